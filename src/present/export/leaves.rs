//! Exports the cells of leaves as boxes for other programs. A format is one entry of
//! [`LEAF_WRITERS`].

use crate::geometry::Aabb;
use crate::present::overlay::{Filter, Leaf};
use crate::present::report::Writer;
use crate::structure::Tree;
use crate::trace::Visits;
use std::io::{Result, Write};

/// A leaf and its cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafCell {
    /// Its number in the tree.
    pub node: u32,
    /// The root has depth 0.
    pub depth: u32,
    /// Number of objects in the leaf; 0 for an empty leaf.
    pub objects: u32,
    /// Its cell, in the scene's units.
    pub bounds: Aabb,
}

/// The leaves of a tree that pass a filter.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafCells {
    /// A one-line description of the tree.
    pub of: String,
    pub cells: Vec<LeafCell>,
}

/// All formats; the first is the default.
pub static LEAF_WRITERS: &[Writer<LeafCells>] = &[
    Writer {
        name: "obj",
        about: "Wavefront OBJ: every leaf an object of 6 faces, named after its node",
        extension: "obj",
        write: write_obj,
    },
    Writer {
        name: "ply",
        about: "PLY, binary: 6 faces a leaf, each with node, depth and number of objects",
        extension: "ply",
        write: write_ply,
    },
];

/// The corners of a box's six faces, counterclockwise seen from outside. Bits 0 to 2 of a corner
/// stand for x, y and z: 0 is the lower end, 1 the upper.
const FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// Returns the eight corners of a box, in the order of their bits.
fn corners(bounds: &Aabb) -> [[f64; 3]; 8] {
    let ends = [bounds.lo.to_array(), bounds.hi.to_array()];
    std::array::from_fn(|corner| std::array::from_fn(|k| ends[corner >> k & 1][k]))
}

impl LeafCells {
    /// Returns the leaves of a tree that pass a filter, in the order of their nodes. A filter by
    /// visits needs `visits`; without them, no leaf passes.
    pub fn new(of: String, tree: &Tree, filter: &Filter, visits: Option<&Visits>) -> Self {
        let mut cells: Vec<LeafCell> = tree
            .cells()
            .filter_map(|cell| {
                let leaf = Leaf::of(tree, &cell, visits)?;
                filter.passes(&leaf).then_some(LeafCell {
                    node: cell.node,
                    depth: leaf.depth,
                    objects: leaf.objects,
                    bounds: cell.bounds,
                })
            })
            .collect();
        cells.sort_by_key(|cell| cell.node);
        LeafCells { of, cells }
    }
}

fn write_obj(leaves: &LeafCells, out: &mut dyn Write) -> Result<()> {
    writeln!(
        out,
        "# Leaves of {}: {}",
        one_line(&leaves.of),
        leaves.cells.len()
    )?;
    for (i, cell) in leaves.cells.iter().enumerate() {
        let LeafCell {
            node,
            depth,
            objects,
            ..
        } = cell;
        writeln!(out, "o leaf-{node}-depth-{depth}-objects-{objects}")?;
        for [x, y, z] in corners(&cell.bounds) {
            writeln!(out, "v {x} {y} {z}")?;
        }
        // Vertices are numbered from 1 throughout the file.
        let first = 8 * i as u64 + 1;
        for face in FACES {
            let [a, b, c, d] = face.map(|corner| first + u64::from(corner));
            writeln!(out, "f {a} {b} {c} {d}")?;
        }
    }
    Ok(())
}

fn write_ply(leaves: &LeafCells, out: &mut dyn Write) -> Result<()> {
    let count = leaves.cells.len();
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment Leaves of {}\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nproperty uint node\n\
         property uint depth\nproperty uint objects\nend_header\n",
        one_line(&leaves.of),
        8 * count,
        6 * count
    )?;
    for cell in &leaves.cells {
        for number in corners(&cell.bounds).as_flattened() {
            out.write_all(&number.to_le_bytes())?;
        }
    }
    for (i, cell) in leaves.cells.iter().enumerate() {
        for face in FACES {
            out.write_all(&[4])?;
            let corners = face.map(|corner| 8 * i as u32 + corner);
            for number in corners
                .into_iter()
                .chain([cell.node, cell.depth, cell.objects])
            {
                out.write_all(&number.to_le_bytes())?;
            }
        }
    }
    Ok(())
}

/// Replaces line breaks, which would end a comment.
fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
