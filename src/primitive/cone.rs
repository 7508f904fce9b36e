//! Cylinders and truncated cones: the open lateral surface between two circles.

use super::clip::certain;
use super::estimate::{Estimate, U, UNDERFLOW};
use super::exact::{ConeEnds, Root, Surface};
use super::{Polygon, Shape, ShapeError, SurfacePoint, gjk, numeric};
use crate::geometry::{Aabb, Ray, Vec3};

/// An open cylinder or truncated cone, without end caps. It is a cylinder if both radii are equal. One
/// radius may be 0, which makes that end a tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    ends: ConeEnds,
    side: Side,
}

/// The lateral surface in the form used for intersection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    /// From base to apex, of unit length.
    axis: Vec3,
    half_length: f64,
    /// The radius at the middle, where the height is 0, and its growth per height.
    middle_radius: f64,
    slope: f64,
    /// The largest distance from the middle.
    reach: f64,
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
        let ends = ConeEnds {
            base,
            base_radius,
            apex,
            apex_radius,
        };
        Ok(Cone {
            ends,
            side: Side::of(&ends),
        })
    }

    /// Returns the center of the circle at the base.
    pub fn base(&self) -> Vec3 {
        self.ends.base
    }

    pub fn base_radius(&self) -> f64 {
        self.ends.base_radius
    }

    /// Returns the center of the circle at the apex, the end of the axis.
    pub fn apex(&self) -> Vec3 {
        self.ends.apex
    }

    pub fn apex_radius(&self) -> f64 {
        self.ends.apex_radius
    }

    /// Returns the length of the axis.
    pub fn length(&self) -> f64 {
        2.0 * self.side.half_length
    }

    /// Estimates where the ray's line crosses the surface, in ascending order.
    #[inline(always)]
    pub(super) fn estimates(&self, ray: &Ray) -> [Estimate; 2] {
        self.side.estimates(self.ends.base, ray)
    }

    pub(crate) fn ends(&self) -> &ConeEnds {
        &self.ends
    }

    /// Returns whether both radii are equal.
    pub fn is_cylinder(&self) -> bool {
        self.ends.base_radius == self.ends.apex_radius
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
            if self.ends.base_radius > 0.0 {
                corners.push(vertex(self.ends.base, self.ends.base_radius, i));
                corners.push(vertex(self.ends.base, self.ends.base_radius, i + 1));
            } else {
                corners.push(self.ends.base);
            }
            if self.ends.apex_radius > 0.0 {
                corners.push(vertex(self.ends.apex, self.ends.apex_radius, i + 1));
                corners.push(vertex(self.ends.apex, self.ends.apex_radius, i));
            } else {
                corners.push(self.ends.apex);
            }
            Polygon::new(corners, None).ok()
        };
        (0..sides).filter_map(side).collect()
    }

    /// Returns how far a disc of radius 1 perpendicular to the axis extends along each coordinate axis.
    fn disc_extent(&self) -> Vec3 {
        let n = self.side.axis;
        let squares = n * n;
        let extent = Vec3::new(
            (squares.y + squares.z).sqrt(),
            (squares.z + squares.x).sqrt(),
            (squares.x + squares.y).sqrt(),
        );
        // Its error is at most 9 u; it has none if the axis is parallel to a coordinate axis.
        let is_exact = extent == extent.round();
        if is_exact {
            extent
        } else {
            extent * (1.0 + 10.0 * U)
        }
    }

    /// Returns the bounds of the solid between the first and the last disc that reach into all slabs of a cell,
    /// if any does, up to rounding.
    fn bounds_of_discs_within(&self, cell: &Aabb) -> Option<Aabb> {
        let ends = &self.ends;
        let extent = self.disc_extent();
        let disc = |share: f64| {
            let center = ends.base + share * (ends.apex - ends.base);
            let reach = (ends.base_radius + share * (ends.apex_radius - ends.base_radius)) * extent;
            Aabb::new(center - reach, center + reach)
        };
        let (base, apex) = (disc(0.0), disc(1.0));
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for k in 0..3 {
            // How far discs reach beyond the near side of the slab: linear along the axis.
            for (at_base, at_apex) in [
                (base.hi[k] - cell.lo[k], apex.hi[k] - cell.lo[k]),
                (cell.hi[k] - base.lo[k], cell.hi[k] - apex.lo[k]),
            ] {
                let share = at_base / (at_base - at_apex);
                match (at_base < 0.0, at_apex < 0.0) {
                    (false, false) => (),
                    (true, true) => return None,
                    (true, false) => first = first.max(share),
                    (false, true) => last = last.min(share),
                }
            }
        }
        (first <= last).then(|| disc(first).union(&disc(last)))
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
        let on_base = self.ends.base + self.ends.base_radius * outward;
        let on_apex = self.ends.apex + self.ends.apex_radius * outward;
        if (on_apex - on_base).dot(direction) > 0.0 {
            on_apex
        } else {
            on_base
        }
    }
}

impl Side {
    /// Converts a cone to the form used for estimates.
    #[inline(always)]
    pub(super) fn of(ends: &ConeEnds) -> Self {
        let along = ends.apex - ends.base;
        let length = along.length();
        let half_length = 0.5 * length;
        let radius = ends.base_radius.max(ends.apex_radius);
        Side {
            axis: along / length,
            half_length,
            middle_radius: 0.5 * ends.base_radius + 0.5 * ends.apex_radius,
            slope: (ends.apex_radius - ends.base_radius) / length,
            reach: (half_length * half_length + radius * radius).sqrt(),
        }
    }

    /// Returns where a ray's line crosses the surface between its ends, in ascending order: the roots of the
    /// quadratic equation of the infinite cone or cylinder at heights of the surface. There the radius is not
    /// negative, so roots on the cone's other half are excluded.
    ///
    /// Distances are relative to the point of the ray nearest to the middle, and the roots are no differences
    /// of nearly equal numbers, for the reasons that Haines, Günther and Akenine-Möller give for spheres (Ray
    /// Tracing Gems, 2019, ch. 7). Where `f` is the sum of the absolute coordinates of the origin relative to
    /// the middle, d the length of the direction and k = (1 + |slope|)²:
    ///
    /// - The origin relative to the middle has an error of 2 u f and 6 u `reach`; a component of the axis has 6
    ///   u, the slope 5 u of itself, a radius 2 u.
    /// - The nearest point is that at the computed distance, so its error is only that of this sum. Its height
    ///   then has an error of at most `eh` = 4 u f + 24 u `reach`, its offset from the axis one of `ex` = 8 u f +
    ///   48 u `reach`, and the radius there one of `er` = |slope| `eh` and 8 u of its terms. The rise of the ray
    ///   along the axis has one of 9 u d, its drift across 18 u d, the growth of the radius 16 u d of the slope.
    /// - In the coefficients of the equation, a s² + 2 b s + c, these amount to at most `ea` = 40 u k d²,
    ///   and to `eb` and `ec`, the errors of products of these terms.
    /// - The errors of the discriminant and of the roots follow from those of the coefficients.
    #[inline(always)]
    pub(super) fn estimates(&self, base: Vec3, ray: &Ray) -> [Estimate; 2] {
        let direction = ray.direction;
        let squared_length = direction.length_squared();
        if !numeric::is_workable(squared_length) {
            return [Estimate::UNSURE; 2];
        }
        let from_middle = (ray.origin - base) - self.half_length * self.axis;
        let t_nearest = -from_middle.dot(direction) / squared_length;
        let nearest = from_middle + t_nearest * direction;
        let f = from_middle.abs().element_sum();
        let eh = 4.0 * U * f + 24.0 * U * self.reach + UNDERFLOW;
        let ex = 2.0 * eh;
        let reach = self.reach + ex;
        if nearest.length_squared() > reach * reach * (1.0 + 8.0 * U) {
            return [Estimate::MISS; 2];
        }
        let (height, rise) = (nearest.dot(self.axis), direction.dot(self.axis));
        let (radius, growth) = (self.middle_radius + self.slope * height, self.slope * rise);
        let across = nearest - height * self.axis;
        let drift = direction - rise * self.axis;

        let a = drift.length_squared() - growth * growth;
        let b = across.dot(drift) - radius * growth;
        let c = across.length_squared() - radius * radius;
        let discriminant = b * b - a * c;

        let steep = self.slope.abs();
        let k = (1.0 + steep) * (1.0 + steep);
        let speed = direction.abs().element_sum();
        let (x, r) = (across.abs().element_sum(), radius.abs());
        let er = steep * eh + 8.0 * U * (self.middle_radius + steep * height.abs());
        let ea = 40.0 * U * k * squared_length;
        let eb = speed * (24.0 * U * x + 1.1 * ex + steep * (24.0 * U * r + 1.1 * er));
        let ec = (2.0 * x + ex) * ex + (2.0 * r + er) * er + 4.0 * U * (x * x + r * r);
        let spread = 4.0 * U * (b * b + (a * c).abs())
            + (2.0 * b.abs() + eb) * eb
            + (a.abs() + ea) * ec
            + ea * c.abs();
        if discriminant < -spread {
            return [Estimate::MISS; 2];
        }
        if !(discriminant > 2.0 * spread && a.abs() > 2.0 * ea) {
            return [Estimate::UNSURE; 2];
        }
        let root = discriminant.sqrt();
        let q = -(b + root.copysign(b));
        let eq = eb + spread / root + 4.0 * U * q.abs();
        let is_far_from_zero = q.abs() > 2.0 * eq;
        if !is_far_from_zero {
            return [Estimate::UNSURE; 2];
        }
        let (s0, s1) = (q / a, c / q);
        let error0 = 2.0 * (eq + s0.abs() * ea) / a.abs();
        let error1 = 2.0 * (ec + s1.abs() * eq) / q.abs();
        let roots = if s0 < s1 {
            [(s0, error0), (s1, error1)]
        } else {
            [(s1, error1), (s0, error0)]
        };
        roots.map(|(s, error)| {
            let above = (height + s * rise).abs() - self.half_length;
            let slack = eh + rise.abs() * error + 32.0 * U * s.abs() * speed;
            let t = t_nearest + s;
            if above > slack {
                Estimate::MISS
            } else if above < -slack {
                Estimate::new(t, error + 8.0 * U * (s.abs() + t_nearest.abs()))
            } else {
                Estimate::UNSURE
            }
        })
    }
}

impl Shape for Cone {
    /// Returns the tight box of the two discs. A disc of radius r and unit normal n extends r √(1 − nᵢ²) along
    /// axis i, computed from the other two components of n to avoid cancellation.
    fn bounds(&self) -> Aabb {
        let extent = self.disc_extent();
        let disc = |center: Vec3, radius: f64| {
            Aabb::new(center - radius * extent, center + radius * extent)
        };
        let base = disc(self.ends.base, self.ends.base_radius);
        numeric::grown(base.union(&disc(self.ends.apex, self.ends.apex_radius)))
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

    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        certain(&self.bounds(), cell, |cell| {
            self.bounds_of_discs_within(cell)
        })
    }

    /// Returns twice the sum of the areas of the silhouettes along the axes, which may be a little too large.
    fn least_box_area(&self) -> f64 {
        let radius = self.ends.base_radius.max(self.ends.apex_radius);
        let side = (self.ends.base_radius + self.ends.apex_radius) * self.length();
        let disc = std::f64::consts::PI * radius * radius;
        let n = self.side.axis;
        let across = (Vec3::ONE - n * n).max(Vec3::ZERO).map(f64::sqrt);
        2.0 * (across * side + n.abs() * disc).element_sum()
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        Surface::Cone(self.ends).settle(self.estimates(ray), ray, t_max)
    }

    fn is_hit(&self, ray: &Ray) -> bool {
        Surface::Cone(self.ends).settle_any(self.estimates(ray), ray)
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Cone(self.ends).exact_distance(ray)
    }

    /// Returns the smaller of the larger diameter and the length of the side.
    fn min_width(&self) -> f64 {
        let slant = self
            .length()
            .hypot(self.ends.apex_radius - self.ends.base_radius);
        slant.min(2.0 * self.ends.base_radius.max(self.ends.apex_radius))
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let side = &self.side;
        let middle = self.ends.base + 0.5 * (self.ends.apex - self.ends.base);
        let hit = ray.at(t) - middle;
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
        let point = middle + along * along_axis * side.axis + radius * outward;
        let normal = (along_axis * outward - along_radius * side.axis).normalize();
        SurfacePoint {
            point: point.clamp(bounds.lo, bounds.hi),
            normal,
            shading_normal: normal,
            error: 16.0 * f64::EPSILON * bounds.magnitude().max(side.half_length),
        }
    }
}
