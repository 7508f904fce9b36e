// Writes the hierarchy that three-mesh-bvh builds for an OBJ file of triangles to a tree file (.bstree).
//
//     npm install three three-mesh-bvh
//     node export_three_mesh_bvh.mjs model.obj three.bstree
//     bspscope measure model.obj --tree three.bstree

import { readFileSync, writeFileSync } from 'node:fs';
import { BufferAttribute, BufferGeometry } from 'three';
import { MeshBVH, SAH } from 'three-mesh-bvh';

// Converts what MeshBVH.serialize returns for a hierarchy built with { indirect: true }, which leaves the order of
// faces as it is.
export function toBstree({ roots, indirectBuffer }, faces) {
    if (roots.length !== 1 || !indirectBuffer) throw new Error('expected one root and { indirect: true }');
    const [floats, words, halves] = [Float32Array, Uint32Array, Uint16Array].map((T) => new T(roots[0]));
    const nodes = floats.length / 8;
    const box = new Float32Array(6 * nodes), leaf = new Uint8Array(nodes), child = [];
    const [first, count] = [new Uint32Array(nodes), new Uint32Array(nodes)];
    for (let node = 0; node < nodes; node++) {
        box.set(floats.subarray(8 * node, 8 * node + 6), 6 * node);
        leaf[node] = halves[16 * node + 15] === 0xffff ? 1 : 0;
        if (leaf[node]) {
            [first[node], count[node]] = [words[8 * node + 6], halves[16 * node + 14]];
        } else {
            [first[node], count[node]] = [child.length, 2];
            child.push(node + 1, node + words[8 * node + 6]);
        }
    }
    const columns = [['box', 'f32', [nodes, 6], box], ['leaf', 'u8', [nodes], leaf],
        ['first', 'u32', [nodes], first], ['count', 'u32', [nodes], count],
        ['child', 'u32', [child.length], Uint32Array.from(child)],
        ['ref', 'u32', [indirectBuffer.length], Uint32Array.from(indirectBuffer)]];
    const parts = [], arrays = [];
    let offset = 0;
    for (const [name, type, shape, numbers] of columns) {
        arrays.push([name, type, shape, offset]);
        parts.push(Buffer.from(numbers.buffer));
        offset += numbers.byteLength;
    }
    let header = JSON.stringify({ format: 'bstree', version: 1, kind: 'bvh', objects: faces, arrays });
    header = header.padEnd(64 * Math.ceil((header.length + 1) / 64) - 1) + '\n';
    return Buffer.concat([Buffer.from(header), ...parts]);
}

const [model, file] = process.argv.slice(2);
const lines = readFileSync(model, 'utf8').split('\n').map((line) => line.trim().split(/\s+/));
const positions = lines.filter(([key]) => key === 'v').flatMap((line) => line.slice(1, 4).map(Number));
const corners = lines.filter(([key]) => key === 'f').flatMap((line) => line.slice(1, 4));
const geometry = new BufferGeometry();
geometry.setAttribute('position', new BufferAttribute(Float32Array.from(positions), 3));
geometry.setIndex(new BufferAttribute(Uint32Array.from(corners, (c) => parseInt(c) - 1), 1));
const bvh = new MeshBVH(geometry, { strategy: SAH, indirect: true });
writeFileSync(file, toBstree(MeshBVH.serialize(bvh), corners.length / 3));
