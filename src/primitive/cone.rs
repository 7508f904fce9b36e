//! Cylinders and truncated cones: the open lateral surface between two circles.

use super::{Polygon, Shape, ShapeError, SurfacePoint, gjk, numeric};
use crate::geometry::{Aabb, Ray, Vec3};

/// An open cylinder or truncated cone, without end caps. It is a cylinder if both radii are equal. One
/// radius may be 0, which makes that end a tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    base: Vec3,
    base_radius: f64,
    apex: Vec3,
    apex_radius: f64,
    side: Side,
}

/// The lateral surface in the form used for intersection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    /// From base to apex, of unit length.
    pub(super) axis: Vec3,
    /// The middle of the axis, where the height is 0.
    pub(super) middle: Vec3,
    pub(super) half_length: f64,
    /// The radius at the middle, and its growth per height.
    pub(super) middle_radius: f64,
    pub(super) slope: f64,
    /// Square of the largest distance from the middle, including rounding.
    pub(super) squared_reach: f64,
}

impl Cone {
    /// Creates a cylinder or cone.
    ///
    /// # Errors
    /// A number that is not finite, a negative radius, two radii of 0, or an axis that is no longer than the
    /// rounding of its ends.
    pub fn new(
        base: Vec3,
        base_radius: f64,
        apex: Vec3,
        apex_radius: f64,
    ) -> Result<Self, ShapeError> {
        let along = apex - base;
        let length = along.length();
        let finite = base.is_finite() && apex.is_finite() && length.is_finite();
        if !finite || !base_radius.is_finite() || !apex_radius.is_finite() {
            return Err(ShapeError::NotFinite);
        }
        if let Some(negative) = [base_radius, apex_radius].into_iter().find(|r| *r < 0.0) {
            return Err(ShapeError::NegativeRadius(negative));
        }
        let radius = base_radius.max(apex_radius);
        if radius == 0.0 {
            return Err(ShapeError::ZeroArea);
        }
        let magnitude = base.abs().max(apex.abs()).max_element();
        if length <= 4.0 * f64::EPSILON * magnitude {
            return Err(ShapeError::NoLength);
        }
        let half_length = 0.5 * length;
        Ok(Cone {
            base,
            base_radius,
            apex,
            apex_radius,
            side: Side {
                axis: along / length,
                middle: base + 0.5 * along,
                half_length,
                middle_radius: 0.5 * base_radius + 0.5 * apex_radius,
                slope: (apex_radius - base_radius) / length,
                squared_reach: (half_length * half_length + radius * radius) * (1.0 + 1e-12),
            },
        })
    }

    /// Returns the center of the circle at the base.
    pub fn base(&self) -> Vec3 {
        self.base
    }

    pub fn base_radius(&self) -> f64 {
        self.base_radius
    }

    /// Returns the center of the circle at the apex, the end of the axis.
    pub fn apex(&self) -> Vec3 {
        self.apex
    }

    pub fn apex_radius(&self) -> f64 {
        self.apex_radius
    }

    /// Returns the length of the axis.
    pub fn length(&self) -> f64 {
        2.0 * self.side.half_length
    }

    pub(super) fn side(&self) -> &Side {
        &self.side
    }

    /// Returns whether both radii are equal.
    pub fn is_cylinder(&self) -> bool {
        self.base_radius == self.apex_radius
    }

    /// Returns the open regular inscribed prism, or frustum, of `sides` (at least 3) planar polygons:
    /// quadrilaterals base i, base i+1, apex i+1, apex i, or triangles if a radius is 0.
    ///
    /// Vertices are numbered by the right-hand rule about the axis, starting at the direction axis × x, or
    /// axis × y where that is 0. The result is the same on every platform. Leaves out a side that is too
    /// narrow for its coordinates.
    pub fn prism(&self, sides: u32) -> Vec<Polygon> {
        let axis = self.side.axis;
        let u = axis
            .cross(Vec3::X)
            .try_normalize()
            .unwrap_or_else(|| axis.cross(Vec3::Y).normalize());
        let v = axis.cross(u);
        let vertex = |center: Vec3, radius: f64, i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i % sides) / f64::from(sides);
            center + radius * (libm::cos(angle) * u + libm::sin(angle) * v)
        };
        let side = |i: u32| {
            let mut corners = Vec::with_capacity(4);
            if self.base_radius > 0.0 {
                corners.push(vertex(self.base, self.base_radius, i));
                corners.push(vertex(self.base, self.base_radius, i + 1));
            } else {
                corners.push(self.base);
            }
            if self.apex_radius > 0.0 {
                corners.push(vertex(self.apex, self.apex_radius, i + 1));
                corners.push(vertex(self.apex, self.apex_radius, i));
            } else {
                corners.push(self.apex);
            }
            Polygon::new(corners, None).ok()
        };
        (0..sides).filter_map(side).collect()
    }

    /// Returns the farthest point of the solid in a direction, which is on the rim of one end. `u` and `v` span
    /// the plane perpendicular to the axis, so that the result is on the rim even if the direction's component
    /// in that plane is only rounding.
    fn support(&self, direction: Vec3, (u, v): (Vec3, Vec3)) -> Vec3 {
        let (x, y) = (direction.dot(u), direction.dot(v));
        let length = (x * x + y * y).sqrt();
        let outward = if length > 0.0 {
            (x / length) * u + (y / length) * v
        } else {
            u
        };
        let on_base = self.base + self.base_radius * outward;
        let on_apex = self.apex + self.apex_radius * outward;
        if (on_apex - on_base).dot(direction) > 0.0 {
            on_apex
        } else {
            on_base
        }
    }
}

impl Side {
    /// Solves the quadratic equation of the infinite cone or cylinder, and keeps roots at heights of the
    /// surface. There the radius is not negative, so roots on the cone's other half are excluded.
    ///
    /// Distances are relative to the point of the ray nearest to the middle, and the roots are no
    /// differences of nearly equal numbers, for the reasons that Haines, Günther and Akenine-Möller give
    /// for spheres (Ray Tracing Gems, 2019, ch. 7). A line within the surface has no hit.
    #[inline]
    pub(super) fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let direction = ray.direction;
        let squared_length = direction.length_squared();
        if !numeric::is_workable(squared_length) {
            return numeric::with_direction_rescaled(ray, t_max, |r, t| self.intersect(r, t));
        }
        let from_middle = ray.origin - self.middle;
        let t_nearest = -from_middle.dot(direction) / squared_length;
        let nearest = from_middle + t_nearest * direction;
        if nearest.length_squared() > self.squared_reach {
            return None;
        }
        let (height, rise) = (nearest.dot(self.axis), direction.dot(self.axis));
        let (radius, growth) = (self.middle_radius + self.slope * height, self.slope * rise);
        let across = nearest - height * self.axis;
        let drift = direction - rise * self.axis;

        let a = drift.length_squared() - growth * growth;
        let b = across.dot(drift) - radius * growth;
        let c = across.length_squared() - radius * radius;
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        // If the ray is parallel to the side, a is 0. The first root is infinite or NaN and fails the
        // comparisons; the second is that of the linear equation.
        let q = -(b + discriminant.sqrt().copysign(b));
        let (s0, s1) = (q / a, c / q);
        let (near, far) = if s0 < s1 { (s0, s1) } else { (s1, s0) };
        let hit = |s: f64| {
            let t = t_nearest + s;
            let on_surface = (height + s * rise).abs() <= self.half_length;
            (on_surface && ray.t_min <= t && t <= t_max && t.is_finite()).then_some(t)
        };
        hit(near).or_else(|| hit(far))
    }
}

impl Shape for Cone {
    /// Returns the tight box of the two discs. A disc of radius r and unit normal n extends r √(1 − nᵢ²) along
    /// axis i, computed from the other two components of n to avoid cancellation.
    fn bounds(&self) -> Aabb {
        let n = self.side.axis;
        let squares = n * n;
        let extent = Vec3::new(
            (squares.y + squares.z).sqrt(),
            (squares.z + squares.x).sqrt(),
            (squares.x + squares.y).sqrt(),
        );
        let disc = |center: Vec3, radius: f64| {
            Aabb::new(center - radius * extent, center + radius * extent)
        };
        let base = disc(self.base, self.base_radius);
        numeric::grown(base.union(&disc(self.apex, self.apex_radius)))
    }

    /// Tests the solid between the two discs.
    fn overlaps(&self, cell: &Aabb) -> bool {
        let bounds = self.bounds();
        let across = self.side.axis.any_orthonormal_pair();
        let difference = |direction: Vec3| {
            let nearest = Vec3::select(direction.cmpgt(Vec3::ZERO), cell.lo, cell.hi);
            self.support(direction, across) - nearest
        };
        let scale = bounds.magnitude().max(cell.magnitude());
        bounds.touches(cell) && !gjk::excludes_origin(difference, scale)
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        self.side.intersect(ray, t_max)
    }

    /// Returns the smaller of the larger diameter and the length of the side.
    fn min_width(&self) -> f64 {
        let slant = self.length().hypot(self.apex_radius - self.base_radius);
        slant.min(2.0 * self.base_radius.max(self.apex_radius))
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let side = &self.side;
        let hit = ray.at(t) - side.middle;
        let height = hit.dot(side.axis);
        let across = hit - height * side.axis;
        let distance = across.length();
        let outward = across
            .try_normalize()
            .unwrap_or_else(|| side.axis.any_orthonormal_vector());

        // In the half-plane through the axis and the point, the surface is a segment.
        let slant = (1.0 + side.slope * side.slope).sqrt();
        let (along_radius, along_axis) = (side.slope / slant, 1.0 / slant);
        let along = (distance - side.middle_radius) * along_radius + height * along_axis;
        let half = side.half_length * slant;
        let along = along.clamp(-half, half);
        let radius = (side.middle_radius + along * along_radius).max(0.0);
        let bounds = self.bounds();
        let point = side.middle + along * along_axis * side.axis + radius * outward;
        let normal = (along_axis * outward - along_radius * side.axis).normalize();
        SurfacePoint {
            point: point.clamp(bounds.lo, bounds.hi),
            normal,
            shading_normal: normal,
            error: 16.0 * f64::EPSILON * bounds.magnitude().max(side.half_length),
        }
    }
}
