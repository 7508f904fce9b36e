//! The error of every pixel for the chosen outcome, in colors.

use super::study::Found;
use crate::gui::document::tasks::Latest;
use crate::gui::widgets::common::busy;
use crate::gui::widgets::scale_bar::{NUMBERS, TICK, color_bar, numbers};
use crate::measure::heat::HeatImage;
use crate::present::number::significant;
use crate::present::overlay::{Colormap, HeatScale, Range, Scale, colormap, heat_colors};
use egui::{Color32, ColorImage, Rect, TextureHandle, TextureOptions, pos2, vec2};
use std::sync::Arc;

/// Height of the color bar in points.
const BAR: f32 = 10.0;

/// An error that is hardly seen: the color scale is linear below and logarithmic above.
const GRAIN: f64 = 1e-3;

/// An outcome of a study.
type Key = (u64, usize);

#[derive(Default)]
pub struct ErrorMap {
    colored: Latest<Key, Colored>,
    texture: Option<(Key, TextureHandle)>,
}

/// Errors in colors.
struct Colored {
    image: HeatImage,
    /// `None` where no pixel has an error.
    scale: Option<HeatScale>,
    pixels: Arc<ColorImage>,
}

fn colors() -> &'static Colormap {
    colormap("inferno").expect("it is a map")
}

impl Colored {
    fn of(errors: &[f32], [width, height]: [u32; 2]) -> Self {
        let image = HeatImage {
            width,
            height,
            values: errors.to_vec(),
            grain: GRAIN,
        };
        let hi = image.present().fold(0.0, f64::max);
        let range = Range::Fixed { lo: 0.0, hi };
        let scale = HeatScale::new(&image, Scale::Logarithmic, range, colors());
        let pixels = heat_colors(&image, scale.as_ref(), colors());
        let pixels = pixels
            .into_iter()
            .map(|[r, g, b]| Color32::from_rgb(r, g, b));
        let size = [width as usize, height as usize];
        Colored {
            pixels: Arc::new(ColorImage::new(size, pixels.collect())),
            scale,
            image,
        }
    }
}

impl ErrorMap {
    /// Shows the map with its legend. Returns the pixel that is clicked.
    pub fn ui(
        &mut self,
        ui: &mut egui::Ui,
        found: &Found,
        chosen: Option<usize>,
    ) -> Option<[u32; 2]> {
        let outcome = chosen.and_then(|place| Some((place, found.trade.outcomes.get(place)?)));
        let (Some((place, outcome)), Some(size)) = (outcome, found.size()) else {
            ui.weak("Choose an outcome: click a point or a row.");
            return None;
        };
        ui.label(format!("Error of {}", outcome.choice.words()));
        let Some(errors) = found.pixel_errors.get(place) else {
            ui.weak("The errors of so many pixels would take too much memory; they are not kept.");
            return None;
        };
        let (key, errors) = ((found.number, place), Arc::clone(errors));
        let make = move || Colored::of(&errors, size);
        let Some(colored) = self.colored.get(&key, ui.ctx(), make) else {
            busy(ui, "Coloring the errors…");
            return None;
        };
        let Some(scale) = &colored.scale else {
            ui.label("No pixel differs from the reference.");
            return None;
        };
        let texture = match &self.texture {
            Some((of, texture)) if *of == key => texture.id(),
            _ => {
                let pixels = Arc::clone(&colored.pixels);
                let options = TextureOptions::NEAREST;
                let texture = ui.ctx().load_texture("error map", pixels, options);
                self.texture.insert((key, texture)).1.id()
            }
        };
        // Two lines of text, the bar and its numbers stand below.
        let line = ui.text_style_height(&egui::TextStyle::Body) + ui.spacing().item_spacing.y;
        let below = 2.0 * line + BAR + TICK + NUMBERS;
        let room = ui.available_size() - vec2(0.0, below);
        let [width, height] = size.map(|n| n as f32);
        let factor = (room.x / width).min(room.y / height).max(8.0 / height);
        let (rect, response) =
            ui.allocate_exact_size(vec2(width, height) * factor, egui::Sense::click());
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture, rect, whole, Color32::WHITE);
        let name = format!("Error map of {}", outcome.choice.words());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
        let under = response
            .hover_pos()
            .map(|at| ((at - rect.min) / factor).max(vec2(0.0, 0.0)))
            .map(|at| [at.x as u32, at.y as u32])
            .map(|[x, y]| [x.min(size[0] - 1), y.min(size[1] - 1)]);
        legend(ui, scale);
        let value = under.and_then(|[x, y]| Some((x, y, colored.image.get(x, y)?)));
        ui.add(
            egui::Label::new(match value {
                Some((x, y, error)) => {
                    format!("pixel {x}, {y}: {}", significant(f64::from(error)))
                }
                None => "Point at a pixel to read its error; click to pick it.".to_owned(),
            })
            .wrap(),
        );
        under.filter(|_| response.clicked())
    }
}

/// The colors with their numbers and what they are.
fn legend(ui: &mut egui::Ui, scale: &HeatScale) {
    ui.label("root mean square over the color channels, linear light")
        .on_hover_text(
            "Square root of the mean squared difference over a pixel's color channels, on linear light \
             from 0 to 1. The color scale is logarithmic above 0.001.",
        );
    let size = vec2(ui.available_width(), BAR + TICK + NUMBERS);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let name = format!("Legend from 0 to {}, linear light", significant(scale.hi));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let bar = Rect::from_min_size(rect.min, vec2(rect.width(), BAR));
    let painter = ui.painter().with_clip_rect(rect);
    color_bar(&painter, colors(), bar);
    numbers(
        &painter,
        scale,
        [0, 0],
        bar,
        rect,
        ui.visuals().text_color(),
    );
}
