//! How the picture pane shows heatmaps, as the user chose it.

use crate::measure::heat::{Heatmap, RayFilter, heatmaps};
use crate::present::overlay::{COLORMAPS, HeatScale, Range, Scale};
use std::collections::BTreeMap;

/// How heatmaps are shown. Which one is shown is chosen in the document. Heatmaps and color maps are
/// named by their place in their registries.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Kept while a heatmap is shown that does not distinguish kinds of rays.
    rays: RayFilter,
    pub scale: Scale,
    /// Of values, and of differences.
    colors: [usize; 2],
    /// Whether differences of two pictures are shown.
    pub differences: bool,
    /// How much of the picture the heatmap hides, 0 to 1.
    pub opacity: f32,
    /// By heatmap, and whether of differences: the values of one have another range than those of another.
    locked: BTreeMap<(usize, bool), [f64; 2]>,
}

impl Default for Choice {
    fn default() -> Self {
        Choice {
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
    /// Returns the rays that a heatmap shows: all, if it does not distinguish the chosen ones.
    pub fn rays(&self, heatmap: &Heatmap) -> RayFilter {
        if heatmap.filters().contains(&self.rays) {
            self.rays
        } else {
            RayFilter::All
        }
    }

    /// Returns the chosen rays, whether or not the heatmap on view distinguishes them.
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

    /// The color map in use, by its place.
    pub fn colors(&self) -> usize {
        self.colors[usize::from(self.differences)]
    }

    /// The color maps of values and of differences, by their places.
    pub fn both_colors(&self) -> [usize; 2] {
        self.colors
    }

    /// The default with these color maps of values and of differences.
    pub fn with_colors(colors: [usize; 2]) -> Choice {
        Choice {
            colors,
            ..Choice::default()
        }
    }

    pub fn set_colors(&mut self, place: usize) {
        self.colors[usize::from(self.differences)] = place;
    }

    /// Returns the range that a heatmap is locked to.
    pub fn locked(&self, heatmap: usize) -> Option<[f64; 2]> {
        self.locked.get(&(heatmap, self.differences)).copied()
    }

    pub fn range(&self, heatmap: usize) -> Range {
        self.locked(heatmap)
            .map_or(Range::Automatic, |[lo, hi]| Range::Fixed { lo, hi })
    }

    /// Locks a heatmap to a range, or unlocks it.
    pub fn lock(&mut self, heatmap: usize, range: Option<[f64; 2]>) {
        let key = (heatmap, self.differences);
        match range {
            Some(range) => {
                self.locked.insert(key, range);
            }
            None => {
                self.locked.remove(&key);
            }
        }
    }
}

/// Returns the heatmap after one, or before it, in a circle of the picture alone and all heatmaps.
pub fn next_heatmap(now: Option<usize>, forward: bool) -> Option<usize> {
    let all = heatmaps().len() + 1;
    let at = now.map_or(0, |place| place + 1);
    let next = (at + if forward { 1 } else { all - 1 }) % all;
    next.checked_sub(1)
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
        let mut heatmap = None;
        let mut met = Vec::new();
        for _ in 0..heatmaps().len() {
            heatmap = next_heatmap(heatmap, true);
            met.push(heatmap.unwrap());
        }
        assert_eq!(met, (0..heatmaps().len()).collect::<Vec<_>>());
        assert_eq!(next_heatmap(heatmap, true), None);
        assert_eq!(next_heatmap(None, false), Some(heatmaps().len() - 1));
    }

    #[test]
    fn a_lock_belongs_to_one_heatmap_and_rays_to_those_that_tell_them_apart() {
        let mut choice = Choice::default();
        choice.lock(0, Some([1.0, 2.0]));
        choice.set_rays(RayFilter::Shadow);
        assert_eq!(choice.range(0), Range::Fixed { lo: 1.0, hi: 2.0 });
        assert_eq!(choice.rays(&heatmaps()[0]), RayFilter::Shadow);
        let time = heatmaps().iter().position(|h| h.symbol == "T_PIXEL");
        let time = time.expect("a heatmap of times");
        assert_eq!(choice.range(time), Range::Automatic);
        assert_eq!(choice.rays(&heatmaps()[time]), RayFilter::All);
        choice.differences = true;
        assert_eq!(choice.range(0), Range::Automatic);
        choice.differences = false;
        choice.lock(0, None);
        assert_eq!(choice.range(0), Range::Automatic);
    }
}
