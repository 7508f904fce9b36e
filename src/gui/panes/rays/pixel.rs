//! The picked pixel: its color and the object that its primary ray hits.

use crate::gui::document::picked::Picked;
use crate::gui::document::{Current, Document};
use crate::gui::widgets::color_text::color_text;
use crate::gui::widgets::step_text;
use crate::scene::Material;

pub fn show(ui: &mut egui::Ui, doc: &Document) {
    let Some(current) = &doc.current else {
        ui.weak("No picture yet");
        return;
    };
    let Some(picked) = &current.picked else {
        ui.weak("Click a pixel of the picture to see its rays.");
        return;
    };
    let [x, y] = picked.pixel;
    ui.label(format!("Pixel {x}, {y} (from the upper left)"));
    ui.label(color_text(current.shown.picture.get(x, y)));
    object(ui, current, picked);
}

fn object(ui: &mut egui::Ui, current: &Current, picked: &Picked) {
    let hit = picked.primary().hit;
    if !hit.is_hit() {
        ui.strong("Hits nothing: background");
        return;
    }
    let object = step_text::object(&current.shown.scene, hit.object);
    ui.strong(format!("Hits {object}"));
    ui.label(format!("at a distance of {:.6} units", hit.t));
    ui.add(egui::Label::new(material_text(current.shown.scene.material(hit.object))).wrap())
        .on_hover_text(
            "Linear color, diffuse share Kd, specular share Ks, exponent of the highlight Shine, \
             transmittance T, index of refraction",
        );
}

fn material_text(m: &Material) -> String {
    let mut text = format!(
        "Material: color {:.3} {:.3} {:.3} · Kd {} · Ks {} · Shine {}",
        m.color.x, m.color.y, m.color.z, m.diffuse, m.specular, m.shine
    );
    if m.transmittance > 0.0 {
        text += &format!(" · T {} · index {}", m.transmittance, m.index_of_refraction);
    }
    text
}
