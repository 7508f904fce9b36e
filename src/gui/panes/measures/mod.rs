//! Which measure predicts time in this scene: the measures, ranked by how much of the times of over a hundred
//! structures they explain, for a chosen set of rays and kernel.

mod study;
mod table;

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::theme::hint;
use crate::gui::widgets::common::{busy, no_picture};
use crate::gui::widgets::study_bar;
use crate::measure::study::{Judged, KERNELS, Outcome, RayOrigin};
use crate::present::number::{Digits, counted, grouped};
use crate::present::report::study::paragraph;
use study::Studying;
use table::By;

#[derive(Default)]
pub struct MeasuresPane {
    studying: Studying,
    /// Place in [`RayOrigin::ALL`].
    origin: usize,
    /// Place in [`KERNELS`].
    kernel: usize,
    by: By,
}

impl Pane for MeasuresPane {
    const ID: &'static str = "measures";
    const TITLE: &'static str = "Measures and time";
    const ABOUT: &'static str = "Which measure predicts the time of tracing rays in this scene.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "measures.run" Here NONE [Enter] "Find which measure predicts time; Esc ends it" => |pane, cx| pane.studying.start(cx.doc);
        "measures.next-rays" Here NONE [W] "Show the next set of rays" => |pane, _| pane.origin = (pane.origin + 1) % RayOrigin::ALL.len();
        "measures.next-kernel" Here NONE [C] "Show the next kernel" => |pane, _| pane.kernel = (pane.kernel + 1) % KERNELS.len();
        "measures.next-order" Here NONE [E] "Rank measures by the next figure" => |pane, _| pane.by = By::ALL[(pane.by as usize + 1) % By::ALL.len()];
    };

    fn update(&mut self, _: &mut Cx<'_>) {
        self.studying.receive();
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        ui.horizontal_wrapped(|ui| self.toolbar(ui, doc));
        let Some(outcome) = self.studying.outcome() else {
            if doc.current.is_none() {
                no_picture(ui, doc);
            } else if let Some(status) = self.studying.study.status() {
                busy(ui, &status.stage);
            } else {
                ui.weak(
                    "Which measure predicts time? Primary, shadow, reflected and random rays are traced in over a \
                     hundred structures of this scene, and every measure is judged by how much of the times it \
                     explains, and by its errors on structures left out of its fit. This takes minutes.",
                );
            }
            return;
        };
        ui.horizontal_wrapped(|ui| self.choices(ui));
        let (origin, kernel) = (RayOrigin::ALL[self.origin], KERNELS[self.kernel]);
        let Some(judged) = outcome.judged(origin, kernel) else {
            ui.weak(format!("The picture has no {} rays.", origin.name()));
            return;
        };
        ui.label(hint(conditions(&outcome, judged)))
            .on_hover_text(paragraph(&outcome));
        if judged.scores.is_empty() {
            ui.weak("Too few structures differ. Choose a larger scene.");
            return;
        }
        table::show(ui, &judged.scores, self.by);
    }
}

impl MeasuresPane {
    fn toolbar(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let words = [
            "Cancel study",
            "Cancel the study; it has no result before its end.",
            "waiting for the picture",
        ];
        if study_bar::running(ui, &mut self.studying.study, words) {
            return;
        }
        let run = egui::Button::new("Study measures");
        let about = "Trace rays in over a hundred structures of the scene on view with every kernel, in the background, \
                     while nothing else is measured.";
        if ui
            .add_enabled(self.studying.may_start(doc), run)
            .on_hover_text(tip(about, "measures.run"))
            .on_disabled_hover_text("Needs a finished picture of a scene with objects.")
            .clicked()
        {
            self.studying.start(doc);
        }
        for (value, most, suffix, name, about) in [
            (
                &mut self.studying.rays,
                1_000_000,
                " rays",
                "Rays per set",
                "Rays per set: as many primary, shadow, reflected and random rays are traced.",
            ),
            (
                &mut self.studying.rounds,
                1000,
                " rounds",
                "Rounds of the study",
                "Rounds in which every structure is timed once. The time is the median.",
            ),
        ] {
            let edit = egui::DragValue::new(value).range(1..=most).speed(0.1);
            ui.add(edit.suffix(suffix))
                .accessible_name(name)
                .on_hover_text(about);
        }
        study_bar::ended(ui, &self.studying.study, "cancelled");
    }

    /// What is shown of the outcome.
    fn choices(&mut self, ui: &mut egui::Ui) {
        for (place, origin) in RayOrigin::ALL.into_iter().enumerate() {
            ui.selectable_value(&mut self.origin, place, origin.name())
                .on_hover_text(tip("The rays that were traced.", "measures.next-rays"));
        }
        ui.separator();
        for (place, kernel) in KERNELS.into_iter().enumerate() {
            ui.selectable_value(&mut self.kernel, place, kernel.name())
                .on_hover_text(tip("The kernel that was timed.", "measures.next-kernel"));
        }
        ui.separator();
        for by in By::ALL {
            ui.selectable_value(&mut self.by, by, format!("by {}", by.name()))
                .on_hover_text(tip(
                    "The figure by which measures are ranked.",
                    "measures.next-order",
                ));
        }
    }
}

/// What was measured.
fn conditions(outcome: &Outcome, judged: &Judged) -> String {
    format!(
        "{} · {} · {} rays · {} · {} · times differ by {} from round to round",
        outcome.scene,
        counted(outcome.observations.len(), "structure"),
        grouped(judged.rays as f64),
        outcome.precision.name(),
        counted(outcome.rounds, "round"),
        Digits::Three.percent(judged.spread)
    )
}
