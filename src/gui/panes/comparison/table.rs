//! The figures of A and B beside each other, with the change from A to B.

use crate::gui::document::Figures;
use crate::gui::icons;
use crate::gui::theme::{Tokens, heading, tokens};
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::symbol::explain;
use crate::gui::widgets::value_row::{HEIGHT, Value, ValueRow};
use crate::measure::{Measurement, Parameter, ray_figures};
use crate::present::number::{ChangeText, Digits, Direction, NO_VALUE};
use crate::trace::RayKind;
use egui::Color32;

/// Widths of A, B and the change in points.
const WIDTHS: [f32; 3] = [70.0, 70.0, 104.0];

/// The figures of both sides, as far as there are any.
pub struct Sides<'a> {
    pub both: [Option<Figures<'a>>; 2],
    /// Whether changes from A to B mean anything.
    pub are_comparable: bool,
}

impl Sides<'_> {
    /// Returns whether nodes of both trees are of the same kind, as far as both are there.
    pub fn have_same_nodes(&self) -> bool {
        let [a, b] = self
            .measurements()
            .map(|m| m.map(Measurement::kind_of_node));
        a.is_none() || b.is_none() || a == b
    }

    /// Shows a table of parameters.
    pub fn parameters(&self, ui: &mut egui::Ui, of: impl Iterator<Item = &'static Parameter>) {
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            titles(ui);
            for (i, parameter) in of.enumerate() {
                let values = self.measurements().map(|m| parameter.value(m?));
                let texts = values.map(|value| parameter.format(value));
                let change = self.compare(|a, b| parameter.comparison_text(a, b));
                let name = sentence(parameter.name);
                let label = self.row(ui, i, &name, parameter.symbol, texts, change);
                if let Some(measurement) = self.measurements().into_iter().flatten().next() {
                    label.on_hover_ui(|ui| explain(ui, parameter, measurement));
                }
            }
        });
    }

    /// Shows what the rays of a kind did; nothing where there are none.
    pub fn rays(&self, ui: &mut egui::Ui, kind: RayKind) {
        let has_rays = |m: &Measurement| m.tally(kind).is_some_and(|tally| tally.rays > 0);
        if !self.measurements().into_iter().flatten().any(has_rays) {
            return;
        }
        ui.add_space(8.0);
        ui.label(heading(sentence(&format!("{} rays", kind.name()))));
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            titles(ui);
            for (i, figure) in ray_figures().iter().enumerate() {
                let values = self.measurements().map(|m| figure.of(m?, kind));
                let texts = values.map(|value| figure.text(value, Digits::Four));
                let change = self.compare(|a, b| figure.comparison_text(a, b, kind));
                self.row(ui, i, &sentence(&figure.name), "", texts, change)
                    .on_hover_text(&figure.meaning);
            }
        });
    }

    fn measurements(&self) -> [Option<&Measurement>; 2] {
        let [a, b] = &self.both;
        [a, b].map(|side| side.as_ref().map(|figures| &figures.now.measurement))
    }

    fn compare(
        &self,
        compare: impl Fn(&Measurement, &Measurement) -> Option<ChangeText>,
    ) -> Option<ChangeText> {
        let [a, b] = self.measurements();
        compare(a?, b?)
    }

    fn row(
        &self,
        ui: &mut egui::Ui,
        i: usize,
        name: &str,
        symbol: &str,
        [a, b]: [String; 2],
        change: Option<ChangeText>,
    ) -> egui::Response {
        let t = tokens(ui);
        let is_current = |side: &Option<Figures<'_>>| side.as_ref().is_some_and(|f| f.are_current);
        let are_current = self.both.each_ref().map(is_current);
        let color = |is_current| if is_current { t.text } else { t.hint };
        let change = change.filter(|_| self.are_comparable);
        let (text, of_change) =
            change.map_or((NO_VALUE.to_owned(), t.hint), |change| colored(change, t));
        let [of_a, of_b] = are_current.map(color);
        let of_change = if are_current == [true, true] {
            of_change
        } else {
            t.hint
        };
        let cells = [(a, of_a), (b, of_b), (text, of_change)];
        let values = values(cells);
        let row = ValueRow {
            name,
            symbol,
            values: &values,
            height: HEIGHT,
            striped: i.is_multiple_of(2),
        };
        row.show(ui)
    }
}

/// A change with its color; an arrow where less is better.
fn colored(change: ChangeText, t: &Tokens) -> (String, Color32) {
    let (arrow, color) = match change.direction {
        Direction::Better => (icons::ARROW_DOWN, t.better),
        Direction::Worse => (icons::ARROW_UP, t.worse),
        Direction::Neutral => return (change.text, t.label),
    };
    (format!("{arrow} {}", change.text), color)
}

fn titles(ui: &mut egui::Ui) {
    let t = tokens(ui);
    let cells = [("A", t.a), ("B", t.b), ("A to B", t.label)];
    let row = ValueRow {
        name: "",
        symbol: "",
        values: &values(cells.map(|(text, color)| (text.to_owned(), color))),
        height: HEIGHT,
        striped: false,
    };
    row.show(ui)
        .on_hover_text("The change from A to B. It has a color where less is better.");
}

fn values(cells: [(String, Color32); 3]) -> [Value; 3] {
    let mut widths = WIDTHS.into_iter();
    cells.map(|(text, color)| Value {
        text,
        color,
        width: widths.next().unwrap_or_default(),
    })
}
