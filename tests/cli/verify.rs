//! `bspscope verify`.

use super::commands::coincident_triangles;
use crate::support::program::Program;
use bspscope::structure::Method;

#[test]
fn verify_checks_every_kind_of_ray() {
    let program = Program::new();
    let text = program.done("verify teaching --rays 1000");
    for method in Method::all().filter(|m| m.name != "none") {
        for kind in ["primary", "shadow", "reflected", "refracted"] {
            let row = text
                .lines()
                .map(|l| l.split_whitespace().collect::<Vec<_>>());
            let expected = [
                "teaching:1",
                method.name,
                "f64",
                "valid",
                kind,
                "1000",
                "0",
                "0",
            ];
            assert!(
                row.into_iter().any(|row| row == expected),
                "{expected:?}\n{text}"
            );
        }
    }
    let text = program.done("verify teaching --rays 1000 --method midpoint --precision f32");
    assert_eq!(text.matches("  f32  ").count(), 4, "{text}");
    let text = program.done("verify balls:1 tetra:2 --rays 100 --method sah-cut");
    assert!(text.contains("All 2 trees"), "{text}");
}

#[test]
fn verify_exact_compares_every_structure_and_kernel_with_exact_arithmetic() {
    let program = Program::new();
    let text = program.done("verify teaching --exact 100 --method midpoint --method grid");
    for structure in ["every object", "midpoint", "grid"] {
        let rows = text.lines().filter(|line| line.contains(structure));
        let rows: Vec<_> = rows
            .filter(|line| line.starts_with(" teaching:1"))
            .collect();
        assert_eq!(rows.len(), 2, "{structure}: {text}");
    }
    for words in [
        "scalar",
        "counting",
        "stream, portable",
        "100 rays in each precision",
        "tangent",
        "All answers are exactly right, of testing every object and of every structure.",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert_eq!(program.files(), [""; 0]);
}

#[test]
fn a_tree_that_is_too_large_is_no_pass_and_does_not_hide_the_others() {
    let program = Program::new();
    program.write("pile.obj", &coincident_triangles(3000));
    for rays in ["--rays 20", "--exact 20"] {
        let command = format!("verify pile.obj {rays} --method midpoint --method sah-cut");
        let output = program.run(&format!("{command} --memory-limit 16"));
        let text = String::from_utf8(output.stdout).unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{text}{errors}");
        assert!(
            errors.contains("midpoint: not measured: the tree exceeds the memory limit"),
            "{errors}"
        );
        assert!(text.contains("sah-cut"), "{text}");
    }
}
