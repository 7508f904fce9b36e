//! The command line as a user meets it: exit codes, outputs, files, and what goes to which stream.

use crate::support::program::Program;
use bspscope::measure::{DELTA, LAMBDA, Unit, parameters};
use bspscope::structure::Method;
use serde_json::Value;
use std::io::Read;
use std::process::Stdio;

/// A small measurement; 16 × 16 pixels are enough for every parameter.
const QUICK: &str = "--resolution 16x16";

/// A view into which no object reaches.
const EMPTY_VIEW: &str = "v\nfrom 0 0 0\nat 0 1 0\nup 0 0 1\nangle 45\nhither 1\n\
    resolution 16 16\nb 0 0 0\nl 5 5 5\nf 1 1 1 1 0 0 0 0\ns 0 -10 0 1\n";

/// Parameters without a value for trees with planes.
const FOR_HIERARCHIES: [&str; 3] = ["V_LEAF/V_ROOT", "F_W", "N_CULL"];

#[test]
fn wrong_use_is_told_with_exit_code_2() {
    let program = Program::new();
    for arguments in [
        "--nonsense",
        "measure",
        "measure balls:1 --method nonsense",
        "measure balls:1 --overlap nonsense",
        "measure balls:1 --resolution 16",
        "measure balls:1 --set gap-fraction",
        "measure balls:1 --cylinders polygons:2",
        "render teaching",
        "render teaching --samples 0 -o a.png",
        "verify teaching --rays 0",
        "verify teaching --exact 0",
        "verify teaching --exact 10 --rays 10",
    ] {
        let output = program.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert_eq!(output.stdout, b"", "{arguments}");
        assert!(!output.stderr.is_empty(), "{arguments}");
    }
    for (arguments, part) in [
        ("measure balls:1 --resolution 0x16", "at least 1 pixel"),
        ("measure balls:1 --root-margin -1", "a number of at least 0"),
        ("measure balls:1 --set gap-fraction=2", "gap-fraction is 2"),
        (
            "measure balls:1 --method midpoint --set gap-fraction=0.5",
            "--set gap-fraction",
        ),
        ("measure balls:99", "the size of balls must be from 0 to"),
        (
            "measure tetra:5 --memory-limit 0",
            "--memory-limit: expected an integer from 1",
        ),
        ("render teaching -o picture.jpg", ".png or .exr"),
        ("render teaching --resolution 16x16 -o no/a.png", "no/a.png"),
        ("measure balls:1 --resolution 16x16 -o no/a.txt", "no/a.txt"),
        ("generate balls:1 -o .", ".: this is a folder"),
    ] {
        let errors = program.refused_in_a_line(arguments);
        assert!(errors.contains(part), "{arguments}: {errors}");
    }
    assert_eq!(program.files(), [""; 0]);
}

#[test]
fn wrong_scenes_are_told_with_their_file_and_line() {
    let program = Program::new();
    let missing = program.refused_in_a_line("measure folder/missing.nff");
    assert!(missing.contains("folder/missing.nff: "), "{missing}");

    let unknown = program.refused_in_a_line("measure bals");
    for builtin in bspscope::scene::builtin::BUILTINS {
        assert!(unknown.contains(builtin.name), "{unknown}");
    }

    program.write("bad.nff", &EMPTY_VIEW.replace("s 0 -10 0 1", "s 0 -10 0"));
    for command in ["measure", "render -o a.png", "generate", "verify"] {
        let errors = program.refused_in_a_line(&format!("{command} bad.nff"));
        assert!(errors.contains("bad.nff:11: expected "), "{errors}");
    }
}

#[test]
fn json_has_every_symbol_and_sets_delta_and_lambda_apart() {
    let report = Program::new().json(&format!("measure teaching {QUICK} --format json"));
    let runs = report["runs"].as_array().unwrap();
    let methods: Vec<_> = runs
        .iter()
        .map(|run| run["method"].as_str().unwrap())
        .collect();
    let papers: Vec<_> = Method::of_the_paper().iter().map(|m| m.name).collect();
    assert_eq!(methods, papers);
    for run in runs {
        let keys = |part: &str| -> Vec<String> {
            run[part].as_object().unwrap().keys().cloned().collect()
        };
        let symbols: Vec<_> = parameters().iter().map(|p| p.symbol).collect();
        assert_eq!(keys("parameters"), symbols);
        assert_eq!(keys("delta"), DELTA);
        assert_eq!(keys("lambda"), LAMBDA);
        for parameter in parameters() {
            let value = &run["parameters"][parameter.symbol];
            if FOR_HIERARCHIES.contains(&parameter.symbol) {
                assert!(value.is_null(), "{}: {value}", parameter.symbol);
                continue;
            }
            assert!(value.is_number(), "{}: {value}", parameter.symbol);
            let is_mean = ["B_RAY", "M_TREE/N_O"].contains(&parameter.symbol);
            let whole = matches!(parameter.unit, Unit::Count | Unit::Bytes);
            assert!(
                is_mean || value.is_u64() == whole,
                "{}: {value}",
                parameter.symbol
            );
        }
        for symbol in DELTA {
            assert_eq!(run["delta"][symbol], run["parameters"][symbol]);
        }
        for symbol in LAMBDA {
            assert_eq!(run["lambda"][symbol], run["parameters"][symbol]);
        }
        let share = run["parameters"]["S_COV"].as_f64().unwrap();
        assert!((0.0..=1.0).contains(&share), "a fraction: {share}");
    }
    let scene = report["scene"].as_object().unwrap();
    let keys: Vec<_> = scene.keys().collect();
    assert_eq!(
        keys,
        [
            "name",
            "source",
            "cylinders",
            "bounds",
            "objects",
            "lights",
            "primitives",
            "requirements",
            "left_out",
            "notes",
            "camera"
        ]
    );
    let kinds: u64 = scene["primitives"]
        .as_object()
        .unwrap()
        .values()
        .map(|count| count.as_u64().unwrap())
        .sum();
    assert_eq!(Some(kinds), scene["objects"].as_u64());
}

#[test]
fn options_arrive_in_the_measurement() {
    let program = Program::new();
    let report = program.json(
        "measure rings:1 --method sah-cut --method object-median --method sah-cut \
         --d-max 7 --n-oilf 3 --d-arec 1 --resolution 24x16 --sampling corner \
         --cylinders polygons:5 --overlap exact --root-margin 0.5 --first-axis z \
         --set gap-fraction=0.5 --set longest-axis=1 --threads 1 --format json",
    );
    assert_eq!(report["scene"]["cylinders"], "polygons:5");
    assert_eq!(report["scene"]["primitives"]["cone"], Value::Null);
    let runs = report["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 3);
    for run in runs {
        let settings = &run["settings"];
        assert_eq!(settings["root_margin"], 0.5);
        assert_eq!(settings["overlap"], "exact");
        assert_eq!(settings["first_axis"], "z");
        assert_eq!(settings["sampling"], "corner");
        assert_eq!(settings["threads"], 1);
        let parameters = &run["parameters"];
        for (symbol, value) in [
            ("D_MAX", 7),
            ("N_OILF", 3),
            ("D_AREC", 1),
            ("N_X", 24),
            ("N_Y", 16),
            ("N_PR", 24 * 16),
        ] {
            assert_eq!(parameters[symbol], value, "{symbol}");
        }
    }
    assert_eq!(runs[0]["settings"]["constants"]["gap-fraction"], 0.5);
    assert_eq!(runs[1]["settings"]["constants"]["longest-axis"], 1.0);
    assert_eq!(
        runs[1]["settings"]["constants"]["gap-fraction"],
        Value::Null
    );

    let report = program.json(&format!(
        "measure balls:1 --d-max auto {QUICK} --format json"
    ));
    // 11 objects: 1.2 · log₂ 11 + 2 = 6.15
    assert_eq!(report["runs"][0]["settings"]["d_max"], "auto");
    assert_eq!(report["runs"][0]["parameters"]["D_MAX"], 6);
}

#[test]
fn the_load_report_is_told_on_standard_error_and_in_the_report() {
    let program = Program::new();
    program.write(
        "square.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 1 2\n",
    );
    let measure = format!("measure square.obj {QUICK} --method midpoint");
    let output = program.run(&measure);
    assert_eq!(output.status.code(), Some(0));
    let [text, errors] = [output.stdout, output.stderr].map(|s| String::from_utf8(s).unwrap());
    for line in [
        "Skipped: polygon with zero area, at line 6",
        "Default: no camera in the file; using one that frames all objects",
    ] {
        assert!(text.lines().any(|l| l.contains(line)), "{text}");
        let told = format!("bspscope: square.obj: {line}");
        assert!(errors.lines().any(|l| l == told), "{errors}");
    }
    assert!(text.contains("Read: polygons: 1"), "{text}");
    assert!(!errors.contains("Read:"), "{errors}");
    let json = program.run(&format!("{measure} --format json"));
    let report: Value = serde_json::from_slice(&json.stdout).unwrap();
    let notes = report["scene"]["notes"].as_array().unwrap();
    assert!(notes.iter().any(|note| note["kind"] == "defaulted"));
    // Converted, it is complete: nothing is made up any more.
    program.run("generate square.obj -o square.nff");
    let text = program.done(&measure.replace(".obj", ".nff"));
    assert!(text.contains("polygons: 1"), "{text}");
    let refused = program.refused_in_a_line("generate balls:1 -o balls.obj");
    assert!(
        refused.contains("OBJ files cannot represent every scene"),
        "{refused}"
    );
}

/// An OBJ file with this many triangles in one place.
pub fn coincident_triangles(count: usize) -> String {
    "v 0 0 0\nv 2 0 1\nv 0 1 1.5\n".to_owned() + &"f 1 2 3\n".repeat(count)
}

#[test]
fn a_tree_that_is_too_large_does_not_hide_the_others() {
    let program = Program::new();
    program.write("pile.obj", &coincident_triangles(3000));
    let options = format!("{QUICK} --memory-limit 16");
    let output = program.run(&format!("measure pile.obj {options} --format json"));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{errors}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let methods = |key: &str| -> Vec<String> {
        let entries = report[key].as_array().unwrap().iter();
        entries
            .map(|one| one["method"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(methods("runs"), ["sah-cut"]);
    assert_eq!(methods("failures"), ["midpoint"]);
    let reason = report["failures"][0]["reason"].as_str().unwrap();
    assert!(reason.contains("3000 objects lie in one place"), "{reason}");
    assert!(
        errors.contains(&format!("bspscope: midpoint: not measured: {reason}")),
        "{errors}"
    );
    let text = program.ends(0, &format!("measure pile.obj {options}"));
    assert!(
        text.contains(&format!("midpoint: not measured: {reason}")),
        "{text}"
    );

    // Nothing can be measured.
    let both = "--method midpoint --method octree";
    let refused = program.refused(&format!("measure pile.obj {options} {both}"));
    assert!(refused.contains("midpoint: not measured"), "{refused}");
    assert!(refused.contains("octree: not measured"), "{refused}");
    // The other side is reported, but there is no comparison.
    let sides = "--a method=midpoint,memory-limit=16 --b method=sah,memory-limit=16";
    let text = program.ends(1, &format!("compare pile.obj {QUICK} {sides}"));
    assert!(
        text.contains("midpoint: not measured") && text.contains("sah: tree built"),
        "{text}"
    );
    // A point of a sweep without values does not end it.
    let points = "--d-max 2,20 --n-oilf 1 -o rows.jsonl";
    let text = program.ends(0, &format!("sweep pile.obj {options} {points}"));
    assert!(
        text.contains("point 2 (midpoint): the tree exceeds"),
        "{text}"
    );
    let rows = program.read("rows.jsonl");
    let rows = rows
        .lines()
        .map(|row| serde_json::from_str::<Value>(row).unwrap());
    let is_empty: Vec<bool> = rows.map(|row| row["N_LS"].is_null()).collect();
    assert_eq!(is_empty, [false, true, false, false]);
}

#[test]
fn what_has_no_value_is_null_and_not_zero() {
    let program = Program::new();
    program.write("empty-view.nff", EMPTY_VIEW);
    let arguments = format!("measure empty-view.nff {QUICK} --method midpoint");
    let report = program.json(&format!("{arguments} --format json"));
    let run = &report["runs"][0];
    assert_eq!(run["parameters"]["N_HPR"], 0);
    assert!(
        run["parameters"]
            .as_object()
            .unwrap()
            .contains_key("N_RPRT")
    );
    assert_eq!(run["parameters"]["N_RPRT"], Value::Null);
    assert_eq!(run["delta"]["N_RPRT"], Value::Null);
    let csv = program.done(&format!("{arguments} --format csv"));
    assert!(
        csv.contains(",N_RPRT,tests per hit,delta,R,ratio,\n"),
        "{csv}"
    );
    let text = program.done(&arguments);
    assert!(
        text.lines()
            .any(|l| l.contains("N_RPRT") && l.ends_with('–')),
        "{text}"
    );
}

#[test]
fn every_form_has_every_symbol_for_every_method() {
    let program = Program::new();
    let measure = format!("measure tetra:3 {QUICK}");

    let text = program.done(&format!("{measure} --threads 3"));
    let at = |part: &str| {
        text.find(part)
            .unwrap_or_else(|| panic!("no {part}: {text}"))
    };
    assert!(at("Δ") < at("Λ") && at("Λ") < at("Table 1"));
    assert!(at("2/1") < at("N_RPRT"));
    assert!(text.contains("Not needed by this scene: spheres"), "{text}");
    assert!(text.contains(" CPU) on 3 threads"), "{text}");

    let markdown = program.done(&format!("{measure} --format markdown"));
    let latex = program.done(&format!("{measure} --format latex"));
    assert_eq!(
        latex.matches("\\begin{tabular}").count(),
        latex.matches("\\end{tabular}").count()
    );
    let csv = program.done(&format!("{measure} --format csv"));
    let mut csv = csv::Reader::from_reader(csv.as_bytes());
    let lines: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    assert_eq!(lines.len(), 2 * parameters().len());
    for parameter in parameters() {
        let symbol = parameter.symbol;
        assert!(
            text.lines().any(|l| l.starts_with(&format!(" {symbol} "))),
            "{symbol}"
        );
        let row = format!("| `{symbol}` | {} |", parameter.name);
        assert!(markdown.contains(&row), "{row}");
        let found = lines
            .iter()
            .filter(|line| &line[2] == symbol && !line[7].is_empty());
        // Without reflection nothing secondary is hit, but all of it is counted.
        let is_there = !FOR_HIERARCHIES.contains(&symbol);
        assert_eq!(found.count(), if is_there { 2 } else { 0 }, "{symbol}");
    }
    for formula in [
        "$N_{LS}$",
        "$T_{TT}/T_{TR}$ [\\%]",
        "$N_{RPRT}$",
        "$V_{EMPTY}$",
    ] {
        assert!(latex.contains(formula), "{formula}: {latex}");
    }
    for line in latex.lines().filter(|l| l.contains(" & ")) {
        assert!(!line.contains('–') && !line.contains('³'), "{line}");
    }
}

#[test]
fn output_files_are_written_whole_and_leave_standard_output_clean() {
    let program = Program::new();
    program.write("report.json", "what the user had");
    assert_eq!(
        program.done(&format!("measure balls:1 {QUICK} -o report.json")),
        ""
    );
    // The extension decides the form.
    let written = std::fs::read_to_string(program.path().join("report.json")).unwrap();
    let report: Value = serde_json::from_str(&written).unwrap();
    assert_eq!(report["scene"]["objects"], 11);
    assert_eq!(program.files(), ["report.json"]);

    program.refused_in_a_line("measure balls:1 --resolution 0x0 -o report.json");
    let kept = std::fs::read_to_string(program.path().join("report.json")).unwrap();
    assert_eq!(kept, written);
    assert_eq!(program.files(), ["report.json"]);
}

#[test]
fn pictures_have_the_size_asked_for() {
    let program = Program::new();
    let options = "--resolution 40x24 --samples 2";
    for name in ["a.png", "a.exr"] {
        assert_eq!(
            program.done(&format!("render teaching {options} -o {name}")),
            ""
        );
    }
    let open = |name: &str| image::open(program.path().join(name)).unwrap();
    let (png, exr) = (open("a.png").to_rgb8(), open("a.exr").to_rgb32f());
    assert_eq!(png.dimensions(), (40, 24));
    assert_eq!(exr.dimensions(), (40, 24));
    // The same picture: PNG is sRGB of what EXR has linear.
    for (encoded, linear) in png.pixels().zip(exr.pixels()) {
        for (encoded, linear) in encoded.0.into_iter().zip(linear.0) {
            let e = f32::from(encoded) / 255.0;
            let decoded = if e <= 0.04045 {
                e / 12.92
            } else {
                ((e + 0.055) / 1.055).powf(2.4)
            };
            assert!((decoded - linear.clamp(0.0, 1.0)).abs() < 0.005);
        }
    }
    let colors: std::collections::BTreeSet<_> = png.pixels().map(|p| p.0).collect();
    assert!(colors.len() > 20, "a picture of something");
}

#[test]
fn generated_files_measure_as_their_generator_does() {
    let program = Program::new();
    program.done("generate balls:2 -o balls.nff");
    program.write(
        "rings.nff",
        &program.done("generate rings:1 --cylinders polygons:6"),
    );
    for (generator, file) in [
        ("balls:2", "balls.nff"),
        ("rings:1 --cylinders polygons:6", "rings.nff"),
    ] {
        let counts = |scene: &str| -> Vec<Value> {
            let report = program.json(&format!("measure {scene} {QUICK} --format json"));
            report["runs"]
                .as_array()
                .unwrap()
                .iter()
                .flat_map(|run| {
                    parameters()
                        .iter()
                        .filter(|p| p.unit == Unit::Count)
                        .map(|p| run["parameters"][p.symbol].clone())
                        .collect::<Vec<_>>()
                })
                .collect()
        };
        let generated = counts(generator);
        assert!(generated.len() > 40);
        assert_eq!(generated, counts(file), "{generator}");
    }
}

#[test]
fn methods_lists_every_method_and_setting() {
    let program = Program::new();
    let text = program.done("methods");
    let list = program.json("methods --format json");
    let list = list.as_array().unwrap();
    assert_eq!(list.len(), Method::all().count());
    for (method, entry) in Method::all().zip(list) {
        assert_eq!(entry["name"], method.name);
        assert_eq!(entry["source"], method.source);
        assert!(text.contains(&format!("{}: {}", method.name, method.summary)));
        let constants = entry["constants"].as_array().unwrap();
        assert_eq!(constants.len(), method.constants.len());
        for (constant, entry) in method.constants.iter().zip(constants) {
            assert_eq!(entry["name"], constant.name);
            assert_eq!(entry["default"], constant.default);
            assert_eq!(entry["lowest"], constant.lowest);
            assert_eq!(entry["highest"], constant.highest);
            assert!(text.contains(&format!("--set {}=", constant.name)));
            assert!(text.contains(constant.source));
        }
    }
}

#[test]
fn a_grid_shows_no_value_where_a_parameter_does_not_apply() {
    let program = Program::new();
    let text =
        program.done("compare balls:1 --a method=midpoint --b method=grid --resolution 20x20");
    for symbol in ["D_MAX", "N_OILF", "D_REACH", "N_IN", "N_INODES"] {
        let row = text
            .lines()
            .find(|line| line.trim_start().starts_with(&format!("{symbol} ")));
        let row: Vec<_> = row.unwrap().split_whitespace().collect();
        assert!(row.contains(&"–"), "{row:?}");
    }
    assert!(
        text.contains("grid: D_MAX 20 (does not apply), N_OILF 1 (does not apply)"),
        "{text}"
    );
}

#[test]
fn f32_for_a_scene_that_it_cannot_represent_is_warned_of() {
    let program = Program::new();
    let ground = "s 0 0 -6371000 6371000\ns 0 0 1 1\n";
    let header = "v\nfrom 0 -9 2\nat 0 0 1\nup 0 0 1\nangle 45\nhither 0.1\nresolution 16 16\n";
    program.write(
        "earth.nff",
        &format!("{header}b 0 0 0\nl 5 -5 50\nf 1 1 1 1 0 0 0 0\n{ground}"),
    );
    let options = "--precision f32 --method midpoint";
    let measured = program.done(&format!("measure earth.nff {options} --resolution 16x16"));
    let line = measured.lines().find(|line| line.contains("Precision: "));
    let words = line.expect("measure says the precision").trim();
    assert!(words.contains("as chosen, though object 1"), "{words}");
    for command in [
        format!("render earth.nff {options} --resolution 16x16 -o earth.png"),
        format!("verify earth.nff {options} --rays 10"),
        format!("verify earth.nff {options} --exact 10"),
    ] {
        let output = program.run(&command);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(errors.contains(words), "{command}: {errors}");
        let other = program.run(&command.replace("f32", "f64"));
        let errors = String::from_utf8(other.stderr).unwrap();
        assert!(!errors.contains("Precision"), "{command}: {errors}");
    }
}

#[test]
fn without_a_display_it_measures_and_writes_a_picture_only_if_asked() {
    let program = Program::new();
    program.write("balls-1.png", "what the user had");
    for command in ["balls:1", "balls:1 -o picture.png"] {
        let output = program.run(command);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{errors}");
        assert_eq!(errors.lines().count(), 1, "{errors}");
        let text = String::from_utf8(output.stdout).unwrap();
        for symbol in DELTA.iter().chain(&LAMBDA) {
            assert!(text.contains(symbol), "{symbol}: {text}");
        }
        for method in Method::of_the_paper() {
            assert!(text.contains(method.name), "{text}");
        }
        let path = program.path().join("picture.png");
        if command == "balls:1" {
            assert!(errors.contains("-o FILE.png"), "{errors}");
            let files = std::fs::read_dir(program.path()).unwrap();
            assert_eq!(files.count(), 1, "it writes no file unasked");
        } else {
            assert!(text.contains("picture.png"), "{text}");
            let picture = image::open(path).unwrap();
            assert_eq!((picture.width(), picture.height()), (512, 512));
        }
    }
    let kept = std::fs::read_to_string(program.path().join("balls-1.png")).unwrap();
    assert_eq!(kept, "what the user had");
    let refused = program.run("balls:1 -o picture.gif");
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let program = Program::new();
    // Far more than a pipe holds.
    let mut child = program
        .command("generate balls:4")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0; 16];
    child.stdout.take().unwrap().read_exact(&mut first).unwrap();
    let mut errors = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut errors)
        .unwrap();
    assert_eq!(errors, "");
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn help_is_there_for_every_command() {
    let program = Program::new();
    for command in [
        "", "measure", "render", "generate", "methods", "verify", "trade", "tune",
    ] {
        let help = program.done(&format!("{command} --help"));
        assert!(help.contains("Usage: bspscope"), "{help}");
        assert!(help.contains("Examples:\n  bspscope"), "{help}");
    }
}

#[test]
fn a_comparison_is_made_under_equal_conditions_or_refused() {
    let program = Program::new();
    let report = program.json(
        "compare tetra:3 --a method=midpoint,d-max=9 --b method=sah-cut,d-max=9,epsilon=1e-5 \
         --resolution 16x16 --format json",
    );
    let methods: Vec<_> = report["runs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|run| run["method"].as_str().unwrap())
        .collect();
    assert_eq!(methods, ["midpoint", "sah-cut"]);

    let refused = program
        .run("compare tetra:3 --a method=midpoint --b method=sah-cut,d-max=12 --resolution 16x16");
    assert_eq!(refused.status.code(), Some(1));
    let text = String::from_utf8(refused.stdout).unwrap();
    assert!(
        text.contains("D_MAX") && text.contains("20 in A and 12 in B"),
        "{text}"
    );

    let wrong = program.run("compare tetra:3 --a method=midpoint --b method=sah-cut,gap=1");
    assert_eq!(wrong.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("no setting 'gap'"));
}

#[test]
fn what_rays_did_is_told_kind_by_kind_in_every_form() {
    let program = Program::new();
    let compare =
        "compare balls:2 --a method=midpoint --b method=sah-cut --resolution 16x16 --format";
    let json = program.json(&format!("{compare} json --per-kind"));
    let tests = &json["per_kind"]["primary"]["tests"];
    let of_runs: Vec<_> = (0..2)
        .map(|run| &json["runs"][run]["parameters"]["N_PRIT"])
        .collect();
    assert_eq!(
        tests["values"]
            .as_array()
            .unwrap()
            .iter()
            .collect::<Vec<_>>(),
        of_runs
    );
    let [a, b] = [0, 1].map(|run: usize| tests["values"][run].as_f64().unwrap());
    assert_eq!(tests["second_to_first"].as_f64(), Some(b / a));
    assert_eq!(json["per_kind"]["shadow"]["rays"]["second_to_first"], 1.0);
    // No ray is refracted.
    assert!(json["per_kind"].get("refracted").is_none());
    let csv = program.done(&format!("{compare} csv --per-kind"));
    assert!(
        csv.contains(&format!("sah-cut,tests,tests,primary,R,count,{b}\n")),
        "{csv}"
    );
    assert!(
        csv.contains(&format!("2/1,tests,tests,primary,R,ratio,{}\n", b / a)),
        "{csv}"
    );
    for (form, title) in [
        ("text", "\nShadow rays\n"),
        ("markdown", "\n## Shadow rays\n"),
        ("latex", "\n% Shadow rays\n"),
    ] {
        let text = program.done(&format!("{compare} {form} --per-kind"));
        assert!(
            text.contains(title) && text.contains("nodes per ray, maximum"),
            "{text}"
        );
        assert!(!text.contains("Refracted rays"), "{text}");
        assert!(!program.done(&format!("{compare} {form}")).contains(title));
    }
}

#[test]
fn accuracy_writes_every_form_and_takes_only_what_is_asked_for() {
    let program = Program::new();
    let options = "accuracy rings:1 --resolution 24x16 --samples 4 --rounds 1";
    let only = format!("{options} --only precision --only cylinders");
    let text = program.done(&only);
    for words in [
        "reference",
        "precision f32",
        "cylinders polygons:10",
        "SSIM",
        "FLIP",
    ] {
        assert!(text.contains(words), "{words}\n{text}");
    }
    assert!(!text.contains("N_OILF"), "{text}");
    let json: serde_json::Value =
        serde_json::from_str(&program.done(&format!("{only} --format json"))).unwrap();
    let outcomes = json["outcomes"].as_array().unwrap();
    assert_eq!(outcomes.len(), 6);
    assert_eq!(outcomes[0]["time_ratio"]["median"], 1.0);
    assert_eq!(outcomes[0]["error"]["rmse"], 0.0);
    assert_eq!(outcomes[1]["turned"]["precision"], "f32");
    let all = program.done(&format!("{options} --format csv"));
    let widths: Vec<_> = csv::Reader::from_reader(all.as_bytes())
        .records()
        .map(|record| record.unwrap().len())
        .collect();
    assert!(
        widths.len() > 20 && widths.iter().all(|&w| w == 14),
        "{widths:?}"
    );
}

#[test]
fn the_papers_tables_come_in_every_form() {
    let program = Program::new();
    let quick = "paper tetra --resolution 16x16";
    let report = program.json(&format!("{quick} --format json"));
    let tetra = &report["scenes"][0];
    assert_eq!(tetra["unequal"], serde_json::json!([]));
    assert_eq!(tetra["table"], 5);
    assert_eq!(tetra["table_4"]["N_O"]["mark"], "equal after rounding");
    let leaves = &tetra["properties"]["N_LS"];
    assert_eq!(leaves["1"]["computed"], 96_056.0);
    assert_eq!(leaves["1"]["mark"], "equal after rounding");
    assert_eq!(leaves["2"]["mark"], "same direction");
    let slip = tetra["properties"]["N_AOIFL"]["2/1"]["note"].as_str();
    assert!(slip.unwrap().contains("125.4"));

    let csv = program.done(&format!("{quick} --format csv"));
    let mut csv = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<_> = csv.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 7 + 10 * 3);
    assert!(
        rows.iter()
            .any(|row| &row[2] == "N_LS" && &row[5] == "11322")
    );

    assert!(
        program
            .done(quick)
            .contains("96056   =   11322      11540   ~")
    );
    let markdown = program.done(&format!("{quick} --format markdown"));
    assert!(
        markdown.contains("| N\\_LS |  | 96056 | 96056 | = |"),
        "{markdown}"
    );
    program.done(&format!("{quick} -o tables.tex"));
    let latex = std::fs::read_to_string(program.path().join("tables.tex")).unwrap();
    assert!(latex.contains("N\\_LS &  & 96056 & 96056 & = &"), "{latex}");
    // clap's own message takes several lines.
    assert_eq!(program.run("paper teaching").status.code(), Some(2));
}

#[test]
fn every_setting_is_an_option_with_help() {
    let help = Program::new().done("measure --help");
    for setting in bspscope::setup::SETTINGS {
        assert!(help.contains(&format!("--{} <", setting.name)), "{help}");
    }
    let program = Program::new();
    // Names of earlier versions.
    let old = "--cut-off 0.5 --kernel lanes --resolution 8x8 --method midpoint --format json";
    let report = program.json(&format!("measure tetra:1 {old}"));
    let settings = &report["runs"][0]["settings"];
    assert_eq!(settings["min_contribution"], 0.5);
    assert_eq!(settings["kernel"]["asked"], "stream");
    program.done("trade tetra:1 --only cut-off --resolution 8x8 --samples 1 --rounds 1");
}

#[test]
fn any_setting_can_differ_between_the_sides_of_a_comparison() {
    let program = Program::new();
    let sides = "--a method=sah-cut,kernel=stream,threads=1 --b method=sah-cut,gap-fraction=0.1";
    let text = program.done(&format!("compare tetra:2 {sides} --resolution 8x8"));
    assert!(
        text.contains("kernel stream") && text.contains("kernel scalar"),
        "{text}"
    );
    let sides = "--a method=sah-cut,precision=f32 --b method=sah-cut";
    let arguments = format!("compare tetra:2 {sides} --resolution 8x8");
    let output = program.run(&arguments);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("precision is f32 in A and f64 in B"),
        "{text}"
    );
}
