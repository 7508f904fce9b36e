//! The traversal stacks of all lanes.
//!
//! Few lanes push a node in a step. So pushes are appended to a buffer as whole vectors, and the buffer
//! is flushed to the stacks before lanes pop.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use crate::trace::simd::arithmetic::Simd;

/// A pending node, and the interval of the ray within its cell. Sized and aligned for
/// [`Simd::gather_quads`].
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
struct PendingNode {
    node: u32,
    t_enter: f32,
    t_exit: f32,
}

#[derive(Default)]
pub(crate) struct Stacks {
    /// The stacks of all lanes, one after the other.
    entries: Vec<PendingNode>,
    /// Entries per lane.
    depth: usize,
    /// Memory of the [`PushBuffer`]: columns of indices of entries, of nodes, and of the ends of their
    /// intervals.
    pushes: Vec<u32>,
    /// Numbers per column.
    column: usize,
}

/// Pushes that are not on the stacks yet.
pub(super) struct PushBuffer {
    columns: [*mut u32; 4],
    count: usize,
}

impl Stacks {
    /// Reserves memory for this many lanes, with this many pending nodes each.
    pub(super) fn reserve(&mut self, lanes: usize, depth: usize) {
        self.depth = depth;
        self.entries.resize(lanes * depth, PendingNode::default());
        // A lane pushes at most one node per level between two flushes. Vectors are stored whole.
        self.column = lanes * (depth + 1);
        self.pushes.resize(4 * self.column, 0);
    }

    /// Returns an empty buffer, valid until the next [`Stacks::reserve`].
    pub(super) fn push_buffer(&mut self) -> PushBuffer {
        let first = self.pushes.as_mut_ptr();
        let column = self.column;
        PushBuffer {
            columns: [0, 1, 2, 3].map(|k| first.wrapping_add(k * column)),
            count: 0,
        }
    }

    /// Returns the index of a lane's first entry.
    pub(super) fn bottom(&self, lane: usize) -> u32 {
        (lane * self.depth) as u32
    }

    /// Moves all pushes to the stacks.
    ///
    /// # Safety
    /// As [`PushBuffer::push`].
    #[inline(always)]
    pub(super) unsafe fn flush(&mut self, pushes: &mut PushBuffer) {
        let [at, node, t_enter, t_exit] = pushes.columns;
        for k in 0..pushes.count {
            let place = *at.add(k) as usize;
            *self.entries.get_unchecked_mut(place) = PendingNode {
                node: *node.add(k),
                t_enter: f32::from_bits(*t_enter.add(k)),
                t_exit: f32::from_bits(*t_exit.add(k)),
            };
        }
        pushes.count = 0;
    }

    /// Returns the nodes and intervals of these entries.
    ///
    /// # Safety
    /// As [`PushBuffer::push`].
    #[inline(always)]
    pub(super) unsafe fn get<S: Simd>(&self, entries: S::U) -> (S::U, S::F, S::F) {
        let [node, t_enter, t_exit] = S::gather_quads(self.entries.as_ptr().cast(), entries);
        (node, S::from_bits(t_enter), S::from_bits(t_exit))
    }
}

impl PushBuffer {
    /// Appends the nodes of the lanes in `mask`, to be stored at these entries.
    ///
    /// # Safety
    /// As [`Simd`]; the buffer is that of stacks reserved for these lanes, and no lane has more pending
    /// nodes than was reserved.
    #[inline(always)]
    pub(super) unsafe fn push<S: Simd>(
        &mut self,
        mask: S::M,
        at: S::U,
        node: S::U,
        t_enter: S::F,
        t_exit: S::F,
    ) {
        let columns = [at, node, S::bits_of(t_enter), S::bits_of(t_exit)];
        let [a, b, c, d] = self.columns;
        let to = [
            a.add(self.count),
            b.add(self.count),
            c.add(self.count),
            d.add(self.count),
        ];
        S::compress_store_few(to, mask, columns);
        self.count += S::mask_bits(mask).count_ones() as usize;
    }
}
