//! Heatmaps: what every pixel cost. A heatmap is one file here and one line in [`HEATMAPS`].

mod depth_complexity;
mod empty_leaves;
mod full_leaves;
mod inner_nodes;
mod intersection_tests;
mod leaves;
mod nodes;
mod pixel_counts;
mod rays;
mod tests_per_hit;
mod time;

pub use pixel_counts::{PIXEL_COUNTS_LIMIT, PixelCounts, RayFilter};

use crate::trace::Tally;

/// All heatmaps; the first is the default.
pub static HEATMAPS: &[Heatmap] = &[
    nodes::HEATMAP,
    inner_nodes::HEATMAP,
    leaves::HEATMAP,
    empty_leaves::HEATMAP,
    full_leaves::HEATMAP,
    intersection_tests::HEATMAP,
    tests_per_hit::HEATMAP,
    rays::HEATMAP,
    time::HEATMAP,
    depth_complexity::HEATMAP,
];

/// The heatmap with this symbol, in capitals or not.
pub fn heatmap(symbol: &str) -> Option<&'static Heatmap> {
    HEATMAPS
        .iter()
        .find(|h| h.symbol.eq_ignore_ascii_case(symbol))
}

/// A number that every pixel has, and how those of all pixels make one of the whole picture.
pub struct Heatmap {
    /// The paper's symbol of what is shown, where it has one.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    /// What a pixel's value is counted in.
    pub unit: &'static str,
    /// What it means, in a sentence.
    pub meaning: &'static str,
    /// Where a pixel's numbers come from.
    pub source: Source,
    /// What the pixels' values make together.
    pub whole: Whole,
    /// The least difference that matters, in its unit.
    pub grain: f64,
    /// Parameters that the whole picture's value equals, by kind of rays.
    pub totals: &'static [Total],
}

/// How to count something of the rays of a pixel.
pub type Count = fn(&Tally) -> u64;

/// Where a pixel's numbers come from.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// Counted for every kind of ray.
    Rays(Count),
    /// Objects that the primary ray meets.
    DepthComplexity,
    /// The time that the pixel took.
    Time,
}

/// What the values of all pixels make together.
#[derive(Clone, Copy, Debug)]
pub enum Whole {
    Sum,
    Mean,
    /// A pixel's value is a ratio to this; the picture's is the ratio of the two sums.
    RatioTo(Count),
}

/// That the value of the whole picture, for some rays, is that of a parameter.
#[derive(Clone, Copy, Debug)]
pub struct Total {
    pub rays: RayFilter,
    /// Symbols of the parameters whose sum it equals.
    pub parameters: &'static [&'static str],
}

impl Heatmap {
    /// The rays that it can be shown for; always [`RayFilter::All`], first.
    pub fn filters(&self) -> &'static [RayFilter] {
        match self.source {
            Source::Rays(_) => &RayFilter::ALL,
            Source::DepthComplexity | Source::Time => &[RayFilter::All],
        }
    }

    /// The value of a pixel, row by row; `None` where it has none: a ratio to zero, or a time that
    /// was not taken.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn value(&self, counts: &PixelCounts, pixel: usize, rays: RayFilter) -> Option<f64> {
        let over = self.counted(counts, pixel, rays)?;
        match self.whole {
            Whole::Sum | Whole::Mean => Some(over),
            Whole::RatioTo(count) => ratio(over, count(&counts.tally(pixel, rays)) as f64),
        }
    }

    /// The value of the whole picture; `None` as [`Heatmap::value`].
    pub fn total(&self, counts: &PixelCounts, rays: RayFilter) -> Option<f64> {
        let pixels = 0..counts.tallies.len();
        let over = pixels
            .clone()
            .map(|pixel| self.counted(counts, pixel, rays))
            .sum::<Option<f64>>()?;
        match self.whole {
            Whole::Sum => Some(over),
            Whole::Mean => ratio(over, pixels.len() as f64),
            Whole::RatioTo(count) => {
                let under: u64 = pixels.map(|pixel| count(&counts.tally(pixel, rays))).sum();
                ratio(over, under as f64)
            }
        }
    }

    /// Symbols of the parameters whose sum is the value of the whole picture; none where the paper
    /// has none.
    pub fn parameters(&self, rays: RayFilter) -> &'static [&'static str] {
        self.totals
            .iter()
            .find(|total| total.rays == rays)
            .map_or(&[], |total| total.parameters)
    }

    /// The values of all pixels.
    pub fn image(&self, counts: &PixelCounts, rays: RayFilter) -> HeatImage {
        let values = (0..counts.tallies.len())
            .map(|pixel| {
                self.value(counts, pixel, rays)
                    .map_or(f32::NAN, |value| value as f32)
            })
            .collect();
        HeatImage {
            width: counts.width,
            height: counts.height,
            values,
            grain: self.grain,
        }
    }

    /// What is counted in a pixel, before any ratio.
    fn counted(&self, counts: &PixelCounts, pixel: usize, rays: RayFilter) -> Option<f64> {
        Some(match self.source {
            Source::Rays(count) => count(&counts.tally(pixel, rays)) as f64,
            Source::DepthComplexity => f64::from(counts.depth_complexity[pixel]),
            Source::Time => f64::from(counts.seconds.as_ref()?[pixel]) * time::PER_SECOND,
        })
    }
}

fn ratio(over: f64, under: f64) -> Option<f64> {
    (under != 0.0).then(|| over / under)
}

/// The values of a heatmap, or the differences of two.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatImage {
    pub width: u32,
    pub height: u32,
    /// Row by row; NaN where a pixel has no value. Rounded beyond 2²⁴ only.
    pub values: Vec<f32>,
    /// The least difference that matters ([`Heatmap::grain`]).
    pub grain: f64,
}

/// What there is to say of all values of a [`HeatImage`] together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatStatistics {
    pub lowest: f64,
    pub highest: f64,
    /// Over the pixels that have a value.
    pub mean: f64,
    /// How many pixels have a value; at least 1.
    pub pixels: usize,
}

impl HeatImage {
    /// The value of a pixel; `None` where it has none or lies outside.
    pub fn get(&self, x: u32, y: u32) -> Option<f32> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let value = self.values[y as usize * self.width as usize + x as usize];
        (!value.is_nan()).then_some(value)
    }

    /// The values that there are.
    pub fn present(&self) -> impl Iterator<Item = f64> + '_ {
        let present = self.values.iter().filter(|value| !value.is_nan());
        present.map(|&value| f64::from(value))
    }

    /// `None` where no pixel has a value.
    pub fn statistics(&self) -> Option<HeatStatistics> {
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut sum, mut pixels) = (0.0, 0);
        for value in self.present() {
            lowest = lowest.min(value);
            highest = highest.max(value);
            sum += value;
            pixels += 1;
        }
        (pixels > 0).then(|| HeatStatistics {
            lowest,
            highest,
            mean: sum / pixels as f64,
            pixels,
        })
    }

    /// Every pixel's value less that of `other`; no value where either has none. `None` for
    /// pictures of different sizes.
    pub fn difference(&self, other: &HeatImage) -> Option<HeatImage> {
        if (self.width, self.height) != (other.width, other.height) {
            return None;
        }
        let pairs = self.values.iter().zip(&other.values);
        Some(HeatImage {
            values: pairs.map(|(a, b)| a - b).collect(),
            ..*self
        })
    }
}
