//! One row for each setting: its label with a tooltip, and a widget for its kind of value.

use crate::geometry::Vec3;
use crate::scene::{Camera, Cylinders};
use crate::setup::{Choice, Kind, Range, Setting, Setup, Value};
use crate::structure::MaxDepth;

/// What widgets know beside the setup.
pub struct Around<'a> {
    /// The most pixels that a picture on the screen can have on a side.
    pub largest: u32,
    /// The camera that is used now; `None` before the first picture.
    pub camera: Option<&'a Camera>,
    /// A few words to stand beside a setting's widget, with a tooltip.
    pub note: &'a dyn Fn(&Setting, &Setup) -> Option<[String; 2]>,
}

/// A grid with a row for each of these settings.
pub fn rows(
    ui: &mut egui::Ui,
    id: &str,
    settings: impl Iterator<Item = Setting>,
    setup: &mut Setup,
    around: &Around<'_>,
) {
    egui::Grid::new(id).num_columns(2).show(ui, |ui| {
        for setting in settings {
            let about = about(&setting, setup);
            let before = setting.value(setup);
            row(ui, setting.label, &about, |ui| {
                let value = widget(ui, &setting, before, &about, around);
                if let Some(value) = value.filter(|value| *value != before) {
                    setting.store(setup, value);
                }
                if let Some([note, about]) = (around.note)(&setting, setup) {
                    ui.weak(note).on_hover_text(about);
                }
            });
        }
    });
}

/// A row of a two-column grid: a name and a widget that goes by it.
fn row<R>(
    ui: &mut egui::Ui,
    name: &str,
    about: &str,
    widget: impl FnOnce(&mut egui::Ui) -> R,
) -> R {
    ui.label(name).on_hover_text(about);
    let result = ui.horizontal(|ui| ui.name_inputs(name, widget)).inner;
    ui.end_row();
    result
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

/// The widget for a value; returns the value that it is given.
fn widget(
    ui: &mut egui::Ui,
    setting: &Setting,
    value: Value,
    about: &str,
    around: &Around<'_>,
) -> Option<Value> {
    match (setting.kind, value) {
        (Kind::Number(range), Value::Number(now)) => number(ui, range, now, about),
        (Kind::Choice(choices), Value::Choice(now)) => {
            choice(ui, setting.name, &choices(), now).map(Value::Choice)
        }
        (Kind::Switch, Value::Switch(mut on)) => {
            let text = if on { "on (1)" } else { "off (0)" };
            let is_changed = ui.checkbox(&mut on, text).on_hover_text(about).changed();
            is_changed.then_some(Value::Switch(on))
        }
        (Kind::Size, Value::Size(size)) => sides(ui, size, around.largest).map(Value::Size),
        (Kind::Depth, Value::Depth(depth)) => self::depth(ui, depth).map(Value::Depth),
        (Kind::Cylinders, Value::Cylinders(now)) => cylinders(ui, now).map(Value::Cylinders),
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
            overridden(ui, point, own, |ui, point| {
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
            overridden(ui, angle, own, |ui, angle| {
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

fn number(ui: &mut egui::Ui, range: Range, now: f64, about: &str) -> Option<Value> {
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
    let is_changed = ui.add(edit).on_hover_text(about).changed();
    if !unit.is_empty() {
        ui.weak(unit);
    }
    is_changed.then_some(Value::Number(value))
}

fn choice(
    ui: &mut egui::Ui,
    id: &str,
    choices: &[Choice],
    now: &'static str,
) -> Option<&'static str> {
    let mut chosen = now;
    let about = choices.iter().find(|choice| choice.name == now);
    let about = about.map_or("", |choice| choice.about);
    let list = egui::ComboBox::from_id_salt(id)
        .selected_text(now)
        .width(90.0)
        .show_ui(ui, |ui| {
            for choice in choices {
                let item = ui.selectable_value(&mut chosen, choice.name, choice.name);
                if !choice.about.is_empty() {
                    item.on_hover_text(choice.about);
                }
            }
        });
    if !about.is_empty() {
        list.response.on_hover_text(about);
    }
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
        ui.add(edit).accessible_name(name);
    }
    ui.weak("pixels");
    (sides != size).then_some(sides)
}

fn depth(ui: &mut egui::Ui, now: MaxDepth) -> Option<MaxDepth> {
    let mut depth = now;
    let mut automatic = now == MaxDepth::Automatic;
    if let MaxDepth::Fixed(depth) = &mut depth {
        ui.add(egui::DragValue::new(depth).range(0..=MaxDepth::LIMIT));
    }
    if ui.checkbox(&mut automatic, "auto").changed() {
        depth = match automatic {
            true => MaxDepth::Automatic,
            false => MaxDepth::Fixed(20),
        };
    }
    (depth != now).then_some(depth)
}

fn cylinders(ui: &mut egui::Ui, now: Cylinders) -> Option<Cylinders> {
    let mut cylinders = now;
    let mut polygons = matches!(now, Cylinders::Polygons(_));
    ui.checkbox(&mut polygons, "as polygons");
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
    edit: impl FnOnce(&mut egui::Ui, &mut T) -> bool,
) -> Option<Option<T>> {
    let mut is_set = now.is_some();
    if ui.checkbox(&mut is_set, "set").changed() {
        return Some(is_set.then_some(own));
    }
    let Some(mut value) = now else {
        ui.weak("the scene's own");
        return None;
    };
    edit(ui, &mut value).then_some(Some(value))
}
