//! Lessons: a column that lists them and shows the step that is taken. What a step asks for is hidden
//! until the prediction is checked; leaving a lesson brings back what was there before.

mod ask;
mod asked;
mod list;
mod running;
mod scale;
mod step;

use crate::gui::action::actions;
use crate::gui::document::Document;
use crate::gui::edits::{Edits, Request};
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::lesson::{LESSONS, Lesson};
use asked::Asked;
use list::List;
use running::Running;

/// The list of lessons and the one that is taken.
#[derive(Default)]
pub struct LessonPane {
    running: Option<Running>,
    list: List,
}

impl Pane for LessonPane {
    const ID: &'static str = "lesson";
    const TITLE: &'static str = "Lesson";
    const ABOUT: &'static str = "Guided tours that ask for a prediction, then measure.";
    const REVEALS: &'static [Fact] = &[];
    const FILLS: bool = true;
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "lesson.open" Everywhere COMMAND [J] "List the lessons, or exit the current one" typing => |pane, cx| {
            if pane.running.is_some() {
                pane.leave(cx.edits);
            } else {
                cx.edits.request(Request::Task("lessons"));
            }
        };
        "lesson.check" Lesson ALT [Enter] "Lesson: check your prediction" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.check(cx);
            }
        };
        "lesson.next" Lesson NONE [PageDown] "Lesson: go to the next step" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.next(cx);
            }
        };
        "lesson.back" Lesson NONE [PageUp] "Lesson: go to the previous step" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.back(cx);
            }
        };
    };

    fn update(&mut self, cx: &mut Cx<'_>) {
        self.take_dropped(cx.ctx, cx.edits);
        if let Some(lesson) = cx.doc.next_lesson.clone() {
            cx.edits.add(|doc| doc.next_lesson = None);
            self.begin(lesson, cx);
        }
        if let Some(running) = &mut self.running {
            running.follow(cx);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let margin = egui::Margin::symmetric(12, 8);
        let frame = egui::Frame::new().inner_margin(margin);
        let shown = frame.show(ui, |ui| match &mut self.running {
            Some(running) => step::show(running, ui, cx.doc),
            None => self.list.show(ui),
        });
        if let Some(asked) = shown.inner {
            self.obey(asked, cx);
        }
    }

    fn choices(&self) -> Vec<String> {
        let titles = LESSONS.iter().map(|known| known.read().title);
        titles.map(|title| format!("Lesson: {title}")).collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        start(place, cx.edits);
    }
}

/// Starts a lesson that comes with the program, by its place in the list.
fn start(place: usize, edits: &mut Edits) {
    let lesson = LESSONS.get(place).map(|known| known.read());
    edits.add(|doc| doc.next_lesson = lesson);
}

impl LessonPane {
    /// Does what was asked for in the column.
    fn obey(&mut self, asked: Asked, cx: &mut Cx<'_>) {
        match (asked, &mut self.running) {
            (Asked::Back, Some(running)) => running.back(cx),
            (Asked::Check, Some(running)) => running.check(cx),
            (Asked::Next, Some(running)) => running.next(cx),
            (Asked::SetUp, Some(running)) => running.set_up(cx),
            (Asked::Back | Asked::Check | Asked::Next | Asked::SetUp, None) => {}
            (Asked::Leave, _) => self.leave(cx.edits),
            (Asked::Begin(place), _) => start(place, cx.edits),
            (Asked::Open(path), _) => self.open(&path, cx.edits),
        }
    }

    /// Begins a lesson in the place of the one that is taken, if there is one.
    fn begin(&mut self, lesson: Lesson, cx: &mut Cx<'_>) {
        let before = self.running.take().map(Running::into_before);
        match Running::begin(lesson, before, cx) {
            Ok(running) => {
                self.list.failure = None;
                self.running = Some(running);
            }
            Err(error) => self.list.failure = Some(error.to_string()),
        }
        cx.edits.request(Request::Task("lessons"));
    }

    /// Opens a lesson's file; the column tells what is wrong with it.
    fn open(&mut self, path: &str, edits: &mut Edits) {
        match Lesson::open(path) {
            Ok(lesson) => {
                self.list.failure = None;
                edits.add(|doc: &mut Document| doc.next_lesson = Some(lesson));
            }
            Err(error) => self.list.failure = Some(error.to_string()),
        }
    }

    /// Takes a lesson that was dropped onto the window; other files stay for others.
    fn take_dropped(&mut self, ctx: &egui::Context, edits: &mut Edits) {
        let dropped = ctx.input_mut(|input| {
            let files = &mut input.raw.dropped_files;
            let extension = |i: usize| files[i].path().extension();
            let place = (0..files.len()).find(|&i| extension(i).is_some_and(|e| e == "md"))?;
            Some(files.remove(place).path().to_owned())
        });
        if let Some(path) = dropped {
            self.open(&path.to_string_lossy(), edits);
        }
    }

    /// Ends the lesson, if there is one; all is as before it.
    fn leave(&mut self, edits: &mut Edits) {
        if let Some(running) = self.running.take() {
            running.into_before().restore(edits);
        }
    }
}
