//! All counters. A counter is one entry.
//!
//! Readings of the paper: equation (1) is what its section 3 calls equation 2. `N_VFLS` is
//! `N_VLS − N_VELS`; the printed N_TRLS and N_TRELS are defined nowhere. D_MDEPTH is `D_MAX`.
//! Two printed ratios disagree with their own columns: tetra N_AOIFL 12.5 (5.62/4.48 = 125.4 %)
//! and balls N_RPRT 63.3 (22.3/34.8 = 64.1 %). The printed N_AT and N_RPRT do not follow from trees
//! that match the paper's to the integer; ours are counted and left as they are.

use super::class::Class::{C, D, R, S, T};
use super::class::Table::{Dynamic, Ours, Scene, Static};
use super::class::Unit;
use super::declaration::Counter;
use super::declaration::Quantity::{Count, Ratio};
use super::declaration::Value::{LeafDeviation, Measured, PixelTime, Rays};
use crate::measure::heat::RayFilter::{All, Primary, Secondary, Shadow};
use crate::measure::measurement::Measurement;
use crate::measure::overlap::{COST_OF_INNER_NODE, COST_OF_TEST};
use crate::structure::split::{MethodInfo, Structure};
use crate::trace::RayKind;

/// Returns `a / b`; `None` if `b` is 0.
fn ratio(a: f64, b: f64) -> Option<f64> {
    (b != 0.0).then(|| a / b)
}

fn is_hierarchy(method: &MethodInfo) -> bool {
    method.structure == Structure::Bvh
}

/// Rays traverse inner nodes of all structures but grids.
fn has_inner_nodes(method: &MethodInfo) -> bool {
    method.structure != Structure::Grid
}

fn plane_tests(measurement: &Measurement) -> Option<f64> {
    let tally = measurement.all_rays()?;
    Some(match measurement.build.method.structure {
        Structure::Bintree | Structure::Octree => tally.inner_nodes,
        Structure::Grid => tally.leaves,
        Structure::Bvh => 6 * tally.box_tests,
    } as f64)
}

fn bytes_per_ray(measurement: &Measurement) -> Option<f64> {
    /// Bytes of a reference to an object.
    const REFERENCE: f64 = size_of::<u32>() as f64;
    let tally = measurement.all_rays()?;
    let nodes = match measurement.build.method.structure {
        Structure::Bintree | Structure::Octree => tally.inner_nodes + tally.leaves,
        Structure::Grid => tally.leaves,
        Structure::Bvh => tally.box_tests + tally.rays,
    };
    let objects = measurement.scene.objects.max(1) as f64;
    let test = REFERENCE + measurement.object_bytes as f64 / objects;
    let bytes = measurement.tree.node_bytes as f64 * nodes as f64 + test * tally.tests as f64;
    ratio(bytes, tally.rays as f64)
}

/// An entry consists of symbol, name, unit, meaning, value, and what the counter serves as.
macro_rules! counters {
    ($( $symbol:literal, $name:literal, $unit:ident, $meaning:literal, $value:expr
        $(, $aspect:ident ( $($argument:expr),* ) )* ; )*) => {
        /// All counters. Parameters come first, in the order of the paper's tables.
        pub static COUNTERS: &[Counter] = &[$(
            Counter::new($symbol, $name, Unit::$unit, $meaning, $value)
                $( .$aspect($($argument),*) )*
        ),*];
    };
}

counters! {
    // Table 1
    "N_X", "width", Count, "Width of the picture in pixels.",
        Measured(|m| Some(f64::from(m.render.width))), parameter(Scene, S);
    "N_Y", "height", Count, "Height of the picture in pixels.",
        Measured(|m| Some(f64::from(m.render.height))), parameter(Scene, S);
    "N_O", "objects", Count, "Objects in the scene.",
        Measured(|m| Some(m.scene.objects as f64)), parameter(Scene, S);
    "N_L", "lights", Count, "Lights in the scene.",
        Measured(|m| Some(m.scene.lights as f64)), parameter(Scene, S);
    "S_COV", "screen coverage", Percent, "Share of the picture that objects cover.",
        Rays(Primary, Ratio(|t| t.hits, |t| t.rays)), parameter(Scene, R),
        formula("N_HPR / N_PR");
    "D_COMPX", "depth complexity", Ratio,
        "Objects that a primary ray meets on average, including hidden ones.",
        Measured(|m| m.counted.as_ref().and_then(|c| {
            ratio(c.objects_met as f64, c.tallies[RayKind::Primary as usize].rays as f64)
        })),
        parameter(Scene, D), formula("objects met by all primary rays / N_PR"),
        heatmap(10, "objects per pixel", 1.0), of_depth_complexity();
    "V_SCENE", "scene volume", Volume, "Volume of the tight box around all objects.",
        Measured(|m| Some(m.scene.volume)), parameter(Scene, D);
    "V_BB", "volume of object boxes", Volume, "Sum of the volumes of the objects' boxes.",
        Measured(|m| Some(m.scene.object_boxes_volume)), parameter(Scene, S);
    "R_BBSC", "object boxes to scene", Percent,
        "Volume of the objects' boxes relative to the scene's box.",
        Measured(|m| ratio(m.scene.object_boxes_volume, m.scene.volume)), parameter(Scene, S),
        formula("V_BB / V_SCENE");
    "D_AREC", "bounces", Count, "Maximum depth of secondary rays.",
        Measured(|m| Some(f64::from(m.render.d_arec))), parameter(Scene, S);
    "D_MAX", "depth", Count,
        "Maximum depth of a leaf; the root has depth 0.",
        Measured(|m| Some(f64::from(m.depth_limit))), applies(|m| m.has_limits),
        parameter(Scene, S);
    "N_OILF", "leaf size", Count,
        "A cell with at most this many objects becomes a leaf.",
        Measured(|m| Some(f64::from(m.build.n_oilf))), applies(|m| m.has_limits),
        parameter(Scene, S);
    // Table 2
    "D_REACH", "depth reached", Count, "Greatest depth of any leaf.",
        Measured(|m| Some(m.tree.depth_reached as f64)), applies(has_inner_nodes),
        parameter(Static, C), formula("≤ D_MAX"), counts_nodes();
    "N_LS", "leaves", Count, "Leaves of the tree, including empty ones.",
        Measured(|m| Some(m.tree.leaves as f64)), parameter(Static, C);
    "N_IN", "inner nodes", Count, "Inner nodes of the tree.",
        Measured(|m| Some(m.tree.inner_nodes as f64)), applies(has_inner_nodes),
        parameter(Static, C), formula("N_LS − 1 for two children each"), counts_nodes();
    "N_ELS", "empty leaves", Count, "Leaves without objects.",
        Measured(|m| Some(m.tree.empty_leaves as f64)), parameter(Static, C);
    "R_ETNLS", "empty leaf ratio", Percent, "Share of the leaves that are empty.",
        Measured(|m| ratio(m.tree.empty_leaves as f64, m.tree.leaves as f64)),
        parameter(Static, C), formula("N_ELS / N_LS");
    "N_RO", "references", Count, "References of all leaves to objects.",
        Measured(|m| Some(m.tree.references as f64)), parameter(Static, C);
    "N_ADL", "extra references per object", Percent,
        "References per object beyond the first, on average; no value without objects.",
        Measured(|m| ratio(m.tree.references as f64, m.scene.objects as f64).map(|r| r - 1.0)),
        parameter(Static, C), formula("N_RO / N_O − 1");
    "N_AOIL", "objects per leaf", Ratio, "References per leaf, empty ones included.",
        Measured(|m| ratio(m.tree.references as f64, m.tree.leaves as f64)),
        parameter(Static, C), formula("N_RO / N_LS");
    "N_AOIFL", "objects per full leaf", Ratio,
        "References per leaf that is not empty; no value if all leaves are empty.",
        Measured(|m| {
            ratio(m.tree.references as f64, (m.tree.leaves - m.tree.empty_leaves) as f64)
        }),
        parameter(Static, C), formula("N_RO / (N_LS − N_ELS)");
    "V_EMPTY", "empty volume", Volume,
        "Volume of the root cell outside all full leaves: of a hierarchy, outside the union of the \
         leaves' boxes.",
        Measured(|m| m.tree.empty_volume), parameter(Static, C);
    "R_FVWV", "volume in full leaves", Percent, "Share of the root cell's volume in full leaves.",
        Measured(|m| ratio(m.tree.root_volume - m.tree.empty_volume?, m.tree.root_volume)),
        parameter(Static, C),
        formula("(V_ROOT − V_EMPTY) / V_ROOT, with V_ROOT the volume of the root cell");
    "T_CB", "build time", Seconds, "CPU time of building the tree.",
        Measured(|m| Some(m.building.cpu.as_secs_f64())), parameter(Static, T), less_is_better();
    // Table 3
    "N_PR", "primary rays", Count, "Rays from the eye, one per pixel.",
        Rays(Primary, Count(|t| t.rays)), parameter(Dynamic, D), formula("N_X · N_Y");
    "N_PRIT", "tests of primary rays", Count, "Intersection tests of all primary rays.",
        Rays(Primary, Count(|t| t.tests)), parameter(Dynamic, R), less_is_better();
    "N_HPR", "primary hits", Count, "Primary rays that hit an object.",
        Rays(Primary, Count(|t| t.hits)), parameter(Dynamic, D), formula("N_PR · S_COV");
    "N_SR", "shadow rays", Count, "Rays from a surface to a light that it faces.",
        Rays(Shadow, Count(|t| t.rays)), parameter(Dynamic, D);
    "N_SRIT", "tests of shadow rays", Count, "Intersection tests of all shadow rays.",
        Rays(Shadow, Count(|t| t.tests)), parameter(Dynamic, R), less_is_better();
    "N_HSR", "blocked shadow rays", Count, "Shadow rays that hit an object before the light.",
        Rays(Shadow, Count(|t| t.hits)), parameter(Dynamic, D);
    "N_SECR", "secondary rays", Count, "Reflected and refracted rays.",
        Rays(Secondary, Count(|t| t.rays)), parameter(Dynamic, D);
    "N_SECRIT", "tests of secondary rays", Count, "Intersection tests of all secondary rays.",
        Rays(Secondary, Count(|t| t.tests)), parameter(Dynamic, R), less_is_better();
    "N_HSECR", "secondary hits", Count, "Secondary rays that hit an object.",
        Rays(Secondary, Count(|t| t.hits)), parameter(Dynamic, R);
    "N_RPRT", "tests per hit", Ratio,
        "Intersection tests per hit, at least 1; no value without hits.",
        Rays(All, Ratio(|t| t.tests, |t| t.hits)), parameter(Dynamic, R),
        formula("(N_PRIT + N_SRIT + N_SECRIT) / (N_HPR + N_HSR + N_HSECR)"),
        heatmap(7, "tests per hit", 0.1), per_kind(3, "tests_per_hit", "tests per hit"),
        less_is_better();
    "N_VLS", "visited leaves", Count, "Leaves that rays visit, including empty ones.",
        Rays(All, Count(|t| t.leaves)), parameter(Dynamic, R),
        heatmap(3, "leaves per pixel", 1.0),
        per_kind(6, "leaves", "leaves"), of_single_rays(|m| m.leaves), less_is_better();
    "N_VELS", "visited empty leaves", Count, "Empty leaves that rays visit.",
        Rays(All, Count(|t| t.empty_leaves)), parameter(Dynamic, R),
        heatmap(4, "empty leaves per pixel", 1.0),
        per_kind(7, "empty_leaves", "empty leaves"), of_single_rays(|m| m.empty_leaves);
    "N_VFLS", "visited full leaves", Count, "Leaves with objects that rays visit.",
        Rays(All, Count(|t| t.leaves - t.empty_leaves)), parameter(Dynamic, R),
        formula("N_VLS − N_VELS"),
        heatmap(5, "full leaves per pixel", 1.0),
        per_kind(8, "full_leaves", "full leaves"), of_single_rays(|m| m.full_leaves),
        less_is_better();
    "N_INODES", "traversed inner nodes", Count, "Inner nodes that rays traverse.",
        Rays(All, Count(|t| t.inner_nodes)), applies(has_inner_nodes), parameter(Dynamic, R),
        counts_nodes(),
        heatmap(2, "inner nodes per pixel", 1.0),
        per_kind(5, "inner_nodes", "inner nodes"), of_single_rays(|m| m.inner_nodes),
        less_is_better();
    "N_NODES", "traversed nodes", Count, "Inner nodes and leaves that rays traverse.",
        Rays(All, Count(|t| t.inner_nodes + t.leaves)), parameter(Dynamic, R), counts_nodes(),
        formula("N_INODES + N_VLS"),
        heatmap(1, "nodes per pixel", 1.0),
        per_kind(4, "nodes", "nodes"), of_single_rays(|m| m.nodes), mean_is("N_AT"),
        less_is_better();
    "N_AT", "nodes per ray", Ratio, "Nodes that a ray traverses on average.",
        Rays(All, Ratio(|t| t.inner_nodes + t.leaves, |t| t.rays)), parameter(Dynamic, R),
        counts_nodes(),
        formula("N_NODES / (N_PR + N_SR + N_SECR)"), less_is_better();
    "T_TR", "render time", Seconds,
        "CPU time of rendering the picture with one sample per pixel, summed over all threads.",
        Measured(|m| m.rendering.map(|r| r.cpu.as_secs_f64())), parameter(Dynamic, T),
        less_is_better();
    // Beside the tables
    "T_TT", "traversal time", Seconds,
        "CPU time of traversing the tree with the same rays up to their known ends, without tests and \
         shading.",
        Measured(|m| m.counted.map(|c| c.traversal.as_secs_f64())), parameter(Ours, T),
        less_is_better();
    "T_TT/T_TR", "time spent traversing", Percent, "Share of the render time spent on traversal.",
        Measured(|m| {
            ratio(m.counted?.traversal.as_secs_f64(), m.rendering?.cpu.as_secs_f64())
        }),
        parameter(Ours, T), formula("T_TT / T_TR");
    "T_CB_WALL", "elapsed build time", Seconds, "Elapsed time of building the tree.",
        Measured(|m| Some(m.building.wall.as_secs_f64())), parameter(Ours, T), less_is_better();
    "T_TR_WALL", "elapsed render time", Seconds,
        "Elapsed time of rendering the picture with all threads.",
        Measured(|m| m.rendering.map(|r| r.wall.as_secs_f64())), parameter(Ours, T),
        less_is_better();
    "N_BITS", "bits per number", Count, "Bits of the numbers that rays are traced with, 32 or 64.",
        Measured(|m| Some(f64::from(m.precision.precision.bits()))), parameter(Ours, S);
    "W_CUT", "minimum contribution", Ratio,
        "A secondary ray that contributes less than this to every color of its pixel is not traced.",
        Measured(|m| Some(m.render.min_contribution)), parameter(Ours, S);
    "M_OBJ", "object memory", Bytes,
        "Memory of the objects as prepared for intersection tests, in the precision used.",
        Measured(|m| Some(m.object_bytes as f64)), parameter(Ours, C);
    "M_TREE", "tree memory", Bytes, "Memory of nodes and references.",
        Measured(|m| Some(m.tree.bytes as f64)), parameter(Ours, C);
    "M_NODE", "node memory", Bytes, "Memory of a node; of a grid, of a voxel.",
        Measured(|m| Some(m.tree.node_bytes as f64)), parameter(Ours, C);
    "M_TREE/N_O", "tree memory per object", Bytes,
        "Memory of nodes and references per object; no value without objects.",
        Measured(|m| ratio(m.tree.bytes as f64, m.scene.objects as f64)), parameter(Ours, C),
        formula("M_TREE / N_O");
    "C_SAH", "SAH cost", Ratio,
        "Expected cost of a random line through the root, which nothing stops, by the surface areas A \
         of nodes: 1.2 per inner node and 1 per test (Aila et al. 2013).",
        Measured(|m| {
            let over = COST_OF_INNER_NODE * m.tree.inner_area + COST_OF_TEST * m.tree.test_area;
            ratio(over, m.tree.root_area)
        }),
        applies(has_inner_nodes), parameter(Ours, C),
        formula("(1.2 Σ A(inner node) + Σ A(leaf) · objects of the leaf) / A(root)"),
        less_is_better();
    "EPO", "end-point overlap", Ratio,
        "Expected cost of the nodes around a random point of a surface that do not hold its object, with \
         the costs of C_SAH (Aila et al. 2013). 0 if leaves do not overlap. Points of spheres, cylinders \
         and cones are 1024 fixed ones. No value where it would take longer than about ten seconds.",
        Measured(|m| m.tree.end_point_overlap), parameter(Ours, C), less_is_better();
    "V_SOV", "sibling overlap", Ratio,
        "Volume that children of the same node have in common, summed over all pairs of children, \
         relative to the root cell. 0 if cells do not overlap.",
        Measured(|m| ratio(m.tree.sibling_overlap, m.tree.root_volume)), parameter(Ours, C);
    "V_LEAF/V_ROOT", "leaf volume to root", Ratio,
        "Sum of the volumes of the leaves' boxes relative to the root cell.",
        Measured(|m| ratio(m.tree.leaf_volume, m.tree.root_volume)), applies(is_hierarchy),
        parameter(Ours, C);
    "F_W", "node fill", Percent,
        "Children of the inner nodes relative to the most they can have; no value without inner nodes.",
        Measured(|m| {
            let width = m.build.constant("width");
            ratio(m.tree.children as f64, width * m.tree.inner_nodes as f64)
        }),
        applies(is_hierarchy), parameter(Ours, C), formula("children / (width · N_IN)");
    "D_LEAF", "mean leaf depth", Ratio, "Depth of a leaf on average.",
        Measured(|m| ratio(m.tree.leaf_depths as f64, m.tree.leaves as f64)),
        applies(has_inner_nodes), parameter(Ours, C), counts_nodes();
    "N_MOIL", "largest leaf", Count, "Objects of the leaf with the most.",
        Measured(|m| Some(m.tree.largest_leaf as f64)), parameter(Ours, C);
    "N_BT", "box tests", Count,
        "Tests of rays with the box of one child; 0 for trees with planes. The root's box is not counted.",
        Rays(All, Count(|t| t.box_tests)), parameter(Ours, R),
        heatmap(11, "box tests per pixel", 1.0),
        per_kind(9, "box_tests", "box tests"), of_single_rays(|m| m.box_tests),
        mean_is("N_BT/ray"), less_is_better();
    "N_BT/ray", "box tests per ray", Ratio, "Box tests of a ray on average.",
        Rays(All, Ratio(|t| t.box_tests, |t| t.rays)), parameter(Ours, R),
        formula("N_BT / (N_PR + N_SR + N_SECR)"), less_is_better();
    "N_CULL", "culled nodes", Count,
        "Pending nodes that rays skip, because these begin beyond the closest hit.",
        Rays(All, Count(|t| t.culled)), applies(is_hierarchy), parameter(Ours, R),
        per_kind(10, "culled", "culled nodes"), of_single_rays(|m| m.culled);
    "N_PT", "plane tests", Count,
        "Planes that rays are tested against: one per inner node of a kd-tree or an octree, six per box, \
         one per voxel of a grid. Compares across structures.",
        Measured(plane_tests), parameter(Ours, R),
        formula("N_INODES; of a hierarchy 6 · N_BT, of a grid N_VLS"), less_is_better();
    "B_RAY", "bytes per ray", Bytes,
        "Memory that a ray reads on average, as if there were no caches: nodes, references and objects. \
         Compares across structures.",
        Measured(bytes_per_ray), parameter(Ours, R),
        formula("(M_NODE · nodes + (4 + M_OBJ / N_O) · tests) / rays, with N_NODES nodes of a tree with \
                 planes, N_VLS of a grid, N_BT and a root per ray of a hierarchy"),
        less_is_better();
    "U_LEAF", "tests that hit", Percent,
        "Share of the intersection tests that find a hit before the closest one so far.",
        Rays(All, Ratio(|t| t.test_hits, |t| t.tests)), parameter(Ours, R),
        per_kind(3, "tests_that_hit", "tests that hit");
    "LCV", "leaf count deviation", Ratio,
        "Standard deviation, over rays, of the leaves that a ray visits: how much rays diverge.",
        LeafDeviation(All), parameter(Ours, R),
        formula("√(E[L²] − E[L]²), with L the leaves of a ray"),
        per_kind(6, "leaves_deviation", "leaves per ray, standard deviation");
    "rays/s", "rays per second", Rate,
        "Rays of all kinds per second of CPU time spent on tracing them, without shading.",
        Measured(|m| {
            let rendering = m.rendering?;
            ratio(rendering.rays as f64, rendering.tracing.as_secs_f64())
        }),
        parameter(Ours, T);
    // No parameters
    "N_RAYS", "rays", Count, "Rays of all kinds, including primary rays.",
        Rays(All, Count(|t| t.rays)),
        heatmap(8, "rays per pixel", 1.0),
        parts(&[(Primary, "N_PR"), (Shadow, "N_SR"), (Secondary, "N_SECR")]),
        per_kind(1, "rays", "rays");
    "N_HITS", "hits", Count, "Rays that hit an object; shadow rays before the light.",
        Rays(All, Count(|t| t.hits)), per_kind(2, "hits", "hits");
    "N_IT", "intersection tests", Count, "Intersection tests of rays with objects.",
        Rays(All, Count(|t| t.tests)),
        heatmap(6, "tests per pixel", 1.0),
        parts(&[(Primary, "N_PRIT"), (Shadow, "N_SRIT"), (Secondary, "N_SECRIT")]),
        per_kind(3, "tests", "tests"), of_single_rays(|m| m.tests), less_is_better();
    // `T_TR` is measured over whole tiles, so no parameter is the sum of these.
    "T_PIXEL", "time", Seconds,
        "Time of tracing and shading a pixel on one thread; the minimum of several runs.",
        PixelTime, heatmap(9, "µs per pixel", 0.1), less_is_better();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_a_view_are_distinct() {
        let mut heatmaps: Vec<_> = COUNTERS
            .iter()
            .filter_map(|c| Some(c.heatmap?.place))
            .collect();
        heatmaps.sort_unstable();
        assert!(
            (1..).zip(&heatmaps).all(|(i, place)| i == *place),
            "{heatmaps:?}"
        );
        let symbols: std::collections::BTreeSet<_> = COUNTERS.iter().map(|c| c.symbol).collect();
        assert_eq!(symbols.len(), COUNTERS.len());
    }
}
