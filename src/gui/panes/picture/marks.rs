//! Marks over the picture: the selected node's cell and the selected object's box as the camera sees
//! them, and the pixels with rays in the range of the histogram of rays.

use crate::geometry::{Aabb, Vec3};
use crate::gui::action::tip;
use crate::gui::document::inspect::Inspect;
use crate::gui::document::tasks::Latest;
use crate::gui::document::{Current, Document};
use crate::gui::theme::hint;
use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::{BOX_EDGES, CELL_COLOR, NODES_PER_RAY, REFERRING_COLOR};
use crate::primitive::Shape as _;
use crate::scene::View;
use egui::{
    Color32, ColorImage, Pos2, Rect, Shape, Stroke, TextureHandle, TextureOptions, pos2, vec2,
};
use std::sync::Arc;

/// The marks over the picture.
pub struct PictureMarks {
    /// Whether the selection is outlined.
    outlines: bool,
    dimmed: Latest<DimmedKey, Dimmed>,
    texture: Option<(DimmedKey, TextureHandle)>,
}

/// Number of the picture and range of nodes per ray.
type DimmedKey = (u64, [u32; 2]);

/// What lies over the pixels without a ray in the range.
struct Dimmed {
    image: Arc<ColorImage>,
    /// Pixels with such a ray.
    marked: usize,
}

impl Default for PictureMarks {
    fn default() -> Self {
        PictureMarks {
            outlines: true,
            dimmed: Latest::default(),
            texture: None,
        }
    }
}

impl PictureMarks {
    /// Shows or hides the outlines of the selection.
    pub fn toggle(&mut self) {
        self.outlines ^= true;
    }

    /// The switch for the outlines.
    pub fn outline_switch(&mut self, ui: &mut egui::Ui) {
        ui.checkbox(&mut self.outlines, "Outline selection")
            .on_hover_text(tip(
                "Outline the selected node's cell (solid) and the selected object's box (dashed) as \
                 the picture's camera sees them, hidden parts included.",
                "picture.outline-selection",
            ));
    }

    /// Says which pixels are hatched, if any are.
    pub fn note(&self, ui: &mut egui::Ui, doc: &Document) {
        let Some((key, range)) = key(&doc.inspect, doc.current.as_ref()) else {
            return;
        };
        let nodes = NODES_PER_RAY.format_range(range);
        let text = match self.dimmed.ready(&key) {
            Some(dimmed) => format!(
                "{} pixels with a ray of {nodes} nodes; others hatched",
                grouped(dimmed.marked)
            ),
            None => format!("Counting the pixels with a ray of {nodes} nodes"),
        };
        ui.add(egui::Label::new(hint(text)).wrap());
    }

    /// Paints the marks over a picture that lies in `rect`.
    pub fn paint(
        &mut self,
        painter: &egui::Painter,
        rect: Rect,
        current: &Current,
        inspect: &Inspect,
    ) {
        self.dim(painter, rect, current, inspect);
        if !self.outlines {
            return;
        }
        let Ok(view) = current.shown.setup.render.view(&current.shown.scene) else {
            return;
        };
        if let Some(object) = current.selection.object {
            let bounds = current.shown.scene.objects()[object as usize].bounds();
            outline(painter, rect, &view, &bounds, REFERRING_COLOR, true);
        }
        if let Some(node) = current.selection.node {
            let cell = current.shown.tree.cell_of(node).bounds;
            outline(painter, rect, &view, &cell, CELL_COLOR, false);
        }
    }

    /// Darkens and hatches the pixels without a ray in the range.
    fn dim(&mut self, painter: &egui::Painter, rect: Rect, current: &Current, inspect: &Inspect) {
        let (Some((key, _)), Some(visits)) = (key(inspect, Some(current)), inspect.visits.ready())
        else {
            return;
        };
        let size = [current.shown.picture.width, current.shown.picture.height];
        let make = move || dimmed(size, &visits.pixels_within(key.1));
        let ctx = painter.ctx();
        let Some(dimmed) = self.dimmed.get(&key, ctx, make) else {
            return;
        };
        if self.texture.as_ref().is_none_or(|(of, _)| *of != key) {
            let image = Arc::clone(&dimmed.image);
            let texture = ctx.load_texture("dimmed pixels", image, TextureOptions::NEAREST);
            self.texture = Some((key, texture));
        }
        if let Some((_, texture)) = &self.texture {
            let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
            painter.image(texture.id(), rect, whole, Color32::WHITE);
        }
    }
}

/// What decides the pixels that are dimmed, and the range as the histogram has it; `None` without a
/// range.
fn key(inspect: &Inspect, current: Option<&Current>) -> Option<(DimmedKey, [f64; 2])> {
    let range = inspect.nodes_a_ray?;
    let [lo, hi] = range;
    let whole = [lo.ceil().max(0.0) as u32, hi.floor().max(0.0) as u32];
    Some(((current?.number, whole), range))
}

/// A dark hatching over all pixels but the marked ones, which are numbered row by row.
fn dimmed([width, height]: [u32; 2], marked: &[u32]) -> Dimmed {
    let [width, height] = [width as usize, height as usize];
    let (light, dark) = (
        Color32::from_black_alpha(150),
        Color32::from_black_alpha(235),
    );
    let hatched = |i: usize| {
        let diagonal = (i % width + i / width).is_multiple_of(4);
        if diagonal { dark } else { light }
    };
    let mut pixels: Vec<Color32> = (0..width * height).map(hatched).collect();
    for &pixel in marked {
        pixels[pixel as usize] = Color32::TRANSPARENT;
    }
    Dimmed {
        image: Arc::new(ColorImage::new([width, height], pixels)),
        marked: marked.len(),
    }
}

/// The edges of a box over the picture, on a dark ground so that they are seen on any color.
fn outline(
    painter: &egui::Painter,
    rect: Rect,
    view: &View,
    bounds: &Aabb,
    [r, g, b]: [u8; 3],
    dashed: bool,
) {
    let [width, height] = view.size();
    let scale = rect.size() / vec2(width as f32, height as f32);
    let corners: [Vec3; 8] = bounds.corners();
    let color = Color32::from_rgb(r, g, b);
    let lines: Vec<_> = BOX_EDGES
        .iter()
        .filter_map(|edge| view.project_line(edge.map(|corner| corners[corner])))
        .map(|ends| ends.map(|[x, y]| rect.min + vec2(x as f32, y as f32) * scale))
        .filter_map(|ends| within(ends, painter.clip_rect().expand(4.0)))
        .collect();
    for &ends in &lines {
        painter.line_segment(ends, Stroke::new(4.0, Color32::from_black_alpha(160)));
    }
    for ends in lines {
        let stroke = Stroke::new(2.0, color);
        if dashed {
            painter.extend(Shape::dashed_line(&ends, stroke, 6.0, 4.0));
        } else {
            painter.line_segment(ends, stroke);
        }
    }
}

/// The part of a line inside a rectangle (Y.-D. Liang and B. A. Barsky, 1984): lines that pass near
/// the eye are too long to be dashed or drawn whole.
fn within([a, b]: [Pos2; 2], rect: Rect) -> Option<[Pos2; 2]> {
    let (mut from, mut to) = (0.0_f32, 1.0_f32);
    let by = b - a;
    for (start, by, lo, hi) in [
        (a.x, by.x, rect.left(), rect.right()),
        (a.y, by.y, rect.top(), rect.bottom()),
    ] {
        if by == 0.0 {
            if start < lo || start > hi {
                return None;
            }
            continue;
        }
        let (s, t) = ((lo - start) / by, (hi - start) / by);
        from = from.max(s.min(t));
        to = to.min(s.max(t));
    }
    (from <= to).then(|| [a + by * from, a + by * to])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_that_are_not_marked_are_hatched() {
        let dimmed = dimmed([5, 3], &[0, 7]);
        assert_eq!(dimmed.marked, 2);
        let pixels = &dimmed.image.pixels;
        assert_eq!(pixels[0], Color32::TRANSPARENT);
        assert_eq!(pixels[7], Color32::TRANSPARENT);
        assert_eq!(pixels.iter().filter(|p| p.a() == 0).count(), 2);
        assert!(pixels[4].a() > pixels[1].a());
    }

    #[test]
    fn lines_end_at_the_rectangle() {
        let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let cut = within([pos2(-10.0, 5.0), pos2(1e6, 5.0)], rect).unwrap();
        assert!((cut[0].x, cut[1].x) == (0.0, 10.0) || cut[1].x - 10.0 < 0.1);
        let inside = [pos2(1.0, 1.0), pos2(2.0, 9.0)];
        assert_eq!(within(inside, rect), Some(inside));
        assert_eq!(within([pos2(-5.0, 3.0), pos2(3.0, -5.1)], rect), None);
        assert_eq!(within([pos2(11.0, 3.0), pos2(11.0, 5.0)], rect), None);
    }
}
