//! The queue of leaves that lanes have reached.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::Simd;
use super::prefetch::prefetch;

/// A leaf whose blocks remain to be tested against a lane's ray.
#[derive(Clone, Copy)]
pub(super) struct Leaf {
    pub(super) lane: u32,
    /// The next block, and the number of remaining blocks including it.
    pub(super) block: u32,
    pub(super) left: u32,
}

/// Leaves of at most `N` lanes, less a vector.
pub(super) struct Leaves<const N: usize> {
    lanes: [u32; N],
    blocks: [u32; N],
    left: [u32; N],
    count: usize,
    /// The number of leaves whose block is prefetched.
    prefetched: usize,
}

impl<const N: usize> Leaves<N> {
    pub(super) fn new() -> Self {
        Leaves {
            lanes: [0; N],
            blocks: [0; N],
            left: [0; N],
            count: 0,
            prefetched: 0,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Appends the leaves of the lanes in `mask`.
    ///
    /// # Safety
    /// As [`Simd`]; a lane has at most one leaf in the queue, and there is room for a vector behind the
    /// leaves of all lanes.
    #[inline(always)]
    pub(super) unsafe fn push<S: Simd>(&mut self, mask: S::M, lane: S::U, block: S::U, left: S::U) {
        let to = [
            self.lanes.as_mut_ptr().add(self.count),
            self.blocks.as_mut_ptr().add(self.count),
            self.left.as_mut_ptr().add(self.count),
        ];
        S::compress_store_few(to, mask, [lane, block, left]);
        self.count += S::mask_bits(mask).count_ones() as usize;
    }

    /// Appends a leaf if `is_added`. Branchless: it is stored in any case.
    ///
    /// # Safety
    /// A lane has at most one leaf in the queue.
    #[inline(always)]
    pub(super) unsafe fn push_one(&mut self, is_added: bool, leaf: Leaf) {
        self.set(self.count, leaf);
        self.count += usize::from(is_added);
    }

    /// Prefetches the block of the next leaf. Branchless: where all leaves are prefetched it prefetches
    /// some block again.
    ///
    /// # Safety
    /// `all` points to the blocks.
    #[inline(always)]
    pub(super) unsafe fn prefetch_next<B>(&mut self, all: *const B) {
        prefetch(all.add(*self.blocks.get_unchecked(self.prefetched) as usize));
        self.prefetched += usize::from(self.prefetched < self.count);
    }

    /// Prefetches the blocks of all leaves that remain to be prefetched.
    ///
    /// # Safety
    /// As above.
    #[inline(always)]
    pub(super) unsafe fn prefetch_all<B>(&mut self, all: *const B) {
        while self.prefetched < self.count {
            self.prefetch_next(all);
        }
        self.prefetched = 0;
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

    /// Replaces a leaf, or writes one behind the last.
    ///
    /// # Safety
    /// As above.
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
