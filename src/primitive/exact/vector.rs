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
        let product = |a: &N, b: &N| a.clone() * b.clone();
        let [x, y, z] = [
            product(&self.x, &other.x),
            product(&self.y, &other.y),
            product(&self.z, &other.z),
        ];
        x + y + z
    }

    /// Returns the dot product with a vector of `f64`.
    #[inline(always)]
    pub(super) fn dot_with(&self, other: Vec3) -> N {
        let (x, y, z) = (self.x.clone(), self.y.clone(), self.z.clone());
        x.times(other.x) + y.times(other.y) + z.times(other.z)
    }

    #[inline(always)]
    pub(super) fn cross(&self, other: &Self) -> Self {
        let minor = |a: &N, b: &N, c: &N, d: &N| a.clone() * d.clone() - b.clone() * c.clone();
        Vector {
            x: minor(&self.y, &self.z, &other.y, &other.z),
            y: minor(&self.z, &self.x, &other.z, &other.x),
            z: minor(&self.x, &self.y, &other.x, &other.y),
        }
    }

    /// Returns the cross product with a vector of `f64`.
    #[inline(always)]
    pub(super) fn cross_with(&self, other: Vec3) -> Self {
        let minor = |a: &N, b: &N, c: f64, d: f64| a.clone().times(d) - b.clone().times(c);
        Vector {
            x: minor(&self.y, &self.z, other.y, other.z),
            y: minor(&self.z, &self.x, other.z, other.x),
            z: minor(&self.x, &self.y, other.x, other.y),
        }
    }
}

/// Returns the exact squared length.
#[inline(always)]
pub(super) fn squared_length<N: Number>(v: Vec3) -> N {
    let square = |x: f64| N::of(x).times(x);
    square(v.x) + square(v.y) + square(v.z)
}
