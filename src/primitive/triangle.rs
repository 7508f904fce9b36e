//! Triangles, with or without vertex normals.

use super::clip::{bounds_of_outline, certain};
use super::estimate::{self, Estimate};
use super::exact::{Known, Root, Surface};
use super::numeric;
use super::{Precision, Shape, ShapeError, SurfacePoint};
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

    /// Estimates where the ray's line crosses the triangle.
    #[inline(always)]
    pub(super) fn estimate(&self, ray: &Ray) -> Estimate {
        estimate::triangle_at(&self.vertices, ray)
    }

    /// [`Shape::intersect`] with what is known of where the ray's line crosses the triangle: an estimate, and
    /// the result of [`nearest_in_plane`](super::nearest_in_plane).
    #[inline(always)]
    pub(crate) fn settle(
        &self,
        estimate: Estimate,
        nearest: f64,
        ray: &Ray,
        t_max: f64,
    ) -> Option<f64> {
        let known = Estimate::first(&[estimate], [ray.t_min, ray.t_max], t_max)?;
        let t = if known == Known::Hit(0) && nearest.is_finite() {
            Some(nearest)
        } else {
            Surface::Triangle(&self.vertices).intersect(known, ray, Precision::F64)
        };
        t.filter(|&t| t <= t_max)
    }

    /// [`Shape::is_hit`] with an estimate of where the ray's line crosses the triangle.
    #[inline(always)]
    pub(crate) fn settle_any(&self, estimate: Estimate, ray: &Ray) -> bool {
        Surface::Triangle(&self.vertices).settle_any([estimate], ray)
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

    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        certain(&self.bounds(), cell, |cell| self.bounds_within(cell))
    }

    /// Returns twice the sum of the areas of the projections along the axes.
    fn least_box_area(&self) -> f64 {
        let [a, b, c] = self.vertices;
        (b - a).cross(c - a).abs().element_sum()
    }

    /// Edges are part of the triangle. A ray within its plane has no hit.
    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        Surface::Triangle(&self.vertices).settle([self.estimate(ray)], ray, t_max)
    }

    #[inline]
    fn is_hit(&self, ray: &Ray) -> bool {
        Surface::Triangle(&self.vertices).settle_any([self.estimate(ray)], ray)
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Triangle(&self.vertices).exact_distance(ray)
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
