//! Roots of quadratic equations with rational coefficients, compared without rounding.

use super::number::{Number, Rational};
use std::cmp::Ordering;

/// The number `rational ± √radicand`.
#[derive(Clone, Debug)]
pub struct Root {
    rational: Rational,
    /// Whether the square root is subtracted rather than added.
    minus: bool,
    /// At least 0.
    radicand: Rational,
}

impl From<Rational> for Root {
    fn from(rational: Rational) -> Self {
        Root {
            rational,
            minus: false,
            radicand: Rational::ZERO,
        }
    }
}

impl Root {
    /// Returns `rational − √radicand` if `minus`, otherwise `rational + √radicand`. A negative
    /// radicand counts as 0.
    pub fn new(rational: Rational, minus: bool, radicand: &Rational) -> Self {
        Root {
            rational,
            minus,
            radicand: radicand.clone().max(Rational::ZERO),
        }
    }

    /// Returns how the number compares with 0.
    pub fn sign(&self) -> Ordering {
        let zero = Rational::ZERO;
        let surd = match self.radicand.cmp(&zero) {
            Ordering::Equal => Ordering::Equal,
            _ if self.minus => Ordering::Less,
            _ => Ordering::Greater,
        };
        match (self.rational.cmp(&zero), surd) {
            (a, Ordering::Equal) => a,
            (Ordering::Equal, b) => b,
            (a, b) if a == b => a,
            // Opposite signs: the term with the larger absolute value decides.
            (a, b) => match (&self.rational * &self.rational).cmp(&self.radicand) {
                Ordering::Greater => a,
                Ordering::Equal => Ordering::Equal,
                Ordering::Less => b,
            },
        }
    }

    /// Returns the number times a factor.
    pub fn times(&self, factor: &Rational) -> Root {
        Root {
            rational: &self.rational * factor,
            minus: self.minus != (*factor < Rational::ZERO),
            radicand: &(&self.radicand * factor) * factor,
        }
    }

    /// Returns the number plus a term.
    pub fn plus(&self, term: &Rational) -> Root {
        Root {
            rational: &self.rational + term,
            ..self.clone()
        }
    }

    /// Returns the nearest `f64`; of two equally near ones that whose last bit is 0. Infinite beyond the
    /// largest one.
    pub fn to_f64(&self) -> f64 {
        Format::F64.nearest(self)
    }

    /// Returns the nearest `f32`, likewise.
    pub fn to_f32(&self) -> f64 {
        Format::F32.nearest(self)
    }

    /// Returns the number with some error.
    fn approximate(&self) -> f64 {
        let (mut near_one, mut half) = (self.radicand.clone(), 0);
        let mut step = |near_one: &mut Rational, by: i32| {
            *near_one = &*near_one * Rational::from(4).pow(by as isize);
            half -= by;
        };
        while near_one.to_f64().value().is_infinite() {
            step(&mut near_one, -400);
        }
        while near_one > Rational::ZERO && !near_one.to_f64().value().is_normal() {
            step(&mut near_one, 400);
        }
        let surd = libm::scalbn(near_one.to_f64().value().sqrt(), half);
        let sign = if self.minus { -1.0 } else { 1.0 };
        self.rational.to_f64().value() + sign * surd
    }
}

/// A floating-point format, as a grid of numbers. The place of 0 is 0.
#[derive(Clone, Copy)]
enum Format {
    F32,
    F64,
}

impl Format {
    /// Returns the place of the largest number.
    fn last(self) -> i64 {
        self.place(f64::MAX)
    }

    /// Returns the place of a number near this one in ascending order.
    fn place(self, x: f64) -> i64 {
        let size = match self {
            Format::F32 => i64::from((x.abs() as f32).min(f32::MAX).to_bits()),
            Format::F64 => x.abs().min(f64::MAX).to_bits() as i64,
        };
        if x < 0.0 { -size } else { size }
    }

    fn at(self, place: i64) -> f64 {
        let size = match self {
            Format::F32 => f64::from(f32::from_bits(place.unsigned_abs() as u32)),
            Format::F64 => f64::from_bits(place.unsigned_abs()),
        };
        if place < 0 { -size } else { size }
    }

    /// Returns the number nearest to a root.
    fn nearest(self, root: &Root) -> f64 {
        let is_at_most = |place: i64| Root::from(rational(self.at(place))) <= *root;
        let (first, last) = (-self.last(), self.last());
        // Brackets the root: `lo` is at most the root, `hi` is above it.
        let (mut lo, mut step) = (self.place(root.approximate()), 1);
        while !is_at_most(lo) {
            if lo == first {
                return f64::NEG_INFINITY;
            }
            lo = (lo - step).max(first);
            step *= 2;
        }
        let (mut hi, mut step) = (lo + 1, 1);
        while hi <= last && is_at_most(hi) {
            lo = hi;
            hi += step;
            step *= 2;
        }
        if hi > last {
            hi = last + 1;
            if is_at_most(last) && rational(self.at(last)) != root.rational {
                return f64::INFINITY;
            }
        }
        while hi - lo > 1 {
            let middle = lo + (hi - lo) / 2;
            if is_at_most(middle) {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        if hi > last {
            return self.at(lo);
        }
        let [below, above] = [lo, hi].map(|place| self.at(place));
        let halfway = (rational(below) + rational(above)) * rational(0.5);
        match root.cmp(&Root::from(halfway)) {
            Ordering::Less => below,
            Ordering::Greater => above,
            Ordering::Equal => [below, above][(lo & 1) as usize],
        }
    }
}

/// Returns a finite number as a fraction.
fn rational(x: f64) -> Rational {
    <Rational as Number>::of(x)
}

impl Ord for Root {
    fn cmp(&self, other: &Self) -> Ordering {
        // self − other = left − right, where right is only the square root of other.
        let left = self.plus(&-&other.rational);
        let right = Root {
            rational: Rational::ZERO,
            ..other.clone()
        };
        let (left_sign, right_sign) = (left.sign(), right.sign());
        if left_sign != right_sign {
            return left_sign.cmp(&right_sign);
        }
        // Equal signs: compare the squares. For two negative numbers the order is reversed.
        let squares = Root {
            rational: &(&(&left.rational * &left.rational) + &left.radicand) - &right.radicand,
            ..left.times(&(&left.rational + &left.rational))
        };
        match left_sign {
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => squares.sign(),
            Ordering::Less => squares.sign().reverse(),
        }
    }
}

impl PartialOrd for Root {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Root {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Root {}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(p: f64, minus: bool, w: f64) -> Root {
        Root::new(rational(p), minus, &rational(w))
    }

    #[test]
    fn roots_compare_as_the_numbers_that_they_are() {
        let values = [-3.0, -1.0, 0.0, 0.5, 1.0, 2.0, 3.0];
        let radicands = [0.0, 0.25, 1.0, 2.0, 5.0, 9.0];
        let mut all = Vec::new();
        for p in values {
            for w in radicands {
                for minus in [false, true] {
                    let sign = if minus { -1.0 } else { 1.0 };
                    all.push((root(p, minus, w), p + sign * f64::sqrt(w)));
                }
            }
        }
        for (a, x) in &all {
            assert_eq!(a.sign(), x.partial_cmp(&0.0).unwrap());
            for (b, y) in &all {
                assert_eq!(a.cmp(b), x.partial_cmp(y).unwrap(), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn the_nearest_number_is_found() {
        for x in [
            0.0,
            1.0,
            -1.0,
            0.1,
            5e-324,
            1e-310,
            1e300,
            f64::MAX,
            -f64::MAX,
        ] {
            assert_eq!(Root::from(rational(x)).to_f64(), x);
            assert_eq!(
                Root::from(rational(x)).to_f32().abs() as f32,
                (x.abs() as f32).min(f32::INFINITY)
            );
        }
        // Halfway between two numbers, and next to that.
        let tiny = rational(1e-300);
        let exactly = rational(1.0) + rational(f64::EPSILON * 0.5);
        assert_eq!(Root::from(exactly.clone()).to_f64(), 1.0);
        assert_eq!(Root::from(&exactly + &tiny).to_f64(), 1.0 + f64::EPSILON);
        assert_eq!(Root::from(&exactly - &tiny).to_f64(), 1.0);
        let odd = rational(1.0) + rational(f64::EPSILON * 1.5);
        assert_eq!(Root::from(odd).to_f64(), 1.0 + 2.0 * f64::EPSILON);
        // Cancellation: 1 − √(1 − 2⁻¹⁰⁰) is nearly 2⁻¹⁰¹.
        let tiny = rational(2f64.powi(-100));
        let root = Root::new(rational(1.0), true, &(rational(1.0) - &tiny));
        assert_eq!(root.to_f64(), 2f64.powi(-101));
        // 2²⁹ + ½ rounds to an f32 only once.
        let double = rational(f64::from(16_777_217_u32)) + &tiny;
        assert_eq!(Root::from(double).to_f32(), 16_777_218.0);
    }

    #[test]
    fn a_difference_far_below_rounding_is_seen() {
        // √2 and √(2 + 2⁻¹⁰⁰⁰), each plus 1.
        let tiny = rational(2.0f64.powi(-1000));
        let a = root(1.0, false, 2.0);
        let b = Root::new(rational(1.0), false, &(&rational(2.0) + &tiny));
        assert!(a < b);
        assert_eq!(a.to_f64().to_bits(), b.to_f64().to_bits());
        // 2·√2 is √8.
        assert_eq!(
            root(0.0, false, 2.0).times(&rational(2.0)),
            root(0.0, false, 8.0)
        );
        assert_eq!(
            root(0.0, false, 2.0).times(&rational(-2.0)),
            root(0.0, true, 8.0)
        );
    }
}
