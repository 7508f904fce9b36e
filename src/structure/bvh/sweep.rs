//! A full sweep: every division of the objects sorted by their centers is tried, along each axis.

use super::binary::Binary;
use super::builder::{BvhBuilder, Input};
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::top_down::{self, Divide, Split};
use crate::geometry::Aabb;
use crate::progress::Cancelled;
use crate::structure::method::Structure;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-sweep",
    summary: "bounding volume hierarchy, tries every split of the sorted centers (SAH)",
    about: "Sorts the objects by the centers of their boxes along each axis, tries every split of these \
            orders, and takes the one of the lowest cost by the surface-area heuristic. A node becomes a \
            leaf where that is cheaper.",
    source: "J. D. MacDonald and K. S. Booth, Heuristics for ray tracing using space subdivision, 1990; as \
             in madmann91/bvh, version 2",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: true,
    constants: &[WIDTH, MAX_LEAF, BLOCK, COST_TRAVERSAL, COST_TEST],
    builder: Builder::Boxes(|settings| Box::new(Sweep::new(settings))),
};

pub struct Sweep {
    costs: Costs,
}

impl Sweep {
    pub fn new(settings: &BuildSettings) -> Self {
        Sweep {
            costs: Costs::of(settings),
        }
    }
}

impl BvhBuilder for Sweep {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        let is_left = (0..input.count()).map(|_| AtomicBool::new(false));
        let sweeping = Sweeping {
            costs: self.costs,
            is_left: is_left.collect(),
        };
        top_down::build(&sweeping, sorted(input)?, self.costs, input)
    }
}

/// Returns all objects in order of their centers along each axis, then of their number.
fn sorted(input: &Input<'_>) -> Result<[Vec<u32>; 3], Cancelled> {
    let mut orders = [(); 3].map(|()| (0..input.count()).collect::<Vec<u32>>());
    for (axis, order) in orders.iter_mut().enumerate() {
        let center = |object: u32| input.center(object)[axis];
        order
            .par_sort_unstable_by(|&a, &b| center(a).total_cmp(&center(b)).then_with(|| a.cmp(&b)));
        input.progress.check()?;
    }
    Ok(orders)
}

struct Sweeping {
    costs: Costs,
    /// Scratch by object. Nodes that are built at the same time have no object in common.
    is_left: Vec<AtomicBool>,
}

/// The first `count` objects in the order of an axis.
#[derive(Clone, Copy, Debug)]
struct Prefix {
    axis: usize,
    count: usize,
}

impl Divide for Sweeping {
    /// The objects in order of their centers along each axis, then of their number.
    type References = [Vec<u32>; 3];
    type How = Prefix;
    /// By index, the cost of the objects from there on.
    type Memory = Vec<f64>;

    fn count(&self, orders: &[Vec<u32>; 3]) -> usize {
        orders[0].len()
    }

    fn bounds(&self, input: &Input<'_>, orders: &[Vec<u32>; 3]) -> Aabb {
        let bounds = orders[0].iter().map(|&o| &input.bounds[o as usize]);
        bounds.fold(Aabb::EMPTY, |all, bounds| all.union(bounds))
    }

    fn objects(&self, [order, ..]: &[Vec<u32>; 3]) -> impl Iterator<Item = u32> {
        order.iter().copied()
    }

    fn cheapest(
        &self,
        input: &Input<'_>,
        orders: &mut [Vec<u32>; 3],
        _: &Aabb,
        rest: &mut Vec<f64>,
    ) -> Option<Split<Prefix>> {
        let count = orders[0].len();
        let mut best: Option<Split<Prefix>> = None;
        rest.resize(count.max(rest.len()), 0.0);
        for (axis, order) in orders.iter().enumerate() {
            let ends = [order[0], order[count - 1]].map(|object| input.center(object)[axis]);
            if ends[0] == ends[1] {
                continue;
            }
            let mut bounds = Aabb::EMPTY;
            for i in (1..count).rev() {
                bounds = bounds.union(&input.bounds[order[i] as usize]);
                rest[i] = bounds.surface_area() * self.costs.blocks(count - i);
            }
            let mut bounds = Aabb::EMPTY;
            for i in 1..count {
                bounds = bounds.union(&input.bounds[order[i - 1] as usize]);
                let cost = bounds.surface_area() * self.costs.blocks(i) + rest[i];
                if best.is_none_or(|best| cost < best.cost) {
                    let how = Prefix { axis, count: i };
                    best = Some(Split { how, cost });
                }
            }
        }
        best
    }

    fn divide(
        &self,
        _: &Input<'_>,
        orders: [Vec<u32>; 3],
        Prefix { axis, count }: Prefix,
    ) -> [[Vec<u32>; 3]; 2] {
        for (i, &object) in orders[axis].iter().enumerate() {
            self.is_left[object as usize].store(i < count, Ordering::Relaxed);
        }
        let mut halves = [(); 2].map(|()| [(); 3].map(|()| Vec::new()));
        for (k, order) in orders.into_iter().enumerate() {
            let is_left = |object: &u32| self.is_left[*object as usize].load(Ordering::Relaxed);
            let [left, right] = &mut halves;
            left[k].reserve_exact(count);
            right[k].reserve_exact(order.len() - count);
            for object in order {
                let half = if is_left(&object) {
                    &mut *left
                } else {
                    &mut *right
                };
                half[k].push(object);
            }
        }
        halves
    }

    fn halve(&self, input: &Input<'_>, orders: [Vec<u32>; 3]) -> [[Vec<u32>; 3]; 2] {
        let width = |axis: usize| {
            let order = &orders[axis];
            let ends = [order[0], order[order.len() - 1]];
            let [lo, hi] = ends.map(|object| input.center(object)[axis]);
            hi - lo
        };
        let axis = (1..3).fold(0, |best, k| if width(k) > width(best) { k } else { best });
        let count = orders[0].len() / 2;
        self.divide(input, orders, Prefix { axis, count })
    }
}
