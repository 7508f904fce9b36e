//! Parallel locally-ordered clustering (PLOC): nearest neighbors in Morton order are merged.

use super::binary::Binary;
use super::builder::{BvhBuilder, Input};
use super::collapse::collapse;
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::morton;
use crate::geometry::Aabb;
use crate::progress::Cancelled;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use rayon::prelude::*;
use std::cmp::Ordering;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-ploc",
    summary: "bounding volume hierarchy, merges nearest neighbors along a Morton curve",
    about: "Begins with one cluster per object, along a Morton curve through the centers of their boxes. In each \
            round, every cluster finds the one within a radius whose box forms the smallest union with its own. \
            Two clusters that find each other are merged. At the end, subtrees become leaves where that is not \
            more expensive by the surface-area heuristic. D_MAX does not apply.",
    source: "D. Meister and J. Bittner, Parallel locally-ordered clustering for bounding volume hierarchy \
             construction, 2018",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: false,
    constants: &[WIDTH, MAX_LEAF, BLOCK, RADIUS, COST_TRAVERSAL, COST_TEST],
    builder: Builder::Boxes(|settings| Box::new(Ploc::new(settings))),
};

pub const RADIUS: Constant = Constant {
    name: "radius",
    default: 25.0,
    lowest: 1.0,
    highest: 1000.0,
    step: 1.0,
    unit: "clusters",
    about: "How many clusters in each direction along the curve are compared with a cluster. More cost build time \
            and find nearer neighbors.",
    source: "D. Meister and J. Bittner, Parallel locally-ordered clustering for bounding volume hierarchy \
             construction, 2018",
};

struct Ploc {
    costs: Costs,
    radius: usize,
}

impl Ploc {
    fn new(settings: &BuildSettings) -> Self {
        Ploc {
            costs: Costs::of(settings),
            radius: settings.constant("radius") as usize,
        }
    }
}

impl BvhBuilder for Ploc {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        collapse(&clustered(input, self.radius)?, self.costs, input.progress)
    }
}

/// A node without a parent.
#[derive(Clone, Copy)]
struct Cluster {
    bounds: Aabb,
    node: u32,
}

/// If so many rounds do not halve the number of clusters, the next one also merges neighbors.
const PATIENCE: u32 = 24;

/// So few clusters are merged without impatience.
const FEW: usize = 64;

/// Builds the hierarchy with one leaf per object.
///
/// ```text
/// clusters = objects in Morton order
/// while there is more than one cluster:
///     for every cluster i: nearest[i] = the cluster within the radius with the smallest key
///     merge all pairs that are nearest to each other; the union takes the place of the first
/// ```
///
/// # Errors
/// Cancellation.
pub fn clustered(input: &Input<'_>, radius: usize) -> Result<Binary, Cancelled> {
    let mut built = Binary::default();
    let order = morton::in_order(input)?;
    let mut clusters: Vec<Cluster> = order
        .into_iter()
        .map(|(_, object)| {
            let bounds = input.bounds[object as usize];
            let node = built.leaf(bounds, [object], StopReason::FewObjects);
            Cluster { bounds, node }
        })
        .collect();
    let all = clusters.len() as f64;
    let root = input.bounds.iter();
    let root = root.fold(Aabb::EMPTY, |all, bounds| all.union(bounds));
    let scene = Neighborhood {
        radius,
        root_area: root.surface_area(),
    };
    let mut nearest = Vec::new();
    let (mut goal, mut rounds) = (clusters.len() / 2, 0);
    while clusters.len() > 1 {
        scene.nearest_of_all(input, &clusters, &mut nearest)?;
        rounds += 1;
        let are_all_merged = rounds > PATIENCE && clusters.len() > FEW;
        merge(&mut clusters, &nearest, are_all_merged, &mut built);
        if are_all_merged || clusters.len() <= goal {
            (goal, rounds) = (clusters.len() / 2, 0);
        }
        input
            .progress
            .set(0.9 * (1.0 - clusters.len() as f64 / all));
    }
    Ok(built)
}

/// Where the nearest neighbor of a cluster is searched for.
struct Neighborhood {
    radius: usize,
    root_area: f64,
}

impl Neighborhood {
    /// Finds the nearest neighbor of every cluster.
    fn nearest_of_all(
        &self,
        input: &Input<'_>,
        clusters: &[Cluster],
        nearest: &mut Vec<u32>,
    ) -> Result<(), Cancelled> {
        /// Clusters between two checks for cancellation.
        const CHUNK: usize = 1 << 10;
        let find = |i: usize| {
            if i.is_multiple_of(CHUNK) && input.progress.is_cancelled() {
                return 0;
            }
            self.nearest_to(clusters, i)
        };
        let all = (0..clusters.len()).into_par_iter().with_min_len(CHUNK / 8);
        all.map(find).collect_into_vec(nearest);
        input.progress.check()
    }

    /// Returns the cluster nearest to another, of at least two.
    ///
    /// The nearest is the one with the smallest [`Key`], which is the same from both sides of a pair. So the pair
    /// with the smallest key of all is merged, and clustering comes to an end.
    fn nearest_to(&self, clusters: &[Cluster], i: usize) -> u32 {
        let around = i.saturating_sub(self.radius)..clusters.len().min(i + self.radius + 1);
        let bounds = &clusters[i].bounds;
        let mut best: Option<Key> = None;
        for j in around.filter(|&j| j != i) {
            let area = bounds.union(&clusters[j].bounds).surface_area();
            let key = Key {
                area: (area / self.root_area) as f32,
                apart: i ^ j,
            };
            if best.is_none_or(|best| key.compare(&best) == Ordering::Less) {
                best = Some(key);
            }
        }
        // The key tells the neighbor.
        best.map_or(i, |key| i ^ key.apart) as u32
    }
}

/// How near two clusters are: the area of their union, then the difference of the bits of their positions. Of two
/// pairs with one cluster in common, one is smaller.
///
/// Where all areas are equal, positions 0 and 1, 2 and 3, 4 and 5 and so on become pairs. If the lower position
/// decided, everyone would prefer a lower one, and only positions 0 and 1 would find each other.
#[derive(Clone, Copy)]
struct Key {
    /// Relative to the root's, in `f32`, so that rounding does not decide between equal areas.
    area: f32,
    apart: usize,
}

impl Key {
    fn compare(&self, other: &Key) -> Ordering {
        let area = self.area.total_cmp(&other.area);
        area.then_with(|| self.apart.cmp(&other.apart))
    }
}

/// Merges the clusters that are nearest to each other, and if `are_all_merged` the others two by two in their order.
///
/// Nearest neighbors may form a chain, as those of nested boxes do, where only the first two find each other. A
/// round for each cluster would take long and make the hierarchy deep. If all are merged from time to time, rounds
/// and levels are at most proportional to the logarithm of the number of objects.
fn merge(clusters: &mut Vec<Cluster>, nearest: &[u32], are_all_merged: bool, built: &mut Binary) {
    let is_pair = |i: usize| nearest[nearest[i] as usize] as usize == i;
    let mut union = |a: Cluster, b: Cluster| Cluster {
        bounds: a.bounds.union(&b.bounds),
        node: built.inner([a.node, b.node]),
    };
    let mut kept = 0;
    let mut waiting: Option<usize> = None;
    for i in 0..clusters.len() {
        let j = nearest[i] as usize;
        if is_pair(i) {
            if i < j {
                clusters[kept] = union(clusters[i], clusters[j]);
                kept += 1;
            }
        } else if let Some(place) = waiting.take() {
            clusters[place] = union(clusters[place], clusters[i]);
        } else {
            waiting = are_all_merged.then_some(kept);
            clusters[kept] = clusters[i];
            kept += 1;
        }
    }
    clusters.truncate(kept);
}
