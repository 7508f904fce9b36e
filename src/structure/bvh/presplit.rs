//! Objects are split before the hierarchy is built (pre-splitting), the most promising ones most often.

use super::binary::{Binary, Content};
use super::builder::{BvhBuilder, Input};
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::sweep::Sweep;
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::progress::Cancelled;
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use rayon::prelude::*;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-presplit",
    summary: "bounding volume hierarchy, splits objects with large boxes first",
    about: "Splits objects at planes that halve the scene again and again, before anything else: those most often \
            whose boxes are much larger than they would have to be and cross a plane of a large cell. Then \
            bvh-sweep builds a hierarchy of all parts. Several leaves can refer to an object.",
    source: "T. Karras and T. Aila, Fast parallel construction of high-quality bounding volume hierarchies, 2013",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: true,
    constants: &[WIDTH, MAX_LEAF, BLOCK, BUDGET, COST_TRAVERSAL, COST_TEST],
    builder: Builder::Boxes(|settings| Box::new(Presplit::new(settings))),
};

const BUDGET: Constant = Constant {
    name: "budget",
    default: 0.3,
    lowest: 0.0,
    highest: 16.0,
    step: 0.0,
    unit: "splits per object",
    about: "Splits of all objects at most. Each adds a reference.",
    source: "jbikker/tinybvh",
};

struct Presplit {
    sweep: Sweep,
    budget: f64,
    /// So few objects are one leaf.
    min_leaf: u32,
}

impl Presplit {
    fn new(settings: &BuildSettings) -> Self {
        Presplit {
            sweep: Sweep::new(settings),
            budget: settings.constant("budget"),
            min_leaf: settings.n_oilf,
        }
    }
}

impl BvhBuilder for Presplit {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        let splits = if input.count() > self.min_leaf {
            (self.budget * f64::from(input.count())) as u64
        } else {
            0
        };
        let parts = split_all(input, splits)?;
        let bounds: Vec<Aabb> = parts.iter().map(|(bounds, _)| *bounds).collect();
        let mut built = self.sweep.build(&Input {
            bounds: &bounds,
            progress: &input.progress.part(0.3, 1.0),
            ..*input
        })?;
        refer_to_objects(&mut built, &parts);
        Ok(built)
    }

    fn max_references_per_object(&self) -> f64 {
        1.0 + self.budget
    }
}

/// Replaces references to parts by references to their objects.
fn refer_to_objects(built: &mut Binary, parts: &[(Aabb, u32)]) {
    let of_parts = std::mem::take(built);
    built.root = of_parts.root;
    for mut node in of_parts.nodes {
        if let Content::Leaf { first, count, stop } = node.content {
            let held = &of_parts.references[first as usize..(first + count) as usize];
            let mut objects: Vec<u32> = held.iter().map(|&i| parts[i as usize].1).collect();
            objects.sort_unstable();
            objects.dedup();
            node.content = Content::Leaf {
                first: built.references.len() as u32,
                count: objects.len() as u32,
                stop,
            };
            built.references.extend(objects);
        }
        built.nodes.push(node);
    }
}

/// Returns the bounds of the parts of all objects in order, with their objects. There are at most `splits` more
/// parts than objects.
fn split_all(input: &Input<'_>, splits: u64) -> Result<Vec<(Aabb, u32)>, Cancelled> {
    /// Objects between two checks for cancellation.
    const CHUNK: usize = 1 << 10;
    let all = input.bounds.iter();
    let planes = MedianPlanes::new(all.fold(Aabb::EMPTY, |all, bounds| all.union(bounds)));
    let objects = input.objects.par_iter().zip(input.bounds);
    let priorities: Vec<f64> = objects
        .with_min_len(CHUNK)
        .map(|(object, bounds)| planes.priority(bounds, object.least_box_area()))
        .collect();
    input.progress.check()?;
    input.progress.set(0.1);
    let scale = scale_for(&priorities, splits);
    let numbers: Vec<u32> = (0..input.count()).collect();
    let parts = numbers.par_chunks(CHUNK).map(|numbers| {
        input.progress.check()?;
        let mut parts = Vec::new();
        for &object in numbers {
            let splits = splits_of(priorities[object as usize], scale);
            planes.split(input, object, splits, &mut parts);
        }
        Ok(parts)
    });
    let parts: Vec<Vec<(Aabb, u32)>> = parts.collect::<Result<_, _>>()?;
    input.progress.set(0.3);
    Ok(parts.concat())
}

fn splits_of(priority: f64, scale: f64) -> u64 {
    (priority * scale) as u64
}

/// Returns the largest factor by which priorities become numbers of splits, rounded down, with a sum of at most
/// `splits`, as far as bisection finds it. 0 if nothing is worth a split.
fn scale_for(priorities: &[f64], splits: u64) -> f64 {
    let sum: f64 = priorities.iter().sum();
    let largest = priorities.iter().copied().fold(0.0, f64::max);
    if !(sum > 0.0 && sum.is_finite()) {
        return 0.0;
    }
    let needed = |scale: f64| {
        let each = priorities.iter().map(|&p| splits_of(p, scale));
        each.fold(0_u64, u64::saturating_add)
    };
    // Without rounding, `lo` would need all splits. With it, `hi` certainly needs more: either every object
    // loses less than one by rounding, or the largest alone is enough.
    let mut lo = splits as f64 / sum;
    let mut hi =
        ((splits + priorities.len() as u64) as f64 / sum).min((splits + 1) as f64 / largest);
    if !(lo.is_finite() && hi.is_finite()) {
        return 0.0;
    }
    for _ in 0..48 {
        let middle = 0.5 * (lo + hi);
        if needed(middle) <= splits {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    // Rounding may have made it one too many.
    if needed(lo) <= splits { lo } else { 0.0 }
}

/// The planes that halve a box again and again along each axis.
struct MedianPlanes {
    all: Aabb,
}

/// Levels of median planes.
const LEVELS: u32 = 30;

/// The part of a cell of the last level that rounding may add to a box.
const TOUCH: f64 = 1.0 / 1024.0;

/// A median plane.
#[derive(Clone, Copy)]
struct MedianPlane {
    axis: usize,
    position: f64,
    /// −1 for the plane through the middle of the scene, −2 for those through the middle of the halves.
    level: i32,
}

impl MedianPlanes {
    fn new(all: Aabb) -> Self {
        MedianPlanes { all }
    }

    /// Returns the plane of the highest level that divides a box, along the longest axis of those of the same
    /// level.
    fn plane_through(&self, bounds: &Aabb) -> Option<MedianPlane> {
        let mut best: Option<MedianPlane> = None;
        let size = bounds.size();
        for axis in 0..3 {
            let (from, length) = (self.all.lo[axis], self.all.size()[axis]);
            let cells = f64::from(1 << LEVELS);
            let place = |at: f64| (at - from) / length * cells;
            // The cells in which the box begins and ends. It does not reach into one that it only touches, up to
            // rounding.
            let lo = ((place(bounds.lo[axis]) + TOUCH).floor() as u64).min((1 << LEVELS) - 1);
            let hi = ((place(bounds.hi[axis]) - TOUCH).ceil() as u64).clamp(1, 1 << LEVELS) - 1;
            if lo >= hi {
                continue;
            }
            let highest = (lo ^ hi).ilog2();
            let share = (hi >> highest << highest) as f64 / cells;
            let plane = MedianPlane {
                axis,
                position: from + length * share,
                level: highest as i32 - LEVELS as i32,
            };
            let divides = bounds.lo[axis] < plane.position && plane.position < bounds.hi[axis];
            let is_better = best.is_none_or(|best| {
                plane.level > best.level
                    || plane.level == best.level && size[axis] > size[best.axis]
            });
            if divides && is_better {
                best = Some(plane);
            }
        }
        best
    }

    /// Returns how much an object is worth a split; at least 0.
    fn priority(&self, bounds: &Aabb, least_area: f64) -> f64 {
        let Some(plane) = self.plane_through(bounds) else {
            return 0.0;
        };
        // Relative to the scene, so that a scene that is scaled has the same priorities.
        let excess = (bounds.surface_area() - least_area) / self.all.surface_area();
        let excess = excess.max(0.0);
        let priority = libm::cbrt(libm::exp2(f64::from(plane.level)) * excess);
        // So that rounding does not decide which of several equal objects are split.
        f64::from(priority as f32)
    }

    /// Adds the parts of an object.
    fn split(&self, input: &Input<'_>, object: u32, splits: u64, parts: &mut Vec<(Aabb, u32)>) {
        let mut stack = vec![(input.bounds[object as usize], splits)];
        while let Some((bounds, splits)) = stack.pop() {
            let halves = if splits == 0 {
                None
            } else {
                self.halves(input, object, &bounds)
            };
            let Some([left, right]) = halves else {
                parts.push((bounds, object));
                continue;
            };
            // The larger half gets more of the other splits.
            let widths = [left, right].map(|half| half.size().max_element());
            let share = widths[0] / (widths[0] + widths[1]);
            let rest = splits - 1;
            let of_left = ((rest as f64 * share + 0.5) as u64).min(rest);
            stack.extend([(right, rest - of_left), (left, of_left)]);
        }
    }

    /// Returns the bounds of the parts of an object on both sides of the plane through its bounds, if the object
    /// is on both sides.
    fn halves(&self, input: &Input<'_>, object: u32, bounds: &Aabb) -> Option<[Aabb; 2]> {
        let MedianPlane { axis, position, .. } = self.plane_through(bounds)?;
        let (mut left, mut right) = (*bounds, *bounds);
        left.hi[axis] = position;
        right.lo[axis] = position;
        let part = |cell| input.objects[object as usize].certain_bounds_within(&cell);
        Some([part(left)?, part(right)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec3;

    #[test]
    fn the_budget_is_used_but_not_exceeded() {
        for priorities in [vec![1.0, 2.0, 3.0, 0.0, 0.25], vec![1e-9; 1000], vec![5.0]] {
            for splits in [0, 1, 7, 300] {
                let scale = scale_for(&priorities, splits);
                let sum: u64 = priorities.iter().map(|&p| splits_of(p, scale)).sum();
                assert!(sum <= splits, "{sum} of {splits}");
            }
        }
        let (some, scale) = ([1.0, 2.0], scale_for(&[1.0, 2.0], 30));
        assert!(some.map(|p| splits_of(p, scale)).iter().sum::<u64>() >= 29);
        assert_eq!(scale_for(&[0.0; 3], 9), 0.0);
    }

    #[test]
    fn boxes_are_split_at_the_plane_of_the_largest_cell() {
        let planes = MedianPlanes::new(Aabb::new(Vec3::ZERO, Vec3::new(8.0, 16.0, 0.0)));
        let plane = |lo: [f64; 3], hi: [f64; 3]| {
            let plane = planes.plane_through(&Aabb::new(lo.into(), hi.into()))?;
            Some((plane.axis, plane.position, plane.level))
        };
        assert_eq!(plane([1.0, 1.0, 0.0], [5.0, 7.0, 0.0]), Some((0, 4.0, -1)));
        assert_eq!(plane([1.0, 1.0, 0.0], [5.0, 9.0, 0.0]), Some((1, 8.0, -1)));
        assert_eq!(plane([4.5, 3.0, 0.0], [5.5, 4.5, 0.0]), Some((1, 4.0, -2)));
        assert_eq!(plane([1.0, 1.0, 0.0], [4.0, 1.5, 0.0]), Some((0, 2.0, -2)));
        assert_eq!(plane([4.5, 4.5, 0.0], [4.5, 4.5, 0.0]), None);
    }
}
