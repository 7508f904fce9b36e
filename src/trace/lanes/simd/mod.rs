//! Vectors of numbers, one a lane, in the instruction sets that the kernel is compiled for.

#[cfg(target_arch = "x86_64")]
pub(super) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(super) mod avx512;
pub(super) mod portable;

use super::prepare::Node;

/// A node that waits for its turn, and where on the ray its cell lies.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
pub(super) struct Waiting {
    pub(super) node: u32,
    pub(super) t_enter: f32,
    pub(super) t_exit: f32,
}

impl Waiting {
    /// What an entry counts in places on the stack, which are of 8 bytes: processors find such
    /// addresses without an instruction for the product.
    pub(super) const PLACES: u32 = (size_of::<Waiting>() / 8) as u32;
}

/// Lanes of numbers (`F`), words (`U`) and yes or no (`M`).
///
/// # Safety
/// All functions may run only where the processor has the instruction set, and only inlined into a
/// function that is compiled for it. Pointers are to as many valid elements as there are lanes.
pub(super) trait Simd: Copy {
    /// Lanes, at most 16.
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
    /// `a` shifted up by as many bits as `by` says.
    unsafe fn shl_by_u(a: Self::U, by: Self::U) -> Self::U;
    /// Whether `a` and `b` have a bit in common.
    unsafe fn test_u(a: Self::U, b: Self::U) -> Self::M;
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
    /// Writes to the stack at these places of 8 bytes, in every lane.
    unsafe fn push(
        stack: *mut Waiting,
        at: Self::U,
        node: Self::U,
        t_enter: Self::F,
        t_exit: Self::F,
    );
    /// Reads from the stack likewise.
    unsafe fn pop(stack: *const Waiting, at: Self::U) -> (Self::U, Self::F, Self::F);
}
