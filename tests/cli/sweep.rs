//! `bspscope sweep`, `merge` and `model`, as a user meets them.

use crate::support::program::Program;
use bspscope::measure::{Class, parameters};

/// The cells of a file of rows, those that depend on the machine left empty.
pub fn counts(program: &Program, name: &str) -> Vec<Vec<String>> {
    let times: Vec<_> = parameters()
        .iter()
        .filter(|p| p.class == Class::T)
        .map(|p| p.symbol)
        .collect();
    assert!(times.len() > 3);
    let mut reader = csv::Reader::from_path(program.file(name)).unwrap();
    let titles = reader.headers().unwrap().clone();
    let cell = |(title, cell): (&str, &str)| {
        let is_time = times.contains(&title);
        if is_time { String::new() } else { cell.into() }
    };
    reader
        .records()
        .map(|row| titles.iter().zip(&row.unwrap()).map(cell).collect())
        .collect()
}

const GRID: &str = "balls:2 --d-max 3..5,auto --n-oilf 1,2 --resolution 16x12";

#[test]
fn a_sweep_that_was_broken_off_resumes_to_the_same_file_but_for_times() {
    let program = Program::new();
    let text = program.ends(0, &format!("sweep {GRID} -o whole.csv"));
    assert!(text.contains("midpoint: least T_TR at D_MAX"), "{text}");
    assert!(text.contains("sah-cut: least T_TR at D_MAX"), "{text}");
    let whole = program.read("whole.csv");
    assert_eq!(whole.lines().count(), 1 + 2 * 2 * 4);
    // Broken off in the midst of the sixth row, of the first one, and of the titles.
    let ends: Vec<usize> = whole.match_indices('\n').map(|(i, _)| i + 1).collect();
    for length in [ends[5] + 30, ends[0] + 3, 10, ends[16]] {
        std::fs::write(program.file("part.csv"), &whole[..length]).unwrap();
        program.ends(0, &format!("sweep {GRID} -o part.csv"));
        assert_eq!(counts(&program, "part.csv"), counts(&program, "whole.csv"));
        // Rows that were whole are as they were, with their times.
        let kept = ends.iter().rev().find(|end| **end <= length).unwrap_or(&0);
        assert_eq!(program.read("part.csv")[..*kept], whole[..*kept]);
    }
    let error = program.ends(2, &format!("sweep {GRID} --d-arec 1 -o whole.csv"));
    assert!(error.contains("another sweep"), "{error}");
    assert_eq!(program.read("whole.csv"), whole);
}

#[test]
fn shards_merge_to_the_whole_and_missing_points_are_told() {
    let program = Program::new();
    program.ends(0, &format!("sweep {GRID} -o whole.csv"));
    for i in 1..=3 {
        program.ends(0, &format!("sweep {GRID} --shard {i}/3 -o part-{i}.jsonl"));
    }
    program.ends(
        0,
        "merge part-3.jsonl part-1.jsonl part-2.jsonl -o merged.csv",
    );
    assert_eq!(
        counts(&program, "merged.csv"),
        counts(&program, "whole.csv")
    );
    let text = program.ends(1, "merge part-1.jsonl part-3.jsonl -o two.csv");
    assert!(
        text.contains("missing points (counted from 0): 1 4 7 10 13"),
        "{text}"
    );
    program.ends(
        0,
        "sweep tetra:2 --d-max 3 --n-oilf 1 --resolution 8x8 -o other.csv",
    );
    let text = program.ends(2, "merge whole.csv other.csv -o wrong.csv");
    assert!(text.contains("of another sweep"), "{text}");
    assert!(!program.file("wrong.csv").exists());
}

#[test]
fn times_of_two_processors_are_merged_and_not_compared() {
    let program = Program::new();
    let options = format!("sweep {GRID} --method midpoint");
    for i in 1..=2 {
        program.ends(0, &format!("{options} --shard {i}/2 -o part-{i}.jsonl"));
    }
    let part = program.read("part-2.jsonl");
    let row: serde_json::Value = serde_json::from_str(part.lines().next().unwrap()).unwrap();
    assert_eq!(row["kernel"], "scalar");
    assert_eq!(row["instruction_set"], std::env::consts::ARCH);
    assert_eq!(row["version"], env!("CARGO_PKG_VERSION"));
    let processor = row["processor"].as_str().unwrap();
    let other = part.replace(processor, "Another Processor");
    assert_ne!(part, other);
    program.write("part-2.jsonl", &other);
    let merge = "merge part-1.jsonl part-2.jsonl";
    let text = program.ends(0, &format!("{merge} -o merged.csv"));
    let why = "T_TR is not compared: it is a time, and the rows are from different processors";
    assert!(text.starts_with(why), "{text}");
    assert!(text.contains("4 rows from Another Processor"), "{text}");
    assert!(!text.contains("least"), "{text}");
    assert_eq!(counts(&program, "merged.csv").len(), 8);
    let text = program.ends(2, &format!("{merge} -o refused.csv --chart chart.svg"));
    assert!(text.contains(why), "{text}");
    assert!(!program.file("refused.csv").exists() && !program.file("chart.svg").exists());
    let counted = program.ends(
        0,
        &format!("{merge} -o merged.csv --show N_AT --chart chart.svg"),
    );
    assert!(counted.contains("midpoint: least N_AT at"), "{counted}");
    // A sweep that is resumed on another machine does not compare its times, either.
    let rows: Vec<_> = other.split_inclusive('\n').collect();
    program.write("part-2.jsonl", &rows[..2].concat());
    let resumed = program.ends(0, &format!("{options} --shard 2/2 -o part-2.jsonl"));
    assert!(resumed.starts_with(why), "{resumed}");
}

#[test]
fn charts_are_pictures_with_a_curve_for_every_method_and_leaf_size() {
    let program = Program::new();
    program.ends(
        0,
        &format!("sweep {GRID} -o a.csv --show N_AT --chart a.svg --chart a.png"),
    );
    let svg = program.read("a.svg");
    for words in [
        "midpoint, N_OILF 1",
        "sah-cut, N_OILF 2",
        "D_MAX",
        "nodes per ray",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    let png = image::open(program.file("a.png")).unwrap().to_rgb8();
    assert_eq!(png.dimensions(), (960, 600));
    let colors: std::collections::BTreeSet<_> = png.pixels().map(|p| p.0).collect();
    assert!(colors.contains(&[0, 114, 178]) && colors.contains(&[213, 94, 0]));
    let error = program.ends(2, &format!("sweep {GRID} -o a.csv --chart a.gif"));
    assert!(error.contains(".png or .svg"), "{error}");
    let error = program.ends(2, &format!("sweep {GRID} -o a.txt"));
    assert!(error.contains(".csv or .jsonl"), "{error}");
}

#[test]
fn a_model_tells_times_by_both_ways() {
    let program = Program::new();
    let options = "model teaching --resolution 24x24 --rounds 1";
    let text = program.ends(0, &format!("{options} --format json"));
    let models: serde_json::Value = serde_json::from_str(&text).unwrap();
    let model = &models[0];
    let terms = model["seconds"].as_array().unwrap();
    let named = |name: &str| terms.iter().find(|t| t["term"] == name).unwrap();
    assert!(named("T_T + T_P")["in_place"].as_f64() > Some(0.0));
    for kind in ["sphere", "triangle", "polygon", "cone"] {
        let time = named(&format!("T_IUN {kind}"))["in_place"].as_f64();
        assert!(time > Some(0.0), "{kind}");
    }
    let is_time = |t: &serde_json::Value| t["regression"].as_f64().is_none_or(|s| s >= 0.0);
    assert!(terms.iter().all(is_time));
    assert_eq!(model["left_out"]["trees"], 8);
    let fastest = &model["fastest"];
    let parts = fastest["parts"].as_array().unwrap().iter();
    let sum: f64 = parts.map(|part| part["seconds"].as_f64().unwrap()).sum();
    let predicted = fastest["predicted"].as_f64().unwrap();
    assert!(predicted > 0.0 && (sum / predicted - 1.0).abs() < 1e-9);
    let notes = model["notes"].to_string();
    assert!(notes.contains("only occur as a sum"), "{notes}");
    let text = program.ends(0, &format!("{options} --equation printed"));
    assert!(text.contains("equation (1) as printed"), "{text}");
}

#[test]
fn rows_of_other_settings_are_not_mixed() {
    let program = Program::new();
    let options = "sweep tetra:3 --d-max 4..8 --n-oilf 1 --resolution 8x8 -o rows.csv";
    program.ends(0, options);
    let rows = program.read("rows.csv");
    for (other, why) in [
        ("--kernel stream", "kernel: scalar vs stream"),
        ("--threads 3", "threads: 0 vs 3"),
        ("--cut-off 0.1", "min-contribution: 0 vs 0.1"),
        ("--angle 20", "angle: scene vs 20"),
    ] {
        let error = program.ends(2, &format!("{options} {other}"));
        assert!(
            error.contains(why) && error.contains("not mixed"),
            "{error}"
        );
        assert_eq!(program.read("rows.csv"), rows);
    }
}

#[test]
fn any_setting_is_an_axis() {
    let program = Program::new();
    let axes = "--vary precision=f32,f64 --vary root-margin=0,0.001 --d-max 3,auto";
    let options = "--method midpoint --resolution 8x8 -o rows.csv --chart rows.svg";
    program.ends(0, &format!("sweep tetra:2 {axes} {options}"));
    let rows = counts(&program, "rows.csv");
    assert_eq!(rows.len(), 8);
    assert_eq!(rows[0][2], "method precision root-margin d-max");
    assert!(rows[0][8].contains("precision=f32") && rows[7][8].contains("precision=f64"));
    assert!(
        program
            .read("rows.svg")
            .contains("precision f64, root-margin 0.001")
    );
    for (wrong, why) in [
        ("--vary colour=1,2", "no setting 'colour'"),
        ("--vary precision=f16", "expected one of f32, f64, auto"),
        ("--vary d-max=3 --d-max 4", "varied twice"),
        (
            "--vary gap-fraction=0.1 --method midpoint",
            "no chosen method",
        ),
    ] {
        let error = program.ends(2, &format!("sweep tetra:2 {wrong} -o other.csv"));
        assert!(error.contains(why), "{error}");
    }
}
