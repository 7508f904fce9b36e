//! A picture as a texture, brought up to date with as little copying as possible.

use crate::gui::document::Current;
use crate::trace::{Picture, Tile};
use egui::ecolor::gamma_u8_from_linear_f32;
use egui::{Color32, ColorImage, TextureHandle, TextureId, TextureOptions};

/// A texture, and which picture it shows.
pub struct Uploaded {
    /// Number of the picture.
    number: u64,
    /// How many of its tiles the texture has.
    tiles: usize,
    texture: TextureHandle,
}

impl Uploaded {
    pub fn id(&self) -> TextureId {
        self.texture.id()
    }

    /// Brings a texture up to date: all of it for a different picture, else only the new tiles.
    pub fn update(slot: &mut Option<Uploaded>, ctx: &egui::Context, current: &Current) {
        let on_view = current.on_view();
        let picture = &*on_view.picture;
        let count = current.tiles().count();
        if let Some(uploaded) = slot.as_mut().filter(|u| u.number == on_view.number) {
            if current.is_held() {
                return;
            }
            if let Some(tiles) = current.tiles().since(uploaded.tiles) {
                for tile in tiles {
                    let at = [tile.x as usize, tile.y as usize];
                    let image = part(picture, tile);
                    uploaded
                        .texture
                        .set_partial(at, image, TextureOptions::NEAREST);
                }
                uploaded.tiles = count;
                return;
            }
        }
        let whole = Tile {
            x: 0,
            y: 0,
            width: picture.width,
            height: picture.height,
        };
        let image = part(picture, &whole);
        let texture = match slot.take() {
            Some(mut uploaded) if uploaded.texture.size() == image.size => {
                uploaded.texture.set(image, TextureOptions::NEAREST);
                uploaded.texture
            }
            _ => ctx.load_texture("picture", image, TextureOptions::NEAREST),
        };
        *slot = Some(Uploaded {
            number: on_view.number,
            tiles: count,
            texture,
        });
    }
}

/// A rectangle of a picture in the colors of the screen.
fn part(picture: &Picture, tile: &Tile) -> ColorImage {
    let pixels = (0..tile.height)
        .flat_map(|y| (0..tile.width).map(move |x| (tile.x + x, tile.y + y)))
        .map(|(x, y)| {
            let [r, g, b] = picture.get(x, y).map(gamma_u8_from_linear_f32);
            Color32::from_rgb(r, g, b)
        })
        .collect();
    ColorImage::new([tile.width as usize, tile.height as usize], pixels)
}
