//! Lessons: those that come with the program hold, and broken ones are told by line and reason.

use crate::support::program::Program;
use crate::support::scenes::scene_path;
use bspscope::lesson::{
    Answer, Figures, Formula, LESSONS, Lesson, Measurer, Prediction, Prose, Style, check,
    check_step,
};
use bspscope::progress::Progress;
use std::path::Path;

/// A lesson of one step, with these settings and this text.
fn lesson_with(settings: &str, text: &str) -> String {
    format!(
        "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\n# Step\n\n```toml\n{settings}\n```\n\n{text}\n"
    )
}

/// Line of the first line of the settings in [`lesson_with`].
const SETTINGS: usize = 9;

const TREES: &str = "scene = \"tetra:2\"\nsize = [16, 16]\na = \"method=midpoint,d-max=6\"\n\
                     b = \"method=none\"";

fn faults(text: &str) -> Vec<(usize, String)> {
    let lesson = Lesson::parse(text, "test.md").unwrap();
    let wrong = check(&lesson, &Progress::new()).unwrap();
    wrong.into_iter().map(|w| (w.line, w.reason)).collect()
}

#[test]
fn every_lesson_holds() {
    assert_eq!(LESSONS.len(), 8);
    for known in LESSONS {
        let lesson = known.read();
        let asked = lesson.steps.iter().filter(|s| s.question.is_some()).count();
        let expected: usize = lesson.steps.iter().map(|s| s.expectations.len()).sum();
        assert!(
            (4..=7).contains(&asked),
            "{}: {asked} questions",
            known.name
        );
        assert!(expected >= asked, "{}: {expected} conditions", known.name);
        let wrong = check(&lesson, &Progress::new()).unwrap();
        assert!(wrong.is_empty(), "{wrong:?}");
    }
}

#[test]
fn every_file_of_the_folder_is_a_lesson_of_the_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "README.md")
        .collect();
    files.sort();
    let mut known: Vec<_> = LESSONS.iter().map(|l| format!("{}.md", l.name)).collect();
    known.sort();
    assert_eq!(files, known);
}

/// What the text says is what the library measures, whoever fills it in.
#[test]
fn figures_are_filled_in_from_what_was_measured() {
    let settings = format!(
        "{TREES}\npixel = [8, 8]\nquestion = \"?\"\nnumber = \"b.N_IT / a.N_IT\"\nwithin = \"10 %\""
    );
    let text = "{a.N_LS}\n\n---\n\n{b.N_LS} {a.N_IT} {b.ray.N_IT} {differing} {2 * 3 as whole} \
                {1 / 4 as %}";
    let lesson = Lesson::parse(&lesson_with(&settings, text), "test.md").unwrap();
    let step = &lesson.steps[0];
    let figures = Measurer::default()
        .measure(&lesson, step, &Progress::new())
        .unwrap();
    assert_eq!(check_step(&lesson, step, &figures), []);
    let of_b = figures.b.as_ref().unwrap();
    let tests = |m: &bspscope::measure::Measurement| m.all_rays().unwrap().tests;
    let (a, b) = (&figures.a.measurement, &of_b.measurement);
    assert_eq!(step.before.fill(None).trim(), "…");
    assert_eq!(
        step.before.fill(Some(&figures)).trim(),
        bspscope::present::number::grouped(a.tree.leaves as f64)
    );
    let in_ray = of_b.pixel.unwrap()[0].tests;
    assert_eq!(
        in_ray, 16,
        "without a tree the ray is tested against all objects"
    );
    let tests_of_a = bspscope::present::number::grouped(tests(a) as f64);
    assert_eq!(
        step.after.fill(Some(&figures)).trim(),
        format!("1 {tests_of_a} {in_ray} 0 6 25.00\u{a0}%")
    );
    // A prediction within 10 % is right, one beyond is not.
    let truth = tests(b) as f64 / tests(a) as f64;
    let answer = &step.question.as_ref().unwrap().answer;
    let right = |share: f64| {
        let prediction = Prediction::Number(truth * share);
        answer.judge(prediction, &figures).unwrap().is_right()
    };
    assert_eq!(
        [0.89, 0.91, 1.09, 1.11].map(right),
        [false, true, true, false]
    );
}

#[test]
fn a_comparison_knows_more_from_less() {
    let settings = format!("{TREES}\nquestion = \"?\"\ncompare = [\"b.N_IT\", \"a.N_IT\"]");
    let lesson = Lesson::parse(&lesson_with(&settings, "x\n\n---\n\ny"), "test.md").unwrap();
    let step = &lesson.steps[0];
    let figures = Measurer::default()
        .measure(&lesson, step, &Progress::new())
        .unwrap();
    let answer = &step.question.as_ref().unwrap().answer;
    let verdicts = [0, 1, 2].map(|place| {
        let verdict = answer.judge(Prediction::Choice(place), &figures).unwrap();
        assert_eq!(verdict.truth, "More");
        (verdict.text(), verdict.is_right())
    });
    let expected = [
        ("Exact: you said More, measured More", true),
        ("Off: you said The same, measured More", false),
        ("Off: you said Less, measured More", false),
    ];
    assert_eq!(
        verdicts,
        expected.map(|(text, right)| (text.to_owned(), right))
    );
    assert_eq!(answer.judge(Prediction::Number(1.0), &figures), None);
}

#[test]
fn what_differs_by_less_than_a_share_is_about_the_same() {
    for (factor, right) in [
        (1.04, "About the same"),
        (0.96, "About the same"),
        (1.06, "More"),
        (0.94, "Less"),
    ] {
        let compare = format!("compare = [\"{factor} * a.N_LS\", \"a.N_LS\"]");
        let settings = format!("{TREES}\nquestion = \"?\"\n{compare}\nsame-within = \"5 %\"");
        let lesson = Lesson::parse(&lesson_with(&settings, "x\n\n---\n\ny"), "test.md").unwrap();
        let step = &lesson.steps[0];
        let figures = Measurer::default()
            .measure(&lesson, step, &Progress::new())
            .unwrap();
        let answer = &step.question.as_ref().unwrap().answer;
        let verdict = answer.judge(Prediction::Choice(0), &figures).unwrap();
        assert_eq!(verdict.truth, right, "{factor}");
    }
}

#[test]
fn what_does_not_hold_is_told_with_its_line() {
    let question = "question = \"?\"\nnumber = \"a.N_LS\"\nwithin = \"1\"";
    let reveal = "x\n\n---\n\ny";
    let settings =
        format!("{TREES}\n{question}\nexpect = [\n  \"a.N_LS > 1\",\n  \"b.N_LS > 1\",\n]");
    let wrong = faults(&lesson_with(&settings, reveal));
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(wrong[0].0, SETTINGS + 9);
    assert!(
        wrong[0]
            .1
            .contains("expected b.N_LS > 1, found 1 on the left"),
        "{wrong:?}"
    );

    // No hit, no tests per hit.
    let camera = "camera = { from = [9, 9, 9], at = [99, 99, 99] }";
    let settings = format!("{TREES}\n{camera}\n{question}");
    let wrong = faults(&lesson_with(&settings, "x\n\n---\n\n{a.N_RPRT}"));
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert!(wrong[0].1.contains("{a.N_RPRT} has no value"), "{wrong:?}");

    let choices = "question = \"?\"\nchoices = [[\"x\", \"a.N_LS > 0\"], [\"y\", \"b.N_LS = 1\"]]";
    let wrong = faults(&lesson_with(&format!("{TREES}\n{choices}"), reveal));
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(wrong[0].0, SETTINGS + 4);
    assert!(wrong[0].1.starts_with("2 choices are right"), "{wrong:?}");

    let wrong = faults(&lesson_with(
        &format!("scene = \"not-there.nff\"\na = \"method=none\"\n{question}"),
        reveal,
    ));
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(wrong[0].0, SETTINGS);
    assert!(wrong[0].1.contains("not-there.nff"), "{wrong:?}");
}

#[test]
fn broken_files_are_refused_with_line_and_reason() {
    let step = |settings: &str, text: &str| lesson_with(&format!("{TREES}\n{settings}"), text);
    let asked = "question = \"?\"\nnumber = \"b.N_LS\"\nwithin = \"1\"";
    let reveal = "x\n\n---\n\ny";
    let cases: Vec<(String, usize, &str)> = vec![
        (String::new(), 1, "expected a line +++"),
        (
            "+++\ntitle = \"T\"\n".into(),
            1,
            "second line +++ is missing",
        ),
        ("+++\ntitle = \"T\"\n+++\n# S\n".into(), 2, "about"),
        (
            "+++\ntitle = \"T\"\nabout = \"A\"\nx = 1\n+++\n".into(),
            4,
            "unknown field",
        ),
        (
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\n".into(),
            4,
            "no step",
        ),
        (
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\nText\n".into(),
            6,
            "expected a heading",
        ),
        (
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\n# S\n\nText\n".into(),
            6,
            "```toml",
        ),
        (
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\n# S\n```toml\na = 1\n".into(),
            7,
            "not closed",
        ),
        (
            lesson_with("a = \"method=none\"", reveal),
            SETTINGS,
            "scene",
        ),
        (
            lesson_with("scene = \"balls\"\na = \"method=no\"", reveal),
            SETTINGS + 1,
            "expected one of midpoint",
        ),
        (
            lesson_with("scene = \"balls\"\na = \"d-max=4\"", reveal),
            SETTINGS + 1,
            "method=NAME",
        ),
        (
            step("colour = \"red\"", reveal),
            SETTINGS + 4,
            "unknown field",
        ),
        (step("= 3", reveal), SETTINGS + 4, ""),
        (
            step("heatmap = \"N_XYZ\"", reveal),
            SETTINGS + 4,
            "no heatmap",
        ),
        (step("pixel = [16, 0]", reveal), SETTINGS + 4, "outside"),
        (
            step("camera = { from = [1, 1, 1], at = [1, 1, 1] }", reveal),
            SETTINGS + 4,
            "camera",
        ),
        (
            step("number = \"a.N_LS\"", reveal),
            SETTINGS + 4,
            "needs 'question'",
        ),
        (
            step("question = \"?\"", reveal),
            SETTINGS + 4,
            "one of 'number'",
        ),
        (
            step("question = \"?\"\nnumber = \"a.N_LS\"", reveal),
            SETTINGS + 5,
            "'within'",
        ),
        (
            step(
                "question = \"?\"\nnumber = \"a.NO\"\nwithin = \"1\"",
                reveal,
            ),
            SETTINGS + 5,
            "NO",
        ),
        (
            step(
                "question = \"?\"\nnumber = \"a.N_LS\"\nwithin = \"x\"",
                reveal,
            ),
            SETTINGS + 6,
            "20 %",
        ),
        (
            step(
                "question = \"?\"\nchoices = [[\"x\", \"a.N_LS > 0\"]]",
                reveal,
            ),
            SETTINGS + 5,
            "two",
        ),
        (
            step("expect = [\"a.N_LS\"]", reveal),
            SETTINGS + 4,
            "expected <",
        ),
        (
            step("expect = [\"a.T_TR > 0\"]", reveal),
            SETTINGS + 4,
            "cannot use times",
        ),
        (
            step("expect = [\"a.ray.N_IT > 0\"]", "x"),
            6 + 3 + 4,
            "no 'pixel'",
        ),
        (step(asked, "x"), SETTINGS + 4, "'---'"),
        (step(asked, "\n---\n\ny"), 6, "text before"),
        (step("", reveal), SETTINGS + 9, "needs 'question'"),
        (
            step(asked, "x {b.N_LS}\n\n---\n\ny"),
            SETTINGS + 9,
            "before the prediction",
        ),
        (step(asked, "x\n\n---\n\n{b.N_LS"), SETTINGS + 13, "'}'"),
        (
            lesson_with(
                "scene = \"balls\"\na = \"method=none\"\nquestion = \"?\"\nnumber = \"b.N_LS\"\n\
                 within = \"1\"",
                reveal,
            ),
            SETTINGS + 2,
            "no tree 'b'",
        ),
    ];
    let mut unlike = Vec::new();
    for (text, line, reason) in cases {
        let error = match Lesson::parse(&text, "broken.md") {
            Ok(_) => panic!("taken: {text}"),
            Err(error) => error,
        };
        let told = error
            .to_string()
            .starts_with(&format!("broken.md:{line}: "));
        if !told || !error.reason.contains(reason) {
            unlike.push(format!(
                "{error}, not line {line} and {reason}, for\n{text}"
            ));
        }
    }
    assert!(unlike.is_empty(), "{}", unlike.join("\n"));
    assert!(Lesson::parse(&step(asked, reveal), "good.md").is_ok());
}

#[test]
fn the_command_line_lists_checks_and_shows() {
    let program = Program::new();
    let out = program.done("lesson list");
    assert!(
        LESSONS.iter().all(|known| out.contains(known.name)),
        "{out}"
    );

    let question = "question = \"How many?\"\nnumber = \"a.N_LS\"\nwithin = \"1\"";
    // The scene lies beside the lesson.
    std::fs::copy(scene_path("teaching"), program.file("mine.nff")).unwrap();
    let settings = "scene = \"mine.nff\"\nsize = [8, 8]\na = \"method=none\"";
    let write = |expect: &str| {
        let settings = format!("{settings}\n{question}\nexpect = [\"{expect}\"]");
        program.write(
            "mine.md",
            &lesson_with(&settings, "x\n\n---\n\n{a.N_LS} leaf"),
        );
    };
    write("a.N_LS = 1");
    let out = program.done("lesson check mine.md");
    assert!(out.contains("1 of 1 conditions hold"), "{out}");
    let out = program.done("lesson show mine.md");
    assert!(
        out.contains("**How many?** 1") && out.contains("1 leaf"),
        "{out}"
    );

    write("a.N_LS = 2");
    let out = program.ends(1, "lesson check mine.md");
    let line = format!("mine.md:{}: expected a.N_LS = 2, found 1", SETTINGS + 6);
    assert!(out.contains(&line), "{out}");

    write("a.N_LS");
    let err = program.ends(2, "lesson check mine.md");
    assert!(
        err.contains(&format!("mine.md:{}: ", SETTINGS + 6)),
        "{err}"
    );
    program.ends(2, "lesson check not-there.md");
}

/// Returns the numbers in a text, without groups of digits.
fn numbers(text: &str) -> Vec<String> {
    let text = text.replace('\u{a0}', "");
    let belongs = |c: char| c.is_ascii_digit() || c == '.';
    let words = text.split(|c| !belongs(c));
    let words = words.map(|word| word.trim_matches('.').to_owned());
    words.filter(|word| !word.is_empty()).collect()
}

/// Returns the measured numbers in a text; those that were specified give nothing away.
fn measured_numbers(prose: &Prose, figures: &Figures) -> Vec<String> {
    let text = prose.fill_with(
        |value| match value.formula.names().iter().all(|n| n.is_given()) {
            true => String::new(),
            false => value.write(figures),
        },
    );
    numbers(&text)
}

fn number_of(formula: &Formula, figures: &Figures) -> String {
    numbers(&formula.write(formula.value(figures), Style::Plain)).concat()
}

/// No text of a step or an earlier one contains the answer.
#[test]
fn no_text_gives_a_later_answer_away() {
    let mut asked = 0;
    let mut told = Vec::new();
    for known in LESSONS {
        let lesson = known.read();
        let mut measurer = Measurer::default();
        let mut seen: Vec<String> = Vec::new();
        for step in &lesson.steps {
            let figures = measurer.measure(&lesson, step, &Progress::new()).unwrap();
            seen.extend(measured_numbers(&step.before, &figures));
            let question = step.question.as_ref().expect("every step asks");
            seen.extend(numbers(&question.ask));
            // Every number that decides the answer.
            let decisive: Vec<_> = match &question.answer {
                Answer::Number { formula, .. } => vec![vec![number_of(formula, &figures)]],
                Answer::Choice(choices) => {
                    let right = &choices[question.answer.right_choices(&figures)[0]];
                    let sides = |when: &bspscope::lesson::Condition| {
                        let sides = when.sides().into_iter();
                        let measured = sides.filter(|s| s.names().iter().any(|n| !n.is_given()));
                        measured.map(|side| number_of(side, &figures)).collect()
                    };
                    right.when.iter().map(sides).collect()
                }
            };
            for numbers in decisive {
                assert!(!numbers.is_empty(), "{}", step.title);
                if numbers.iter().all(|number| seen.contains(number)) {
                    told.push(format!("{}, {}: {numbers:?}", known.name, step.title));
                }
            }
            asked += 1;
            seen.extend(measured_numbers(&step.after, &figures));
        }
    }
    assert!(asked > 20);
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// Numbers in a text are measured or specified. What remains is the rule of thumb, sizes of numbers, "3D",
/// and settings that the heading or the question repeats.
#[test]
fn texts_contain_no_numbers_of_their_own() {
    const ALLOWED: [&str; 11] = [
        "1.2", "2", "32", "64", "256", "10", "20", "4", "16", "1", "3",
    ];
    let mut placeholders = 0;
    for known in LESSONS {
        let lesson = known.read();
        for step in &lesson.steps {
            for prose in [&step.before, &step.after] {
                placeholders += prose.placeholders().count();
                // Without the commands in backticks.
                let text = prose.fill_with(|_| String::new());
                let text: String = text.split('`').step_by(2).collect();
                for number in numbers(&text) {
                    let place = format!("{}, {}: {number}", known.name, step.title);
                    assert!(ALLOWED.contains(&number.as_str()), "{place}");
                }
            }
        }
    }
    assert!(placeholders > 100);
}

/// What a step shows on purpose does not show the answer before the prediction.
#[test]
fn every_question_hides_what_it_asks_for() {
    let mut asked = 0;
    for known in LESSONS {
        for step in &known.read().steps {
            let secret = step.secret();
            let question = step.question.as_ref().expect("every step asks");
            for name in question.answer.formulas().iter().flat_map(|f| f.names()) {
                let text = format!("{name:?}");
                let symbol = text.rsplit('.').next().expect("a symbol");
                let hidden = match name.is_of_pixel() {
                    true => secret.hides_rays() && secret.hides_heatmap(symbol),
                    false if name.side().is_none() => secret.hides_difference(),
                    false => secret.hides_counter(symbol),
                };
                assert_eq!(hidden, !name.is_given(), "{}: {text}", step.title);
                asked += 1;
            }
        }
    }
    assert!(asked > 20);
}
