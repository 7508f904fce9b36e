//! What the picture pane shows of every pixel, as the user chose it.

use crate::measure::heat::{Heatmap, RayFilter, heatmaps};
use crate::present::overlay::{COLORMAPS, HeatScale, Range, Scale};
use std::collections::BTreeMap;

/// The choice. Heatmaps and colour maps go by their place in their registries.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// `None` for the picture alone.
    pub heatmap: Option<usize>,
    /// Kept for the heatmaps that tell rays apart while one is shown that does not.
    rays: RayFilter,
    pub scale: Scale,
    /// Of values, and of differences.
    colors: [usize; 2],
    /// Whether differences of two pictures are shown.
    pub differences: bool,
    /// How much of the picture the heatmap hides, 0 to 1.
    pub opacity: f32,
    /// By heatmap, and whether of differences: numbers of one make no range for another.
    locked: BTreeMap<(usize, bool), [f64; 2]>,
}

impl Default for Choice {
    fn default() -> Self {
        Choice {
            heatmap: None,
            rays: RayFilter::default(),
            scale: Scale::default(),
            colors: [false, true].map(|diverging| {
                let first = COLORMAPS.iter().position(|c| c.diverging == diverging);
                first.expect("there are maps of both sorts")
            }),
            differences: false,
            opacity: 1.0,
            locked: BTreeMap::new(),
        }
    }
}

impl Choice {
    /// The heatmap, with its place in the registry.
    pub fn heatmap(&self) -> Option<(usize, &'static Heatmap)> {
        let place = self.heatmap?;
        Some((place, &heatmaps()[place]))
    }

    /// Goes through the picture and all heatmaps in a circle.
    pub fn turn(&mut self, forward: bool) {
        let all = heatmaps().len() + 1;
        let at = self.heatmap.map_or(0, |place| place + 1);
        let next = (at + if forward { 1 } else { all - 1 }) % all;
        self.heatmap = next.checked_sub(1);
    }

    /// The rays that are looked at: all, where the heatmap does not tell those chosen apart.
    pub fn rays(&self) -> RayFilter {
        match self.heatmap() {
            Some((_, heatmap)) if heatmap.filters().contains(&self.rays) => self.rays,
            _ => RayFilter::All,
        }
    }

    /// The rays that were chosen, be they told apart by the heatmap or not.
    pub fn chosen_rays(&self) -> RayFilter {
        self.rays
    }

    pub fn set_rays(&mut self, rays: RayFilter) {
        self.rays = rays;
    }

    pub fn turn_scale(&mut self) {
        self.scale = match self.scale {
            Scale::Linear => Scale::Logarithmic,
            Scale::Logarithmic => Scale::Linear,
        };
    }

    /// The colour map in use, by its place.
    pub fn colors(&self) -> usize {
        self.colors[usize::from(self.differences)]
    }

    /// The colour maps of values and of differences, by their places.
    pub fn both_colors(&self) -> [usize; 2] {
        self.colors
    }

    /// The default with these colour maps of values and of differences.
    pub fn with_colors(colors: [usize; 2]) -> Choice {
        Choice {
            colors,
            ..Choice::default()
        }
    }

    pub fn set_colors(&mut self, place: usize) {
        self.colors[usize::from(self.differences)] = place;
    }

    /// The range that the heatmap is locked to.
    pub fn locked(&self) -> Option<[f64; 2]> {
        self.locked.get(&(self.heatmap?, self.differences)).copied()
    }

    pub fn range(&self) -> Range {
        self.locked()
            .map_or(Range::Automatic, |[lo, hi]| Range::Fixed { lo, hi })
    }

    /// Locks the heatmap to a range, or unlocks it.
    pub fn lock(&mut self, range: Option<[f64; 2]>) {
        match (self.heatmap, range) {
            (Some(place), Some(range)) => {
                self.locked.insert((place, self.differences), range);
            }
            (Some(place), None) => {
                self.locked.remove(&(place, self.differences));
            }
            (None, _) => {}
        }
    }
}

/// The range on view, to lock to. A single value gets room: a locked range has two ends.
pub fn range_of(scale: &HeatScale, heatmap: &Heatmap) -> [f64; 2] {
    [scale.lo, scale.hi.max(scale.lo + heatmap.grain)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_meets_every_heatmap_once_and_the_picture() {
        let mut choice = Choice::default();
        let mut met = Vec::new();
        for _ in 0..heatmaps().len() {
            choice.turn(true);
            met.push(choice.heatmap.unwrap());
        }
        assert_eq!(met, (0..heatmaps().len()).collect::<Vec<_>>());
        choice.turn(true);
        assert_eq!(choice.heatmap, None);
        choice.turn(false);
        assert_eq!(choice.heatmap, Some(heatmaps().len() - 1));
    }

    #[test]
    fn a_lock_belongs_to_one_heatmap_and_rays_to_those_that_tell_them_apart() {
        let mut choice = Choice {
            heatmap: Some(0),
            ..Choice::default()
        };
        choice.lock(Some([1.0, 2.0]));
        choice.set_rays(RayFilter::Shadow);
        assert_eq!(choice.range(), Range::Fixed { lo: 1.0, hi: 2.0 });
        assert_eq!(choice.rays(), RayFilter::Shadow);
        let time = heatmaps().iter().position(|h| h.symbol == "T_PIXEL");
        choice.heatmap = time;
        assert_eq!(choice.range(), Range::Automatic);
        assert_eq!(choice.rays(), RayFilter::All);
        choice.heatmap = Some(0);
        assert_eq!(choice.rays(), RayFilter::Shadow);
        choice.lock(None);
        assert_eq!(choice.range(), Range::Automatic);
    }
}
