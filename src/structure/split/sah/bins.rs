//! Bin limits as candidate planes, for cells with many objects.

use super::cost::Plane;
use super::extents::{Extents, Scratch, Source};
use super::grid::{BINS, Grid, count_bins};
use crate::geometry::Axis;
use crate::structure::split::rule::Cell;
use rayon::prelude::*;

/// The number of objects that begin and end in each bin along each axis.
pub(super) struct Bins {
    grids: [Grid; 3],
    counts: Counts,
}

#[derive(Clone)]
struct Counts {
    objects: usize,
    begins: [[u32; BINS]; 3],
    ends: [[u32; BINS]; 3],
}

/// Objects per task.
const CHUNK: usize = 1 << 14;

/// Objects whose extents are computed at once.
const BATCH: usize = 1 << 9;

impl Bins {
    /// Counts the objects of a cell; incomplete if the build is cancelled.
    pub(super) fn of(cell: &Cell<'_>, clip: bool) -> Self {
        let grids = Axis::ALL.map(|axis| Grid::new(cell.local[axis.index()], BINS));
        let source = Source::new(cell, clip);
        let count = |objects: &[u32]| {
            let mut counts = Counts::default();
            if !cell.progress.is_cancelled() {
                let (mut extents, mut scratch) = (Extents::default(), Scratch::default());
                for objects in objects.chunks(BATCH) {
                    extents.fill(&source, objects);
                    counts.add(&grids, &extents, &mut scratch);
                }
            }
            counts
        };
        let counts = cell
            .inside
            .par_chunks(CHUNK)
            .map(count)
            .reduce(Counts::default, Counts::plus);
        Bins { grids, counts }
    }

    /// Returns the number of objects that overlap the cell.
    pub(super) fn objects(&self) -> usize {
        self.counts.objects
    }

    /// Returns the limits between bins, in ascending order.
    pub(super) fn planes(&self, axis: Axis) -> impl Iterator<Item = Plane> + '_ {
        let k = axis.index();
        let (mut begun, mut ended) = (0, 0);
        (1..self.grids[k].bins()).map(move |bin| {
            begun += self.counts.begins[k][bin - 1] as usize;
            ended += self.counts.ends[k][bin - 1] as usize;
            Plane {
                at: self.grids[k].limit(bin),
                below: begun,
                above: self.counts.objects - ended,
            }
        })
    }
}

impl Default for Counts {
    fn default() -> Self {
        Counts {
            objects: 0,
            begins: [[0; BINS]; 3],
            ends: [[0; BINS]; 3],
        }
    }
}

impl Counts {
    fn add(&mut self, grids: &[Grid; 3], extents: &Extents, scratch: &mut Scratch) {
        self.objects += extents.objects();
        for axis in Axis::ALL {
            let (k, along) = (axis.index(), extents.along(axis));
            grids[k].bins_of(along.begins, &mut scratch.begin_bins);
            grids[k].bins_of(along.ends, &mut scratch.end_bins);
            count_bins(&scratch.begin_bins, &mut self.begins[k]);
            count_bins(&scratch.end_bins, &mut self.ends[k]);
        }
    }

    fn plus(mut self, other: Self) -> Self {
        self.objects += other.objects;
        let mine = self.begins.iter_mut().chain(&mut self.ends).flatten();
        let others = other.begins.iter().chain(&other.ends).flatten();
        mine.zip(others).for_each(|(mine, other)| *mine += other);
        self
    }
}
