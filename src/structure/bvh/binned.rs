//! Binning: objects are sorted into bins by their centers, and splits between bins are tried.

use super::binary::Binary;
use super::bins::{Between, Held, cheapest_between};
use super::builder::{BvhBuilder, Input};
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::reference::{Reference, halve};
use super::top_down::{self, Divide, Split};
use crate::geometry::Aabb;
use crate::progress::Cancelled;
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use rayon::prelude::*;
use std::marker::PhantomData;

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
        let mut all = Reference::to_all(input);
        let binning = Binning {
            costs: self.costs,
            bins: self.bins,
            all: PhantomData,
        };
        top_down::build(&binning, References::of(&mut all), self.costs, input)
    }
}

/// Divides parts of one list, which lives for `'a`.
struct Binning<'a> {
    costs: Costs,
    bins: usize,
    all: PhantomData<&'a ()>,
}

/// The references of a node.
struct References<'a> {
    list: &'a mut [Reference],
    bounds: Aabb,
    centers: Aabb,
}

impl<'a> References<'a> {
    fn of(list: &'a mut [Reference]) -> Self {
        /// References that one thread encloses.
        const CHUNK: usize = 1 << 15;
        let [bounds, centers] = if list.len() > 2 * CHUNK {
            let parts = list.par_chunks(CHUNK).map(enclose);
            parts.reduce(
                || [Aabb::EMPTY; 2],
                |a, b| [a[0].union(&b[0]), a[1].union(&b[1])],
            )
        } else {
            enclose(list)
        };
        References {
            list,
            bounds,
            centers,
        }
    }

    fn split_at(self, count: usize) -> [Self; 2] {
        let (left, right) = self.list.split_at_mut(count);
        [left, right].map(References::of)
    }
}

impl<'a> Divide for Binning<'a> {
    type References = References<'a>;
    type How = Between;
    type Memory = Held;

    fn count(&self, references: &References<'a>) -> usize {
        references.list.len()
    }

    fn bounds(&self, _: &Input<'_>, references: &References<'a>) -> Aabb {
        references.bounds
    }

    fn objects(&self, references: &References<'a>) -> impl Iterator<Item = u32> {
        references.list.iter().map(|held| held.object)
    }

    fn cheapest(
        &self,
        _: &Input<'_>,
        references: &mut References<'a>,
        _: &Aabb,
        held: &mut Held,
    ) -> Option<Split<Between>> {
        let References { list, centers, .. } = references;
        let how = cheapest_between(list, centers, self.bins, &self.costs, held)?;
        let cost = how.cost;
        Some(Split { how, cost })
    }

    fn divide(
        &self,
        _: &Input<'_>,
        references: References<'a>,
        how: Between,
    ) -> [References<'a>; 2] {
        let is_left = |held: &Reference| how.bins.of_center(held) < how.first_right;
        let count = partition(references.list, is_left);
        references.split_at(count)
    }

    fn halve(&self, _: &Input<'_>, references: References<'a>) -> [References<'a>; 2] {
        let middle = halve(references.list);
        references.split_at(middle)
    }
}

/// Returns the bounds of references and those of their centers.
fn enclose(list: &[Reference]) -> [Aabb; 2] {
    let (mut bounds, mut centers) = (Aabb::EMPTY, Aabb::EMPTY);
    for reference in list {
        let center = reference.center();
        bounds = bounds.union(&reference.bounds);
        centers = centers.union(&Aabb::new(center, center));
    }
    [bounds, centers]
}

/// Moves the references that are on the left before the others and returns their number.
fn partition(list: &mut [Reference], is_left: impl Fn(&Reference) -> bool) -> usize {
    let (mut first, mut end) = (0, list.len());
    loop {
        while first < end && is_left(&list[first]) {
            first += 1;
        }
        while first < end && !is_left(&list[end - 1]) {
            end -= 1;
        }
        if first == end {
            return first;
        }
        end -= 1;
        list.swap(first, end);
        first += 1;
    }
}
