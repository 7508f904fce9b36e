//! Numbers that are never rounded.

use super::number::{Number, Unsure};
use super::root::Rational;
use dashu_int::{IBig, UBig};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// The number `multiple · 2^exponent`. Sums and products of `f64` values are such numbers.
#[derive(Clone, Debug)]
pub(crate) struct Dyadic {
    multiple: IBig,
    exponent: isize,
}

impl Dyadic {
    fn is_zero(&self) -> bool {
        self.multiple == IBig::ZERO
    }

    /// Converts the number to a fraction.
    pub(super) fn to_rational(&self) -> Rational {
        let power = self.exponent.unsigned_abs();
        if self.exponent < 0 {
            Rational::from_parts(self.multiple.clone(), UBig::ONE << power)
        } else {
            Rational::from_parts(&self.multiple << power, UBig::ONE)
        }
    }
}

impl Number for Dyadic {
    /// # Panics
    /// If the number is infinite or NaN.
    fn of(x: f64) -> Self {
        assert!(x.is_finite(), "only finite numbers are decided");
        const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;
        let bits = x.to_bits();
        let fraction = (bits & ((1 << MANTISSA_BITS) - 1)) as i64;
        let exponent = (bits >> MANTISSA_BITS & 0x7ff) as isize;
        // Numbers with exponent 0 are subnormal.
        let (size, exponent) = match exponent {
            0 => (fraction, 1),
            _ => (fraction | 1 << MANTISSA_BITS, exponent),
        };
        let zeros = if size == 0 { 0 } else { size.trailing_zeros() };
        let size = size >> zeros;
        Dyadic {
            multiple: IBig::from(if x < 0.0 { -size } else { size }),
            exponent: exponent - 1075 + zeros as isize,
        }
    }

    fn difference(a: f64, b: f64) -> Self {
        Dyadic::of(a) - Dyadic::of(b)
    }

    fn sign(&self) -> Result<Ordering, Unsure> {
        Ok(self.multiple.cmp(&IBig::ZERO))
    }
}

impl Add for Dyadic {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (high, low) = if self.exponent >= other.exponent {
            (self, other)
        } else {
            (other, self)
        };
        let shift = high.exponent.abs_diff(low.exponent);
        Dyadic {
            multiple: (high.multiple << shift) + low.multiple,
            exponent: low.exponent,
        }
    }
}

impl Neg for Dyadic {
    type Output = Self;

    fn neg(self) -> Self {
        Dyadic {
            multiple: -self.multiple,
            ..self
        }
    }
}

impl Sub for Dyadic {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dyadic {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Dyadic {
            multiple: self.multiple * other.multiple,
            exponent: self.exponent + other.exponent,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_rounded() {
        let numbers = [
            0.0,
            -0.0,
            1.0,
            -3.0,
            0.1,
            5e-324,
            -1e-310,
            1e300,
            f64::MAX,
            0.5,
        ];
        let rational = |x: f64| Rational::try_from(x).unwrap();
        for a in numbers {
            assert_eq!(Dyadic::of(a).to_rational(), rational(a));
            for b in numbers {
                let (x, y) = (Dyadic::of(a), Dyadic::of(b));
                let sum = x.clone() + y.clone();
                assert_eq!(sum.to_rational(), rational(a) + rational(b));
                assert_eq!(
                    Dyadic::difference(a, b).to_rational(),
                    rational(a) - rational(b)
                );
                assert_eq!((x * y).to_rational(), rational(a) * rational(b));
                assert_eq!(
                    Dyadic::difference(a, b).sign(),
                    Ok(a.partial_cmp(&b).unwrap())
                );
            }
        }
    }
}
