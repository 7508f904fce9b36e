//! Lessons in the window: a panel on the left that lists them and takes one, step by step. Until
//! there is a prediction, no figures are shown; leaving a lesson brings back what was there before.

mod panel;
mod running;

use crate::gui::action::actions;
use crate::gui::document::Document;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::lesson::{LESSONS, Lesson};
use egui_commonmark::CommonMarkCache;
use running::Running;

/// The list of lessons and the one that is taken.
#[derive(Default)]
pub struct LessonPane {
    running: Option<Running>,
    /// What is typed as the path of a lesson.
    path: String,
    /// Why a lesson could not be opened.
    failure: Option<String>,
    markdown: CommonMarkCache,
}

impl Pane for LessonPane {
    const ID: &'static str = "lesson";
    const TITLE: &'static str = "Lesson";
    const ABOUT: &'static str = "Guided tours that ask for a prediction, then measure.";
    const SHOWS_FIGURES: bool = false;
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "lesson.open" Everywhere COMMAND [J] "List the lessons, or exit the current one" typing => |pane, cx| {
            if pane.running.is_some() {
                pane.leave(cx);
            } else {
                cx.edits.request(Request::Task("lessons"));
            }
        };
        "lesson.check" Everywhere ALT [Enter] "Lesson: check your prediction" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.reveal(cx);
            }
        };
        "lesson.next" Everywhere ALT [PageDown] "Lesson: go to the next step" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.next(cx);
            }
        };
        "lesson.back" Everywhere ALT [PageUp] "Lesson: go to the previous step" typing => |pane, cx| {
            if let Some(running) = &mut pane.running {
                running.back(cx);
            }
        };
    };

    fn update(&mut self, cx: &mut Cx<'_>) {
        self.take_dropped(cx.ctx, cx.doc);
        if let Some(lesson) = cx.doc.next_lesson.take() {
            self.leave(cx);
            match Running::begin(lesson, cx) {
                Ok(running) => {
                    self.failure = None;
                    self.running = Some(running);
                }
                Err(error) => self.failure = Some(error.to_string()),
            }
            cx.edits.request(Request::Task("lessons"));
        }
        if let Some(running) = &mut self.running {
            running.follow(cx);
        }
        cx.doc.in_lesson = self.running.is_some();
        cx.doc.hides_figures = self.running.as_ref().is_some_and(Running::asks);
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        panel::show(self, ui, cx);
    }

    fn choices(&self) -> Vec<String> {
        let titles = LESSONS.iter().map(|known| known.read().title);
        titles.map(|title| format!("Lesson: {title}")).collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        cx.doc.next_lesson = LESSONS.get(place).map(|known| known.read());
    }
}

impl LessonPane {
    /// Opens a lesson's file; what is wrong with it is told in the panel.
    fn open(&mut self, path: &str, doc: &mut Document) {
        match Lesson::open(path) {
            Ok(lesson) => {
                self.failure = None;
                doc.next_lesson = Some(lesson);
            }
            Err(error) => self.failure = Some(error.to_string()),
        }
    }

    /// Takes a lesson that was dropped onto the window; other files stay for others.
    fn take_dropped(&mut self, ctx: &egui::Context, doc: &mut Document) {
        let dropped = ctx.input_mut(|input| {
            let files = &mut input.raw.dropped_files;
            let extension = |i: usize| files[i].path().extension();
            let place = (0..files.len()).find(|&i| extension(i).is_some_and(|e| e == "md"))?;
            Some(files.remove(place).path().to_owned())
        });
        if let Some(path) = dropped {
            self.open(&path.to_string_lossy(), doc);
        }
    }

    /// Ends the lesson, if there is one; all is as before it.
    fn leave(&mut self, cx: &mut Cx<'_>) {
        if let Some(running) = self.running.take() {
            running.restore(cx);
            cx.doc.in_lesson = false;
            cx.doc.hides_figures = false;
        }
    }
}
