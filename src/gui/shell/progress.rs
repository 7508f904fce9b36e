//! How the work in progress stands, once it has taken long enough to be worth saying.

use crate::gui::document::Document;
use crate::gui::theme::tokens;
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::progress_ring::PATIENCE;
use egui::{Rect, vec2};

/// The work in progress.
#[derive(Default)]
pub struct WorkInProgress {
    /// When it began, in seconds.
    since: Option<f64>,
    /// What is done of it, 0 to 1, and its stage.
    now: Option<(f32, String)>,
}

impl WorkInProgress {
    /// Takes note of what is being worked on; once a frame.
    pub fn follow(&mut self, doc: &Document, ctx: &egui::Context) {
        let time = ctx.input(|i| i.time);
        let status = doc.work.as_ref().and_then(|work| work.status());
        let Some(status) = status else {
            *self = WorkInProgress::default();
            return;
        };
        let since = *self.since.get_or_insert(time);
        self.now = (time - since >= PATIENCE).then_some((status.fraction as f32, status.stage));
        // Jobs wake the window for results; progress in between is worth a look now and then.
        ctx.request_repaint_after_secs(0.1);
    }

    /// Such as "Counting 52 % · Esc stops"; `None` while there is nothing to say.
    pub fn text(&self) -> Option<String> {
        let (fraction, stage) = self.now.as_ref()?;
        let stage = sentence(stage);
        let percent = (fraction * 100.0).floor();
        Some(format!("{stage} {percent:.0}\u{a0}% · Esc stops"))
    }

    /// Draws a line along the top of a rectangle, as long as what is done.
    pub fn line(&self, ui: &egui::Ui, rect: Rect) {
        if let Some((fraction, _)) = self.now {
            let height = 3.0;
            let size = vec2(rect.width() * fraction, height);
            let bar = Rect::from_min_size(rect.left_top(), size);
            ui.painter().rect_filled(bar, 0.0, tokens(ui).accent);
        }
    }
}
