//! A heatmap as a file: in colors with its legend, or as raw values.

use super::png;
use crate::measure::heat::{HeatImage, HeatStatistics, Heatmap, RayFilter, Whole};
use crate::measure::parameter;
use crate::present::number::Digits;
use crate::present::overlay::{
    Captions, Colormap, HeatPicture, HeatScale, Range, Scale, blend, heat_colors, with_legend,
};
use crate::trace::Picture;
use exr::prelude::{SpecificChannels, WritableImage};
use image::{ImageError, RgbImage};
use std::io::Cursor;

/// A heatmap with everything that determines its exported picture.
pub struct HeatSheet<'a> {
    pub heatmap: &'a Heatmap,
    pub image: &'a HeatImage,
    /// The value of the whole picture; `None` if it has no value, and for a difference.
    pub total: Option<f64>,
    /// Whether values are those of tree B minus those of tree A.
    pub difference: bool,
    pub rays: RayFilter,
    pub scale: Scale,
    pub range: Range,
    pub colors: &'a Colormap,
    /// The rendered picture below, and the opacity of the heatmap over it, 0 to 1.
    pub below: Option<(&'a Picture, f64)>,
    /// The subject, such as scene and method.
    pub of: String,
}

impl HeatSheet<'_> {
    /// Returns the picture with title, color bar, histogram and statistics.
    pub fn drawn(&self) -> RgbImage {
        let HeatSheet { image, colors, .. } = self;
        let scale = HeatScale::new(image, self.scale, self.range, colors);
        let mut pixels = heat_colors(image, scale.as_ref(), colors);
        if let Some((below, opacity)) = self.below {
            pixels = blend(&pixels, &below.to_srgb8(), opacity);
        }
        let difference = if self.difference { " · B − A" } else { "" };
        let captions = Captions {
            title: format!(
                "{} · {}{difference}",
                self.heatmap.symbol, self.heatmap.name
            ),
            subtitle: self.subtitle(),
            unit: format!(
                "{}, {} scale; above, how many pixels (square root)",
                self.heatmap.unit,
                self.scale.name()
            ),
            figures: self.figures(),
        };
        let picture = HeatPicture {
            image,
            pixels,
            scale,
            colors,
        };
        with_legend(&picture, &captions)
    }

    /// Encodes the picture as a PNG file.
    ///
    /// # Errors
    /// Errors of the encoder.
    pub fn png(&self) -> Result<Vec<u8>, ImageError> {
        png(&self.drawn())
    }

    /// Encodes the values as an OpenEXR file: 32-bit floats in one channel named after the symbol;
    /// NaN for missing values.
    ///
    /// # Errors
    /// Errors of the encoder.
    pub fn exr(&self) -> Result<Vec<u8>, exr::error::Error> {
        let image = self.image;
        let (width, height) = (image.width as usize, image.height as usize);
        let channels = SpecificChannels::build()
            .with_channel::<f32>(self.heatmap.symbol)
            .with_pixel_fn(|at| (image.values[at.y() * width + at.x()],));
        let mut bytes = Cursor::new(Vec::new());
        exr::prelude::Image::from_channels((width, height), channels)
            .write()
            .to_buffered(&mut bytes)?;
        Ok(bytes.into_inner())
    }

    /// Returns the subtitle: what the heatmap shows, and of which scene.
    fn subtitle(&self) -> String {
        let mut words = self.of.clone();
        if self.heatmap.filters().len() > 1 {
            words += &format!(", {} rays", self.rays.name());
        }
        if let Some((_, opacity)) = self.below {
            words += &format!("; {} over the picture", Digits::All.percent(opacity));
        }
        words
    }

    /// Returns the statistics of the whole picture.
    fn figures(&self) -> String {
        let HeatSheet { heatmap, image, .. } = self;
        let mut words = Vec::new();
        if let Some(total) = self.total {
            let parameters = heatmap.parameters(self.rays);
            words.push(match (parameters, heatmap.whole) {
                ([first, ..], _) => {
                    let number = parameter(first).number(total);
                    format!("{} {number}", parameters.join(" + "))
                }
                ([], Whole::Sum) => {
                    // The sum over all pixels no longer has a unit per pixel.
                    let unit = heatmap.unit.trim_end_matches(" per pixel");
                    format!("total {} {unit}", number(total))
                }
                ([], Whole::Mean | Whole::RatioTo(_)) => {
                    format!("whole picture {} {}", number(total), heatmap.unit)
                }
            });
        }
        if let Some(HeatStatistics {
            lowest,
            highest,
            mean,
            pixels,
        }) = image.statistics()
        {
            let [lowest, mean, highest] = [lowest, mean, highest].map(number);
            words.push(format!(
                "per pixel: lowest {lowest}, mean {mean}, highest {highest}"
            ));
            let without = image.values.len() - pixels;
            if without > 0 {
                let color = if self.colors.diverging {
                    "gray"
                } else {
                    "white"
                };
                words.push(format!("no value in {without} pixels, {color}"));
            }
        }
        words.join("; ")
    }
}

/// Formats an integer in full, and any other number to four digits.
fn number(value: f64) -> String {
    Digits::Four.exact_or(value)
}
