//! Lessons in the window: each is taken from its first step to its last, by mouse and by keys.

use crate::harness::{Window, click, finish, has, open, press, small, wait};
use bspscope::lesson::{Answer, LESSONS, Lesson, Measurer, Question};
use bspscope::progress::Progress;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

const HIDDEN: &str = "Hidden until you have made your prediction";

/// A window that opens with a lesson.
fn taking(lesson: &Lesson) -> Window<'static> {
    let mut start = small("tetra:2");
    start.lesson = Some(lesson.clone());
    open(start)
}

fn reveal_is_disabled(window: &Window<'_>) -> bool {
    let button = window.get_by_label("Reveal");
    button.accesskit_node().is_disabled()
}

/// Predicts something, right or wrong.
fn predict(window: &mut Window<'_>, question: &Question) {
    match &question.answer {
        Answer::Number { .. } => {
            let field = window.get_by_label("Your prediction");
            field.focus();
            window.run_steps(2);
            window.get_by_label("Your prediction").type_text("1000000");
        }
        Answer::Choice(choices) => window.get_by_label(&choices[0].text).click(),
    }
    window.run_steps(3);
}

/// The line that tells what became of the prediction.
fn verdict(window: &Window<'_>) -> Option<String> {
    let node = window
        .query_all_by_label_contains("You predicted: ")
        .next()?;
    node.accesskit_node().label().or(node.value())
}

fn take_whole(lesson: &Lesson) {
    let mut window = taking(lesson);
    window.run_steps(3);
    let mut measurer = Measurer::default();
    let mut asked = 0;
    let last = lesson.steps.len() - 1;
    for (place, step) in lesson.steps.iter().enumerate() {
        let of = lesson.steps.len();
        assert!(has(&window, &step.title), "{}", step.title);
        assert!(has(&window, &format!("step {} of {of}", place + 1)));
        if let Some(question) = &step.question {
            asked += 1;
            assert!(has(&window, HIDDEN), "{}", step.title);
            assert!(!has(&window, "the tree in seven figures"));
            wait(&mut window, "measured", |w| !has(w, "measuring …"));
            assert!(reveal_is_disabled(&window), "no prediction yet");
            assert!(verdict(&window).is_none());
            predict(&mut window, question);
            wait(&mut window, "Reveal", |w| !reveal_is_disabled(w));
            click(&mut window, "Reveal");
            let told = verdict(&window).expect("the answer");
            assert!(!has(&window, HIDDEN));
            let timed = question.answer.formulas().iter().any(|f| f.is_timed());
            if !timed {
                // The window measures what the command line does.
                let figures = measurer.measure(lesson, step, &Progress::new()).unwrap();
                let truth = match &question.answer {
                    Answer::Number { formula, .. } => {
                        formula.write(formula.value(&figures), Default::default())
                    }
                    Answer::Choice(choices) => choices[question.answer.right_choices(&figures)[0]]
                        .text
                        .clone(),
                };
                assert!(
                    told.ends_with(&format!("It is: {truth}.")),
                    "{told}, {truth}"
                );
            }
        }
        if place < last {
            click(&mut window, "Go on");
        }
    }
    assert!(asked >= 4);
    assert!(has(&window, &format!(" of {asked} predictions were right")));
    click(&mut window, "Leave the lesson");
    finish(&mut window);
    assert!(has(&window, "the tree in seven figures"));
    assert!(window.query_by_label("Leave the lesson").is_none());
    let mut lists = window.query_all_by_role(egui::accesskit::Role::ComboBox);
    assert!(lists.any(|list| list.value().as_deref() == Some("Scene: tetra:2")));
}

#[test]
fn every_lesson_can_be_taken_to_its_end() {
    assert!(!LESSONS.is_empty());
    for known in LESSONS {
        take_whole(&known.read());
    }
}

#[test]
fn keys_will_do() {
    let mut window = open(small("tetra:2"));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::J);
    window.run_steps(2);
    for known in LESSONS {
        assert!(has(&window, &known.read().title));
    }
    press(&mut window, Modifiers::COMMAND, Key::J);
    assert!(!has(&window, &LESSONS[1].read().title));

    press(&mut window, Modifiers::COMMAND, Key::K);
    window
        .get_by_label("Search for a command")
        .type_text("lesson one ray");
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(3);
    let lesson = LESSONS.iter().find(|l| l.name == "one-ray").unwrap().read();
    assert!(has(&window, &lesson.steps[0].title));
    // Nothing is told before there is a prediction.
    press(&mut window, Modifiers::ALT, Key::Enter);
    press(&mut window, Modifiers::ALT, Key::PageDown);
    assert!(has(&window, &lesson.steps[0].title) && verdict(&window).is_none());
    // The field has the focus.
    window.event(egui::Event::Text("12".into()));
    window.run_steps(2);
    wait(&mut window, "Reveal", |w| !reveal_is_disabled(w));
    press(&mut window, Modifiers::ALT, Key::Enter);
    window.run_steps(2);
    let told = verdict(&window).expect("the answer");
    assert_eq!(told, "Right. You predicted: 12. It is: 12.");
    press(&mut window, Modifiers::ALT, Key::PageDown);
    assert!(has(&window, &lesson.steps[1].title));
    press(&mut window, Modifiers::ALT, Key::PageUp);
    window.run_steps(2);
    // What was told stays so.
    assert_eq!(verdict(&window), Some(told));
    press(&mut window, Modifiers::COMMAND, Key::J);
    finish(&mut window);
    assert!(!has(&window, &lesson.steps[0].title));
}

#[test]
fn what_was_there_comes_back() {
    let mut start = small("balls:1");
    start.setup.build.n_oilf = 3;
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait(&mut window, "both", |w| has(w, "May be compared"));
    click(&mut window, "Tree B");
    press(&mut window, Modifiers::COMMAND, Key::M);
    wait(&mut window, "both", |w| {
        has(w, "B: balls:1 · sah-cut") && has(w, "May be compared")
    });
    let settings = |window: &Window<'_>| -> Vec<String> {
        let sides = ["A: balls:1", "B: balls:1"];
        let nodes = sides.map(|side| window.get_by_label_contains(side));
        let nodes = nodes.iter();
        nodes.map(|n| n.accesskit_node().label().unwrap()).collect()
    };
    let before = settings(&window);
    assert!(before[0].contains("N_OILF 3"), "{before:?}");
    press(&mut window, Modifiers::COMMAND, Key::K);
    window
        .get_by_label("Search for a command")
        .type_text("lesson empty space");
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(3);
    wait(&mut window, "measured", |w| !has(w, "measuring …"));
    assert!(window.query_by_label("Tree B").is_none(), "one tree alone");
    // Other settings than the step's are pointed out, and can be set back.
    window
        .get_by_role_and_label(egui::accesskit::Role::SpinButton, "N_OILF")
        .set_value_accesskit(5.0);
    wait(&mut window, "changed", |w| has(w, "no longer the step's"));
    click(&mut window, "Set them again");
    wait(&mut window, "set back", |w| !has(w, "no longer the step's"));
    click(&mut window, "Leave the lesson");
    wait(&mut window, "both", |w| {
        has(w, "B: balls:1 · sah-cut") && has(w, "May be compared")
    });
    finish(&mut window);
    assert_eq!(settings(&window), before);
}

#[test]
fn a_file_that_is_no_lesson_is_told_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.md");
    let text = "+++\ntitle = \"Mine\"\nabout = \"A\"\n+++\n# S\n```toml\nscene = \"tetra:1\"\n\
                a = \"method=none\"\npanes = [\"Inline\"]\n```\nText\n";
    std::fs::write(&path, text).unwrap();
    let mut window = open(small("tetra:2"));
    press(&mut window, Modifiers::COMMAND, Key::J);
    let enter = |window: &mut Window<'_>| {
        window.run_steps(2);
        let field = window.get_by_label("Path of a lesson");
        field.focus();
        window.run_steps(2);
        window
            .get_by_label("Path of a lesson")
            .type_text(path.to_str().unwrap());
        window.run_steps(2);
        window.key_press(Key::Enter);
        window.run_steps(4);
    };
    enter(&mut window);
    assert!(has(&window, "mine.md:9: no pane is called 'Inline'"));
}

#[test]
fn the_hint_comes_once_and_never_again() {
    const HINT: &str = "Three things to try";
    let folder = tempfile::tempdir().unwrap();
    let start = || {
        let mut start = small("tetra:2");
        start.remember = true;
        start.settings_folder = Some(folder.path().to_owned());
        start
    };
    let first = LESSONS[0].read();
    {
        let mut window = open(start());
        window.run_steps(3);
        assert!(has(&window, HINT));
        assert!(has(&window, "Ctrl+M") && has(&window, "Ctrl+E"));
        // Looked at, but not dismissed.
    }
    {
        let mut window = open(start());
        window.run_steps(3);
        click(&mut window, &format!("First lesson: {}", first.title));
        window.run_steps(3);
        assert!(has(&window, &first.steps[0].title) && !has(&window, HINT));
    }
    let mut window = open(start());
    window.run_steps(3);
    assert!(!has(&window, HINT), "dismissed");

    std::fs::remove_file(folder.path().join("hint.json")).unwrap();
    let mut window = open(start());
    window.run_steps(3);
    assert!(has(&window, HINT));
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(2);
    assert!(!has(&window, HINT));
    let mut window = open(start());
    window.run_steps(3);
    assert!(!has(&window, HINT), "Esc dismisses it, too");
    // Nothing is remembered: a hint could not be dismissed for good, so there is none.
    let mut window = open(small("tetra:2"));
    window.run_steps(3);
    assert!(!has(&window, HINT));
}

#[test]
fn the_list_stands_in_the_place_of_the_settings() {
    let mut window = open(small("tetra:2"));
    finish(&mut window);
    assert!(has(&window, "Root margin"));
    click(&mut window, "Lessons");
    wait(&mut window, "the list", |w| {
        has(w, &LESSONS[0].read().title)
    });
    assert!(!has(&window, "Root margin"));
    click(&mut window, "Close");
    wait(&mut window, "the settings", |w| has(w, "Root margin"));
}
