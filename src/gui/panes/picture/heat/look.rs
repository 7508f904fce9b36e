//! A heatmap worked out for the screen: values, colors, histogram, order of cost.

use crate::measure::heat::{
    HeatImage, HeatStatistics, Heatmap, PixelCounts, RayFilter, Whole, heatmaps,
};
use crate::measure::parameter;
use crate::present::number::{grouped, significant};
use crate::present::overlay::{COLORMAPS, HeatScale, Range, Scale, heat_colors};
use egui::{Color32, ColorImage};
use std::sync::Arc;

/// Which values: of which picture, what, and of which rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValuesKey {
    /// Number of the picture.
    pub number: u64,
    /// The picture whose values are taken away from it, for a difference.
    pub minus: Option<u64>,
    /// Place in [`heatmaps`].
    pub heatmap: usize,
    pub rays: RayFilter,
}

/// Which values, and in which colors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookKey {
    pub values: ValuesKey,
    pub scale: Scale,
    pub range: Range,
    /// Whether the range spans the values of two compared pictures.
    pub spans_both: bool,
    /// Place in [`COLORMAPS`].
    pub colors: usize,
}

/// The values of all pixels, and what they make together.
pub struct Values {
    pub image: HeatImage,
    /// `None` where no pixel has a value.
    pub statistics: Option<HeatStatistics>,
    /// Of the whole picture; `None` where it has no value, and for a difference.
    pub total: Option<f64>,
}

impl Values {
    pub fn of(heatmap: &Heatmap, counts: &PixelCounts, rays: RayFilter) -> Values {
        let image = heatmap.image(counts, rays);
        Values {
            statistics: image.statistics(),
            total: heatmap.total(counts, rays),
            image,
        }
    }

    /// What these are more than others, pixel by pixel; `None` for pictures of different sizes.
    pub fn less(&self, others: &Values) -> Option<Values> {
        let image = self.image.difference(&others.image)?;
        Some(Values {
            statistics: image.statistics(),
            total: None,
            image,
        })
    }

    /// All pixels that have a value, the costliest first; of equals, the upper left first.
    pub fn by_cost(&self) -> Vec<u32> {
        let values = &self.image.values;
        let mut order: Vec<u32> = (0..values.len() as u32)
            .filter(|&i| !values[i as usize].is_nan())
            .collect();
        order.sort_unstable_by(|&a, &b| {
            let [first, second] = [a, b].map(|i| values[i as usize]);
            second.total_cmp(&first).then(a.cmp(&b))
        });
        order
    }
}

/// Columns of the histogram.
const BINS: usize = 96;

/// Values in colors.
pub struct Look {
    pub key: LookKey,
    pub values: Arc<Values>,
    /// `None` where no pixel has a value.
    pub scale: Option<HeatScale>,
    pub pixels: Arc<ColorImage>,
    /// How many pixels lie in each stretch of the color bar.
    pub histogram: Vec<u64>,
    /// How many pixels lie below the range, and how many above.
    pub beyond: [usize; 2],
}

impl Look {
    pub fn of(key: LookKey, values: Arc<Values>) -> Look {
        let image = &values.image;
        let colors = &COLORMAPS[key.colors];
        let scale = HeatScale::new(image, key.scale, key.range, colors);
        let pixels = heat_colors(image, scale.as_ref(), colors)
            .into_iter()
            .map(|[r, g, b]| Color32::from_rgb(r, g, b))
            .collect();
        let size = [image.width as usize, image.height as usize];
        Look {
            key,
            scale,
            pixels: Arc::new(ColorImage::new(size, pixels)),
            histogram: scale.map_or_else(Vec::new, |s| s.histogram(image, BINS)),
            beyond: scale.map_or([0; 2], |s| s.beyond(image)),
            values,
        }
    }

    pub fn heatmap(&self) -> &'static Heatmap {
        &heatmaps()[self.key.values.heatmap]
    }

    /// Symbol and name, and that it is a difference.
    pub fn title(&self) -> String {
        let heatmap = self.heatmap();
        let title = format!("{} · {}", heatmap.symbol, heatmap.name);
        if self.is_difference() {
            title + " · B − A"
        } else {
            title
        }
    }

    pub fn is_difference(&self) -> bool {
        self.key.values.minus.is_some()
    }

    /// The value of a pixel with its unit.
    pub fn value_text(&self, pixel: [u32; 2]) -> String {
        match self.number_text(pixel) {
            Some(number) => format!("{number} {}", self.heatmap().unit),
            None => "no value".to_owned(),
        }
    }

    /// The value of a pixel without its unit.
    pub fn number_text(&self, [x, y]: [u32; 2]) -> Option<String> {
        let value = f64::from(self.values.image.get(x, y)?);
        let sign = if self.is_difference() && value > 0.0 {
            "+"
        } else {
            ""
        };
        Some(format!("{sign}{}", exact(value)))
    }

    /// Where a pixel's value lies on the color bar, 0 to 1.
    pub fn place(&self, [x, y]: [u32; 2]) -> Option<f64> {
        let value = self.values.image.get(x, y)?;
        self.scale?.place(f64::from(value))
    }

    /// The rays, the scale and the range, where it does not follow the values.
    pub fn terms(&self) -> String {
        let mut text = format!("{} scale", self.key.scale.name());
        if self.heatmap().filters().len() > 1 {
            text = format!("{} rays · {text}", self.key.values.rays.name());
        }
        if self.key.spans_both {
            text += " · range of A and B together";
        } else if let Range::Fixed { lo, hi } = self.key.range {
            text += &format!(" · locked {} to {}", exact(lo), exact(hi));
        }
        text
    }

    /// The span of the pixels' values.
    pub fn span(&self) -> String {
        self.values.statistics.map_or_else(
            || "No pixel has a value".to_owned(),
            |found| {
                let [lowest, highest] = [found.lowest, found.highest].map(exact);
                let mean = significant(found.mean);
                format!("From {lowest} to {highest}, mean {mean}")
            },
        )
    }

    /// How many pixels have no value, and their color; `None` if all have one.
    pub fn without(&self) -> Option<String> {
        let with = self.values.statistics.map_or(0, |found| found.pixels);
        let without = self.values.image.values.len() - with;
        let diverging = COLORMAPS[self.key.colors].diverging;
        let color = if diverging { "gray" } else { "white" };
        (without > 0).then(|| format!("{color}: no value ({})", grouped(without as f64)))
    }

    /// What all pixels make together.
    pub fn whole(&self) -> String {
        let heatmap = self.heatmap();
        if self.is_difference() {
            return "Below zero B has less than A, above zero more.".to_owned();
        }
        let Some(total) = self.values.total else {
            return "The whole picture has no value.".to_owned();
        };
        match (heatmap.parameters(self.key.values.rays), heatmap.whole) {
            (symbols @ [first, ..], _) => format!(
                "Whole picture: {} = {}",
                symbols.join(" + "),
                parameter(first).format(Some(total))
            ),
            ([], Whole::Sum) => {
                // A sum over pixels is not per pixel any more.
                let unit = heatmap.unit.trim_end_matches(" per pixel");
                format!("Whole picture: {} {unit}", exact(total))
            }
            ([], Whole::Mean | Whole::RatioTo(_)) => {
                format!("Whole picture: {} {}", exact(total), heatmap.unit)
            }
        }
    }
}

/// A whole number in full, any other to four places.
pub fn exact(value: f64) -> String {
    if value.fract() == 0.0 {
        grouped(value)
    } else {
        format!("{value:.4}")
    }
}
