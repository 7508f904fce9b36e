//! The bar that steps through the walk of the selected ray, and says what the current step does.

use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::document::walk::{Go, RATES, listed};
use crate::gui::widgets::step_text;

/// Shows the bar; it is always there, so that nothing moves when a pixel is picked.
pub fn show(ui: &mut egui::Ui, doc: &mut Document) {
    ui.horizontal_wrapped(|ui| {
        moves(ui, doc);
        scrubber(ui, doc);
        ui.separator();
        ui.add(
            egui::DragValue::new(&mut doc.walking.rate)
                .range(RATES)
                .speed(0.1)
                .max_decimals(1)
                .suffix(" steps/s"),
        )
        .accessible_name("Speed")
        .on_hover_text("How fast the walk plays, in steps a second.");
        let mut only = doc.walking.leaves_only;
        ui.checkbox(&mut only, "Leaves only")
            .on_hover_text(tip("Pass over inner nodes.", "ray.leaves-only"));
        if only != doc.walking.leaves_only {
            doc.set_leaves_only(only);
        }
        ui.separator();
        ui.add(egui::Label::new(ray_text(doc)).truncate());
    });
    let text = sentence(doc);
    ui.add(egui::Label::new(text.as_str()).truncate())
        .on_hover_text(text);
}

fn moves(ui: &mut egui::Ui, doc: &mut Document) {
    let playing = doc.is_playing();
    let mut button = |ui: &mut egui::Ui, name, about, go, action| {
        let enabled = doc.step_to(go).is_some();
        let button = egui::Button::new(name);
        if ui
            .add_enabled(enabled, button)
            .on_hover_text(tip(about, action))
            .clicked()
        {
            doc.go(go);
        }
    };
    let first = "Back to the first step of the walk.";
    button(ui, "First", first, Go::First, "ray.first-step");
    let previous = "One step back.";
    button(ui, "Previous", previous, Go::Previous, "ray.previous-step");
    button(ui, "Next", "One step on.", Go::Next, "ray.next-step");
    button(
        ui,
        "Last",
        "On to the last step.",
        Go::Last,
        "ray.last-step",
    );
    let can_play = playing || doc.step_to(Go::Next).or(doc.step_to(Go::First)).is_some();
    let name = if playing { "Pause" } else { "Play" };
    // Both names take the same room.
    let button = egui::Button::new(name).min_size(egui::vec2(52.0, 0.0));
    let about = "Let the walk go on by itself, or stop it.";
    if ui
        .add_enabled(can_play, button)
        .on_hover_text(tip(about, "ray.play"))
        .clicked()
    {
        doc.play_or_pause(ui.input(|i| i.time));
    }
}

fn scrubber(ui: &mut egui::Ui, doc: &mut Document) {
    const WIDTH: f32 = 150.0;
    let picked = doc.current.as_ref().and_then(|c| c.picked.as_ref());
    let listed = picked.map_or_else(Vec::new, |p| listed(p.path(), doc.walking.leaves_only));
    let step = picked.map_or(0, |p| p.step);
    let all = picked.map_or(0, |p| p.path().steps.len());
    let at = listed.partition_point(|&i| i < step);
    let mut place = at + 1;
    ui.spacing_mut().slider_width = WIDTH;
    let slider = egui::Slider::new(&mut place, 1..=listed.len().max(1)).show_value(false);
    ui.add_enabled(listed.len() > 1, slider)
        .accessible_name("Step of the walk")
        .on_hover_text("Drag through the steps of the walk.");
    let text = match (all, doc.walking.leaves_only) {
        (0, _) => "step – of –".to_owned(),
        (_, false) => format!("step {} of {all}", step + 1),
        (_, true) => format!(
            "step {} of {all} (leaf {} of {})",
            step + 1,
            (at + 1).min(listed.len()),
            listed.len()
        ),
    };
    let room = if doc.walking.leaves_only {
        200.0
    } else {
        110.0
    };
    let size = egui::vec2(room, ui.spacing().interact_size.y);
    ui.add_sized(size, egui::Label::new(text).truncate());
    if place != at + 1
        && let (Some(&step), Some(current)) = (listed.get(place - 1), &mut doc.current)
    {
        current.go_to_step(step);
    }
}

/// Which ray the walk is of.
fn ray_text(doc: &Document) -> String {
    let Some(current) = &doc.current else {
        return String::new();
    };
    match &current.picked {
        Some(picked) => {
            let [x, y] = picked.pixel;
            format!(
                "ray {} of {} of pixel {x}, {y}: {} ray, {}",
                picked.ray + 1,
                picked.record.rays.len(),
                picked.path().kind.name(),
                step_text::outcome(&current.shown.scene, picked.path())
            )
        }
        None => "no ray".to_owned(),
    }
}

fn sentence(doc: &Document) -> String {
    let Some(current) = &doc.current else {
        return "No picture yet".to_owned();
    };
    if let Some(wish) = current.wish {
        let [x, y] = wish.pixel;
        return format!("Following the rays of pixel {x}, {y} …");
    }
    match &current.picked {
        None => "Pick a pixel to step through the walks of its rays.".to_owned(),
        Some(picked) => match picked.current() {
            Some(step) => step_text::step(&current.shown.scene, picked.step + 1, step),
            None => "This ray misses the root cell: it visits no node.".to_owned(),
        },
    }
}
