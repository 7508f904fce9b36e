//! Eight lanes in portable Rust, for processors without code of their own.

use super::vector::{Eight, ROW, ROW_STRIDE, Simd};

#[derive(Clone, Copy)]
pub(crate) struct Portable;

const LANES: usize = 8;

#[inline(always)]
fn map<A: Copy, B: Copy, C>(a: [A; LANES], b: [B; LANES], f: impl Fn(A, B) -> C) -> [C; LANES] {
    std::array::from_fn(|k| f(a[k], b[k]))
}

#[inline(always)]
fn compare<A: Copy>(a: [A; LANES], b: [A; LANES], f: impl Fn(A, A) -> bool) -> u32 {
    (0..LANES).fold(0, |mask, k| mask | u32::from(f(a[k], b[k])) << k)
}

#[inline(always)]
fn blend<A: Copy>(mask: u32, a: [A; LANES], b: [A; LANES]) -> [A; LANES] {
    std::array::from_fn(|k| if mask >> k & 1 == 1 { a[k] } else { b[k] })
}

impl Eight for Portable {
    #[inline(always)]
    unsafe fn sort_descending(mut a: Self::F) -> Self::F {
        a.sort_unstable_by(|a, b| b.total_cmp(a));
        a
    }

    #[inline(always)]
    unsafe fn permute_u(a: Self::U, at: Self::U) -> Self::U {
        at.map(|k| a[k as usize % LANES])
    }

    #[inline(always)]
    unsafe fn and_not_u(a: Self::U, b: Self::U) -> Self::U {
        map(a, b, |a, b| a & !b)
    }
}

impl Simd for Portable {
    const LANES: usize = LANES;
    type F = [f32; LANES];
    type U = [u32; LANES];
    type M = u32;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self::F {
        [x; LANES]
    }
    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self::F {
        // SAFETY: there are as many elements as lanes.
        unsafe { from.cast::<Self::F>().read_unaligned() }
    }
    #[inline(always)]
    unsafe fn add(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| a + b)
    }
    #[inline(always)]
    unsafe fn sub(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| a - b)
    }
    #[inline(always)]
    unsafe fn mul(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| a * b)
    }
    #[inline(always)]
    unsafe fn div(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| a / b)
    }
    #[inline(always)]
    unsafe fn sqrt(a: Self::F) -> Self::F {
        a.map(f32::sqrt)
    }
    #[inline(always)]
    unsafe fn mul_add(a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        std::array::from_fn(|k| a[k] * b[k] + c[k])
    }
    #[inline(always)]
    unsafe fn sub_mul(c: Self::F, a: Self::F, b: Self::F) -> Self::F {
        std::array::from_fn(|k| c[k] - a[k] * b[k])
    }
    #[inline(always)]
    unsafe fn min(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    unsafe fn max(a: Self::F, b: Self::F) -> Self::F {
        map(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    unsafe fn max_lane(a: Self::F) -> f32 {
        a.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }
    #[inline(always)]
    unsafe fn abs(a: Self::F) -> Self::F {
        a.map(f32::abs)
    }
    #[inline(always)]
    unsafe fn xor_sign(a: Self::F, by: Self::F) -> Self::F {
        std::array::from_fn(|k| f32::from_bits(a[k].to_bits() ^ by[k].to_bits() & 0x8000_0000))
    }
    #[inline(always)]
    unsafe fn lt(a: Self::F, b: Self::F) -> u32 {
        compare(a, b, |a, b| a < b)
    }
    #[inline(always)]
    unsafe fn le(a: Self::F, b: Self::F) -> u32 {
        compare(a, b, |a, b| a <= b)
    }
    #[inline(always)]
    unsafe fn select(mask: u32, a: Self::F, b: Self::F) -> Self::F {
        blend(mask, a, b)
    }

    #[inline(always)]
    unsafe fn splat_u(x: u32) -> Self::U {
        [x; LANES]
    }
    #[inline(always)]
    unsafe fn load_u(from: *const u32) -> Self::U {
        // SAFETY: there are as many elements as lanes.
        unsafe { from.cast::<Self::U>().read_unaligned() }
    }
    #[inline(always)]
    unsafe fn store_u(to: *mut u32, x: Self::U) {
        // SAFETY: as above.
        unsafe { to.cast::<Self::U>().write_unaligned(x) }
    }
    #[inline(always)]
    unsafe fn add_u(a: Self::U, b: Self::U) -> Self::U {
        map(a, b, u32::wrapping_add)
    }
    #[inline(always)]
    unsafe fn sub_u(a: Self::U, b: Self::U) -> Self::U {
        map(a, b, u32::wrapping_sub)
    }
    #[inline(always)]
    unsafe fn xor_u(a: Self::U, b: Self::U) -> Self::U {
        map(a, b, |a, b| a ^ b)
    }
    #[inline(always)]
    unsafe fn shr_u<const BITS: u32>(a: Self::U) -> Self::U {
        a.map(|a| a >> BITS)
    }
    #[inline(always)]
    unsafe fn test_bit_u<const BIT: u32>(a: Self::U) -> u32 {
        compare(a, a, |a, _| a >> BIT & 1 != 0)
    }
    #[inline(always)]
    unsafe fn test_bit_pair_u<const BIT: u32>(a: Self::U, by: Self::U) -> (u32, u32) {
        (
            compare(a, by, |a, by| a >> (BIT + by) & 1 != 0),
            compare(a, by, |a, by| a >> (BIT + 1 - by) & 1 != 0),
        )
    }
    #[inline(always)]
    unsafe fn eq_u(a: Self::U, b: Self::U) -> u32 {
        compare(a, b, |a, b| a == b)
    }
    #[inline(always)]
    unsafe fn select_u(mask: u32, a: Self::U, b: Self::U) -> Self::U {
        blend(mask, a, b)
    }
    #[inline(always)]
    unsafe fn bits_of(a: Self::F) -> Self::U {
        a.map(f32::to_bits)
    }
    #[inline(always)]
    unsafe fn from_bits(a: Self::U) -> Self::F {
        a.map(f32::from_bits)
    }

    #[inline(always)]
    unsafe fn mask_bits(mask: u32) -> u32 {
        mask
    }
    #[inline(always)]
    unsafe fn mask_from_bits(bits: u32) -> u32 {
        bits
    }
    #[inline(always)]
    unsafe fn and(a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    unsafe fn or(a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    unsafe fn and_not(a: u32, b: u32) -> u32 {
        a & !b
    }

    #[inline(always)]
    unsafe fn gather_pairs(from: *const [u32; 2], at: Self::U) -> (Self::U, Self::U) {
        // SAFETY: the indices are valid.
        let pairs = at.map(|at| unsafe { *from.add(at as usize) });
        (pairs.map(|[x, _]| x), pairs.map(|[_, y]| y))
    }

    #[inline(always)]
    unsafe fn gather_quads(from: *const [u32; 4], at: Self::U) -> [Self::U; 3] {
        // SAFETY: as above. The fourth word may be uninitialized.
        let quads = at.map(|at| unsafe { *from.add(at as usize).cast::<[u32; 3]>() });
        [0, 1, 2].map(|k| quads.map(|quad| quad[k]))
    }

    #[inline(always)]
    unsafe fn compress_store(to: *mut u32, mask: u32, x: Self::U) {
        let mut count = 0;
        for (k, x) in x.into_iter().enumerate() {
            // SAFETY: there is room for all lanes.
            unsafe { *to.add(count) = x };
            count += (mask >> k & 1) as usize;
        }
    }

    #[inline(always)]
    unsafe fn expand_load(mask: u32, from: *const u32, x: Self::U) -> Self::U {
        let mut next = 0;
        let mut expanded = x;
        for (k, x) in expanded.iter_mut().enumerate() {
            if mask >> k & 1 == 1 {
                // SAFETY: there are as many words as lanes in the mask.
                *x = unsafe { *from.add(next) };
                next += 1;
            }
        }
        expanded
    }

    #[inline(always)]
    unsafe fn load_transposed(from: *const f32) -> [Self::F; ROW] {
        // SAFETY: there is a row for every lane.
        let number = |lane: usize, k: usize| unsafe { *from.add(lane * ROW_STRIDE + k) };
        std::array::from_fn(|k| std::array::from_fn(|lane| number(lane, k)))
    }

    #[inline(always)]
    unsafe fn store_transposed(to: *mut f32, columns: [Self::F; ROW]) {
        for (k, column) in columns.into_iter().enumerate() {
            for (lane, x) in column.into_iter().enumerate() {
                // SAFETY: as above.
                unsafe { *to.add(lane * ROW_STRIDE + k) = x };
            }
        }
    }

    #[inline(always)]
    unsafe fn scale_to_f32(
        numbers: &[f64; ROW],
        [scale, shift, minimum]: &[[f64; ROW]; 3],
    ) -> [f32; ROW] {
        std::array::from_fn(|k| {
            let moved = numbers[k] * scale[k] - shift[k];
            (if minimum[k] > moved {
                minimum[k]
            } else {
                moved
            }) as f32
        })
    }
}
