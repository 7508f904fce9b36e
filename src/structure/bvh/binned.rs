//! Binning: objects are sorted into bins by their centers, and splits between bins are tried.

use super::binary::Binary;
use super::builder::{BvhBuilder, Input, center};
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::sweep::bounds_of;
use super::top_down::{self, Divide, Split};
use crate::geometry::{Aabb, Vec3};
use crate::progress::Cancelled;
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-binned",
    summary: "bounding volume hierarchy, tries splits between bins of centers (SAH)",
    about: "Sorts the objects of a node into bins of equal width by the centers of their boxes, along each \
            axis, and takes the split between bins of the lowest cost by the surface-area heuristic. A node \
            becomes a leaf where that is cheaper.",
    source: "I. Wald, On fast construction of SAH-based bounding volume hierarchies, 2007",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: true,
    constants: &[WIDTH, MAX_LEAF, BLOCK, BINS, COST_TRAVERSAL, COST_TEST],
    builder: Builder::Boxes(|settings| Box::new(Binned::new(settings))),
};

pub const BINS: Constant = Constant {
    name: "bins",
    default: 16.0,
    lowest: 2.0,
    highest: 1024.0,
    step: 1.0,
    unit: "",
    about: "Bins per axis. More cost build time and find better splits of large nodes.",
    source: "I. Wald, On fast construction of SAH-based bounding volume hierarchies, 2007",
};

pub struct Binned {
    costs: Costs,
    bins: usize,
}

impl Binned {
    pub fn new(settings: &BuildSettings) -> Self {
        Binned {
            costs: Costs::of(settings),
            bins: settings.constant("bins") as usize,
        }
    }
}

impl BvhBuilder for Binned {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        top_down::build(self, self.costs, input)
    }
}

/// The bins of a node along one axis.
#[derive(Clone, Copy, Debug)]
pub struct Bins {
    pub axis: usize,
    lo: f64,
    per_length: f64,
    count: usize,
}

impl Bins {
    /// Divides the range from `lo` to `hi`; `None` if it is too short to be divided.
    pub fn new(axis: usize, [lo, hi]: [f64; 2], count: usize) -> Option<Self> {
        let per_length = count as f64 / (hi - lo);
        (lo < hi && per_length.is_finite()).then_some(Bins {
            axis,
            lo,
            per_length,
            count,
        })
    }

    /// Returns the bin of a coordinate.
    pub fn of(&self, coordinate: f64) -> usize {
        (((coordinate - self.lo) * self.per_length) as usize).min(self.count - 1)
    }
}

/// The objects in the bins before `first_right`.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    bins: Bins,
    first_right: usize,
}

impl Divide for Binned {
    type References = Vec<u32>;
    type How = Between;

    fn root(&self, input: &Input<'_>) -> Result<Vec<u32>, Cancelled> {
        Ok((0..input.count()).collect())
    }

    fn count(&self, objects: &Vec<u32>) -> usize {
        objects.len()
    }

    fn bounds(&self, input: &Input<'_>, objects: &Vec<u32>) -> Aabb {
        bounds_of(input, objects)
    }

    fn objects(&self, objects: Vec<u32>) -> Vec<u32> {
        objects
    }

    fn cheapest(
        &self,
        input: &Input<'_>,
        objects: &mut Vec<u32>,
        _: &Aabb,
    ) -> Option<Split<Between>> {
        let centers = centers_of(input, objects);
        let mut best: Option<Split<Between>> = None;
        for axis in 0..3 {
            let Some(bins) = Bins::new(axis, [centers.lo[axis], centers.hi[axis]], self.bins)
            else {
                continue;
            };
            let mut held = vec![(Aabb::EMPTY, 0_usize); self.bins];
            for &object in objects.iter() {
                let (bounds, count) = &mut held[bins.of(input.center(object)[axis])];
                *bounds = bounds.union(&input.bounds[object as usize]);
                *count += 1;
            }
            for (first_right, cost) in costs_between(&held, &self.costs) {
                if best.is_none_or(|best| cost < best.cost) {
                    let how = Between { bins, first_right };
                    best = Some(Split { how, cost });
                }
            }
        }
        best
    }

    fn divide(&self, input: &Input<'_>, objects: Vec<u32>, how: Between) -> [Vec<u32>; 2] {
        let is_left =
            |object: &u32| how.bins.of(input.center(*object)[how.bins.axis]) < how.first_right;
        let (left, right) = objects.into_iter().partition(is_left);
        [left, right]
    }

    fn halve(&self, input: &Input<'_>, mut objects: Vec<u32>) -> [Vec<u32>; 2] {
        let axis = centers_of(input, &objects).longest_axis().index();
        let middle = objects.len() / 2;
        objects.select_nth_unstable_by(middle, |&a, &b| {
            let order = input.center(a)[axis].total_cmp(&input.center(b)[axis]);
            order.then_with(|| a.cmp(&b))
        });
        let right = objects.split_off(middle);
        [objects, right]
    }
}

/// Returns the bounds of the centers of some objects.
fn centers_of(input: &Input<'_>, objects: &[u32]) -> Aabb {
    let centers = objects.iter().map(|&o| center(&input.bounds[o as usize]));
    let point = |center: Vec3| Aabb::new(center, center);
    centers.fold(Aabb::EMPTY, |all, center| all.union(&point(center)))
}

/// Returns the cost of every split between bins that leaves objects on both sides, with the first bin to the
/// right. `held` has the bounds and the number of references of each bin.
pub fn costs_between(held: &[(Aabb, usize)], costs: &Costs) -> Vec<(usize, f64)> {
    let mut rest = vec![(0.0, 0_usize); held.len()];
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    for (i, (more, n)) in held.iter().enumerate().skip(1).rev() {
        bounds = bounds.union(more);
        count += n;
        rest[i] = (bounds.surface_area() * costs.blocks(count), count);
    }
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    let mut found = Vec::new();
    for i in 1..held.len() {
        let (more, n) = &held[i - 1];
        bounds = bounds.union(more);
        count += n;
        let (right, on_right) = rest[i];
        if count > 0 && on_right > 0 {
            found.push((i, bounds.surface_area() * costs.blocks(count) + right));
        }
    }
    found
}
