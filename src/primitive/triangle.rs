//! Triangles, with or without vertex normals.

use super::clip::bounds_of_outline;
use super::numeric::{self, Shear};
use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Ray, Vec3};

/// A triangle. `normals`, one unit vector per vertex, are for smooth shading.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    pub vertices: [Vec3; 3],
    pub normals: Option<Box<[Vec3; 3]>>,
}

impl Triangle {
    /// Creates a triangle. Normalizes vertex normals; a zero one becomes the triangle's own.
    ///
    /// # Errors
    /// A number that is not finite, or collinear vertices: the height over the longest edge is at most four
    /// units of relative precision of that edge. Coordinates of the edge's size then cannot distinguish the
    /// triangle from a line, and its normal is noise.
    pub fn new(vertices: [Vec3; 3], normals: Option<[Vec3; 3]>) -> Result<Self, ShapeError> {
        if vertices.iter().any(|v| !v.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        let triangle = Triangle {
            vertices,
            normals: None,
        };
        let (normal, flatness) = triangle.normal_and_flatness();
        if flatness.is_nan() || flatness <= 4.0 * f64::EPSILON {
            return Err(ShapeError::ZeroArea);
        }
        let normals = match normals {
            None => None,
            Some(given) => {
                let unit = numeric::unit_normals(&given, normal).ok_or(ShapeError::NotFinite)?;
                Some(Box::new([unit[0], unit[1], unit[2]]))
            }
        };
        Ok(Triangle { vertices, normals })
    }

    /// Returns the unit normal on the side where the vertices are counterclockwise.
    pub fn normal(&self) -> Vec3 {
        self.normal_and_flatness().0
    }

    /// Returns the unit normal, and the height over the longest edge in lengths of that edge.
    ///
    /// Multiplies the two shorter edges because in a product with the longest one, rounding would exceed the
    /// area of a needle. Scales them first because the squares of tiny ones would underflow.
    fn normal_and_flatness(&self) -> (Vec3, f64) {
        let [a, b, c] = self.vertices;
        let edges = [b - a, c - b, a - c];
        let scale = edges
            .iter()
            .fold(0.0_f64, |s, e| s.max(e.abs().max_element()));
        let [ab, bc, ca] = edges.map(|e| e / scale);
        let squares = [ab, bc, ca].map(Vec3::length_squared);
        let longest = squares[0].max(squares[1]).max(squares[2]);
        let cross = if squares[0] == longest {
            bc.cross(ca)
        } else if squares[1] == longest {
            ca.cross(ab)
        } else {
            ab.cross(bc)
        };
        (cross.normalize_or(Vec3::Z), cross.length() / longest)
    }

    /// Returns barycentric coordinates, not negative and of sum 1, of the projection of `point` along the
    /// normal, or of a point nearby if that is outside.
    fn weights(&self, point: Vec3, normal: Vec3) -> [f64; 3] {
        let [a, b, c] = self.vertices.map(|v| v - point);
        let areas = [b.cross(c), c.cross(a), a.cross(b)].map(|n| n.dot(normal).max(0.0));
        let sum = areas[0] + areas[1] + areas[2];
        if sum > 0.0 {
            areas.map(|area| area / sum)
        } else {
            [1.0 / 3.0; 3]
        }
    }
}

/// Returns where a ray hits a triangle within an interval. The vertices are relative to the ray's origin
/// and [rotated](Shear::rotate).
///
/// An edge function of 0 counts as inside, whatever its exact sign is. So at an edge, both triangles may
/// report the hit, but never neither. A triangle seen edge-on has no hit.
#[inline(always)]
pub(super) fn crossing(
    vertices: [Vec3; 3],
    shear: &Shear,
    [t_min, t_max]: [f64; 2],
) -> Option<f64> {
    let [a, b, c] = vertices.map(|v| shear.apply_rotated(v));
    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    if u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0 {
        return None;
    }
    let determinant = u + v + w;
    let t = (u * a.z + v * b.z + w * c.z) / determinant;
    let in_reach = t_min <= t && t <= t_max && t.is_finite();
    (in_reach && !is_edge_on(vertices, determinant, [a, b, c])).then_some(t)
}

/// [`crossing`] without an upper limit; NaN for a miss. Branchless, so that a loop over many triangles is
/// vectorized. The arithmetic is the same.
#[inline(always)]
pub(super) fn crossing_or_nan(vertices: [Vec3; 3], shear: &Shear, t_min: f64) -> f64 {
    let a = shear.apply_rotated(vertices[0]);
    let b = shear.apply_rotated(vertices[1]);
    let c = shear.apply_rotated(vertices[2]);
    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    let outside = (u.min(v).min(w) < 0.0) & (u.max(v).max(w) > 0.0);
    let determinant = u + v + w;
    let t = (u * a.z + v * b.z + w * c.z) / determinant;
    let in_reach = (t_min <= t) & t.is_finite();
    if !outside & in_reach & !is_edge_on(vertices, determinant, [a, b, c]) {
        t
    } else {
        f64::NAN
    }
}

/// Returns whether the determinant of the edge functions is within rounding of 0. Then their signs are
/// meaningless, and the ray is within rounding of the triangle's plane.
///
/// A sheared coordinate has an error of about 3 ε of the distance to the vertex, and the determinant has
/// that times the longest sheared edge, for each vertex.
#[inline(always)]
fn is_edge_on(vertices: [Vec3; 3], determinant: f64, [a, b, c]: [Vec3; 3]) -> bool {
    let distance = vertices
        .iter()
        .fold(0.0_f64, |m, v| m.max(v.abs().max_element()));
    let edge = [b - a, c - b, a - c]
        .iter()
        .fold(0.0_f64, |m, e| m.max(e.x.abs().max(e.y.abs())));
    determinant.abs() <= 16.0 * f64::EPSILON * distance * edge
}

impl Shape for Triangle {
    fn bytes(&self) -> usize {
        size_of::<Self>() + self.normals.as_deref().map_or(0, size_of_val)
    }

    fn bounds(&self) -> Aabb {
        numeric::grown(Aabb::around(self.vertices))
    }

    /// The thirteen separating axes of Akenine-Möller, "Fast 3D triangle–box overlap testing"
    /// (Journal of Graphics Tools 6(1), 2001).
    fn overlaps(&self, cell: &Aabb) -> bool {
        let vertices = &self.vertices;
        let [a, b, c] = *vertices;
        Aabb::around(*vertices).touches(cell)
            && !numeric::separates((b - a).cross(c - a), vertices, cell)
            && ![(a, b), (b, c), (c, a)]
                .into_iter()
                .any(|(from, to)| numeric::edge_separates(from, to, vertices, cell))
    }

    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        bounds_of_outline(&self.vertices, cell)
    }

    /// After Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2(1), 2013).
    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let Some(shear) = Shear::of(ray.direction) else {
            return numeric::with_direction_rescaled(ray, t_max, |r, t| self.intersect(r, t));
        };
        let vertices = self.vertices.map(|v| shear.rotate(v - ray.origin));
        crossing(vertices, &shear, [ray.t_min, t_max])
    }

    /// Returns the height over the longest edge.
    fn min_width(&self) -> f64 {
        let [a, b, c] = self.vertices;
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        self.normal_and_flatness().1 * longest
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let normal = self.normal();
        let weights = self.weights(ray.at(t), normal);
        let mean = |v: &[Vec3; 3]| weights[0] * v[0] + weights[1] * v[1] + weights[2] * v[2];
        let shading_normal = self
            .normals
            .as_deref()
            .map_or(normal, |normals| mean(normals).normalize_or(normal));
        let magnitude = self.vertices.iter().fold(Vec3::ZERO, |m, v| m.max(v.abs()));
        SurfacePoint {
            point: mean(&self.vertices),
            normal,
            shading_normal,
            // Three rounding errors for the weights, one for a product and two for the sums: γ₆ of Pharr,
            // Jakob and Humphreys, "Physically based rendering" (3.9).
            error: 3.5 * f64::EPSILON * magnitude.element_sum(),
        }
    }
}
