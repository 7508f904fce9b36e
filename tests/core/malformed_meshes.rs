//! Bad meshes of every format but NFF: each mistake is named with its place, at no great cost.

use bspscope::progress::Progress;
use bspscope::scene::SceneParts;
use bspscope::scene::format::{FORMATS, Input, ReadError};
use serde_json::{Value, json};

fn read(format: &str, bytes: &[u8]) -> Result<SceneParts, ReadError> {
    let format = FORMATS.iter().find(|f| f.name == format).unwrap();
    (format.read)(&Input::from(bytes), &Progress::new())
}

/// Holds the message about a file against the parts it must have.
fn refused(format: &str, bytes: &[u8], fragments: &[&str]) {
    let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(300)]);
    let Err(error) = read(format, bytes) else {
        panic!("{format} takes {shown:?}")
    };
    let message = error.to_string();
    for fragment in fragments {
        assert!(
            message.contains(fragment),
            "{shown:?}: {message}, not {fragment}"
        );
    }
    assert!(
        message.len() < 600 && !message.contains(char::is_control),
        "{message:?}"
    );
}

#[test]
fn mistakes_in_obj_are_named_with_their_line() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    let cases: &[(&str, &[&str])] = &[
        (
            "v 1 2\n",
            &["line 4", "z of the vertex", "the end of the line"],
        ),
        ("v 1 x 2\n", &["line 4", "y of the vertex", "'x'"]),
        (
            "v 1 2 nan\nf 1 2 4\n",
            &["line 5", "finite coordinates", "vertex 4 of line 4"],
        ),
        (
            "\nv 1 -1.#INF 2\nf -1 1 2\n",
            &["line 6", "finite coordinates", "vertex 4 of line 5"],
        ),
        (
            "f 1 2 4\n",
            &["line 4", "a vertex index from 1 to 3", "'4'"],
        ),
        ("f 1 2 0\n", &["line 4", "found '0'"]),
        ("f 1 2 -4\n", &["line 4", "from -3 to -1", "'-4'"]),
        ("f 1 2 -9223372036854775808\n", &["line 4"]),
        ("f 1 2 99999999999999999999\n", &["line 4"]),
        ("f 1 2 3.5\n", &["line 4", "'3.5'"]),
        ("\n\nf 1 2 /\n", &["line 6"]),
        ("f 1 \\\n 2 \\\n 9\n", &["line 4", "'9'"]),
        ("f 1 2 \u{1b}[31m\n", &["line 4"]),
        (
            "v 1e308 1e308 0\nv -1e308 -1e308 0\nv 1e308 -1e308 0\nf 4 5 6 1\n",
            &["line 7"],
        ),
    ];
    for (text, fragments) in cases {
        refused("obj", format!("{square}{text}").as_bytes(), fragments);
    }
}

#[test]
fn what_is_no_obj_is_refused_as_such() {
    refused(
        "obj",
        b"\n<html>\n404\n</html>\n",
        &["line 2", "'<html>'", "OBJ"],
    );
    for text in ["\u{feff}v 0 0 0\n", "v 0 0 0\n"] {
        let (mut little, mut big) = (Vec::new(), Vec::new());
        for unit in text.encode_utf16() {
            little.extend(unit.to_le_bytes());
            big.extend(unit.to_be_bytes());
        }
        for bytes in [little, big] {
            refused("obj", &bytes, &["line 1", "UTF-16", "UTF-8"]);
            refused("ply", &bytes, &["UTF-16"]);
            refused("gltf", &bytes, &["UTF-16"]);
        }
    }
}

#[test]
fn mistakes_in_stl_are_named_with_their_line_or_facet() {
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
                 endloop\nendfacet\n";
    let cases: &[(&str, &str, &[&str])] = &[
        ("vertex 1 0 0", "vertex 1 0", &["line 5", "z of the vertex"]),
        ("vertex 1 0 0", "vertex 1 0 inf", &["line 5", "'inf'"]),
        (
            "outer loop\n",
            "",
            &["line 3", "expected 'outer loop'", "'vertex'"],
        ),
        (
            "endloop\n",
            "",
            &["line 7", "'vertex' or 'endloop'", "'endfacet'"],
        ),
        ("endfacet\n", "", &["line 8", "expected 'endfacet'"]),
        (
            "endfacet\n",
            "endfacet\nfaced\n",
            &["line 9", "'facet' or 'endsolid'", "'faced'"],
        ),
    ];
    for (good, bad, fragments) in cases {
        let text = format!("solid a\n{facet}endsolid a\n");
        assert!(read("stl", text.as_bytes()).is_ok());
        refused("stl", text.replace(good, bad).as_bytes(), fragments);
    }
    let cut = format!("solid a\n{facet}");
    refused(
        "stl",
        cut.as_bytes(),
        &["line 8", "'endsolid'", "the end of the file"],
    );

    let mut binary = vec![0; 80];
    refused(
        "stl",
        &binary,
        &["byte 80", "84 bytes", "the end of the file"],
    );
    refused("stl", b"", &["byte 0"]);
    binary.extend(4_000_000_000_u32.to_le_bytes());
    binary.extend([0; 49]);
    refused(
        "stl",
        &binary,
        &["facet 0", "4000000000 facets", "the end of the file"],
    );
    // What has neither the declared size nor plausible coordinates is something else.
    binary.extend([0x7f; 500]);
    refused("stl", &binary, &["4000000000 facets"]);
    let page = "<html><body>not found</body></html>\n".repeat(10);
    refused(
        "stl",
        page.as_bytes(),
        &["line 1", "STL as text", "'<html>"],
    );
    let text = format!("solid a\n{facet}endsolid a\n");
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    refused("stl", &wide, &["text in UTF-16"]);
    refused(
        "stl",
        &[b"\xff\xfe", &wide[..]].concat(),
        &["text in UTF-16"],
    );
    let mut nan = vec![0; 80];
    nan.extend(1_u32.to_le_bytes());
    nan.extend([0xff; 50]);
    refused("stl", &nan, &["facet 0", "numbers that define a triangle"]);
}

/// A PLY header.
fn header(format: &str, elements: &str) -> String {
    format!("ply\nformat {format} 1.0\n{elements}end_header\n")
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";

#[test]
fn mistakes_in_ply_are_named_with_their_line_or_element() {
    let list = "property list uchar int vertex_indices\n";
    let mesh = |vertices: &str, faces: &str| {
        format!("element vertex {vertices}\n{XYZ}element face {faces}\n{list}")
    };
    let text = |elements: &str, data: &str| header("ascii", elements) + data;
    let points = "0 0 0\n1 0 0\n0 1 0\n";
    let good = text(&mesh("3", "1"), &format!("{points}3 0 1 2\n"));
    assert_eq!(read("ply", good.as_bytes()).unwrap().objects.len(), 1);
    let cases: &[(String, &[&str])] = &[
        ("ply\n".into(), &["PLY header", "end"]),
        ("ply\nformat ascii 1.0\nelement\n".into(), &["line 3"]),
        ("ply\nformat ebcdic 1.0\n".into(), &["line 2"]),
        (text("", "").replace("end_header\n", ""), &["end_header"]),
        (
            text("element vertex 1\nproperty float x\n", "0\n"),
            &["x, y and z"],
        ),
        (text(&mesh("-1", "1"), ""), &["line 3"]),
        (
            text(&mesh("18446744073709551615", "1"), points),
            &["18446744073709551615 of element"],
        ),
        (
            text(&mesh("99999999999999999999", "1"), points),
            &["line 3"],
        ),
        (
            text(&mesh("3", "2"), &format!("{points}3 0 1 2\n")),
            &["line 13", "end of the file"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}3 0 1\n")),
            &["line 13", "1 of element 'face'", "end of the file"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}3 0 1 x\n")),
            &["line 13", "the numbers of a face", "'x'"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}3 0\n1 2.5\n")),
            &["line 14", "the numbers of a face", "'2.5'"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}3 0 1 3\n")),
            &["line 13", "3 vertices", "3"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}3 0 1 -1\n")),
            &["line 13", "found -1"],
        ),
        (
            text(&mesh("3", "1"), &format!("{points}4000000000 0\n")),
            &["line 13"],
        ),
        (
            text(&mesh("3", "1"), "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
            &["line 13", "finite coordinates", "vertex 1 of line 11"],
        ),
        (
            text(&mesh("3", "1"), "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n"),
            &["line 11", "the numbers of a vertex", "'zero'"],
        ),
        (text(&mesh("3", "1"), "0 0 0\n1 0\n"), &["line 11"]),
        (
            text(
                &format!("element face 1\n{list}element vertex 3\n{XYZ}"),
                "3 0 1 2\n",
            ),
            &["0 vertices above"],
        ),
        (
            text(
                &format!("element vertex 3\n{XYZ}element face 1\nproperty int vertex_indices\n"),
                &format!("{points}3\n"),
            ),
            &["a list of whole numbers"],
        ),
        (
            text(
                &format!("element vertex 3\n{XYZ}element face 1\nproperty int a\n"),
                points,
            ),
            &["vertex_indices or vertex_index"],
        ),
    ];
    for (text, fragments) in cases {
        refused("ply", text.as_bytes(), fragments);
    }
    for (order, bytes) in [("little", [1, 0, 0, 0]), ("big", [0, 0, 0, 1])] {
        let format = format!("binary_{order}_endian");
        let mut file = header(&format, &mesh("4000000000", "1")).into_bytes();
        file.extend([0; 25]);
        refused(
            "ply",
            &file,
            &[
                "vertex 2",
                "4000000000 of element 'vertex'",
                "end of the file",
            ],
        );
        // A list longer than the file.
        let long = mesh("1", "1").replace("list uchar", "list int");
        let mut file = header(&format, &long).into_bytes();
        file.extend([0; 12]);
        let mut count = [0x7f, 0xff, 0xff, 0xff];
        if order == "little" {
            count.reverse();
        }
        file.extend(count);
        file.extend(bytes);
        refused("ply", &file, &["face 0", "end of the file"]);
    }
    // Elements of no bytes are no work, however many there are.
    let nothing = header(
        "binary_little_endian",
        "element nothing 18446744073709551615\n",
    );
    assert!(read("ply", nothing.as_bytes()).is_ok());
}

/// A glTF file of one triangle, with a place in it changed.
fn gltf_with(pointer: &str, value: Value) -> Vec<u8> {
    let triangle = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
    let file = crate::support::glb::file(&triangle, &crate::support::glb::furnished());
    let mut json: Value = serde_json::from_slice(&file.with_data_uri()).unwrap();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = json
        .pointer_mut(parent)
        .unwrap_or_else(|| panic!("{pointer}"));
    match parent {
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        parent => parent[key] = value,
    }
    serde_json::to_vec(&json).unwrap()
}

#[test]
fn mistakes_in_gltf_are_named_with_their_element() {
    let cases: &[(&str, Value, &[&str])] = &[
        ("/asset/version", json!("1.0"), &["glTF version 2", "1.0"]),
        ("/asset", json!(7), &["line 1", "glTF"]),
        ("/scene", json!(3), &["scene 3", "one of 1 scenes"]),
        (
            "/scenes/0/nodes/0",
            json!(99),
            &["node 99", "one of 4 nodes"],
        ),
        ("/nodes/0/mesh", json!(5), &["mesh 5", "one of 1 meshes"]),
        ("/nodes/0/children", json!([77]), &["node 77"]),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(9),
            &["accessor 9"],
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(1),
            &["accessor 1", "type VEC3"],
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(0),
            &["accessor 0", "type SCALAR"],
        ),
        (
            "/accessors/0/count",
            json!(4),
            &["accessor 0", "beyond its end"],
        ),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            &["accessor 0", "beyond its end"],
        ),
        (
            "/accessors/0/byteOffset",
            json!(u64::MAX),
            &["accessor 0", "beyond its end"],
        ),
        (
            "/accessors/0/componentType",
            json!(1),
            &["accessor 0", "type of components"],
        ),
        (
            "/accessors/0/bufferView",
            json!(6),
            &["accessor 0", "a buffer view"],
        ),
        (
            "/accessors/0/count",
            json!(2),
            &["mesh 0", "indices below 2"],
        ),
        (
            "/accessors/1/componentType",
            json!(5126),
            &["mesh 0", "whole numbers"],
        ),
        (
            "/bufferViews/0/byteLength",
            json!(u64::MAX),
            &["accessor 0", "beyond its end"],
        ),
        (
            "/bufferViews/0/byteStride",
            json!(4),
            &["accessor 0", "do not overlap"],
        ),
        (
            "/bufferViews/0/buffer",
            json!(2),
            &["accessor 0", "a buffer"],
        ),
        (
            "/buffers/0/byteLength",
            json!(4_000_000_000_u64),
            &["buffer 0", "4000000000 bytes"],
        ),
        (
            "/buffers/0/uri",
            json!("data:text/plain,hello"),
            &["buffer 0", "bytes, found 5"],
        ),
        (
            "/buffers/0/uri",
            json!("data:;base64,!!!"),
            &["buffer 0", "base64"],
        ),
        (
            "/buffers/0/uri",
            json!("http://a.b/c.bin"),
            &["buffer 0", "the file 'http://a.b/c.bin'"],
        ),
        ("/buffers/0/uri", json!(null), &["buffer 0", "a URI"]),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            &[
                "compressed with Draco",
                "KHR_draco_mesh_compression",
                "without compression",
            ],
        ),
        (
            "/extensionsRequired",
            json!(["EXT_meshopt_compression"]),
            &["compressed with meshoptimizer", "decompress it"],
        ),
        (
            "/extensionsRequired",
            json!(["ACME_curved_space"]),
            &["the required extension 'ACME_curved_space'"],
        ),
        (
            "/accessors/0/count",
            json!(1.5),
            &["line 1", "whole number"],
        ),
        ("/scene", json!(-1), &["line 1", "whole number"]),
    ];
    for (pointer, value, fragments) in cases {
        refused("gltf", &gltf_with(pointer, value.clone()), fragments);
    }
    refused("gltf", b"{\n\"asset\": }", &["line 2", "glTF"]);
    refused(
        "gltf",
        &[b"{\"asset\":".as_slice(), &[b'['; 100_000]].concat(),
        &["line 1"],
    );
}

#[test]
fn mistakes_in_glb_are_named_with_their_byte() {
    let triangle = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
    let good = crate::support::glb::file(&triangle, &crate::support::glb::to_and_fro()).glb();
    let with = |at: usize, number: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
        bytes
    };
    assert_eq!(read("gltf", &good).unwrap().objects.len(), 1);
    refused("gltf", b"glTF", &["byte 4", "the end of the file"]);
    refused("gltf", &with(4, 1), &["byte 4", "version 2"]);
    refused("gltf", &with(8, 3), &["byte 3"]);
    refused("gltf", &with(8, u32::MAX), &["byte 8", "4294967295 bytes"]);
    refused(
        "gltf",
        &with(12, u32::MAX),
        &["byte 12", "4294967295 bytes in chunk 'JSON'"],
    );
    refused("gltf", &with(16, 0), &["byte 16", "a chunk 'JSON'"]);
    refused("gltf", &good[..good.len() - 1], &["byte 8"]);
}

#[test]
fn nodes_in_a_ring_end() {
    for children in [json!([0]), json!([1, 1, 1, 2])] {
        let parts = read("gltf", &gltf_with("/nodes/0/children", children)).unwrap();
        assert_eq!(parts.objects.len(), 1);
        let said = parts.notes.iter().any(|n| n.text.contains("two parents"));
        assert!(said, "{:?}", parts.notes);
    }
}

/// A kilobyte that claims to place a mesh a million million times ends, and soon.
#[test]
fn few_bytes_never_become_endless_work() {
    let mut json: Value = serde_json::from_slice(&gltf_with("/scene", json!(0))).unwrap();
    let part = json["meshes"][0]["primitives"][0].clone();
    json["meshes"][0]["primitives"] = Value::Array(vec![part; 20_000]);
    json["nodes"] = Value::Array(vec![json!({"mesh": 0}); 20_000]);
    json["scenes"][0]["nodes"] = (0..20_000).collect();
    json["accessors"][1]["count"] = json!(0);
    let bytes = serde_json::to_vec(&json).unwrap();
    refused("gltf", &bytes, &["at most", "mesh parts and triangles"]);
}
