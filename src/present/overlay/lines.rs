//! Lines in a scene: edges of boxes, and the view frustum of a camera.

use crate::geometry::{Aabb, Vec3};
use crate::scene::Camera;

/// A line to draw, relative to a center.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Line {
    pub a: [f32; 3],
    pub b: [f32; 3],
    /// sRGB and line style: 255 for a solid line, 0 for a dashed one.
    pub color: [u8; 4],
    /// Width in points of the screen.
    pub width: f32,
}

impl Line {
    pub(super) fn new(a: Vec3, b: Vec3, center: Vec3, color: [u8; 4], width: f32) -> Self {
        Line {
            a: (a - center).as_vec3().to_array(),
            b: (b - center).as_vec3().to_array(),
            color,
            width,
        }
    }
}

/// Pairs of corner indices ([`Aabb::corners`]) that edges connect.
pub const BOX_EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// Returns the edges of a box.
pub fn box_lines(bounds: &Aabb, center: Vec3, color: [u8; 4], width: f32) -> Vec<Line> {
    let corners = bounds.corners();
    BOX_EDGES
        .iter()
        .map(|&[a, b]| Line::new(corners[a], corners[b], center, color, width))
        .collect()
}

/// Returns the color of leaf `i` of `n` along a ray, from light pink to purple. No coloring of
/// leaves uses these colors.
pub fn order_color(i: usize, n: usize) -> [u8; 3] {
    let place = i as f64 / (n.max(2) - 1) as f64;
    let color = colorous::RED_PURPLE.eval_continuous(0.2 + 0.55 * place);
    [color.r, color.g, color.b]
}

/// Returns the view frustum of a camera, `length` deep; no lines for a camera without a view.
pub fn frustum_lines(camera: &Camera, aspect: f64, length: f64, center: Vec3) -> Vec<Line> {
    let Ok([forward, right, up]) = camera.frame() else {
        return Vec::new();
    };
    let half = libm::tan(camera.angle.to_radians() * 0.5);
    let corner = |x: f64, y: f64| {
        camera.from + length * (forward + x * half * aspect * right + y * half * up)
    };
    let corners = [
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
    ];
    let color = [255, 255, 255, 255];
    let mut lines = Vec::new();
    for (i, &c) in corners.iter().enumerate() {
        lines.push(Line::new(camera.from, c, center, color, 1.5));
        lines.push(Line::new(c, corners[(i + 1) % 4], center, color, 1.5));
    }
    // A tick marks the upper side.
    let top = (corners[2] + corners[3]) * 0.5;
    let tick = top + length * 0.2 * half * up;
    lines.push(Line::new(corners[2], tick, center, color, 1.5));
    lines.push(Line::new(corners[3], tick, center, color, 1.5));
    lines
}
