//! `bspscope study`, as a user meets it.

use crate::support::program::Program;
use std::collections::BTreeSet;

const QUICK: &str = "--rays 16 --rounds 1";

#[test]
fn the_study_is_written_in_every_form() {
    let program = Program::new();
    program.done(&format!(
        "study measures tetra:2 balls:1 {QUICK} -o measures.csv"
    ));
    let mut reader = csv::Reader::from_path(program.file("measures.csv")).unwrap();
    let rows: Vec<_> = reader.records().map(|row| row.unwrap()).collect();
    let cells = |place: usize| -> BTreeSet<String> {
        rows.iter().map(|row| row[place].to_owned()).collect()
    };
    assert_eq!(
        cells(0),
        BTreeSet::from(["balls:1", "tetra:2"].map(String::from))
    );
    assert_eq!(
        cells(3),
        BTreeSet::from(["packets", "scalar", "stream"].map(String::from))
    );
    assert!(cells(5).contains("reflected") && cells(5).contains("random"));
    assert!(cells(2).contains(std::env::consts::ARCH));
    assert_eq!(
        cells(4),
        BTreeSet::from([env!("CARGO_PKG_VERSION").to_owned()])
    );
    assert!(cells(6).contains("equation (1)") && cells(6).contains("C_SAH + EPO"));

    let json = program.json(&format!("study measures tetra:2 {QUICK} --format json"));
    let scene = &json["scenes"][0];
    assert_eq!(scene["scene"], "tetra:2");
    assert!(
        json["processor"]
            .as_str()
            .is_some_and(|name| !name.is_empty())
    );
    assert!(scene["left_out"]["same"].as_u64() > Some(0));
    let structure = &scene["structures"][0];
    assert_eq!(structure["method"], "midpoint");
    let set = &structure["sets"][0];
    assert!(set["measures"]["N_AT"].as_f64() > Some(0.0));
    assert_eq!(set["seconds"]["scalar"].as_array().map(Vec::len), Some(1));

    let text = program.done(&format!("study measures tetra:2 {QUICK}"));
    assert!(text.contains("tetra:2, kernel stream: how well each measure predicts time"));
    assert!(
        text.contains("Equation (1)") || text.contains("equation (1)"),
        "{text}"
    );
}

#[test]
fn the_document_has_a_figure_per_scene_and_the_command() {
    let program = Program::new();
    std::fs::create_dir(program.file("docs")).unwrap();
    let command =
        "study measures tetra:2 balls:1 --rays 16 --rounds 1 -o docs/which.md --figures docs/which";
    program.done(command);
    let document = program.read("docs/which.md");
    for part in [
        "# Which measure predicts time?",
        "## The answer",
        "## tetra:2",
        "![R² of each measure in tetra:2](which/tetra-2.svg)",
        "On quality metrics of bounding volume hierarchies",
        &format!("bspscope {command}"),
    ] {
        assert!(document.contains(part), "{part}: {document}");
    }
    let figure = program.read("docs/which/balls-1.svg");
    for words in ["reflected rays", "C_SAH + EPO", "equation (1)", "packets"] {
        assert!(figure.contains(words), "{words}");
    }
    let error = program.refused_in_a_line("study measures nowhere");
    assert!(error.contains("neither a file nor a generator"), "{error}");
}
