//! Where a picture lies in its pane: fitted into it, or zoomed and moved.

use crate::gui::widgets::rounded::rounded;
use crate::workspace::PicturePlace;
use egui::{Pos2, Rect, Vec2, vec2};

/// How a picture is looked at.
#[derive(Default)]
pub struct Place {
    /// Points per pixel; `None` fits the picture into the pane.
    zoom: Option<f32>,
    /// The picture's center relative to the pane's, in points.
    offset: Vec2,
}

impl Place {
    /// Fits the picture into the pane.
    pub fn fit(&mut self) {
        *self = Place::default();
    }

    /// Shows it with so many points per pixel.
    pub fn zoom_to(&mut self, zoom: f32) {
        *self = Place {
            zoom: Some(zoom),
            offset: Vec2::ZERO,
        };
    }

    /// Moves the picture.
    pub fn drag(&mut self, by: Vec2) {
        self.offset += by;
    }

    /// Returns the rectangle of a picture of this size in a pane.
    pub fn rect(&self, pane: Rect, [width, height]: [u32; 2]) -> Rect {
        let size = vec2(width as f32, height as f32);
        let zoom = self.zoom.unwrap_or_else(|| {
            let fit = pane.size() / size;
            fit.x.min(fit.y)
        });
        Rect::from_center_size(pane.center() + self.offset, size * zoom)
    }

    /// Returns the pixel at a point; `None` outside the picture.
    pub fn pixel_at(&self, pane: Rect, picture: [u32; 2], point: Pos2) -> Option<[u32; 2]> {
        let size = vec2(picture[0] as f32, picture[1] as f32);
        let rect = self.rect(pane, picture);
        let at = (point - rect.min) / rect.size() * size;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y;
        inside.then_some([at.x as u32, at.y as u32])
    }

    /// Moves the picture so that a pixel is in the pane.
    pub fn reveal(&mut self, pane: Rect, picture: [u32; 2], pixel: [u32; 2]) {
        let rect = self.rect(pane, picture);
        let [x, y] = pixel.map(|i| i as f32 + 0.5);
        let at = rect.min + vec2(x / picture[0] as f32, y / picture[1] as f32) * rect.size();
        if !pane.contains(at) {
            self.offset += pane.center() - at;
        }
    }

    /// Zooms by a turn of the wheel; what is at the pointer stays there.
    pub fn zoom_at(&mut self, pane: Rect, picture: [u32; 2], pointer: Pos2, wheel: f32) {
        let before = self.rect(pane, picture);
        let zoom = before.width() / picture[0] as f32;
        let [least, most] =
            [PicturePlace::ZOOMS.start(), PicturePlace::ZOOMS.end()].map(|&zoom| zoom as f32);
        let next = (zoom * (wheel * 0.004).exp()).clamp(least, most);
        self.zoom = Some(next);
        let from_center = before.center() - pointer;
        self.offset = pointer + from_center * (next / zoom) - pane.center();
    }

    /// Returns it as a workspace keeps it.
    pub fn kept(&self) -> PicturePlace {
        PicturePlace {
            zoom: self.zoom.map(rounded),
            offset: [self.offset.x, self.offset.y].map(rounded),
        }
    }

    /// Looks at the picture as a workspace says.
    pub fn load(&mut self, kept: &PicturePlace) {
        self.zoom = kept.zoom.map(|zoom| zoom as f32);
        let [x, y] = kept.offset.map(|by| by as f32);
        self.offset = vec2(x, y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    const PICTURE: [u32; 2] = [48, 24];

    fn pane() -> Rect {
        Rect::from_min_size(pos2(10.0, 20.0), vec2(480.0, 400.0))
    }

    #[test]
    fn a_picture_fits_and_its_pixels_are_found() {
        let place = Place::default();
        assert_eq!(place.rect(pane(), PICTURE).size(), vec2(480.0, 240.0));
        let at = |x, y| place.pixel_at(pane(), PICTURE, pos2(x, y));
        assert_eq!(at(10.5, 100.5), Some([0, 0]));
        assert_eq!(at(489.5, 339.5), Some([47, 23]));
        assert_eq!(at(10.5, 99.5), None);
        assert_eq!(at(490.5, 200.0), None);
    }

    #[test]
    fn what_is_at_the_pointer_stays_when_the_wheel_turns() {
        let mut place = Place::default();
        let pointer = pos2(100.0, 150.0);
        let before = place.pixel_at(pane(), PICTURE, pointer);
        place.zoom_at(pane(), PICTURE, pointer, 200.0);
        assert!(place.rect(pane(), PICTURE).width() > 900.0);
        assert_eq!(place.pixel_at(pane(), PICTURE, pointer), before);
        // A pixel that the zoom moved out of the pane comes back.
        place.reveal(pane(), PICTURE, [47, 23]);
        let center = place.pixel_at(pane(), PICTURE, pane().center());
        assert_eq!(center, Some([47, 23]));
        place.fit();
        assert_eq!(place.kept(), PicturePlace::default());
    }
}
