//! The row above the picture: what is shown of which rays, scale, range, colours, and the way to
//! the most expensive pixels.

use super::HeatView;
use super::choice::Choice;
use crate::gui::action::{shortcut, tip};
use crate::measure::heat::{Heatmap, heatmaps};
use crate::present::overlay::{COLORMAPS, Scale};
use egui::containers::menu::{MenuButton, MenuConfig};

impl HeatView {
    /// Shows the row; what does not fit goes into a second one.
    pub fn controls(&mut self, ui: &mut egui::Ui) {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            what(ui, &mut self.choice);
            let Some((_, heatmap)) = self.choice.heatmap() else {
                return;
            };
            rays(ui, &mut self.choice, heatmap);
            let mut log = self.choice.scale == Scale::Logarithmic;
            let about = "Colours by the logarithm of the value: small values come apart.";
            ui.checkbox(&mut log, "log")
                .on_hover_text(tip(about, "picture.log-scale"));
            if log != (self.choice.scale == Scale::Logarithmic) {
                self.choice.turn_scale();
            }
            self.lock(ui);
            self.details(ui, heatmap);
            self.expensive(ui);
        });
    }

    fn lock(&mut self, ui: &mut egui::Ui) {
        let locked = self.choice.locked().is_some();
        let possible = locked || self.range_on_view().is_some();
        let mut wanted = locked;
        let about = "Keep the range of the colours for every picture from now on, so that two \
                     trees can be compared by their colours.";
        ui.add_enabled(possible, egui::Checkbox::new(&mut wanted, "lock range"))
            .on_hover_text(tip(about, "picture.lock-range"));
        if wanted != locked {
            self.toggle_lock();
        }
    }

    /// Colour map, ends of the range, and how much of the picture is hidden.
    fn details(&mut self, ui: &mut egui::Ui, heatmap: &Heatmap) {
        let config =
            MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let (button, _) = MenuButton::new("Colours …").config(config).ui(ui, |ui| {
            // Not a menu's style: here a button without a frame looks like text.
            ui.reset_style();
            ui.set_min_width(230.0);
            ui.strong("Colours");
            for (place, map) in COLORMAPS.iter().enumerate() {
                let name = format!("{}: {}", map.name, map.about);
                if ui.radio(self.choice.colors() == place, name).clicked() {
                    self.choice.set_colors(place);
                }
            }
            ui.separator();
            self.ends(ui, heatmap);
            ui.separator();
            ui.label("Over the picture")
                .on_hover_text("0 % leaves the picture, 100 % hides it.");
            let mut percent = self.choice.opacity * 100.0;
            ui.horizontal(|ui| {
                // A suffix or a tooltip of its own would become the widget's name.
                let slider = egui::Slider::new(&mut percent, 0.0..=100.0).fixed_decimals(0);
                ui.name_inputs("Over the picture", |ui| ui.add(slider));
                ui.label("%");
            });
            self.choice.opacity = percent / 100.0;
        });
        button.on_hover_text("Colour map, ends of the range, blending with the picture.");
    }

    /// The two ends of the range; editing one locks it.
    fn ends(&mut self, ui: &mut egui::Ui, heatmap: &Heatmap) {
        let locked = self.choice.locked();
        ui.label(if locked.is_some() {
            "Range, locked"
        } else {
            "Range, automatic; a change locks it"
        });
        let Some(before) = locked.or_else(|| self.range_on_view()) else {
            ui.weak("There are no values yet.");
            return;
        };
        let [mut lo, mut hi] = before;
        let grain = heatmap.grain;
        let speed = ((hi - lo) * 0.005).max(grain * 0.1);
        for (name, value, range) in [
            ("from", &mut lo, f64::MIN..=before[1] - grain),
            ("to", &mut hi, before[0] + grain..=f64::MAX),
        ] {
            ui.horizontal(|ui| {
                ui.label(name);
                let edit = egui::DragValue::new(value)
                    .range(range)
                    .clamp_existing_to_range(false)
                    .speed(speed)
                    .max_decimals(3);
                ui.name_inputs(format!("Range {name}"), |ui| ui.add(edit));
                ui.label(heatmap.unit);
            });
        }
        if [lo, hi] != before {
            self.choice.lock(Some([lo, hi]));
        }
        let whole = self
            .look()
            .and_then(|look| look.values.statistics)
            .filter(|found| found.lowest < found.highest);
        if let Some(found) = whole
            && locked.is_some()
            && ui.button("Span this picture's values").clicked()
        {
            self.choice.lock(Some([found.lowest, found.highest]));
        }
    }

    /// Buttons to the pixels in the order of their values.
    fn expensive(&mut self, ui: &mut egui::Ui) {
        let some = self
            .look()
            .is_some_and(|look| look.values.statistics.is_some());
        ui.label("costliest:")
            .on_hover_text("Pixels in the order of the values shown, from the highest.");
        for (sign, by, action, name, about) in [
            (
                "<",
                -1,
                "picture.more-expensive",
                "Previous costliest pixel",
                "pick the pixel before this one in the order of the values shown.",
            ),
            (
                ">",
                1,
                "picture.less-expensive",
                "Next costliest pixel",
                "pick the pixel of the highest value shown, then the one of the next.",
            ),
        ] {
            let button = ui.add_enabled(some, egui::Button::new(sign));
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, some, name));
            if button
                .on_hover_text(tip(&format!("{name}: {about}"), action))
                .clicked()
            {
                self.step_by_cost(by);
            }
        }
    }
}

/// The picture or one of the heatmaps.
fn what(ui: &mut egui::Ui, choice: &mut Choice) {
    let now = choice
        .heatmap()
        .map_or("picture", |(_, heatmap)| heatmap.symbol);
    let response = egui::ComboBox::from_id_salt("heatmap")
        .selected_text(format!("Show: {now}"))
        .width(128.0)
        .height(400.0)
        .show_ui(ui, |ui| {
            ui.selectable_value(&mut choice.heatmap, None, "picture")
                .on_hover_text("The traced picture alone");
            for (place, heatmap) in heatmaps().iter().enumerate() {
                let name = format!("{} · {}", heatmap.symbol, heatmap.name);
                ui.selectable_value(&mut choice.heatmap, Some(place), name)
                    .on_hover_text(format!("{}\nIn {}", heatmap.meaning, heatmap.unit));
            }
        })
        .response;
    let about = choice.heatmap().map_or_else(
        || "What is shown of every pixel: the picture, or what it cost.".to_owned(),
        |(_, heatmap)| format!("{}: {}", heatmap.name, heatmap.meaning),
    );
    response.on_hover_text(format!(
        "{about}\nShortcuts: {} and {}",
        shortcut("picture.next-heatmap"),
        shortcut("picture.previous-heatmap")
    ));
}

fn rays(ui: &mut egui::Ui, choice: &mut Choice, heatmap: &Heatmap) {
    let filters = heatmap.filters();
    let now = choice.rays();
    ui.add_enabled_ui(filters.len() > 1, |ui| {
        egui::ComboBox::from_id_salt("heatmap rays")
            .selected_text(format!("Rays: {}", now.name()))
            .width(110.0)
            .show_ui(ui, |ui| {
                for &filter in filters {
                    if ui
                        .selectable_label(filter == now, format!("{} rays", filter.name()))
                        .clicked()
                    {
                        choice.set_rays(filter);
                    }
                }
            })
            .response
            .on_hover_text("Which of a pixel's rays are looked at.")
            .on_disabled_hover_text("This is not told apart by kinds of rays.");
    });
}
