//! Counts and times of every structure. Each round times every structure once with every set of rays and every
//! kernel, so that a machine that slows down or warms up affects all of them alike.

use super::rays::RaySet;
use crate::measure::model::Terms;
use crate::measure::{MeasureError, Measurement, Times};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{BuildSettings, Tree, build};
use crate::trace::{
    CountedRender, CountingKernel, KernelChoice, RayKind, RayTracer, RenderError, RenderSettings,
    TimedBatches, TimedKernel, thread_pool,
};
use rayon::ThreadPool;

/// The most bytes that the trees between two rounds may take. Trees beyond this are built again in every round.
const MOST_KEPT: usize = 1 << 30;

/// What is studied in a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Camera and precision; the number of threads is that of building.
    pub render: RenderSettings,
    pub builds: Vec<BuildSettings>,
    pub kernels: Vec<KernelChoice>,
    /// Rays per set, at least 1.
    pub rays: usize,
    /// How often each structure is timed, at least 1.
    pub rounds: usize,
}

/// One structure with one set of rays.
#[derive(Clone, Debug)]
pub struct SetObservation {
    /// Structure and counts. All rays are those of the set.
    pub measurement: Measurement,
    pub terms: Terms,
    /// CPU time of tracing the set in seconds, by kernel and round.
    pub seconds: Vec<Vec<f64>>,
}

/// One structure with all sets of rays, in the order of [`Observing::sets`].
#[derive(Clone, Debug)]
pub struct Observation {
    pub build: BuildSettings,
    pub sets: Vec<SetObservation>,
}

/// The structures that are not measured.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// How many are the same tree as another one.
    pub same: usize,
    /// Those that could not be built, with reasons.
    pub refused: Vec<String>,
}

/// Measurements that are made turn by turn. A turn is one structure in one round.
pub struct Observing<'a> {
    scene: &'a Scene,
    plan: Plan,
    pool: ThreadPool,
    sets: Vec<RaySet>,
    /// Complete rounds.
    round: usize,
    /// Index of the next structure of the round.
    next: usize,
    candidates: Vec<Candidate>,
    left_out: LeftOut,
}

struct Candidate {
    build: BuildSettings,
    tree: Option<Tree>,
    /// Empty before the first round.
    sets: Vec<SetObservation>,
}

impl<'a> Observing<'a> {
    /// Creates the rays. Measures nothing yet.
    ///
    /// # Errors
    /// A camera without a view, settings out of range, threads that cannot be created, or cancellation.
    pub fn new(scene: &'a Scene, plan: Plan, progress: &Progress) -> Result<Self, MeasureError> {
        let tree = build(scene, &BuildSettings::default(), progress)?;
        let sets = RaySet::all(scene, &tree, &plan.render, plan.rays, progress)?;
        let candidates = plan.builds.iter().map(|build| Candidate {
            build: build.clone(),
            tree: None,
            sets: Vec::new(),
        });
        Ok(Observing {
            scene,
            pool: thread_pool(plan.render.threads)?,
            sets,
            round: 0,
            next: 0,
            candidates: candidates.collect(),
            left_out: LeftOut::default(),
            plan,
        })
    }

    pub fn sets(&self) -> &[RaySet] {
        &self.sets
    }

    /// Returns how many turns are done and how many there are; `None` after the last.
    pub fn upcoming(&self) -> Option<(usize, usize)> {
        let count = self.candidates.len();
        let done = self.round * count + self.next;
        (done < self.plan.rounds * count).then_some((done, self.plan.rounds * count))
    }

    /// Runs the next turn. A cancelled turn can be run again.
    ///
    /// # Errors
    /// Settings out of range, or cancellation.
    pub fn turn(&mut self, progress: &Progress) -> Result<(), MeasureError> {
        if self.upcoming().is_none() {
            return Ok(());
        }
        let kept: usize = (self.candidates.iter())
            .filter_map(|c| c.tree.as_ref())
            .map(Tree::bytes)
            .sum();
        match self.measure(progress) {
            Ok(true) => {
                if kept > MOST_KEPT {
                    self.candidates[self.next].tree = None;
                }
                self.next += 1;
            }
            Ok(false) => drop(self.candidates.remove(self.next)),
            Err(error) if error.is_too_large() => {
                let build = self.candidates.remove(self.next).build;
                let refused = format!("{}: {error}", build.method.name);
                self.left_out.refused.push(refused);
            }
            Err(error) => return Err(error),
        }
        if self.next == self.candidates.len() {
            self.next = 0;
            self.round += 1;
        }
        Ok(())
    }

    /// Returns the sets of rays, the structures, and what is left out.
    pub fn into_result(self) -> (Vec<RaySet>, Vec<Observation>, LeftOut) {
        let observations = self.candidates.into_iter().map(|candidate| Observation {
            build: candidate.build,
            sets: candidate.sets,
        });
        (self.sets, observations.collect(), self.left_out)
    }

    /// Measures the next structure. Returns `false` if it is the same as an earlier one.
    fn measure(&mut self, progress: &Progress) -> Result<bool, MeasureError> {
        let (scene, pool, render) = (self.scene, &self.pool, &self.plan.render);
        let (earlier, rest) = self.candidates.split_at_mut(self.next);
        let candidate = &mut rest[0];
        if candidate.tree.is_none() {
            let (tree, time) = Times::of(pool, || build(scene, &candidate.build, progress));
            let tree = tree?;
            if candidate.sets.is_empty() {
                let mut known = Measurement::of_tree(scene, &tree, time, render);
                let is_same = |other: &Candidate| is_same(&other.sets[0].measurement, &known);
                if earlier.iter().any(is_same) {
                    self.left_out.same += 1;
                    return Ok(false);
                }
                pool.install(|| known.tree.find_overlaps(scene, &tree, progress))
                    .map_err(RenderError::from)?;
                let kernels = self.plan.kernels.len();
                candidate.sets = (self.sets.iter())
                    .map(|set| count(scene, &tree, &known, set, kernels, progress))
                    .collect();
                progress.check().map_err(RenderError::from)?;
            }
            candidate.tree = Some(tree);
        }
        let tree = candidate.tree.as_ref().expect("it was built above");
        let mut times = Vec::new();
        for set in &self.sets {
            for &kernel in &self.plan.kernels {
                times.push(time(scene, tree, render, kernel, set, progress));
                progress.check().map_err(RenderError::from)?;
            }
        }
        // Only now, so that a cancelled turn leaves no times.
        let seconds = candidate.sets.iter_mut().flat_map(|set| &mut set.seconds);
        seconds.zip(times).for_each(|(all, time)| all.push(time));
        Ok(true)
    }
}

/// Returns whether two structures are the same tree, as settings without effect build it.
fn is_same(a: &Measurement, b: &Measurement) -> bool {
    let facts = |m: &Measurement| {
        let tree = &m.tree;
        let counts = [
            tree.inner_nodes,
            tree.leaves,
            tree.references,
            tree.leaf_depths,
        ];
        (counts, [tree.inner_area, tree.test_area])
    };
    a.kind_of_node() == b.kind_of_node() && facts(a) == facts(b)
}

/// Counts the rays of a set.
fn count(
    scene: &Scene,
    tree: &Tree,
    known: &Measurement,
    set: &RaySet,
    kernels: usize,
    progress: &Progress,
) -> SetObservation {
    let precision = known.precision.precision;
    let mut counting = CountingKernel::new(tree, scene.shapes(precision), progress, 1);
    trace(&mut counting, set);
    let mut measurement = known.clone();
    measurement.counted = Some(CountedRender {
        tallies: counting.tallies,
        maxima: counting.maxima,
        leaves_squared: counting.leaves_squared,
        traversal: counting.traversal,
        objects_met: 0,
    });
    SetObservation {
        measurement,
        terms: Terms::of_batch(scene, tree, precision, set.batch()),
        seconds: vec![Vec::new(); kernels],
    }
}

/// Returns the CPU time of tracing a set in seconds, after it was traced once untimed.
fn time(
    scene: &Scene,
    tree: &Tree,
    render: &RenderSettings,
    kernel: KernelChoice,
    set: &RaySet,
    progress: &Progress,
) -> f64 {
    let shapes = scene.shapes(render.precision_for(scene).precision);
    let mut kernel = TimedKernel::new(kernel, scene, tree, shapes, progress);
    trace(&mut kernel, set);
    let mut timed = TimedBatches::new(kernel);
    trace(&mut timed, set);
    timed.time.as_secs_f64()
}

fn trace(kernel: &mut impl RayTracer, set: &RaySet) {
    match set.origin.kind() {
        RayKind::Shadow => kernel.any_hits(set.batch(), &mut Vec::new()),
        _ => kernel.closest_hits(set.batch(), &mut Vec::new()),
    }
}
