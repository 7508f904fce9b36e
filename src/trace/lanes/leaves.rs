//! Leaves that lanes have come to, in the order in which they came.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::simd::Simd;

/// A leaf with blocks that are still to be held against a lane's ray.
#[derive(Clone, Copy)]
pub(super) struct Leaf {
    pub(super) lane: u32,
    /// The next block, and how many there are with it.
    pub(super) block: u32,
    pub(super) left: u32,
}

/// Leaves of at most `N` lanes, less a vector.
pub(super) struct Leaves<const N: usize> {
    lanes: [u32; N],
    blocks: [u32; N],
    left: [u32; N],
    count: usize,
    /// How many of them were asked for.
    asked: usize,
}

impl<const N: usize> Leaves<N> {
    pub(super) fn new() -> Self {
        Leaves {
            lanes: [0; N],
            blocks: [0; N],
            left: [0; N],
            count: 0,
            asked: 0,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Adds the leaves of the lanes in `mask`.
    ///
    /// # Safety
    /// As [`Simd`]; a lane has one leaf at a time, and there is room for a vector beyond all lanes.
    #[inline(always)]
    pub(super) unsafe fn push<S: Simd>(&mut self, mask: S::M, lane: S::U, block: S::U, left: S::U) {
        let to = [
            self.lanes.as_mut_ptr().add(self.count),
            self.blocks.as_mut_ptr().add(self.count),
            self.left.as_mut_ptr().add(self.count),
        ];
        S::append_few(to, mask, [lane, block, left]);
        self.count += S::bits(mask).count_ones() as usize;
    }

    /// Asks for the block of the next leaf, or again for the last where all were asked for: nothing
    /// predicts whether there is one.
    ///
    /// # Safety
    /// `all` are the blocks.
    #[inline(always)]
    pub(super) unsafe fn ask<B>(&mut self, all: *const B) {
        prefetch(all.add(*self.blocks.get_unchecked(self.asked) as usize));
        self.asked += usize::from(self.asked < self.count);
    }

    /// Asks for the blocks of all leaves that were not asked for yet.
    ///
    /// # Safety
    /// Likewise.
    #[inline(always)]
    pub(super) unsafe fn ask_all<B>(&mut self, all: *const B) {
        while self.asked < self.count {
            self.ask(all);
        }
        self.asked = 0;
    }

    /// # Safety
    /// There are more than `k`.
    #[inline(always)]
    pub(super) unsafe fn get(&self, k: usize) -> Leaf {
        Leaf {
            lane: *self.lanes.get_unchecked(k),
            block: *self.blocks.get_unchecked(k),
            left: *self.left.get_unchecked(k),
        }
    }

    /// Puts a leaf in the place of one that was there.
    ///
    /// # Safety
    /// Likewise.
    #[inline(always)]
    pub(super) unsafe fn set(&mut self, k: usize, leaf: Leaf) {
        *self.lanes.get_unchecked_mut(k) = leaf.lane;
        *self.blocks.get_unchecked_mut(k) = leaf.block;
        *self.left.get_unchecked_mut(k) = leaf.left;
    }

    /// Keeps the first `count`.
    #[inline(always)]
    pub(super) fn truncate(&mut self, count: usize) {
        self.count = count;
    }
}

/// Asks for a block or node before it is needed.
#[inline(always)]
pub(super) unsafe fn prefetch<B>(block: *const B) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let block = block.cast::<i8>();
        let mut line = 0;
        while line < size_of::<B>() {
            _mm_prefetch::<_MM_HINT_T0>(block.add(line));
            line += 64;
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = block;
}
