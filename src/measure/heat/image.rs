//! The values of all pixels.

/// The values of a heatmap, or the differences between two.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatImage {
    pub width: u32,
    pub height: u32,
    /// Row by row; NaN if a pixel has no value. Values above 2²⁴ are rounded.
    pub values: Vec<f32>,
    /// The smallest difference that matters ([`Heatmap::grain`](super::Heatmap::grain)).
    pub grain: f64,
}

/// Statistics of the values of a [`HeatImage`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatStatistics {
    pub lowest: f64,
    pub highest: f64,
    /// Over the pixels that have a value.
    pub mean: f64,
    /// Number of pixels that have a value; at least 1.
    pub pixels: usize,
}

impl HeatImage {
    /// Returns the value of a pixel; `None` if it has none or lies outside.
    pub fn get(&self, x: u32, y: u32) -> Option<f32> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let value = self.values[y as usize * self.width as usize + x as usize];
        (!value.is_nan()).then_some(value)
    }

    /// Returns the values of the pixels that have one.
    pub fn present(&self) -> impl Iterator<Item = f64> + '_ {
        let present = self.values.iter().filter(|value| !value.is_nan());
        present.map(|&value| f64::from(value))
    }

    /// Returns the statistics of the values; `None` if no pixel has a value.
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

    /// Subtracts the values of `other`, pixel by pixel. A pixel has no value if it is missing in
    /// either. Returns `None` if the sizes differ.
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
