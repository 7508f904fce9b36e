//! `bspscope render --show` and `bspscope probe`, as a user meets them.

use crate::support::program::Program;
use bspscope::measure::heat::heatmaps;
use exr::prelude::read_first_flat_layer_from_file;
use image::GenericImageView;
use std::path::Path;

/// Runs what must be refused, without a trace; returns standard error.
fn refused(program: &Program, arguments: &str) -> String {
    let errors = program.refused(arguments);
    assert_eq!(program.files(), [""; 0], "{arguments}");
    errors
}

const QUICK: &str = "--resolution 40x30";

/// The one channel of an OpenEXR file: its name and its values.
fn channel(path: &Path) -> (String, Vec<f32>) {
    let image = read_first_flat_layer_from_file(path).unwrap();
    let channels = &image.layer_data.channel_data.list;
    assert_eq!(channels.len(), 1);
    let values = channels[0].sample_data.values_as_f32().collect();
    (channels[0].name.to_string(), values)
}

#[test]
fn every_heatmap_is_written_with_its_legend() {
    let program = Program::new();
    for heatmap in heatmaps() {
        let symbol = heatmap.symbol;
        program.done(&format!(
            "render teaching {QUICK} --show {symbol} -o {symbol}.png"
        ));
        let (width, height) = image::open(program.file(&format!("{symbol}.png")))
            .unwrap()
            .dimensions();
        assert!(
            width > 40 && height > 30 + 100,
            "{symbol}: {width} × {height}"
        );
    }
}

#[test]
fn options_change_the_heatmaps_picture() {
    let program = Program::new();
    let mut pictures: Vec<Vec<u8>> = Vec::new();
    for options in [
        "",
        "--rays shadow",
        "--scale log",
        "--range 0:500",
        "--colors magma",
        "--blend 0.5",
        "--method sah-cut",
    ] {
        program.done(&format!(
            "render teaching {QUICK} --show n_it {options} -o a.png"
        ));
        let picture = std::fs::read(program.file("a.png")).unwrap();
        assert!(!pictures.contains(&picture), "{options}");
        pictures.push(picture);
    }
}

#[test]
fn raw_values_sum_to_what_measure_prints() {
    let program = Program::new();
    let report = program.json(&format!(
        "measure teaching {QUICK} --method sah-cut --format json"
    ));
    let parameters = &report["runs"][0]["parameters"];
    for (symbol, rays, parameter) in [
        ("N_NODES", "all", "N_NODES"),
        ("N_VELS", "all", "N_VELS"),
        ("N_IT", "shadow", "N_SRIT"),
        ("N_IT", "secondary", "N_SECRIT"),
        ("N_RAYS", "primary", "N_PR"),
    ] {
        program.done(&format!(
            "render teaching {QUICK} --method sah-cut --show {symbol} --rays {rays} -o a.exr"
        ));
        let (name, values) = channel(&program.file("a.exr"));
        assert_eq!(name, symbol);
        assert_eq!(values.len(), 40 * 30);
        let sum: f64 = values.iter().map(|&v| f64::from(v)).sum();
        assert!(sum > 0.0);
        assert_eq!(Some(sum), parameters[parameter].as_f64(), "{symbol} {rays}");
    }
    program.done(&format!("render teaching {QUICK} --show N_RPRT -o a.exr"));
    let (_, values) = channel(&program.file("a.exr"));
    assert!(values.iter().any(|v| v.is_nan()), "pixels that hit nothing");
    assert!(values.iter().all(|v| v.is_nan() || *v >= 1.0));
}

#[test]
fn a_probe_tells_what_the_heatmap_says_of_the_pixel() {
    let program = Program::new();
    for (x, y) in [(20, 15), (0, 0), (39, 29), (13, 18)] {
        let record = program.json(&format!(
            "probe teaching {QUICK} --pixel {x},{y} --format json"
        ));
        assert_eq!(record["pixel"], serde_json::json!([x, y]));
        let methods = record["methods"].as_array().unwrap();
        assert_eq!(methods.len(), 2, "both of the paper's");
        for method in methods {
            let name = method["method"].as_str().unwrap();
            let sum = |field: &str| -> u64 {
                let rays = method["rays"].as_array().unwrap();
                rays.iter()
                    .map(|r| r["counts"][field].as_u64().unwrap())
                    .sum()
            };
            for (symbol, expected) in [
                ("N_IT", sum("tests")),
                ("N_NODES", sum("inner_nodes") + sum("leaves")),
            ] {
                program.done(&format!(
                    "render teaching {QUICK} --method {name} --show {symbol} -o a.exr"
                ));
                let (_, values) = channel(&program.file("a.exr"));
                assert_eq!(values[y * 40 + x], expected as f32, "{name}, {symbol}");
            }
            assert_eq!(method["total"]["tests"], sum("tests"));
            let kinds = method["kinds"].as_object().unwrap();
            let of_kinds: u64 = kinds.values().map(|k| k["tests"].as_u64().unwrap()).sum();
            assert_eq!(of_kinds, sum("tests"));
            for ray in method["rays"].as_array().unwrap() {
                let steps = ray["steps"].as_array().unwrap();
                let leaves = steps.iter().filter(|s| s["step"] == "leaf");
                assert_eq!(ray["counts"]["leaves"], leaves.clone().count());
                assert_eq!(
                    ray["counts"]["inner_nodes"],
                    steps.len() - leaves.clone().count()
                );
                for leaf in leaves {
                    assert!(leaf["bounds"]["lo"].is_array() && leaf["after"].is_string());
                }
            }
        }
    }
}

#[test]
fn a_probes_outline_names_rays_nodes_tests_and_reasons() {
    let program = Program::new();
    // The mirror below the glass: primary, shadow and reflected rays.
    let arguments = format!("probe teaching {QUICK} --method midpoint --pixel 20,15");
    let text = program.done(&arguments);
    let record = program.json(&format!("{arguments} --format json"));
    let rays = record["methods"][0]["rays"].as_array().unwrap();
    let lines = |part: &str| {
        text.lines()
            .filter(|l| l.trim_start().starts_with(part))
            .count()
    };
    assert_eq!(lines("Ray "), rays.len());
    let total = &record["methods"][0]["total"];
    assert_eq!(Some(lines("node ") as u64), total["inner_nodes"].as_u64());
    assert_eq!(Some(lines("leaf ") as u64), total["leaves"].as_u64());
    assert_eq!(Some(lines("test ") as u64), total["tests"].as_u64());
    for part in [
        "Pixel 20,15 of 40 × 30",
        "scene units",
        "Ray 0, primary: from",
        "plane ",
        ": done",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    program.done(&format!("{arguments} -o pixel.txt"));
    let written = std::fs::read_to_string(program.file("pixel.txt")).unwrap();
    assert_eq!(written, text);
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let program = Program::new();
    for pixel in ["40,0", "0,30", "-1,0", "0,-1"] {
        let errors = refused(&program, &format!("probe teaching {QUICK} --pixel {pixel}"));
        assert!(
            errors.contains("columns 0 to 39 and rows 0 to 29"),
            "{errors}"
        );
    }
    let errors = refused(
        &program,
        &format!("render teaching {QUICK} --show N_NODE -o a.png"),
    );
    for heatmap in heatmaps() {
        assert!(errors.contains(heatmap.symbol), "{errors}");
    }
    for (arguments, part) in [
        ("probe teaching", "--pixel"),
        ("probe teaching --pixel 7", "a column and a row"),
        ("probe teaching --resolution 0x9 --pixel 0,0", "0x9"),
        ("render teaching --rays shadow -o a.png", "--show"),
        ("render teaching --colors magma -o a.png", "--show"),
        (
            "render teaching --show N_IT --rays green -o a.png",
            "secondary",
        ),
        ("render teaching --show N_IT --range 5:5 -o a.png", "0:200"),
        (
            "render teaching --show N_IT --blend 2 -o a.png",
            "from 0 to 1",
        ),
        (
            "render teaching --show N_IT --colors turbo -o a.png",
            "viridis",
        ),
        (
            "render teaching --show D_COMPX --rays shadow -o a.png",
            "--rays shadow",
        ),
        (
            "render teaching --show N_IT --blend 0.5 -o a.exr",
            "--blend",
        ),
        (
            "render teaching --show N_IT --scale log -o a.exr",
            "--scale",
        ),
    ] {
        let errors = refused(&program, arguments);
        assert!(errors.contains(part), "{arguments}: {errors}");
    }
}
