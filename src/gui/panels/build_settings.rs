//! How the tree is built: root cell, overlap, memory, and the method's own constants.

use super::{Panel, Side, row};
use crate::geometry::Axis;
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::State;
use crate::structure::split::Constant;
use crate::structure::{BuildSettings, OverlapRule};

pub(super) const PANEL: Panel = Panel {
    title: "Tree",
    side: Side::Left,
    open: true,
    show,
};

const MIB: u64 = 1 << 20;

fn show(ui: &mut egui::Ui, state: &mut State) {
    let build = &mut state.wanted.build;
    egui::Grid::new("build settings").num_columns(2).show(ui, |ui| {
        row(
            ui,
            "Root margin",
            "How far the root cell reaches beyond the scene's bounds on every side, in the scene's \
             units of length.",
            |ui| {
                let speed = (build.root_margin * 0.02).max(1e-5);
                ui.add(
                    egui::DragValue::new(&mut build.root_margin)
                        .range(0.0..=1e6)
                        .speed(speed)
                        .max_decimals(9)
                        .suffix(" units"),
                )
                .accessible_name("Root margin");
            },
        );
        row(
            ui,
            "Overlap",
            "When an object belongs to a cell: as the paper's figures show for the method at hand; \
             when its bounding box touches the cell; or when it shares a point with the cell.",
            |ui| {
                egui::ComboBox::from_id_salt("overlap")
                    .selected_text(build.overlap.name())
                    .width(90.0)
                    .show_ui(ui, |ui| {
                        for rule in OverlapRule::ALL {
                            ui.selectable_value(&mut build.overlap, rule, rule.name())
                                .on_hover_text(build.method.overlap_text(rule));
                        }
                    })
                    .response
                    .on_hover_text(build.method.overlap_text(build.overlap));
            },
        );
        row(
            ui,
            "First axis",
            "The axis that methods in cyclic order split first.",
            |ui| {
                for axis in Axis::ALL {
                    ui.selectable_value(&mut build.first_axis, axis, axis.name());
                }
            },
        );
        row(
            ui,
            "Memory limit",
            "The build stops with a message before the tree takes more than this.",
            |ui| {
                let mut mib = build.memory_limit / MIB;
                let edit = egui::DragValue::new(&mut mib)
                    .range(1..=1 << 20)
                    .speed(8.0)
                    .suffix(" MiB");
                if ui.add(edit).accessible_name("Memory limit").changed() {
                    build.memory_limit = mib * MIB;
                }
            },
        );
    });
    constants(ui, build);
}

fn constants(ui: &mut egui::Ui, build: &mut BuildSettings) {
    let method = build.method;
    ui.add_space(4.0);
    ui.label(method.title)
        .on_hover_text(format!("{}\nSource: {}", method.about, method.source));
    if method.constants.is_empty() {
        ui.weak("This method has no settings of its own.");
    } else {
        egui::Grid::new("constants").num_columns(2).show(ui, |ui| {
            for c in method.constants {
                let mut value = build.constant(c.name);
                row(ui, c.name, &about(c), |ui| edit(ui, c, &mut value));
                if value == c.default {
                    build.constants.remove(c.name);
                } else {
                    build.constants.insert(c.name.to_owned(), value);
                }
            }
        });
    }
    let paper = BuildSettings::for_method(method);
    if ui
        .add_enabled(*build != paper, egui::Button::new("Reset to the paper's"))
        .on_hover_text(tip(
            "All settings of the tree as in the paper, D_MAX and N_OILF too.",
            Action::ResetMethod,
        ))
        .clicked()
    {
        *build = paper;
    }
}

fn about(c: &Constant) -> String {
    let unit = if c.unit.is_empty() {
        "plain number"
    } else {
        c.unit
    };
    format!(
        "{}\nFrom {} to {}, default {} ({unit}).\nSource: {}",
        c.about, c.lowest, c.highest, c.default, c.source
    )
}

/// A switch for what goes from 0 to 1 in steps of 1, else a number.
fn edit(ui: &mut egui::Ui, c: &Constant, value: &mut f64) {
    if c.step == 1.0 && c.lowest == 0.0 && c.highest == 1.0 {
        let mut on = *value != 0.0;
        let state = if on { "on (1)" } else { "off (0)" };
        ui.checkbox(&mut on, state).on_hover_text(about(c));
        *value = f64::from(u8::from(on));
        return;
    }
    let speed = if c.step > 0.0 {
        0.05
    } else {
        // Small numbers are moved in small steps.
        (value.abs() * 0.02).clamp((c.highest - c.lowest) * 1e-7, (c.highest - c.lowest) * 0.01)
    };
    let mut drag = egui::DragValue::new(value)
        .range(c.lowest..=c.highest)
        .speed(speed)
        .max_decimals(if c.step > 0.0 { 0 } else { 9 });
    if c.step == 0.0 {
        drag = drag.custom_formatter(|v, _| {
            if v != 0.0 && v.abs() < 1e-3 {
                format!("{v:e}")
            } else {
                format!("{v}")
            }
        });
    }
    ui.add(drag).on_hover_text(about(c));
    if !c.unit.is_empty() {
        ui.weak(c.unit);
    }
}
