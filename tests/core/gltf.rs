//! glTF, part by part, against what its specification says of numbers written out by hand.

use base64::Engine;
use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::format::{FORMATS, Input};
use bspscope::scene::{Material, SceneParts};
use serde_json::{Value, json};

/// Reads a file with one buffer; `rest` overrides a triangle at (1, 0, 0), (0, 1, 0), (0, 0, 1) in a
/// node of its own.
fn read(buffer: &[u8], rest: Value) -> SceneParts {
    let data = base64::engine::general_purpose::STANDARD.encode(buffer);
    let mut json = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{
            "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 1],
        }],
        "bufferViews": [{"buffer": 0, "byteLength": buffer.len()}],
    });
    let all = json.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    json["buffers"] = json!([{
        "byteLength": buffer.len(),
        "uri": format!("data:application/octet-stream;base64,{data}"),
    }]);
    let format = FORMATS.iter().find(|f| f.name == "gltf").unwrap();
    let bytes = json.to_string().into_bytes();
    (format.read)(&Input::from(bytes.as_slice()), &Progress::new())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// The usual triangle's buffer.
fn corner() -> Vec<u8> {
    floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])
}

fn triangles(parts: &SceneParts) -> Vec<&Triangle> {
    let objects = parts.objects.iter();
    objects
        .map(|object| match object {
            Primitive::Triangle(triangle) => triangle,
            other => panic!("not a triangle: {other:?}"),
        })
        .collect()
}

fn near(found: &[Vec3], expected: &[[f64; 3]], by: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let expected = Vec3::from_array(*expected);
        assert!(found.abs_diff_eq(expected, by), "{found} for {expected}");
    }
}

#[test]
fn nodes_scale_then_turn_then_move_and_children_follow_their_parents() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let parts = read(
        &corner(),
        json!({"nodes": [
            {"translation": [1, 2, 3], "children": [1]},
            // A quarter turn about z, from x to y.
            {"rotation": [0, 0, half, half], "scale": [2, 3, 4], "mesh": 0},
        ]}),
    );
    let expected = [[1.0, 4.0, 3.0], [-2.0, 2.0, 3.0], [1.0, 2.0, 7.0]];
    near(&triangles(&parts)[0].vertices, &expected, 1e-6);
}

#[test]
fn vertices_may_lie_among_others_and_be_parts_of_the_largest_number() {
    // Every vertex: three 16-bit numbers, two bytes of something else, three 8-bit ones, a byte.
    let mut buffer = Vec::new();
    let largest = i16::MAX;
    for (position, normal) in [
        ([largest, 0, 0], [0, 0, 127_i8]),
        ([0, largest, 0], [0, 127, 0]),
        ([0, 0, largest], [127, 0, 0]),
        ([0, 0, -largest], [-127, 0, 0]),
    ] {
        buffer.extend(position.into_iter().flat_map(i16::to_le_bytes));
        buffer.extend([99, 99]);
        buffer.extend(normal.map(|n| n as u8));
        buffer.push(99);
    }
    buffer.extend([0_u8, 1, 2, 0, 3, 1]);
    let parts = read(
        &buffer,
        json!({
            "extensionsRequired": ["KHR_mesh_quantization"],
            "extensionsUsed": ["KHR_mesh_quantization"],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
            "bufferViews": [
                {"buffer": 0, "byteLength": 48, "byteStride": 12},
                {"buffer": 0, "byteOffset": 48, "byteLength": 6},
            ],
            "accessors": [
                {
                    "bufferView": 0, "componentType": 5122, "normalized": true, "count": 4,
                    "type": "VEC3", "min": [0, 0, -1], "max": [1, 1, 1],
                },
                {
                    "bufferView": 0, "byteOffset": 8, "componentType": 5120, "normalized": true,
                    "count": 4, "type": "VEC3",
                },
                {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"},
            ],
        }),
    );
    let found = triangles(&parts);
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    near(&found[0].vertices, &[x, y, z], 1e-12);
    near(&found[1].vertices, &[x, [0.0, 0.0, -1.0], y], 1e-12);
    near(
        found[0].normals.as_ref().unwrap().as_slice(),
        &[z, y, x],
        1e-12,
    );
    let second = found[1].normals.as_ref().unwrap();
    near(second.as_slice(), &[z, [-1.0, 0.0, 0.0], y], 1e-12);
}

#[test]
fn normals_stay_at_right_angles_where_scales_differ() {
    let mut buffer = corner();
    let side = 1.0 / 3.0_f32.sqrt();
    buffer.extend(floats(&[side; 9]));
    let parts = read(
        &buffer,
        json!({
            "nodes": [{"mesh": 0, "scale": [1, 2, 4]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
            "accessors": [
                {
                    "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                    "min": [0, 0, 0], "max": [1, 1, 1],
                },
                {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3"},
            ],
        }),
    );
    let triangle = triangles(&parts)[0];
    let [a, b, c] = triangle.vertices;
    for normal in triangle.normals.as_ref().unwrap().iter() {
        assert!(normal.dot(b - a).abs() < 1e-6 && normal.dot(c - a).abs() < 1e-6);
    }
}

#[test]
fn strips_and_fans_keep_the_side_of_their_triangles() {
    // A square, round about its middle for the fan, to and fro for the strip.
    let strip = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    let fan = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    for (mode, buffer) in [(5, strip), (6, fan)] {
        let parts = read(
            &buffer,
            json!({
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": mode}]}],
                "accessors": [{
                    "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                    "min": [0, 0, 0], "max": [1, 1, 0],
                }],
            }),
        );
        let found = triangles(&parts);
        assert_eq!(found.len(), 2, "mode {mode}");
        for triangle in found {
            let [a, b, c] = triangle.vertices;
            let normal = (b - a).cross(c - a);
            assert!(normal.abs_diff_eq(Vec3::Z, 1e-12), "mode {mode}: {normal}");
        }
    }
}

#[test]
fn lights_shine_as_they_do_amid_the_scene() {
    let node = |light: usize, more: Value| {
        let mut node = more;
        node["extensions"] = json!({"KHR_lights_punctual": {"light": light}});
        node
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let light = json!({"KHR_lights_punctual": {"lights": [
        {"type": "point", "intensity": 100},
        {"type": "directional", "intensity": 0.5},
    ]}});
    // The middle is at (0.5, 0.5, 0.5).
    let parts = read(
        &corner(),
        json!({
            "scenes": [{"nodes": [0, 1, 2, 3]}],
            "nodes": [
                {"mesh": 0},
                node(0, json!({"translation": [10.5, 0.5, 0.5]})),
                node(0, json!({"translation": [0.5, 0.5, 20.5]})),
                // A quarter turn about y, from -z to -x.
                node(1, json!({"rotation": [0, half, 0, half]})),
            ],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": light,
        }),
    );
    let color = |i: usize| parts.lights[i].color.unwrap().max_element();
    // 100 / 10² = 1, 100 / 20² = 1/4, and 1/2; the brightest has 1/√3.
    let most = 1.0 / 3.0_f64.sqrt();
    for (i, share) in [1.0, 0.25, 0.5].into_iter().enumerate() {
        assert!(
            (color(i) - share * most).abs() < 1e-9,
            "light {i}: {}",
            color(i)
        );
    }
    // What shines along −x stands far away on the side of +x.
    let from = parts.lights[2].position - Vec3::splat(0.5);
    assert!(from.length() > 1000.0, "{from}");
    assert!(from.normalize().abs_diff_eq(Vec3::X, 1e-6), "{from}");
}

#[test]
fn metals_mirror_by_their_smoothness_and_glass_bends_as_glass() {
    let materials = [
        json!({"pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0.25}}),
        json!({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9}}}),
        json!({"extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 0.5}, "KHR_materials_ior": {"ior": 1.25},
        }}),
    ];
    let found = materials.map(|mut material| {
        if material.get("pbrMetallicRoughness").is_none() {
            material["pbrMetallicRoughness"] = json!({"metallicFactor": 0});
        }
        let part = json!({"attributes": {"POSITION": 0}, "material": 0});
        let parts = read(
            &corner(),
            json!({"meshes": [{"primitives": [part]}], "materials": [material]}),
        );
        parts.materials[0]
    });
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let [metal, glass, thin]: [Material; 3] = found;
    assert!(
        close(metal.specular, 0.75) && close(metal.diffuse, 0.25),
        "{metal:?}"
    );
    // Blinn's exponent of the roughness squared.
    assert!(
        close(metal.shine, 2.0 / 0.25_f64.powi(4) - 2.0),
        "{metal:?}"
    );
    assert!(
        close(glass.transmittance, 0.9) && close(glass.diffuse, 0.1),
        "{glass:?}"
    );
    assert!(close(glass.index_of_refraction, 1.5), "{glass:?}");
    assert!(close(thin.index_of_refraction, 1.25), "{thin:?}");
}
