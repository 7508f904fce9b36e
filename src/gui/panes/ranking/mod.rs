//! The trees that the search for the best one has measured, the best first.

mod sentence;
mod table;
mod uses;

use crate::gui::document::Document;
use crate::gui::document::tuning::Found;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Pane};
use crate::gui::theme::{hint, strong};
use crate::gui::widgets::common::{busy, no_picture};
use egui::{Align, Layout, vec2};
use uses::{copy, use_this};

#[derive(Default)]
pub struct RankingPane;

impl Pane for RankingPane {
    const ID: &'static str = "ranking";
    const TITLE: &'static str = "Ranking";
    const ABOUT: &'static str = "The trees that were measured for this scene, the best first.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let found = doc.tuning.study.found().cloned();
        let Some(found) = found.filter(|found| !found.rows.is_empty()) else {
            if doc.current.is_none() {
                no_picture(ui, doc);
            } else if doc.tuning.study.is_running() {
                busy(ui, "Measuring the first method…");
            } else {
                ui.weak(
                    "Which tree renders this scene fastest? Press \"Find the best tree\": all methods are \
                     measured with many settings, and the better ones more and more often.",
                );
            }
            return;
        };
        recommended(ui, doc, &found, cx.edits);
        table::show(ui, doc, &found, cx.edits);
    }
}

/// What is recommended, with buttons that use it.
fn recommended(ui: &mut egui::Ui, doc: &Document, found: &Found, edits: &mut Edits) {
    let Some(best) = found.best() else {
        return;
    };
    // Two lines for the sentence, so that nothing moves while it changes.
    let size = vec2(ui.available_width(), 44.0);
    let to_the_left = Layout::right_to_left(Align::Center);
    ui.allocate_ui_with_layout(size, to_the_left, |ui| {
        ui.set_min_size(size);
        let so_far = if doc.tuning.study.is_running() {
            "Best so far: "
        } else {
            ""
        };
        let text = format!("{so_far}{}", sentence::recommendation(found, best));
        if ui
            .button("Copy command")
            .on_hover_text("Copy the command that measures these settings.")
            .clicked()
        {
            copy(best, edits);
        }
        if ui
            .button("Use the best tree")
            .on_hover_text("Build the tree on view with these settings.")
            .clicked()
        {
            use_this(best, edits);
        }
        let size = ui.available_size();
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.add(egui::Label::new(strong(text)).wrap());
        });
    });
    ui.label(hint(sentence::conditions(found)));
}
