//! Two trees of a scene: whether they may be compared, and their figures beside each other, with the
//! change from A to B.

mod gate;
mod sides;
mod table;

use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::pane::{Cx, Pane};
use crate::measure::{ACROSS_STRUCTURES, DELTA, LAMBDA, parameter, parameters};
use crate::trace::RayKind;
use table::Sides;

/// The comparison of A and B.
#[derive(Default)]
pub struct ComparisonPane {
    /// Whether all parameters are listed, or Δ and Λ alone.
    all_figures: bool,
    /// Whether what rays did is listed by kind of ray, too.
    per_kind: bool,
}

impl Pane for ComparisonPane {
    const ID: &'static str = "comparison";
    const TITLE: &'static str = "Comparison";
    const ALIASES: &'static [&'static str] = &["A and B"];
    const ABOUT: &'static str = "The figures of A and B, and whether the comparison is fair.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        if doc.other.is_none() {
            let about = "A second tree of the same scene, seen by the same camera, with settings of \
                         its own.";
            if ui
                .button("Compare with another tree")
                .on_hover_text(tip(about, "window.compare"))
                .clicked()
            {
                cx.edits.add(Document::compare_or_not);
            }
            return;
        }
        let verdict = doc.verdict(cx.ctx);
        sides::show(ui, doc, cx.edits);
        ui.separator();
        gate::show(ui, doc, verdict.as_deref(), cx.edits);
        ui.separator();
        ui.horizontal(|ui| {
            ui.checkbox(&mut self.all_figures, "All figures")
                .on_hover_text("All of the paper's Tables 1 to 3, or Δ and Λ alone.");
            ui.checkbox(&mut self.per_kind, "Per kind of ray")
                .on_hover_text(
                    "What primary, shadow, reflected and refracted rays did: all together, per ray, \
                     and the ray with the most.",
                );
        });
        let sides = Sides {
            both: Which::BOTH.map(|which| doc.figures(which)),
            // Until the verdict is there, the changes are those of before.
            are_comparable: verdict.is_none_or(|verdict| verdict.reasons.is_empty()),
        };
        if self.all_figures {
            sides.parameters(ui, parameters().iter());
        } else {
            let across: &[&str] = if sides.have_same_nodes() {
                &[]
            } else {
                &ACROSS_STRUCTURES
            };
            let symbols = DELTA.iter().chain(across).chain(&LAMBDA);
            sides.parameters(ui, symbols.map(|symbol| parameter(symbol)));
        }
        if self.per_kind {
            for kind in RayKind::ALL {
                sides.rays(ui, kind);
            }
        }
    }
}
