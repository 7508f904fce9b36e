//! Arithmetic on SIMD vectors: one trait, [`Simd`], and one file per instruction set.

#[cfg(target_arch = "x86_64")]
pub(super) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(super) mod avx512;
pub(super) mod portable;
mod vector;

pub(super) use vector::{Eight, ROW, ROW_STRIDE, Simd, WIDEST};
