//! The picked pixel: its colour, the object hit, and the leaves its primary ray visited, in order.

use super::{Panel, Side};
use crate::gui::picture_pane::color_text;
use crate::gui::state::{Current, Picked, State};
use crate::gui::symbol::grouped;
use crate::scene::Material;
use crate::trace::LeafStep;
use egui_extras::{Column, TableBuilder};

pub(super) const PANEL: Panel = Panel {
    title: "Picked pixel",
    side: Side::Right,
    open: true,
    show,
};

fn show(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        ui.weak("No picture yet");
        return;
    };
    let Some(picked) = &current.picked else {
        ui.weak("Click a pixel of the picture to follow its ray.");
        return;
    };
    let [x, y] = picked.pixel;
    ui.label(format!("Pixel {x}, {y} (from the upper left)"));
    ui.label(color_text(current.shown.picture.get(x, y)));
    object(ui, current, picked);
    leaves(ui, picked);
}

/// A kind of primitive in the singular.
fn singular(current: &Current, object: u32) -> &'static str {
    use crate::primitive::Primitive;
    match &current.shown.scene.objects()[object as usize] {
        Primitive::Sphere(_) => "sphere",
        Primitive::Triangle(_) => "triangle",
        Primitive::Polygon(_) => "polygon",
        Primitive::Cone(c) if c.is_cylinder() => "cylinder",
        Primitive::Cone(_) => "cone",
    }
}

fn object(ui: &mut egui::Ui, current: &Current, picked: &Picked) {
    let hit = picked.path.hit;
    if !hit.is_hit() {
        ui.strong("Hits nothing: background");
        return;
    }
    let kind = singular(current, hit.object);
    ui.strong(format!("Hits {kind} number {}", hit.object));
    ui.label(format!("at a distance of {:.6} units", hit.t));
    ui.add(egui::Label::new(material_text(current.shown.scene.material(hit.object))).wrap())
        .on_hover_text(
            "Linear colour, diffuse share Kd, specular share Ks, exponent of the highlight Shine, \
             transmittance T, index of refraction",
        );
}

fn material_text(m: &Material) -> String {
    let mut text = format!(
        "Material: colour {:.3} {:.3} {:.3} · Kd {} · Ks {} · Shine {}",
        m.color.x, m.color.y, m.color.z, m.diffuse, m.specular, m.shine
    );
    if m.transmittance > 0.0 {
        text += &format!(" · T {} · index {}", m.transmittance, m.index_of_refraction);
    }
    text
}

/// The leaves in the order of the visits.
fn leaves(ui: &mut egui::Ui, picked: &Picked) {
    let path = &picked.path;
    let counts = path.counts();
    let leaves: Vec<_> = path.leaves().collect();
    ui.add(
        egui::Label::new(format!(
            "Its ray visits {} leaves ({} empty) and {} inner nodes, and makes {} intersection tests:",
            counts.leaves, counts.empty_leaves, counts.inner_nodes, counts.tests
        ))
        .wrap(),
    );
    ui.push_id("leaves", |ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let row = ui.text_style_height(&egui::TextStyle::Body);
        TableBuilder::new(ui)
            .striped(true)
            .vscroll(true)
            .max_scroll_height(190.0)
            .auto_shrink([false, true])
            .column(Column::exact(24.0))
            .column(Column::exact(50.0))
            .column(Column::exact(38.0))
            .column(Column::exact(50.0))
            .column(Column::exact(110.0))
            .column(Column::remainder().clip(true))
            .header(row, |mut header| {
                for (title, about) in [
                    ("#", "Order of the visits"),
                    ("node", "Index of the node in the tree's array"),
                    ("depth", "Levels below the root"),
                    ("objects", "Objects that the leaf refers to"),
                    ("from – to", "Distance along the ray, in units of the scene"),
                    ("became a leaf", "Why the cell was not split"),
                ] {
                    header.col(|ui| {
                        ui.strong(title).on_hover_text(about);
                    });
                }
            })
            .body(|body| {
                body.rows(row, leaves.len(), |mut line| {
                    let i = line.index();
                    let leaf = leaves[i];
                    let objects = if leaf.objects == 0 {
                        "empty".to_owned()
                    } else {
                        grouped(leaf.objects as usize)
                    };
                    for text in [
                        (i + 1).to_string(),
                        grouped(leaf.node as usize),
                        leaf.depth.to_string(),
                        objects,
                        format!("{} – {}", short(leaf.t_enter), short(leaf.t_exit)),
                        leaf.stop.text().to_owned(),
                    ] {
                        line.col(|ui| {
                            ui.add(
                                egui::Label::new(text.as_str())
                                    .truncate()
                                    .show_tooltip_when_elided(false),
                            )
                            .on_hover_text(story(leaf));
                        });
                    }
                });
            });
    });
}

/// What happened in a leaf, in words.
fn story(leaf: &LeafStep) -> String {
    let hits: Vec<String> = leaf
        .tests
        .iter()
        .filter_map(|test| {
            Some(format!(
                "object {} at {} units",
                test.object,
                short(test.hit?)
            ))
        })
        .collect();
    let mut text = format!(
        "A leaf because: {}\nIntersection tests: {}",
        leaf.stop.text(),
        leaf.tests.len()
    );
    if !hits.is_empty() {
        text += &format!("\nHits nearer than all before: {}", hits.join(", "));
    }
    text + "\nThen: " + leaf.after.text()
}

/// A distance in few characters.
fn short(t: f64) -> String {
    if t.abs() >= 1e5 || (t != 0.0 && t.abs() < 1e-3) {
        format!("{t:.2e}")
    } else {
        format!("{t:.4}")
    }
}
