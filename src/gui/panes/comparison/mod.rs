//! Two trees of a scene: their figures in three columns, A, B and B/A, as in the paper's Table 5;
//! or why they may not be compared.

use crate::gui::action::tip;
use crate::gui::document::comparing::{Verdict, View, Which};
use crate::gui::document::{Current, Document};
use crate::gui::pane::{Cx, Pane};
use crate::gui::panes::figures::value;
use crate::gui::widgets::symbol::symbol;
use crate::measure::{
    DELTA, LAMBDA, Measurement, Parameter, Unequal, Unit, change, parameter, parameters,
    ray_figures,
};
use crate::trace::RayKind;

#[derive(Default)]
pub struct ComparisonPane;

impl Pane for ComparisonPane {
    const ID: &'static str = "comparison";
    const TITLE: &'static str = "Comparison";
    const ALIASES: &'static [&'static str] = &["A and B"];
    const ABOUT: &'static str = "The figures of A and B, and whether the comparison is fair.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        show(ui, cx.doc);
    }
}

fn show(ui: &mut egui::Ui, doc: &mut Document) {
    let about = "A second tree of the same scene, seen by the same camera, with settings of its \
                 own.";
    if doc.other.is_none() {
        if ui
            .button("Compare with another tree")
            .on_hover_text(tip(about, "window.compare"))
            .clicked()
        {
            doc.compare_or_not();
        }
        return;
    }
    sides(ui, doc);
    let verdict = doc.verdict(ui.ctx());
    gate(ui, doc, verdict.as_deref());
    ui.checkbox(&mut doc.comparing.all_parameters, "all parameters")
        .on_hover_text("All of the paper's Tables 1 to 3, or Δ and Λ alone.");
    ui.checkbox(&mut doc.comparing.per_kind, "per kind of ray")
        .on_hover_text(
            "What primary, shadow, reflected and refracted rays did: all together, a ray on average, \
             and the ray with the most.",
        );
    let [Some(a), Some(b)] = doc.both() else {
        return;
    };
    let may_compare = verdict.is_some_and(|verdict| verdict.reasons.is_empty());
    let rows: Vec<&'static Parameter> = if doc.comparing.all_parameters {
        parameters().iter().collect()
    } else {
        DELTA.iter().chain(&LAMBDA).map(|s| parameter(s)).collect()
    };
    columns(ui, &rows, [a, b], may_compare);
    if doc.comparing.per_kind {
        for kind in RayKind::ALL {
            of_kind(ui, kind, [a, b], may_compare);
        }
    }
}

/// The settings of both; the one chosen comes to the front.
fn sides(ui: &mut egui::Ui, doc: &mut Document) {
    for which in Which::BOTH {
        let settings = match doc.both()[which as usize] {
            Some(current) => current.settings_text(),
            None => "on its way".to_owned(),
        };
        let text = format!("{}: {settings}", which.name());
        let in_front = doc.which == which;
        let choice = ui
            .scope(|ui| {
                ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
                ui.radio(in_front, &text)
            })
            .inner
            .on_hover_text(tip(
                &format!("{text}\nThe one chosen is in front: settings and panels are about it."),
                "window.other-tree",
            ));
        if choice.clicked() {
            doc.show(which);
        }
    }
}

/// Whether they may be compared, and if not, why and what can be done.
fn gate(ui: &mut egui::Ui, doc: &mut Document, verdict: Option<&Verdict>) {
    let Some(verdict) = verdict else {
        ui.label("Waits until both pictures are finished.");
        return;
    };
    if verdict.reasons.is_empty() {
        ui.strong("May be compared")
            .on_hover_text("Parameters of class S and D are equal, and so is every pixel.");
        return;
    }
    ui.strong("May not be compared").on_hover_text(
        "The paper's precondition: parameters of class S and D are equal, and so is the picture.",
    );
    for reason in &verdict.reasons {
        ui.add(egui::Label::new(format!("• {reason}")).wrap());
    }
    ui.horizontal_wrapped(|ui| {
        let unlike = verdict
            .reasons
            .iter()
            .any(|reason| !matches!(reason, Unequal::Pixels { .. }));
        let which = doc.which.name();
        if ui
            .add_enabled(unlike, egui::Button::new("Make conditions equal"))
            .on_hover_text(format!(
                "Take {which}'s settings of scene and picture for both; the trees stay different."
            ))
            .clicked()
            && let Some(other) = &mut doc.other
        {
            other.wanted.scene = doc.wanted.scene.clone();
            other.wanted.render = doc.wanted.render;
        }
        let some = !verdict.pixels.is_empty();
        if ui
            .add_enabled(some, egui::Button::new("Show the pixels"))
            .on_hover_text("Darken the picture but for the pixels that differ.")
            .clicked()
        {
            doc.comparing.view = View::Difference;
            doc.comparing.asks_for_pixels = true;
        }
    });
}

fn columns(ui: &mut egui::Ui, rows: &[&'static Parameter], [a, b]: [&Current; 2], may: bool) {
    egui::Grid::new("A and B")
        .num_columns(4)
        .striped(true)
        .show(ui, |ui| {
            titles(ui);
            for &p in rows {
                symbol(ui, p, &a.shown.measurement);
                value(ui, p, a);
                value(ui, p, b);
                let [of_a, of_b] = [a, b].map(|side| p.value(&side.shown.measurement));
                relation(ui, p.unit, of_a, of_b, may);
                ui.end_row();
            }
        });
}

/// What the rays of a kind did; nothing where there are none.
fn of_kind(ui: &mut egui::Ui, kind: RayKind, both: [&Current; 2], may: bool) {
    let [a, b] = both.map(|side| &side.shown.measurement);
    let has_rays = |m: &Measurement| m.tally(kind).is_some_and(|tally| tally.rays > 0);
    if !has_rays(a) && !has_rays(b) {
        return;
    }
    ui.add_space(4.0);
    ui.strong(format!("{} rays", kind.name()));
    egui::Grid::new(kind.name())
        .num_columns(4)
        .striped(true)
        .show(ui, |ui| {
            titles(ui);
            for figure in ray_figures() {
                ui.label(&figure.name).on_hover_text(&figure.meaning);
                let [of_a, of_b] = [a, b].map(|m| figure.of(m, kind));
                for value in [of_a, of_b] {
                    let text = value.map_or_else(none, |value| figure.unit.number(value));
                    ui.label(egui::RichText::new(text).monospace());
                }
                relation(ui, figure.unit, of_a, of_b, may);
                ui.end_row();
            }
        });
}

/// What stands where there is no value.
fn none() -> String {
    "–".to_owned()
}

fn titles(ui: &mut egui::Ui) {
    ui.label("");
    for (title, about) in [
        ("A", "The first tree"),
        ("B", "The second tree"),
        (
            "B/A",
            "The second in percent of the first; of percentages the difference in points",
        ),
    ] {
        ui.strong(title).on_hover_text(about);
    }
    ui.end_row();
}

/// The second value relative to the first, if the two may be compared.
fn relation(ui: &mut egui::Ui, unit: Unit, a: Option<f64>, b: Option<f64>, may: bool) {
    let change = change(unit, a, b).filter(|_| may);
    let text = change.map_or_else(none, |change| change.to_string());
    ui.label(egui::RichText::new(text).monospace());
}
