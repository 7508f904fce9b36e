//! All settings of the experiment, made from the registry of settings.

use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::theme::heading;
use crate::gui::widgets::setting_widget::{Around, rows};
use crate::scene::CameraOverride;
use crate::setup::{Group, SETTINGS, Setting, Setup};
use crate::structure::BuildSettings;
use crate::trace::PrecisionChoice;

/// The settings of the tree in front.
#[derive(Default)]
pub struct SettingsPane;

impl Pane for SettingsPane {
    const ID: &'static str = "settings";
    const TITLE: &'static str = "Settings";
    const ALIASES: &'static [&'static str] = &["Tree"];
    const ABOUT: &'static str = "How the tree is built and how the picture is rendered.";
    const REVEALS: &'static [Fact] = &[];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let note = |setting: &Setting, setup: &Setup| note(doc, setting, setup);
        let around = Around {
            largest: ui.input(|i| i.max_texture_side).min(16_384) as u32,
            camera: doc.current.as_ref().map(|c| &c.shown.measurement.camera),
            depth_limit: doc.current.as_ref().map(|c| c.shown.tree.depth_limit()),
            root_margin: doc.current.as_ref().map(|c| c.shown.tree.root_margin()),
            slider: None,
            note: &note,
        };
        let setup = &doc.wanted;
        let group = |ui: &mut egui::Ui, group: Group, edits: &mut Edits| {
            let general = SETTINGS.iter().filter(|s| s.group == group).copied();
            section(ui, group.title());
            rows(ui, general, setup, &around, edits);
        };
        group(ui, Group::Structure, cx.edits);
        let constants = setup.build.method.constants;
        if !constants.is_empty() {
            section(ui, &format!("Tree: {} only", setup.build.method.name));
            let own = constants.iter().map(Setting::of_constant);
            rows(ui, own, setup, &around, cx.edits);
        }
        reset_tree(ui, setup, cx.edits);
        group(ui, Group::Picture, cx.edits);
        group(ui, Group::Scene, cx.edits);
        group(ui, Group::Camera, cx.edits);
        reset_camera(ui, setup, cx.edits);
    }
}

fn section(ui: &mut egui::Ui, title: &str) {
    ui.add_space(12.0);
    ui.label(heading(title));
}

fn reset_tree(ui: &mut egui::Ui, setup: &Setup, edits: &mut Edits) {
    let paper = BuildSettings::for_method(setup.build.method);
    let reset = egui::Button::new("Reset to the paper's");
    if ui
        .add_enabled(setup.build != paper, reset)
        .on_hover_text(tip(
            "Set all settings of the tree as in the paper, depth and leaf size too.",
            "window.reset-method",
        ))
        .clicked()
    {
        edits.add(move |doc| doc.wanted.build = paper);
    }
}

fn reset_camera(ui: &mut egui::Ui, setup: &Setup, edits: &mut Edits) {
    let is_moved = !setup.render.camera.is_none();
    if ui
        .add_enabled(is_moved, egui::Button::new("Scene's own camera"))
        .on_hover_text(tip(
            "Look at the scene as its file says, as measurements do.",
            "window.scene-camera",
        ))
        .clicked()
    {
        edits.add(|doc| doc.wanted.render.camera = CameraOverride::default());
    }
}

/// What a setting came to in the picture on view or on this machine.
fn note(doc: &Document, setting: &Setting, setup: &Setup) -> Option<[String; 2]> {
    match setting.name {
        "precision" => {
            let measured = &doc.current.as_ref()?.shown.measurement;
            let used = &measured.precision;
            let in_words = format!("Used: {used}.");
            match measured.render.precision {
                PrecisionChoice::Auto => {
                    Some([format!("used {}", used.precision.name()), in_words])
                }
                _ => used
                    .warning()
                    .map(|warning| ["too imprecise for this scene".to_owned(), warning + "."]),
            }
        }
        "kernel" => {
            let structure = setup.build.method.structure;
            let used = setup.render.kernel.description_for(structure);
            let is_other = used != setup.render.kernel.name();
            is_other.then(|| [used, "On this processor".to_owned()])
        }
        "threads" if setup.render.threads == 0 => {
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            Some([format!("all {cores} cores"), "0 uses all cores".to_owned()])
        }
        _ => None,
    }
}
