//! Tests whether two convex bodies are disjoint, given their farthest points in a direction.
//!
//! After Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex
//! objects in three-dimensional space" (IEEE Journal of Robotics and Automation 4(2), 1988).

use crate::geometry::Vec3;

/// More than smooth bodies need. Bodies that barely touch may reach it.
const MAX_ITERATIONS: usize = 64;

/// Returns whether the origin certainly lies outside the convex body whose farthest point in a direction is
/// `support`. The difference of two bodies is such a body, and contains the origin if they share a point.
/// `scale` bounds the coordinates that `support` was computed from.
///
/// Returns `true` only if a separating plane exists by more than rounding, and `false` in all doubtful
/// cases.
pub(super) fn excludes_origin(support: impl Fn(Vec3) -> Vec3, scale: f64) -> bool {
    let mut nearest = support(Vec3::X);
    let mut simplex = Simplex::default();
    simplex.push(nearest);
    for _ in 0..MAX_ITERATIONS {
        let distance = nearest.length();
        if distance <= 1e-12 * scale {
            return false;
        }
        let candidate = support(-nearest);
        if candidate.dot(nearest) > 16.0 * f64::EPSILON * scale * distance {
            return true;
        }
        simplex.push(candidate);
        let Some(next) = simplex.reduce_to_nearest() else {
            return false;
        };
        // Not nearer than before: the rest of the distance is rounding.
        if next.length_squared() >= nearest.length_squared() {
            return false;
        }
        nearest = next;
    }
    false
}

/// Up to four points of the body.
#[derive(Clone, Copy, Default)]
struct Simplex {
    points: [Vec3; 4],
    len: usize,
}

/// A point of a simplex, and the smallest part of the simplex that contains it.
type Candidate = (Vec3, Simplex);

impl Simplex {
    fn of(points: &[Vec3]) -> Self {
        let mut simplex = Simplex::default();
        points.iter().for_each(|&p| simplex.push(p));
        simplex
    }

    fn push(&mut self, point: Vec3) {
        self.points[self.len] = point;
        self.len += 1;
    }

    /// Returns the point nearest to the origin and removes the vertices that it does not depend on; `None` if
    /// the origin lies inside.
    fn reduce_to_nearest(&mut self) -> Option<Vec3> {
        let [a, b, c, d] = self.points;
        let (point, part) = match self.len {
            1 => (a, *self),
            2 => nearest_on_segment(a, b),
            3 => nearest_on_triangle(a, b, c),
            _ => [(a, b, c, d), (a, b, d, c), (a, c, d, b), (b, c, d, a)]
                .into_iter()
                .filter(|&(p, q, r, opposite)| {
                    // Keeps the faces that do not certainly have the origin on their inner side. A flat
                    // tetrahedron has only such faces.
                    let normal = (q - p).cross(r - p);
                    normal.dot(-p) * normal.dot(opposite - p) <= 0.0
                })
                .map(|(p, q, r, _)| nearest_on_triangle(p, q, r))
                .reduce(nearer)?,
        };
        *self = part;
        Some(point)
    }
}

fn nearer(a: Candidate, b: Candidate) -> Candidate {
    if b.0.length_squared() < a.0.length_squared() {
        b
    } else {
        a
    }
}

fn nearest_on_segment(a: Vec3, b: Vec3) -> Candidate {
    let along = b - a;
    let s = -a.dot(along) / along.length_squared();
    if s >= 1.0 {
        (b, Simplex::of(&[b]))
    } else if s > 0.0 {
        (a + s * along, Simplex::of(&[a, b]))
    } else {
        // Also for two equal points, where s is NaN.
        (a, Simplex::of(&[a]))
    }
}

fn nearest_on_triangle(a: Vec3, b: Vec3, c: Vec3) -> Candidate {
    let normal = (b - a).cross(c - a);
    let weights = [b.cross(c), c.cross(a), a.cross(b)].map(|n| n.dot(normal));
    if weights.iter().all(|&w| w > 0.0) {
        let foot = normal * (a.dot(normal) / normal.length_squared());
        (foot, Simplex::of(&[a, b, c]))
    } else {
        let sides = nearer(nearest_on_segment(a, b), nearest_on_segment(b, c));
        nearer(sides, nearest_on_segment(c, a))
    }
}
