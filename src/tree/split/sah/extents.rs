//! Where the objects of a cell begin and end within it.

use super::{Cell, Extent};
use crate::geometry::Axis;
use crate::primitive::Shape;
use crate::tree::ObjectPlanes;
use crate::tree::frame::is_inside;

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

    /// An object's extent with whether it counts: not if it only touches the cell from outside.
    #[inline]
    fn extent(&self, object: u32) -> (bool, ObjectPlanes) {
        let planes = &self.cell.object_planes[object as usize];
        let inside = is_inside(planes, &self.cell.local);
        let cut = self.cut_off(planes);
        if self.clip && inside && cut != *planes {
            let part = self.part(object, &cut);
            return (part.is_some(), part.unwrap_or(cut));
        }
        (inside, cut)
    }

    #[inline]
    fn cut_off(&self, planes: &ObjectPlanes) -> ObjectPlanes {
        let local = &self.cell.local;
        std::array::from_fn(|k| [planes[k][0].max(local[k][0]), planes[k][1].min(local[k][1])])
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
pub(super) struct Room {
    pub(super) begins: Vec<f32>,
    pub(super) ends: Vec<f32>,
    pub(super) begin_bins: Vec<u8>,
    pub(super) end_bins: Vec<u8>,
    pub(super) flat: Vec<f32>,
}

thread_local! {
    /// Kept so that no cell allocates.
    static KEPT: std::cell::Cell<(Extents, Room)> = std::cell::Cell::default();
}

impl Extents {
    /// Calls `task` with the extents of a cell's objects and with lists for its own use.
    pub(super) fn with<R>(
        cell: &Cell<'_>,
        clip: bool,
        task: impl FnOnce(&Extents, &mut Room) -> R,
    ) -> R {
        let (mut extents, mut room) = KEPT.take();
        extents.fill(&Source::new(cell, clip), cell.objects);
        let result = task(&extents, &mut room);
        KEPT.set((extents, room));
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
        for &object in objects {
            // Always put there and kept by a count: a branch would often be foretold wrong.
            let (is_held, extent) = source.extent(object);
            for (k, [begin, end]) in extent.into_iter().enumerate() {
                begins[k][held] = begin;
                ends[k][held] = end;
            }
            held += usize::from(is_held);
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
        let lower = |a: f32, b: f32| if b < a { b } else { a };
        let higher = |a: f32, b: f32| if b > a { b } else { a };
        [
            fold(self.begins, f32::INFINITY, lower),
            fold(self.ends, f32::NEG_INFINITY, higher),
        ]
    }
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
