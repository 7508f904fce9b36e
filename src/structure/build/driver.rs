//! The one driver of all rules that split cells: termination, distribution of objects, threads, memory,
//! cancellation.
//!
//! Large cells are split into tasks. Each task builds a subtree in its own arrays, which are joined
//! in depth-first order. The tree is the same for any number of threads.

use super::cell_objects::CellObjects;
use super::error::{BuildError, Inseparable};
use super::limits::Limits;
use super::overlap::{HalfCell, Overlap, Side};
use super::part::Part;
use crate::geometry::{Aabb, Axis};
use crate::primitive::Primitive;
use crate::progress::Progress;
use crate::structure::frame::{Frame, ObjectPlanes};
use crate::structure::method::Structure;
use crate::structure::node::{Node, StopReason};
use crate::structure::settings::BuildSettings;
use crate::structure::split::rule::{Cell, Decision, SplitRule};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// The objects of a scene, and the root cell around them.
pub struct Scope<'a> {
    pub objects: &'a [Primitive],
    /// The bounds of all objects.
    pub bounds: &'a [Aabb],
    pub frame: &'a Frame,
    pub settings: &'a BuildSettings,
    pub depth_limit: u32,
    pub progress: &'a Progress,
}

/// What a rule made of the root cell.
pub struct Divided {
    pub nodes: Vec<Node>,
    pub references: Vec<u32>,
    pub depth_reached: u32,
}

/// Divides the root cell by the planes of a rule.
///
/// # Errors
/// The tree would exceed the memory limit, or cancellation.
pub fn divide(scope: &Scope<'_>, rule: &dyn SplitRule) -> Result<Divided, BuildError> {
    let &Scope {
        objects,
        bounds,
        frame,
        settings,
        depth_limit,
        progress,
    } = scope;
    let limits = Limits::new(
        settings.memory_limit,
        objects.len(),
        settings.method.structure,
    );
    limits.reserve_pending(0, objects.len())?;
    let mut planes = Vec::new();
    bounds
        .par_iter()
        .with_min_len(CHUNK)
        .map(|bounds| frame.planes_around(bounds))
        .collect_into_vec(&mut planes);
    progress.check()?;
    let driver = Driver {
        overlap: Overlap::new(settings, objects, bounds, &planes, frame.slack()),
        frame,
        rule,
        settings,
        depth_limit,
        progress,
        objects,
        bounds,
        planes: &planes,
        limits,
        done: AtomicU64::new(0),
    };
    let place = Place {
        bounds: frame.cell(),
        local: [[-1.0, 1.0]; 3],
        depth: 0,
        failed_splits: 0,
        pending: objects.len(),
    };
    let all = CellObjects::of_root(&planes, &place.local);
    let mut part = Part::default();
    driver.cell(&mut part, &all, &place)?;
    part.finish(&driver.limits)?;
    let Part {
        mut nodes,
        mut references,
        depth_reached,
        ..
    } = part;
    nodes.shrink_to_fit();
    references.shrink_to_fit();
    Ok(Divided {
        nodes,
        references,
        depth_reached,
    })
}

/// Objects between two checks for cancellation.
const CHUNK: usize = 1 << 14;

/// A cell in local coordinates: lower and upper end along each axis.
type Local = [[f32; 2]; 3];

/// Position of a cell in space and in the tree.
#[derive(Clone, Copy)]
struct Place {
    bounds: Aabb,
    local: Local,
    depth: u32,
    /// Number of failed splits from the root to this cell (see [`Cell::failed_splits`]).
    failed_splits: u32,
    /// Number of objects in the lists of the cells from the root to this one.
    pending: usize,
}

struct Driver<'a> {
    overlap: Overlap<'a>,
    frame: &'a Frame,
    rule: &'a dyn SplitRule,
    settings: &'a BuildSettings,
    depth_limit: u32,
    progress: &'a Progress,
    objects: &'a [Primitive],
    bounds: &'a [Aabb],
    planes: &'a [ObjectPlanes],
    limits: Limits,
    /// Fraction of the work that is done, where a child counts half as much as its parent; the bits
    /// of an `f64`.
    done: AtomicU64,
}

/// Cells with more objects are split into tasks.
const TASK: usize = 1 << 12;

/// Cells with more objects always check for cancellation.
const LARGE: usize = 1 << 8;

impl Driver<'_> {
    /// Builds the subtree of a cell with these objects.
    fn cell(
        &self,
        part: &mut Part,
        objects: &CellObjects,
        place: &Place,
    ) -> Result<(), BuildError> {
        debug_assert!(objects.are_partitioned(self.planes, &place.local));
        if objects.len() > LARGE || part.nodes.len().is_multiple_of(64) {
            self.progress.check()?;
        }
        self.check_separable(objects, place)?;
        match self.decide(objects, place) {
            Decision::Leaf(stop) => self.leaf(part, objects, place.depth, stop),
            Decision::Split { axis, plane } => {
                self.split(part, objects, place, axis, [plane, plane])
            }
            Decision::FailedSplit { axis, plane } => {
                let place = Place {
                    failed_splits: place.failed_splits + 1,
                    ..*place
                };
                self.split(part, objects, &place, axis, [plane, plane])
            }
            Decision::Cut { axis, slab } => self.split(part, objects, place, axis, slab),
        }
    }

    /// Returns a cell as rules see it.
    fn seen<'c>(&'c self, objects: &'c CellObjects, place: &Place) -> Cell<'c> {
        Cell {
            frame: self.frame,
            bounds: place.bounds,
            local: place.local,
            depth: place.depth,
            depth_limit: self.depth_limit,
            failed_splits: place.failed_splits,
            inside: &objects.inside,
            touching: &objects.touching,
            primitives: self.objects,
            object_bounds: self.bounds,
            object_planes: self.planes,
            progress: self.progress,
        }
    }

    /// Stops the build if the subtree of a cell certainly exceeds the memory limit, because its objects
    /// have a part in common and the rule divides that part wherever the objects lie. Otherwise a rule
    /// that splits to `D_MAX` would do all the work first.
    ///
    /// The splits are not skipped where they fit in memory, although they separate nothing: `D_MAX` and
    /// `N_OILF` alone define the leaves of these methods, and so the counts of the paper.
    fn check_separable(&self, objects: &CellObjects, place: &Place) -> Result<(), BuildError> {
        /// Number of slices along an axis below which planes are certainly distinct `f32` numbers.
        const DISTINCT: f64 = (1 << 22) as f64;
        let structure = self.settings.method.structure;
        let levels = structure.levels_left(place.depth, self.depth_limit);
        let all = objects.len() as f64;
        let is_grid = structure == Structure::Grid;
        let could_be_too_many = is_grid
            || self
                .limits
                .are_too_many(all * libm::exp2(f64::from(levels)));
        if !could_be_too_many || !is_grid && objects.len() <= self.settings.n_oilf as usize {
            return Ok(());
        }
        let Some(slices) = self.rule.slices(&self.seen(objects, place), levels) else {
            return Ok(());
        };
        if !self
            .limits
            .are_too_many(all * slices.iter().product::<f64>())
        {
            return Ok(());
        }
        let mut common = place.local;
        for &object in objects.inside.iter().chain(&objects.touching) {
            let Some(core) = self.overlap.core(self.frame, object) else {
                return Ok(());
            };
            for (common, core) in common.iter_mut().zip(core) {
                *common = [common[0].max(core[0]), common[1].min(core[1])];
                if common[0] > common[1] {
                    return Ok(());
                }
            }
        }
        let mut leaves = 1.0;
        for k in 0..3 {
            let [width, shared] =
                [place.local[k], common[k]].map(|[lo, hi]| f64::from(hi) - f64::from(lo));
            let slices = slices[k].min(width * DISTINCT);
            // The common part reaches into as many slices as it is long, at least.
            leaves *= (shared / width * slices * (1.0 - 1e-6)).ceil().max(1.0);
        }
        if !self.limits.are_too_many(all * leaves) {
            return Ok(());
        }
        let inseparable = Inseparable {
            objects: objects.len(),
            leaves: leaves as u64,
        };
        Err(self.limits.inseparable(place.depth, inseparable))
    }

    fn decide(&self, objects: &CellObjects, place: &Place) -> Decision {
        let structure = self.settings.method.structure;
        if structure.ends_at(place.depth) {
            if objects.len() == 0 {
                return Decision::Leaf(StopReason::Empty);
            }
            if objects.len() <= self.settings.n_oilf as usize {
                return Decision::Leaf(StopReason::FewObjects);
            }
            if place.depth + structure.levels() > self.depth_limit {
                return Decision::Leaf(StopReason::MaxDepth);
            }
        }
        let cell = self.seen(objects, place);
        match self.rule.decide(&cell) {
            Decision::Split { axis, plane } | Decision::FailedSplit { axis, plane }
                if !(cell.divides(axis, plane) && cell.divides_in_world(axis, plane)) =>
            {
                Decision::Leaf(StopReason::TooThin)
            }
            decision => {
                if let Decision::Cut { axis, slab } = decision {
                    debug_assert!(slab.iter().all(|&p| cell.divides(axis, p)) && slab[0] < slab[1]);
                }
                decision
            }
        }
    }

    fn leaf(
        &self,
        part: &mut Part,
        objects: &CellObjects,
        depth: u32,
        stop: StopReason,
    ) -> Result<(), BuildError> {
        part.leaf(&self.limits, objects, depth, stop)?;
        if part.nodes.len().is_multiple_of(64) {
            self.report_progress(part);
        }
        Ok(())
    }

    /// Reports the progress.
    fn report_progress(&self, part: &mut Part) {
        let more = std::mem::take(&mut part.done);
        let add = |bits| Some((f64::from_bits(bits) + more).to_bits());
        let before = self
            .done
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, add)
            .unwrap_or_else(|bits| bits);
        self.progress.set(f64::from_bits(before) + more);
    }

    /// Splits a cell into below | empty | above; if both planes of the slab are equal, into below |
    /// above. A slab takes one more inner node, but does not count as a level.
    fn split(
        &self,
        part: &mut Part,
        objects: &CellObjects,
        place: &Place,
        axis: Axis,
        slab: [f32; 2],
    ) -> Result<(), BuildError> {
        let [below, above] = self.parts(place, objects.len(), axis, slab);
        self.limits.reserve_pending(place.depth, below.1.pending)?;
        let outer = part.inner(&self.limits, place.depth)?;
        let in_parallel = objects.len() > TASK && rayon::current_num_threads() > 1;
        let built = if in_parallel {
            let (below, above) = rayon::join(
                || self.build_separately(objects, &below),
                || self.build_separately(objects, &above),
            );
            part.append(below?);
            Some(above?)
        } else {
            self.child(part, objects, &below)?;
            None
        };
        part.close(outer, axis, slab[0]);
        if slab[0] < slab[1] {
            let inner = part.inner(&self.limits, place.depth)?;
            self.leaf(
                part,
                &CellObjects::default(),
                place.depth + 1,
                StopReason::CutOut,
            )?;
            part.close(inner, axis, slab[1]);
        }
        match built {
            Some(above) => part.append(above),
            None => self.child(part, objects, &above)?,
        }
        Ok(())
    }

    /// Returns the parts of a cell below and above a slab.
    fn parts(
        &self,
        place: &Place,
        objects: usize,
        axis: Axis,
        slab: [f32; 2],
    ) -> [(HalfCell, Place); 2] {
        let [first, second] = slab.map(|plane| self.frame.to_world(axis, f64::from(plane)));
        let (below, rest) = place.bounds.split(axis, first);
        let (_, above) = rest.split(axis, second);
        let part = |bounds, side, plane| {
            let mut local = place.local;
            local[axis.index()][if side == Side::Below { 1 } else { 0 }] = plane;
            let place = Place {
                bounds,
                local,
                depth: place.depth + 1,
                failed_splits: place.failed_splits,
                pending: place.pending + objects,
            };
            (HalfCell::new(self.frame, bounds, side, axis, plane), place)
        };
        [
            part(below, Side::Below, slab[0]),
            part(above, Side::Above, slab[1]),
        ]
    }

    /// Selects the objects of a child from those of its parent and builds it.
    fn child(
        &self,
        part: &mut Part,
        objects: &CellObjects,
        (half, place): &(HalfCell, Place),
    ) -> Result<(), BuildError> {
        let mut own = part.spare.pop().unwrap_or_default();
        own.clear();
        for (list, inside) in [(&objects.inside, true), (&objects.touching, false)] {
            for chunk in list.chunks(CHUNK) {
                if list.len() > CHUNK {
                    self.progress.check()?;
                }
                self.overlap.select(half, chunk, inside, &mut own);
            }
        }
        self.cell(part, &own, place)?;
        part.spare.push(own);
        Ok(())
    }

    /// Like [`Driver::child`], but in separate arrays.
    fn build_separately(
        &self,
        objects: &CellObjects,
        child: &(HalfCell, Place),
    ) -> Result<Part, BuildError> {
        let mut part = Part::default();
        self.child(&mut part, objects, child)?;
        part.finish(&self.limits)?;
        self.report_progress(&mut part);
        // Free memory that is no longer needed while the part is pending.
        part.spare = Vec::new();
        Ok(part)
    }
}
