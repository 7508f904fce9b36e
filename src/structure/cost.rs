//! The cost of splitting a node by the surface-area heuristic (SAH), for any plane along any axis.
//!
//! The cost is the expected number of intersection tests of a ray through the cell if both parts
//! become leaves: the number of objects in a part times the ratio of its area to the cell's area,
//! summed over both parts (J. D. MacDonald and K. S. Booth, Heuristics for ray tracing using space
//! subdivision, 1990). Traversal costs nothing here, as in the paper's method 2. Objects are
//! counted by their bounds, clipped to the cell, whatever rule the tree was built with.

use super::index::TreeIndex;
use super::tree::Tree;
use crate::geometry::{Aabb, Axis};
use crate::primitive::Shape;
use crate::scene::Scene;

/// A candidate plane with its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitCost {
    /// World coordinate of the plane.
    pub plane: f64,
    /// Number of objects below and above the plane; objects that meet it count on both sides.
    pub objects: [usize; 2],
    /// Expected number of intersection tests of a ray through the cell.
    pub cost: f64,
}

/// The cost along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct CostCurve {
    pub axis: Axis,
    /// Lower and upper end of the cell.
    pub range: [f64; 2],
    /// The middle of the cell.
    pub spatial_median: f64,
    /// The upper median of all bounds of objects in the cell; `None` without objects.
    pub object_median: Option<f64>,
    /// Lower and upper ends of the objects, each sorted.
    lows: Vec<f64>,
    highs: Vec<f64>,
    slack: f64,
    /// Fraction of the cell's area in the two faces parallel to the plane, and in the other four.
    faces: f64,
    rim: f64,
}

/// The costs of splitting one node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeCost {
    pub node: u32,
    pub cell: Aabb,
    /// Objects in the cell.
    pub objects: usize,
    /// Cost along x, y and z.
    pub curves: [CostCurve; 3],
    /// The plane of the tree; `None` for a leaf.
    pub chosen: Option<(Axis, SplitCost)>,
}

impl NodeCost {
    /// Computes the curves of a node.
    ///
    /// # Panics
    /// If the node does not exist.
    pub fn new(scene: &Scene, tree: &Tree, index: &TreeIndex, node: u32) -> Self {
        let mut objects =
            tree.references()[tree.references_below(node, index.of(node).end)].to_vec();
        objects.sort_unstable();
        objects.dedup();
        let bounds: Vec<Aabb> = objects
            .iter()
            .map(|&object| scene.objects()[object as usize].bounds())
            .collect();
        let cell = tree.cell_of(node).bounds;
        let slack = tree.frame().slack();
        let curves = Axis::ALL.map(|axis| CostCurve::new(&cell, axis, &bounds, slack));
        let chosen = tree
            .plane(node)
            .map(|(axis, plane)| (axis, curves[axis.index()].at(plane)));
        NodeCost {
            node,
            cell,
            objects: objects.len(),
            curves,
            chosen,
        }
    }

    /// Returns the cost of making the cell a leaf: one test per object.
    pub fn leaf_cost(&self) -> f64 {
        self.objects as f64
    }

    /// Returns the cheapest plane of all axes, the first if several are equal; `None` if no object
    /// ends inside the cell.
    pub fn cheapest(&self) -> Option<(Axis, SplitCost)> {
        self.curves
            .iter()
            .flat_map(|curve| curve.samples().into_iter().map(|s| (curve.axis, s)))
            .filter(|(axis, s)| {
                let [lo, hi] = self.curves[axis.index()].range;
                lo < s.plane && s.plane < hi
            })
            .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))
    }
}

impl CostCurve {
    fn new(cell: &Aabb, axis: Axis, bounds: &[Aabb], slack: f64) -> Self {
        let k = axis.index();
        let (lo, hi) = (cell.lo[k], cell.hi[k]);
        let mut lows: Vec<f64> = bounds.iter().map(|b| b.lo[k].max(lo)).collect();
        let mut highs: Vec<f64> = bounds.iter().map(|b| b.hi[k].min(hi)).collect();
        lows.sort_unstable_by(f64::total_cmp);
        highs.sort_unstable_by(f64::total_cmp);
        let mut all = [lows.as_slice(), highs.as_slice()].concat();
        let middle = all.len() / 2;
        let object_median =
            (!all.is_empty()).then(|| *all.select_nth_unstable_by(middle, f64::total_cmp).1);
        let size = cell.size();
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        let area = cell.surface_area();
        CostCurve {
            axis,
            range: [lo, hi],
            spatial_median: lo * 0.5 + hi * 0.5,
            object_median,
            lows,
            highs,
            slack,
            faces: 2.0 * u * v / area,
            rim: 2.0 * (u + v) * size[k] / area,
        }
    }

    /// Returns the cost of a plane, which is clamped to the cell. As in the build driver, an object
    /// within rounding of the plane counts on both sides.
    pub fn at(&self, plane: f64) -> SplitCost {
        let plane = plane.clamp(self.range[0], self.range[1]);
        let below = self.lows.partition_point(|&lo| lo <= plane + self.slack);
        let above = self.highs.len() - self.highs.partition_point(|&hi| hi < plane - self.slack);
        self.with(plane, [below, above])
    }

    fn with(&self, plane: f64, objects: [usize; 2]) -> SplitCost {
        let [lo, hi] = self.range;
        let part = if hi > lo {
            (plane - lo) / (hi - lo)
        } else {
            0.5
        };
        let [below, above] = objects.map(|n| n as f64);
        let cost =
            below * (self.faces + self.rim * part) + above * (self.faces + self.rim * (1.0 - part));
        SplitCost {
            plane,
            objects,
            cost,
        }
    }

    /// Returns the whole curve: the limits on both sides of every end of an object, where the cost
    /// jumps. The curve is linear in between.
    pub fn samples(&self) -> Vec<SplitCost> {
        let n = self.lows.len();
        let mut samples = vec![self.at(self.range[0])];
        let (mut started, mut ended) = (0, 0);
        while started < n || ended < n {
            let next = |ends: &[f64], done: usize| ends.get(done).copied().unwrap_or(f64::INFINITY);
            let plane = next(&self.lows, started).min(next(&self.highs, ended));
            // The limit from below, before the objects that start or end here are counted.
            if plane > self.range[0] {
                samples.push(self.with(plane, [started, n - ended]));
            }
            started += self.lows[started..].partition_point(|&lo| lo <= plane);
            ended += self.highs[ended..].partition_point(|&hi| hi <= plane);
            if plane < self.range[1] {
                samples.push(self.with(plane, [started, n - ended]));
            }
        }
        samples.push(self.at(self.range[1]));
        samples
    }

    /// Returns the curve in about `max_points` points at most, for drawing. Of a run of samples,
    /// only the lowest and the highest are kept.
    pub fn simplified(&self, max_points: usize) -> Vec<SplitCost> {
        let samples = self.samples();
        if samples.len() <= max_points {
            return samples;
        }
        let chunk = samples.len().div_ceil((max_points / 2).max(1));
        samples
            .chunks(chunk)
            .flat_map(|part| {
                let by_cost = |a: &&SplitCost, b: &&SplitCost| a.cost.total_cmp(&b.cost);
                let ends = [part.iter().min_by(by_cost), part.iter().max_by(by_cost)];
                let mut ends: Vec<SplitCost> = ends.into_iter().flatten().copied().collect();
                ends.sort_by(|a, b| a.plane.total_cmp(&b.plane));
                ends
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::index::tests::small;
    use crate::structure::{BuildSettings, Method, build};

    #[test]
    fn where_method_2_may_choose_any_plane_it_chooses_the_cheapest() {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:1"), &progress).unwrap();
        let mut settings = BuildSettings::for_method(Method::named("sah-cut").unwrap());
        for name in ["median-interval", "gap-fraction"] {
            settings.constants.insert(name.to_owned(), 1.0);
        }
        let tree = build(&scene, &settings, &progress).unwrap();
        let index = TreeIndex::new(&tree, scene.objects().len());
        let mut compared = 0;
        for node in 0..tree.nodes().len() as u32 {
            let cost = NodeCost::new(&scene, &tree, &index, node);
            assert_eq!(cost.objects, index.of(node).objects as usize);
            let (Some((_, chosen)), Some((_, cheapest))) = (cost.chosen, cost.cheapest()) else {
                continue;
            };
            // The method places planes slightly outside the objects.
            assert!(chosen.cost <= cheapest.cost * 1.001 + 1e-4, "node {node}");
            assert!(chosen.cost < cost.leaf_cost());
            compared += 1;
        }
        assert!(compared > 5);
    }

    #[test]
    fn the_chosen_plane_counts_what_its_children_hold() {
        let (scene, tree) = small("tetra:3", "sah-cut");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let mut compared = 0;
        for node in 0..tree.nodes().len() as u32 {
            let children = tree.child_nodes(node);
            let held: Vec<_> = children
                .map(|child| index.of(child).objects as usize)
                .collect();
            let Some((_, chosen)) = NodeCost::new(&scene, &tree, &index, node).chosen else {
                assert!(held.is_empty());
                continue;
            };
            assert_eq!(chosen.objects.as_slice(), held, "node {node}");
            compared += 1;
        }
        assert!(compared > 5);
    }

    #[test]
    fn samples_lie_on_the_curve_and_few_of_them_keep_its_extremes() {
        let (scene, tree) = small("balls:1", "midpoint");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let cost = NodeCost::new(&scene, &tree, &index, 0);
        for curve in &cost.curves {
            let samples = curve.samples();
            assert!(samples.is_sorted_by(|a, b| a.plane <= b.plane));
            for pair in samples
                .windows(2)
                .filter(|p| p[1].plane - p[0].plane > 1e-9)
            {
                let middle = curve.at((pair[0].plane + pair[1].plane) * 0.5);
                assert!((middle.cost - (pair[0].cost + pair[1].cost) * 0.5).abs() < 1e-9);
            }
            let least = |s: &[SplitCost]| s.iter().map(|s| s.cost).fold(f64::INFINITY, f64::min);
            assert_eq!(least(&samples), least(&curve.simplified(8)));
            assert!(curve.simplified(8).len() <= 8);
        }
    }
}
