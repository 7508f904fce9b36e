//! The arithmetic of exact decisions: numbers whose sign is certain or known to be uncertain.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// A sign that the precision does not determine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unsure;

/// A number computed from finite `f64` values.
pub(crate) trait Number:
    Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    fn of(x: f64) -> Self;

    /// Returns `a − b`, exactly.
    fn difference(a: f64, b: f64) -> Self;

    /// Returns the sum of the products of pairs.
    #[inline(always)]
    fn sum_of_products<const K: usize>(pairs: [(Self, Self); K]) -> Self {
        let products = pairs.into_iter().map(|(a, b)| a * b);
        products.fold(Self::of(0.0), |sum, product| sum + product)
    }

    /// Returns how the exact result compares with 0.
    ///
    /// # Errors
    /// The precision does not suffice.
    fn sign(&self) -> Result<Ordering, Unsure>;
}
