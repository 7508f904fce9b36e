//! Widgets of settings, made from their entries: a row with a label, and a control for the kind of value.
//! A control returns the new value; nothing is changed before the pane has been drawn.

use crate::geometry::Vec3;
use crate::gui::action::tip;
use crate::gui::edits::Edits;
use crate::gui::theme::{ROW, hint};
use crate::gui::widgets::choice_list;
use crate::gui::widgets::common::sentence;
use crate::scene::{Camera, Cylinders};
use crate::setup::{Choice, Kind, Range, Setting, Setup, Value, methods};
use crate::structure::MaxDepth;
use crate::structure::tree_file::short_name;
use egui::vec2;

/// The width of the labels in points.
const LABEL: f32 = 152.0;

/// The depth that is shown before there is a tree.
const USUAL_DEPTH: u32 = 20;

/// What widgets know beside the setup.
pub struct Around<'a> {
    /// The most pixels that a picture on the screen can have on a side.
    pub largest: u32,
    /// The camera that is used now; `None` before the first picture.
    pub camera: Option<&'a Camera>,
    /// The depth limit of the tree on view; `None` before the first.
    pub depth_limit: Option<u32>,
    /// The root margin of the tree on view, a length; `None` before the first.
    pub root_margin: Option<f64>,
    /// The width of the slider for the depth, in points; `None` for a number alone.
    pub slider: Option<f32>,
    /// A few words to stand beside a setting's widget, with a tooltip.
    pub note: &'a dyn Fn(&Setting, &Setup) -> Option<[String; 2]>,
}

/// Shows a row for each of these settings. A change is an edit of the tree in front.
pub fn rows(
    ui: &mut egui::Ui,
    settings: impl Iterator<Item = Setting>,
    setup: &Setup,
    around: &Around<'_>,
    edits: &mut Edits,
) {
    for setting in settings {
        ui.horizontal_wrapped(|ui| {
            label(ui, &setting, setup);
            show(ui, &setting, setup, around, edits);
            if !setup.applies(&setting) {
                unused(ui, setup);
            }
            if let Some([note, about]) = (around.note)(&setting, setup) {
                // As a whole on one line, so that all of it is under the pointer.
                ui.add(egui::Label::new(egui::RichText::new(note).weak()).extend())
                    .on_hover_text(about);
            }
        });
    }
}

/// Shows the control of a setting alone. A change is an edit of the tree in front.
pub fn show(
    ui: &mut egui::Ui,
    setting: &Setting,
    setup: &Setup,
    around: &Around<'_>,
    edits: &mut Edits,
) {
    let before = setting.value(setup);
    let said = Said {
        name: &name(setting),
        about: &about(setting, setup),
    };
    let applies = setup.applies(setting);
    let value = ui.add_enabled_ui(applies, |ui| {
        ui.name_inputs(said.name, |ui| control(ui, setting, before, said, around))
    });
    if let Some(value) = value.inner.filter(|value| *value != before) {
        let setting = *setting;
        edits.add(move |doc| setting.store(&mut doc.wanted, value));
    }
}

/// Says that a setting has no effect.
fn unused(ui: &mut egui::Ui, setup: &Setup) {
    let method = setup.build.method.name;
    ui.label(hint("not used"))
        .on_hover_text(format!("It has no effect on the trees of method {method}."));
}

/// What is said of a setting.
#[derive(Clone, Copy)]
struct Said<'a> {
    name: &'a str,
    about: &'a str,
}

impl Said<'_> {
    /// Gives a widget its tooltip and its name, in this order: a tooltip would be the name otherwise.
    fn of(self, response: egui::Response) -> egui::Response {
        let response = response.on_hover_text(self.about);
        response.accessible_name(self.name)
    }
}

/// What a setting is called. Settings of a single method are named as in commands.
pub fn name(setting: &Setting) -> String {
    sentence(&setting.label.replace('-', " "))
}

/// The name of a setting, with the paper's symbol as a hint.
fn label(ui: &mut egui::Ui, setting: &Setting, setup: &Setup) {
    let left = egui::Layout::left_to_right(egui::Align::Center);
    ui.allocate_ui_with_layout(vec2(LABEL, ROW), left, |ui| {
        ui.set_min_size(vec2(LABEL, ROW));
        ui.label(name(setting)).on_hover_text(about(setting, setup));
        if let Some(symbol) = setting.symbol {
            ui.label(hint(symbol));
        }
    });
}

/// What a setting does, which values it takes, and what it is on the command line.
pub fn about(setting: &Setting, setup: &Setup) -> String {
    let mut text = format!("{}.", setting.about);
    let mut constants = setup.build.method.info().constants.iter();
    if let Some(constant) = constants.find(|c| c.name == setting.name) {
        text += &format!("\nSource: {}", constant.source);
    }
    let default = setting.default(setup);
    text += &format!("\nValue: {}; default {default}.", setting.expected());
    text + &format!("\nOn the command line: {}.", setting.name)
}

/// The control for a value; returns the value that it is given.
fn control(
    ui: &mut egui::Ui,
    setting: &Setting,
    value: Value,
    said: Said<'_>,
    around: &Around<'_>,
) -> Option<Value> {
    match (setting.kind, value) {
        (Kind::Number(range), Value::Number(now)) => number(ui, range, now, said),
        (Kind::Choice(choices), Value::Choice(now)) => {
            choice(ui, said, &choices(), now).map(Value::Choice)
        }
        (Kind::Method, Value::Choice(now)) => choice(ui, said, &methods(), now).map(Value::Choice),
        (Kind::Switch, Value::Switch(mut on)) => {
            let text = if on { "on (1)" } else { "off (0)" };
            let is_changed = said.of(ui.checkbox(&mut on, text)).changed();
            is_changed.then_some(Value::Switch(on))
        }
        (Kind::Size, Value::Size(size)) => sides(ui, size, around.largest).map(Value::Size),
        (Kind::Depth, Value::Depth(now)) => depth(ui, now, around, said).map(Value::Depth),
        (Kind::Automatic(range), value) => automatic(ui, range, value, around, said),
        (Kind::Cylinders, Value::Cylinders(now)) => cylinders(ui, now, said).map(Value::Cylinders),
        (Kind::Point, value) => {
            let own = around
                .camera
                .map_or(Vec3::ZERO, |camera| match setting.name {
                    "from" => camera.from,
                    "at" => camera.at,
                    _ => camera.up,
                });
            let point = match value {
                Value::Point(point) => Some(point),
                _ => None,
            };
            overridden(ui, point, own, said, |ui, point| {
                let mut changed = false;
                for coordinate in [&mut point.x, &mut point.y, &mut point.z] {
                    let speed = (coordinate.abs() * 0.01).max(0.01);
                    let edit = egui::DragValue::new(coordinate)
                        .speed(speed)
                        .max_decimals(4);
                    changed |= ui.add(edit).changed();
                }
                changed
            })
            .map(|point| point.map_or(Value::Own, Value::Point))
        }
        (Kind::Angle(range), value) => {
            let own = around.camera.map_or(45.0, |camera| camera.angle);
            let angle = match value {
                Value::Number(angle) => Some(angle),
                _ => None,
            };
            overridden(ui, angle, own, said, |ui, angle| {
                let edit = egui::DragValue::new(angle)
                    .range(range.lowest..=range.highest)
                    .max_decimals(3)
                    .suffix("°");
                ui.add(edit).changed()
            })
            .map(|angle| angle.map_or(Value::Own, Value::Number))
        }
        _ => None,
    }
}

fn number(ui: &mut egui::Ui, range: Range, now: f64, said: Said<'_>) -> Option<Value> {
    let Range {
        lowest,
        highest,
        whole,
        unit,
    } = range;
    let mut value = now;
    let speed = if whole {
        (now.abs() * 0.01).max(0.05)
    } else {
        // Small numbers are moved in small steps.
        let width = (highest - lowest).min(1e3);
        (now.abs() * 0.02).clamp(width * 1e-7, width * 0.01)
    };
    let mut edit = egui::DragValue::new(&mut value)
        .range(lowest..=highest)
        .speed(speed)
        .max_decimals(if whole { 0 } else { 9 });
    if !whole {
        edit = edit.custom_formatter(|v, _| {
            if v != 0.0 && v.abs() < 1e-3 {
                format!("{v:e}")
            } else {
                format!("{v}")
            }
        });
    }
    let is_changed = said.of(ui.add(edit)).changed();
    if !unit.is_empty() {
        ui.weak(unit);
    }
    is_changed.then_some(Value::Number(value))
}

fn choice(
    ui: &mut egui::Ui,
    said: Said<'_>,
    choices: &[Choice],
    now: &'static str,
) -> Option<&'static str> {
    let mut chosen = now;
    let of_chosen = choices.iter().find(|choice| choice.name == now);
    let of_chosen = of_chosen.map_or("", |choice| choice.about);
    let list = egui::ComboBox::from_id_salt(said.name)
        .selected_text(short_name(now))
        // Without scrolling: a list that hides its last item hides that there is one.
        .height(f32::INFINITY)
        .show_ui(ui, |ui| {
            let mut group = "";
            choice_list::close_together(ui);
            for choice in choices {
                if choice.group != group {
                    group = choice.group;
                    choice_list::group(ui, group);
                }
                // With headings there are so many that each says what it is.
                let about = if group.is_empty() { "" } else { choice.about };
                let item = choice_list::item(ui, choice.name == now, choice.name, about);
                if item.clicked() {
                    chosen = choice.name;
                    ui.close();
                }
                if about.is_empty() && !choice.about.is_empty() {
                    item.on_hover_text(choice.about)
                        .accessible_name(choice.name);
                }
            }
        });
    let about = format!("{}\n{of_chosen}", said.about);
    let about = about.trim_end();
    Said { about, ..said }.of(list.response);
    (chosen != now).then_some(chosen)
}

fn sides(ui: &mut egui::Ui, size: [u32; 2], largest: u32) -> Option<[u32; 2]> {
    let mut sides = size;
    for (i, name) in ["Width", "Height"].into_iter().enumerate() {
        if i > 0 {
            ui.label("×");
        }
        let edit = egui::DragValue::new(&mut sides[i])
            .range(1..=largest)
            .update_while_editing(false);
        ui.add(edit)
            .accessible_name(name)
            .on_hover_text(format!("{name} in pixels"));
    }
    (sides != size).then_some(sides)
}

fn depth(
    ui: &mut egui::Ui,
    now: MaxDepth,
    around: &Around<'_>,
    said: Said<'_>,
) -> Option<MaxDepth> {
    let automatic = now == MaxDepth::Automatic;
    // While automatic, the number is what that came to in the tree on view.
    let mut depth = match now {
        MaxDepth::Fixed(depth) => depth,
        MaxDepth::Automatic => around.depth_limit.unwrap_or(USUAL_DEPTH),
    };
    let range = 0..=MaxDepth::LIMIT;
    let edit = if let Some(width) = around.slider {
        ui.spacing_mut().slider_width = width;
        ui.add_enabled(!automatic, egui::Slider::new(&mut depth, range))
    } else {
        ui.add_enabled(!automatic, egui::DragValue::new(&mut depth).range(range))
    };
    let is_changed = said.of(edit).changed();
    let mut auto = automatic;
    ui.checkbox(&mut auto, "Auto").on_hover_text(tip(
        "D_MAX = 1.2 log2 N_O + 2, rounded.",
        "window.auto-depth",
    ));
    if auto && !automatic {
        Some(MaxDepth::Automatic)
    } else {
        (is_changed || auto != automatic).then_some(MaxDepth::Fixed(depth))
    }
}

/// Rounds a number to four digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}

/// A number with a switch for the one that follows from the scene. While automatic, the number is that of
/// the tree on view, rounded.
fn automatic(
    ui: &mut egui::Ui,
    range: Range,
    value: Value,
    around: &Around<'_>,
    said: Said<'_>,
) -> Option<Value> {
    let is_automatic = value == Value::Automatic;
    let now = match value {
        Value::Number(now) => now,
        _ => around.root_margin.map_or(range.lowest, rounded),
    };
    let edited = ui.add_enabled_ui(!is_automatic, |ui| number(ui, range, now, said));
    let mut auto = is_automatic;
    ui.checkbox(&mut auto, "Auto")
        .on_hover_text("Relative to the size of the scene.")
        .accessible_name(format!("{}: auto", said.name));
    match (is_automatic, auto) {
        (false, true) => Some(Value::Automatic),
        (true, false) => Some(Value::Number(now)),
        _ => edited.inner,
    }
}

fn cylinders(ui: &mut egui::Ui, now: Cylinders, said: Said<'_>) -> Option<Cylinders> {
    let mut cylinders = now;
    let mut polygons = matches!(now, Cylinders::Polygons(_));
    said.of(ui.checkbox(&mut polygons, "as polygons"));
    match (polygons, &mut cylinders) {
        (true, Cylinders::Polygons(sides)) => {
            let edit = egui::DragValue::new(sides)
                .range(3..=1000)
                .speed(0.1)
                .suffix(" sides");
            ui.add(edit).accessible_name("Sides of the polygons");
        }
        (true, Cylinders::Exact) => cylinders = Cylinders::Polygons(8),
        (false, _) => cylinders = Cylinders::Exact,
    }
    (cylinders != now).then_some(cylinders)
}

/// A switch that overrides the scene's own value, and the value while it is overridden.
fn overridden<T: Copy>(
    ui: &mut egui::Ui,
    now: Option<T>,
    own: T,
    said: Said<'_>,
    edit: impl FnOnce(&mut egui::Ui, &mut T) -> bool,
) -> Option<Option<T>> {
    let mut is_set = now.is_some();
    if said.of(ui.checkbox(&mut is_set, "override")).changed() {
        return Some(is_set.then_some(own));
    }
    let mut value = now?;
    edit(ui, &mut value).then_some(Some(value))
}
