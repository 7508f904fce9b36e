//! The steps of a ray: a block per step, in order. Leaves are as wide as the ray is long in them; in a tree of
//! planes they lie on the ray one after the other, and boxes may overlap. The inner nodes that lead to a leaf
//! stand above it, and so do the nodes that are culled after it, with a cross.

use crate::gui::theme::Tokens;
use crate::gui::widgets::step_text;
use crate::present::overlay::{CULLED, order_color};
use crate::trace::{RayPath, Step};
use egui::{Align2, Color32, Rect, Sense, Stroke, StrokeKind, Theme, Ui, pos2, vec2};
use std::ops::Range;

/// The height of the strip in points.
pub const HEIGHT: f32 = 40.0;

/// The height of the blocks of inner nodes, and where the blocks of leaves end.
const INNER: f32 = 9.0;
const LEAVES: f32 = 23.0;

/// Behind the blocks, in both themes: the colors of leaves are made for the dark ground of the 3D view.
const GROUND: Color32 = Color32::from_rgb(24, 27, 33);

/// The least width of a leaf's block in points.
const LEAST: f32 = 4.0;

/// The width of a step after the last leaf in points, and the most that all of them take of the strip.
const AFTER: f32 = 10.0;
const MOST_AFTER: f32 = 0.2;

/// A block of the strip.
#[derive(Clone, Debug, PartialEq)]
struct Block {
    step: usize,
    /// Left and right end, in points from the strip's left end.
    x: Range<f32>,
    is_leaf: bool,
}

/// The places of all steps on a strip.
struct Layout {
    blocks: Vec<Block>,
    /// The interval of t and of x that each leaf takes.
    leaves: Vec<(Range<f64>, Range<f32>)>,
}

impl Layout {
    fn new(path: &RayPath, whole: f32) -> Self {
        let is_leaf = |step: &&Step| matches!(step, Step::Leaf(_));
        let after = path.steps.iter().rev().take_while(|step| !is_leaf(step));
        // In a hierarchy, pending nodes are left when the closest hit is known.
        let width = match after.count() {
            n if n == path.steps.len() => 0.0,
            n => whole - (AFTER * n as f32).min(MOST_AFTER * whole),
        };
        let spans: Vec<Range<f64>> = path
            .leaves()
            .map(|leaf| leaf.t_enter..leaf.t_exit)
            .collect();
        let length = |span: &Range<f64>| (span.end - span.start).max(0.0);
        let total: f64 = spans.iter().map(length).sum();
        // Every leaf has the least width, and its share of the rest.
        let least = LEAST.min(0.5 * width / spans.len().max(1) as f32);
        let rest = width - least * spans.len() as f32;
        let mut layout = Layout {
            blocks: Vec::new(),
            leaves: Vec::new(),
        };
        let mut x = 0.0;
        for span in spans {
            let share = if total > 0.0 && total.is_finite() {
                (length(&span) / total) as f32
            } else {
                1.0
            };
            let right = (x + least + rest * share).min(width);
            layout.leaves.push((span, x..right));
            x = right;
        }
        let mut inner = Vec::new();
        let mut leaves = layout.leaves.iter().map(|(_, x)| x.clone());
        for (step, what) in path.steps.iter().enumerate() {
            match what {
                Step::Inner(_) | Step::Boxes(_) | Step::Culled(_) => inner.push(step),
                Step::Leaf(_) => {
                    let x = leaves.next().expect("every leaf has a place");
                    layout.blocks.extend(side_by_side(&inner, x.clone()));
                    inner.clear();
                    layout.blocks.push(Block {
                        step,
                        x,
                        is_leaf: true,
                    });
                }
            }
        }
        layout.blocks.extend(side_by_side(&inner, width..whole));
        layout
    }

    /// Where a parameter of the ray lies, in points from the left end.
    fn place(&self, t: f64) -> Option<f32> {
        let (span, x) = self
            .leaves
            .iter()
            .find(|(span, _)| t <= span.end)
            .or(self.leaves.last())?;
        let part = (t - span.start) / (span.end - span.start).max(f64::MIN_POSITIVE);
        Some(x.start + (part.clamp(0.0, 1.0) as f32) * (x.end - x.start))
    }

    /// Where a hit in a leaf lies; `order` is the leaf's number. In the leaf, or beyond it where the ray
    /// gets to later.
    fn place_of_hit(&self, order: usize, t: f64) -> Option<f32> {
        let (span, x) = self.leaves.get(order)?;
        if !(span.start..=span.end).contains(&t) {
            return self.place(t);
        }
        let part = (t - span.start) / (span.end - span.start).max(f64::MIN_POSITIVE);
        Some(x.start + (part as f32) * (x.end - x.start))
    }

    /// Whether the leaves lie on the ray one after the other.
    fn is_along(&self) -> bool {
        let starts = self.leaves.iter().map(|(span, _)| span);
        starts.is_sorted_by(|a, b| a.start <= b.start && a.end <= b.end)
    }

    /// The step at a place; `above` among inner nodes.
    fn at(&self, x: f32, above: bool) -> Option<usize> {
        let distance = |block: &Block| (block.x.start - x).max(x - block.x.end).max(0.0);
        self.blocks
            .iter()
            .filter(|block| block.is_leaf != above)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .map(|block| block.step)
    }
}

/// Divides an interval among steps.
fn side_by_side(steps: &[usize], x: Range<f32>) -> impl Iterator<Item = Block> + '_ {
    let width = (x.end - x.start) / steps.len().max(1) as f32;
    steps.iter().enumerate().map(move |(i, &step)| Block {
        step,
        x: x.start + i as f32 * width..x.start + (i + 1) as f32 * width,
        is_leaf: false,
    })
}

/// Shows the strip; `path` is `None` while no ray is selected. Returns the step that was clicked.
pub fn show(ui: &mut Ui, path: Option<&RayPath>, step: usize, leaves_only: bool) -> Option<usize> {
    let size = vec2(ui.available_width(), HEIGHT);
    let (whole, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let name = "Steps along the ray";
    let steps = path.map_or(0, |path| path.steps.len());
    response
        .widget_info(|| egui::WidgetInfo::slider(steps > 0, (step + 1).min(steps) as f64, name));
    let rect = whole.shrink2(vec2(8.0, 3.0));
    ui.painter().rect_filled(whole, 4.0, GROUND);
    let path = path?;
    let layout = Layout::new(path, rect.width());
    paint(ui, rect, path, &layout, step, leaves_only);
    let pointer = response.interact_pointer_pos();
    let target = |at: egui::Pos2| {
        let above = !leaves_only && at.y < rect.top() + INNER;
        let found = layout.at(at.x - rect.left(), above);
        found.or_else(|| layout.at(at.x - rect.left(), !above))
    };
    let hovered = response.hover_pos().and_then(target);
    if let Some(hovered) = hovered {
        response.on_hover_text_at_pointer(about(hovered, &path.steps[hovered]));
    }
    pointer.and_then(target).filter(|&to| to != step)
}

/// What a block says under the pointer.
fn about(number: usize, step: &Step) -> String {
    let what = format!(
        "Step {}: {} {}",
        number + 1,
        step_text::kind(step),
        step.node()
    );
    let [enter, exit] = step.interval();
    let interval = step_text::interval(enter, exit);
    match step {
        Step::Culled(culled) => format!("{what}: {}", step_text::why_culled(culled)),
        Step::Boxes(boxes) => {
            let mut text = format!("{what}, t from {interval} units");
            for test in &boxes.tests {
                text += &format!("\n{}", step_text::box_test(boxes, test));
            }
            text
        }
        Step::Leaf(leaf) => format!("{what}, t from {interval} units\n{}", leaf.outcome.text()),
        Step::Inner(_) => format!("{what}, t from {interval} units"),
    }
}

fn paint(ui: &Ui, rect: Rect, path: &RayPath, layout: &Layout, step: usize, leaves_only: bool) {
    let (t, painter) = (Tokens::of(Theme::Dark), ui.painter());
    let n = layout.leaves.len();
    let mut order = 0;
    for block in &layout.blocks {
        let [top, bottom] = if block.is_leaf {
            [INNER + 1.0, LEAVES]
        } else {
            [0.0, INNER - 1.0]
        };
        let gap = if block.x.end - block.x.start > 3.0 {
            1.0
        } else {
            0.0
        };
        let block_rect = Rect::from_min_max(
            pos2(rect.left() + block.x.start, rect.top() + top),
            pos2(
                rect.left() + (block.x.end - gap).max(block.x.start + 1.0),
                rect.top() + bottom,
            ),
        );
        match &path.steps[block.step] {
            Step::Leaf(leaf) => {
                let [r, g, b] = order_color(order, n);
                let color = Color32::from_rgb(r, g, b);
                order += 1;
                if leaf.objects == 0 {
                    let stroke = Stroke::new(1.5, color);
                    painter.rect_stroke(block_rect, 1.0, stroke, StrokeKind::Inside);
                } else {
                    painter.rect_filled(block_rect, 1.0, color);
                }
            }
            _ if leaves_only => {}
            Step::Culled(_) => {
                let [r, g, b] = CULLED;
                let stroke = Stroke::new(1.0, Color32::from_rgb(r, g, b));
                painter.rect_stroke(block_rect, 1.0, stroke, StrokeKind::Inside);
                // Where there is room for a cross beside the frame.
                let middle = block_rect.center();
                let half = 0.5 * block_rect.height() - 1.0;
                if block_rect.width() > 2.0 * half {
                    for down in [-half, half] {
                        let ends = [middle - vec2(half, down), middle + vec2(half, down)];
                        painter.line_segment(ends, Stroke::new(1.5, stroke.color));
                    }
                }
            }
            _ => {
                painter.rect_filled(block_rect, 1.0, t.border);
            }
        }
        if block.step == step {
            let stroke = Stroke::new(2.0, t.text);
            painter.rect_stroke(block_rect.expand(2.0), 2.0, stroke, StrokeKind::Inside);
        }
    }
    marks(ui, rect, path, layout);
}

/// Marks the hits, the closest one with a wedge, and writes where the strip begins and ends.
fn marks(ui: &Ui, rect: Rect, path: &RayPath, layout: &Layout) {
    let (t, painter) = (Tokens::of(Theme::Dark), ui.painter());
    let hits = path.leaves().enumerate().flat_map(|(order, leaf)| {
        let hits = leaf.tests.iter().filter_map(|test| test.hit);
        hits.map(move |hit| (order, hit))
    });
    for (order, hit) in hits {
        let Some(x) = layout.place_of_hit(order, hit) else {
            continue;
        };
        let x = rect.left() + x;
        let stroke = Stroke::new(2.0, t.text);
        painter.vline(x, rect.top() + INNER..=rect.top() + LEAVES + 1.0, stroke);
        if path.hit.is_hit() && hit == path.hit.t {
            let top = pos2(x, rect.top() + LEAVES);
            let wedge = vec![top, top + vec2(-5.0, 8.0), top + vec2(5.0, 8.0)];
            painter.add(egui::Shape::convex_polygon(wedge, t.text, Stroke::NONE));
        }
    }
    let font = egui::FontId::proportional(12.0);
    if let (Some((first, _)), Some((last, _))) = (layout.leaves.first(), layout.leaves.last()) {
        // Leaves whose boxes overlap are no axis.
        let [from, to] = if layout.is_along() {
            ["t = ", "t = "]
        } else {
            ["first leaf from t = ", "last leaf to t = "]
        };
        for (at, align, what, t_end) in [
            (rect.left(), Align2::LEFT_BOTTOM, from, first.start),
            (rect.right(), Align2::RIGHT_BOTTOM, to, last.end),
        ] {
            let text = format!("{what}{}", step_text::short(t_end));
            let bottom = pos2(at, rect.bottom() + 3.0);
            painter.text(bottom, align, text, font.clone(), t.hint);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::{BuildSettings, Method, build};
    use crate::trace::{LeafStep, RenderSettings, record_pixel};

    #[test]
    fn every_step_has_a_block_and_is_found_at_its_place() {
        for method in ["midpoint", "bvh-sweep"] {
            check_blocks(method);
        }
    }

    fn check_blocks(method: &str) {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:2"), &progress).unwrap();
        let settings = BuildSettings::for_method(Method::named(method).unwrap());
        let tree = build(&scene, &settings, &progress).unwrap();
        let render = RenderSettings {
            width: 16,
            height: 16,
            ..RenderSettings::default()
        };
        let record = record_pixel(&scene, &tree, &render, [8, 8]).unwrap();
        for ray in record.rays.iter().filter(|ray| !ray.path.steps.is_empty()) {
            let layout = Layout::new(&ray.path, 800.0);
            let steps: Vec<usize> = layout.blocks.iter().map(|block| block.step).collect();
            assert_eq!(steps, (0..ray.path.steps.len()).collect::<Vec<_>>());
            let leaves: Vec<_> = layout.blocks.iter().filter(|block| block.is_leaf).collect();
            if leaves.is_empty() {
                assert!(method == "bvh-sweep" && !ray.path.hit.is_hit());
                continue;
            }
            if method == "midpoint" {
                assert!(layout.is_along());
            }
            assert!(leaves.is_sorted_by(|a, b| a.x.end <= b.x.start));
            let end = layout.blocks.iter().map(|block| block.x.end);
            assert!((end.fold(0.0, f32::max) - 800.0).abs() < 0.5);
            assert!(leaves.last().unwrap().x.end >= 0.8 * 800.0 - 0.5);
            for block in &layout.blocks {
                let middle = 0.5 * (block.x.start + block.x.end);
                assert_eq!(layout.at(middle, !block.is_leaf), Some(block.step));
            }
            if ray.path.hit.is_hit() {
                let found =
                    |leaf: &LeafStep| leaf.tests.iter().any(|t| t.hit == Some(ray.path.hit.t));
                let order = ray.path.leaves().position(found).unwrap();
                let x = layout.place_of_hit(order, ray.path.hit.t).unwrap();
                let last = leaves.last().unwrap();
                assert!(x <= last.x.end && x >= leaves[0].x.start);
            }
        }
    }
}
