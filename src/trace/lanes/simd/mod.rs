//! Vectors of numbers, one a lane, in the instruction sets that the kernel is compiled for.

#[cfg(target_arch = "x86_64")]
pub(super) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(super) mod avx512;
pub(super) mod portable;

use super::prepare::Node;
use super::ray::HALF;
use super::stacks::Waiting;

/// Lanes of the widest vector.
pub(super) const WIDEST: usize = 16;

/// Numbers from one half of a ray to the same half of the next.
const STRIDE: usize = 2 * HALF;

/// Lanes of numbers (`F`), words (`U`) and yes or no (`M`).
///
/// # Safety
/// All functions may run only where the processor has the instruction set, and only inlined into a
/// function that is compiled for it. Pointers are to as many valid elements as there are lanes.
pub(super) trait Simd: Copy {
    /// Lanes, at most [`WIDEST`].
    const LANES: usize;
    type F: Copy;
    type U: Copy;
    type M: Copy;

    unsafe fn splat(x: f32) -> Self::F;
    unsafe fn load(from: *const f32) -> Self::F;
    unsafe fn add(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn sub(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn mul(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn div(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn sqrt(a: Self::F) -> Self::F;
    /// `a · b + c`, rounded once or twice.
    unsafe fn mul_add(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// `c − a · b`, rounded once or twice.
    unsafe fn sub_mul(c: Self::F, a: Self::F, b: Self::F) -> Self::F;
    /// The second where either is NaN.
    unsafe fn min(a: Self::F, b: Self::F) -> Self::F;
    /// The second where either is NaN.
    unsafe fn max(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn abs(a: Self::F) -> Self::F;
    /// The other sign for lanes where `by` is negative.
    unsafe fn flip(a: Self::F, by: Self::F) -> Self::F;
    /// The greatest of all lanes; none is NaN.
    unsafe fn greatest(a: Self::F) -> f32;
    unsafe fn lt(a: Self::F, b: Self::F) -> Self::M;
    unsafe fn le(a: Self::F, b: Self::F) -> Self::M;
    /// `a` where the mask is set, else `b`.
    unsafe fn select(mask: Self::M, a: Self::F, b: Self::F) -> Self::F;

    unsafe fn splat_u(x: u32) -> Self::U;
    unsafe fn load_u(from: *const u32) -> Self::U;
    unsafe fn store_u(to: *mut u32, x: Self::U);
    unsafe fn add_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn sub_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn xor_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn shr_u<const BITS: u32>(a: Self::U) -> Self::U;
    /// Whether a bit is set.
    unsafe fn bit_u<const BIT: u32>(a: Self::U) -> Self::M;
    /// Whether the bit is set that lies `by` above this one, 0 or 1, and whether the other of both is.
    unsafe fn bits_by_u<const BIT: u32>(a: Self::U, by: Self::U) -> (Self::M, Self::M);
    unsafe fn eq_u(a: Self::U, b: Self::U) -> Self::M;
    unsafe fn select_u(mask: Self::M, a: Self::U, b: Self::U) -> Self::U;
    unsafe fn bits_of(a: Self::F) -> Self::U;
    unsafe fn from_bits(a: Self::U) -> Self::F;

    /// Bit `k` for lane `k`.
    unsafe fn bits(mask: Self::M) -> u32;
    unsafe fn mask(bits: u32) -> Self::M;
    unsafe fn and(a: Self::M, b: Self::M) -> Self::M;
    unsafe fn or(a: Self::M, b: Self::M) -> Self::M;
    /// `a` and not `b`.
    unsafe fn and_not(a: Self::M, b: Self::M) -> Self::M;

    /// Both words of the nodes at these places.
    unsafe fn nodes(nodes: *const Node, at: Self::U) -> (Self::U, Self::U);
    /// Reads from the stacks at these places.
    unsafe fn pop(stacks: *const Waiting, at: Self::U) -> (Self::U, Self::F, Self::F);
    /// Writes the lanes of the mask one after the other. `to` has room for all lanes, and what follows
    /// those written may be overwritten.
    unsafe fn append(to: *mut u32, mask: Self::M, x: Self::U);
    /// The same for several columns, where few lanes are set mostly: half a vector is written then, which
    /// is cheaper.
    #[inline(always)]
    unsafe fn append_few<const N: usize>(to: [*mut u32; N], mask: Self::M, x: [Self::U; N]) {
        for k in 0..N {
            // SAFETY: the caller's.
            unsafe { Self::append(to[k], mask, x[k]) };
        }
    }
    /// Gives the lanes of the mask what lies one after the other in `from`, and the others their own of
    /// `x`.
    unsafe fn expand(mask: Self::M, from: *const u32, x: Self::U) -> Self::U;
    /// Half of a ray a lane, number by number; `from` is aligned to 32 bytes, and likewise below.
    unsafe fn columns(from: *const f32) -> [Self::F; HALF];
    /// Writes a half of every ray.
    unsafe fn write_columns(to: *mut f32, columns: [Self::F; HALF]);
    /// Numbers scaled, moved down, raised to the least, and rounded, in that order. NaN stays NaN.
    unsafe fn narrowed(numbers: &[f64; HALF], scale_shift_least: &[[f64; HALF]; 3]) -> [f32; HALF];
    /// The larger of both sizes, whatever the signs.
    #[inline(always)]
    unsafe fn max_abs(a: Self::F, b: Self::F) -> Self::F {
        // SAFETY: the caller's.
        unsafe { Self::max(Self::abs(a), Self::abs(b)) }
    }
}
