//! The color scale of a heatmap: places, colors, ticks and a histogram of the values.

use super::Colormap;
use crate::measure::heat::HeatImage;
use crate::present::number::{Digits, grouped};

/// How values map to places on the scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    #[default]
    Linear,
    /// Logarithm of the absolute value, with the value's sign. It is linear below the heatmap's
    /// grain, so that zero and negative differences have places, too.
    Logarithmic,
}

impl Scale {
    pub const ALL: [Scale; 2] = [Scale::Linear, Scale::Logarithmic];

    /// Returns the name in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Scale::Linear => "linear",
            Scale::Logarithmic => "log",
        }
    }

    /// Returns the scale with this name.
    pub fn named(name: &str) -> Option<Scale> {
        Scale::ALL.into_iter().find(|s| s.name() == name)
    }
}

/// The range of values that the colors span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Range {
    /// From the least value to the greatest. With a diverging map, symmetric around zero.
    #[default]
    Automatic,
    /// A fixed range, so that colors of several pictures are comparable. Values outside have the
    /// color of the nearer end.
    Fixed { lo: f64, hi: f64 },
}

/// A labeled tick of the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub value: f64,
    /// Place from 0 (lower end) to 1.
    pub place: f64,
    pub text: String,
}

/// The mapping of values to places on a color bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatScale {
    pub scale: Scale,
    /// The value at place 0.
    pub lo: f64,
    /// The value at place 1; equal to `lo` if all values are the same.
    pub hi: f64,
    grain: f64,
}

impl HeatScale {
    /// Creates the scale for a picture. Returns `None` if the range is automatic and no pixel has a
    /// value, or if a fixed range is not ascending and finite.
    pub fn new(image: &HeatImage, scale: Scale, range: Range, colors: &Colormap) -> Option<Self> {
        let (lo, hi) = match range {
            Range::Fixed { lo, hi } => {
                (lo < hi && lo.is_finite() && hi.is_finite()).then_some((lo, hi))?
            }
            Range::Automatic => {
                let found = image.statistics()?;
                let most = found.lowest.abs().max(found.highest.abs());
                if colors.diverging {
                    (-most, most)
                } else {
                    (found.lowest, found.highest)
                }
            }
        };
        Some(HeatScale {
            scale,
            lo,
            hi,
            grain: image.grain,
        })
    }

    /// Returns the place of a value, 0 to 1. Values outside the range are clamped. If all values
    /// are the same, returns the middle. Returns `None` for NaN.
    pub fn place(&self, value: f64) -> Option<f64> {
        if value.is_nan() {
            return None;
        }
        let [value, lo, hi] = [value, self.lo, self.hi].map(|v| self.spread(v));
        let place = (value - lo) / (hi - lo);
        Some(if place.is_nan() {
            0.5
        } else {
            place.clamp(0.0, 1.0)
        })
    }

    fn spread(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => (value.abs() / self.grain).ln_1p().copysign(value),
        }
    }

    /// Returns at most `most` (3 or more) ticks at round numbers within the range, in ascending
    /// order. Round numbers are 1, 2 or 5 times a power of ten, or multiples of such a step. If all
    /// values are the same, returns one tick.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        if self.lo == self.hi {
            return vec![self.tick(self.lo, Digits::Four.exact_or(self.lo))];
        }
        let linear = || -> Vec<Tick> {
            let (step, values) = self.round_values(most);
            let text = |value| with_step(value, step);
            values.map(|value| self.tick(value, text(value))).collect()
        };
        match self.scale {
            Scale::Linear => linear(),
            Scale::Logarithmic => {
                let powers = self.powers(most);
                // A range of about one decade contains too few powers of ten.
                if powers.len() >= 3 { powers } else { linear() }
            }
        }
    }

    fn tick(&self, value: f64, text: String) -> Tick {
        let place = self.place(value).unwrap_or(0.5);
        Tick { value, place, text }
    }

    /// Returns a round step, and the multiples of it within the range.
    fn round_values(&self, most: usize) -> (f64, impl Iterator<Item = f64>) {
        let span = self.hi - self.lo;
        let least = span / most.max(2) as f64;
        let power = 10f64.powf(least.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|k| k * power);
        // The step is at least the smallest relevant difference, unless that exceeds the whole
        // range.
        let step = steps
            .into_iter()
            .find(|&step| step * (most.max(2) - 1) as f64 >= span)
            .unwrap_or(10.0 * power);
        let step = if self.grain <= span {
            step.max(self.grain)
        } else {
            step
        };
        let (first, last) = ((self.lo / step).ceil(), (self.hi / step).floor());
        let count = (last - first) as usize + 1;
        // Adding zero turns −0 into 0.
        (
            step,
            (0..count).map(move |i| (first + i as f64) * step + 0.0),
        )
    }

    /// Returns zero and the powers of ten, with 2 and 5 times each if they fit.
    fn powers(&self, most: usize) -> Vec<Tick> {
        let top = self.lo.abs().max(self.hi.abs());
        let exponents = self.grain.log10().ceil() as i32..=top.log10().floor() as i32;
        let every = |step| (&[1.0][..], step);
        let choices = std::iter::once((&[1.0, 2.0, 5.0][..], 1))
            .chain((1..=exponents.clone().count().max(1)).map(every));
        let mut ticks = Vec::new();
        for (folds, step) in choices {
            // Start at the largest. Ticks are dropped near zero, where they are crowded.
            let sizes = exponents
                .clone()
                .rev()
                .step_by(step)
                .flat_map(|e| folds.iter().map(move |fold| fold * 10f64.powi(e)));
            let mut values: Vec<f64> = sizes.flat_map(|size| [-size, size]).collect();
            values.push(0.0);
            values.retain(|value| (self.lo..=self.hi).contains(value));
            values.sort_by(f64::total_cmp);
            ticks = values
                .into_iter()
                .map(|value| self.tick(value, with_step(value, value.abs())))
                .collect();
            if ticks.len() <= most {
                break;
            }
        }
        ticks
    }

    /// Counts the values in each of `bins` equal parts of the color bar. Values outside the range
    /// count in the outermost parts.
    pub fn histogram(&self, image: &HeatImage, bins: usize) -> Vec<u64> {
        let mut counts = vec![0; bins];
        for place in image.present().filter_map(|value| self.place(value)) {
            let bin = (place * bins as f64) as usize;
            if let Some(count) = counts.get_mut(bin.min(bins.saturating_sub(1))) {
                *count += 1;
            }
        }
        counts
    }

    /// Returns the number of values below and above the range.
    pub fn beyond(&self, image: &HeatImage) -> [usize; 2] {
        [
            image.present().filter(|&value| value < self.lo).count(),
            image.present().filter(|&value| value > self.hi).count(),
        ]
    }
}

/// Formats a number with as many decimals as a step of this size needs.
fn with_step(value: f64, step: f64) -> String {
    let (sign, size) = (if value < 0.0 { "−" } else { "" }, value.abs());
    if value == 0.0 {
        "0".into()
    } else if !(1e-4..1e7).contains(&size) {
        format!("{sign}{size:e}")
    } else if step >= 1.0 {
        format!("{sign}{}", grouped(size))
    } else {
        let decimals = (-step.log10()).ceil().max(0.0) as usize;
        format!("{sign}{size:.decimals$}")
    }
}

/// Returns the sRGB colors of all pixels, row by row. Without a scale, no pixel has a value.
pub fn heat_colors(
    image: &HeatImage,
    scale: Option<&HeatScale>,
    colors: &Colormap,
) -> Vec<[u8; 3]> {
    let place = |value: f32| scale?.place(f64::from(value));
    let color = |&value| place(value).map_or(colors.no_value(), |place| colors.color(place));
    image.values.iter().map(color).collect()
}

/// Blends colors over others in sRGB: opacity 0 shows only `below`, 1 only `over`.
pub fn blend(over: &[[u8; 3]], below: &[[u8; 3]], opacity: f64) -> Vec<[u8; 3]> {
    let mix = |(a, b): (u8, u8)| {
        (f64::from(b) + (f64::from(a) - f64::from(b)) * opacity.clamp(0.0, 1.0)).round() as u8
    };
    let pixels = over.iter().zip(below);
    pixels
        .map(|(a, b)| std::array::from_fn(|i| mix((a[i], b[i]))))
        .collect()
}
