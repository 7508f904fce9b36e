//! Small pictures of the generated scenes, for the menu of scenes. They are files that come with the
//! program, because rendering them would take as long as the first picture. `assets/thumbnails/README.md`
//! has the command that makes them.

use crate::gui::theme::{CARD_RADIUS, HINT, named, tokens};
use crate::scene::builtin::Builtin;
use egui::{
    ColorImage, Rect, Sense, Stroke, StrokeKind, TextureHandle, TextureOptions, pos2, vec2,
};

/// Width and height of a picture in points, and in pixels of its file.
const SIDE: f32 = 96.0;

/// The height of the name below the picture, in points.
const NAME: f32 = 20.0;

/// The distance of a picture from the outline of its button, in points.
const MARGIN: f32 = 4.0;

/// The files, by the name of the scene.
const FILES: &[(&str, &[u8])] = &[
    (
        "balls",
        include_bytes!("../../../assets/thumbnails/balls.png"),
    ),
    (
        "rings",
        include_bytes!("../../../assets/thumbnails/rings.png"),
    ),
    (
        "tetra",
        include_bytes!("../../../assets/thumbnails/tetra.png"),
    ),
    (
        "fluid",
        include_bytes!("../../../assets/thumbnails/fluid.png"),
    ),
    (
        "m-fluid",
        include_bytes!("../../../assets/thumbnails/m-fluid.png"),
    ),
    (
        "room",
        include_bytes!("../../../assets/thumbnails/room.png"),
    ),
    (
        "lattice",
        include_bytes!("../../../assets/thumbnails/lattice.png"),
    ),
    (
        "terrain",
        include_bytes!("../../../assets/thumbnails/terrain.png"),
    ),
    (
        "teaching",
        include_bytes!("../../../assets/thumbnails/teaching.png"),
    ),
];

/// The pictures, decoded when they are first shown.
#[derive(Default)]
pub struct Thumbnails(Vec<Option<TextureHandle>>);

impl Thumbnails {
    /// The width of a button.
    pub const WIDTH: f32 = SIDE + 2.0 * MARGIN;

    /// Shows a scene as a button: its picture above its name.
    pub fn button(&mut self, ui: &mut egui::Ui, scene: &Builtin, chosen: bool) -> egui::Response {
        let size = vec2(Self::WIDTH, SIDE + NAME + 2.0 * MARGIN);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::Button, true, chosen, scene.name)
        });
        if ui.is_rect_visible(rect) {
            let visuals = ui.style().interact_selectable(&response, chosen);
            let is_marked = chosen || response.hovered() || response.has_focus();
            if is_marked {
                ui.painter()
                    .rect_filled(rect, CARD_RADIUS, visuals.weak_bg_fill);
            }
            if response.has_focus() {
                let ring = Stroke::new(2.0, tokens(ui).border);
                ui.painter()
                    .rect_stroke(rect, CARD_RADIUS, ring, StrokeKind::Inside);
            }
            let picture = Rect::from_min_size(rect.min + vec2(MARGIN, MARGIN), vec2(SIDE, SIDE));
            if let Some(texture) = self.texture(ui.ctx(), scene.name) {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                let white = egui::Color32::WHITE;
                ui.painter().image(texture.id(), picture, whole, white);
            }
            let font = named(HINT).resolve(ui.style());
            let color = visuals.text_color();
            let place = pos2(
                rect.center().x,
                picture.bottom() + NAME / 2.0 + MARGIN / 2.0,
            );
            let middle = egui::Align2::CENTER_CENTER;
            ui.painter().text(place, middle, scene.name, font, color);
        }
        response
    }

    /// The picture of a scene; `None` if there is none.
    fn texture(&mut self, ctx: &egui::Context, scene: &str) -> Option<&TextureHandle> {
        self.0.resize(FILES.len(), None);
        let place = FILES.iter().position(|(name, _)| *name == scene)?;
        let known = &mut self.0[place];
        if known.is_none() {
            let name = format!("thumbnail of {scene}");
            let load = |image| ctx.load_texture(name, image, TextureOptions::LINEAR);
            *known = decode(FILES[place].1).map(load);
        }
        known.as_ref()
    }
}

/// Returns the picture of a file; `None` if it cannot be read.
fn decode(file: &[u8]) -> Option<ColorImage> {
    let image = image::load_from_memory(file).ok()?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Some(ColorImage::from_rgba_unmultiplied(size, &image))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin::BUILTINS;

    #[test]
    fn every_generated_scene_has_its_picture() {
        assert_eq!(FILES.len(), BUILTINS.len());
        for scene in BUILTINS {
            let file = FILES.iter().find(|(name, _)| *name == scene.name);
            let (_, file) = file.unwrap_or_else(|| panic!("{} has no picture", scene.name));
            let image = decode(file).expect("a picture");
            assert_eq!(image.size, [SIDE as usize; 2], "{}", scene.name);
            let first = image.pixels[0];
            assert!(image.pixels.iter().any(|pixel| *pixel != first));
        }
    }

    #[test]
    fn the_pictures_are_small() {
        let bytes: usize = FILES.iter().map(|(_, file)| file.len()).sum();
        assert!(bytes < 200_000, "{bytes}");
    }
}
