//! glTF files that a specification forbids, but that other programs write and open.

use super::{check, reported, try_read};
use base64::Engine;
use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Shape};
use bspscope::scene::SceneParts;
use serde_json::{Value, json};

/// Bytes of a triangle, and of what else the tests refer to.
fn buffer() -> Vec<u8> {
    let triangle = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    // Three translations from byte 36, three rotations from 72, three scales from 120.
    let translations = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0, 0.0, 0.0];
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let rotations = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 1.0, 0.0];
    let scales = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 1.0, 1.0];
    let all = triangle
        .into_iter()
        .chain(translations)
        .chain(rotations)
        .chain(scales);
    let mut bytes: Vec<u8> = all.flat_map(f32::to_le_bytes).collect();
    // Sparse: index 2 from byte 156, its value from 160.
    bytes.extend([2, 0, 0, 0]);
    bytes.extend([0.0_f32, 3.0, 0.0].into_iter().flat_map(f32::to_le_bytes));
    bytes
}

/// A glTF file of one triangle; `rest` replaces top-level entries.
fn gltf(rest: Value) -> Value {
    let data = base64::engine::general_purpose::STANDARD.encode(buffer());
    let vectors = |offset: usize, kind: &str| json!({"bufferView": 0, "byteOffset": offset, "componentType": 5126, "count": 3, "type": kind});
    let mut file = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [vectors(0, "VEC3"), vectors(36, "VEC3"), vectors(72, "VEC4"), vectors(120, "VEC3")],
        "bufferViews": [{"buffer": 0, "byteLength": 172}],
        "buffers": [{"byteLength": 172, "uri": format!("data:;base64,{data}")}],
    });
    let all = file.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    file
}

fn check_gltf(rest: Value, objects: usize, report: &str) -> SceneParts {
    check("gltf", gltf(rest).to_string(), objects, report)
}

/// The bounds of each object, rounded.
fn bounds(parts: &SceneParts) -> Vec<[[f64; 3]; 2]> {
    let rounded = |v: Vec3| (v * 1e6).round().to_array().map(|n| n / 1e6 + 0.0);
    let of = |object: &Primitive| [object.bounds().lo, object.bounds().hi].map(rounded);
    parts.objects.iter().map(of).collect()
}

#[test]
fn instances_in_gltf_are_copies() {
    let instancing = |attributes: Value| {
        json!({
            "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "extensionsRequired": ["EXT_mesh_gpu_instancing"],
            "nodes": [{"mesh": 0, "translation": [0, 0, 7], "extensions": {
                "EXT_mesh_gpu_instancing": {"attributes": attributes},
            }}],
        })
    };
    let parts = check_gltf(instancing(json!({"TRANSLATION": 1, "_ID": 0})), 3, "");
    let at = |x: f64| [[x, 0.0, 7.0], [x + 1.0, 1.0, 7.0]];
    assert_eq!(bounds(&parts), [at(0.0), at(2.0), at(4.0)]);
    let all = instancing(json!({"TRANSLATION": 1, "ROTATION": 2, "SCALE": 3}));
    let parts = check_gltf(all, 3, "");
    // The second is turned by a quarter about z, the third by a half.
    let expected = [
        [[0.0, 0.0, 7.0], [1.0, 1.0, 7.0]],
        [[0.0, 0.0, 7.0], [2.0, 2.0, 7.0]],
        [[1.0, -1.0, 7.0], [4.0, 0.0, 7.0]],
    ];
    assert_eq!(bounds(&parts), expected);
    for attributes in [json!({}), json!({"TRANSLATION": 9}), json!({"ROTATION": 1})] {
        let file = gltf(instancing(attributes)).to_string();
        assert!(try_read("gltf", file.as_bytes()).is_err(), "{file}");
    }
}

#[test]
fn hidden_nodes_of_gltf_are_skipped_with_their_children() {
    let visible = |is: bool| json!({"KHR_node_visibility": {"visible": is}});
    let nodes = json!({
        "extensionsUsed": ["KHR_node_visibility"],
        "scenes": [{"nodes": [0, 1, 3]}],
        "nodes": [
            {"mesh": 0, "extensions": visible(true)},
            {"mesh": 0, "children": [2], "extensions": visible(false)},
            {"mesh": 0, "extensions": visible(true)},
            {"mesh": 0, "extensions": visible(false)},
        ],
    });
    check_gltf(
        nodes,
        1,
        "2 × node that is hidden (KHR_node_visibility), with its children",
    );
}

fn with_material(material: Value, rest: Value) -> Value {
    let mut file = json!({
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [material],
    });
    let all = file.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    file
}

#[test]
fn specular_and_glossiness_in_gltf_are_read() {
    let name = "KHR_materials_pbrSpecularGlossiness";
    let required = json!({"extensionsUsed": [name], "extensionsRequired": [name]});
    let material = |extension: Value| json!({"extensions": {name: extension}});
    let file = with_material(
        material(json!({"diffuseFactor": [0, 1, 0, 1]})),
        required.clone(),
    );
    let parts = check_gltf(file, 1, "");
    assert_eq!(
        (parts.materials[0].color, parts.materials[0].diffuse),
        (Vec3::Y, 1.0)
    );
    let extension = json!({
        "diffuseFactor": [0.5, 0, 0, 1], "specularFactor": [0.5, 0.5, 0.5], "glossinessFactor": 0.5,
        "diffuseTexture": {"index": 0},
    });
    let parts = check_gltf(
        with_material(material(extension), required),
        1,
        "texture, at material 0",
    );
    let found = parts.materials[0];
    assert_eq!(
        (found.specular, found.diffuse, found.color.x),
        (0.25, 0.75, 0.5)
    );
}

#[test]
fn what_gltf_shows_and_bspscope_does_not_is_named() {
    let masked = |alpha: f64, more: Value| {
        let mut pbr = json!({"baseColorFactor": [1, 1, 1, alpha]});
        pbr.as_object_mut()
            .unwrap()
            .extend(more.as_object().unwrap().clone());
        json!({"alphaMode": "MASK", "pbrMetallicRoughness": pbr})
    };
    let none = || json!({});
    check_gltf(
        with_material(masked(0.4, none()), none()),
        0,
        "alpha mask hides, at mesh 0",
    );
    let colored = json!({"attributes": {"POSITION": 0, "COLOR_0": 1}, "material": 0});
    let colored = json!({"meshes": [{"primitives": [colored]}]});
    check_gltf(
        with_material(masked(0.6, none()), colored),
        1,
        "vertex colors (COLOR_0), at mesh 0",
    );
    let texture = json!({"baseColorTexture": {"index": 0}});
    check_gltf(
        with_material(masked(0.4, texture), none()),
        1,
        "alpha mask of a texture",
    );
    let glowing = json!({"emissiveFactor": [0, 0.5, 0]});
    check_gltf(with_material(glowing, none()), 1, "emissive color");
    let coat = json!({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}});
    let used = json!({"extensionsUsed": ["KHR_materials_clearcoat", "ACME_unknown"]});
    let parts = check_gltf(
        with_material(coat, used),
        1,
        "'KHR_materials_clearcoat', which is not supported, at material 0",
    );
    assert!(reported(&parts).contains("extension 'ACME_unknown', which is not supported"));
    // An extension that is used but not declared.
    let nodes = json!({"nodes": [{"mesh": 0, "extensions": {"ACME_bend": {}}}]});
    check_gltf(
        nodes,
        1,
        "extension 'ACME_bend', which is not supported, at node 0",
    );
}

#[test]
fn nothing_but_geometry_refuses_a_gltf_file() {
    for (material, report) in [
        (
            json!({"pbrMetallicRoughness": {"baseColorFactor": "red"}}),
            "baseColorFactor of a material",
        ),
        (
            json!({"pbrMetallicRoughness": 3, "emissiveFactor": [1]}),
            "emissiveFactor of a material",
        ),
        (
            json!({"pbrMetallicRoughness": {"roughnessFactor": null}}),
            "roughnessFactor",
        ),
        (json!(7), "the whole object of a material"),
    ] {
        check_gltf(with_material(material, json!({})), 1, report);
    }
    let part = |part: Value| json!({"meshes": [{"primitives": [part]}]});
    let attributes = json!({"POSITION": 0});
    let file = part(json!({"attributes": attributes, "material": 5}));
    let parts = check_gltf(file, 1, "");
    let defaulted = |n: &bspscope::scene::Note| n.text.contains("material that does not exist");
    assert!(parts.notes.iter().any(defaulted));
    for normal in [json!(99), json!(2), json!("up")] {
        let file = part(json!({"attributes": {"POSITION": 0, "NORMAL": normal}}));
        check_gltf(file, 1, "normals that cannot be read (accessor");
    }
    for (node, report) in [
        (
            json!({"mesh": 0, "camera": 3}),
            "camera that does not exist, at node 0",
        ),
        (
            json!({"mesh": 0, "camera": "front"}),
            "camera that does not exist, at node 0",
        ),
        (
            json!({"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 4}}}),
            "light that does not exist or cannot be read, at node 0",
        ),
    ] {
        check_gltf(json!({"nodes": [node]}), 1, report);
    }
}

#[test]
fn accessors_of_gltf_may_be_sparse_or_without_a_view() {
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": 0, "byteOffset": 156, "componentType": 5123},
        "values": {"bufferView": 0, "byteOffset": 160},
    });
    let view = json!({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse});
    let parts = check_gltf(json!({"accessors": [view]}), 1, "");
    assert_eq!(bounds(&parts), [[[0.0, 0.0, 0.0], [1.0, 3.0, 0.0]]]);
    // Without a view, all but the sparse elements are zero: the triangle has no area.
    let zeros = json!({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse});
    check_gltf(json!({"accessors": [zeros]}), 0, "polygon with zero area");
    let nothing = json!({"componentType": 5126, "count": 3, "type": "VEC3"});
    check_gltf(
        json!({"accessors": [nothing]}),
        0,
        "positions are not in the file",
    );
    let (positions, with_normals) = (
        gltf(json!({}))["accessors"][0].clone(),
        json!([{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}]),
    );
    let file = json!({"accessors": [positions, nothing], "meshes": with_normals});
    check_gltf(file, 1, "zero-length vertex normal; using the face normal");
    for (key, value) in [("count", json!(2)), ("count", json!(1_000_000_000_000_u64))] {
        let mut bad = view.clone();
        bad["sparse"][key] = value;
        let file = gltf(json!({"accessors": [bad]})).to_string();
        assert!(try_read("gltf", file.as_bytes()).is_err(), "{file}");
    }
    // Draco leaves accessors without views for data that is compressed, even if not required.
    let part =
        json!({"attributes": {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {}}});
    let file = json!({"accessors": [nothing], "meshes": [{"primitives": [part]}]});
    let error = try_read("gltf", gltf(file).to_string().as_bytes())
        .unwrap_err()
        .to_string();
    assert!(error.contains("compressed with Draco"), "{error}");
    let buffers = json!({"buffers": [{"byteLength": 172, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}]});
    let error = try_read("gltf", gltf(buffers).to_string().as_bytes())
        .unwrap_err()
        .to_string();
    assert!(error.contains("compressed with meshoptimizer"), "{error}");
}

#[test]
fn data_uris_of_gltf_may_be_written_in_many_ways() {
    let bytes = buffer();
    let base64 = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let lines: Vec<_> = base64
        .as_bytes()
        .chunks(76)
        .map(|l| String::from_utf8_lossy(l))
        .collect();
    let escaped: String = bytes.iter().map(|b| format!("%{b:02x}")).collect();
    for data in [
        format!("data:application/octet-stream;base64,{base64}"),
        format!(
            "data:;base64,{}",
            base64
                .replace('=', "%3D")
                .replace('+', "%2B")
                .replace('/', "%2F")
        ),
        format!("data:;base64,{}", base64.trim_end_matches('=')),
        format!(
            "data:;base64,{}",
            base64.replace('+', "-").replace('/', "_")
        ),
        format!("data:;base64,\n{}\n", lines.join("\r\n")),
        format!("data:application/gltf-buffer;charset=x;BASE64, {base64}"),
        format!("data:application/octet-stream,{escaped}"),
        format!("data:,{escaped}"),
    ] {
        check_gltf(
            json!({"buffers": [{"byteLength": 172, "uri": data}]}),
            1,
            "",
        );
    }
}

#[test]
fn whole_numbers_in_gltf_may_be_written_as_decimals() {
    let decimals = gltf(json!({"scene": 0})).to_string();
    let decimals = decimals
        .replace("5126", "5126.0")
        .replace("\"count\":3", "\"count\":3.0")
        .replace("172", "1.72e2")
        .replace("\"mesh\":0", "\"mesh\":0.0")
        .replace("\"POSITION\":0", "\"POSITION\":0.0")
        .replace("[0]", "[0.0]")
        .replace("\"scene\":0", "\"scene\":0.0");
    check("gltf", decimals, 1, "");
}

#[test]
fn gltf_1_0_is_named() {
    let old = json!({"asset": {"version": "1.0"}, "accessors": {"a": {}}, "meshes": {"m": {}}});
    for file in [
        old.to_string().into_bytes(),
        b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0".to_vec(),
    ] {
        let error = try_read("gltf", &file).unwrap_err().to_string();
        assert!(
            error.contains("found glTF 1.0") && error.contains("version 2"),
            "{error}"
        );
    }
    check_gltf(json!({"asset": {}}), 1, "");
}

#[test]
fn points_in_gltf_are_one_line_of_the_report() {
    let file = json!({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]});
    check_gltf(file, 0, "3 points, no faces");
}
