//! The row of buttons that go through the steps, and the sentence about the current step.

use super::details;
use crate::gui::action::{shortcut, tip};
use crate::gui::document::Document;
use crate::gui::document::walk::{Go, RATES, listed};
use crate::gui::edits::{Edits, Request};
use crate::gui::icons;
use crate::gui::theme::ROW;
use crate::gui::widgets::step_text;
use crate::gui::widgets::transport::{self, Button, Transport};
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Align, Label, Layout, PopupCloseBehavior, Ui, vec2};

/// The room for the number of the step, in points.
const NUMBER: f32 = 120.0;
/// The same where leaves are counted, too.
const NUMBER_AND_LEAF: f32 = 190.0;
/// The greatest width of the list of rays, in points.
const RAYS: f32 = 400.0;
/// The lines of the sentence in a narrow pane.
const LINES: f32 = 3.0;

/// Shows the buttons; they are always there, so that nothing moves when a pixel is picked. In a narrow pane
/// the list of rays stands below the others, and the details of the step are a menu.
pub fn buttons(ui: &mut Ui, doc: &Document, edits: &mut Edits, is_wide: bool) {
    line(ui, transport::HEIGHT, |ui| {
        if let Some(action) = moves(doc).show(ui) {
            edits.request(Request::Run(action));
        }
        ui.spacing_mut().item_spacing.x = 8.0;
        number(ui, doc, is_wide);
        if is_wide {
            rays(ui, doc, edits, RAYS);
        }
        options(ui, doc, edits);
        if !is_wide {
            let button = MenuButton::new("Details").config(stays_open());
            button.ui(ui, |ui| {
                ui.set_width(380.0);
                details::show(ui, doc, 220.0);
            });
        }
    });
    if !is_wide {
        line(ui, transport::HEIGHT, |ui| {
            let width = ui.available_width().min(RAYS);
            rays(ui, doc, edits, width);
        });
    }
}

/// Shows widgets beside each other in all of the width.
fn line(ui: &mut Ui, height: f32, show: impl FnOnce(&mut Ui)) {
    let size = vec2(ui.available_width(), height);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        show(ui);
    });
}

fn stays_open() -> MenuConfig {
    MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside)
}

fn moves(doc: &Document) -> Transport {
    let leads = |go| doc.step_to(go).is_some();
    let is_playing = doc.is_playing();
    Transport {
        first: Button {
            name: "First",
            about: "Go back to the first step of the ray.",
            action: "ray.first-step",
            enabled: leads(Go::First),
        },
        previous: Button {
            name: "Previous",
            about: "Go one step back.",
            action: "ray.previous-step",
            enabled: leads(Go::Previous),
        },
        play: Button {
            name: if is_playing { "Pause" } else { "Play" },
            about: "Play the steps, or pause.",
            action: "ray.play",
            enabled: is_playing || leads(Go::Next) || leads(Go::First),
        },
        next: Button {
            name: "Next",
            about: "Go one step forward.",
            action: "ray.next-step",
            enabled: leads(Go::Next),
        },
        last: Button {
            name: "Last",
            about: "Go to the last step.",
            action: "ray.last-step",
            enabled: leads(Go::Last),
        },
        is_playing,
    }
}

/// The number of the step, in a place whose width does not depend on it.
fn number(ui: &mut Ui, doc: &Document, is_wide: bool) {
    let picked = doc.current.as_ref().and_then(|c| c.picked.as_ref());
    let leaves_only = doc.walking.leaves_only;
    let all = picked.map_or(0, |p| p.path().steps.len());
    let step = picked.map_or(0, |p| p.step);
    let text = match picked {
        Some(picked) if all > 0 && leaves_only => {
            let leaves = listed(picked.path(), true);
            let leaf = leaves.partition_point(|&i| i < step) + 1;
            let leaf = format!("leaf {} of {}", leaf.min(leaves.len()), leaves.len());
            match is_wide {
                true => format!("{} of {all} ({leaf})", step + 1),
                false => leaf,
            }
        }
        _ if all > 0 => format!("{} of {all}", step + 1),
        _ => "– of –".to_owned(),
    };
    let width = match leaves_only && is_wide {
        true => NUMBER_AND_LEAF,
        false => NUMBER,
    };
    let label = Label::new(&text).truncate();
    ui.add_sized(vec2(width, ROW), label)
        .on_hover_text("The current step, and how many the ray has.");
}

/// A list of the pixel's rays, with their kind and outcome.
fn rays(ui: &mut Ui, doc: &Document, edits: &mut Edits, width: f32) {
    let current = doc.current.as_ref();
    let Some((current, picked)) = current.and_then(|c| Some((c, c.picked.as_ref()?))) else {
        ui.add_sized(vec2(width, ROW), Label::new("No ray"));
        return;
    };
    let rays = &picked.record.rays;
    let name = |i: usize| {
        let path = &rays[i].path;
        let outcome = step_text::outcome(&current.shown.scene, path);
        format!(
            "Ray {} of {}: {} ray, {outcome}",
            i + 1,
            rays.len(),
            path.kind.name()
        )
    };
    let list = egui::ComboBox::from_id_salt("rays")
        .width(width)
        .truncate()
        .selected_text(name(picked.ray))
        .show_ui(ui, |ui| {
            for i in 0..rays.len() {
                if ui.selectable_label(i == picked.ray, name(i)).clicked() {
                    edits.add(move |doc| {
                        if let Some(current) = &mut doc.current {
                            current.select_ray(i);
                        }
                    });
                }
            }
        });
    let [x, y] = picked.pixel;
    list.response
        .on_hover_text(format!(
            "The rays of pixel {x}, {y}.\nShortcuts: {} and {} select a ray",
            shortcut("ray.previous-ray"),
            shortcut("ray.next-ray")
        ))
        .accessible_name(name(picked.ray));
}

/// A menu with what is rarely changed.
fn options(ui: &mut Ui, doc: &Document, edits: &mut Edits) {
    let button = MenuButton::from_button(egui::Button::new(icons::DOTS)).config(stays_open());
    let (response, _) = button.ui(ui, |ui| {
        let mut rate = doc.walking.rate;
        let speed = egui::DragValue::new(&mut rate)
            .range(RATES)
            .speed(0.1)
            .max_decimals(1)
            .suffix(" steps per second");
        let speed = ui
            .add(speed)
            .accessible_name("Speed")
            .on_hover_text("How fast the steps are played.");
        if speed.changed() {
            edits.add(move |doc| doc.walking.rate = rate);
        }
        let mut only = doc.walking.leaves_only;
        let check = ui.checkbox(&mut only, "Leaves only");
        if check
            .on_hover_text(tip("Step through leaves only.", "ray.leaves-only"))
            .changed()
        {
            edits.add(move |doc| doc.set_leaves_only(only));
        }
    });
    response
        .on_hover_text("How steps are played.")
        .accessible_name("Options of the steps");
}

/// Shows the sentence about the current step: in one line, in a narrow pane in several.
pub fn sentence(ui: &mut Ui, doc: &Document, is_wide: bool) {
    let (short, whole) = words(doc);
    let label = Label::new(short);
    if is_wide {
        line(ui, ROW, |ui| {
            ui.add(label.truncate()).on_hover_text(whole);
        });
    } else {
        let height = LINES * ui.text_style_height(&egui::TextStyle::Body) + 8.0;
        let size = vec2(ui.available_width(), height);
        ui.allocate_ui(size, |ui| {
            ui.set_min_size(size);
            ui.add_space(4.0);
            ui.add(label.wrap()).on_hover_text(whole);
        });
    }
}

/// The sentence about the current step, short and whole.
fn words(doc: &Document) -> (String, String) {
    let same = |text: String| (text.clone(), text);
    let Some(current) = &doc.current else {
        return same("No picture yet".to_owned());
    };
    if let Some(wish) = current.wish {
        let [x, y] = wish.pixel;
        return same(format!("Recording the rays of pixel {x}, {y} …"));
    }
    let Some(picked) = &current.picked else {
        return same("Pick a pixel in the picture to step through its rays.".to_owned());
    };
    let Some(step) = picked.current() else {
        return same("This ray misses the root cell: it visits no node.".to_owned());
    };
    let (scene, number) = (&current.shown.scene, picked.step + 1);
    let short = step_text::short_step(scene, number, step);
    (short, step_text::step(scene, number, step))
}
