//! glTF files written with `gltf-json`.

use base64::Engine;
use gltf_json::Root;
use serde_json::{Value, json};

/// A file of one mesh: its JSON without the buffer's place, and the buffer.
pub struct File {
    root: Root,
    pub binary: Vec<u8>,
}

/// Nodes that end with the mesh where it was: there and back, halved and doubled, turned both ways.
pub fn to_and_fro() -> Value {
    json!({
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"translation": [8, -4, 2], "children": [1]},
            {"scale": [2, 4, 0.5], "children": [2]},
            {"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "children": [3]},
            {"matrix": [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "children": [4]},
            {"scale": [0.5, 0.25, 2], "children": [5]},
            {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -8, 4, -2, 1], "mesh": 0},
        ],
    })
}

/// Nodes with a camera and two lights, and a blended material.
pub fn furnished() -> Value {
    json!({
        "scenes": [{"nodes": [0, 1, 2, 3]}],
        "nodes": [
            {"mesh": 0},
            {"translation": [1, 2, 9], "camera": 0},
            {"translation": [5, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"translation": [0, 7, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        ],
        "cameras": [{
            "type": "perspective",
            "perspective": {"yfov": std::f32::consts::FRAC_PI_3, "znear": 0.1, "aspectRatio": 2},
        }],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 100},
            {"type": "point", "intensity": 50, "color": [1, 0, 0]},
        ]}},
        "materials": [{
            "alphaMode": "BLEND",
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.25]},
        }],
    })
}

/// A file of these triangles, with 16-bit indices, and what `rest` says of nodes and materials.
pub fn file(triangles: &[[[f32; 3]; 3]], rest: &Value) -> File {
    let numbers = triangles.as_flattened().as_flattened();
    let mut binary: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    let vertices = 3 * triangles.len();
    let positions = binary.len();
    let indices = 0..vertices as u32;
    binary.extend(indices.flat_map(u32::to_le_bytes));
    let mut json = json!({
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3",
                "min": [-1, -1, -1], "max": [1, 1, 1],
            },
            {"bufferView": 1, "componentType": 5125, "count": vertices, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": positions},
            {"buffer": 0, "byteOffset": positions, "byteLength": binary.len() - positions},
        ],
        "buffers": [{"byteLength": binary.len()}],
    });
    if rest.get("materials").is_some() {
        json["meshes"][0]["primitives"][0]["material"] = json!(0);
    }
    let all = json.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    let root = serde_json::from_value(json).unwrap();
    File { root, binary }
}

impl File {
    fn json(&self) -> Vec<u8> {
        gltf_json::serialize::to_vec(&self.root).unwrap()
    }

    /// As a GLB (glTF 2.0 Specification, section 4.4).
    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json();
        json.resize(json.len().next_multiple_of(4), b' ');
        let total = 12 + 8 + json.len() + 8 + self.binary.len();
        let number = |n: usize| (n as u32).to_le_bytes();
        let mut file = b"glTF\x02\0\0\0".to_vec();
        file.extend(number(total));
        file.extend(number(json.len()));
        file.extend(b"JSON");
        file.extend(json);
        file.extend(number(self.binary.len()));
        file.extend(b"BIN\0");
        file.extend(&self.binary);
        file
    }

    /// As JSON that names its buffer.
    pub fn with_uri(&self, uri: &str) -> Vec<u8> {
        let mut root = self.root.clone();
        root.buffers[0].uri = Some(uri.to_owned());
        gltf_json::serialize::to_vec(&root).unwrap()
    }

    /// As JSON that holds its buffer.
    pub fn with_data_uri(&self) -> Vec<u8> {
        let text = base64::engine::general_purpose::STANDARD.encode(&self.binary);
        self.with_uri(&format!("data:application/octet-stream;base64,{text}"))
    }
}
