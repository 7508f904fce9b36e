//! The septet Δ and the triplet Λ of what is on view: four of them on cards, the others in rows.

mod card;
mod export;

use crate::gui::action::actions;
use crate::gui::document::Document;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::theme::{ROW, tokens};
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::symbol::explain;
use crate::gui::widgets::value_row::{Value, ValueRow};
use crate::measure::{Class, DELTA, LAMBDA, Parameter, parameter};
use crate::present::number::Digits;

/// The figures of the picture on view.
#[derive(Default)]
pub struct FiguresPane;

impl Pane for FiguresPane {
    const ID: &'static str = "figures";
    const TITLE: &'static str = "Figures";
    const ALIASES: &'static [&'static str] = &["Δ  the tree in seven figures", "Λ  the times"];
    const ABOUT: &'static str = "The septet Δ of counts and the triplet Λ of times.";
    const REVEALS: &'static [Fact] = &[Fact::Counters(&DELTA), Fact::Counters(&LAMBDA)];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "figures.export" Everywhere ALT [Num4] "Export the figures: text, JSON, CSV, Markdown, LaTeX" => |_, cx| {
            let export = export::figures(cx.doc, cx.ctx);
            cx.edits.request(Request::Export(Box::new(export)));
        };
        "figures.export-report" Everywhere ALT [Num6] "Export a report: one HTML file" => |_, cx| {
            let export = export::page(cx.doc, cx.ctx);
            cx.edits.request(Request::Export(Box::new(export)));
        };
    };

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let room = ui.available_height();
        ui.spacing_mut().item_spacing.y = SPACE;
        let kernel = doc.figures(doc.which).map(|figures| {
            let setup = &figures.now.setup;
            let structure = setup.build.method.structure;
            format!(
                "Timed kernel: {}",
                setup.render.kernel.description_for(structure)
            )
        });
        for symbol in CARDS {
            let is_time = parameter(symbol).class == Class::T;
            let note = kernel.as_deref().filter(|_| is_time).unwrap_or("");
            card::card(ui, parameter(symbol), doc, cx.edits, note);
        }
        // The cards leave room for the other figures, or else for a way to them.
        if room >= height_with_rows() {
            rows(ui, doc);
            return;
        }
        let about = "Show all parameters of the paper's Tables 1 to 3.";
        let size = egui::vec2(ui.available_width(), ROW);
        let button = ui.add_sized(size, egui::Button::new("All figures"));
        let button = button.on_hover_text(about);
        if button.accessible_name("Show all figures").clicked() {
            cx.edits.request(Request::Show("parameters"));
        }
    }
}

/// The figures on cards: the costs of tracing, and what decides them.
const CARDS: [&str; 4] = ["N_RPRT", "N_AT", "N_LS", "T_TR"];

/// Space between cards.
const SPACE: f32 = 8.0;

/// The figures of Δ and Λ that have no card.
fn others() -> impl Iterator<Item = &'static Parameter> {
    let all = DELTA.iter().chain(&LAMBDA);
    all.filter(|symbol| !CARDS.contains(symbol))
        .map(|symbol| parameter(symbol))
}

/// The height of all ten figures and the button.
fn height_with_rows() -> f32 {
    let cards = CARDS.len() as f32 * (card::HEIGHT + SPACE);
    cards + others().count() as f32 * ROW + SPACE + ROW
}

/// Shows the figures that have no card.
fn rows(ui: &mut egui::Ui, doc: &Document) {
    let figures = doc.figures(doc.which);
    let t = tokens(ui);
    ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for parameter in others() {
            let value = figures
                .as_ref()
                .and_then(|f| parameter.value(&f.now.measurement));
            let is_current = figures.as_ref().is_some_and(|f| f.are_current);
            let text = parameter.text(value, Digits::Three);
            let label = ValueRow {
                name: &sentence(parameter.name),
                symbol: parameter.symbol,
                values: &[Value {
                    color: if is_current { t.text } else { t.hint },
                    width: VALUE,
                    text,
                }],
                height: ROW,
                striped: false,
            };
            let label = label.show(ui);
            if let Some(figures) = &figures {
                label.on_hover_ui(|ui| explain(ui, parameter, &figures.now.measurement));
            }
        }
    });
}

/// Width of the values of the rows.
const VALUE: f32 = 56.0;
