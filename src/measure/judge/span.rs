//! Interval arithmetic on rational numbers. Nothing is ever rounded.

use crate::geometry::Vec3;
use dashu_ratio::Relaxed as Rational;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An interval from `lo` to `hi`. If both are equal, the number is exact.
#[derive(Clone, Debug)]
pub struct Span {
    pub lo: Rational,
    pub hi: Rational,
}

/// Returns a finite number as a fraction.
///
/// # Panics
/// If the number is infinite or NaN.
pub fn rational(number: f64) -> Rational {
    Rational::try_from(number).expect("only finite numbers are judged")
}

impl Span {
    /// Returns the interval that contains only this number.
    pub fn exactly(number: Rational) -> Self {
        Span {
            lo: number.clone(),
            hi: number,
        }
    }

    /// Returns the interval of the numbers at most `reach` from `middle`.
    pub fn around(middle: Rational, reach: &Rational) -> Self {
        Span {
            lo: &middle - reach,
            hi: middle + reach,
        }
    }

    pub fn is_exact(&self) -> bool {
        self.lo == self.hi
    }

    /// Returns how the numbers compare with 0, or `None` if they differ in that.
    pub fn sign(&self) -> Option<Ordering> {
        let signs = (self.lo.cmp(&Rational::ZERO), self.hi.cmp(&Rational::ZERO));
        (signs.0 == signs.1).then_some(signs.0)
    }

    /// Returns whether the interval contains 0.
    pub fn may_be_zero(&self) -> bool {
        self.lo <= Rational::ZERO && self.hi >= Rational::ZERO
    }

    /// Returns the interval of all squares.
    pub fn square(&self) -> Self {
        let (a, b) = (&self.lo * &self.lo, &self.hi * &self.hi);
        let (least, most) = if a < b { (a, b) } else { (b, a) };
        Span {
            lo: if self.may_be_zero() {
                Rational::ZERO
            } else {
                least
            },
            hi: most,
        }
    }

    /// Returns the interval of all quotients; `None` if the divisor may be 0.
    pub fn divided_by(&self, divisor: &Span) -> Option<Self> {
        let one = Rational::ONE;
        (!divisor.may_be_zero()).then(|| {
            let inverse = Span {
                lo: &one / &divisor.hi,
                hi: &one / &divisor.lo,
            };
            self * &inverse
        })
    }
}

impl Add for &Span {
    type Output = Span;

    fn add(self, other: &Span) -> Span {
        Span {
            lo: &self.lo + &other.lo,
            hi: &self.hi + &other.hi,
        }
    }
}

impl Neg for &Span {
    type Output = Span;

    fn neg(self) -> Span {
        Span {
            lo: -&self.hi,
            hi: -&self.lo,
        }
    }
}

impl Sub for &Span {
    type Output = Span;

    fn sub(self, other: &Span) -> Span {
        Span {
            lo: &self.lo - &other.hi,
            hi: &self.hi - &other.lo,
        }
    }
}

impl Mul for &Span {
    type Output = Span;

    fn mul(self, other: &Span) -> Span {
        if self.is_exact() && other.is_exact() {
            return Span::exactly(&self.lo * &other.lo);
        }
        let mut products = [
            &self.lo * &other.lo,
            &self.lo * &other.hi,
            &self.hi * &other.lo,
            &self.hi * &other.hi,
        ];
        products.sort();
        let [lo, _, _, hi] = products;
        Span { lo, hi }
    }
}

/// A vector of intervals.
#[derive(Clone, Debug)]
pub struct SpanVec(pub [Span; 3]);

impl SpanVec {
    /// Returns the vectors whose components differ from those of `middle` by at most `reach`.
    pub fn around(middle: Vec3, reach: &Rational) -> Self {
        SpanVec(middle.to_array().map(|x| Span::around(rational(x), reach)))
    }

    pub fn dot(&self, other: &SpanVec) -> Span {
        let [x, y, z] = std::array::from_fn(|k| &self.0[k] * &other.0[k]);
        &(&x + &y) + &z
    }

    pub fn cross(&self, other: &SpanVec) -> SpanVec {
        SpanVec(std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            &(&self.0[i] * &other.0[j]) - &(&self.0[j] * &other.0[i])
        }))
    }

    /// Returns the interval of the squared length.
    pub fn squared_length(&self) -> Span {
        let [x, y, z] = std::array::from_fn(|k| self.0[k].square());
        &(&x + &y) + &z
    }

    pub fn scaled(&self, by: &Span) -> SpanVec {
        SpanVec(std::array::from_fn(|k| &self.0[k] * by))
    }
}

impl Add for &SpanVec {
    type Output = SpanVec;

    fn add(self, other: &SpanVec) -> SpanVec {
        SpanVec(std::array::from_fn(|k| &self.0[k] + &other.0[k]))
    }
}

impl Sub for &SpanVec {
    type Output = SpanVec;

    fn sub(self, other: &SpanVec) -> SpanVec {
        SpanVec(std::array::from_fn(|k| &self.0[k] - &other.0[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(lo: f64, hi: f64) -> Span {
        Span {
            lo: rational(lo),
            hi: rational(hi),
        }
    }

    fn assert_is(found: &Span, lo: f64, hi: f64) {
        assert_eq!((&found.lo, &found.hi), (&rational(lo), &rational(hi)));
    }

    #[test]
    fn arithmetic_holds_every_combination() {
        assert_is(&(&span(-1.0, 2.0) * &span(-3.0, 4.0)), -6.0, 8.0);
        assert_is(&(&span(1.0, 2.0) - &span(-3.0, 4.0)), -3.0, 5.0);
        assert_is(&span(-3.0, 2.0).square(), 0.0, 9.0);
        let quotient = span(1.0, 2.0).divided_by(&span(-4.0, -2.0)).unwrap();
        assert_is(&quotient, -1.0, -0.25);
        assert!(span(1.0, 2.0).divided_by(&span(0.0, 1.0)).is_none());
    }

    #[test]
    fn nothing_is_rounded() {
        let third = Span::exactly(rational(0.1));
        let sum = &(&third + &third) + &third;
        assert_eq!(
            (&sum - &Span::exactly(rational(0.3))).sign(),
            Some(Ordering::Greater)
        );
        assert_eq!(span(-1.0, 1.0).sign(), None);
        let least = Span::exactly(rational(5e-324));
        assert_eq!((&least * &least).sign(), Some(Ordering::Greater));
    }
}
