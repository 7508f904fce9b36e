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
const TAB: f32 = 76.0;

/// The width of the place of the wipe's line as a number, in points.
const SPLIT: f32 = 72.0;

/// How much of the controls is shown: as much as there is room for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// All of them, with whole names.
    Whole,
    /// The arrangements of two pictures as a menu, with shorter names.
    Short,
    /// All that belongs to two pictures in one menu, and no names where there are icons.
    Least,
}

impl Extent {
    /// Returns the greatest one that fits into a row of this width, in points.
    fn fitting(ui: &egui::Ui, doc: &Document, verdict: Option<&Verdict>, room: f32) -> Self {
        let fits = |extent: &Extent| extent.width(ui, doc, verdict) <= room;
        let greatest = [Extent::Whole, Extent::Short].into_iter().find(fits);
        greatest.unwrap_or(Extent::Least)
    }

    /// The width of all controls, in points.
    fn width(self, ui: &egui::Ui, doc: &Document, verdict: Option<&Verdict>) -> f32 {
        let gap = ui.spacing().item_spacing.x;
        let font = egui::TextStyle::Button.resolve(ui.style());
        let text = |text: &str| {
            let color = egui::Color32::PLACEHOLDER;
            let galley = ui
                .painter()
                .layout_no_wrap(text.into(), font.clone(), color);
            galley.size().x + gap
        };
        let button = |name: &str| text(name) + 2.0 * ui.spacing().button_padding.x;
        let icon = ROW + gap;
        let mut width = icon + button(&what_title(doc));
        if doc.heatmap.is_some() {
            width += 2.0 * icon + self.costliest().map_or(0.0, text);
        }
        if doc.other.is_some() {
            let view = doc.comparing.view;
            let arranged = match self {
                Extent::Whole => ARRANGEMENTS
                    .map(|view| button(&sentence(view.name())))
                    .iter()
                    .sum(),
                Extent::Short => button(&arrangement_title(view)),
                Extent::Least => return width + icon,
            };
            let of_view = match view {
                View::Wipe => SPLIT + gap,
                _ => said(doc, verdict).map_or(0.0, |said| text(&said)),
            };
            width += arranged + of_view + button(&view3d_title());
        }
        width
    }

    /// What stands beside the way to the costliest pixels; `None` without a name.
    fn costliest(self) -> Option<&'static str> {
        match self {
            Extent::Whole => Some("Costliest pixels"),
            Extent::Short => Some("Costliest"),
            Extent::Least => None,
        }
    }
}

/// How two pictures are arranged.
const ARRANGEMENTS: [View; 4] = [View::Beside, View::Wipe, View::Difference, View::One];

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
        let extent = Extent::fitting(ui, doc, verdict, ui.available_width() - TAB);
        self.ring(ui, doc);
        if doc.heatmap.is_some() {
            costliest(ui, heat, extent.costliest());
        }
        if doc.other.is_some() {
            of_two(ui, doc, verdict, extent, edits);
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

/// What two pictures add to the controls.
fn of_two(
    ui: &mut egui::Ui,
    doc: &Document,
    verdict: Option<&Verdict>,
    extent: Extent,
    edits: &mut Edits,
) {
    if extent == Extent::Least {
        let icon = egui::Button::new(icons::SCALES).min_size(egui::vec2(ROW, ROW));
        let (button, _) = MenuButton::from_button(icon).ui(ui, |ui| {
            arrangements(ui, doc, false, edits);
            ui.separator();
            ui.horizontal(|ui| of_view(ui, doc, verdict, edits));
            view3d(ui, edits);
        });
        button
            .on_hover_text("How the two pictures are arranged.")
            .accessible_name("Arrangement");
        return;
    }
    view3d(ui, edits);
    of_view(ui, doc, verdict, edits);
    if extent == Extent::Whole {
        arrangements(ui, doc, true, edits);
    } else {
        let title = arrangement_title(doc.comparing.view);
        ui.menu_button(title, |ui| arrangements(ui, doc, false, edits));
    }
}

fn arrangement_title(view: View) -> String {
    format!("{} {}", sentence(view.name()), icons::CARET_DOWN)
}

fn what_title(doc: &Document) -> String {
    format!("{} {}", menu::title(doc), icons::CARET_DOWN)
}

fn view3d_title() -> String {
    format!("{} 3D", icons::CUBE)
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
    let (button, _) = MenuButton::new(what_title(doc))
        .config(config)
        .ui(ui, |ui| {
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
    let mut all = ARRANGEMENTS;
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
    let button = ui.button(view3d_title());
    let button = button.on_hover_text("Show the cells of the tree in front in 3D.");
    if button.accessible_name("Show in 3D").clicked() {
        edits.request(Request::Show("view3d"));
    }
}

/// What an arrangement has to say or to set.
fn of_view(ui: &mut egui::Ui, doc: &Document, verdict: Option<&Verdict>, edits: &mut Edits) {
    if let Some(said) = said(doc, verdict) {
        ui.label(hint(said));
    }
    if doc.comparing.view == View::Wipe {
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
}

/// What an arrangement says about the pictures; `None` if it says nothing.
fn said(doc: &Document, verdict: Option<&Verdict>) -> Option<String> {
    let says = doc.comparing.view == View::Difference && doc.heatmap.is_none();
    says.then(|| match verdict {
        None if doc.hides(&[Fact::Difference]) => HIDDEN.to_owned(),
        None => "Waiting for both pictures".to_owned(),
        Some(verdict) if verdict.pixels.is_empty() => "Equal in every pixel".to_owned(),
        Some(verdict) => format!("{} differ", counted(verdict.pixels.len(), "pixel")),
    })
}

/// Buttons to the pixels in the order of their values.
fn costliest(ui: &mut egui::Ui, heat: &mut HeatView, name: Option<&str>) {
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
    if let Some(name) = name {
        ui.label(name)
            .on_hover_text("Pixels in the order of the values shown, from the highest.");
    }
}
