//! A figure on a card: its value, the change against the result before, and the last results.

use crate::gui::document::{Document, Figures, Measured};
use crate::gui::edits::Edits;
use crate::gui::icons;
use crate::gui::theme::{CARD_RADIUS, FIGURE, HINT, Tokens, named, tokens};
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::sparkline::Sparkline;
use crate::gui::widgets::symbol::explain;
use crate::gui::widgets::value_row::text;
use crate::measure::Parameter;
use crate::present::number::{Digits, Direction};
use egui::{Color32, Rect, Sense, Stroke, StrokeKind, TextStyle, Ui, pos2, vec2};

/// Height of a card in points.
pub const HEIGHT: f32 = 104.0;

/// How many results a card shows.
const RESULTS: usize = 20;

/// Shows the card of a figure. What is on it has fixed places; `note` stands right of the value.
pub fn card(
    ui: &mut Ui,
    parameter: &'static Parameter,
    doc: &Document,
    edits: &mut Edits,
    note: &str,
) {
    let figures = doc.figures(doc.which);
    let figures = figures.as_ref();
    let t = tokens(ui);
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let id = response.id;
    let divider = Stroke::new(1.0, t.divider);
    ui.painter()
        .rect(rect, CARD_RADIUS, t.card, divider, StrokeKind::Inside);
    let inner = rect.shrink2(vec2(12.0, 8.0));
    let (left, top) = (inner.left(), inner.top());
    let is_current = figures.is_some_and(|figures| figures.are_current);
    let value_of = |measured: &Measured| parameter.value(&measured.measurement);
    let value = figures.and_then(|figures| value_of(figures.now));

    let style = |name: TextStyle| name.resolve(ui.style());
    let painter = ui.painter().clone();
    let name = sentence(parameter.name);
    let galley = painter.layout_no_wrap(name.clone(), style(TextStyle::Body), t.label);
    let width = galley.size().x;
    let mut label = text(ui, id.with("name"), pos2(left, top), galley, &name);
    let symbol = parameter.symbol.to_owned();
    let galley = painter.layout_no_wrap(symbol, style(named(HINT)), t.hint);
    let at = pos2(left + width + 8.0, top + 2.0);
    label = label.union(text(ui, id.with("symbol"), at, galley, parameter.symbol));

    let shown = parameter.text(value, Digits::Three);
    let color = if is_current { t.text } else { t.hint };
    let galley = painter.layout_no_wrap(shown.clone(), style(named(FIGURE)), color);
    label = label.union(text(
        ui,
        id.with("value"),
        pos2(left, top + 20.0),
        galley,
        &shown,
    ));
    if !note.is_empty() {
        let galley = painter.layout_no_wrap(note.to_owned(), style(named(HINT)), t.hint);
        let at = pos2(inner.right() - galley.size().x, top + 26.0);
        text(ui, id.with("note"), at, galley, note);
    }
    if let Some(figures) = figures {
        label.on_hover_ui(|ui| {
            explain(ui, parameter, &figures.now.measurement);
            if !figures.are_current {
                ui.weak("Of earlier settings: the new figure is being measured.");
            }
        });
        if let Some((change, color)) = change(parameter, figures, t) {
            let color = if is_current { color } else { t.hint };
            let galley = painter.layout_no_wrap(change.clone(), style(named(HINT)), color);
            text(
                ui,
                id.with("change"),
                pos2(left, top + 46.0),
                galley,
                &change,
            );
        }
    }
    let line = Rect::from_min_max(pos2(left, inner.bottom() - 22.0), inner.max);
    history(ui, id.with("history"), line, parameter, doc, edits);
}

/// Returns the change against the result before, with its color. An arrow where less is better.
fn change(parameter: &Parameter, figures: &Figures<'_>, t: &Tokens) -> Option<(String, Color32)> {
    let value = |measured: &Measured| parameter.value(&measured.measurement);
    let change = parameter.change_text(value(figures.before?), value(figures.now))?;
    let (arrow, color) = match change.direction {
        Direction::Better => (icons::ARROW_DOWN, t.better),
        Direction::Worse => (icons::ARROW_UP, t.worse),
        Direction::Neutral => return Some((change.with_before(), t.label)),
    };
    Some((format!("{arrow} {}", change.with_before()), color))
}

/// Shows the last results; a click wants the setup of one again.
fn history(
    ui: &Ui,
    id: egui::Id,
    rect: Rect,
    parameter: &Parameter,
    doc: &Document,
    edits: &mut Edits,
) {
    let results = doc.results(doc.which).results();
    if results.len() < 2 {
        return;
    }
    let value = |measured: &Measured| parameter.value(&measured.measurement);
    let values: Vec<_> = results.iter().map(value).collect();
    let line = Sparkline {
        name: &format!("Results: {}", parameter.name),
        values: &values,
        room: RESULTS,
    };
    let (under, response) = line.show(ui, id, rect);
    let Some(result) = under.and_then(|place| results.get(place)) else {
        return;
    };
    let shown = parameter.text(value(result), Digits::Three);
    let is_clicked = response.clicked();
    response.on_hover_text(format!(
        "{shown} with {}\nClick to use these settings again.",
        settings(result)
    ));
    if is_clicked {
        let setup = result.setup.clone();
        edits.add(move |doc| doc.wanted = setup);
    }
}

/// Returns the method of a result, and its settings that are not at their defaults.
fn settings(result: &Measured) -> String {
    let setup = &result.setup;
    let mut text = setup.build.method.name.to_owned();
    let left_out = ["scene", "method", "resolution"];
    for setting in setup.differences().filter(|s| !left_out.contains(&s.name)) {
        text += &format!(" · {} {}", setting.label, setting.text(setup));
    }
    text
}
