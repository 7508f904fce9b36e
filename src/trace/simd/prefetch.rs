//! Prefetching.
#![allow(unsafe_op_in_unsafe_fn)] // the contract covers every line

/// Prefetches all cache lines of a value. The address need not be valid.
#[inline(always)]
pub(super) unsafe fn prefetch<T>(address: *const T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let address = address.cast::<i8>();
        let mut line = 0;
        while line < size_of::<T>() {
            _mm_prefetch::<_MM_HINT_T0>(address.add(line));
            line += 64;
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}
