//! Eight lanes of AVX2 with fused multiply–add.
#![allow(unsafe_op_in_unsafe_fn)] // the trait's contract covers every line

use super::vector::{Eight, ROW, ROW_STRIDE, Simd};
use std::arch::x86_64::*;

#[derive(Clone, Copy)]
pub(crate) struct Avx2;

/// Only the highest bit of each lane is significant.
type Mask = __m256i;

/// Returns the vector, as one that the compiler knows nothing about.
#[target_feature(enable = "avx")]
#[inline]
unsafe fn opaque(mut x: __m256i) -> __m256i {
    std::arch::asm!("/* {0} */", inout(ymm_reg) x, options(pure, nomem, nostack, preserves_flags));
    x
}

/// Returns the lanes as indices, extracting two at a time.
#[inline(always)]
unsafe fn indices(at: __m256i) -> [usize; 8] {
    let mut indices = [0; 8];
    let parts = [
        _mm256_castsi256_si128(at),
        _mm256_extracti128_si256::<1>(at),
    ];
    for (k, part) in parts.into_iter().enumerate() {
        let pairs = [_mm_cvtsi128_si64(part), _mm_extract_epi64::<1>(part)];
        for (j, pair) in pairs.into_iter().enumerate() {
            indices[4 * k + 2 * j] = pair as u32 as usize;
            indices[4 * k + 2 * j + 1] = (pair as u64 >> 32) as usize;
        }
    }
    indices
}

/// Gathers eight pairs of words: the first words and the second words.
#[inline(always)]
unsafe fn gather(from: *const f64, at: __m256i) -> (__m256i, __m256i) {
    let at = indices(at);
    // Lanes 0, 1, 4, 5 and 2, 3, 6, 7, so that taking every other word puts them in order.
    let first =
        _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(two(from, &at)), two(from, &at[4..]));
    let second = _mm256_insertf128_ps::<1>(
        _mm256_castps128_ps256(two(from, &at[2..])),
        two(from, &at[6..]),
    );
    (
        _mm256_castps_si256(_mm256_shuffle_ps::<0b10_00_10_00>(first, second)),
        _mm256_castps_si256(_mm256_shuffle_ps::<0b11_01_11_01>(first, second)),
    )
}

#[inline(always)]
unsafe fn two(from: *const f64, at: &[usize]) -> __m128 {
    let low = _mm_load_sd(from.add(at[0]));
    _mm_castpd_ps(_mm_loadh_pd(low, from.add(at[1])))
}

/// Loads the quadruples of two lanes, four lanes apart.
#[inline(always)]
unsafe fn load_two(from: *const [u32; 4], at: &[usize]) -> __m256 {
    let first = _mm_load_ps(from.add(at[0]).cast());
    let second = _mm_load_ps(from.add(at[4]).cast());
    _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(first), second)
}

/// Returns the maximum of eight numbers.
#[inline(always)]
pub(super) unsafe fn max_lane(a: __m256) -> f32 {
    let four = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps::<1>(a));
    let two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)))
}

/// Puts the larger of lane `k` and lane `at[k]` into the lower of both lanes. `UPPER` has the bits of the upper
/// ones.
#[inline(always)]
unsafe fn exchange<const UPPER: i32>(a: __m256, at: [i32; 8]) -> __m256 {
    let at = _mm256_loadu_si256(at.as_ptr().cast());
    let b = _mm256_permutevar8x32_ps(a, at);
    _mm256_blend_ps::<UPPER>(_mm256_max_ps(a, b), _mm256_min_ps(a, b))
}

impl Eight for Avx2 {
    #[inline(always)]
    unsafe fn sort_descending(a: __m256) -> __m256 {
        // The network of 19 exchanges in 6 layers (D. E. Knuth, The Art of Computer Programming 3, 5.3.4).
        let a = exchange::<0b1100_1100>(a, [2, 3, 0, 1, 6, 7, 4, 5]);
        let a = exchange::<0b1111_0000>(a, [4, 5, 6, 7, 0, 1, 2, 3]);
        let a = exchange::<0b1010_1010>(a, [1, 0, 3, 2, 5, 4, 7, 6]);
        let a = exchange::<0b0011_0000>(a, [0, 1, 4, 5, 2, 3, 6, 7]);
        let a = exchange::<0b0101_0000>(a, [0, 4, 2, 6, 1, 5, 3, 7]);
        exchange::<0b0101_0100>(a, [0, 2, 1, 4, 3, 6, 5, 7])
    }

    #[inline(always)]
    unsafe fn permute_u(a: __m256i, at: __m256i) -> __m256i {
        _mm256_permutevar8x32_epi32(a, at)
    }

    #[inline(always)]
    unsafe fn and_not_u(a: __m256i, b: __m256i) -> __m256i {
        _mm256_andnot_si256(b, a)
    }
}

impl Simd for Avx2 {
    const LANES: usize = 8;
    type F = __m256;
    type U = __m256i;
    type M = Mask;

    #[inline(always)]
    unsafe fn splat(x: f32) -> __m256 {
        _mm256_set1_ps(x)
    }
    #[inline(always)]
    unsafe fn load(from: *const f32) -> __m256 {
        _mm256_loadu_ps(from)
    }
    #[inline(always)]
    unsafe fn add(a: __m256, b: __m256) -> __m256 {
        _mm256_add_ps(a, b)
    }
    #[inline(always)]
    unsafe fn sub(a: __m256, b: __m256) -> __m256 {
        _mm256_sub_ps(a, b)
    }
    #[inline(always)]
    unsafe fn mul(a: __m256, b: __m256) -> __m256 {
        _mm256_mul_ps(a, b)
    }
    #[inline(always)]
    unsafe fn div(a: __m256, b: __m256) -> __m256 {
        _mm256_div_ps(a, b)
    }
    #[inline(always)]
    unsafe fn sqrt(a: __m256) -> __m256 {
        _mm256_sqrt_ps(a)
    }
    #[inline(always)]
    unsafe fn mul_add(a: __m256, b: __m256, c: __m256) -> __m256 {
        _mm256_fmadd_ps(a, b, c)
    }
    #[inline(always)]
    unsafe fn sub_mul(c: __m256, a: __m256, b: __m256) -> __m256 {
        _mm256_fnmadd_ps(a, b, c)
    }
    #[inline(always)]
    unsafe fn min(a: __m256, b: __m256) -> __m256 {
        _mm256_min_ps(a, b)
    }
    #[inline(always)]
    unsafe fn max(a: __m256, b: __m256) -> __m256 {
        _mm256_max_ps(a, b)
    }
    #[inline(always)]
    unsafe fn max_lane(a: __m256) -> f32 {
        max_lane(a)
    }
    #[inline(always)]
    unsafe fn abs(a: __m256) -> __m256 {
        _mm256_andnot_ps(_mm256_set1_ps(-0.0), a)
    }
    #[inline(always)]
    unsafe fn xor_sign(a: __m256, by: __m256) -> __m256 {
        let sign = _mm256_set1_ps(-0.0);
        _mm256_xor_ps(a, _mm256_and_ps(by, sign))
    }
    #[inline(always)]
    unsafe fn lt(a: __m256, b: __m256) -> __m256i {
        _mm256_castps_si256(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b))
    }
    #[inline(always)]
    unsafe fn le(a: __m256, b: __m256) -> __m256i {
        _mm256_castps_si256(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b))
    }
    #[inline(always)]
    unsafe fn select(mask: __m256i, a: __m256, b: __m256) -> __m256 {
        _mm256_blendv_ps(b, a, _mm256_castsi256_ps(mask))
    }

    #[inline(always)]
    unsafe fn splat_u(x: u32) -> __m256i {
        _mm256_set1_epi32(x as i32)
    }
    #[inline(always)]
    unsafe fn load_u(from: *const u32) -> __m256i {
        _mm256_loadu_si256(from.cast())
    }
    #[inline(always)]
    unsafe fn store_u(to: *mut u32, x: __m256i) {
        _mm256_storeu_si256(to.cast(), x);
    }
    #[inline(always)]
    unsafe fn add_u(a: __m256i, b: __m256i) -> __m256i {
        _mm256_add_epi32(a, b)
    }
    #[inline(always)]
    unsafe fn sub_u(a: __m256i, b: __m256i) -> __m256i {
        _mm256_sub_epi32(a, b)
    }
    #[inline(always)]
    unsafe fn xor_u(a: __m256i, b: __m256i) -> __m256i {
        _mm256_xor_si256(a, b)
    }
    #[inline(always)]
    unsafe fn shr_u<const BITS: u32>(a: __m256i) -> __m256i {
        _mm256_srl_epi32(a, _mm_cvtsi32_si128(BITS as i32))
    }
    #[inline(always)]
    unsafe fn test_bit_u<const BIT: u32>(a: __m256i) -> __m256i {
        _mm256_sll_epi32(a, _mm_cvtsi32_si128(31 - BIT as i32))
    }
    #[inline(always)]
    unsafe fn test_bit_pair_u<const BIT: u32>(a: __m256i, by: __m256i) -> (__m256i, __m256i) {
        let to_sign = _mm256_sub_epi32(Self::splat_u(31 - BIT), by);
        let other = _mm256_add_epi32(Self::splat_u(30 - BIT), by);
        (_mm256_sllv_epi32(a, to_sign), _mm256_sllv_epi32(a, other))
    }
    #[inline(always)]
    unsafe fn eq_u(a: __m256i, b: __m256i) -> __m256i {
        _mm256_cmpeq_epi32(a, b)
    }
    #[inline(always)]
    unsafe fn select_u(mask: __m256i, a: __m256i, b: __m256i) -> __m256i {
        Self::bits_of(Self::select(mask, Self::from_bits(a), Self::from_bits(b)))
    }
    /// Hides from the compiler where the value comes from. It turns "load, select, store" into a masked store,
    /// which Zen 2 and Zen 3 execute as microcode.
    #[inline(always)]
    unsafe fn replace_u(mask: __m256i, new: __m256i, old: __m256i) -> __m256i {
        opaque(Self::select_u(mask, new, old))
    }
    #[inline(always)]
    unsafe fn bits_of(a: __m256) -> __m256i {
        _mm256_castps_si256(a)
    }
    #[inline(always)]
    unsafe fn from_bits(a: __m256i) -> __m256 {
        _mm256_castsi256_ps(a)
    }

    #[inline(always)]
    unsafe fn mask_bits(mask: __m256i) -> u32 {
        _mm256_movemask_ps(_mm256_castsi256_ps(mask)) as u32
    }
    #[inline(always)]
    unsafe fn mask_from_bits(bits: u32) -> __m256i {
        let bit_of_lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        let bits = _mm256_and_si256(_mm256_set1_epi32(bits as i32), bit_of_lane);
        _mm256_cmpeq_epi32(bits, bit_of_lane)
    }
    #[inline(always)]
    unsafe fn and(a: __m256i, b: __m256i) -> __m256i {
        _mm256_and_si256(a, b)
    }
    #[inline(always)]
    unsafe fn or(a: __m256i, b: __m256i) -> __m256i {
        _mm256_or_si256(a, b)
    }
    #[inline(always)]
    unsafe fn and_not(a: __m256i, b: __m256i) -> __m256i {
        _mm256_andnot_si256(b, a)
    }

    #[inline(always)]
    unsafe fn gather_pairs(from: *const [u32; 2], at: __m256i) -> (__m256i, __m256i) {
        gather(from.cast(), at)
    }

    #[inline(always)]
    unsafe fn gather_quads(from: *const [u32; 4], at: __m256i) -> [__m256i; 3] {
        let at = indices(at);
        let (a, b) = (load_two(from, &at), load_two(from, &at[1..]));
        let (c, d) = (load_two(from, &at[2..]), load_two(from, &at[3..]));
        let low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b));
        let high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
        let other_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
        let other_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
        [
            _mm256_castpd_si256(_mm256_unpacklo_pd(low, other_low)),
            _mm256_castpd_si256(_mm256_unpackhi_pd(low, other_low)),
            _mm256_castpd_si256(_mm256_unpacklo_pd(high, other_high)),
        ]
    }

    #[inline(always)]
    unsafe fn compress_store(to: *mut u32, mask: __m256i, x: __m256i) {
        let order = _mm_loadl_epi64(ORDERS[Self::mask_bits(mask) as usize].as_ptr().cast());
        let packed = _mm256_permutevar8x32_epi32(x, _mm256_cvtepu8_epi32(order));
        _mm256_storeu_si256(to.cast(), packed);
    }

    #[inline(always)]
    unsafe fn expand_load(mask: __m256i, from: *const u32, x: __m256i) -> __m256i {
        let ranks = _mm_loadl_epi64(RANKS[Self::mask_bits(mask) as usize].as_ptr().cast());
        let packed = _mm256_loadu_si256(from.cast());
        let spread = _mm256_permutevar8x32_epi32(packed, _mm256_cvtepu8_epi32(ranks));
        Self::replace_u(mask, spread, x)
    }

    #[inline(always)]
    unsafe fn load_transposed(from: *const f32) -> [__m256; ROW] {
        let mut rows = [_mm256_setzero_ps(); ROW];
        for (k, row) in rows.iter_mut().enumerate() {
            *row = _mm256_load_ps(from.add(k * ROW_STRIDE));
        }
        transposed(rows)
    }

    #[inline(always)]
    unsafe fn store_transposed(to: *mut f32, columns: [__m256; ROW]) {
        for (k, row) in transposed(columns).into_iter().enumerate() {
            _mm256_store_ps(to.add(k * ROW_STRIDE), row);
        }
    }

    #[inline(always)]
    unsafe fn scale_to_f32(
        numbers: &[f64; ROW],
        [scale, shift, minimum]: &[[f64; ROW]; 3],
    ) -> [f32; ROW] {
        let mut narrow = [0.0; ROW];
        for at in [0, 4] {
            let scale = _mm256_loadu_pd(scale.as_ptr().add(at));
            let scaled = _mm256_mul_pd(_mm256_loadu_pd(numbers.as_ptr().add(at)), scale);
            let moved = _mm256_sub_pd(scaled, _mm256_loadu_pd(shift.as_ptr().add(at)));
            let moved = _mm256_max_pd(_mm256_loadu_pd(minimum.as_ptr().add(at)), moved);
            _mm_storeu_ps(narrow.as_mut_ptr().add(at), _mm256_cvtpd_ps(moved));
        }
        narrow
    }
}

/// Returns columns 0 and 4, 1 and 5, 2 and 6, 3 and 7 of four rows.
#[inline(always)]
unsafe fn four_rows(rows: &[__m256]) -> [__m256; 4] {
    let a = _mm256_castps_pd(_mm256_unpacklo_ps(rows[0], rows[1]));
    let b = _mm256_castps_pd(_mm256_unpackhi_ps(rows[0], rows[1]));
    let c = _mm256_castps_pd(_mm256_unpacklo_ps(rows[2], rows[3]));
    let d = _mm256_castps_pd(_mm256_unpackhi_ps(rows[2], rows[3]));
    [
        _mm256_castpd_ps(_mm256_unpacklo_pd(a, c)),
        _mm256_castpd_ps(_mm256_unpackhi_pd(a, c)),
        _mm256_castpd_ps(_mm256_unpacklo_pd(b, d)),
        _mm256_castpd_ps(_mm256_unpackhi_pd(b, d)),
    ]
}

/// Transposes eight rows of eight numbers.
#[inline(always)]
unsafe fn transposed(rows: [__m256; 8]) -> [__m256; 8] {
    let (first, second) = (four_rows(&rows[..4]), four_rows(&rows[4..]));
    let mut columns = rows;
    for k in 0..4 {
        columns[k] = _mm256_permute2f128_ps::<0x20>(first[k], second[k]);
        columns[k + 4] = _mm256_permute2f128_ps::<0x31>(first[k], second[k]);
    }
    columns
}

/// For each mask, its lanes in ascending order.
static ORDERS: [[u8; 8]; 256] = {
    let mut orders = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                orders[mask][count] = lane as u8;
                count += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    orders
};

/// For each mask and lane, the number of lower lanes in the mask.
static RANKS: [[u8; 8]; 256] = {
    let mut ranks = [[0; 8]; 256];
    let mut mask = 0_usize;
    while mask < 256 {
        let mut lane = 0;
        while lane < 8 {
            ranks[mask][lane] = (mask & ((1 << lane) - 1)).count_ones() as u8;
            lane += 1;
        }
        mask += 1;
    }
    ranks
};
