//! Lessons in the window: a panel on the left that lists them and takes one, step by step. Until
//! there is a prediction, no figures are shown; leaving a lesson brings back what was there before.

mod panel;
mod running;

use super::heat::HeatView;
use super::layout::Layout;
use super::shortcuts::Action;
use super::state::State;
use crate::lesson::{LESSONS, Lesson};
use egui_commonmark::CommonMarkCache;
use running::Running;

/// What a lesson sets and brings back.
pub struct Around<'a> {
    pub state: &'a mut State,
    pub layout: &'a mut Layout,
    pub heat: &'a mut HeatView,
}

/// The list of lessons and the one that is taken.
#[derive(Default)]
pub struct Lessons {
    /// Whether the list is shown while none is taken.
    listed: bool,
    running: Option<Running>,
    /// A lesson that is to begin with the next frame.
    next: Option<Lesson>,
    /// What is typed as the path of a lesson.
    path: String,
    /// Why a lesson could not be opened.
    failure: Option<String>,
    markdown: CommonMarkCache,
}

impl Lessons {
    /// Begins with a lesson, if there is one.
    pub fn new(first: Option<Lesson>) -> Self {
        Lessons {
            next: first,
            ..Lessons::default()
        }
    }

    /// Whether a lesson is being taken.
    pub fn is_on(&self) -> bool {
        self.running.is_some() || self.next.is_some()
    }

    /// Whether the list of lessons is open.
    pub fn is_listed(&self) -> bool {
        self.listed
    }

    /// Whether figures are to be hidden: a prediction is asked for.
    pub fn hides_figures(&self) -> bool {
        self.running.as_ref().is_some_and(Running::asks)
    }

    /// Takes a lesson of those that come with the program, by its place.
    pub fn take(&mut self, place: usize) {
        self.next = LESSONS.get(place).map(|known| known.read());
    }

    /// Opens a lesson's file; what is wrong with it is told in the panel.
    fn open(&mut self, path: &str) {
        match Lesson::open(path) {
            Ok(lesson) => {
                self.failure = None;
                self.next = Some(lesson);
            }
            Err(error) => {
                self.failure = Some(error.to_string());
                self.listed = true;
            }
        }
    }

    /// Takes a lesson that was dropped onto the window; other files stay for others.
    pub fn take_dropped(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input_mut(|input| {
            let files = &mut input.raw.dropped_files;
            let extension = |i: usize| files[i].path().extension();
            let place = (0..files.len()).find(|&i| extension(i).is_some_and(|e| e == "md"))?;
            Some(files.remove(place).path().to_owned())
        });
        if let Some(path) = dropped {
            self.open(&path.to_string_lossy());
        }
    }

    /// Does what keys or the palette ask for.
    pub fn act(&mut self, action: Action, around: &mut Around<'_>) {
        match (action, &mut self.running) {
            (Action::Lessons, Some(_)) => self.leave(around),
            (Action::Lessons, None) => self.listed ^= true,
            (Action::LessonReveal, Some(running)) => running.reveal(around),
            (Action::LessonNext, Some(running)) => running.next(around),
            (Action::LessonBack, Some(running)) => running.back(around),
            _ => {}
        }
    }

    /// Ends the lesson that is taken, if there is one; all is as before it.
    pub fn leave(&mut self, around: &mut Around<'_>) {
        if let Some(running) = self.running.take() {
            running.restore(around);
        }
    }

    /// Shows the panel, and follows what the window has measured.
    pub fn show(&mut self, ui: &mut egui::Ui, around: &mut Around<'_>) {
        if let Some(lesson) = self.next.take() {
            self.leave(around);
            match Running::begin(lesson, around) {
                Ok(running) => self.running = Some(running),
                Err(error) => self.failure = Some(error.to_string()),
            }
            self.listed = false;
        }
        if let Some(running) = &mut self.running {
            running.follow(around);
        }
        if self.running.is_some() || self.listed || self.failure.is_some() {
            egui::Panel::left("lessons")
                .default_size(350.0)
                .size_range(260.0..=560.0)
                .show(ui, |ui| panel::show(self, ui, around));
        }
    }
}
