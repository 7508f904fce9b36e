//! The counters that have a value for each pixel.

use super::image::HeatImage;
use super::pixel_counts::{PixelCounts, RayFilter};
use crate::measure::counter::{COUNTERS, Count, Counter, Quantity, Value};
use std::sync::LazyLock;

/// A counter that has a value for each pixel, and how the values of all pixels combine.
pub struct Heatmap {
    /// The paper's symbol, or one in its style.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    /// Unit of a pixel's value.
    pub unit: &'static str,
    /// What it means, in a sentence.
    pub meaning: &'static str,
    /// Where the values of pixels come from.
    pub source: Source,
    /// How the values of all pixels combine.
    pub whole: Whole,
    /// The smallest difference that matters, in its unit.
    pub grain: f64,
    /// Symbols of the parameters that add up to its total, by the rays counted.
    pub totals: Vec<(RayFilter, Vec<&'static str>)>,
}

/// Where the values of pixels come from.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// Counted for each kind of ray.
    Rays(Count),
    /// The number of objects along the primary ray.
    DepthComplexity,
    /// The time that a pixel takes, in microseconds.
    Time,
}

/// How the values of all pixels combine.
#[derive(Clone, Copy, Debug)]
pub enum Whole {
    Sum,
    Mean,
    /// The value of a pixel is a ratio to this count; that of the whole picture is the ratio of the
    /// two sums.
    RatioTo(Count),
}

/// Returns all heatmaps; the first is the default.
pub fn heatmaps() -> &'static [Heatmap] {
    static HEATMAPS: LazyLock<Vec<Heatmap>> = LazyLock::new(|| {
        let mut placed: Vec<_> = COUNTERS.iter().filter_map(Heatmap::of).collect();
        placed.sort_by_key(|(place, _)| *place);
        placed.into_iter().map(|(_, heatmap)| heatmap).collect()
    });
    &HEATMAPS
}

/// Returns the heatmap with this symbol, ignoring case.
pub fn heatmap(symbol: &str) -> Option<&'static Heatmap> {
    heatmaps()
        .iter()
        .find(|h| h.symbol.eq_ignore_ascii_case(symbol))
}

impl Heatmap {
    /// Returns its view of a counter, with its place among the heatmaps; `None` if the counter is no
    /// heatmap.
    fn of(counter: &Counter) -> Option<(u32, Heatmap)> {
        let entry = counter.heatmap?;
        let (source, whole) = match counter.value {
            _ if entry.is_depth_complexity => (Source::DepthComplexity, Whole::Mean),
            Value::PixelTime => (Source::Time, Whole::Sum),
            Value::Rays(_, Quantity::Count(count)) => (Source::Rays(count), Whole::Sum),
            Value::Rays(_, Quantity::Ratio(over, under)) => {
                (Source::Rays(over), Whole::RatioTo(under))
            }
            Value::Measured(_) | Value::LeafDeviation(_) => return None,
        };
        let mut totals = Vec::new();
        if counter.is_parameter() {
            totals.push((RayFilter::All, vec![counter.symbol]));
        } else if !entry.parts.is_empty() {
            let symbols = entry.parts.iter().map(|(_, symbol)| *symbol);
            totals.push((RayFilter::All, symbols.collect()));
            let parts = entry.parts.iter();
            totals.extend(parts.map(|(rays, symbol)| (*rays, vec![*symbol])));
        }
        let heatmap = Heatmap {
            symbol: counter.symbol,
            name: counter.name,
            unit: entry.unit,
            meaning: counter.meaning,
            source,
            whole,
            grain: entry.grain,
            totals,
        };
        Some((entry.place, heatmap))
    }

    /// Returns the rays that it can be restricted to; always [`RayFilter::All`] first.
    pub fn filters(&self) -> &'static [RayFilter] {
        match self.source {
            Source::Rays(_) => &RayFilter::ALL,
            Source::DepthComplexity | Source::Time => &[RayFilter::All],
        }
    }

    /// Returns the value of a pixel, counted row by row. `None` for a ratio whose denominator is 0,
    /// and for a time that was not measured.
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

    /// Returns the value of the whole picture; `None` as for [`Heatmap::value`].
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

    /// Returns the symbols of the parameters that add up to the value of the whole picture; none if
    /// the paper has none.
    pub fn parameters(&self, rays: RayFilter) -> &[&'static str] {
        let mut totals = self.totals.iter();
        totals
            .find(|(of, _)| *of == rays)
            .map_or(&[], |(_, symbols)| symbols)
    }

    /// Returns the values of all pixels.
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

    /// Returns what is counted for a pixel, before any ratio.
    fn counted(&self, counts: &PixelCounts, pixel: usize, rays: RayFilter) -> Option<f64> {
        Some(match self.source {
            Source::Rays(count) => count(&counts.tally(pixel, rays)) as f64,
            Source::DepthComplexity => f64::from(counts.depth_complexity[pixel]),
            Source::Time => f64::from(counts.seconds.as_ref()?[pixel]) * 1e6,
        })
    }
}

fn ratio(over: f64, under: f64) -> Option<f64> {
    (under != 0.0).then(|| over / under)
}
