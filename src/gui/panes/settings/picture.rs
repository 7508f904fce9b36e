//! How the picture is rendered, from where, and how cylinders enter the scene.

use super::build::IN_TOP_BAR;
use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::widgets::setting_widget::{Around, rows};
use crate::scene::CameraOverride;
use crate::setup::{Group, Setting, Setup};
use crate::trace::PrecisionChoice;

pub fn show(ui: &mut egui::Ui, doc: &mut Document) {
    let measured = doc.current.as_ref().map(|c| &c.shown.measurement);
    let note = |setting: &Setting, setup: &Setup| match setting.name {
        "precision" => {
            let measured = measured?;
            let used = &measured.precision;
            let is_auto = measured.render.precision == PrecisionChoice::Auto;
            let used_in_words = format!("Used: {used}.");
            is_auto.then(|| [format!("took {}", used.precision.name()), used_in_words])
        }
        "kernel" => {
            let used = setup.render.kernel.description();
            let is_other = used != setup.render.kernel.name();
            is_other.then(|| [used, "On this processor".to_owned()])
        }
        "threads" if setup.render.threads == 0 => {
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            Some([format!("all {cores} cores"), "0 uses all cores".to_owned()])
        }
        _ => None,
    };
    let around = Around {
        largest: ui.input(|i| i.max_texture_side).min(16_384) as u32,
        camera: measured.map(|measured| &measured.camera),
        note: &note,
    };
    let setup = &mut doc.wanted;
    for (id, groups) in [
        (
            "picture settings",
            [Group::Picture, Group::Scene].as_slice(),
        ),
        ("camera", &[Group::Camera]),
    ] {
        let settings = setup.settings().filter(|s| groups.contains(&s.group));
        let settings = settings.filter(|s| !IN_TOP_BAR.contains(&s.name));
        rows(
            ui,
            id,
            settings.collect::<Vec<_>>().into_iter(),
            setup,
            &around,
        );
    }
    let own = !setup.render.camera.is_none();
    if ui
        .add_enabled(own, egui::Button::new("Scene's own camera"))
        .on_hover_text(tip(
            "Look at the scene as its file says, as measurements do.",
            "window.scene-camera",
        ))
        .clicked()
    {
        setup.render.camera = CameraOverride::default();
    }
}
