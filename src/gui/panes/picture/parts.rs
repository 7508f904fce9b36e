//! How one picture, or the pictures of two trees, share the pane.

use super::place::Place;
use crate::gui::document::Document;
use crate::gui::document::comparing::{View, Which};
use egui::{Rect, Vec2, vec2};

/// One picture's share of the pane.
pub struct Part {
    pub which: Which,
    /// What the picture is fitted into.
    pub pane: Rect,
    /// What is seen of it.
    pub clip: Rect,
}

/// Half the space between two pictures.
const GAP: f32 = 1.0;

/// How the pictures share the pane: the one in front alone, or A before B.
pub fn parts(place: &Place, pane: Rect, doc: &Document, flipped: bool) -> Vec<Part> {
    let alone = |which| {
        vec![Part {
            which,
            pane,
            clip: pane,
        }]
    };
    if doc.other.is_none() {
        return alone(doc.which);
    }
    let [first, second] = match flipped {
        false => [Which::A, Which::B],
        true => [Which::B, Which::A],
    };
    match doc.comparing.view {
        View::Difference => alone(doc.which),
        View::One if flipped => alone(doc.which.other()),
        View::One => alone(doc.which),
        View::Wipe => {
            let picture = size_of(doc, doc.which);
            let rect = picture.map_or(pane, |picture| place.rect(pane, picture));
            let x = egui::lerp(rect.x_range(), doc.comparing.split);
            let (left, right) = pane.split_left_right_at_x(x.clamp(pane.left(), pane.right()));
            [(first, left), (second, right)]
                .map(|(which, clip)| Part { which, pane, clip })
                .into()
        }
        View::Beside => {
            let (left, right) = pane.split_left_right_at_fraction(0.5);
            [(first, left), (second, right)]
                .map(|(which, half)| {
                    let half = half.shrink2(vec2(GAP, 0.0));
                    Part {
                        which,
                        pane: half,
                        clip: half,
                    }
                })
                .into()
        }
    }
}

/// Returns the size of the picture of a tree in pixels; `None` while there is none.
pub fn size_of(doc: &Document, which: Which) -> Option<[u32; 2]> {
    let picture = &doc.both()[which as usize]?.shown.picture;
    Some([picture.width, picture.height])
}

/// Returns the height that is left below a picture that is as wide as its part of the pane.
pub fn room_below(pane: Vec2, doc: &Document) -> f32 {
    let [width, height] = size_of(doc, doc.which).unwrap_or([1, 1]);
    let beside = doc.other.is_some() && doc.comparing.view == View::Beside;
    let of_one = if beside {
        pane.x / 2.0 - 2.0 * GAP
    } else {
        pane.x
    };
    pane.y - of_one * height as f32 / width as f32
}
