//! All rays of a pixel as lines. Color and dash pattern show the kind of ray; a mark shows how it
//! ends.

use super::Line;
use crate::geometry::{Aabb, Ray, Vec3};
use crate::trace::{PixelRecord, RayKind, RayPath};

/// How rays of a kind are drawn. Color and dash pattern are each unique to the kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayStyle {
    /// sRGB.
    pub color: [u8; 3],
    /// Lengths of dashes and gaps in turn, in an arbitrary unit; empty for a solid line.
    pub strokes: &'static [f64],
    /// Name of the dash pattern.
    pub text: &'static str,
}

/// Returns how rays of this kind are drawn.
pub const fn ray_style(kind: RayKind) -> RayStyle {
    match kind {
        RayKind::Primary => RayStyle {
            color: [255, 255, 255],
            strokes: &[],
            text: "solid",
        },
        RayKind::Shadow => RayStyle {
            color: [255, 221, 51],
            strokes: &[1.0, 1.0],
            text: "short dashes",
        },
        RayKind::Reflected => RayStyle {
            color: [64, 224, 255],
            strokes: &[4.0, 1.0],
            text: "long dashes",
        },
        RayKind::Refracted => RayStyle {
            color: [255, 96, 255],
            strokes: &[3.0, 1.0, 0.6, 1.0],
            text: "dash and dot",
        },
    }
}

/// Which rays of a pixel are drawn, and how.
#[derive(Clone, Copy, Debug)]
pub struct RaysShown {
    /// Index of the ray to draw thicker.
    pub selected: usize,
    /// Whether to draw the other rays, too.
    pub others: bool,
    /// Box that clips the rays.
    pub space: Aabb,
    /// Size of marks, in scene units.
    pub mark: f64,
}

impl RaysShown {
    /// The most rays to draw. More could not be distinguished.
    pub const MOST: usize = 1000;
}

/// Width of the selected ray and of the others, in points.
const WIDTHS: [f32; 2] = [6.0, 1.5];

/// Width of the outline on either side of the selected ray, in points.
const OUTLINE: f32 = 1.5;

/// Color of the outline: dark, so that the ray stands out from bright objects.
const OUTLINE_COLOR: [u8; 4] = [12, 14, 18, 255];

/// The most repetitions of the dash pattern along one ray.
const MOST_STROKES: f64 = 80.0;

/// Returns the rays of a pixel as lines, the selected ray last, thick and outlined. A cross marks a hit. A
/// star marks a light that the ray reaches.
pub fn ray_lines(record: &PixelRecord, shown: &RaysShown, center: Vec3) -> Vec<Line> {
    let mut lines = Vec::new();
    let others = (0..record.rays.len().min(RaysShown::MOST))
        .filter(|&place| shown.others && place != shown.selected);
    let [thick, thin] = WIDTHS;
    for place in others {
        one_ray(&record.rays[place].path, shown, thin, center, &mut lines);
    }
    if let Some(ray) = record.rays.get(shown.selected) {
        let mut selected = Vec::new();
        one_ray(&ray.path, shown, thick, center, &mut selected);
        lines.extend(selected.iter().map(|line| Line {
            color: OUTLINE_COLOR,
            width: line.width + 2.0 * OUTLINE,
            ..*line
        }));
        lines.extend(selected);
    }
    lines
}

fn one_ray(path: &RayPath, shown: &RaysShown, width: f32, center: Vec3, lines: &mut Vec<Line>) {
    let ray = &path.ray;
    let style = ray_style(path.kind);
    let [r, g, b] = style.color;
    let color = [r, g, b, 255];
    let end = end_of(path, shown);
    if !end.is_finite() {
        return;
    }
    let mut line = |a: Vec3, b: Vec3| lines.push(Line::new(a, b, center, color, width));
    for [from, to] in strokes(end, style.strokes, shown.mark) {
        line(ray.at(from), ray.at(to));
    }
    let point = ray.at(end);
    let mark_width = width.min(2.5);
    let mut line = |a: Vec3, b: Vec3| lines.push(Line::new(a, b, center, color, mark_width));
    if path.hit.is_hit() {
        for axis in Vec3::AXES {
            line(point - axis * shown.mark, point + axis * shown.mark);
        }
    } else if path.kind == RayKind::Shadow && end == ray.t_max {
        let diagonals = [[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]];
        for arm in Vec3::AXES
            .into_iter()
            .chain(diagonals.map(|d| Vec3::from(d.map(f64::from)) * 0.6))
        {
            let arm = arm * shown.mark * 1.5;
            line(point - arm, point + arm);
        }
    }
}

/// Returns the ray parameter where the line ends: the hit, the light, or the border of the visible
/// space.
fn end_of(path: &RayPath, shown: &RaysShown) -> f64 {
    if path.hit.is_hit() {
        return path.hit.t;
    }
    let leaves = exit(&shown.space, &path.ray);
    if path.kind == RayKind::Shadow {
        path.ray.t_max.min(leaves)
    } else if path.steps.is_empty() {
        // The ray misses the tree. A short line shows its direction.
        leaves.min(shown.mark * 12.0)
    } else {
        path.end()
    }
}

/// Returns the ray parameter where a ray that starts inside a box leaves it.
fn exit(bounds: &Aabb, ray: &Ray) -> f64 {
    (0..3)
        .filter(|&k| ray.direction[k] != 0.0)
        .map(|k| {
            let side = if ray.direction[k] > 0.0 {
                bounds.hi[k]
            } else {
                bounds.lo[k]
            };
            (side - ray.origin[k]) / ray.direction[k]
        })
        .fold(f64::INFINITY, f64::min)
        .max(0.0)
}

/// Returns the intervals of a line of this length that are drawn.
fn strokes(length: f64, pattern: &[f64], unit: f64) -> Vec<[f64; 2]> {
    let period: f64 = pattern.iter().sum();
    if period <= 0.0 || length <= 0.0 {
        return vec![[0.0, length]];
    }
    let rounds = (length / (period * unit)).ceil().clamp(1.0, MOST_STROKES);
    let scale = length / (rounds * period);
    let mut drawn = Vec::new();
    for round in 0..rounds as u32 {
        let mut at = f64::from(round) * period;
        for pair in pattern.chunks(2) {
            drawn.push([at * scale, ((at + pair[0]) * scale).min(length)]);
            at += pair.iter().sum::<f64>();
        }
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_differ_in_color_and_in_strokes() {
        for (i, a) in RayKind::ALL.into_iter().enumerate() {
            for b in RayKind::ALL.into_iter().skip(i + 1) {
                assert_ne!(ray_style(a).color, ray_style(b).color);
                assert_ne!(ray_style(a).strokes, ray_style(b).strokes);
            }
        }
    }

    #[test]
    fn strokes_stay_on_the_line_in_order_and_few() {
        for kind in RayKind::ALL {
            for length in [1e-6, 1.0, 1e9] {
                let drawn = strokes(length, ray_style(kind).strokes, 0.03);
                assert!(!drawn.is_empty() && drawn.len() <= 2 * MOST_STROKES as usize);
                assert!(drawn.is_sorted_by(|a, b| a[1] <= b[0]));
                assert!(drawn.iter().all(|[a, b]| a <= b && *b <= length));
            }
        }
    }

    #[test]
    fn a_ray_leaves_a_box_where_it_meets_its_far_side() {
        let unit = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let ray = Ray::new(Vec3::splat(0.25), Vec3::new(-0.5, 0.0, 0.25));
        assert_eq!(exit(&unit, &ray), 0.5);
    }
}
