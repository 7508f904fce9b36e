//! The trees that the search for the best one has measured, the best first.

mod sentence;
mod table;

use crate::gui::document::Document;
use crate::gui::document::tuning::Found;
use crate::gui::edits::{Edits, Request};
use crate::gui::pane::{Cx, Pane};
use crate::gui::theme::{heading, hint};
use crate::gui::widgets::common::{busy, no_picture};
use crate::measure::tune::Row;
use crate::setup::measure_command;

#[derive(Default)]
pub struct RankingPane;

impl Pane for RankingPane {
    const ID: &'static str = "ranking";
    const TITLE: &'static str = "Ranking";
    const ABOUT: &'static str = "The trees that were measured for this scene, the best first.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc: &Document = cx.doc;
        let found = doc.tuning.study.found().cloned();
        let Some(found) = found.filter(|found| !found.rows.is_empty()) else {
            if doc.current.is_none() {
                no_picture(ui, doc);
            } else if doc.tuning.study.is_running() {
                busy(ui, "Measuring the first method…");
            } else {
                ui.weak(
                    "Which tree renders this scene fastest? Press \"Find the best tree\": all methods are \
                     measured, then depth and leaf size of the best two.",
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
    ui.horizontal_wrapped(|ui| {
        let so_far = if doc.tuning.study.is_running() {
            "Best so far: "
        } else {
            ""
        };
        let text = format!("{so_far}{}", sentence::recommendation(found, best));
        ui.label(heading(text));
        if ui
            .button("Use the best tree")
            .on_hover_text("Build the tree on view with these settings.")
            .clicked()
        {
            use_this(best, edits);
        }
        if ui
            .button("Copy command")
            .on_hover_text("Copy the command that measures these settings.")
            .clicked()
        {
            copy(best, edits);
        }
    });
    ui.label(hint(sentence::conditions(found)));
}

fn use_this(row: &Row, edits: &mut Edits) {
    let setup = row.setup.clone();
    edits.add(move |doc| doc.use_tree_of(setup));
}

fn copy(row: &Row, edits: &mut Edits) {
    edits.request(Request::Copy(measure_command(&row.setup)));
}
