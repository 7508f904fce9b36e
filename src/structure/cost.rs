//! The cost of splitting a node by the surface-area heuristic (SAH), for any split along any axis.
//!
//! The cost is the expected number of intersection tests of a ray through the cell if both parts
//! become leaves: the number of objects in a part times the ratio of its area to the cell's area,
//! summed over both parts (J. D. MacDonald and K. S. Booth, Heuristics for ray tracing using space
//! subdivision, 1990).
//!
//! A plane splits a cell. Traversal costs nothing there, as in the paper's method 2. Objects are
//! counted by their bounds, clipped to the cell, whatever rule the tree was built with.
//!
//! In a bounding volume hierarchy, the objects are sorted by the centers of their bounds, and any place in
//! that order splits them into two boxes, each of which is tested.

use super::index::TreeIndex;
use super::nodes::Nodes;
use super::tree::Tree;
use crate::geometry::{Aabb, Axis};
use crate::primitive::Shape;
use crate::scene::Scene;

/// A candidate split with its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitCost {
    /// World coordinate of the plane; in a hierarchy, of a plane between the centers of both parts.
    pub plane: f64,
    /// Number of objects below and above the plane. Objects that meet it count on both sides; in a
    /// hierarchy, every object counts on the side of its center.
    pub objects: [usize; 2],
    /// Expected number of intersection tests of a ray through the cell.
    pub cost: f64,
}

/// The cost along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct CostCurve {
    pub axis: Axis,
    /// Lower and upper end of the cell; in a hierarchy, a little below and above all centers.
    pub range: [f64; 2],
    /// The middle of the cell; in a hierarchy, between the outermost centers.
    pub spatial_median: f64,
    /// The upper median of all bounds of objects in the cell, in a hierarchy of their centers; `None` without
    /// objects.
    pub object_median: Option<f64>,
    splits: Splits,
}

/// What splits a node.
#[derive(Clone, Debug, PartialEq)]
enum Splits {
    Planes {
        /// Lower and upper ends of the objects, each sorted.
        lows: Vec<f64>,
        highs: Vec<f64>,
        slack: f64,
        /// Fraction of the cell's area in the two faces parallel to the plane, and in the other four.
        faces: f64,
        rim: f64,
    },
    Centers {
        /// The centers of the objects along the axis, sorted.
        centers: Vec<f64>,
        /// The cost if as many objects as the index says are in the first part; that at 0 means no split.
        costs: Vec<f64>,
        /// The objects in the order of their centers.
        order: Vec<u32>,
    },
}

/// The children of a node in a hierarchy.
#[derive(Clone, Debug, PartialEq)]
pub struct Division {
    /// Number of objects in each child.
    pub objects: Vec<usize>,
    /// Expected number of intersection tests of a ray through the box.
    pub cost: f64,
}

/// How far the range of a curve reaches beyond the centers, as a share of their width.
const MARGIN: f64 = 0.08;

/// The costs of splitting one node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeCost {
    pub node: u32,
    pub cell: Aabb,
    /// Objects in the cell.
    pub objects: usize,
    /// Cost along x, y and z.
    pub curves: [CostCurve; 3],
    /// The split of the tree; `None` for a leaf, and in a hierarchy if no axis has the children apart.
    pub chosen: Option<(Axis, SplitCost)>,
    /// The children; `None` for a leaf and for a node with a plane.
    pub division: Option<Division>,
    /// The part of every split's cost that is due to the box tests, in intersection tests. 0 for planes.
    pub traversal: f64,
    /// Whether boxes split the node rather than a plane.
    pub has_boxes: bool,
}

impl NodeCost {
    /// Computes the curves of a node.
    ///
    /// # Panics
    /// If the node does not exist.
    pub fn new(scene: &Scene, tree: &Tree, index: &TreeIndex, node: u32) -> Self {
        let mut objects = objects_below(tree, index, node).to_vec();
        objects.sort_unstable();
        objects.dedup();
        let bounds: Vec<Aabb> = objects
            .iter()
            .map(|&object| scene.objects()[object as usize].bounds())
            .collect();
        let cell = tree.cell_of(node).bounds;
        let mut cost = NodeCost {
            node,
            cell,
            objects: objects.len(),
            curves: Axis::ALL.map(|axis| CostCurve::empty(&cell, axis)),
            chosen: None,
            division: None,
            traversal: 0.0,
            has_boxes: matches!(tree.nodes(), Nodes::Boxes(_)),
        };
        if cost.has_boxes {
            cost.traversal = traversal_cost(tree);
            let traversal = cost.traversal;
            for curve in &mut cost.curves {
                curve.set_centers(&cell, &objects, &bounds, traversal);
            }
            cost.division = division(tree, index, node, &cell, traversal);
            cost.chosen = cost.apart(scene, tree, index);
        } else {
            let slack = tree.frame().slack();
            for curve in &mut cost.curves {
                curve.set_planes(&cell, &bounds, slack);
            }
            let plane = tree.plane(node);
            cost.chosen = plane.map(|(axis, at)| (axis, cost.curves[axis.index()].at(at)));
        }
        cost
    }

    /// Returns the cost of making the cell a leaf: one test per object.
    pub fn leaf_cost(&self) -> f64 {
        self.objects as f64
    }

    /// Returns the cheapest split of all axes, the first if several are equal; `None` if there is none: no
    /// object ends inside the cell, or all centers coincide.
    pub fn cheapest(&self) -> Option<(Axis, SplitCost)> {
        self.curves
            .iter()
            .flat_map(|curve| curve.samples().into_iter().map(|s| (curve.axis, s)))
            .filter(|(axis, s)| {
                let [lo, hi] = self.curves[axis.index()].range;
                self.has_boxes || lo < s.plane && s.plane < hi
            })
            .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))
    }

    /// Returns the boxes of the two parts into which a plane between centers splits the objects of a node in a
    /// hierarchy. A part without objects has an empty box. `None` if planes split the node.
    pub fn boxes_at(&self, scene: &Scene, axis: Axis, plane: f64) -> Option<[Aabb; 2]> {
        let Splits::Centers { centers, order, .. } = &self.curves[axis.index()].splits else {
            return None;
        };
        let first = centers.partition_point(|&center| center <= plane);
        let (below, above) = order.split_at(first);
        Some([below, above].map(|part| {
            let bounds = part.iter().map(|&o| scene.objects()[o as usize].bounds());
            bounds.fold(Aabb::EMPTY, |all, bounds| all.union(&bounds))
        }))
    }

    /// Returns the axis along which the centers of the two children's objects lie farthest apart, with a plane
    /// between them. Centers that coincide lie apart by nothing.
    fn apart(&self, scene: &Scene, tree: &Tree, index: &TreeIndex) -> Option<(Axis, SplitCost)> {
        let division = self.division.as_ref()?;
        let children: Vec<u32> = tree.child_nodes(self.node).collect();
        let &[a, b] = children.as_slice() else {
            return None;
        };
        let range = |child: u32, axis: Axis| {
            let objects = objects_below(tree, index, child).iter();
            let centers = objects.map(|&o| center(&scene.objects()[o as usize].bounds(), axis));
            centers.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], at| {
                [lo.min(at), hi.max(at)]
            })
        };
        let [n_a, n_b] = [division.objects[0], division.objects[1]];
        let mut best: Option<(f64, Axis, SplitCost)> = None;
        for axis in Axis::ALL {
            let ([a_lo, a_hi], [b_lo, b_hi]) = (range(a, axis), range(b, axis));
            for (below, above, objects) in [(a_hi, b_lo, [n_a, n_b]), (b_hi, a_lo, [n_b, n_a])] {
                let gap = above - below;
                if gap >= 0.0 && best.is_none_or(|(known, ..)| gap > known) {
                    let split = SplitCost {
                        plane: below * 0.5 + above * 0.5,
                        objects,
                        cost: division.cost,
                    };
                    best = Some((gap, axis, split));
                }
            }
        }
        best.map(|(_, axis, split)| (axis, split))
    }
}

/// Returns the references of all leaves below a node.
fn objects_below<'a>(tree: &'a Tree, index: &TreeIndex, node: u32) -> &'a [u32] {
    &tree.references()[tree.references_below(node, index.of(node).end)]
}

/// Returns the center of bounds along an axis, as builders of hierarchies compute it.
fn center(bounds: &Aabb, axis: Axis) -> f64 {
    bounds.lo[axis.index()] * 0.5 + bounds.hi[axis.index()] * 0.5
}

/// Returns what visiting a node costs the builder of a hierarchy, in intersection tests; 0 if its method has no
/// such costs.
fn traversal_cost(tree: &Tree) -> f64 {
    let settings = tree.settings();
    let cost = |name: &str| {
        let known = settings.method.constants.iter().any(|c| c.name == name);
        known.then(|| settings.constant(name))
    };
    match (cost("cost-traversal"), cost("cost-test")) {
        (Some(traversal), Some(test)) if test > 0.0 => traversal / test,
        _ => 0.0,
    }
}

/// Returns the children of a node in a hierarchy with their cost; `None` for a leaf.
fn division(
    tree: &Tree,
    index: &TreeIndex,
    node: u32,
    cell: &Aabb,
    traversal: f64,
) -> Option<Division> {
    let mut division = Division {
        objects: Vec::new(),
        cost: traversal,
    };
    for child in tree.child_nodes(node) {
        let facts = index.of(child);
        let objects = facts.objects as usize;
        division.objects.push(objects);
        division.cost += facts.area / cell.surface_area() * objects as f64;
    }
    (!division.objects.is_empty()).then_some(division)
}

impl CostCurve {
    fn empty(cell: &Aabb, axis: Axis) -> Self {
        let (lo, hi) = (cell.lo[axis.index()], cell.hi[axis.index()]);
        CostCurve {
            axis,
            range: [lo, hi],
            spatial_median: lo * 0.5 + hi * 0.5,
            object_median: None,
            splits: Splits::Centers {
                centers: Vec::new(),
                costs: Vec::new(),
                order: Vec::new(),
            },
        }
    }

    fn set_planes(&mut self, cell: &Aabb, bounds: &[Aabb], slack: f64) {
        let k = self.axis.index();
        let [lo, hi] = self.range;
        let mut lows: Vec<f64> = bounds.iter().map(|b| b.lo[k].max(lo)).collect();
        let mut highs: Vec<f64> = bounds.iter().map(|b| b.hi[k].min(hi)).collect();
        lows.sort_unstable_by(f64::total_cmp);
        highs.sort_unstable_by(f64::total_cmp);
        let mut all = [lows.as_slice(), highs.as_slice()].concat();
        let middle = all.len() / 2;
        self.object_median =
            (!all.is_empty()).then(|| *all.select_nth_unstable_by(middle, f64::total_cmp).1);
        let size = cell.size();
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        let area = cell.surface_area();
        self.splits = Splits::Planes {
            lows,
            highs,
            slack,
            faces: 2.0 * u * v / area,
            rim: 2.0 * (u + v) * size[k] / area,
        };
    }

    fn set_centers(&mut self, cell: &Aabb, objects: &[u32], bounds: &[Aabb], traversal: f64) {
        let n = objects.len();
        let mut places: Vec<usize> = (0..n).collect();
        let center = |place: usize| center(&bounds[place], self.axis);
        // Objects are in ascending order.
        places.sort_by(|&a, &b| center(a).total_cmp(&center(b)));
        let centers: Vec<f64> = places.iter().map(|&place| center(place)).collect();
        self.object_median = centers.get(n / 2).copied();
        if let [first, .., last] = centers[..]
            && first < last
        {
            // Nothing happens beside the centers.
            let margin = MARGIN * (last - first);
            self.range = [first - margin, last + margin];
            self.spatial_median = first * 0.5 + last * 0.5;
        }
        let area = cell.surface_area();
        // A flat box of a single point has no area: nothing is gained there.
        let share = |bounds: &Aabb| match area > 0.0 {
            true => bounds.surface_area() / area,
            false => 1.0,
        };
        let mut costs = vec![n as f64 + traversal; n];
        let mut part = Aabb::EMPTY;
        for first in (1..n).rev() {
            part = part.union(&bounds[places[first]]);
            costs[first] = traversal + share(&part) * (n - first) as f64;
        }
        let mut part = Aabb::EMPTY;
        for first in 1..n {
            part = part.union(&bounds[places[first - 1]]);
            costs[first] += share(&part) * first as f64;
        }
        self.splits = Splits::Centers {
            centers,
            costs,
            order: places.into_iter().map(|place| objects[place]).collect(),
        };
    }

    /// Returns the cost of a plane, which is clamped to the cell. As in the build driver, an object
    /// within rounding of the plane counts on both sides. In a hierarchy it is the cost of dividing the
    /// objects by the sides of their centers; a center in the plane counts below.
    pub fn at(&self, plane: f64) -> SplitCost {
        let plane = plane.clamp(self.range[0], self.range[1]);
        match &self.splits {
            Splits::Planes {
                lows, highs, slack, ..
            } => {
                let below = lows.partition_point(|&lo| lo <= plane + slack);
                let above = highs.len() - highs.partition_point(|&hi| hi < plane - slack);
                self.with(plane, [below, above])
            }
            Splits::Centers { centers, costs, .. } => {
                let n = centers.len();
                let first = centers.partition_point(|&center| center <= plane);
                SplitCost {
                    plane,
                    objects: [first, n - first],
                    cost: costs.get(first % n.max(1)).copied().unwrap_or_default(),
                }
            }
        }
    }

    /// Returns the cost of a plane with these objects on its sides.
    fn with(&self, plane: f64, objects: [usize; 2]) -> SplitCost {
        let Splits::Planes { faces, rim, .. } = self.splits else {
            unreachable!("only planes have parts of a cell");
        };
        let [lo, hi] = self.range;
        let part = if hi > lo {
            (plane - lo) / (hi - lo)
        } else {
            0.5
        };
        let [below, above] = objects.map(|n| n as f64);
        let cost = below * (faces + rim * part) + above * (faces + rim * (1.0 - part));
        SplitCost {
            plane,
            objects,
            cost,
        }
    }

    /// Returns the whole curve. Of planes: the limits on both sides of every end of an object, where the cost
    /// jumps; the curve is linear in between. Of a hierarchy: the cost from each center to the next, between
    /// which it is constant.
    pub fn samples(&self) -> Vec<SplitCost> {
        match &self.splits {
            Splits::Planes { lows, highs, .. } => self.samples_of_planes(lows, highs),
            Splits::Centers { centers, costs, .. } => {
                let n = centers.len();
                let between = (1..n).filter(|&first| centers[first - 1] < centers[first]);
                let sample = |first: usize, plane: f64| SplitCost {
                    plane,
                    objects: [first, n - first],
                    cost: costs[first],
                };
                between
                    .flat_map(|first| {
                        [centers[first - 1], centers[first]].map(|plane| sample(first, plane))
                    })
                    .collect()
            }
        }
    }

    fn samples_of_planes(&self, lows: &[f64], highs: &[f64]) -> Vec<SplitCost> {
        let n = lows.len();
        let mut samples = vec![self.at(self.range[0])];
        let (mut started, mut ended) = (0, 0);
        while started < n || ended < n {
            let next = |ends: &[f64], done: usize| ends.get(done).copied().unwrap_or(f64::INFINITY);
            let plane = next(lows, started).min(next(highs, ended));
            // The limit from below, before the objects that start or end here are counted.
            if plane > self.range[0] {
                samples.push(self.with(plane, [started, n - ended]));
            }
            started += lows[started..].partition_point(|&lo| lo <= plane);
            ended += highs[ended..].partition_point(|&hi| hi <= plane);
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

    #[test]
    fn a_sweep_takes_the_cheapest_split_of_the_centers() {
        let (scene, tree) = small("balls:2", "bvh-sweep");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let mut compared = 0;
        for node in 0..tree.nodes().len() as u32 {
            let cost = NodeCost::new(&scene, &tree, &index, node);
            assert!(cost.has_boxes);
            let Some(division) = &cost.division else {
                assert!(cost.chosen.is_none() && tree.child_nodes(node).next().is_none());
                continue;
            };
            let (axis, chosen) = cost.chosen.expect("centers lie apart");
            let (_, cheapest) = cost.cheapest().expect("centers differ");
            assert!(division.cost < cheapest.cost * (1.0 + 1e-4), "node {node}");
            assert!(division.cost < cost.leaf_cost());
            assert_eq!(chosen.objects.iter().sum::<usize>(), cost.objects);
            let sample = cost.curves[axis.index()].at(chosen.plane);
            if sample.objects != chosen.objects {
                // Of objects with the same center, the sweep puts some on either side.
                continue;
            }
            assert!(division.cost > cheapest.cost * (1.0 - 1e-4), "node {node}");
            assert!((sample.cost - chosen.cost).abs() < 1e-4 * chosen.cost);
            // The children's boxes are those of both parts, but for rounding.
            let children = tree.children(&tree.cell_of(node));
            let children: Vec<Aabb> = children.map(|child| child.bounds).collect();
            let parts = cost.boxes_at(&scene, axis, chosen.plane).unwrap();
            let slack = 1e-5 * tree.root_cell().size().max_element();
            let is_near = |a: &Aabb, b: &Aabb| {
                let ends = (a.lo - b.lo).abs().max((a.hi - b.hi).abs());
                ends.max_element() < slack
            };
            let are = |[a, b]: [&Aabb; 2]| is_near(&parts[0], a) && is_near(&parts[1], b);
            let [a, b] = [&children[0], &children[1]];
            assert!(are([a, b]) || are([b, a]), "node {node}");
            compared += 1;
        }
        assert!(compared > 20);
    }

    #[test]
    fn without_a_split_a_hierarchy_pays_for_its_box_tests() {
        let (scene, tree) = small("balls:1", "bvh-sweep");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let cost = NodeCost::new(&scene, &tree, &index, 0);
        assert_eq!(cost.traversal, 1.2);
        for curve in &cost.curves {
            let outside = curve.at(curve.range[0]);
            assert_eq!(outside.objects, [0, cost.objects]);
            assert_eq!(outside.cost, cost.leaf_cost() + 1.2);
            assert!(curve.samples().len() <= 2 * (cost.objects - 1));
        }
    }
}
