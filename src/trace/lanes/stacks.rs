//! The stacks of all lanes: nodes that rays visit later.
//!
//! Few lanes leave a node behind in a step. So what they leave is only noted, one after the other in
//! whole vectors, and brought to the stacks when lanes are about to take something off.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::simd::Simd;

/// A node that waits for its turn, and where on the ray its cell lies.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
pub(super) struct Waiting {
    pub(super) node: u32,
    pub(super) t_enter: f32,
    pub(super) t_exit: f32,
}

#[derive(Default)]
pub(super) struct Stacks {
    /// A lane's stack follows that of the lane before.
    entries: Vec<Waiting>,
    /// Entries of a lane.
    depth: usize,
    /// What is noted, number by number: the place on the stacks, the node, and where its cell begins
    /// and ends.
    notes: Vec<u32>,
    /// Numbers of a column of them.
    column: usize,
}

/// Notes of nodes that are to be brought to the stacks.
pub(super) struct Notes {
    columns: [*mut u32; 4],
    count: usize,
}

impl Stacks {
    /// Room for so many lanes, with so many nodes waiting in each.
    pub(super) fn reserve(&mut self, lanes: usize, depth: usize) {
        self.depth = depth;
        self.entries.resize(lanes * depth, Waiting::default());
        // Between two calls of `settle`, a lane only goes down. Vectors are written whole.
        self.column = lanes * (depth + 1);
        self.notes.resize(4 * self.column, 0);
    }

    /// No notes so far. They are of no use after the next [`Stacks::reserve`].
    pub(super) fn notes(&mut self) -> Notes {
        let first = self.notes.as_mut_ptr();
        let column = self.column;
        Notes {
            columns: [0, 1, 2, 3].map(|k| first.wrapping_add(k * column)),
            count: 0,
        }
    }

    /// Where a lane's stack begins.
    pub(super) fn bottom(&self, lane: usize) -> u32 {
        (lane * self.depth) as u32
    }

    /// Brings what was noted to the stacks.
    ///
    /// # Safety
    /// As [`Notes::push`].
    #[inline(always)]
    pub(super) unsafe fn settle(&mut self, notes: &mut Notes) {
        let [at, node, t_enter, t_exit] = notes.columns;
        for k in 0..notes.count {
            let place = *at.add(k) as usize;
            *self.entries.get_unchecked_mut(place) = Waiting {
                node: *node.add(k),
                t_enter: f32::from_bits(*t_enter.add(k)),
                t_exit: f32::from_bits(*t_exit.add(k)),
            };
        }
        notes.count = 0;
    }

    /// The nodes at these places of the stacks.
    ///
    /// # Safety
    /// As [`Notes::push`].
    #[inline(always)]
    pub(super) unsafe fn at<S: Simd>(&self, places: S::U) -> (S::U, S::F, S::F) {
        S::pop(self.entries.as_ptr(), places)
    }
}

impl Notes {
    /// Notes nodes of the lanes in `mask`, for these places on the stacks.
    ///
    /// # Safety
    /// As [`Simd`]; these are the notes of stacks whose [`Stacks::reserve`] was called for these lanes, and
    /// no more nodes are pushed than it was told.
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
        S::append_few(to, mask, columns);
        self.count += S::bits(mask).count_ones() as usize;
    }
}
