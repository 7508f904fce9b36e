//! Distances along a ray, as fractions that may contain a square root.

use super::double_word::DoubleWord;
use super::dyadic::Dyadic;
use super::number::{Number, Unsure};
use super::root::{Rational, Root};
use super::vector::minor;
use crate::primitive::Precision;
use std::cmp::Ordering;

/// The number `(middle ± √radicand) / divisor`.
#[derive(Clone, Debug)]
pub(crate) struct Distance<N> {
    middle: N,
    surd: Option<Surd<N>>,
    /// Positive.
    divisor: N,
}

#[derive(Clone, Debug)]
struct Surd<N> {
    sign: Ordering,
    /// At least 0.
    radicand: N,
    /// `(middle² − radicand) / divisor`, computed without them.
    product: N,
}

/// Where a line crosses a surface, in ascending order.
pub(super) type Crossings<N> = [Option<Distance<N>>; 2];

/// Returns how `a ± √radicand` compares with 0, where `side` is the sign of the square root.
#[inline(always)]
fn sign_with_surd<N: Number>(a: &N, side: Ordering, radicand: &N) -> Result<Ordering, Unsure> {
    if side == Ordering::Equal || radicand.sign()? == Ordering::Equal {
        return a.sign();
    }
    match a.sign()? {
        Ordering::Equal => Ok(side),
        sign if sign == side => Ok(sign),
        // Opposite signs: the term with the larger absolute value decides.
        sign => Ok(match (a.clone() * a.clone() - radicand.clone()).sign()? {
            Ordering::Greater => sign,
            Ordering::Equal => Ordering::Equal,
            Ordering::Less => side,
        }),
    }
}

impl<N: Number> Distance<N> {
    /// Returns `over / under`; `None` if `under` is 0.
    #[inline(always)]
    pub(super) fn fraction(over: N, under: N) -> Result<Option<Self>, Unsure> {
        let (middle, divisor) = match under.sign()? {
            Ordering::Equal => return Ok(None),
            Ordering::Greater => (over, under),
            Ordering::Less => (-over, -under),
        };
        Ok(Some(Distance {
            middle,
            surd: None,
            divisor,
        }))
    }

    /// Returns the roots of `a t² − 2 b t + c` in ascending order. There is none if the equation holds
    /// everywhere.
    #[inline(always)]
    pub(super) fn roots(a: N, b: N, c: N) -> Result<Crossings<N>, Unsure> {
        let (a, b, c) = match a.sign()? {
            Ordering::Less => (-a, -b, -c),
            Ordering::Equal => return Ok([Distance::fraction(c, b.clone() + b)?, None]),
            Ordering::Greater => (a, b, c),
        };
        let radicand = minor(&b, &a, &c, &b);
        if radicand.sign()? == Ordering::Less {
            return Ok([None, None]);
        }
        let root = |sign| {
            Some(Distance {
                middle: b.clone(),
                surd: Some(Surd {
                    sign,
                    radicand: radicand.clone(),
                    product: c.clone(),
                }),
                divisor: a.clone(),
            })
        };
        Ok([root(Ordering::Less), root(Ordering::Greater)])
    }

    /// Returns how the distance compares with a number, which may be infinite.
    #[inline(always)]
    pub(super) fn compare(&self, t: f64) -> Result<Ordering, Unsure> {
        if t.is_infinite() {
            return Ok(if t > 0.0 {
                Ordering::Less
            } else {
                Ordering::Greater
            });
        }
        let rational = self.middle.clone() - self.divisor.clone() * N::of(t);
        match &self.surd {
            None => rational.sign(),
            Some(surd) => sign_with_surd(&rational, surd.sign, &surd.radicand),
        }
    }

    /// Returns how `offset + factor · distance` compares with 0.
    #[inline(always)]
    pub(super) fn sign_at(&self, offset: N, factor: N) -> Result<Ordering, Unsure> {
        let rational = minor(&offset, &-factor.clone(), &self.middle, &self.divisor);
        let Some(surd) = &self.surd else {
            return rational.sign();
        };
        let side = match factor.sign()? {
            Ordering::Greater => surd.sign,
            Ordering::Equal => Ordering::Equal,
            Ordering::Less => surd.sign.reverse(),
        };
        let radicand = surd.radicand.clone() * factor.clone() * factor;
        sign_with_surd(&rational, side, &radicand)
    }
}

/// A number that can be rounded.
pub(super) trait Round {
    /// Returns the nearest number of a precision.
    ///
    /// # Errors
    /// The arithmetic does not determine it.
    fn nearest(&self, precision: Precision) -> Result<f64, Unsure>;
}

impl<const FMA: bool> Distance<DoubleWord<FMA>> {
    #[inline(always)]
    fn value(&self) -> DoubleWord<FMA> {
        let Some(surd) = &self.surd else {
            return self.middle.over(self.divisor);
        };
        let root = surd.radicand.square_root();
        let root = match surd.sign {
            Ordering::Less => -root,
            _ => root,
        };
        let sum = self.middle + root;
        // Where the sum cancels, the product of both roots is divided instead.
        if sum.is_far_below(&self.middle) {
            surd.product.over(self.middle - root)
        } else {
            sum.over(self.divisor)
        }
    }
}

impl<const FMA: bool> Round for Distance<DoubleWord<FMA>> {
    #[inline(always)]
    fn nearest(&self, precision: Precision) -> Result<f64, Unsure> {
        let [lo, hi] = self.value().around();
        let (lo, hi) = match precision {
            Precision::F32 => {
                let [lo, hi] = [lo.next_down(), hi.next_up()].map(|t| f64::from(t as f32));
                (lo, hi)
            }
            Precision::F64 => (lo, hi),
        };
        if lo == hi { Ok(lo) } else { Err(Unsure) }
    }
}

impl Round for Distance<Dyadic> {
    fn nearest(&self, precision: Precision) -> Result<f64, Unsure> {
        Ok(self.root().nearest(precision))
    }
}

impl Distance<Dyadic> {
    pub(super) fn root(&self) -> Root {
        let inverse = Rational::ONE / self.divisor.to_rational();
        let middle = self.middle.to_rational();
        match &self.surd {
            None => Root::from(middle * inverse),
            Some(surd) => {
                let is_less = surd.sign == Ordering::Less;
                Root::new(middle, is_less, &surd.radicand.to_rational()).times(&inverse)
            }
        }
    }
}
