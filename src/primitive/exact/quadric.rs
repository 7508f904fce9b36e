//! Spheres, cylinders and cones: roots of quadratic equations.

use super::distance::{Crossings, Distance};
use super::number::{Number, Unsure};
use super::vector::{Vector, minor};
use crate::geometry::{Ray, Vec3};
use std::cmp::Ordering;

#[inline(always)]
fn square<N: Number>(x: &N) -> N {
    x.clone() * x.clone()
}

/// Returns where a line crosses a sphere, in ascending order. At a tangent both roots are equal.
#[inline(always)]
pub(super) fn sphere<N: Number>(
    center: Vec3,
    radius: f64,
    ray: &Ray,
) -> Result<Crossings<N>, Unsure> {
    let to_center = Vector::<N>::difference(center, ray.origin);
    let direction = Vector::from(ray.direction);
    let b = to_center.dot(&direction);
    let c = to_center.dot(&to_center) - square(&N::of(radius));
    Distance::roots(direction.dot(&direction), b, c)
}

/// The ends of a cylinder or cone and their radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ConeEnds {
    pub(crate) base: Vec3,
    pub(crate) base_radius: f64,
    pub(crate) apex: Vec3,
    pub(crate) apex_radius: f64,
}

/// A point of a line relative to a cone: its height and how much the line rises there.
pub(super) struct Height<N> {
    height: N,
    rise: N,
    squared_axis: N,
}

impl<N: Number> Height<N> {
    /// Returns whether a point of the line is between the ends.
    #[inline(always)]
    pub(super) fn is_within(&self, t: &Distance<N>) -> Result<bool, Unsure> {
        let below_apex = self.height.clone() - self.squared_axis.clone();
        Ok(
            t.sign_at(self.height.clone(), self.rise.clone())? != Ordering::Less
                && t.sign_at(below_apex, self.rise.clone())? != Ordering::Greater,
        )
    }
}

/// Returns where a line crosses the infinite cylinder or cone, in ascending order, and how to find whether
/// that is between the ends. A line within the surface does not cross it.
///
/// The axis `w` from base to apex is not normalized, which keeps every coefficient rational. For a point
/// `p` relative to the base, the scaled height is `h = p·w`, from 0 to `w·w`. Its distance from the axis
/// is `|w × p| / |w|`. The surface at that height has the radius `r₀ + (r₁ − r₀) h / w·w`. The equation of
/// both squares is multiplied by `(w·w)²`.
#[inline(always)]
pub(super) fn cone<N: Number>(
    ends: &ConeEnds,
    ray: &Ray,
) -> Result<(Crossings<N>, Height<N>), Unsure> {
    let axis = Vector::<N>::difference(ends.apex, ends.base);
    let from_base = Vector::difference(ray.origin, ends.base);
    let squared_axis = axis.dot(&axis);
    let direction = Vector::from(ray.direction);
    let (height, rise) = (from_base.dot(&axis), axis.dot(&direction));
    let (across, drift) = (axis.cross(&from_base), axis.cross(&direction));
    let (a, b) = (drift.dot(&drift), across.dot(&drift));
    let squared_distance = across.dot(&across);
    let (a, b, c) = if ends.base_radius == ends.apex_radius {
        // A cylinder: the equation is divided by w·w.
        let squared_radius = square(&N::of(ends.base_radius));
        (
            a,
            b,
            squared_distance - squared_radius * squared_axis.clone(),
        )
    } else {
        let growth = N::difference(ends.apex_radius, ends.base_radius);
        let base_radius = N::of(ends.base_radius);
        let radius = minor(&squared_axis, &-growth.clone(), &height, &base_radius);
        let widening = growth * rise.clone();
        (
            minor(&a, &widening, &widening, &squared_axis),
            minor(&b, &widening, &radius, &squared_axis),
            minor(&squared_distance, &radius, &radius, &squared_axis),
        )
    };
    let height = Height {
        height,
        rise,
        squared_axis,
    };
    Ok((Distance::roots(a, -b, c)?, height))
}
