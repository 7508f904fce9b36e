//! What is shown of every pixel, to and from a workspace.

use super::HeatView;
use super::choice::Choice;
use crate::measure::heat::{RayFilter, heatmaps};
use crate::present::overlay::{COLORMAPS, Scale};
use crate::workspace::Heat;

impl HeatView {
    /// As a workspace has it. Of locked ranges only that on view is kept.
    pub fn kept(&self) -> Heat {
        let choice = &self.choice;
        let [colors, difference_colors] = choice.both_colors();
        Heat {
            show: choice.heatmap().map(|(_, map)| map.symbol.to_owned()),
            rays: choice.chosen_rays().name().to_owned(),
            scale: choice.scale.name().to_owned(),
            colors: COLORMAPS[colors].name.to_owned(),
            difference_colors: COLORMAPS[difference_colors].name.to_owned(),
            range: choice.locked(),
            // To a thousandth, as its slider shows it.
            opacity: (f64::from(choice.opacity) * 1e3).round() / 1e3,
        }
    }

    /// Shows what a workspace says, of values or of differences.
    pub fn restore(&mut self, kept: &Heat, differences: bool) {
        let place = |name: &str| COLORMAPS.iter().position(|map| map.name == name);
        let default = Choice::default().both_colors();
        let colors = [
            place(&kept.colors).unwrap_or(default[0]),
            place(&kept.difference_colors).unwrap_or(default[1]),
        ];
        let mut choice = Choice::with_colors(colors);
        choice.heatmap = heatmaps()
            .iter()
            .position(|map| Some(map.symbol) == kept.show.as_deref());
        choice.scale = Scale::named(&kept.scale).unwrap_or_default();
        choice.opacity = kept.opacity as f32;
        choice.differences = differences;
        choice.set_rays(RayFilter::named(&kept.rays).unwrap_or_default());
        choice.lock(kept.range);
        self.choice = choice;
    }
}
