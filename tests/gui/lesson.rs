//! Lessons in the window: each is taken from its first step to its last, by mouse and by keys.

use crate::harness::{Window, click, described, has, open, open_sized, press, small, wait};
use bspscope::lesson::{Answer, Figures, LESSONS, Lesson, Measurer, Question, Step};
use bspscope::progress::Progress;
use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};

const HIDDEN: &str = "Hidden until you check your prediction";

/// A window that opens with a lesson.
fn taking(lesson: &Lesson) -> Window<'static> {
    let mut start = small("tetra:2");
    start.lesson = Some(lesson.clone());
    let mut window = open_sized(start, [1600.0, 1000.0], false);
    window.run_steps(3);
    window
}

fn named(name: &str) -> Lesson {
    let known = LESSONS.iter().find(|lesson| lesson.name == name);
    known.expect("a lesson of this name").read()
}

fn finish(window: &mut Window<'_>) {
    wait(window, "the picture", |w| w.state().is_finished());
}

/// Waits until the step is measured.
fn measure(window: &mut Window<'_>) {
    wait(window, "the figures", |w| !has(w, "measuring…"));
}

fn check_is_disabled(window: &Window<'_>) -> bool {
    let button = window.get_by_label("Check");
    button.accesskit_node().is_disabled()
}

/// Predicts something, right or wrong.
fn predict(window: &mut Window<'_>, question: &Question) {
    match &question.answer {
        Answer::Number { .. } => type_number(window, "1000000"),
        Answer::Choice(choices) => click_in_column(window, &choices[0].text),
    }
    window.run_steps(3);
}

/// Runs the command that the palette finds first.
fn run_command(window: &mut Window<'_>, command: &str) {
    press(window, Modifiers::COMMAND, Key::K);
    let field = window.get_by_label("Search for a command");
    field.type_text(command);
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(3);
}

fn type_number(window: &mut Window<'_>, number: &str) {
    window.get_by_label("Your prediction").focus();
    window.run_steps(2);
    window.get_by_label("Your prediction").type_text(number);
    window.run_steps(2);
}

/// The line that tells what became of the prediction.
fn verdict(window: &Window<'_>) -> Option<String> {
    let mut nodes = window.query_all_by_label_contains(": you said ");
    let node = nodes.find(|node| node.accesskit_node().role() == Role::Label)?;
    node.accesskit_node().label().or(node.value())
}

/// The answer as the lesson measures it without a window; `None` where times decide.
fn truth(question: &Question, figures: &Figures) -> Option<String> {
    if question.answer.formulas().iter().any(|f| f.is_timed()) {
        return None;
    }
    Some(match &question.answer {
        Answer::Number { formula, .. } => formula.write(formula.value(figures), Default::default()),
        Answer::Choice(choices) => {
            let right = question.answer.right_choices(figures);
            choices[right[0]].text.clone()
        }
    })
}

/// Clicks in the lesson's column; other places have such a button, too.
fn click_in_column(window: &mut Window<'_>, label: &str) {
    let of_lesson = |node: &egui_kittest::Node<'_>| node.rect().right() < 420.0;
    let button = window.query_all_by_label(label).find(of_lesson);
    button.expect("a button of the column").click();
    window.run_steps(3);
}

fn take_whole(lesson: &Lesson) {
    let mut window = taking(lesson);
    let mut measurer = Measurer::default();
    let mut asked = 0;
    let last = lesson.steps.len() - 1;
    for (place, step) in lesson.steps.iter().enumerate() {
        let of = lesson.steps.len();
        assert!(has(&window, &step.title), "{}", step.title);
        let at = format!("{} of {of}", place + 1);
        assert!(window.query_by_label(&at).is_some(), "{at}");
        if let Some(question) = &step.question {
            asked += 1;
            measure(&mut window);
            assert!(check_is_disabled(&window), "no prediction yet");
            assert!(verdict(&window).is_none());
            let figures = measurer.measure(lesson, step, &Progress::new()).unwrap();
            assert_nothing_tells(&mut window, step, &figures);
            predict(&mut window, question);
            click(&mut window, "Check");
            let told = verdict(&window).expect("the answer");
            if let Some(truth) = truth(question, &figures) {
                // The window measures what the command line does.
                assert!(
                    told.ends_with(&format!("measured {truth}")),
                    "{told}, {truth}"
                );
            }
        }
        if place < last {
            click_in_column(&mut window, "Next");
        }
    }
    assert!(asked >= 4);
    assert!(has(&window, &format!(" of {asked} predictions were right")));
    click(&mut window, "Exit lesson");
    finish(&mut window);
    assert!(window.query_by_label("Exit lesson").is_none());
    assert!(has(&window, "tetra:2"));
}

/// Every text and value of the window outside the lesson's column and the top bar, which holds no figure.
fn texts(window: &Window<'_>) -> Vec<String> {
    let nodes = window.query_all(By::new().recursive(true));
    let outside = nodes.filter(|node| {
        let bounds = node.accesskit_node().raw_bounds();
        bounds.is_some_and(|bounds| bounds.x0 > 420.0 && bounds.y0 > 40.0)
    });
    let texts = outside.flat_map(|node| {
        let node = node.accesskit_node();
        [node.label(), node.value(), node.description()]
    });
    texts.flatten().collect()
}

/// The numbers in a text, as they are written.
fn numbers(text: &str) -> impl Iterator<Item = &str> {
    let belongs = |c: char| c.is_ascii_digit() || c == '.' || c == '\u{a0}';
    let pieces = text.split(move |c| !belongs(c));
    pieces.map(|piece| piece.trim_matches(['.', '\u{a0}']))
}

/// No pane tells a figure that decides the answer, whichever pane is opened.
fn assert_nothing_tells(window: &mut Window<'_>, step: &Step, figures: &Figures) {
    let question = step.question.as_ref().expect("a question");
    let names = question
        .answer
        .formulas()
        .into_iter()
        .flat_map(|f| f.names());
    // Small numbers stand everywhere, as settings and counts of panes.
    let secrets: Vec<String> = names
        .filter(|name| !name.is_given() && !name.is_timed())
        .filter_map(|name| Some(name.write(name.value(figures)?)))
        .filter(|text| text.len() > 1)
        .collect();
    for pane in [
        "Figures",
        "Comparison",
        "All figures",
        "Rays of the pixel",
        "Steps of the ray",
        "Outline",
        "Histograms",
    ] {
        run_command(window, &format!("show {pane}"));
        // Changes of times are in percent or with a unit of time, and could be any number.
        let is_of_time = |text: &String| text.contains('%') || text.ends_with('s');
        for text in texts(window).into_iter().filter(|text| !is_of_time(text)) {
            let told = secrets
                .iter()
                .find(|secret| numbers(&text).any(|n| n == *secret));
            assert_eq!(told, None, "{}: {pane} says {text}", step.title);
        }
    }
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
    press(&mut window, Modifiers::COMMAND, Key::Num1);
    assert!(!has(&window, &LESSONS[1].read().title));

    run_command(&mut window, "lesson one ray");
    let lesson = named("one-ray");
    assert!(has(&window, &lesson.steps[0].title));
    // Nothing is told before there is a prediction.
    press(&mut window, Modifiers::ALT, Key::Enter);
    press(&mut window, Modifiers::NONE, Key::PageDown);
    assert!(has(&window, &lesson.steps[0].title) && verdict(&window).is_none());
    // The field has the focus.
    window.event(egui::Event::Text("12".into()));
    window.run_steps(2);
    wait(&mut window, "Check", |w| !check_is_disabled(w));
    press(&mut window, Modifiers::ALT, Key::Enter);
    window.run_steps(2);
    let told = verdict(&window).expect("the answer");
    assert!(told.ends_with(": you said 12, measured 12"), "{told}");
    press(&mut window, Modifiers::NONE, Key::PageDown);
    assert!(has(&window, &lesson.steps[1].title));
    press(&mut window, Modifiers::NONE, Key::PageUp);
    window.run_steps(2);
    // What was told stays so.
    assert_eq!(verdict(&window), Some(told));
    press(&mut window, Modifiers::COMMAND, Key::J);
    finish(&mut window);
    assert!(!has(&window, &lesson.steps[0].title));
}

/// Presenter remotes send the page keys, which select rays elsewhere.
#[test]
fn page_keys_turn_steps_and_select_no_ray() {
    let lesson = named("one-ray");
    let place = lesson
        .steps
        .iter()
        .position(|s| s.title == "More than one ray");
    let place = place.expect("a step with several rays");
    let mut window = taking(&lesson);
    for step in &lesson.steps[..place] {
        measure(&mut window);
        predict(&mut window, step.question.as_ref().expect("a question"));
        click(&mut window, "Check");
        press(&mut window, Modifiers::NONE, Key::PageDown);
    }
    measure(&mut window);
    predict(&mut window, lesson.steps[place].question.as_ref().unwrap());
    click(&mut window, "Check");
    wait(&mut window, "the rays", |w| has(w, "Ray 1: primary"));
    let selected = |window: &Window<'_>| {
        let rays = window.query_all_by_label_contains("Ray ");
        let mut rays = rays.filter(|ray| ray.accesskit_node().is_selected() == Some(true));
        rays.next().and_then(|ray| ray.accesskit_node().label())
    };
    let before = selected(&window);
    press(&mut window, Modifiers::NONE, Key::PageDown);
    assert!(has(&window, &lesson.steps[place + 1].title));
    press(&mut window, Modifiers::NONE, Key::PageUp);
    wait(&mut window, "the rays", |w| has(w, "Ray 1: primary"));
    assert_eq!(selected(&window), before);
    // Without a lesson, the key selects the next ray.
    press(&mut window, Modifiers::COMMAND, Key::J);
    finish(&mut window);
    assert!(window.query_by_label("Next").is_none());
}

#[test]
fn the_column_is_wide_enough_to_be_read() {
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        let lesson = named("what-a-tree-saves");
        let mut start = small("tetra:2");
        start.lesson = Some(lesson.clone());
        let mut window = open_sized(start, size, false);
        window.run_steps(3);
        let text = window.get_by_label_contains("The picture shows a pyramid");
        let rect = text.rect();
        assert!(rect.width() > 340.0 && rect.right() < 420.0, "{rect:?}");
        let rows = (rect.height() / 26.0).round();
        assert!(rows >= 4.0 && (rect.height() - 26.0 * rows).abs() < 2.0);
        let picture = window.get_by_label("Traced picture").rect();
        let half = (size[0] - 420.0) / 2.0;
        assert!(picture.left() > 420.0 && (picture.width() - half).abs() < 30.0);
    }
}

/// A step about B has B in front, and then the 3D view, the heatmap and the panes are about it.
#[test]
fn what_the_text_is_about_is_in_front() {
    for (front, in_front) in [("", "Tree A"), ("front = \"b\"", "Tree B")] {
        let text = format!(
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n# S\n```toml\nscene = \"tetra:1\"\n\
             a = \"method=none\"\nb = \"method=midpoint\"\n{front}\n```\nText\n"
        );
        let mut window = taking(&Lesson::parse(&text, "t.md").unwrap());
        finish(&mut window);
        let button = window.get_by_label(in_front).accesskit_node();
        assert_eq!(button.toggled(), Some(Toggled::True), "{in_front}");
    }
}

#[test]
fn what_was_there_comes_back() {
    let mut start = small("balls:1");
    start.setup.build.n_oilf = 3;
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait(&mut window, "both", |w| w.state().is_finished());
    click(&mut window, "Bring B to the front");
    press(&mut window, Modifiers::COMMAND, Key::M);
    finish(&mut window);
    let before = described(&window);
    run_command(&mut window, "lesson empty space");
    measure(&mut window);
    assert!(window.query_by_label("Tree B").is_none(), "one tree alone");
    // Other settings than the step's are pointed out, and can be set back.
    run_command(&mut window, "leaf size: one object more");
    wait(&mut window, "changed", |w| {
        has(w, "You changed the settings")
    });
    click(&mut window, "Restore the step's settings");
    wait(&mut window, "set back", |w| {
        !has(w, "You changed the settings")
    });
    click(&mut window, "Exit lesson");
    finish(&mut window);
    assert!(window.query_by_label("Bring B to the front").is_some());
    assert_eq!(described(&window), before);
    let task = window.get_by_label("Compare").accesskit_node();
    assert_eq!(task.toggled(), Some(Toggled::True));
    assert!(window.query_by_label("Exit lesson").is_none());
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
    window.run_steps(2);
    window.get_by_label("Path of a lesson").focus();
    window.run_steps(2);
    window
        .get_by_label("Path of a lesson")
        .type_text(path.to_str().unwrap());
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(4);
    assert!(has(&window, "mine.md:9: no pane is called 'Inline'"));
}

#[test]
fn a_card_starts_its_lesson() {
    let mut window = open(small("tetra:2"));
    press(&mut window, Modifiers::COMMAND, Key::Num5);
    window.run_steps(2);
    let lesson = LESSONS[1].read();
    click(&mut window, &format!("Lesson: {}", lesson.title));
    window.run_steps(3);
    assert!(has(&window, &lesson.steps[0].title));
}

/// What is asked is hidden; what is not stays.
#[test]
fn only_what_is_asked_is_hidden() {
    let lesson = named("one-ray");
    let mut window = taking(&lesson);
    measure(&mut window);
    // A question about a ray.
    run_command(&mut window, "show rays of the pixel");
    assert!(has(&window, HIDDEN));
    run_command(&mut window, "show figures");
    assert!(!has(&window, HIDDEN));
    run_command(&mut window, "show rays of the pixel");
    predict(&mut window, lesson.steps[0].question.as_ref().unwrap());
    click(&mut window, "Check");
    assert!(!has(&window, HIDDEN));
}

#[test]
fn what_was_open_before_a_lesson_is_open_after_it() {
    let mut window = open(small("tetra:2"));
    finish(&mut window);
    let drawer = |w: &Window<'_>| has(w, "Root margin");
    let bottom = |w: &Window<'_>| w.query_by_label("Icicle of the tree").is_some();
    press(&mut window, Modifiers::COMMAND, Key::I);
    click(&mut window, "Icicle");
    wait(&mut window, "both", |w| drawer(w) && bottom(w));
    click(&mut window, "Lessons");
    let lesson = LESSONS[0].read();
    click(&mut window, &format!("Lesson: {}", lesson.title));
    wait(&mut window, "the lesson", |w| has(w, "Exit lesson"));
    click(&mut window, "Settings");
    click(&mut window, "Histograms");
    assert!(!drawer(&window) && !bottom(&window));
    click(&mut window, "Exit lesson");
    wait(&mut window, "both again", |w| drawer(w) && bottom(w));
}
