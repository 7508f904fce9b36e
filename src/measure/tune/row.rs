//! What is measured of one candidate.

use super::candidates::is_default;
use super::ranking::{Score, Spread};
use crate::measure::Measurement;
use crate::setup::Setup;
use crate::structure::split::Structure;
use crate::trace::TimedRender;

/// A candidate that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What was asked for, with the structure of this candidate. The size of the picture is the
    /// user's.
    pub setup: Setup,
    /// The last rung in which it was timed, from 0.
    pub rung: usize,
    /// The tree, its build time, as rendering time the median, and all counts of the small picture. A candidate that was
    /// timed only once is not counted, except for the defaults of a method.
    pub measurement: Measurement,
    /// The rendering of every round, by ascending CPU time; at least one.
    times: Vec<TimedRender>,
}

impl Row {
    /// Creates the row of a candidate after it was counted and timed once.
    pub(super) fn new(setup: Setup, measurement: Measurement, time: TimedRender) -> Row {
        let mut row = Row {
            setup,
            rung: 0,
            measurement,
            times: Vec::new(),
        };
        row.add(0, time);
        row
    }

    /// Adds the time of another round.
    pub(super) fn add(&mut self, rung: usize, time: TimedRender) {
        self.rung = rung;
        let place = self.times.partition_point(|t| t.cpu < time.cpu);
        self.times.insert(place, time);
        self.measurement.rendering = Some(self.times[(self.times.len() - 1) / 2]);
    }

    /// Returns the CPU times of all rounds in seconds, in ascending order.
    pub fn seconds(&self) -> Vec<f64> {
        self.times.iter().map(|t| t.cpu.as_secs_f64()).collect()
    }

    /// Returns the least, the median and the greatest CPU time. For an even number of rounds, the
    /// median is the lower of the two middle values.
    pub fn spread(&self) -> Spread {
        Spread::of(self.seconds())
    }

    /// Returns the CPU time of building the tree once and tracing so many rays like those of the picture, without
    /// shading. The tree is built once, so the spread is that of tracing.
    pub fn spread_with_build(&self, rays: u64) -> Spread {
        let build = self.measurement.building.cpu.as_secs_f64();
        let of = |time: &TimedRender| {
            build + time.tracing.as_secs_f64() / time.rays.max(1) as f64 * rays as f64
        };
        Spread::of(self.times.iter().map(of).collect())
    }

    /// Returns how often it was timed.
    pub fn rounds(&self) -> usize {
        self.times.len()
    }

    /// Returns what it is ranked by if so many rays are traced after it is built; `None` ranks by rendering alone.
    pub fn score(&self, rays: Option<u64>) -> Score {
        Score {
            seconds: rays.map_or_else(|| self.spread(), |rays| self.spread_with_build(rays)),
            bytes: self.bytes(),
            rung: self.rung,
        }
    }

    /// Returns whether it has the default settings of its method.
    pub fn is_default(&self) -> bool {
        is_default(&self.setup.build)
    }

    /// Returns the intersection tests per ray, over rays of all kinds; `None` if it was not counted.
    pub fn tests_per_ray(&self) -> Option<f64> {
        let tally = self.measurement.all_rays()?;
        (tally.rays > 0).then(|| tally.tests as f64 / tally.rays as f64)
    }

    /// Returns the number of nodes; of a grid, the number of voxels.
    pub fn nodes(&self) -> u64 {
        let tree = &self.measurement.tree;
        match self.setup.build.method.structure {
            Structure::Grid => tree.leaves,
            Structure::Bintree | Structure::Octree | Structure::Bvh => {
                tree.inner_nodes + tree.leaves
            }
        }
    }

    /// Returns the memory of nodes and references, `M_TREE`.
    pub fn bytes(&self) -> u64 {
        self.measurement.tree.bytes
    }
}
