//! Draws a heatmap for export: with a title, a color bar with numbers, and a histogram.

use super::text::Pen;
use super::{Colormap, HeatScale};
use crate::measure::heat::HeatImage;
use image::{Rgb, RgbImage};

/// The text around a heatmap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Captions {
    /// One line in large type.
    pub title: String,
    /// Below the title: what the heatmap shows, and of which scene.
    pub subtitle: String,
    /// Below the color bar: the unit of the values.
    pub unit: String,
    /// At the bottom: statistics of the whole picture.
    pub figures: String,
}

const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [24; 3];
const SOFT_INK: [u8; 3] = [80; 3];
const HISTOGRAM: [u8; 3] = [150; 3];

/// The narrowest image on which the legend's text fits, in pixels.
const LEAST_WIDTH: u32 = 480;

/// Sizes in pixels. They grow with the width of the picture, so that text stays legible when a wide
/// picture is shown small.
struct Sizes {
    unit: u32,
    margin: u32,
    title: Pen,
    text: Pen,
    number: Pen,
}

impl Sizes {
    fn for_width(width: u32) -> Sizes {
        let unit = (width / 640).clamp(1, 8);
        Sizes {
            unit,
            margin: 16 * unit,
            title: Pen::new(24.0 * unit as f32, INK),
            text: Pen::new(17.0 * unit as f32, SOFT_INK),
            number: Pen::new(16.0 * unit as f32, INK),
        }
    }
}

/// A heatmap in colors.
pub struct HeatPicture<'a> {
    pub image: &'a HeatImage,
    /// sRGB colors of the image's pixels, row by row.
    pub pixels: Vec<[u8; 3]>,
    /// `None` if no pixel has a value.
    pub scale: Option<HeatScale>,
    pub colors: &'a Colormap,
}

/// Returns the heatmap on a white sheet with its legend.
pub fn with_legend(picture: &HeatPicture<'_>, captions: &Captions) -> RgbImage {
    let HeatPicture { image, pixels, .. } = picture;
    let sizes = Sizes::for_width(image.width);
    let Sizes { unit, margin, .. } = sizes;
    let inner = image.width.max(LEAST_WIDTH);
    let lines = |pen: &Pen, text: &str| -> Vec<String> { pen.wrapped(text, inner) };
    let title = lines(&sizes.title, &captions.title);
    let subtitle = lines(&sizes.text, &captions.subtitle);
    let figures = lines(&sizes.text, &captions.figures);
    let height_of = |pen: &Pen, lines: &[String]| pen.line_height() * lines.len() as u32;
    let head = height_of(&sizes.title, &title) + height_of(&sizes.text, &subtitle) + margin / 2;
    let bar = BarLayout::new(&sizes);
    let foot = bar.height() + margin / 2 + height_of(&sizes.text, &figures);
    let size = [
        inner + 2 * margin,
        margin + head + image.height + margin + foot + margin,
    ];
    let mut sheet = RgbImage::from_pixel(size[0], size[1], Rgb(PAPER));

    let mut y = margin;
    let write = |sheet: &mut RgbImage, pen: &Pen, lines: &[String], y: &mut u32| {
        for line in lines {
            pen.draw(sheet, margin, *y, line);
            *y += pen.line_height();
        }
    };
    write(&mut sheet, &sizes.title, &title, &mut y);
    write(&mut sheet, &sizes.text, &subtitle, &mut y);
    y += margin / 2;

    let left = margin + (inner - image.width) / 2;
    // The frame separates pixels without a value from the sheet.
    let framed = [
        left - unit,
        y - unit,
        image.width + 2 * unit,
        image.height + 2 * unit,
    ];
    fill(&mut sheet, framed, SOFT_INK);
    for (i, &pixel) in pixels.iter().enumerate() {
        let (column, row) = (i as u32 % image.width, i as u32 / image.width);
        sheet.put_pixel(left + column, y + row, Rgb(pixel));
    }
    y += image.height + margin;

    let place = [margin, y, inner];
    bar.draw(&mut sheet, place, picture, &captions.unit, &sizes);
    y += bar.height() + margin / 2;
    write(&mut sheet, &sizes.text, &figures, &mut y);
    sheet
}

/// Heights of the parts of the color bar, in pixels.
struct BarLayout {
    histogram: u32,
    bar: u32,
    tick: u32,
    numbers: u32,
    unit: u32,
}

impl BarLayout {
    fn new(sizes: &Sizes) -> BarLayout {
        BarLayout {
            histogram: 40 * sizes.unit,
            bar: 18 * sizes.unit,
            tick: 6 * sizes.unit,
            numbers: sizes.number.line_height(),
            unit: sizes.text.line_height(),
        }
    }

    fn height(&self) -> u32 {
        self.histogram + self.bar + self.tick + self.numbers + self.unit
    }

    /// Draws the color bar at the given left, top and width.
    fn draw(
        &self,
        sheet: &mut RgbImage,
        [left, top, width]: [u32; 3],
        picture: &HeatPicture<'_>,
        unit: &str,
        sizes: &Sizes,
    ) {
        let HeatPicture { image, colors, .. } = picture;
        let Some(scale) = &picture.scale else {
            let words = "no pixel has a value";
            sizes.text.draw(sheet, left, top + self.histogram, words);
            return;
        };
        let bar_top = top + self.histogram;
        self.draw_histogram(
            sheet,
            [left, top, width],
            &scale.histogram(image, width as usize / 4),
        );
        for column in 0..width {
            let color = colors.color((f64::from(column) + 0.5) / f64::from(width));
            fill(sheet, [left + column, bar_top, 1, self.bar], color);
        }
        let number_top = bar_top + self.bar + self.tick;
        let [below, above] = scale.beyond(image);
        let ticks = scale.ticks((width / (44 * sizes.unit)) as usize);
        let mut free_from = 0;
        for tick in &ticks {
            let x = left + ((f64::from(width - sizes.unit)) * tick.place).round() as u32;
            fill(sheet, [x, bar_top + self.bar, sizes.unit, self.tick], INK);
            // The first and last colors also stand for all values beyond the range.
            let text = match tick.place {
                place if place <= 0.0 && below > 0 => format!("≤ {}", tick.text),
                place if place >= 1.0 && above > 0 => format!("≥ {}", tick.text),
                _ => tick.text.clone(),
            };
            let text_width = sizes.number.width(&text);
            let centered = x.saturating_sub(text_width / 2);
            let text_left = centered.clamp(left, left + width.saturating_sub(text_width));
            if text_left >= free_from {
                sizes.number.draw(sheet, text_left, number_top, &text);
                free_from = text_left + text_width + 6 * sizes.unit;
            }
        }
        sizes
            .text
            .draw(sheet, left, number_top + self.numbers, unit);
    }

    /// Draws columns whose height is the square root of the count, so that rare values are visible.
    fn draw_histogram(&self, sheet: &mut RgbImage, [left, top, width]: [u32; 3], counts: &[u64]) {
        let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
        let bins = counts.len() as u32;
        for (i, &count) in counts.iter().enumerate() {
            let from = width * i as u32 / bins;
            let to = width * (i as u32 + 1) / bins;
            let share = (count as f64 / most).sqrt();
            let height = (share * f64::from(self.histogram - 2)).ceil() as u32;
            let y = top + self.histogram - height;
            fill(sheet, [left + from, y, to - from, height], HISTOGRAM);
        }
    }
}

/// Fills a rectangle, given as left, top, width and height.
fn fill(sheet: &mut RgbImage, [left, top, width, height]: [u32; 4], color: [u8; 3]) {
    for y in top..top + height {
        for x in left..left + width {
            sheet.put_pixel(x, y, Rgb(color));
        }
    }
}
