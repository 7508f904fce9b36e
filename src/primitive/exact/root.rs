//! Roots of quadratic equations with rational coefficients, compared without rounding.

use crate::primitive::Precision;
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// A fraction.
pub(crate) type Rational = Relaxed;

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

    /// Returns the nearest number of a precision; of two the one whose last bit is 0. Infinite beyond the
    /// largest one.
    pub fn nearest(&self, precision: Precision) -> f64 {
        let most = key_of(f64::MAX, precision);
        let is_at_most = |key: i64| Root::from(rational(number_of(key, precision))) <= *self;
        // The estimate is wrong by far if its terms cancel, so the steps grow.
        let start = key_of(self.approximate(), precision);
        let (mut low, mut high, mut step) = (start, start, 1i64);
        if is_at_most(start) {
            while high < most && is_at_most(high) {
                low = high;
                high = high.saturating_add(step).min(most);
                step = step.saturating_mul(2);
            }
            if is_at_most(high) {
                let largest = number_of(high, precision);
                let is_beyond = *self > Root::from(rational(largest));
                return if is_beyond { f64::INFINITY } else { largest };
            }
        } else {
            while low > -most && !is_at_most(low) {
                high = low;
                low = low.saturating_sub(step).max(-most);
                step = step.saturating_mul(2);
            }
        }
        while high.saturating_sub(low) > 1 {
            let middle = low.midpoint(high);
            if is_at_most(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let [below, above] = [low, high].map(|key| number_of(key, precision));
        let middle = (rational(below) + rational(above)) / Rational::from(2);
        match self.cmp(&Root::from(middle)) {
            Ordering::Less => below,
            Ordering::Greater => above,
            Ordering::Equal if low % 2 == 0 => below,
            Ordering::Equal => above,
        }
    }

    /// Returns roughly the number.
    pub fn approximate(&self) -> f64 {
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

/// Returns a finite number as a fraction.
fn rational(x: f64) -> Rational {
    Rational::try_from(x).expect("numbers of a precision are finite")
}

/// Returns the number of a precision with this key. Keys are consecutive integers: the bits of the absolute
/// value, with the sign of the number.
fn number_of(key: i64, precision: Precision) -> f64 {
    let bits = key.unsigned_abs();
    let size = match precision {
        Precision::F64 => f64::from_bits(bits),
        Precision::F32 => f64::from(f32::from_bits(bits as u32)),
    };
    if key < 0 { -size } else { size }
}

/// Returns the key of a number of the precision near this one; that of the largest for an infinite one, and
/// 0 for NaN.
fn key_of(number: f64, precision: Precision) -> i64 {
    if number.is_nan() {
        return 0;
    }
    let size = match precision {
        Precision::F64 => number.abs().min(f64::MAX).to_bits() as i64,
        Precision::F32 => i64::from((number.abs() as f32).min(f32::MAX).to_bits()),
    };
    if number < 0.0 { -size } else { size }
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
    fn the_nearest_number_is_exact_also_where_terms_cancel() {
        let f64_of = |root: &Root| root.nearest(Precision::F64);
        assert_eq!(f64_of(&root(0.0, false, 2.0)), std::f64::consts::SQRT_2);
        assert_eq!(f64_of(&root(-3.0, false, 0.0)), -3.0);
        assert_eq!(f64_of(&root(0.0, false, 0.0)), 0.0);
        // 1 − √(1 − 2⁻⁷⁰) = 2⁻⁷¹ (1 + 2⁻⁷² + …).
        let tiny = rational(2.0f64.powi(-70));
        let cancelled = Root::new(rational(1.0), true, &(&rational(1.0) - &tiny));
        assert_eq!(f64_of(&cancelled), 2.0f64.powi(-71));
        assert_eq!(cancelled.nearest(Precision::F32), 2.0f64.powi(-71));
        // Terms so large that the estimate is not a number.
        let huge = Rational::from(2).pow(1099);
        let square = &huge * &huge;
        for difference in [0.0, 5.0, -5.0, 1e300, -1e300] {
            let root = Root::new(&huge + rational(difference), true, &square);
            assert_eq!(f64_of(&root), difference);
        }
        // Halfway between two numbers, and the least beyond it.
        let half = f64::EPSILON / 2.0;
        let halfway = |x: f64| Root::from(rational(x) + rational(half));
        assert_eq!(f64_of(&halfway(1.0)), 1.0);
        assert_eq!(f64_of(&halfway(1.0f64.next_up())), 1.0 + 2.0 * f64::EPSILON);
        let beyond = halfway(1.0).plus(&rational(1e-300));
        assert_eq!(f64_of(&beyond), 1.0f64.next_up());
        assert_eq!(f64_of(&halfway(-1.0)), -1.0 + half);
        // Subnormal and huge.
        assert_eq!(f64_of(&Root::from(rational(1.5e-323))), 1.5e-323);
        assert_eq!(f64_of(&Root::from(rational(f64::MAX))), f64::MAX);
        let double = Root::from(rational(f64::MAX) * rational(2.0));
        assert_eq!(f64_of(&double), f64::INFINITY);
        let f32_half = f64::from(f32::EPSILON) / 2.0;
        let near_f32 = |x: f64| Root::from(rational(x)).nearest(Precision::F32);
        assert_eq!(near_f32(1.0 + f32_half), 1.0);
        assert_eq!(
            near_f32(1.0 + f32_half * 1.000001),
            f64::from(1.0f32.next_up())
        );
        assert_eq!(near_f32(0.1), f64::from(0.1f32));
    }

    #[test]
    fn a_difference_far_below_rounding_is_seen() {
        // √2 and √(2 + 2⁻¹⁰⁰⁰), each plus 1.
        let tiny = rational(2.0f64.powi(-1000));
        let a = root(1.0, false, 2.0);
        let b = Root::new(rational(1.0), false, &(&rational(2.0) + &tiny));
        assert!(a < b);
        assert_eq!(a.approximate().to_bits(), b.approximate().to_bits());
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
