//! Spheres, cylinders and cones: roots of quadratic equations.

use super::distance::Distance;
use super::number::{Number, Unsure};
use crate::geometry::{Ray, Vec3};
use std::cmp::Ordering;

/// Three numbers.
#[derive(Clone)]
struct Vector<N>([N; 3]);

impl<N: Number> Vector<N> {
    fn of(v: Vec3) -> Self {
        Vector(v.to_array().map(N::of))
    }

    /// Returns `a − b`.
    fn difference(a: Vec3, b: Vec3) -> Self {
        Vector([0, 1, 2].map(|k| N::difference(a[k], b[k])))
    }

    fn dot(&self, other: &Self) -> N {
        let [x, y, z] = [0, 1, 2].map(|k| self.0[k].clone() * other.0[k].clone());
        x + y + z
    }

    fn cross(&self, other: &Self) -> Self {
        Vector([0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            self.0[i].clone() * other.0[j].clone() - self.0[j].clone() * other.0[i].clone()
        }))
    }
}

fn square<N: Number>(x: &N) -> N {
    x.clone() * x.clone()
}

/// Returns where a line crosses a sphere, in ascending order. At a tangent both roots are equal.
pub(super) fn sphere<N: Number>(
    center: Vec3,
    radius: f64,
    ray: &Ray,
) -> Result<[Option<Distance<N>>; 2], Unsure> {
    let direction = Vector::of(ray.direction);
    let to_center = Vector::<N>::difference(center, ray.origin);
    let c = to_center.dot(&to_center) - square(&N::of(radius));
    Distance::roots(direction.dot(&direction), to_center.dot(&direction), c)
}

/// The ends of a cylinder or cone and their radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ConeEnds {
    pub(crate) base: Vec3,
    pub(crate) base_radius: f64,
    pub(crate) apex: Vec3,
    pub(crate) apex_radius: f64,
}

/// Returns where a line crosses a cylinder or cone between its ends, in ascending order. A line within the
/// surface does not.
///
/// The axis `w` from base to apex is not normalized, which keeps every coefficient rational. For a point
/// `p` relative to the base, the scaled height is `h = p·w`, from 0 to `w·w`. Its distance from the axis
/// is `|w × p| / |w|`. The surface at that height has the radius `r₀ + (r₁ − r₀) h / w·w`. The equation of
/// both squares is multiplied by `(w·w)²`.
pub(super) fn cone<N: Number>(
    ends: &ConeEnds,
    ray: &Ray,
) -> Result<[Option<Distance<N>>; 2], Unsure> {
    let direction = Vector::<N>::of(ray.direction);
    let axis = Vector::difference(ends.apex, ends.base);
    let from_base = Vector::difference(ray.origin, ends.base);
    let squared_axis = axis.dot(&axis);
    let growth = N::difference(ends.apex_radius, ends.base_radius);
    let (height, rise) = (from_base.dot(&axis), direction.dot(&axis));
    let radius = N::of(ends.base_radius) * squared_axis.clone() + growth.clone() * height.clone();
    let widening = growth * rise.clone();
    let (across, drift) = (axis.cross(&from_base), axis.cross(&direction));
    let a = drift.dot(&drift) * squared_axis.clone() - square(&widening);
    let b = across.dot(&drift) * squared_axis.clone() - widening * radius.clone();
    let c = across.dot(&across) * squared_axis.clone() - square(&radius);
    let mut roots = Distance::roots(a, -b, c)?;
    for root in &mut roots {
        let Some(t) = root else { continue };
        let is_above = t.sign_at(height.clone(), rise.clone())? != Ordering::Less;
        let below_apex = t.sign_at(height.clone() - squared_axis.clone(), rise.clone())?;
        if !is_above || below_apex == Ordering::Greater {
            *root = None;
        }
    }
    Ok(roots)
}
