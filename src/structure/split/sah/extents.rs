//! Where the objects of a cell begin and end within it.

use super::cost::Extent;
use crate::geometry::Axis;
use crate::primitive::Shape;
use crate::structure::frame::ObjectPlanes;
use crate::structure::split::rule::Cell;

/// Gives the extents of a cell's objects.
pub(super) struct Source<'a> {
    cell: &'a Cell<'a>,
    clip: bool,
}

impl<'a> Source<'a> {
    /// With `clip` extents are those of an object's part within the cell, else those of its bounds
    /// cut off at the cell.
    pub(super) fn new(cell: &'a Cell<'a>, clip: bool) -> Self {
        Source { cell, clip }
    }

    /// The extent of the part of an object that is within the cell; none if there is no such part.
    fn clipped(&self, object: u32) -> Option<ObjectPlanes> {
        let planes = &self.cell.object_planes[object as usize];
        let cut = clamp_to_cell(planes, &self.cell.local);
        if cut == *planes {
            return Some(cut);
        }
        self.part(object, &cut)
    }

    /// The extent of the part within the cell of an object whose bounds, cut off at the cell, are
    /// `cut`.
    fn part(&self, object: u32, cut: &ObjectPlanes) -> Option<ObjectPlanes> {
        let primitive = &self.cell.primitives[object as usize];
        let part = primitive.bounds_within(&self.cell.bounds)?;
        let part = self.cell.frame.planes_around(&part);
        // Rounding must not move ends out of the cell.
        Some(std::array::from_fn(|k| {
            let [lo, hi] = cut[k];
            part[k].map(|at| at.max(lo).min(hi))
        }))
    }
}

/// The extents of a cell's objects, one axis after the other.
#[derive(Default)]
pub(super) struct Extents {
    begins: [Vec<f32>; 3],
    ends: [Vec<f32>; 3],
}

/// The extents along an axis: where each object begins, and where it ends.
#[derive(Clone, Copy)]
pub(super) struct Along<'a> {
    pub(super) begins: &'a [f32],
    pub(super) ends: &'a [f32],
}

/// Lists that are used for one cell after the other.
#[derive(Default)]
pub(super) struct Scratch {
    pub(super) begins: Vec<f32>,
    pub(super) ends: Vec<f32>,
    pub(super) begin_bins: Vec<u8>,
    pub(super) end_bins: Vec<u8>,
    pub(super) flat: Vec<f32>,
}

thread_local! {
    /// Kept so that no cell allocates.
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

    /// Takes the extents of some of a cell's objects.
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
            // Read once: for all the compiler knows, writing to the lists might change them.
            let (planes, local) = (source.cell.object_planes, source.cell.local);
            for &object in objects {
                put(clamp_to_cell(&planes[object as usize], &local));
            }
        }
        for list in self.begins.iter_mut().chain(&mut self.ends) {
            list.truncate(held);
        }
    }

    /// Objects that do more than touch the cell from outside.
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
    /// Ends of the whole: where the first object begins and the last ends.
    pub(super) fn hull(&self) -> Extent {
        [
            fold(self.begins, f32::INFINITY, min),
            fold(self.ends, f32::NEG_INFINITY, max),
        ]
    }
}

/// The lower of two numbers, of equal ones the first. Unlike `f32::min` it is one instruction, as none is
/// NaN.
#[inline]
fn min(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// The higher likewise.
#[inline]
fn max(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// The extent of bounds, cut off at a cell.
#[inline]
fn clamp_to_cell(planes: &ObjectPlanes, cell: &ObjectPlanes) -> ObjectPlanes {
    std::array::from_fn(|k| {
        let ([lo, hi], [cell_lo, cell_hi]) = (planes[k], cell[k]);
        [max(cell_lo, lo), min(cell_hi, hi)]
    })
}

/// Folds in lanes, so that no step waits for the one before.
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
