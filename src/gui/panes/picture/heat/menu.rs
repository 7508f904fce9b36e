//! The menu above the picture: which heatmap is shown, of which rays, and in which colors.

use super::{HeatView, chosen};
use crate::gui::action::{shortcut, tip};
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::gui::theme::hint;
use crate::gui::widgets::common::sentence;
use crate::measure::heat::{Heatmap, heatmaps};
use crate::present::overlay::{COLORMAPS, Scale};

/// Width of either half of the menu in points.
const WIDTH: f32 = 240.0;

/// Returns what is shown, in a word or two.
pub fn title(doc: &Document) -> String {
    let name = chosen(doc).map_or("picture", |(_, heatmap)| heatmap.name);
    sentence(name)
}

/// Shows a list of the picture and all heatmaps.
pub fn list(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    ui.set_width(WIDTH);
    let keys = ["picture.next-heatmap", "picture.previous-heatmap"].map(shortcut);
    ui.label(hint(format!("Show ({} and {})", keys[0], keys[1])));
    let alone = (None, "Picture".to_owned(), "The picture alone.".to_owned());
    let all = heatmaps().iter().enumerate().map(|(place, heatmap)| {
        let name = format!("{} · {}", heatmap.symbol, heatmap.name);
        let about = format!("{}\nIn {}", heatmap.meaning, heatmap.unit);
        (Some(place), name, about)
    });
    for (heatmap, name, about) in std::iter::once(alone).chain(all) {
        let item = ui.radio(doc.heatmap == heatmap, name).on_hover_text(about);
        if item.clicked() {
            edits.add(move |doc| doc.heatmap = heatmap);
            ui.close();
        }
    }
}

impl HeatView {
    /// Shows how the heatmap on view is shown.
    pub fn options(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let Some((place, heatmap)) = chosen(doc) else {
            return;
        };
        ui.set_width(WIDTH);
        self.rays(ui, heatmap);
        ui.separator();
        let mut log = self.choice.scale == Scale::Logarithmic;
        let about = "Colors by the logarithm of the value, which separates small values.";
        ui.checkbox(&mut log, "Logarithmic scale")
            .on_hover_text(tip(about, "picture.log-scale"));
        if log != (self.choice.scale == Scale::Logarithmic) {
            self.choice.turn_scale();
        }
        self.lock(ui, doc, place);
        self.ends(ui, doc, place, heatmap);
        ui.separator();
        self.colors(ui);
        self.opacity(ui);
    }

    fn rays(&mut self, ui: &mut egui::Ui, heatmap: &Heatmap) {
        ui.label(hint("Rays"));
        let filters = heatmap.filters();
        let now = self.choice.rays(heatmap);
        ui.horizontal_wrapped(|ui| {
            for &filter in filters {
                let name = sentence(filter.name());
                let item = ui.radio(filter == now, name);
                let about = format!("Show {} rays of each pixel.", filter.name());
                if item.on_hover_text(about).clicked() {
                    self.choice.set_rays(filter);
                }
            }
        });
    }

    fn lock(&mut self, ui: &mut egui::Ui, doc: &Document, place: usize) {
        let locked = self.choice.locked(place).is_some();
        let possible = locked || self.range_on_view(doc).is_some();
        let mut wanted = locked;
        let about = "Keep the range of the colors for every picture from now on, so that two trees \
                     can be compared by their colors.";
        ui.add_enabled(possible, egui::Checkbox::new(&mut wanted, "Lock range"))
            .on_hover_text(tip(about, "picture.lock-range"));
        if wanted != locked {
            self.toggle_lock(doc);
        }
    }

    /// The two ends of the range; editing one locks it.
    fn ends(&mut self, ui: &mut egui::Ui, doc: &Document, place: usize, heatmap: &Heatmap) {
        let locked = self.choice.locked(place);
        let Some(before) = locked.or_else(|| self.range_on_view(doc)) else {
            ui.weak("There are no values yet.");
            return;
        };
        let [mut lo, mut hi] = before;
        let grain = heatmap.grain;
        let speed = ((hi - lo) * 0.005).max(grain * 0.1);
        ui.horizontal(|ui| {
            for (name, value, range) in [
                ("from", &mut lo, f64::MIN..=before[1] - grain),
                ("to", &mut hi, before[0] + grain..=f64::MAX),
            ] {
                ui.label(name);
                let edit = egui::DragValue::new(value)
                    .range(range)
                    .clamp_existing_to_range(false)
                    .speed(speed)
                    .max_decimals(3);
                ui.name_inputs(format!("Range {name}"), |ui| ui.add(edit));
            }
        });
        if [lo, hi] != before {
            self.choice.lock(place, Some([lo, hi]));
        }
        let found = self.look().and_then(|look| look.values.statistics);
        let whole = found.filter(|found| locked.is_some() && found.lowest < found.highest);
        if let Some(found) = whole
            && ui.button("Span this picture's values").clicked()
        {
            self.choice.lock(place, Some([found.lowest, found.highest]));
        }
    }

    fn colors(&mut self, ui: &mut egui::Ui) {
        ui.label(hint("Colors"));
        ui.horizontal_wrapped(|ui| {
            for (place, map) in COLORMAPS.iter().enumerate() {
                let item = ui.radio(self.choice.colors() == place, map.name);
                if item.on_hover_text(sentence(map.about)).clicked() {
                    self.choice.set_colors(place);
                }
            }
        });
    }

    fn opacity(&mut self, ui: &mut egui::Ui) {
        ui.label(hint("Over the picture"))
            .on_hover_text("0 % shows only the picture, 100 % hides it.");
        let mut percent = self.choice.opacity * 100.0;
        ui.horizontal(|ui| {
            // A suffix or a tooltip of its own would become the widget's name.
            let slider = egui::Slider::new(&mut percent, 0.0..=100.0).fixed_decimals(0);
            ui.name_inputs("Over the picture", |ui| ui.add(slider));
            ui.label("%");
        });
        self.choice.opacity = percent / 100.0;
    }
}
