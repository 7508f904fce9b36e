//! `bspscope tune`, as a user meets it.

use crate::support::program::Program;
use bspscope::structure::Method;
use serde_json::{Value, json};

/// One round of all methods.
const QUICK: &str = "tune tetra:3 --resolution 24x16 --budget 0";

#[test]
fn the_answer_is_a_setup_with_its_command() {
    let program = Program::new();
    let tune = "tune balls:2 --resolution 24x16 --kernel stream --format json";
    let report = program.json(tune);
    assert_eq!(report["for"], "time");
    assert_eq!(report["resolution"], json!([24, 16]));
    let candidates = report["candidates"].as_array().unwrap();
    for method in Method::all() {
        let is_it = |c: &Value| c["method"] == method.name;
        assert!(candidates.iter().any(is_it), "{}", method.name);
    }
    assert_eq!(candidates[0]["rank"], 1);
    assert_eq!(candidates[0]["recommended"], true);
    for key in ["method", "d_max", "n_oilf", "constants", "command"] {
        assert_eq!(candidates[0][key], report["recommended"][key], "{key}");
    }
    for candidate in candidates {
        let time = &candidate["time"];
        let [least, median, most] = ["least", "median", "most"].map(|key| time[key].as_f64());
        assert!(least <= median && median <= most, "{candidate}");
        assert_eq!(candidate["parameters"]["T_TR"].as_f64(), median);
        assert!(candidate["parameters"]["M_TREE"].as_u64() > Some(0));
        assert!(candidate["nodes"].as_u64() > Some(0));
        let method = Method::named(candidate["method"].as_str().unwrap()).unwrap();
        assert_eq!(candidate["d_max"].is_null(), !method.has_limits);
        let rung = candidate["rung"].as_u64().unwrap();
        let rounds = candidate["seconds"].as_array().unwrap().len();
        assert!(rounds >= 1 << rung.saturating_sub(1), "{candidate}");
        // Who was timed more than once is counted.
        let tests = candidate["tests_per_ray"].as_f64();
        assert!(tests > Some(0.0) || rung == 0, "{candidate}");
    }
    // The command measures what is recommended, with the settings that were given.
    let command = report["recommended"]["command"].as_str().unwrap();
    let command = command.strip_prefix("bspscope ").unwrap();
    // Its words have no spaces.
    let command = command.replace('\'', "");
    let measured = program.json(&format!("{command} --format json"));
    let run = &measured["runs"][0];
    assert_eq!(run["method"], report["recommended"]["method"]);
    assert_eq!(run["settings"]["kernel"]["asked"], "stream");
    assert_eq!(run["parameters"]["N_X"], 24);
    assert_eq!(
        run["parameters"]["M_TREE"],
        candidates[0]["parameters"]["M_TREE"]
    );
}

#[test]
fn what_a_budget_leaves_out_is_stated() {
    let program = Program::new();
    let text = program.done(QUICK);
    for part in [
        "Scene tetra:3. All candidates: 24 × 16 pixels",
        " combinations of settings were not tried: their part of the budget of 0 s was spent.",
        "candidates were left; each of them was timed at least 1 time.",
        "Best for time: ",
        "\nbspscope measure tetra:3 --method ",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let report = program.json(&format!("{QUICK} --format json"));
    assert_eq!(report["left_out"].as_array().map(Vec::len), Some(2));
    assert_eq!(report["budget"], 0.0);
    let candidates = report["candidates"].as_array().unwrap();
    assert_eq!(candidates.len(), Method::all().count());
    for candidate in candidates {
        assert_eq!(candidate["seconds"].as_array().map(Vec::len), Some(1));
    }
    let large = program.done("tune balls:4 --resolution 8x8 --budget 0");
    let left_out = "Method none was left out: the scene has 7\u{a0}382 objects";
    assert!(large.contains(left_out), "{large}");
}

#[test]
fn build_time_counts_if_the_number_of_rays_is_given() {
    let program = Program::new();
    let tune = "tune balls:3 --resolution 24x16 --budget 0 --format json";
    let build = |candidate: &Value| candidate["parameters"]["T_CB"].as_f64().unwrap();
    let candidates = |report: &Value| report["candidates"].as_array().unwrap().clone();
    for rays in [1, 1_000_000_000_000u64] {
        let report = program.json(&format!("{tune} --rays {rays}"));
        assert_eq!(report["rays"], rays);
        let candidates = candidates(&report);
        let totals: Vec<f64> = (candidates.iter())
            .map(|c| c["build_and_rays"]["median"].as_f64().unwrap())
            .collect();
        assert!(totals.is_sorted() && totals.len() > 10, "{totals:?}");
        for (candidate, total) in candidates.iter().zip(totals) {
            assert!(total > build(candidate));
        }
        let reason = report["recommended"]["reason"].as_str().unwrap();
        assert!(reason.contains("Building it once and tracing"), "{reason}");
        // For one ray, no tree pays off that takes long to build.
        if rays == 1 {
            let least = candidates.iter().map(build).fold(f64::INFINITY, f64::min);
            assert!(
                build(&candidates[0]) <= 2.0 * least + 1e-3,
                "{}",
                candidates[0]
            );
        }
    }
    let text = program.done("tune balls:3 --resolution 24x16 --budget 0 --rays 1000000");
    assert!(
        text.contains("build and 1\u{a0}000\u{a0}000 rays"),
        "{text}"
    );
    let report = program.json(tune);
    assert!(report["candidates"][0]["build_and_rays"].is_null());
}

#[test]
fn trees_that_need_too_much_memory_are_left_out() {
    let program = Program::new();
    let tune = "tune balls:3 --resolution 24x16 --budget 0 --format json";
    let bytes = |report: &Value| -> Vec<u64> {
        let candidates = report["candidates"].as_array().unwrap().iter();
        let bytes = candidates.map(|c| c["parameters"]["M_TREE"].as_u64().unwrap());
        bytes.collect()
    };
    let all = bytes(&program.json(tune));
    let limit = 1 << 14;
    let small = all.iter().filter(|bytes| **bytes <= limit).count();
    assert!(0 < small && small < all.len(), "{all:?}");
    let report = program.json(&format!("{tune} --max-memory 0.015625"));
    assert_eq!(report["most_bytes"], limit);
    let found = bytes(&report);
    assert_eq!(found.len(), small);
    assert!(found.iter().all(|bytes| *bytes <= limit), "{found:?}");
    let left_out = report["left_out"].to_string();
    assert!(left_out.contains("more memory than"), "{left_out}");
    let error = program.refused_in_a_line("tune balls:4 --resolution 8x8 --max-memory 0.00001");
    assert!(
        error.contains("no tree is small enough: the smallest needs "),
        "{error}"
    );
    let error = program.refused("tune balls:3 --max-memory 0");
    assert!(error.contains("a number of MiB"), "{error}");
}

#[test]
fn every_form_has_a_line_per_candidate() {
    let program = Program::new();
    program.done(&format!("{QUICK} --for memory -o trees.csv"));
    let mut reader = csv::Reader::from_path(program.file("trees.csv")).unwrap();
    let titles = reader.headers().unwrap().clone();
    assert_eq!(
        titles.iter().collect::<Vec<_>>(),
        [
            "scene",
            "rank",
            "tied",
            "recommended",
            "method",
            "d_max",
            "depth_limit",
            "n_oilf",
            "rounds",
            "T_TR",
            "T_TR_least",
            "T_TR_most",
            "tests_per_ray",
            "nodes",
            "T_CB",
            "M_TREE",
            "T_BUILD_AND_RAYS",
            "constants",
        ]
    );
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), Method::all().count());
    let bytes: Vec<u64> = rows.iter().map(|row| row[15].parse().unwrap()).collect();
    assert!(bytes.is_sorted(), "{bytes:?}");
    assert_eq!(&rows[0][4], "none");
    let recommended: Vec<_> = rows.iter().filter(|row| &row[3] == "true").collect();
    assert_eq!(recommended.len(), 1);
    for (form, part) in [
        ("markdown", "## Trees by memory"),
        ("latex", "\\begin{tabular}"),
        ("text", "Best for memory: "),
    ] {
        let text = program.done(&format!("{QUICK} --for memory --format {form}"));
        assert!(text.contains(part), "{form}: {text}");
        for method in Method::all() {
            assert!(text.contains(method.name), "{form}: {text}");
        }
    }
}

#[test]
fn wrong_goals_budgets_and_settings_are_refused() {
    let program = Program::new();
    for (option, part) in [
        ("--for beauty", "[possible values: time, memory]"),
        ("--budget -1", "a number of seconds"),
        ("--budget soon", "a number of seconds"),
        ("--method sah", "--method"),
        ("--set gap-fraction=0.1", "--set"),
    ] {
        let errors = program.refused(&format!("tune tetra:3 {option}"));
        assert!(errors.contains(part), "{option}: {errors}");
    }
    let errors = program.refused_in_a_line("tune tetra:3 --resolution 0x16");
    assert!(errors.contains("at least 1 pixel"), "{errors}");
}
