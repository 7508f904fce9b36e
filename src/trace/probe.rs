//! Observers of traversals. A probe is a type parameter: `()` costs nothing.

use serde::Serialize;
use std::iter::Sum;
use std::ops::AddAssign;

/// The children of an inner node that a ray visits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Children {
    /// Only the near child: the ray ends before the plane.
    Near,
    /// Only the far child: the ray begins behind the plane.
    Far,
    /// Both, the near child first.
    Both,
}

/// What became of a child whose box was tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// The ray misses its box.
    Missed,
    /// Its box begins beyond the closest hit so far.
    BeyondHit,
    /// It is visited, or becomes pending.
    Entered,
}

impl Fate {
    /// Returns a word or two.
    pub const fn text(self) -> &'static str {
        match self {
            Fate::Missed => "missed",
            Fate::BeyondHit => "beyond the hit",
            Fate::Entered => "entered",
        }
    }
}

/// The test of one child's box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BoxTest {
    /// Index of the child.
    pub node: u32,
    /// The interval of the ray within the box; NaN if it misses the box.
    pub within: [f64; 2],
    pub fate: Fate,
}

impl BoxTest {
    /// A test that did not take place.
    pub(super) const NONE: BoxTest = BoxTest {
        node: 0,
        within: [f64::NAN; 2],
        fate: Fate::Missed,
    };
}

/// Observes every step of a traversal.
pub trait Probe {
    /// Called when an inner node is traversed. `within` is the ray's interval within its cell, `t` where the
    /// ray crosses the plane (infinite or NaN if parallel), and `t_far` where the far child begins if both
    /// children are visited.
    fn inner(&mut self, node: u32, within: [f64; 2], t: f64, t_far: f64, children: Children);
    /// Called when an inner node of a hierarchy is visited, after the boxes of all its children were tested.
    fn boxes(&mut self, node: u32, within: [f64; 2], tests: &[BoxTest]);
    /// Called when a pending node is skipped because it begins at `t_enter`, beyond `limit`.
    fn culled(&mut self, node: u32, t_enter: f64, limit: f64);
    /// Called after the objects of a leaf are tested. Nothing beyond `limit` matters from then on. The distance
    /// is along the ray in the coordinates in which it is traced.
    #[inline(always)]
    fn limit(&mut self, _limit: f64) {}
    /// Called when a leaf is visited. `within` is the ray's interval within its cell.
    fn leaf(&mut self, node: u32, objects: &[u32], within: [f64; 2]);
    /// Called when an object is tested. `hit` returns the distance of a hit before the closest one so far.
    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>);
}

/// Observes nothing: the probe of timed kernels.
impl Probe for () {
    #[inline(always)]
    fn inner(&mut self, _: u32, _: [f64; 2], _: f64, _: f64, _: Children) {}
    #[inline(always)]
    fn boxes(&mut self, _: u32, _: [f64; 2], _: &[BoxTest]) {}
    #[inline(always)]
    fn culled(&mut self, _: u32, _: f64, _: f64) {}
    #[inline(always)]
    fn leaf(&mut self, _: u32, _: &[u32], _: [f64; 2]) {}
    #[inline(always)]
    fn test(&mut self, _: u32, _: impl FnOnce() -> Option<f64>) {}
}

/// The counts of one ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RayCounts {
    /// Inner nodes traversed.
    pub inner_nodes: u32,
    /// Leaves visited, empty ones included.
    pub leaves: u32,
    /// Empty leaves visited.
    pub empty_leaves: u32,
    /// Intersection tests.
    pub tests: u32,
    /// Intersection tests that find a hit before the closest one so far.
    pub test_hits: u32,
    /// Tests of children's boxes; 0 for trees with planes.
    pub box_tests: u32,
    /// Pending nodes that were skipped because they begin beyond the closest hit.
    pub culled: u32,
}

impl Probe for RayCounts {
    #[inline(always)]
    fn inner(&mut self, _: u32, _: [f64; 2], _: f64, _: f64, _: Children) {
        self.inner_nodes += 1;
    }

    #[inline(always)]
    fn boxes(&mut self, _: u32, _: [f64; 2], tests: &[BoxTest]) {
        self.inner_nodes += 1;
        self.box_tests += tests.len() as u32;
    }

    #[inline(always)]
    fn culled(&mut self, _: u32, _: f64, _: f64) {
        self.culled += 1;
    }

    #[inline(always)]
    fn leaf(&mut self, _: u32, objects: &[u32], _: [f64; 2]) {
        self.leaves += 1;
        self.empty_leaves += u32::from(objects.is_empty());
    }

    #[inline(always)]
    fn test(&mut self, _: u32, hit: impl FnOnce() -> Option<f64>) {
        self.tests += 1;
        self.test_hits += u32::from(hit().is_some());
    }
}

/// Maxima over single rays. Each maximum may be that of another ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RayMaxima {
    /// Inner nodes and leaves traversed.
    pub nodes: u32,
    /// Inner nodes traversed.
    pub inner_nodes: u32,
    /// Leaves visited, empty ones included.
    pub leaves: u32,
    /// Empty leaves visited.
    pub empty_leaves: u32,
    /// Leaves with objects visited.
    pub full_leaves: u32,
    /// Intersection tests.
    pub tests: u32,
    /// Tests of children's boxes.
    pub box_tests: u32,
    /// Pending nodes that were skipped.
    pub culled: u32,
}

impl RayMaxima {
    /// Includes another ray.
    pub fn add(&mut self, counts: &RayCounts) {
        *self = self.merge(RayMaxima {
            nodes: counts.inner_nodes + counts.leaves,
            inner_nodes: counts.inner_nodes,
            leaves: counts.leaves,
            empty_leaves: counts.empty_leaves,
            full_leaves: counts.leaves - counts.empty_leaves,
            tests: counts.tests,
            box_tests: counts.box_tests,
            culled: counts.culled,
        });
    }

    /// Returns the maxima of both.
    pub fn merge(self, other: RayMaxima) -> RayMaxima {
        RayMaxima {
            nodes: self.nodes.max(other.nodes),
            inner_nodes: self.inner_nodes.max(other.inner_nodes),
            leaves: self.leaves.max(other.leaves),
            empty_leaves: self.empty_leaves.max(other.empty_leaves),
            full_leaves: self.full_leaves.max(other.full_leaves),
            tests: self.tests.max(other.tests),
            box_tests: self.box_tests.max(other.box_tests),
            culled: self.culled.max(other.culled),
        }
    }
}

/// The counts of all rays of one kind, in numbers of type `N`. The order of additions does not matter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally<N = u64> {
    /// Rays formed.
    pub rays: N,
    /// Rays that hit an object (before the light, for shadow rays).
    pub hits: N,
    /// Intersection tests.
    pub tests: N,
    /// Intersection tests that find a hit before the closest one so far.
    pub test_hits: N,
    /// Inner nodes traversed.
    pub inner_nodes: N,
    /// Leaves visited, empty ones included.
    pub leaves: N,
    /// Empty leaves visited.
    pub empty_leaves: N,
    /// Tests of children's boxes; 0 for trees with planes.
    pub box_tests: N,
    /// Pending nodes that were skipped because they begin beyond the closest hit.
    pub culled: N,
}

/// The counts of one pixel, by [`super::RayKind`].
pub type PixelTallies = [Tally<u32>; 4];

impl<N: From<u32> + AddAssign> Tally<N> {
    /// Adds one ray.
    pub fn add(&mut self, counts: &RayCounts, hit: bool) {
        self.rays += 1.into();
        self.hits += u32::from(hit).into();
        self.tests += counts.tests.into();
        self.test_hits += counts.test_hits.into();
        self.inner_nodes += counts.inner_nodes.into();
        self.leaves += counts.leaves.into();
        self.empty_leaves += counts.empty_leaves.into();
        self.box_tests += counts.box_tests.into();
        self.culled += counts.culled.into();
    }
}

impl<N: AddAssign, M: Into<N>> AddAssign<Tally<M>> for Tally<N> {
    fn add_assign(&mut self, other: Tally<M>) {
        self.rays += other.rays.into();
        self.hits += other.hits.into();
        self.tests += other.tests.into();
        self.test_hits += other.test_hits.into();
        self.inner_nodes += other.inner_nodes.into();
        self.leaves += other.leaves.into();
        self.empty_leaves += other.empty_leaves.into();
        self.box_tests += other.box_tests.into();
        self.culled += other.culled.into();
    }
}

impl<M: Into<u64>> Sum<Tally<M>> for Tally {
    fn sum<I: Iterator<Item = Tally<M>>>(tallies: I) -> Tally {
        tallies.fold(Tally::default(), |mut sum, tally| {
            sum += tally;
            sum
        })
    }
}
