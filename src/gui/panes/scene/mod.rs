//! What the scene contains, what rendering it needs, and the load report.

use crate::gui::document::Document;
use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::theme::heading;
use crate::gui::widgets::common::no_picture;
use crate::gui::widgets::symbol::grouped;
use crate::scene::{Note, NoteKind};

#[derive(Default)]
pub struct ScenePane;

impl Pane for ScenePane {
    const ID: &'static str = "scene";
    const TITLE: &'static str = "Scene";
    const ABOUT: &'static str =
        "What the scene contains, what rendering it needs, and the load report.";
    const REVEALS: &'static [Fact] = &[];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        show(ui, cx.doc);
    }
}

fn show(ui: &mut egui::Ui, doc: &Document) {
    let Some(current) = &doc.current else {
        no_picture(ui, doc);
        return;
    };
    let scene = &current.shown.scene;
    let requirements = scene.requirements();
    ui.label(heading(scene.name()));
    for (kind, count) in &requirements.primitives {
        ui.label(format!("{}: {}", kind.plural(), grouped(*count)));
    }
    ui.label(format!("lights: {}", scene.lights().len()));
    if scene.objects().is_empty() {
        ui.label("No objects");
    } else {
        let size = scene.bounds().size();
        ui.label(format!(
            "{:.4} × {:.4} × {:.4} units",
            size.x, size.y, size.z
        ))
        .on_hover_text("Width, depth and height (x, y, z) of the tight box around all objects");
    }
    load_report(ui, scene.notes());
    list(
        ui,
        "Needs",
        &[
            (requirements.reflects, "reflected rays"),
            (requirements.refracts, "refracted rays"),
            (requirements.casts_shadows, "shadow rays"),
            (requirements.interpolates_normals, "interpolated normals"),
        ]
        .into_iter()
        .filter(|(needed, _)| *needed)
        .map(|(_, what)| what.to_owned())
        .collect::<Vec<_>>(),
    );
    list(ui, "Not needed", &requirements.unneeded());
}

/// What the reader read, skipped, changed and replaced by defaults.
fn load_report(ui: &mut egui::Ui, notes: &[Note]) {
    if notes.iter().any(|note| note.kind == NoteKind::Read) {
        ui.add_space(4.0);
        ui.label(heading("Load report"));
    }
    for kind in NoteKind::ALL {
        let of_kind = notes.iter().filter(|note| note.kind == kind);
        let texts: Vec<_> = of_kind.map(|note| note.text.clone()).collect();
        list(ui, kind.title(), &texts);
    }
}

fn list(ui: &mut egui::Ui, title: &str, items: &[String]) {
    if items.is_empty() {
        return;
    }
    ui.add_space(4.0);
    ui.label(crate::gui::theme::strong(title));
    for item in items {
        ui.add(egui::Label::new(format!("• {item}")).wrap());
    }
}
