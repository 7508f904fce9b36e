//! Every parameter of the paper's Tables 1 to 3, Δ and Λ. A parameter is one entry.
//!
//! Readings of the paper: equation (1) is what its section 3 calls equation 2. `N_VFLS` is
//! `N_VLS − N_VELS`; the printed N_TRLS and N_TRELS are defined nowhere. D_MDEPTH is `D_MAX`.
//! Two printed ratios disagree with their own columns: tetra N_AOIFL 12.5 (5.62/4.48 = 125.4 %)
//! and balls N_RPRT 63.3 (22.3/34.8 = 64.1 %). The printed N_AT and N_RPRT cannot be had from trees
//! that match the paper's to the integer; ours are counted and left as they are.

use super::{Class, Measurement, Parameter, Table, Unit};
use crate::structure::split::Structure;
use crate::trace::RayKind;

/// The septet Δ by symbol, in the paper's order (equation 2).
pub const DELTA: [&str; 7] = [
    "N_LS", "R_ETNLS", "N_ADL", "N_AOIFL", "R_FVWV", "N_RPRT", "N_AT",
];

/// The triplet Λ by symbol, in the paper's order (equation 3).
pub const LAMBDA: [&str; 3] = ["T_CB", "T_TR", "T_TT/T_TR"];

/// The parameter with this symbol.
///
/// # Panics
/// If there is none: symbols are written in code, not by users.
pub fn parameter(symbol: &str) -> &'static Parameter {
    PARAMETERS
        .iter()
        .find(|p| p.symbol == symbol)
        .unwrap_or_else(|| panic!("no parameter {symbol}"))
}

/// `a / b`, without a value where `b` is zero.
fn ratio(a: f64, b: f64) -> Option<f64> {
    (b != 0.0).then(|| a / b)
}

/// Whether rays pass planes from the root down, as in all but grids: to those, parameters of depth and
/// of inner nodes do not apply.
fn passes_planes(m: &Measurement) -> bool {
    m.build.method.structure != Structure::Grid
}

macro_rules! parameters {
    ($( $symbol:literal, $name:literal, $table:ident $class:ident $unit:ident,
        $meaning:literal, $formula:literal, $value:expr; )*) => {
        /// Every parameter, in the order of the paper's tables.
        pub static PARAMETERS: &[Parameter] = &[$( Parameter {
            symbol: $symbol,
            name: $name,
            table: Table::$table,
            class: Class::$class,
            unit: Unit::$unit,
            meaning: $meaning,
            formula: $formula,
            value: $value,
        } ),*];
    };
}

parameters! {
    // Table 1
    "N_X", "width", Scene S Count, "Width of the picture in pixels.", "",
        |m| Some(f64::from(m.render.width));
    "N_Y", "height", Scene S Count, "Height of the picture in pixels.", "",
        |m| Some(f64::from(m.render.height));
    "N_O", "objects", Scene S Count, "Objects in the scene.", "",
        |m| Some(m.scene.objects as f64);
    "N_L", "lights", Scene S Count, "Lights in the scene.", "",
        |m| Some(m.scene.lights as f64);
    "S_COV", "screen coverage", Scene R Percent,
        "Share of the picture that objects cover.", "N_HPR / N_PR",
        |m| m.tally(RayKind::Primary).and_then(|t| ratio(t.hits as f64, t.rays as f64));
    "D_COMPX", "depth complexity", Scene D Ratio,
        "Objects that a primary ray meets on average, hidden ones included.",
        "objects met by all primary rays / N_PR",
        |m| m.counted.as_ref().and_then(|c| {
            ratio(c.objects_met as f64, c.tallies[RayKind::Primary as usize].rays as f64)
        });
    "V_SCENE", "scene volume", Scene D Volume,
        "Volume of the tight box around all objects.", "",
        |m| Some(m.scene.volume);
    "V_BB", "volume of object boxes", Scene S Volume,
        "Sum of the volumes of the objects' boxes.", "",
        |m| Some(m.scene.object_boxes_volume);
    "R_BBSC", "object boxes to scene", Scene S Percent,
        "Volume of the objects' boxes relative to the scene's box.", "V_BB / V_SCENE",
        |m| ratio(m.scene.object_boxes_volume, m.scene.volume);
    "D_AREC", "recursion depth", Scene S Count, "How deep secondary rays may go.", "",
        |m| Some(f64::from(m.render.d_arec));
    "D_MAX", "greatest tree depth", Scene S Count,
        "Greatest depth that a leaf may have; the root has depth 0.", "",
        |m| passes_planes(m).then(|| f64::from(m.depth_limit));
    "N_OILF", "objects in a leaf to stop at", Scene S Count,
        "A cell with at most this many objects becomes a leaf.", "",
        |m| passes_planes(m).then(|| f64::from(m.build.n_oilf));
    // Table 2
    "D_REACH", "depth reached", Static C Count, "Greatest depth of any leaf.", "≤ D_MAX",
        |m| passes_planes(m).then_some(m.tree.depth_reached as f64);
    "N_LS", "leaves", Static C Count, "Leaves of the tree, empty ones included.", "",
        |m| Some(m.tree.leaves as f64);
    "N_IN", "inner nodes", Static C Count, "Inner nodes of the tree.", "N_LS − 1",
        |m| passes_planes(m).then_some(m.tree.inner_nodes as f64);
    "N_ELS", "empty leaves", Static C Count, "Leaves without an object.", "",
        |m| Some(m.tree.empty_leaves as f64);
    "R_ETNLS", "empty leaf ratio", Static C Percent,
        "Share of the leaves that is empty.", "N_ELS / N_LS",
        |m| ratio(m.tree.empty_leaves as f64, m.tree.leaves as f64);
    "N_RO", "references", Static C Count, "References to objects from all leaves.", "",
        |m| Some(m.tree.references as f64);
    "N_ADL", "mean duplication", Static C Percent,
        "How often an object is referred to beyond once, on average; none without objects.",
        "N_RO / N_O − 1",
        |m| ratio(m.tree.references as f64, m.scene.objects as f64).map(|r| r - 1.0);
    "N_AOIL", "references per leaf", Static C Ratio,
        "Objects in a leaf on average.", "N_RO / N_LS",
        |m| ratio(m.tree.references as f64, m.tree.leaves as f64);
    "N_AOIFL", "references per full leaf", Static C Ratio,
        "Objects in a leaf that is not empty, on average; none where all leaves are empty.",
        "N_RO / (N_LS − N_ELS)",
        |m| ratio(m.tree.references as f64, (m.tree.leaves - m.tree.empty_leaves) as f64);
    "V_EMPTY", "empty volume", Static C Volume, "Sum of the volumes of the empty leaves.", "",
        |m| Some(m.tree.empty_volume);
    "R_FVWV", "full volume ratio", Static C Percent,
        "Share of the root cell's volume that lies in full leaves.",
        "(V_ROOT − V_EMPTY) / V_ROOT, with V_ROOT the volume of the root cell",
        |m| ratio(m.tree.root_volume - m.tree.empty_volume, m.tree.root_volume);
    "T_CB", "build time", Static T Seconds, "CPU time of building the tree.", "",
        |m| Some(m.building.cpu.as_secs_f64());
    // Table 3
    "N_PR", "primary rays", Dynamic D Count, "Rays from the eye, one a pixel.", "N_X · N_Y",
        |m| m.tally(RayKind::Primary).map(|t| t.rays as f64);
    "N_PRIT", "tests of primary rays", Dynamic R Count,
        "Intersection tests of all primary rays.", "",
        |m| m.tally(RayKind::Primary).map(|t| t.tests as f64);
    "N_HPR", "primary hits", Dynamic D Count,
        "Primary rays that hit an object.", "N_PR · S_COV",
        |m| m.tally(RayKind::Primary).map(|t| t.hits as f64);
    "N_SR", "shadow rays", Dynamic D Count,
        "Rays from a surface to a light that it faces.", "",
        |m| m.tally(RayKind::Shadow).map(|t| t.rays as f64);
    "N_SRIT", "tests of shadow rays", Dynamic R Count,
        "Intersection tests of all shadow rays.", "",
        |m| m.tally(RayKind::Shadow).map(|t| t.tests as f64);
    "N_HSR", "blocked shadow rays", Dynamic D Count,
        "Shadow rays that hit an object before the light.", "",
        |m| m.tally(RayKind::Shadow).map(|t| t.hits as f64);
    "N_SECR", "secondary rays", Dynamic D Count, "Reflected and refracted rays.", "",
        |m| m.secondary().map(|t| t.rays as f64);
    "N_SECRIT", "tests of secondary rays", Dynamic R Count,
        "Intersection tests of all secondary rays.", "",
        |m| m.secondary().map(|t| t.tests as f64);
    "N_HSECR", "secondary hits", Dynamic R Count, "Secondary rays that hit an object.", "",
        |m| m.secondary().map(|t| t.hits as f64);
    "N_RPRT", "tests per hit", Dynamic R Ratio,
        "Intersection tests for every hit, at least 1; none where nothing is hit.",
        "(N_PRIT + N_SRIT + N_SECRIT) / (N_HPR + N_HSR + N_HSECR)",
        |m| m.all_rays().and_then(|t| ratio(t.tests as f64, t.hits as f64));
    "N_VLS", "visited leaves", Dynamic R Count, "Leaves that rays visited.", "",
        |m| m.all_rays().map(|t| t.leaves as f64);
    "N_VELS", "visited empty leaves", Dynamic R Count, "Empty leaves that rays visited.", "",
        |m| m.all_rays().map(|t| t.empty_leaves as f64);
    "N_VFLS", "visited full leaves", Dynamic R Count,
        "Leaves with objects that rays visited.", "N_VLS − N_VELS",
        |m| m.all_rays().map(|t| (t.leaves - t.empty_leaves) as f64);
    "N_INODES", "traversed inner nodes", Dynamic R Count, "Inner nodes that rays traversed.", "",
        |m| m.all_rays().filter(|_| passes_planes(m)).map(|t| t.inner_nodes as f64);
    "N_NODES", "traversed nodes", Dynamic R Count,
        "Inner nodes and leaves that rays traversed.", "N_INODES + N_VLS",
        |m| m.all_rays().map(|t| (t.inner_nodes + t.leaves) as f64);
    "N_AT", "nodes per ray", Dynamic R Ratio,
        "Nodes that a ray traverses on average.", "N_NODES / (N_PR + N_SR + N_SECR)",
        |m| m.all_rays().and_then(|t| ratio((t.inner_nodes + t.leaves) as f64, t.rays as f64));
    "T_TR", "render time", Dynamic T Seconds,
        "CPU time of rendering the picture, one sample a pixel, all threads together.", "",
        |m| m.rendering.map(|r| r.cpu.as_secs_f64());
    // Beside the tables
    "T_TT", "traversal time", Ours T Seconds,
        "CPU time of walking the same rays through the tree to their known ends, without tests and \
         shading.", "",
        |m| m.counted.map(|c| c.traversal.as_secs_f64());
    "T_TT/T_TR", "traversal share", Ours T Percent,
        "Share of the render time that goes into traversing the tree.", "T_TT / T_TR",
        |m| ratio(m.counted?.traversal.as_secs_f64(), m.rendering?.cpu.as_secs_f64());
    "T_CB_WALL", "build time on the wall", Ours T Seconds,
        "Time on the wall clock of building the tree.", "",
        |m| Some(m.building.wall.as_secs_f64());
    "T_TR_WALL", "render time on the wall", Ours T Seconds,
        "Time on the wall clock of rendering the picture with all threads.", "",
        |m| m.rendering.map(|r| r.wall.as_secs_f64());
    "N_BITS", "bits of a number", Ours S Count,
        "Bits of the numbers in which rays are traced, 32 or 64.", "",
        |m| Some(f64::from(m.precision.precision.bits()));
    "W_CUT", "minimum contribution", Ours S Ratio,
        "A secondary ray that counts for less than this in every colour of its pixel is not traced.",
        "", |m| Some(m.render.min_contribution);
    "M_OBJ", "object memory", Ours C Bytes,
        "Memory of the objects as intersection tests take them, in the precision used.", "",
        |m| Some(m.object_bytes as f64);
    "M_TREE", "tree memory", Ours C Bytes, "Memory that nodes and references hold.", "",
        |m| Some(m.tree.bytes as f64);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every symbol of the paper's Tables 1 to 3. `OP_CAMERA` is not a number; it stands in the
    /// settings of a measurement.
    const TABLES: [(&str, Table); 41] = [
        ("N_X", Table::Scene),
        ("N_Y", Table::Scene),
        ("N_O", Table::Scene),
        ("N_L", Table::Scene),
        ("S_COV", Table::Scene),
        ("D_COMPX", Table::Scene),
        ("V_SCENE", Table::Scene),
        ("V_BB", Table::Scene),
        ("R_BBSC", Table::Scene),
        ("D_AREC", Table::Scene),
        ("D_MAX", Table::Scene),
        ("N_OILF", Table::Scene),
        ("D_REACH", Table::Static),
        ("N_LS", Table::Static),
        ("N_IN", Table::Static),
        ("N_ELS", Table::Static),
        ("R_ETNLS", Table::Static),
        ("N_RO", Table::Static),
        ("N_ADL", Table::Static),
        ("N_AOIL", Table::Static),
        ("N_AOIFL", Table::Static),
        ("V_EMPTY", Table::Static),
        ("R_FVWV", Table::Static),
        ("T_CB", Table::Static),
        ("N_PR", Table::Dynamic),
        ("N_PRIT", Table::Dynamic),
        ("N_HPR", Table::Dynamic),
        ("N_SR", Table::Dynamic),
        ("N_SRIT", Table::Dynamic),
        ("N_HSR", Table::Dynamic),
        ("N_SECR", Table::Dynamic),
        ("N_SECRIT", Table::Dynamic),
        ("N_HSECR", Table::Dynamic),
        ("N_RPRT", Table::Dynamic),
        ("N_VLS", Table::Dynamic),
        ("N_VELS", Table::Dynamic),
        ("N_VFLS", Table::Dynamic),
        ("N_INODES", Table::Dynamic),
        ("N_NODES", Table::Dynamic),
        ("N_AT", Table::Dynamic),
        ("T_TR", Table::Dynamic),
    ];

    #[test]
    fn every_symbol_of_the_tables_is_there_exactly_once() {
        for (symbol, table) in TABLES {
            let found: Vec<_> = PARAMETERS.iter().filter(|p| p.symbol == symbol).collect();
            assert_eq!(found.len(), 1, "{symbol}");
            assert_eq!(found[0].table, table, "{symbol}");
        }
        let in_tables = PARAMETERS.iter().filter(|p| p.table != Table::Ours).count();
        assert_eq!(in_tables, TABLES.len());
    }

    #[test]
    fn septet_and_triplet_name_parameters() {
        for symbol in DELTA.iter().chain(&LAMBDA) {
            assert!(!parameter(symbol).meaning.is_empty());
        }
    }
}
