//! The controls above the picture: what is shown, how two pictures are arranged, the way to the costliest
//! pixels, and how far the rendering is.

use super::heat::{HeatView, menu};
use super::marks::PictureMarks;
use crate::gui::action::tip;
use crate::gui::document::comparing::{Verdict, View};
use crate::gui::document::{Document, Fact};
use crate::gui::edits::{Edits, Request};
use crate::gui::icons;
use crate::gui::theme::{IconButton, ROW, hint};
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::hidden::HIDDEN;
use crate::gui::widgets::progress_ring::{PATIENCE, progress_ring};
use crate::present::number::counted;
use egui::containers::menu::{MenuButton, MenuConfig};

/// What the tab left of the controls needs, in points.
const TAB: f32 = 100.0;

/// Below this width, in points, the arrangements of two pictures are a menu.
const NARROW: f32 = 560.0;

/// What the controls keep from frame to frame.
#[derive(Default)]
pub struct Row {
    /// Since when a picture is being rendered, in seconds.
    busy_since: Option<f64>,
}

impl Row {
    /// Shows the controls, from the right to the left.
    pub fn show(
        &mut self,
        ui: &mut egui::Ui,
        (heat, marks): (&mut HeatView, &mut PictureMarks),
        doc: &Document,
        verdict: Option<&Verdict>,
        edits: &mut Edits,
    ) {
        let room = ui.available_width() - TAB;
        self.ring(ui, doc);
        let mut narrow = room < NARROW;
        if doc.heatmap.is_some() {
            costliest(ui, heat, narrow);
            narrow = room < NARROW + COSTLIEST;
        }
        if doc.other.is_some() {
            view3d(ui, edits);
            of_view(ui, doc, verdict, edits);
            if narrow {
                let title = format!(
                    "{} {}",
                    sentence(doc.comparing.view.name()),
                    icons::CARET_DOWN
                );
                ui.menu_button(title, |ui| arrangements(ui, doc, false, edits));
            } else {
                arrangements(ui, doc, true, edits);
            }
        }
        what(ui, heat, marks, doc, edits);
    }

    /// How much of the picture is done, once that takes a while. An empty slot before, so that nothing
    /// moves.
    fn ring(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let now = ui.input(|i| i.time);
        let Some((work, status)) = doc.work.as_ref().and_then(|w| Some((w, w.status()?))) else {
            self.busy_since = None;
            empty_slot(ui);
            return;
        };
        let since = *self.busy_since.get_or_insert(now);
        if now - since < PATIENCE {
            empty_slot(ui);
            let left = since + PATIENCE - now;
            ui.ctx().request_repaint_after_secs(left as f32);
            return;
        }
        let which = match &doc.other {
            Some(_) => format!(" {}", work.which.name()),
            None => String::new(),
        };
        let percent = status.fraction * 100.0;
        let about = format!(
            "Tracing{which}: {}, {percent:.0} %. Esc stops it.",
            status.stage
        );
        progress_ring(ui, status.fraction, &about);
    }
}

/// Takes the room of the ring.
fn empty_slot(ui: &mut egui::Ui) {
    ui.allocate_exact_size(egui::vec2(ROW, ROW), egui::Sense::hover());
}

/// The menu of the picture and its heatmaps.
fn what(
    ui: &mut egui::Ui,
    heat: &mut HeatView,
    marks: &mut PictureMarks,
    doc: &Document,
    edits: &mut Edits,
) {
    let config = MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    let title = format!("{} {}", menu::title(doc), icons::CARET_DOWN);
    let (button, _) = MenuButton::new(title).config(config).ui(ui, |ui| {
        // Not a menu's style: here a button without a frame looks like text.
        ui.reset_style();
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                menu::list(ui, doc, edits);
                ui.separator();
                marks.outline_switch(ui);
            });
            if doc.heatmap.is_some() {
                ui.separator();
                ui.vertical(|ui| heat.options(ui, doc));
            }
        });
    });
    let about = tip(
        "Show the picture, or what each pixel cost.",
        "picture.next-heatmap",
    );
    button.on_hover_text(about).accessible_name("Show");
}

/// The arrangements of two pictures, in a menu or, `reversed`, from the right to the left.
fn arrangements(ui: &mut egui::Ui, doc: &Document, reversed: bool, edits: &mut Edits) {
    let mut all = [View::Beside, View::Wipe, View::Difference, View::One];
    if reversed {
        all.reverse();
    }
    for view in all {
        let is_chosen = doc.comparing.view == view;
        let button = egui::Button::selectable(is_chosen, sentence(view.name()));
        let about = tip(view.about(), "picture.next-view");
        if ui.add(button).on_hover_text(about).clicked() {
            edits.add(move |doc| doc.comparing.view = view);
        }
    }
}

fn view3d(ui: &mut egui::Ui, edits: &mut Edits) {
    let button = ui.button(format!("{} 3D", icons::CUBE));
    let button = button.on_hover_text("Show the cells of the tree in front in 3D.");
    if button.accessible_name("Show in 3D").clicked() {
        edits.request(Request::Show("view3d"));
    }
}

/// What an arrangement has to say or to set.
fn of_view(ui: &mut egui::Ui, doc: &Document, verdict: Option<&Verdict>, edits: &mut Edits) {
    match doc.comparing.view {
        View::Difference if doc.heatmap.is_none() => {
            let text = match verdict {
                None if doc.hides(&[Fact::Difference]) => HIDDEN.to_owned(),
                None => "Waiting for both pictures".to_owned(),
                Some(verdict) if verdict.pixels.is_empty() => "Equal in every pixel".to_owned(),
                Some(verdict) => format!("{} differ", counted(verdict.pixels.len(), "pixel")),
            };
            ui.label(hint(text));
        }
        View::Wipe => {
            let before = doc.comparing.split * 100.0;
            let mut percent = before;
            let edit = egui::DragValue::new(&mut percent)
                .range(0.0..=100.0)
                .fixed_decimals(0);
            ui.label("%");
            ui.name_inputs("Wipe", |ui| ui.add(edit));
            if percent != before {
                edits.add(move |doc| doc.comparing.split = percent / 100.0);
            }
        }
        View::Difference | View::Beside | View::One => {}
    }
}

/// Width of the way to the costliest pixels, in points.
const COSTLIEST: f32 = 200.0;

/// Buttons to the pixels in the order of their values.
fn costliest(ui: &mut egui::Ui, heat: &mut HeatView, narrow: bool) {
    for (icon, by, action, name) in [
        (
            icons::NEXT,
            1,
            "picture.less-expensive",
            "Next costliest pixel",
        ),
        (
            icons::PREVIOUS,
            -1,
            "picture.more-expensive",
            "Previous costliest pixel",
        ),
    ] {
        let about = tip(name, action);
        if ui.add(IconButton::new(icon, name).tip(&about)).clicked() {
            heat.step_by_cost(by);
        }
    }
    ui.label(if narrow {
        "Costliest"
    } else {
        "Costliest pixels"
    })
    .on_hover_text("Pixels in the order of the values shown, from the highest.");
}
