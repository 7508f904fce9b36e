//! Exports read back by other programs' readers, and the report as a page.

use crate::html::Element;
use crate::support::program::Program;
use crate::support::scenes::{scene, tree_by};
use bspscope::measure::{Class, DELTA, LAMBDA, parameter, parameters};
use bspscope::present::export::{LEAF_WRITERS, LeafCells};
use bspscope::present::overlay::Filter;
use bspscope::scene::Scene;
use bspscope::structure::{NodeKind, Tree};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use serde_json::Value;
use std::collections::HashMap;

fn tree_of(source: &str, method: &str) -> (Scene, Tree) {
    let scene = scene(source);
    let tree = tree_by(&scene, method);
    (scene, tree)
}

fn written(name: &str, leaves: &LeafCells) -> Vec<u8> {
    let writer = LEAF_WRITERS.iter().find(|w| w.name == name).unwrap();
    let mut bytes = Vec::new();
    (writer.write)(leaves, &mut bytes).unwrap();
    bytes
}

fn all(tree: &Tree) -> LeafCells {
    LeafCells::new("a\nscene".into(), tree, &Filter::default(), None)
}

/// The least and the greatest coordinates.
fn span(points: impl IntoIterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        for k in 0..3 {
            lo[k] = lo[k].min(point[k]);
            hi[k] = hi[k].max(point[k]);
        }
    }
    [lo, hi]
}

#[test]
fn leaves_pass_their_filter_and_none_is_missing() {
    let (_, tree) = tree_of("balls:2", "sah-cut");
    let cells = all(&tree).cells;
    let leaves = tree.cells().filter_map(|cell| match tree.kind(cell.node) {
        NodeKind::Leaf { count, .. } => Some((cell, count)),
        NodeKind::Inner => None,
    });
    let mut expected: Vec<_> = leaves.collect();
    expected.sort_by_key(|(cell, _)| cell.node);
    assert_eq!(cells.len(), expected.len());
    for (found, (cell, count)) in cells.iter().zip(expected) {
        assert_eq!((found.node, found.objects), (cell.node, count));
        assert_eq!((found.depth, found.bounds), (cell.depth, cell.bounds));
    }
    let [full, empty] = [true, false].map(|full| {
        let filter = Filter {
            full,
            empty: !full,
            ..Filter::default()
        };
        LeafCells::new(String::new(), &tree, &filter, None).cells
    });
    assert!(!full.is_empty() && full.iter().all(|cell| cell.objects > 0));
    assert!(!empty.is_empty() && empty.iter().all(|cell| cell.objects == 0));
    assert_eq!(full.len() + empty.len(), cells.len());
}

#[test]
fn boxes_in_obj_are_those_of_the_leaves() {
    let (_, tree) = tree_of("balls:2", "midpoint");
    let leaves = all(&tree);
    let bytes = written("obj", &leaves);
    let options = tobj::LoadOptions::default();
    let none = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, none).unwrap();
    assert!(models.len() > 100);
    assert_eq!(models.len(), leaves.cells.len());
    for (model, cell) in models.iter().zip(&leaves.cells) {
        let name = format!(
            "leaf-{}-depth-{}-objects-{}",
            cell.node, cell.depth, cell.objects
        );
        assert_eq!(model.name, name);
        let mesh = &model.mesh;
        assert_eq!(mesh.face_arities, [4; 6]);
        let point = |i: u32| {
            let at = 3 * i as usize;
            [0, 1, 2].map(|k| f64::from(mesh.positions[at + k]))
        };
        let used = mesh.indices.iter().map(|&i| point(i));
        let ends = [cell.bounds.lo, cell.bounds.hi].map(|p| p.to_array());
        // This reader holds coordinates in 32 bits.
        assert_eq!(span(used), ends.map(|p| p.map(|x| f64::from(x as f32))));
    }
}

#[test]
fn boxes_in_ply_are_those_of_the_leaves_and_face_outward() {
    let (_, tree) = tree_of("tetra:3", "midpoint");
    let leaves = all(&tree);
    let bytes = written("ply", &leaves);
    let ply = Parser::<DefaultElement>::new()
        .read_ply(&mut &bytes[..])
        .unwrap();
    let vertices: Vec<[f64; 3]> = ply.payload["vertex"]
        .iter()
        .map(|vertex| {
            ["x", "y", "z"].map(|name| match vertex[name] {
                Property::Double(value) => value,
                ref other => panic!("{other:?}"),
            })
        })
        .collect();
    let faces = &ply.payload["face"];
    assert_eq!(vertices.len(), 8 * leaves.cells.len());
    assert_eq!(faces.len(), 6 * leaves.cells.len());
    let number = |face: &DefaultElement, name: &str| match face[name] {
        Property::UInt(value) => value,
        ref other => panic!("{other:?}"),
    };
    for (faces, cell) in faces.chunks(6).zip(&leaves.cells) {
        let mut used = Vec::new();
        let center = cell.bounds.center();
        for face in faces {
            assert_eq!(number(face, "node"), cell.node);
            assert_eq!(number(face, "depth"), cell.depth);
            assert_eq!(number(face, "objects"), cell.objects);
            let Property::ListUInt(indices) = &face["vertex_indices"] else {
                panic!("no list");
            };
            let corners: Vec<glam::DVec3> = indices
                .iter()
                .map(|&i| vertices[i as usize].into())
                .collect();
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            assert!(normal.dot(corners[0] - center) > 0.0);
            used.extend(corners.iter().map(|corner| corner.to_array()));
        }
        let ends = [cell.bounds.lo, cell.bounds.hi].map(|p| p.to_array());
        assert_eq!(span(used), ends);
    }
}

#[test]
fn leaves_are_exported_from_the_command_line() {
    let program = Program::new();
    let output = program.run("leaves balls:1 --only full -o leaves.ply");
    assert!(output.status.success(), "{output:?}");
    let (_, tree) = tree_of("balls:1", "midpoint");
    let full = Filter {
        empty: false,
        ..Filter::default()
    };
    let leaves = LeafCells::new("balls:1, midpoint".into(), &tree, &full, None);
    assert_eq!(
        std::fs::read(program.file("leaves.ply")).unwrap(),
        written("ply", &leaves)
    );
    let output = program.run("leaves balls:1");
    assert_eq!(
        output.stdout,
        written(
            "obj",
            &LeafCells::new("balls:1, midpoint".into(), &tree, &Filter::default(), None)
        )
    );
}

/// The page and the JSON report of the same settings.
fn page_and_json(program: &Program, settings: &str) -> (String, Value) {
    let output = program.run(&format!("report {settings} -o report.html"));
    assert!(output.status.success(), "{output:?}");
    let output = program.run(&format!("measure {settings} --format json"));
    assert!(output.status.success(), "{output:?}");
    (
        program.read("report.html"),
        serde_json::from_slice(&output.stdout).unwrap(),
    )
}

#[test]
fn the_page_has_the_numbers_of_the_json_report() {
    let (text, json) = page_and_json(&Program::new(), "balls:1 --resolution 40x30");
    let page = Element::page(&text);
    let runs = json["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2);
    let mut found: HashMap<String, usize> = HashMap::new();
    let bodies = page.named("tbody").into_iter();
    for row in bodies.flat_map(|body| body.named("tr")) {
        let title = row
            .named("th")
            .iter()
            .flat_map(|th| th.named("code"))
            .next();
        let symbol = title.unwrap().text();
        let values = row.named("data");
        assert_eq!(values.len(), 2, "{symbol}");
        for (value, run) in values.iter().zip(runs) {
            let expected = &run["parameters"][&symbol];
            let attributes = value.attributes();
            let (_, written) = attributes.iter().find(|(name, _)| name == "value").unwrap();
            // Times are of another run; all else is the same.
            if parameter(&symbol).class == Class::T {
                assert_eq!(written == "null", expected.is_null(), "{symbol}");
            } else {
                assert_eq!(*written, expected.to_string(), "{symbol}");
            }
        }
        *found.entry(symbol).or_default() += 1;
    }
    for symbol in parameters().iter().map(|p| p.symbol) {
        let again = DELTA.contains(&symbol) || LAMBDA.contains(&symbol);
        assert_eq!(found[symbol], 1 + usize::from(again), "{symbol}");
    }
    for text_of_the_page in ["Processor", "Cores", "Memory", "System", " UTC", "2/1"] {
        assert!(text.contains(text_of_the_page), "{text_of_the_page}");
    }
    let command = "bspscope measure balls:1 --method sah-cut --resolution 40x30";
    assert!(text.contains(command));
}

#[test]
fn the_page_refers_to_nothing_outside_and_escapes_what_it_is_given() {
    let program = Program::new();
    let name = "<b>&\"scene\".nff";
    let ball = "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 32 32\n\
                b 0 0 0\nl 5 -5 5\nf 1 0 0 1 0 0 0 1\ns 0 0 0 1\n";
    program.write(name, ball);
    let settings = format!("{name} --method midpoint --resolution 20x20");
    let (text, _) = page_and_json(&program, &settings);
    let page = Element::page(&text);
    assert!(!text.contains("<b>") && text.contains("&lt;b&gt;&amp;"));
    let mut pictures = 0;
    let elements = page.elements();
    assert!(elements.len() > 100, "{} elements", elements.len());
    for element in &elements {
        assert!(!["script", "link", "iframe", "object"].contains(&element.name()));
        for (name, value) in element.attributes() {
            assert!(
                !["href", "srcset", "action"].contains(&name.as_str()),
                "{name}"
            );
            if name == "src" {
                let data = value.strip_prefix("data:image/png;base64,").expect("data");
                assert!(data.len() > 100);
                pictures += 1;
            }
        }
    }
    // The picture and two heatmaps.
    assert_eq!(pictures, 3);
    for outside in ["http:", "https:", "url(", "@import", "//"] {
        let style = &text[..text.find("</style>").unwrap()];
        assert!(!style.contains(outside), "{outside}");
    }
}
