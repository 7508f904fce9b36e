//! Sums of two `f64`, with a bound on their error.

use super::number::{Number, Unsure};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// The number `hi + lo`, where `|lo|` is at most half a unit in the last place of `hi`, up to `error`.
///
/// Sums, products, quotients and square roots are those of Joldes, Muller and Popescu, "Tight and rigorous
/// error bounds for basic building blocks of double-word arithmetic" (ACM TOMS 44(2), 2017), and Lefèvre,
/// Louvet, Muller, Picot and Rideau, "Accurate calculation of Euclidean norms using double-word
/// arithmetic" (ACM TOMS 49(1), 2023). With u = 2⁻⁵³, their relative errors are at most 3 u², 7 u², 15 u²
/// and 4 u²; [`ROUNDING`] is 16 u².
///
/// With `FMA`, products use fused multiply-add instructions. The results are the same.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DoubleWord<const FMA: bool> {
    hi: f64,
    lo: f64,
    /// At least 0; infinite or NaN if nothing is known.
    error: f64,
}

/// 2⁻¹⁰².
const ROUNDING: f64 = f64::EPSILON * f64::EPSILON * 4.0;

/// Below this size, 2⁻⁸⁶⁰, low words of products may underflow.
const SMALL: f64 = f64::from_bits((1023 - 860) << 52);

/// More than the sum of all errors by underflow in one operation whose result is [`SMALL`].
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52);

/// Makes up for the rounding of a bound while it is computed.
const UP: f64 = 1.0 + 32.0 * f64::EPSILON;

#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// [`two_sum`] for `|a| ≥ |b|` or `a` = 0.
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Returns the product and its rounding error. NaN above 2⁹⁹⁶.
#[inline(always)]
fn two_product<const FMA: bool>(a: f64, b: f64) -> (f64, f64) {
    /// Splits a number into two of 26 bits (Dekker 1971).
    #[inline(always)]
    fn split(x: f64) -> (f64, f64) {
        let scaled = 134_217_729.0 * x; // 2²⁷ + 1
        let hi = scaled - (scaled - x);
        (hi, x - hi)
    }
    let product = a * b;
    if FMA {
        return (product, a.mul_add(b, -product));
    }
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    let error = al * bl - (((product - ah * bh) - al * bh) - ah * bl);
    (product, error)
}

impl<const FMA: bool> DoubleWord<FMA> {
    /// Returns the number with a bound on its error, and accounts for underflow of a result that is not 0.
    #[inline(always)]
    fn new((hi, lo): (f64, f64), error: f64, is_zero: bool) -> Self {
        let is_small = (hi.abs() < SMALL) & !is_zero;
        let underflow = if is_small { UNDERFLOW } else { 0.0 };
        DoubleWord {
            hi,
            lo,
            error: (error + ROUNDING * hi.abs()) * UP + underflow,
        }
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        (self.hi == 0.0) & (self.error == 0.0)
    }

    /// Returns a lower bound on the absolute value, or a negative number.
    #[inline(always)]
    fn least(&self) -> f64 {
        self.hi.abs() * (1.0 - 4.0 * f64::EPSILON) - self.error
    }

    #[inline(always)]
    pub(super) fn over(self, divisor: Self) -> Self {
        let least = divisor.least();
        let is_large = |x: f64| x.abs() >= SMALL;
        let is_safe = least > 0.0 && is_large(divisor.hi) && (self.hi == 0.0 || is_large(self.hi));
        let first = self.hi / divisor.hi;
        let (product, mut below) = two_product::<FMA>(first, divisor.hi);
        below += first * divisor.lo;
        let (product, below) = fast_two_sum(product, below);
        let rest = (self.hi - product) + (self.lo - below);
        let quotient = fast_two_sum(first, rest / divisor.hi);
        let error = if is_safe {
            (self.error + quotient.0.abs() * UP * divisor.error) / least
        } else {
            f64::INFINITY
        };
        DoubleWord::new(quotient, error, self.hi == 0.0)
    }

    /// Returns the square root of a number that is not negative.
    #[inline(always)]
    pub(super) fn square_root(self) -> Self {
        if self.is_zero() {
            return self;
        }
        let root = self.hi.sqrt();
        let (square, error) = two_product::<FMA>(root, root);
        let rest = ((self.hi - square) - error) + self.lo;
        let is_safe = self.hi >= SMALL && self.error <= 0.5 * self.hi;
        // |√(x + e) − √x| ≤ |e| / √x.
        let error = if is_safe {
            self.error / root * UP
        } else {
            f64::INFINITY
        };
        DoubleWord::new(fast_two_sum(root, rest / (root + root)), error, false)
    }

    /// Returns whether this number is about a thousand times smaller than another one, or less.
    #[inline(always)]
    pub(super) fn is_far_below(&self, other: &Self) -> bool {
        self.hi.abs() < 1e-3 * other.hi.abs()
    }

    /// Returns two numbers between which the exact one lies, in a precision of 53 bits.
    #[inline(always)]
    pub(super) fn around(&self) -> [f64; 2] {
        let error = self.error * UP + 2.0 * f64::EPSILON * self.lo.abs();
        [self.hi + (self.lo - error), self.hi + (self.lo + error)]
    }
}

impl<const FMA: bool> Add for DoubleWord<FMA> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (sum, low) = two_sum(self.hi, other.hi);
        let (low_sum, lowest) = two_sum(self.lo, other.lo);
        let (sum, low) = fast_two_sum(sum, low + low_sum);
        let words = fast_two_sum(sum, lowest + low);
        // Sums do not underflow.
        DoubleWord::new(words, self.error + other.error, true)
    }
}

impl<const FMA: bool> Neg for DoubleWord<FMA> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        DoubleWord {
            hi: -self.hi,
            lo: -self.lo,
            error: self.error,
        }
    }
}

impl<const FMA: bool> Sub for DoubleWord<FMA> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const FMA: bool> Mul for DoubleWord<FMA> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (product, low) = two_product::<FMA>(self.hi, other.hi);
        let words = fast_two_sum(product, low + (self.hi * other.lo + self.lo * other.hi));
        let error =
            self.hi.abs() * other.error + other.hi.abs() * self.error + self.error * other.error;
        DoubleWord::new(words, error, self.is_zero() | other.is_zero())
    }
}

impl<const FMA: bool> Number for DoubleWord<FMA> {
    #[inline(always)]
    fn of(x: f64) -> Self {
        DoubleWord {
            hi: x,
            lo: 0.0,
            error: 0.0,
        }
    }

    #[inline(always)]
    fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, -b);
        DoubleWord { hi, lo, error: 0.0 }
    }

    /// Adds the high words of the products exactly, and all that is lower in `f64` (Ogita, Rump and Oishi,
    /// "Accurate sum and dot product", SIAM J. Sci. Comput. 26(6), 2005). A lower part is at most 3 u of its
    /// product and has an error of 7 u². The sum of 2 K − 1 such parts and carries adds less than 20 u² of the
    /// products for K ≤ 3. Two [`ROUNDING`] are 32 u².
    #[inline(always)]
    fn sum_of_products<const K: usize>(pairs: [(Self, Self); K]) -> Self {
        const { assert!(K <= 3) };
        let (mut sum, mut low, mut size, mut error) = (0.0, 0.0, 0.0, 0.0);
        let mut is_zero = true;
        for (a, b) in pairs {
            let (product, rest) = two_product::<FMA>(a.hi, b.hi);
            let (next, carry) = two_sum(sum, product);
            sum = next;
            low += carry + (rest + (a.hi * b.lo + a.lo * b.hi));
            size += product.abs();
            error += a.hi.abs() * b.error + b.hi.abs() * a.error + a.error * b.error;
            is_zero &= a.is_zero() | b.is_zero();
        }
        let error = error + 2.0 * ROUNDING * size;
        let underflow = if size < SMALL && !is_zero {
            UNDERFLOW
        } else {
            0.0
        };
        DoubleWord::new(two_sum(sum, low), error + underflow, true)
    }

    #[inline(always)]
    fn sign(&self) -> Result<Ordering, Unsure> {
        if self.least() > 0.0 {
            Ok(if self.hi > 0.0 {
                Ordering::Greater
            } else {
                Ordering::Less
            })
        } else if self.is_zero() {
            Ok(Ordering::Equal)
        } else {
            Err(Unsure)
        }
    }
}
