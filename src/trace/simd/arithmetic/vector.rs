//! The operations that SIMD kernels are written in, for any instruction set.

/// Lanes of the widest vector.
pub(crate) const WIDEST: usize = 16;

/// Numbers per row of [`Simd::load_transposed`] and [`Simd::store_transposed`].
pub(crate) const ROW: usize = 8;

/// Numbers from the beginning of a row to that of the next.
pub(crate) const ROW_STRIDE: usize = 2 * ROW;

/// Vectors of eight lanes: one per child of a node.
pub(crate) trait Eight: Simd {
    /// Sorts lanes, the largest first. None may be NaN.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn sort_descending(a: Self::F) -> Self::F;

    /// Returns the lanes of `a` whose numbers are the lowest three bits of `at`.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn permute_u(a: Self::U, at: Self::U) -> Self::U;

    /// Returns `a` and not `b`, bit by bit.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn and_not_u(a: Self::U, b: Self::U) -> Self::U;
}

/// A vector type: lanes of `f32` (`F`), of `u32` (`U`), and masks (`M`).
///
/// Functions named `…_u` work on `u32`.
///
/// # Safety
/// Every function may only run where the processor has the instruction set, and only inlined into a
/// function compiled for it. Unless stated otherwise, pointers must be valid for as many elements as
/// there are lanes.
pub(crate) trait Simd: Copy {
    /// Number of lanes, at most [`WIDEST`].
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
    /// Returns `a · b + c`, rounded once or twice.
    unsafe fn mul_add(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// Returns `c − a · b`, rounded once or twice.
    unsafe fn sub_mul(c: Self::F, a: Self::F, b: Self::F) -> Self::F;
    /// Returns the smaller, and `b` where either is NaN.
    unsafe fn min(a: Self::F, b: Self::F) -> Self::F;
    /// Returns the larger, and `b` where either is NaN.
    unsafe fn max(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn abs(a: Self::F) -> Self::F;
    /// Flips the sign of `a` where `by` is negative.
    unsafe fn xor_sign(a: Self::F, by: Self::F) -> Self::F;
    /// Returns the maximum over all lanes, none of which may be NaN.
    unsafe fn max_lane(a: Self::F) -> f32;
    unsafe fn lt(a: Self::F, b: Self::F) -> Self::M;
    unsafe fn le(a: Self::F, b: Self::F) -> Self::M;
    /// Returns `a` where the mask is set, else `b`.
    unsafe fn select(mask: Self::M, a: Self::F, b: Self::F) -> Self::F;

    unsafe fn splat_u(x: u32) -> Self::U;
    unsafe fn load_u(from: *const u32) -> Self::U;
    unsafe fn store_u(to: *mut u32, x: Self::U);
    unsafe fn add_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn sub_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn xor_u(a: Self::U, b: Self::U) -> Self::U;
    unsafe fn shr_u<const BITS: u32>(a: Self::U) -> Self::U;
    /// Returns whether bit `BIT` is set.
    unsafe fn test_bit_u<const BIT: u32>(a: Self::U) -> Self::M;
    /// Returns whether bit `BIT + by` is set, and whether bit `BIT + 1 − by` is; `by` is 0 or 1.
    unsafe fn test_bit_pair_u<const BIT: u32>(a: Self::U, by: Self::U) -> (Self::M, Self::M);
    unsafe fn eq_u(a: Self::U, b: Self::U) -> Self::M;
    unsafe fn select_u(mask: Self::M, a: Self::U, b: Self::U) -> Self::U;

    /// [`Simd::select_u`] of a new value or the old one of a variable. If the variable is in memory, all lanes are
    /// stored: not those of the mask alone, which is slow on some processors.
    #[inline(always)]
    unsafe fn replace_u(mask: Self::M, new: Self::U, old: Self::U) -> Self::U {
        unsafe { Self::select_u(mask, new, old) }
    }

    /// [`Simd::replace_u`] for `f32`.
    #[inline(always)]
    unsafe fn replace(mask: Self::M, new: Self::F, old: Self::F) -> Self::F {
        unsafe {
            Self::from_bits(Self::replace_u(
                mask,
                Self::bits_of(new),
                Self::bits_of(old),
            ))
        }
    }

    unsafe fn bits_of(a: Self::F) -> Self::U;
    unsafe fn from_bits(a: Self::U) -> Self::F;

    /// Returns a mask as bits, bit `k` for lane `k`.
    unsafe fn mask_bits(mask: Self::M) -> u32;
    unsafe fn mask_from_bits(bits: u32) -> Self::M;
    unsafe fn and(a: Self::M, b: Self::M) -> Self::M;
    unsafe fn or(a: Self::M, b: Self::M) -> Self::M;
    /// Returns `a` and not `b`.
    unsafe fn and_not(a: Self::M, b: Self::M) -> Self::M;

    /// Gathers pairs of words by index: returns the first words and the second words.
    unsafe fn gather_pairs(from: *const [u32; 2], at: Self::U) -> (Self::U, Self::U);
    /// Gathers quadruples of words by index, aligned to 16 bytes: returns the first three words of each.
    unsafe fn gather_quads(from: *const [u32; 4], at: Self::U) -> [Self::U; 3];
    /// Stores the lanes of the mask contiguously. There must be room for all lanes: memory behind those
    /// stored may be overwritten.
    unsafe fn compress_store(to: *mut u32, mask: Self::M, x: Self::U);
    /// [`Simd::compress_store`] of several vectors with the same mask. Faster where the mask has few
    /// lanes: then only half a vector is stored.
    #[inline(always)]
    unsafe fn compress_store_few<const N: usize>(
        to: [*mut u32; N],
        mask: Self::M,
        x: [Self::U; N],
    ) {
        for k in 0..N {
            // SAFETY: the caller's.
            unsafe { Self::compress_store(to[k], mask, x[k]) };
        }
    }
    /// Loads contiguous words into the lanes of the mask; the other lanes are those of `x`.
    unsafe fn expand_load(mask: Self::M, from: *const u32, x: Self::U) -> Self::U;
    /// Loads one row of [`ROW`] numbers per lane, [`ROW_STRIDE`] apart, and returns the columns. `from` is
    /// aligned to 32 bytes.
    unsafe fn load_transposed(from: *const f32) -> [Self::F; ROW];
    /// Stores columns as one row per lane: the inverse of [`Simd::load_transposed`].
    unsafe fn store_transposed(to: *mut f32, columns: [Self::F; ROW]);
    /// Returns `max(minimum, numbers · scale − shift)`, computed in `f64` and rounded to `f32`. NaN stays
    /// NaN.
    unsafe fn scale_to_f32(
        numbers: &[f64; ROW],
        scale_shift_minimum: &[[f64; ROW]; 3],
    ) -> [f32; ROW];
    /// Returns the larger absolute value.
    #[inline(always)]
    unsafe fn max_abs(a: Self::F, b: Self::F) -> Self::F {
        // SAFETY: the caller's.
        unsafe { Self::max(Self::abs(a), Self::abs(b)) }
    }
}
