//! The extents of the objects of a cell, clipped to it.

use super::cost::Extent;
use crate::geometry::Axis;
use crate::primitive::Shape;
use crate::structure::frame::ObjectPlanes;
use crate::structure::split::rule::Cell;

/// Computes the extents of the objects of a cell.
pub(super) struct Source<'a> {
    cell: &'a Cell<'a>,
    clip: bool,
}

impl<'a> Source<'a> {
    /// With `clip`, extents are those of the part of an object within the cell; otherwise, those of
    /// its bounds clipped to the cell.
    pub(super) fn new(cell: &'a Cell<'a>, clip: bool) -> Self {
        Source { cell, clip }
    }

    /// Returns the extent of the part of an object within the cell; `None` if there is no such
    /// part.
    fn clipped(&self, object: u32) -> Option<ObjectPlanes> {
        let planes = &self.cell.object_planes[object as usize];
        let cut = clamp_to_cell(planes, &self.cell.local);
        if cut == *planes {
            return Some(cut);
        }
        self.part(object, &cut)
    }

    /// Returns the extent of the part within the cell of an object whose bounds, clipped to the
    /// cell, are `cut`.
    fn part(&self, object: u32, cut: &ObjectPlanes) -> Option<ObjectPlanes> {
        let primitive = &self.cell.primitives[object as usize];
        let part = primitive.bounds_within(&self.cell.bounds)?;
        let part = self.cell.frame.planes_around(&part);
        // Rounding must not move the ends out of the cell.
        Some(std::array::from_fn(|k| {
            let [lo, hi] = cut[k];
            part[k].map(|at| at.max(lo).min(hi))
        }))
    }
}

/// The extents of the objects of a cell, one list per axis.
#[derive(Default)]
pub(super) struct Extents {
    begins: [Vec<f32>; 3],
    ends: [Vec<f32>; 3],
}

/// The extents along an axis: the start and the end of each object.
#[derive(Clone, Copy)]
pub(super) struct Along<'a> {
    pub(super) begins: &'a [f32],
    pub(super) ends: &'a [f32],
}

/// Lists that are reused from cell to cell.
#[derive(Default)]
pub(super) struct Scratch {
    pub(super) begins: Vec<f32>,
    pub(super) ends: Vec<f32>,
    pub(super) begin_bins: Vec<u8>,
    pub(super) end_bins: Vec<u8>,
    pub(super) flat: Vec<f32>,
}

thread_local! {
    /// Kept per thread, so that cells do not allocate.
    static SCRATCH: std::cell::Cell<(Extents, Scratch)> = std::cell::Cell::default();
}

impl Extents {
    /// Calls `task` with the extents of a cell's objects and with lists for its own use.
    pub(super) fn with<R>(
        cell: &Cell<'_>,
        clip: bool,
        task: impl FnOnce(&Extents, &mut Scratch) -> R,
    ) -> R {
        let (mut extents, mut scratch) = SCRATCH.take();
        extents.fill(&Source::new(cell, clip), cell.inside);
        let result = task(&extents, &mut scratch);
        SCRATCH.set((extents, scratch));
        result
    }

    /// Computes the extents of some objects of a cell.
    pub(super) fn fill(&mut self, source: &Source<'_>, objects: &[u32]) {
        let most = objects.len();
        for list in self.begins.iter_mut().chain(&mut self.ends) {
            list.resize(most, 0.0);
        }
        let begins = self.begins.each_mut().map(|list| &mut list[..most]);
        let ends = self.ends.each_mut().map(|list| &mut list[..most]);
        let mut held = 0;
        let mut put = |extent: ObjectPlanes| {
            for (k, [begin, end]) in extent.into_iter().enumerate() {
                begins[k][held] = begin;
                ends[k][held] = end;
            }
            held += 1;
        };
        if source.clip {
            objects
                .iter()
                .filter_map(|&object| source.clipped(object))
                .for_each(put);
        } else {
            // Copied because the compiler must assume that writing to the lists changes the
            // originals.
            let (planes, local) = (source.cell.object_planes, source.cell.local);
            for &object in objects {
                put(clamp_to_cell(&planes[object as usize], &local));
            }
        }
        for list in self.begins.iter_mut().chain(&mut self.ends) {
            list.truncate(held);
        }
    }

    /// Returns the number of objects that overlap the cell.
    pub(super) fn objects(&self) -> usize {
        self.begins[0].len()
    }

    pub(super) fn along(&self, axis: Axis) -> Along<'_> {
        Along {
            begins: &self.begins[axis.index()],
            ends: &self.ends[axis.index()],
        }
    }
}

impl Along<'_> {
    /// Returns the start of the first object and the end of the last.
    pub(super) fn hull(&self) -> Extent {
        [
            fold(self.begins, f32::INFINITY, min),
            fold(self.ends, f32::NEG_INFINITY, max),
        ]
    }
}

/// Returns the smaller of two numbers, the first if they are equal. Unlike `f32::min`, this
/// compiles to one instruction, because it does not handle NaN.
#[inline]
fn min(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// Returns the larger of two numbers, the first if they are equal.
#[inline]
fn max(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// Returns bounds clipped to a cell.
#[inline]
fn clamp_to_cell(planes: &ObjectPlanes, cell: &ObjectPlanes) -> ObjectPlanes {
    std::array::from_fn(|k| {
        let ([lo, hi], [cell_lo, cell_hi]) = (planes[k], cell[k]);
        [max(cell_lo, lo), min(cell_hi, hi)]
    })
}

/// Folds in eight independent lanes, so that no step depends on the previous one.
fn fold(values: &[f32], start: f32, step: impl Fn(f32, f32) -> f32) -> f32 {
    let (lanes, rest) = values.as_chunks::<8>();
    let mut folded = [start; 8];
    for values in lanes {
        for (folded, &value) in folded.iter_mut().zip(values) {
            *folded = step(*folded, value);
        }
    }
    folded.iter().chain(rest).fold(start, |a, &b| step(a, b))
}
