//! What is shown of every pixel, to and from a workspace.

use super::HeatView;
use super::choice::Choice;
use crate::measure::heat::{RayFilter, heatmaps};
use crate::present::overlay::{COLORMAPS, Scale};
use crate::workspace::Heat;

impl HeatView {
    /// Writes how heatmaps are shown to what a workspace keeps, which names the heatmap on view already.
    /// Of the locked ranges only the one on view is kept.
    pub fn save(&self, kept: &mut Heat) {
        let choice = &self.choice;
        let [colors, difference_colors] = choice.both_colors();
        *kept = Heat {
            rays: choice.chosen_rays().name().to_owned(),
            scale: choice.scale.name().to_owned(),
            colors: COLORMAPS[colors].name.to_owned(),
            difference_colors: COLORMAPS[difference_colors].name.to_owned(),
            range: place_of(kept).and_then(|place| choice.locked(place)),
            // To a thousandth, as its slider shows it.
            opacity: (f64::from(choice.opacity) * 1e3).round() / 1e3,
            show: kept.show.take(),
        };
    }

    /// Shows heatmaps as a workspace says, of values or of differences.
    pub fn load(&mut self, kept: &Heat, differences: bool) {
        let place = |name: &str| COLORMAPS.iter().position(|map| map.name == name);
        let default = Choice::default().both_colors();
        let colors = [
            place(&kept.colors).unwrap_or(default[0]),
            place(&kept.difference_colors).unwrap_or(default[1]),
        ];
        let mut choice = Choice::with_colors(colors);
        choice.scale = Scale::named(&kept.scale).unwrap_or_default();
        choice.opacity = kept.opacity as f32;
        choice.differences = differences;
        choice.set_rays(RayFilter::named(&kept.rays).unwrap_or_default());
        if let Some(place) = place_of(kept) {
            choice.lock(place, kept.range);
        }
        self.choice = choice;
    }
}

/// The heatmap that a workspace names, by its place.
fn place_of(kept: &Heat) -> Option<usize> {
    let show = kept.show.as_deref();
    heatmaps().iter().position(|map| Some(map.symbol) == show)
}
