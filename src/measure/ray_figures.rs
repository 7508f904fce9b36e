//! What the rays of one kind did: all of them together, a ray on average, and the most that a single
//! ray did. A figure is one entry of [`RAY_FIGURES`].

use super::{Measurement, Unit};
use crate::trace::{RayKind, RayMaxima, Tally};

/// A figure of the rays of one kind.
pub struct RayFigure {
    /// The key in JSON and CSV.
    pub key: &'static str,
    /// Name in words, with the paper's symbol where all rays together have one.
    pub name: &'static str,
    pub unit: Unit,
    /// What it means, in a sentence.
    pub meaning: &'static str,
    value: fn(&Tally, &RayMaxima) -> Option<f64>,
}

impl RayFigure {
    /// Its value for rays of a kind; `None` before they were counted, for ratios to zero, and where
    /// there is no such ray, but for counts.
    pub fn of(&self, measurement: &Measurement, kind: RayKind) -> Option<f64> {
        let counted = measurement.counted.as_ref()?;
        (self.value)(
            &counted.tallies[kind as usize],
            &counted.maxima[kind as usize],
        )
    }
}

/// A mean over the rays.
fn mean(sum: u64, tally: &Tally) -> Option<f64> {
    (tally.rays > 0).then(|| sum as f64 / tally.rays as f64)
}

/// The most of any ray, where there is one.
fn most(count: u32, tally: &Tally) -> Option<f64> {
    (tally.rays > 0).then(|| f64::from(count))
}

macro_rules! figures {
    ($( $key:literal, $name:literal, $unit:ident, $meaning:literal, $value:expr; )*) => {
        /// Every figure, in the order in which reports show them.
        pub static RAY_FIGURES: &[RayFigure] = &[$( RayFigure {
            key: $key,
            name: $name,
            unit: Unit::$unit,
            meaning: $meaning,
            value: $value,
        } ),*];
    };
}

figures! {
    "rays", "rays", Count, "Rays formed.", |t, _| Some(t.rays as f64);
    "hits", "hits", Count,
        "Rays that hit an object, shadow rays before the light.", |t, _| Some(t.hits as f64);
    "tests", "tests", Count, "Intersection tests.", |t, _| Some(t.tests as f64);
    "tests_per_hit", "tests per hit (N_RPRT)", Ratio,
        "Intersection tests for every hit; none where nothing is hit.",
        |t, _| (t.hits > 0).then(|| t.tests as f64 / t.hits as f64);
    "tests_mean", "tests of a ray, mean", Ratio,
        "Intersection tests of a ray on average.", |t, _| mean(t.tests, t);
    "tests_most", "tests of a ray, most", Count,
        "Intersection tests of the ray with the most.", |t, m| most(m.tests, t);
    "nodes", "nodes (N_NODES)", Count,
        "Inner nodes and leaves traversed.", |t, _| Some((t.inner_nodes + t.leaves) as f64);
    "nodes_mean", "nodes of a ray, mean (N_AT)", Ratio,
        "Inner nodes and leaves that a ray traverses on average.",
        |t, _| mean(t.inner_nodes + t.leaves, t);
    "nodes_most", "nodes of a ray, most", Count,
        "Inner nodes and leaves of the ray with the most.", |t, m| most(m.nodes, t);
    "inner_nodes", "inner nodes (N_INODES)", Count,
        "Inner nodes traversed.", |t, _| Some(t.inner_nodes as f64);
    "inner_nodes_mean", "inner nodes of a ray, mean", Ratio,
        "Inner nodes that a ray traverses on average.", |t, _| mean(t.inner_nodes, t);
    "inner_nodes_most", "inner nodes of a ray, most", Count,
        "Inner nodes of the ray with the most.", |t, m| most(m.inner_nodes, t);
    "leaves", "leaves (N_VLS)", Count,
        "Leaves visited, empty ones included.", |t, _| Some(t.leaves as f64);
    "leaves_mean", "leaves of a ray, mean", Ratio,
        "Leaves that a ray visits on average.", |t, _| mean(t.leaves, t);
    "leaves_most", "leaves of a ray, most", Count,
        "Leaves of the ray with the most.", |t, m| most(m.leaves, t);
    "empty_leaves", "empty leaves (N_VELS)", Count,
        "Empty leaves visited.", |t, _| Some(t.empty_leaves as f64);
    "empty_leaves_mean", "empty leaves of a ray, mean", Ratio,
        "Empty leaves that a ray visits on average.", |t, _| mean(t.empty_leaves, t);
    "empty_leaves_most", "empty leaves of a ray, most", Count,
        "Empty leaves of the ray with the most.", |t, m| most(m.empty_leaves, t);
    "full_leaves", "full leaves (N_VFLS)", Count,
        "Leaves with objects visited.", |t, _| Some((t.leaves - t.empty_leaves) as f64);
    "full_leaves_mean", "full leaves of a ray, mean", Ratio,
        "Leaves with objects that a ray visits on average.",
        |t, _| mean(t.leaves - t.empty_leaves, t);
    "full_leaves_most", "full leaves of a ray, most", Count,
        "Leaves with objects of the ray with the most.", |t, m| most(m.full_leaves, t);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_names_are_there_once() {
        assert!(!RAY_FIGURES.is_empty());
        for (i, figure) in RAY_FIGURES.iter().enumerate() {
            let mut before = RAY_FIGURES[..i].iter();
            assert!(before.all(|f| f.key != figure.key && f.name != figure.name));
        }
    }
}
