//! Simple polygons, convex or not.

use super::clip::{bounds_of_outline, certain};
use super::estimate::{Estimate, U, UNDERFLOW};
use super::exact::{self, Root, Surface};
use super::numeric;
use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Axis, Ray, Vec3};
use std::num::NonZeroU32;

/// Maximum distance of vertices from their common plane, in lengths of the polygon. Files round to six
/// digits, which is a hundred times less.
const MAX_DEVIATION: f64 = 1e-4;

/// Distance of vertices from their common plane that rounding accounts for, in lengths of the largest
/// coordinate.
const FLATNESS: f64 = 8.0 * f64::EPSILON;

/// A planar simple polygon of 3 or more vertices.
///
/// Its surface is the part of the vertices' mean plane within the outline. The outline consists of the
/// vertices projected to that plane along the axis nearest to its normal. Where the outline intersects
/// itself, the even–odd rule determines the inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    vertices: Box<[Vec3]>,
    normals: Option<Box<[Vec3]>>,
    /// Unit normal of the plane on the side where the vertices are counterclockwise.
    normal: Vec3,
    /// A point of the plane: the mean of the vertices.
    anchor: Vec3,
    /// The axis of the normal's largest component, along which vertices are projected.
    axis: Axis,
    /// The projected vertices.
    outline: Box<[[f64; 2]]>,
    bounds: Aabb,
    /// The vertices projected to the plane; `None` if they lie in it up to rounding.
    in_plane: Option<Box<[Vec3]>>,
    /// The vertex `i` such that all vertices exactly lie in the plane of the vertices 0, `i` and `i` + 1, if
    /// that is known.
    support: Option<NonZeroU32>,
    /// The largest absolute coordinate: the scale of rounding errors.
    magnitude: f64,
    /// Bound on the distance of the vertices in the plane from the stored plane.
    deviation: f64,
}

impl Polygon {
    /// Creates a polygon. Normalizes vertex normals; a zero one becomes the polygon's own. Equal or collinear
    /// neighboring vertices are allowed.
    ///
    /// # Errors
    /// Too few vertices, a number that is not finite, no area, or vertices off a common plane.
    pub fn new(vertices: Vec<Vec3>, normals: Option<Vec<Vec3>>) -> Result<Self, ShapeError> {
        if vertices.len() < 3 {
            return Err(ShapeError::TooFewVertices(vertices.len()));
        }
        if let Some(n) = normals.as_ref().filter(|n| n.len() != vertices.len()) {
            return Err(ShapeError::NormalCount {
                vertices: vertices.len(),
                normals: n.len(),
            });
        }
        let box_of_vertices = Aabb::around(vertices.iter().copied());
        let size = box_of_vertices.size().max_element();
        if !size.is_finite() || vertices.iter().any(|v| !v.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        let normal = newell_normal(&vertices).ok_or(ShapeError::ZeroArea)?;

        let first = vertices[0];
        let count = vertices.len() as f64;
        let anchor = first + vertices.iter().map(|&v| (v - first) / count).sum::<Vec3>();
        let deviation = vertices
            .iter()
            .map(|&v| normal.dot(v - anchor).abs())
            .fold(0.0, f64::max);
        if deviation > MAX_DEVIATION * size {
            return Err(ShapeError::NotPlanar(deviation));
        }

        let magnitude = box_of_vertices.magnitude();
        let normals = match normals {
            None => None,
            Some(n) => Some(
                numeric::unit_normals(&n, normal)
                    .ok_or(ShapeError::NotFinite)?
                    .into(),
            ),
        };
        let axis = Axis::of_largest(normal.abs().to_array());
        let outline = vertices.iter().map(|&v| project(v, axis)).collect();
        let mut polygon = Polygon {
            vertices: vertices.into(),
            normals,
            normal,
            anchor,
            axis,
            outline,
            bounds: box_of_vertices,
            in_plane: None,
            support: None,
            magnitude,
            deviation: 0.0,
        };
        if deviation > FLATNESS * magnitude {
            polygon.in_plane = Some(polygon.projected());
        }
        polygon.support = support(polygon.vertices_in_plane());
        polygon.deviation = polygon.deviation();
        let in_plane = Aabb::around(polygon.vertices_in_plane().iter().copied());
        polygon.bounds = numeric::grown(box_of_vertices.union(&in_plane));
        Ok(polygon)
    }

    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    pub fn vertex_normals(&self) -> Option<&[Vec3]> {
        self.normals.as_deref()
    }

    /// Returns the unit normal on the side where the vertices are counterclockwise.
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Returns the axis along which vertices are projected to the plane: that of the normal's largest
    /// component.
    pub fn projection_axis(&self) -> Axis {
        self.axis
    }

    /// Triangulates the polygon: indices of vertices, in the orientation of the polygon.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        Self::triangulate(&self.vertices)
    }

    /// Triangulates a closed loop of vertices, planar or not. Returns no triangle if it has no area.
    ///
    /// Clips ears of the loop as seen along its normal. Vertices that do not affect the shape may be left
    /// out.
    pub fn triangulate(vertices: &[Vec3]) -> Vec<[u32; 3]> {
        let Some(normal) = newell_normal(vertices) else {
            return Vec::new();
        };
        let (u, v) = normal.any_orthonormal_pair();
        let first = vertices[0];
        let flat: Vec<[f64; 2]> = vertices
            .iter()
            .map(|&p| [(p - first).dot(u), (p - first).dot(v)])
            .collect();
        let mut indices: Vec<u32> = Vec::new();
        earcut::Earcut::new().earcut(flat.iter().copied(), &[], &mut indices);
        let triangles = indices.chunks_exact(3).map(|t| {
            let corners = [t[0], t[1], t[2]];
            let [a, b, c] = corners.map(|i| vertices[i as usize]);
            if (b - a).cross(c - a).dot(normal) < 0.0 {
                [t[0], t[2], t[1]]
            } else {
                corners
            }
        });
        triangles.collect()
    }

    /// Returns the vertices projected to the plane, or unchanged if they lie in it up to rounding:
    /// neighbors in a mesh then have vertices in common.
    pub fn vertices_in_plane(&self) -> &[Vec3] {
        self.in_plane.as_deref().unwrap_or(&self.vertices)
    }

    fn projected(&self) -> Box<[Vec3]> {
        let normal = numeric::rotated(self.normal, self.axis);
        let anchor = numeric::rotated(self.anchor, self.axis);
        let moved = self.vertices.iter().map(|&v| {
            let rotated = numeric::rotated(v, self.axis);
            let rise = normal.x * (rotated.x - anchor.x) + normal.y * (rotated.y - anchor.y);
            let mut moved = v;
            moved[self.axis.index()] = anchor.z - rise / normal.z;
            moved
        });
        moved.collect()
    }

    /// Returns [`Polygon::deviation`]: the largest computed distance, and 4 u of the sum of its absolute terms.
    fn deviation(&self) -> f64 {
        let steepness = self.normal.abs();
        let distances = self.vertices_in_plane().iter().map(|&v| {
            let offset = v - self.anchor;
            self.normal.dot(offset).abs() + 4.0 * U * steepness.dot(offset.abs())
        });
        distances.fold(0.0, f64::max)
    }

    /// Estimates where the ray's line crosses the polygon.
    ///
    /// Vertices are at most `deviation` away from the stored plane. The distance h to the plane and the speed
    /// towards it have errors of at most 4 u of the sums of their absolute terms. So the line meets the
    /// polygon where it passes the plane, up to the sum of `deviation` and of both errors, divided by the
    /// speed; with a third more for a polygon that is reached there.
    ///
    /// With L the sum of the absolute components of the direction, this moves the point along each axis by
    /// less than `slack`: 6 [`FLATNESS`] of all coordinates, divided by the sine of the angle.
    #[inline(always)]
    fn estimate(&self, ray: &Ray) -> Estimate {
        let speed = self.normal.dot(ray.direction);
        let length = ray.direction.abs().element_sum();
        if !numeric::is_workable(length) {
            return Estimate::UNSURE;
        }
        let to_plane = self.anchor - ray.origin;
        let t = self.normal.dot(to_plane) / speed;
        let point = ray.origin + t * ray.direction;
        let reach = to_plane.abs().element_sum() + t.abs() * length + self.magnitude;
        let slack = 6.0 * FLATNESS * reach * (length / speed).abs() + UNDERFLOW;
        if !slack.is_finite() {
            return self.estimate_parallel(ray);
        }
        if !self.bounds.enlarged(slack).contains(point) {
            return Estimate::MISS;
        }
        match is_inside(&self.outline, project(point, self.axis), slack) {
            Some(true) => {
                let steepness = self.normal.abs();
                let rounding = steepness.dot(to_plane.abs() + t.abs() * ray.direction.abs());
                let error = 2.0 * (self.deviation + 4.0 * U * rounding) / speed.abs();
                Estimate::new(t, error + 4.0 * U * t.abs() + UNDERFLOW)
            }
            Some(false) => Estimate::MISS,
            None => Estimate::UNSURE,
        }
    }

    /// [`Polygon::estimate`] of a ray that computes as parallel to the plane. The rounding of its speed towards
    /// the plane, 4 u, counts for the distance to the farthest vertex, which is at most three times the sum
    /// of absolute coordinates divided by L.
    #[cold]
    fn estimate_parallel(&self, ray: &Ray) -> Estimate {
        let steepness = self.normal.abs();
        let to_plane = self.anchor - ray.origin;
        let far = 3.0 * (to_plane.abs().element_sum() + 6.0 * self.magnitude);
        let turn = steepness.dot(ray.direction.abs()) / ray.direction.abs().element_sum();
        let rounding = 4.0 * U * (steepness.dot(to_plane.abs()) + 2.0 * far * turn) + UNDERFLOW;
        if self.normal.dot(to_plane).abs() > 2.0 * (self.deviation + rounding) {
            Estimate::MISS
        } else {
            Estimate::UNSURE
        }
    }

    /// Calls `f` with an estimate and the surface that decides what it leaves open. If the ray certainly hits
    /// and all vertices lie in a plane, this is a triangle in that plane.
    #[inline(always)]
    pub(super) fn with_surface<R>(
        &self,
        ray: &Ray,
        f: impl FnOnce(&Surface<'_>, Estimate) -> R,
    ) -> R {
        let outline = self.vertices_in_plane();
        let estimate = self.estimate(ray);
        match self.support {
            Some(support) if estimate.is_certain() => {
                let i = support.get() as usize;
                let vertices = [0, i, i + 1].map(|i| outline[i]);
                f(&Surface::Triangle(&vertices), estimate)
            }
            _ => f(&Surface::Outline(outline), estimate),
        }
    }

    /// Interpolates vertex normals at a point of the polygon by mean value coordinates (Hormann and Floater,
    /// "Mean value coordinates for arbitrary planar polygons", ACM Transactions on Graphics 25(4), 2006).
    /// Returns the plane's own normal where they cancel.
    fn interpolated(&self, normals: &[Vec3], point: Vec3) -> Vec3 {
        let mut sum = Vec3::ZERO;
        let mut previous = self.vertices.len() - 1;
        let mut a = self.vertices[previous] - point;
        for (i, &vertex) in self.vertices.iter().enumerate() {
            let b = vertex - point;
            let (ra, rb) = (a.length(), b.length());
            if rb == 0.0 {
                return normals[i];
            }
            // tan(φ/2) = sin φ / (1 + cos φ), where φ is the angle that the edge subtends at the point.
            let sine = a.cross(b).dot(self.normal);
            let one_plus_cosine = ra * rb + a.dot(b);
            if one_plus_cosine <= 4.0 * f64::EPSILON * ra * rb {
                // On the edge, the other vertices have no weight.
                return (rb * normals[previous] + ra * normals[i]).normalize_or(self.normal);
            }
            if ra > 0.0 {
                let tangent = sine / one_plus_cosine;
                sum += tangent * (normals[previous] / ra + normals[i] / rb);
            }
            (previous, a) = (i, b);
        }
        sum.normalize_or(self.normal)
    }
}

/// Returns the unit normal by Newell's method (Sutherland, Sproull and Schumacker, "A characterization of ten
/// hidden-surface algorithms", ACM Computing Surveys 6(1), 1974), here as the sum of the fan's
/// cross products; `None` if that is within rounding of zero.
fn newell_normal(vertices: &[Vec3]) -> Option<Vec3> {
    let first = *vertices.first()?;
    let scale = vertices
        .iter()
        .fold(0.0_f64, |s, &v| s.max((v - first).abs().max_element()));
    let (mut sum, mut rounding) = (Vec3::ZERO, 0.0);
    let mut a = Vec3::ZERO;
    for &vertex in vertices {
        let b = (vertex - first) / scale;
        sum += a.cross(b);
        rounding += a.length() * b.length();
        a = b;
    }
    let length = sum.length();
    (length > 4.0 * f64::EPSILON * rounding).then(|| sum / length)
}

/// Returns [`Polygon::support`] if it is easily shown.
fn support(vertices: &[Vec3]) -> Option<NonZeroU32> {
    let area = |i: usize| {
        let [a, b, c] = [0, i, i + 1].map(|i| vertices[i]);
        (b - a).cross(c - a).length_squared()
    };
    let widest = (1..vertices.len() - 1).max_by(|&i, &j| area(i).total_cmp(&area(j)))?;
    let triangle = [0, widest, widest + 1].map(|i| vertices[i]);
    let is_flat = vertices.iter().all(|&v| exact::is_in_plane(&triangle, v));
    NonZeroU32::new(widest as u32).filter(|_| is_flat)
}

/// Returns the two coordinates other than that along `axis`.
#[inline]
fn project(v: Vec3, axis: Axis) -> [f64; 2] {
    let rotated = numeric::rotated(v, axis);
    [rotated.x, rotated.y]
}

/// Returns whether a point lies in a closed outline: whether an odd number of edges cross the half-line to
/// its right (Haines, "Point in polygon strategies", Graphics Gems IV, 1994). `None` within `slack` of an
/// edge, or exactly on one for `slack` 0.
#[inline]
fn is_inside(outline: &[[f64; 2]], point: [f64; 2], slack: f64) -> Option<bool> {
    let [x, y] = point;
    let last = outline.last()?;
    let (mut ax, mut ay) = (last[0] - x, last[1] - y);
    let mut inside = false;
    for vertex in outline {
        let (bx, by) = (vertex[0] - x, vertex[1] - y);
        if ay.min(by) <= slack && ay.max(by) >= -slack {
            // Reversing the edge only changes the sign.
            let cross = ax * by - ay * bx;
            if cross.abs() <= slack * ((bx - ax).abs() + (by - ay).abs())
                && ax.min(bx) <= slack
                && ax.max(bx) >= -slack
            {
                return None;
            }
            if (ay > 0.0) != (by > 0.0) {
                // If the products underflow, the edge lies entirely on one side.
                let is_right = if cross == 0.0 {
                    ax > 0.0
                } else {
                    (cross > 0.0) == (by > ay)
                };
                inside ^= is_right;
            }
        }
        (ax, ay) = (bx, by);
    }
    Some(inside)
}

impl Shape for Polygon {
    fn bytes(&self) -> usize {
        size_of::<Self>()
            + size_of_val(&*self.vertices)
            + size_of_val(&*self.outline)
            + self.in_plane.as_deref().map_or(0, size_of_val)
            + self.normals.as_deref().map_or(0, size_of_val)
    }

    fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// After Green and Hatch, "Fast polygon–cube intersection testing" (Graphics Gems V, 1995): polygon and
    /// cell overlap if an edge overlaps the cell, or if the plane's cross-section of the cell lies within
    /// the outline. Then so does its point on the cell's diagonal.
    fn overlaps(&self, cell: &Aabb) -> bool {
        if !self.bounds.touches(cell) {
            return false;
        }
        let forward = self.normal.cmpge(Vec3::ZERO);
        let from = Vec3::select(forward, cell.lo, cell.hi);
        let to = Vec3::select(forward, cell.hi, cell.lo);
        let (below, above) = (
            self.normal.dot(self.anchor - from),
            self.normal.dot(to - self.anchor),
        );
        // Vertices are at most 2 `FLATNESS` from the plane.
        let slack = 3.0 * FLATNESS * (self.magnitude + cell.magnitude());
        if below < -slack || above < -slack {
            return false;
        }
        let mut previous = None;
        let mut meets_cell = |vertex: Vec3| {
            let Some(start) = previous.replace(vertex) else {
                return false;
            };
            let edge = [start, vertex];
            Aabb::around(edge).enlarged(slack).touches(cell)
                && !numeric::edge_separates(start, vertex, &edge, cell)
        };
        let vertices = self.vertices_in_plane();
        if vertices.iter().copied().any(&mut meets_cell)
            || vertices.first().copied().is_some_and(meets_cell)
        {
            return true;
        }
        let share = below / (below + above);
        let cut = if share > 0.0 {
            from + share.min(1.0) * (to - from)
        } else {
            // Also for a flat cell in the plane.
            from
        };
        is_inside(&self.outline, project(cut, self.axis), slack).unwrap_or(true)
    }

    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        bounds_of_outline(&self.vertices, cell)
    }

    /// Whether the polygon is convex or not, every point of it is in a triangle of the fan around the first
    /// vertex: the number of times that the outline turns around the point is the sum of those of the
    /// triangles. The vertices themselves count, too, as for the bounds. The exact plane is less than 64 ε of the largest coordinate from the vertices in it.
    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let outlines = [Some(&*self.vertices), self.in_plane.as_deref()];
        certain(&self.bounds, cell, |cell| {
            let fans = outlines.into_iter().flatten().flat_map(|vertices| {
                let edges = vertices[1..].windows(2);
                edges.map(|edge| [vertices[0], edge[0], edge[1]])
            });
            let parts = fans.filter_map(|triangle| bounds_of_outline(&triangle, cell));
            parts.reduce(|all, part| all.union(&part))
        })
    }

    /// Returns twice the sum of the areas of the projections along the axes.
    fn least_box_area(&self) -> f64 {
        let first = self.vertices[0];
        let fan = self.vertices[1..].windows(2);
        let crosses = fan.map(|edge| (edge[0] - first).cross(edge[1] - first));
        crosses.sum::<Vec3>().abs().element_sum()
    }

    /// The outline is part of the polygon. A ray within its plane has no hit.
    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        self.with_surface(ray, |surface, estimate| {
            surface.settle([estimate], ray, t_max)
        })
    }

    #[inline]
    fn is_hit(&self, ray: &Ray) -> bool {
        Surface::Outline(self.vertices_in_plane()).settle_any([self.estimate(ray)], ray)
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Outline(self.vertices_in_plane()).exact_distance(ray)
    }

    /// Returns the area divided by the longest edge of the bounds, which is at most the width.
    fn min_width(&self) -> f64 {
        let first = self.vertices[0];
        let size = self.bounds.size().max_element();
        let fan = self.vertices.windows(2).map(|edge| {
            let [a, b] = [edge[0], edge[1]].map(|v| (v - first) / size);
            a.cross(b)
        });
        0.5 * fan.sum::<Vec3>().length() * size
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let met = ray.at(t);
        let in_plane = met - self.normal.dot(met - self.anchor) * self.normal;
        let point = in_plane.clamp(self.bounds.lo, self.bounds.hi);
        let shading_normal = match &self.normals {
            Some(normals) => self.interpolated(normals, point),
            None => self.normal,
        };
        SurfacePoint {
            point,
            normal: self.normal,
            shading_normal,
            error: 16.0 * f64::EPSILON * self.magnitude,
        }
    }
}
