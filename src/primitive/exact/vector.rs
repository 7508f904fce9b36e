//! Vectors of exact numbers.

use super::number::Number;
use crate::geometry::Vec3;

#[derive(Clone)]
pub(super) struct Vector<N> {
    x: N,
    y: N,
    z: N,
}

impl<N: Number> Vector<N> {
    /// Returns `a − b`.
    #[inline(always)]
    pub(super) fn difference(a: Vec3, b: Vec3) -> Self {
        Vector {
            x: N::difference(a.x, b.x),
            y: N::difference(a.y, b.y),
            z: N::difference(a.z, b.z),
        }
    }

    #[inline(always)]
    pub(super) fn dot(&self, other: &Self) -> N {
        N::sum_of_products([
            (self.x.clone(), other.x.clone()),
            (self.y.clone(), other.y.clone()),
            (self.z.clone(), other.z.clone()),
        ])
    }

    #[inline(always)]
    pub(super) fn cross(&self, other: &Self) -> Self {
        Vector {
            x: minor(&self.y, &self.z, &other.y, &other.z),
            y: minor(&self.z, &self.x, &other.z, &other.x),
            z: minor(&self.x, &self.y, &other.x, &other.y),
        }
    }
}

impl<N: Number> From<Vec3> for Vector<N> {
    #[inline(always)]
    fn from(v: Vec3) -> Self {
        Vector {
            x: N::of(v.x),
            y: N::of(v.y),
            z: N::of(v.z),
        }
    }
}

/// Returns the determinant of the rows (a, b) and (c, d).
#[inline(always)]
pub(super) fn minor<N: Number>(a: &N, b: &N, c: &N, d: &N) -> N {
    N::sum_of_products([(a.clone(), d.clone()), (-b.clone(), c.clone())])
}
