//! What single build methods promise: where their planes lie, where they end, and that octree and grid
//! are what their names say.

use crate::support::scenes::{self, scene, tree_with};
use bspscope::geometry::{Aabb, Ray, Vec3};
use bspscope::measure::{DELTA, LAMBDA, TreeFacts, change, measure, parameter, unequal};
use bspscope::primitive::{Precision, Primitive, Shape};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{
    BuildSettings, CellOfNode, Constants, MaxDepth, NodeKind, OverlapRule, StopReason, Tree,
};
use bspscope::trace::{BoxTest, Children, Probe, RenderSettings, Scratch, closest_hit};

fn settings(method: &str, constants: &[(&str, f64)]) -> BuildSettings {
    BuildSettings {
        constants: Constants::from_iter(constants.iter().map(|&(k, v)| (k.to_owned(), v))),
        ..scenes::settings(method)
    }
}

fn tree(scene: &Scene, method: &str, constants: &[(&str, f64)]) -> Tree {
    tree_with(scene, &settings(method, constants))
}

/// Every inner node's cell with its plane's axis and place between the cell's ends, 0 to 1.
fn planes(tree: &Tree) -> Vec<(CellOfNode, usize, f64)> {
    let planes: Vec<_> = tree
        .cells()
        .filter_map(|cell| {
            let (axis, plane) = tree.plane(cell.node)?;
            let k = axis.index();
            let [lo, hi] = [cell.bounds.lo[k], cell.bounds.hi[k]];
            Some((cell, k, (plane - lo) / (hi - lo)))
        })
        .collect();
    assert!(planes.len() > 100, "{} planes", planes.len());
    planes
}

fn leaves(tree: &Tree) -> impl Iterator<Item = (CellOfNode, StopReason, u32)> + '_ {
    tree.cells().filter_map(|cell| match tree.kind(cell.node) {
        NodeKind::Leaf { stop, count, .. } => Some((cell, stop, count)),
        NodeKind::Inner => None,
    })
}

#[test]
fn midpoint_on_the_longest_axis_halves_it() {
    let balls = scene("balls:3");
    for (cell, axis, place) in planes(&tree(&balls, "midpoint-longest", &[])) {
        let size = cell.bounds.size();
        assert!(size[axis] >= size.max_element() * (1.0 - 1e-6), "{cell:?}");
        assert!((place - 0.5).abs() < 1e-6);
    }
}

#[test]
fn sampled_planes_lie_at_equal_steps_and_more_of_them_expect_less_work() {
    let balls = scene("balls:3");
    for samples in [1.0, 3.0, 7.0] {
        let tree = tree(&balls, "sah-sampled", &[("samples", samples)]);
        let mut places = std::collections::BTreeSet::new();
        for (_, _, place) in planes(&tree) {
            let step = place * (samples + 1.0);
            assert!((step - step.round()).abs() < 1e-4, "{place}");
            places.insert(step.round() as u32);
        }
        assert_eq!(places.len(), samples as usize, "all places are used");
    }
    // In turn, the depth says which axis.
    for (cell, axis, _) in planes(&tree(&balls, "sah-sampled", &[("in-turn", 1.0)])) {
        assert_eq!(axis as u32, cell.depth % 3);
    }
    let full_leaves = |cost_stop| {
        let tree = tree(&balls, "sah-sampled", &[("cost-stop", cost_stop)]);
        leaves(&tree)
            .filter(|(_, stop, _)| *stop == StopReason::LeafIsCheaper)
            .count()
    };
    assert!(full_leaves(1.0) > 0);
    assert_eq!(full_leaves(0.0), 0);
}

#[test]
fn a_sampled_plane_is_the_cheapest_by_area_and_count() {
    let balls = scene("balls:2");
    let bounds: Vec<Aabb> = balls.objects().iter().map(Shape::bounds).collect();
    let tree = tree(&balls, "sah-sampled", &[]);
    let root = tree.root();
    let (axis, plane) = tree.plane(0).unwrap();
    let cost = |k: usize, plane: f64| {
        let (mut lower, mut upper) = (root.bounds, root.bounds);
        (lower.hi[k], upper.lo[k]) = (plane, plane);
        [lower, upper]
            .map(|part| {
                let held = bounds.iter().filter(|b| b.touches(&part)).count();
                held as f64 * part.surface_area()
            })
            .iter()
            .sum::<f64>()
    };
    let chosen = cost(axis.index(), plane);
    for k in 0..3 {
        for sample in 1..8 {
            let share = f64::from(sample) / 8.0;
            let plane = root.bounds.lo[k] + root.bounds.size()[k] * share;
            assert!(chosen <= cost(k, plane) * (1.0 + 1e-6), "{k} {sample}");
        }
    }
}

/// The failed splits on the way to every leaf that stopped because none was allowed any more, found
/// from the finished tree: splits whose parts are expected to cost too large a share of the cell.
fn failed_above(tree: &Tree, ratio: f64, traversal: f64, bonus: f64) -> Vec<u32> {
    let held = |node: u32| {
        let mut objects: Vec<u32> = Vec::new();
        let mut stack = vec![node];
        while let Some(node) = stack.pop() {
            match tree.kind(node) {
                NodeKind::Inner => stack.extend(tree.child_nodes(node)),
                NodeKind::Leaf { .. } => objects.extend(tree.leaf_objects(node)),
            }
        }
        objects.sort_unstable();
        objects.dedup();
        objects.len() as f64
    };
    let mut found = Vec::new();
    let mut stack = vec![(tree.root(), 0)];
    while let Some((cell, failed)) = stack.pop() {
        match tree.children(&cell).collect::<Vec<_>>()[..] {
            [below, above] => {
                let parts = [below, above];
                let [a, b] = parts.map(|part| held(part.node));
                let mut cost = traversal
                    + (a * parts[0].bounds.surface_area() + b * parts[1].bounds.surface_area())
                        / cell.bounds.surface_area();
                if a == 0.0 || b == 0.0 {
                    cost *= 1.0 - bonus;
                }
                let failed = failed + u32::from(cost >= ratio * held(cell.node));
                stack.extend(parts.map(|part| (part, failed)));
            }
            _ => {
                if let NodeKind::Leaf {
                    stop: StopReason::LeafIsCheaper,
                    ..
                } = tree.kind(cell.node)
                {
                    found.push(failed);
                }
            }
        }
    }
    found
}

#[test]
fn automatic_termination_allows_so_many_failed_splits_on_the_way_to_a_leaf() {
    let balls = scene("balls:2");
    for failures in [0.0, 1.0, 3.0] {
        let constants = [("failures", failures), ("failures-per-level", 0.0)];
        let failed = failed_above(&tree(&balls, "sah-auto", &constants), 0.75, 0.75, 0.2);
        assert!(failed.len() >= 10, "{}", failed.len());
        assert!(
            failed.iter().all(|&n| f64::from(n) == failures),
            "{failed:?}"
        );
    }
    // The allowance grows with D_MAX: 1 + 0.2 · 10.
    let mut shallow = settings("sah-auto", &[]);
    shallow.d_max = MaxDepth::Fixed(10);
    let tree = tree_with(&balls, &shallow);
    let failed = failed_above(&tree, 0.75, 0.75, 0.2);
    assert!(!failed.is_empty() && failed.iter().all(|&n| n == 3));
}

#[test]
fn a_bonus_for_empty_space_cuts_more_of_it_off() {
    let tetra = scene("tetra:4");
    let full = |bonus| {
        let facts = TreeFacts::of(&tree(&tetra, "sah-auto", &[("empty-bonus", bonus)]));
        facts.root_volume - facts.empty_volume.unwrap()
    };
    assert!(full(0.5) < full(0.0), "{} {}", full(0.5), full(0.0));
}

/// What an octree with children by eights holds: leaves, empty leaves and references.
fn octree(cell: Aabb, objects: &[&Primitive], levels: u32) -> [u64; 3] {
    let held: Vec<&Primitive> = objects
        .iter()
        .copied()
        .filter(|object| object.overlaps(&cell))
        .collect();
    if held.len() <= 1 || levels == 0 {
        return [1, u64::from(held.is_empty()), held.len() as u64];
    }
    let middle = cell.lo * 0.5 + cell.hi * 0.5;
    let mut sum = [0; 3];
    for child in 0..8 {
        let mut part = cell;
        for k in 0..3 {
            if child >> k & 1 == 0 {
                part.hi[k] = middle[k];
            } else {
                part.lo[k] = middle[k];
            }
        }
        let counts = octree(part, &held, levels - 1);
        for (sum, count) in sum.iter_mut().zip(counts) {
            *sum += count;
        }
    }
    sum
}

#[test]
fn an_octree_has_the_leaves_of_one_with_children_by_eights() {
    // Spheres alone, as they are held against cells exactly.
    let mut parts = scene("balls:2").parts().clone();
    parts
        .objects
        .retain(|object| matches!(object, Primitive::Sphere(_)));
    parts.material_of.truncate(parts.objects.len());
    let balls = Scene::new(parts);
    let objects: Vec<&Primitive> = balls.objects().iter().collect();
    for (d_max, levels) in [(2, 0), (3, 1), (14, 4), (15, 5)] {
        let mut settings = settings("octree", &[]);
        settings.d_max = MaxDepth::Fixed(d_max);
        let tree = tree_with(&balls, &settings);
        let facts = TreeFacts::of(&tree);
        assert_eq!(
            [facts.leaves, facts.empty_leaves, facts.references],
            octree(tree.root_cell(), &objects, levels),
            "D_MAX {d_max}"
        );
        assert!(leaves(&tree).all(|(cell, ..)| cell.depth.is_multiple_of(3)));
        assert_eq!(facts.inner_nodes % 7, 0);
        assert_eq!(tree.depth_reached(), 3 * levels);
    }
}

/// V. Havran, statistics of octrees and grids on the SPD scenes, 1999 (`docs/havran_stats_octrees.txt` and
/// `docs/havran_stats_grids.txt` in the SPD repository): leaves, empty leaves, references. An octree's depth is
/// counted in levels of eight children.
#[test]
fn octrees_and_grids_have_the_published_counts() {
    let counts = |scene: &Scene, settings: &BuildSettings| {
        let facts = TreeFacts::of(&tree_with(scene, settings));
        [facts.leaves, facts.empty_leaves, facts.references]
    };
    let octree = |scene: &Scene, levels: u32| {
        let mut settings = settings("octree", &[]);
        settings.d_max = MaxDepth::Fixed(3 * levels);
        settings.overlap = OverlapRule::Bounds;
        counts(scene, &settings)
    };
    let tetra = scene("tetra");
    assert_eq!(octree(&tetra, 4), [2136, 1072, 13_312]);
    assert_eq!(octree(&tetra, 5), [9584, 4764, 32_768]);
    assert_eq!(octree(&tetra, 6), [43_324, 21_100, 110_592]);
    assert_eq!(octree(&tetra, 7), [198_892, 80_444, 512_000]);
    // 35 voxels along each axis.
    let mut grid = settings("grid", &[("density", 10.47)]);
    grid.overlap = OverlapRule::Bounds;
    assert_eq!(counts(&tetra, &grid), [42_875, 37_311, 35_936]);
    // Cylinders and the rounding of coordinates differ: a few references do, too.
    for (name, published) in [("balls", [400, 300, 9171]), ("rings", [1618, 416, 22_505])] {
        let found = octree(&scene(name), 4);
        assert_eq!(found[..2], published[..2], "{name}");
        let off = found[2] as f64 / published[2] as f64 - 1.0;
        assert!(off.abs() < 0.023, "{name}: {} references", found[2]);
    }
}

#[test]
fn a_grid_is_equal_voxels_as_many_as_its_density_asks() {
    let balls = scene("balls:3");
    for density in [0.5, 5.0, 40.0] {
        let tree = tree(&balls, "grid", &[("density", density)]);
        let counts = tree.voxels().unwrap().counts();
        let root = tree.root_cell().size().to_array();
        let size: [f64; 3] = std::array::from_fn(|k| root[k] / counts[k] as f64);
        let mut found = 0;
        for (cell, stop, count) in leaves(&tree) {
            found += 1;
            for (found, size) in cell.bounds.size().to_array().into_iter().zip(size) {
                assert!((found / size - 1.0).abs() < 1e-4);
            }
            let expected = if count == 0 {
                StopReason::Empty
            } else {
                StopReason::Voxel
            };
            assert_eq!(stop, expected);
        }
        assert_eq!(found, counts.iter().product::<usize>());
        let wanted = density * balls.objects().len() as f64;
        assert!(
            (found as f64 / wanted - 1.0).abs() < 0.2,
            "{found} for {wanted}"
        );
        // About cubic.
        let longest = size.iter().copied().fold(0.0, f64::max);
        assert!(size.iter().all(|s| s / longest > 0.6), "{size:?}");
    }
}

/// Keeps the leaves that a ray visits.
#[derive(Default)]
struct Visited(Vec<(u32, [f64; 2])>);

impl Probe for Visited {
    fn inner(&mut self, _: u32, _: [f64; 2], _: f64, _: f64, _: Children) {
        panic!("a grid has no inner nodes to traverse");
    }
    fn boxes(&mut self, _: u32, _: [f64; 2], _: &[BoxTest]) {
        panic!("a grid has no boxes");
    }
    fn culled(&mut self, _: u32, _: f64, _: f64) {}
    fn leaf(&mut self, node: u32, _: &[u32], within: [f64; 2]) {
        self.0.push((node, within));
    }
    fn test(&mut self, _: u32, _: impl FnOnce() -> Option<f64>) {}
}

#[test]
fn rays_visit_the_voxels_that_they_pass_and_no_others_in_order() {
    let balls = scene("balls:2");
    let tree = tree(&balls, "grid", &[("density", 20.0)]);
    let root = tree.root_cell();
    let cells: Vec<CellOfNode> = leaves(&tree).map(|(cell, ..)| cell).collect();
    let mut random = 1_u64;
    let mut next = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (random >> 33) as f64 / f64::from(u32::MAX >> 1)
    };
    let mut scratch = Scratch::default();
    let (mut rays, mut most) = (0, 0);
    for i in 0..600 {
        let mut point = || root.lo + root.size() * Vec3::new(next(), next(), next());
        let (a, b) = (point(), point());
        let mut direction = b - a;
        // Some along one or two axes, in both directions.
        for k in 0..3 {
            if i % 4 == 1 && k == i / 4 % 3 || i % 4 == 2 && k != i / 4 % 3 {
                direction[k] = if i % 8 < 4 { 0.0 } else { -0.0 };
            }
        }
        let origin = if i % 5 == 0 { a } else { a - 3.0 * direction };
        let ray = Ray::new(origin, direction);
        let shapes = balls.shapes(Precision::F64);
        let mut visited = Visited::default();
        let hit = closest_hit(&tree, shapes, &ray, &mut scratch, &mut visited);
        let end = hit.t.min(1e9);
        let passed = |grown: f64| -> Vec<u32> {
            cells
                .iter()
                .filter(|cell| {
                    let (mut t0, mut t1) = (0.0_f64, end);
                    for k in 0..3 {
                        let [lo, hi] = [cell.bounds.lo[k] - grown, cell.bounds.hi[k] + grown];
                        let (o, d) = (ray.origin[k], ray.direction[k]);
                        if d == 0.0 {
                            if o < lo || o > hi {
                                return false;
                            }
                            continue;
                        }
                        let (a, b) = ((lo - o) / d, (hi - o) / d);
                        t0 = t0.max(a.min(b));
                        t1 = t1.min(a.max(b));
                    }
                    t0 <= t1
                })
                .map(|cell| cell.node)
                .collect()
        };
        let found: Vec<u32> = visited.0.iter().map(|&(node, _)| node).collect();
        let mut once = found.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), found.len(), "{ray:?}: twice");
        let (surely, perhaps) = (passed(-1e-9), passed(1e-9));
        assert!(surely.iter().all(|node| found.contains(node)), "{ray:?}");
        assert!(found.iter().all(|node| perhaps.contains(node)), "{ray:?}");
        let entered = visited.0.iter().map(|(_, within)| within[0]);
        assert!(entered.is_sorted(), "{ray:?}");
        rays += usize::from(!found.is_empty());
        most = most.max(found.len());
    }
    assert!(rays > 500 && most > 30, "{rays} rays, {most} voxels");
}

#[test]
fn octree_and_grid_have_all_of_delta_and_lambda_and_may_be_compared() {
    let balls = scene("balls:2");
    let render = RenderSettings {
        width: 40,
        height: 30,
        ..RenderSettings::for_camera(*balls.camera())
    };
    let of = |method| measure(&balls, &settings(method, &[]), &render, &Progress::new()).unwrap();
    let midpoint = of("midpoint");
    for method in ["octree", "grid"] {
        let other = of(method);
        let sides = [&midpoint, &other].map(|m| (&m.measurement, &m.picture));
        assert_eq!(unequal(sides[0], sides[1]), [], "{method}");
        for symbol in DELTA.iter().chain(&LAMBDA) {
            let value = |m| parameter(symbol).value(m);
            let values = [value(sides[0].0), value(sides[1].0)];
            assert!(values[1].is_some(), "{symbol} of {method}");
            assert!(change(parameter(symbol).unit, values[0], values[1]).is_some());
        }
    }
}
