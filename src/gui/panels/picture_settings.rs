//! How the picture is traced: size, samples, threads, camera, cylinders.

use super::{Panel, Side, row};
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::State;
use crate::scene::{CameraOverride, Cylinders, Sampling};
use crate::trace::{KernelChoice, PrecisionChoice};

pub(super) const PANEL: Panel = Panel {
    title: "Picture",
    side: Side::Left,
    open: true,
    show,
};

fn show(ui: &mut egui::Ui, state: &mut State) {
    let largest = ui.input(|i| i.max_texture_side).min(16_384) as u32;
    let wanted = &mut state.wanted;
    let render = &mut wanted.render;
    egui::Grid::new("picture settings").num_columns(2).show(ui, |ui| {
        for (name, value, symbol) in [
            ("Width", &mut render.width, "N_X"),
            ("Height", &mut render.height, "N_Y"),
        ] {
            let about = format!("{name} of the picture in pixels, {symbol}.");
            row(ui, name, &about, |ui| {
                ui.add(
                    egui::DragValue::new(value)
                        .range(1..=largest)
                        .suffix(" pixels")
                        .update_while_editing(false),
                )
                .accessible_name(name);
            });
        }
        row(
            ui,
            "Sampling",
            "Where a pixel's first sample lies: at its centre, or on a lattice whose first and last \
             samples span the angle of view.",
            |ui| {
                ui.selectable_value(&mut render.sampling, Sampling::Center, "centre");
                ui.selectable_value(&mut render.sampling, Sampling::Corner, "corner");
            },
        );
        row(
            ui,
            "Samples",
            "Samples a pixel in the finished picture; figures are always measured with one.",
            |ui| {
                ui.add(
                    egui::DragValue::new(&mut render.samples)
                        .range(1..=4096)
                        .speed(0.1)
                        .suffix(" a pixel"),
                )
                .accessible_name("Samples");
            },
        );
        row(
            ui,
            "Precision",
            "The numbers that rays are traced in. auto takes f32 where it can hold the scene as the \
             camera sees it, else f64.",
            |ui| {
                let asked = &mut render.precision;
                let list = egui::ComboBox::from_id_salt("precision")
                    .selected_text(asked.name())
                    .show_ui(ui, |ui| {
                        for choice in PrecisionChoice::ALL {
                            ui.selectable_value(asked, choice, choice.name());
                        }
                    });
                if let Some(current) = &state.current {
                    let used = &current.shown.measurement.precision;
                    let about = format!("Used: {used}.");
                    list.response.on_hover_text(&about);
                    let asked = current.shown.setup.render.precision;
                    if asked == PrecisionChoice::Auto {
                        let used = format!("took {}", used.precision.name());
                        ui.weak(used).on_hover_text(&about);
                    }
                }
            },
        );
        row(
            ui,
            "Kernel",
            "How timed rendering traces rays: scalar, one after the other through exactly the nodes that \
             are counted, as in the paper; stream, batches of rays in SIMD; packets, neighboring rays \
             that traverse together in SIMD; auto, packets where rays are coherent, stream elsewhere, \
             scalar where the processor has no wide SIMD. All give the same hits.",
            |ui| {
                let asked = &mut render.kernel;
                egui::ComboBox::from_id_salt("kernel")
                    .selected_text(asked.name())
                    .show_ui(ui, |ui| {
                        for choice in KernelChoice::ALL {
                            ui.selectable_value(asked, choice, choice.name());
                        }
                    })
                    .response
                    .on_hover_text(format!("On this processor: {}.", asked.description()));
            },
        );
        row(
            ui,
            "Threads",
            "Threads that trace; 0 takes as many as the machine has cores.",
            |ui| {
                ui.add(egui::DragValue::new(&mut render.threads).range(0..=256).speed(0.05));
                if render.threads == 0 {
                    let cores = std::thread::available_parallelism().map_or(1, usize::from);
                    ui.weak(format!("all {cores} cores"));
                }
            },
        );
        row(
            ui,
            "Cylinders",
            "Cylinders and cones as the exact surfaces they are, or as open prisms of polygons, as \
             the paper took them.",
            |ui| cylinders(ui, &mut wanted.scene.cylinders),
        );
    });
    let own = !wanted.render.camera.is_none();
    if ui
        .add_enabled(own, egui::Button::new("Scene's own camera"))
        .on_hover_text(tip(
            "Look at the scene as its file says, as measurements do.",
            Action::SceneCamera,
        ))
        .clicked()
    {
        wanted.render.camera = CameraOverride::default();
    }
}

fn cylinders(ui: &mut egui::Ui, cylinders: &mut Cylinders) {
    let mut polygons = matches!(cylinders, Cylinders::Polygons(_));
    ui.checkbox(&mut polygons, "as polygons");
    match (polygons, &mut *cylinders) {
        (true, Cylinders::Polygons(sides)) => {
            ui.add(
                egui::DragValue::new(sides)
                    .range(3..=1000)
                    .speed(0.1)
                    .suffix(" sides"),
            )
            .accessible_name("Sides of the polygons");
        }
        (true, Cylinders::Exact) => *cylinders = Cylinders::Polygons(8),
        (false, _) => *cylinders = Cylinders::Exact,
    }
}
