//! A record of everything that the rays of one pixel do, to explain the cost of the pixel.

use super::query::{any_hit, closest_hit};
use super::whitted::spawn;
use super::{
    BoxTest, Children, Fate, Hit, PixelTallies, Probe, RayCounts, RayKind, RenderError,
    RenderSettings, Scratch, Shading,
};
use crate::geometry::{Aabb, Axis, Ray, Vec3};
use crate::primitive::Shapes;
use crate::scene::Scene;
use crate::structure::{NodeKind, StopReason, Tree};
use serde::Serialize;

/// An inner node that a ray traversed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct InnerStep {
    /// Index of the node.
    pub node: u32,
    pub depth: u32,
    pub axis: Axis,
    /// World coordinate of the plane.
    pub plane: f64,
    /// The interval of the ray within the node's cell, widened for rounding.
    pub t_enter: f64,
    pub t_exit: f64,
    /// Where the ray crosses the plane; `None` if it is parallel.
    pub t_plane: Option<f64>,
    /// Where the far child begins, widened for rounding, if the ray visits both children.
    pub t_far: f64,
    #[serde(rename = "way")]
    pub children: Children,
    /// Indices of the near and the far child.
    pub near: u32,
    pub far: u32,
}

/// An intersection test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TestStep {
    pub object: u32,
    /// The distance of a hit before the closest one so far, if any.
    pub hit: Option<f64>,
}

/// Why a traversal continues after a leaf, or ends there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LeafOutcome {
    /// There is no hit so far: continues with the next leaf.
    NothingYet,
    /// The closest hit so far lies beyond this leaf: the next leaf may hold a closer one.
    HitBeyond,
    /// The closest hit so far lies in this leaf or before it, but a pending node begins before the hit, as
    /// boxes overlap.
    OverlapAhead,
    /// The closest hit lies before the next leaf: ends.
    HitNearer,
    /// Something blocks the light: ends.
    Blocked,
    /// No leaf is left on the ray: ends.
    NoLeafLeft,
}

impl LeafOutcome {
    /// Returns a short phrase.
    pub const fn text(self) -> &'static str {
        match self {
            LeafOutcome::NothingYet => "no hit yet: on to the next leaf",
            LeafOutcome::HitBeyond => "the hit lies beyond this leaf: on to the next",
            LeafOutcome::OverlapAhead => "a pending node begins before the hit: on to it",
            LeafOutcome::HitNearer => "the hit lies before any other leaf: done",
            LeafOutcome::Blocked => "the light is blocked: done",
            LeafOutcome::NoLeafLeft => "no leaf is left on the ray: done",
        }
    }
}

/// A leaf that a ray visited.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeafStep {
    /// Index of the node.
    pub node: u32,
    pub depth: u32,
    pub bounds: Aabb,
    /// Number of references to objects; 0 for an empty leaf.
    pub objects: u32,
    /// Why the cell became a leaf.
    pub stop: StopReason,
    /// The interval of the ray within the cell, widened for rounding.
    pub t_enter: f64,
    pub t_exit: f64,
    /// In order; a shadow ray ends at its first hit.
    pub tests: Vec<TestStep>,
    #[serde(rename = "after")]
    pub outcome: LeafOutcome,
}

/// An inner node of a hierarchy whose children's boxes were tested.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoxesStep {
    /// Index of the node.
    pub node: u32,
    pub depth: u32,
    /// The interval of the ray within the node's box, widened for rounding.
    pub t_enter: f64,
    pub t_exit: f64,
    /// In the order of the children.
    pub tests: Vec<BoxTest>,
}

impl BoxesStep {
    /// Returns the children that are visited or become pending, in the order of visits.
    pub fn entered(&self) -> Vec<&BoxTest> {
        let entered = self.tests.iter().filter(|test| test.fate == Fate::Entered);
        let mut entered: Vec<_> = entered.collect();
        entered.sort_by(|a, b| a.within[0].total_cmp(&b.within[0]));
        entered
    }
}

/// A pending node that was skipped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CulledStep {
    /// Index of the node.
    pub node: u32,
    pub depth: u32,
    /// Where its box begins, widened for rounding.
    pub t_enter: f64,
    /// The distance beyond which nothing matters.
    pub limit: f64,
}

/// One step of a traversal.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "step", rename_all = "lowercase")]
pub enum Step {
    Inner(InnerStep),
    Boxes(BoxesStep),
    Culled(CulledStep),
    Leaf(LeafStep),
}

impl Step {
    /// Returns the index of the node.
    pub fn node(&self) -> u32 {
        match self {
            Step::Inner(step) => step.node,
            Step::Boxes(step) => step.node,
            Step::Culled(step) => step.node,
            Step::Leaf(step) => step.node,
        }
    }

    /// Returns the interval of the ray within the node's cell, widened for rounding; of a node that was
    /// skipped, only where it begins.
    pub fn interval(&self) -> [f64; 2] {
        match self {
            Step::Inner(step) => [step.t_enter, step.t_exit],
            Step::Boxes(step) => [step.t_enter, step.t_exit],
            Step::Culled(step) => [step.t_enter, step.t_enter],
            Step::Leaf(step) => [step.t_enter, step.t_exit],
        }
    }
}

/// The traversal of one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct RayPath {
    pub kind: RayKind,
    pub ray: Ray,
    /// In order; empty if the ray misses the root cell.
    pub steps: Vec<Step>,
    /// The closest hit; for a shadow ray the one that blocks it.
    pub hit: Hit,
}

impl RayPath {
    /// Returns the visited leaves, in order.
    pub fn leaves(&self) -> impl Iterator<Item = &LeafStep> {
        self.steps.iter().filter_map(|step| match step {
            Step::Leaf(leaf) => Some(leaf),
            _ => None,
        })
    }

    /// Returns the counts of this ray, equal to those of the counting kernel.
    pub fn counts(&self) -> RayCounts {
        let mut counts = RayCounts::default();
        for step in &self.steps {
            match step {
                Step::Inner(_) => counts.inner_nodes += 1,
                Step::Boxes(step) => {
                    counts.inner_nodes += 1;
                    counts.box_tests += step.tests.len() as u32;
                }
                Step::Culled(_) => counts.culled += 1,
                Step::Leaf(leaf) => {
                    counts.leaves += 1;
                    counts.empty_leaves += u32::from(leaf.objects == 0);
                    counts.tests += leaf.tests.len() as u32;
                    let hits = leaf.tests.iter().filter(|test| test.hit.is_some());
                    counts.test_hits += hits.count() as u32;
                }
            }
        }
        counts
    }

    /// Returns where the ray is drawn to: its hit, its own end, or where it leaves the root cell.
    pub fn end(&self) -> f64 {
        let left = self.leaves().last().map_or(0.0, |leaf| leaf.t_exit);
        if self.hit.is_hit() {
            self.hit.t
        } else {
            self.ray.t_max.min(left)
        }
    }
}

/// A ray in the tree of rays of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedRay {
    pub path: RayPath,
    /// Index of the ray whose hit spawned this one; `None` for the primary ray.
    pub parent: Option<usize>,
    /// Number of bounces: 0 for the primary ray. A shadow ray has that of its parent.
    pub depth: u32,
    /// Weight of its radiance in the pixel, or of the light for a shadow ray.
    pub weight: Vec3,
}

/// The ray tree of one pixel, after Whitted.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelRecord {
    /// Column and row, from the upper left.
    pub pixel: [u32; 2],
    /// Linear color of sample 0.
    pub color: Vec3,
    /// Depth first: a ray before those that its hit spawned.
    pub rays: Vec<RecordedRay>,
    /// Whether rays are missing because of the limit on the size of the record.
    pub cut: bool,
}

impl PixelRecord {
    /// Returns the counts of this pixel, equal to those of the counting kernel.
    pub fn tallies(&self) -> PixelTallies {
        let mut tallies = PixelTallies::default();
        for ray in &self.rays {
            let path = &ray.path;
            tallies[path.kind as usize].add(&path.counts(), path.hit.is_hit());
        }
        tallies
    }
}

/// Traces sample 0 of a pixel and records all steps of its rays.
///
/// # Errors
/// A camera without a view or a resolution out of range.
pub fn record_pixel(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    pixel: [u32; 2],
) -> Result<PixelRecord, RenderError> {
    record_pixel_within(scene, tree, settings, pixel, usize::MAX)
}

/// As [`record_pixel`], but starts no further ray once the record has `limit` steps and tests. The ray tree
/// of a glass scene doubles with every level of `d_arec`.
///
/// # Errors
/// As [`record_pixel`].
pub fn record_pixel_within(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    [x, y]: [u32; 2],
    limit: usize,
) -> Result<PixelRecord, RenderError> {
    let shading = Shading::new(scene, settings)?;
    let mut recording = Recording {
        shading: &shading,
        tree,
        record: PixelRecord {
            pixel: [x, y],
            color: Vec3::ZERO,
            rays: Vec::new(),
            cut: false,
        },
        left: limit,
    };
    let ray = shading.view.primary_ray(x, y, 0);
    recording.follow(RayKind::Primary, ray, Vec3::ONE, None, 0);
    Ok(recording.record)
}

/// Traces one ray and records all its steps.
pub fn record_ray(tree: &Tree, shapes: &Shapes, kind: RayKind, ray: &Ray) -> RayPath {
    let mut recorder = Recorder {
        tree,
        steps: Vec::new(),
    };
    let mut scratch = Scratch::default();
    let hit = if kind == RayKind::Shadow {
        any_hit(tree, shapes, ray, &mut scratch, &mut recorder);
        recorder.last_hit()
    } else {
        closest_hit(tree, shapes, ray, &mut scratch, &mut recorder)
    };
    let mut steps = recorder.steps;
    complete(&mut steps, kind);
    RayPath {
        kind,
        ray: *ray,
        steps,
        hit,
    }
}

struct Recording<'a> {
    shading: &'a Shading<'a>,
    tree: &'a Tree,
    record: PixelRecord,
    /// Steps and tests that may still be recorded.
    left: usize,
}

impl Recording<'_> {
    fn follow(&mut self, kind: RayKind, ray: Ray, weight: Vec3, parent: Option<usize>, depth: u32) {
        if self.left == 0 {
            self.record.cut = true;
            return;
        }
        let path = record_ray(self.tree, self.shading.shapes, kind, &ray);
        let size = 1 + path.steps.len() + path.counts().tests as usize;
        self.left = self.left.saturating_sub(size);
        let hit = path.hit;
        let place = self.record.rays.len();
        self.record.rays.push(RecordedRay {
            path,
            parent,
            depth,
            weight,
        });
        if kind == RayKind::Shadow {
            if !hit.is_hit() {
                self.record.color += weight;
            }
        } else if hit.is_hit() {
            let mut children = Vec::new();
            spawn(
                self.shading,
                &ray,
                &hit,
                weight,
                depth,
                |kind, ray, weight| {
                    children.push((kind, ray, weight));
                },
            );
            for (kind, ray, weight) in children {
                let deeper = depth + u32::from(kind != RayKind::Shadow);
                self.follow(kind, ray, weight, Some(place), deeper);
            }
        } else {
            self.record.color += weight * self.shading.scene.background();
        }
    }
}

struct Recorder<'a> {
    tree: &'a Tree,
    steps: Vec<Step>,
}

impl Recorder<'_> {
    fn last_hit(&self) -> Hit {
        let last = self.steps.iter().rev().find_map(|step| match step {
            Step::Leaf(leaf) => leaf.tests.last().copied(),
            _ => None,
        });
        match last {
            Some(TestStep {
                object,
                hit: Some(t),
            }) => Hit { t, object },
            _ => Hit::MISS,
        }
    }
}

impl Probe for Recorder<'_> {
    fn inner(
        &mut self,
        node: u32,
        [t_enter, t_exit]: [f64; 2],
        t: f64,
        t_far: f64,
        children: Children,
    ) {
        let mut two = self.tree.child_nodes(node);
        let (Some((axis, plane)), Some(below), Some(above)) =
            (self.tree.plane(node), two.next(), two.next())
        else {
            return;
        };
        self.steps.push(Step::Inner(InnerStep {
            node,
            depth: self.tree.cell_of(node).depth,
            axis,
            plane,
            t_enter,
            t_exit,
            t_plane: t.is_finite().then_some(t),
            t_far,
            children,
            // Corrected by `complete`, when the next step is known.
            near: below,
            far: above,
        }));
    }

    fn boxes(&mut self, node: u32, [t_enter, t_exit]: [f64; 2], tests: &[BoxTest]) {
        self.steps.push(Step::Boxes(BoxesStep {
            node,
            depth: self.tree.cell_of(node).depth,
            t_enter,
            t_exit,
            tests: tests.to_vec(),
        }));
    }

    fn culled(&mut self, node: u32, t_enter: f64, limit: f64) {
        self.steps.push(Step::Culled(CulledStep {
            node,
            depth: self.tree.cell_of(node).depth,
            t_enter,
            limit,
        }));
    }

    fn leaf(&mut self, node: u32, objects: &[u32], [t_enter, t_exit]: [f64; 2]) {
        let cell = self.tree.cell_of(node);
        let NodeKind::Leaf { stop, .. } = self.tree.kind(node) else {
            return;
        };
        self.steps.push(Step::Leaf(LeafStep {
            node,
            depth: cell.depth,
            bounds: cell.bounds,
            objects: objects.len() as u32,
            stop,
            t_enter,
            t_exit,
            tests: Vec::new(),
            outcome: LeafOutcome::NothingYet,
        }));
    }

    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>) {
        if let Some(Step::Leaf(leaf)) = self.steps.last_mut() {
            leaf.tests.push(TestStep { object, hit: hit() });
        }
    }
}

/// Completes the steps with what depends on the following ones: near and far child, and the outcome of
/// leaves.
fn complete(steps: &mut [Step], kind: RayKind) {
    let mut nearest = f64::INFINITY;
    for i in 0..steps.len() {
        let next = steps.get(i + 1).map(Step::node);
        let is_visited = |step: &Step| !matches!(step, Step::Culled(_));
        let more_leaves = steps[i + 1..].iter().any(is_visited);
        match &mut steps[i] {
            Step::Boxes(_) | Step::Culled(_) => {}
            Step::Inner(step) => {
                let entered_above = next == Some(step.far);
                // `near` is the child below and `far` the one above so far. The next step shows which one
                // the ray entered, and `children` whether that is its near or its far child.
                if entered_above == (step.children != Children::Far) {
                    std::mem::swap(&mut step.near, &mut step.far);
                }
            }
            Step::Leaf(leaf) => {
                nearest = leaf
                    .tests
                    .iter()
                    .filter_map(|test| test.hit)
                    .fold(nearest, f64::min);
                leaf.outcome = match (more_leaves, nearest.is_finite()) {
                    (false, true) if kind == RayKind::Shadow => LeafOutcome::Blocked,
                    (false, true) => LeafOutcome::HitNearer,
                    (false, false) => LeafOutcome::NoLeafLeft,
                    (true, true) if nearest <= leaf.t_exit => LeafOutcome::OverlapAhead,
                    (true, true) => LeafOutcome::HitBeyond,
                    (true, false) => LeafOutcome::NothingYet,
                };
            }
        }
    }
}
