//! Spatial splits (SBVH): objects may be divided at planes, so that the boxes of their parts overlap less.

use super::binary::Binary;
use super::bins::{Between, Bins, Held, cheapest_between};
use super::builder::{BvhBuilder, Input};
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::reference::{Reference, bounds_of, centers_of, halve};
use super::top_down::{self, Divide, Split};
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::progress::Cancelled;
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-spatial",
    summary: "bounding volume hierarchy, also splits objects at planes (SBVH)",
    about: "Like bvh-binned, but where the boxes of the two children would overlap, also tries planes that divide \
            the objects. The parts get boxes of their own, so several leaves can refer to an object. An object \
            stays whole where that is cheaper.",
    source: "M. Stich, H. Friedrich and A. Dietrich, Spatial splits in bounding volume hierarchies, 2009",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: true,
    constants: &[
        WIDTH,
        MAX_LEAF,
        BLOCK,
        BINS,
        ALPHA,
        BUDGET,
        COST_TRAVERSAL,
        COST_TEST,
    ],
    builder: Builder::Boxes(|settings| Box::new(Spatial::new(settings))),
};

const BINS: Constant = Constant {
    name: "bins",
    default: 32.0,
    lowest: 2.0,
    highest: 1024.0,
    step: 1.0,
    unit: "",
    about: "Bins per axis, of centers and of space. More cost build time and find better splits of large nodes.",
    source: "meistdan/hippie",
};

const ALPHA: Constant = Constant {
    name: "alpha",
    default: 1e-5,
    lowest: 0.0,
    highest: 1.0,
    step: 0.0,
    unit: "",
    about: "Objects are divided only where the boxes of the children would overlap in a box whose surface area is \
            at least this share of the root's. 0 always tries, 1 never does.",
    source: "M. Stich, H. Friedrich and A. Dietrich, Spatial splits in bounding volume hierarchies, 2009",
};

const BUDGET: Constant = Constant {
    name: "budget",
    default: 2.0,
    lowest: 0.0,
    highest: 16.0,
    step: 0.0,
    unit: "references per object",
    about: "References of all leaves at most; up to 1, no object is divided. A node may spend what its parent leaves \
            to it, in proportion to its references.",
    source: "Embree, rtcSetSceneBuildQuality and the build arguments",
};

struct Spatial {
    costs: Costs,
    bins: usize,
    alpha: f64,
    budget: f64,
}

impl Spatial {
    fn new(settings: &BuildSettings) -> Self {
        Spatial {
            costs: Costs::of(settings),
            bins: settings.constant("bins") as usize,
            alpha: settings.constant("alpha"),
            budget: settings.constant("budget"),
        }
    }
}

impl BvhBuilder for Spatial {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        let list = Reference::to_all(input);
        let splitting = Splitting {
            costs: self.costs,
            bins: self.bins,
            least_overlap: self.alpha * bounds_of(&list).surface_area(),
        };
        let spare = ((self.budget - 1.0).max(0.0) * list.len() as f64) as usize;
        top_down::build(&splitting, References { list, spare }, self.costs, input)
    }

    fn max_references_per_object(&self) -> f64 {
        self.budget.max(1.0)
    }
}

/// Returns the bounds of the part of a reference between two planes; `None` if there is no such part.
fn part_of(
    reference: &Reference,
    input: &Input<'_>,
    axis: usize,
    lo: f64,
    hi: f64,
) -> Option<Aabb> {
    let mut cell = reference.bounds;
    cell.lo[axis] = cell.lo[axis].max(lo);
    cell.hi[axis] = cell.hi[axis].min(hi);
    if cell == reference.bounds {
        return Some(cell);
    }
    input.objects[reference.object as usize].certain_bounds_within(&cell)
}

/// The references of a node.
struct References {
    list: Vec<Reference>,
    /// How many more references its leaves may have.
    spare: usize,
}

/// A way to divide references.
enum How {
    /// None is divided.
    Whole(Between),
    /// Those that cross the plane are divided.
    Parts {
        axis: usize,
        plane: f64,
        /// The bounds on both sides, and the numbers of references there.
        sides: [(Aabb, usize); 2],
    },
}

struct Splitting {
    costs: Costs,
    bins: usize,
    least_overlap: f64,
}

impl Divide for Splitting {
    type References = References;
    type How = How;
    type Memory = Held;

    fn count(&self, references: &References) -> usize {
        references.list.len()
    }

    fn bounds(&self, _: &Input<'_>, references: &References) -> Aabb {
        bounds_of(&references.list)
    }

    fn objects(&self, references: &References) -> impl Iterator<Item = u32> {
        references.list.iter().map(|held| held.object)
    }

    fn cheapest(
        &self,
        input: &Input<'_>,
        references: &mut References,
        bounds: &Aabb,
        held: &mut Held,
    ) -> Option<Split<How>> {
        let centers = centers_of(&references.list);
        let whole = cheapest_between(&references.list, &centers, self.bins, &self.costs, held);
        let (limit, overlap) = match &whole {
            Some(between) => {
                let [left, right] = &between.sides;
                (between.cost, left.intersection(right).surface_area())
            }
            // The references can be halved by number.
            None => {
                let area = bounds.surface_area();
                (area * references.list.len() as f64, area)
            }
        };
        // Without any overlap there is nothing to gain.
        let parts = if references.spare > 0 && overlap > 0.0 && overlap >= self.least_overlap {
            self.cheapest_of_parts(input, references, bounds, limit)
        } else {
            None
        };
        if parts.is_none() && whole.is_none() {
            // Halves with the same centers would not do better.
            references.spare = 0;
        }
        parts.or(whole.map(|between| Split {
            cost: between.cost,
            how: How::Whole(between),
        }))
    }

    fn divide(&self, input: &Input<'_>, references: References, how: How) -> [References; 2] {
        let References { list, spare } = references;
        let count = list.len();
        let [left, right] = match how {
            How::Whole(Between {
                bins, first_right, ..
            }) => {
                let is_left = |held: &Reference| bins.of_center(held) < first_right;
                let (left, right) = list.into_iter().partition(is_left);
                [left, right]
            }
            How::Parts { axis, plane, sides } => {
                divide_at(&self.costs, input, list, axis, plane, sides, spare)
            }
        };
        let spare = spare - (left.len() + right.len() - count);
        if left.is_empty() || right.is_empty() {
            let list = if left.is_empty() { right } else { left };
            return self.halve(input, References { list, spare });
        }
        share(spare, left, right)
    }

    fn halve(&self, _: &Input<'_>, references: References) -> [References; 2] {
        let References {
            list: mut left,
            spare,
        } = references;
        let middle = halve(&mut left);
        let right = left.split_off(middle);
        share(spare, left, right)
    }
}

/// Gives each side a part of the spare references in proportion to its own.
fn share(spare: usize, left: Vec<Reference>, right: Vec<Reference>) -> [References; 2] {
    let all = (left.len() + right.len()) as u128;
    let of_left = (spare as u128 * left.len() as u128 / all) as usize;
    [(left, of_left), (right, spare - of_left)].map(|(list, spare)| References { list, spare })
}

impl Splitting {
    /// Returns the cheapest plane between bins of space that costs less than `limit` and that the spare
    /// references suffice for.
    fn cheapest_of_parts(
        &self,
        input: &Input<'_>,
        references: &References,
        bounds: &Aabb,
        limit: f64,
    ) -> Option<Split<How>> {
        let count = references.list.len();
        let mut best: Option<Split<How>> = None;
        let mut least = limit;
        for axis in 0..3 {
            let [lo, hi] = [bounds.lo[axis], bounds.hi[axis]];
            let Some(bins) = Bins::new(axis, [lo, hi], self.bins) else {
                continue;
            };
            let step = (hi - lo) / self.bins as f64;
            let plane = |bin: usize| lo + step * bin as f64;
            // For each bin, the bounds of the parts in it, and how many references begin and end there.
            let mut held = vec![(Aabb::EMPTY, [0_usize; 2]); self.bins];
            for reference in &references.list {
                let [first, last] =
                    [reference.bounds.lo, reference.bounds.hi].map(|end| bins.of(end[axis]));
                held[first].1[0] += 1;
                held[last].1[1] += 1;
                if first == last {
                    held[first].0 = held[first].0.union(&reference.bounds);
                    continue;
                }
                for (bin, (all, _)) in held.iter_mut().enumerate().take(last + 1).skip(first) {
                    // The outer parts take what rounding puts beyond the planes.
                    let from = if bin == first {
                        f64::NEG_INFINITY
                    } else {
                        plane(bin)
                    };
                    let to = if bin == last {
                        f64::INFINITY
                    } else {
                        plane(bin + 1)
                    };
                    if let Some(part) = part_of(reference, input, axis, from, to) {
                        *all = all.union(&part);
                    }
                }
            }
            let mut rest = vec![(Aabb::EMPTY, 0); self.bins + 1];
            for bin in (0..self.bins).rev() {
                let (bounds, [_, ends]) = &held[bin];
                rest[bin] = (rest[bin + 1].0.union(bounds), rest[bin + 1].1 + ends);
            }
            let mut left = (Aabb::EMPTY, 0);
            for bin in 1..self.bins {
                let (bounds, [begins, _]) = &held[bin - 1];
                left = (left.0.union(bounds), left.1 + begins);
                let right = rest[bin];
                let cost = self.costs.of_part(left) + self.costs.of_part(right);
                let more = left.1 + right.1 - count;
                let is_possible = left.1 > 0 && right.1 > 0 && more <= references.spare;
                if is_possible && cost < least && plane(bin) > lo && plane(bin) < hi {
                    least = cost;
                    let how = How::Parts {
                        axis,
                        plane: plane(bin),
                        sides: [left, right],
                    };
                    best = Some(Split { how, cost });
                }
            }
        }
        best
    }
}

/// Divides references at a plane. A reference that crosses it goes to one side as a whole where that is cheaper
/// than to divide it ("reference unsplitting"), or if as many as `spare` are divided already.
fn divide_at(
    costs: &Costs,
    input: &Input<'_>,
    list: Vec<Reference>,
    axis: usize,
    plane: f64,
    mut sides: [(Aabb, usize); 2],
    mut spare: usize,
) -> [Vec<Reference>; 2] {
    let mut halves = [Vec::new(), Vec::new()];
    for reference in list {
        let [left, right] = &mut halves;
        if reference.bounds.hi[axis] <= plane {
            left.push(reference);
            continue;
        }
        if reference.bounds.lo[axis] >= plane {
            right.push(reference);
            continue;
        }
        let parts = [
            part_of(&reference, input, axis, f64::NEG_INFINITY, plane),
            part_of(&reference, input, axis, plane, f64::INFINITY),
        ];
        let whole = match parts {
            [Some(_), Some(_)] => cheaper_whole(costs, &sides, &reference.bounds, spare > 0),
            [None, Some(_)] => Some(1),
            _ => Some(0),
        };
        match whole {
            Some(side) => {
                sides[side].0 = sides[side].0.union(&reference.bounds);
                let other = &mut sides[1 - side].1;
                *other = other.saturating_sub(1);
                halves[side].push(reference);
            }
            None => {
                spare -= 1;
                for (half, part) in halves.iter_mut().zip(parts) {
                    half.extend(part.map(|bounds| Reference {
                        bounds,
                        ..reference
                    }));
                }
            }
        }
    }
    halves
}

/// Returns the side on which a reference as a whole is cheaper than its parts on both; `None` if its parts are and
/// it may be divided.
fn cheaper_whole(
    costs: &Costs,
    sides: &[(Aabb, usize); 2],
    bounds: &Aabb,
    may_be_divided: bool,
) -> Option<usize> {
    let cost = |bounds: Aabb, count: usize| costs.of_part((bounds, count));
    let [(left, on_left), (right, on_right)] = *sides;
    let divided = cost(left, on_left) + cost(right, on_right);
    let costs = [
        cost(left.union(bounds), on_left) + cost(right, on_right.saturating_sub(1)),
        cost(left, on_left.saturating_sub(1)) + cost(right.union(bounds), on_right),
    ];
    let side = usize::from(costs[1] < costs[0]);
    (costs[side] <= divided || !may_be_divided).then_some(side)
}
