//! Kernels over batches of rays: closest hit and any hit, timed or counted.

use super::space::{Inside, Space, World};
use super::{LeafVisitor, PixelTallies, Probe, RayCounts, RayMaxima, Scratch, Tally};
use crate::geometry::Ray;
use crate::primitive::{Form, Shapes};
use crate::progress::Progress;
use crate::structure::Tree;
use cpu_time::ThreadTime;
use std::time::Duration;

/// The nearest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where on the ray; infinite for a miss.
    pub t: f64,
    /// Number of the object; [`Hit::MISS`]'s is no object.
    pub object: u32,
}

impl Hit {
    /// Nothing is hit.
    pub const MISS: Hit = Hit {
        t: f64::INFINITY,
        object: u32::MAX,
    };

    #[inline]
    pub fn is_hit(&self) -> bool {
        self.object != u32::MAX
    }

    /// A hit on a ray where it was traced, as one on the ray of the world.
    #[inline(always)]
    pub(super) fn in_world<I: Inside>(self, inside: &I) -> Hit {
        if self.is_hit() {
            let t = inside.to_world(self.t);
            Hit { t, ..self }
        } else {
            Hit::MISS
        }
    }
}

/// The kinds of ray that the paper's Table 3 tells apart; reflected and refracted rays are its
/// secondary rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RayKind {
    Primary = 0,
    Shadow = 1,
    Reflected = 2,
    Refracted = 3,
}

impl RayKind {
    pub const ALL: [RayKind; 4] = [
        RayKind::Primary,
        RayKind::Shadow,
        RayKind::Reflected,
        RayKind::Refracted,
    ];

    pub const fn name(self) -> &'static str {
        ["primary", "shadow", "reflected", "refracted"][self as usize]
    }
}

/// Rays of one kind, with the pixel of the tile that each belongs to.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    pub kind: RayKind,
    pub rays: &'a [Ray],
    pub pixels: &'a [u32],
}

/// How many rays are traced between two looks at whether the task was cancelled: even against
/// 50,000 objects each, they take a few milliseconds.
const RAYS_PER_LOOK: usize = 16;

/// Runs `$body` with `$objects` bound to the one array of objects there is and `$space` to where they
/// are, compiled once for every kind and precision.
macro_rules! with_shapes {
    ($shapes:expr, $space:ident, $objects:ident => $body:expr) => {
        match $shapes {
            $crate::primitive::Shapes::F64(arrays) => {
                let $space = &$crate::trace::space::World;
                $crate::primitive::with_array!(arrays, $objects => $body)
            }
            $crate::primitive::Shapes::F32 { frame, arrays, .. } => {
                let $space = frame;
                $crate::primitive::with_array!(arrays, $objects => $body)
            }
        }
    };
}
pub(super) use with_shapes;

/// What the renderer asks for, a batch at a time. A cancelled task leaves the rest of a batch
/// untraced, as misses.
pub trait RayTracer {
    /// The nearest hit of every ray; of equal distances the lower object number. `hits` is
    /// overwritten and gets the length of the batch.
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>);

    /// Whether anything lies on every ray before its end. `blocked` is overwritten likewise.
    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>);
}

struct Closest<'a, F: Form> {
    objects: &'a [F],
    ray: &'a F::Ray,
    best: Hit,
}

impl<F: Form> LeafVisitor for Closest<'_, F> {
    #[inline(always)]
    fn visit<P: Probe>(&mut self, objects: &[u32], probe: &mut P) -> f64 {
        for &object in objects {
            let hit = self.objects[object as usize].intersect(self.ray, self.best.t);
            probe.test(object, hit);
            if let Some(t) = hit
                && (t < self.best.t || object < self.best.object)
            {
                self.best = Hit { t, object };
            }
        }
        self.best.t
    }
}

struct Any<'a, F: Form> {
    objects: &'a [F],
    ray: &'a F::Ray,
    t_max: f64,
    blocked: bool,
}

impl<F: Form> LeafVisitor for Any<'_, F> {
    #[inline(always)]
    fn visit<P: Probe>(&mut self, objects: &[u32], probe: &mut P) -> f64 {
        for &object in objects {
            let hit = self.objects[object as usize].intersect(self.ray, self.t_max);
            probe.test(object, hit);
            if hit.is_some() {
                self.blocked = true;
                return f64::NEG_INFINITY;
            }
        }
        self.t_max
    }
}

/// Walks to the known end of a ray: through as many leaves as it visited, testing nothing.
struct Walk {
    leaves: u32,
}

impl LeafVisitor for Walk {
    #[inline(always)]
    fn visit<P: Probe>(&mut self, _: &[u32], _: &mut P) -> f64 {
        self.leaves -= 1;
        if self.leaves == 0 {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        }
    }
}

/// What is asked of a ray: the one thing in which the kernels' two loops differ.
trait Question {
    type Answer: Copy;
    /// The answer for a ray that hits nothing.
    const MISS: Self::Answer;

    fn ask<I: Inside, F: Form<Ray = I>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &I,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> Self::Answer;

    fn is_hit(answer: Self::Answer) -> bool;
}

/// What is the nearest hit?
struct WhatIsNearest;

impl Question for WhatIsNearest {
    type Answer = Hit;
    const MISS: Hit = Hit::MISS;

    #[inline(always)]
    fn ask<I: Inside, F: Form<Ray = I>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &I,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> Hit {
        let best = Hit {
            t: ray.interval()[1],
            object: u32::MAX,
        };
        let mut visitor = Closest { objects, ray, best };
        ray.walk(tree, scratch, &mut visitor, probe);
        visitor.best.in_world(ray)
    }

    fn is_hit(answer: Hit) -> bool {
        answer.is_hit()
    }
}

/// Is anything hit before the ray's end?
struct IsAnythingHit;

impl Question for IsAnythingHit {
    type Answer = bool;
    const MISS: bool = false;

    #[inline(always)]
    fn ask<I: Inside, F: Form<Ray = I>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &I,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> bool {
        let mut visitor = Any {
            objects,
            ray,
            t_max: ray.interval()[1],
            blocked: false,
        };
        ray.walk(tree, scratch, &mut visitor, probe);
        visitor.blocked
    }

    fn is_hit(answer: bool) -> bool {
        answer
    }
}

/// Asks about a ray of the world.
#[inline(always)]
fn ask<Q: Question, S: Space, F: Form<Ray = S::Inside>, P: Probe>(
    tree: &Tree,
    (space, objects): (&S, &[F]),
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> Q::Answer {
    match space.enter(ray) {
        Some(inside) => Q::ask(tree, objects, &inside, scratch, probe),
        None => Q::MISS,
    }
}

/// The nearest hit of one ray, watched by a probe (`()` watches nothing); of equal distances the
/// lower object number.
pub fn closest_hit<P: Probe>(
    tree: &Tree,
    shapes: &Shapes,
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> Hit {
    with_shapes!(shapes, space, objects => {
        ask::<WhatIsNearest, _, _, P>(tree, (space, objects), ray, scratch, probe)
    })
}

/// Whether anything lies on a ray before its end, watched by a probe.
pub fn any_hit<P: Probe>(
    tree: &Tree,
    shapes: &Shapes,
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> bool {
    with_shapes!(shapes, space, objects => {
        ask::<IsAnythingHit, _, _, P>(tree, (space, objects), ray, scratch, probe)
    })
}

/// [`closest_hit`] by testing every object, without a tree.
pub fn closest_hit_brute_force(shapes: &Shapes, ray: &Ray) -> Hit {
    with_shapes!(shapes, space, objects => {
        let Some(ray) = space.enter(ray) else {
            return Hit::MISS;
        };
        let [_, t_max] = ray.interval();
        let hits = objects.iter().zip(0..).filter_map(|(shape, object)| {
            let t = shape.intersect(&ray, t_max)?;
            Some(Hit { t, object })
        });
        // Of equal distances the first stays.
        let nearest = hits.reduce(|a, b| if b.t < a.t { b } else { a });
        nearest.map_or(Hit::MISS, |hit| hit.in_world(&ray))
    })
}

/// [`any_hit`] by testing every object, without a tree.
pub fn any_hit_brute_force(shapes: &Shapes, ray: &Ray) -> bool {
    with_shapes!(shapes, space, objects => {
        space.enter(ray).is_some_and(|ray| {
            let [_, t_max] = ray.interval();
            objects.iter().any(|shape| shape.intersect(&ray, t_max).is_some())
        })
    })
}

/// The kernel whose time counts: it counts nothing.
pub struct ScalarKernel<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: &'a Progress,
    scratch: Scratch,
}

impl<'a> ScalarKernel<'a> {
    pub fn new(tree: &'a Tree, shapes: &'a Shapes, progress: &'a Progress) -> Self {
        ScalarKernel {
            tree,
            shapes,
            progress,
            scratch: Scratch::default(),
        }
    }

    fn ask_all<Q: Question>(&mut self, batch: Batch<'_>, answers: &mut Vec<Q::Answer>) {
        answers.clear();
        with_shapes!(self.shapes, space, objects => {
            for rays in batch.rays.chunks(RAYS_PER_LOOK) {
                if self.progress.is_cancelled() {
                    break;
                }
                answers.extend(rays.iter().map(|ray| {
                    let scratch = &mut self.scratch;
                    ask::<Q, _, _, _>(self.tree, (space, objects), ray, scratch, &mut ())
                }));
            }
        });
        answers.resize(batch.rays.len(), Q::MISS);
    }
}

impl RayTracer for ScalarKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        self.ask_all::<WhatIsNearest>(batch, hits);
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        self.ask_all::<IsAnythingHit>(batch, blocked);
    }
}

/// The kernel whose counts count: its own time means nothing. Between its batches it walks the same
/// rays through the tree once more, by the timed traversal without tests, and takes that time.
pub struct CountingKernel<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: &'a Progress,
    scratch: Scratch,
    counts: Vec<RayCounts>,
    /// What the rays of each kind did, by [`RayKind`].
    pub tallies: [Tally; 4],
    /// The most that a ray of each kind did, by [`RayKind`].
    pub maxima: [RayMaxima; 4],
    /// CPU time of walking all rays to their known ends, without tests and shading.
    pub traversal: Duration,
    /// The same for every pixel of the batches.
    pub pixels: Vec<PixelTallies>,
}

impl<'a> CountingKernel<'a> {
    /// A kernel for batches of rays that belong to `pixels` pixels.
    pub fn new(tree: &'a Tree, shapes: &'a Shapes, progress: &'a Progress, pixels: usize) -> Self {
        CountingKernel {
            tree,
            shapes,
            progress,
            scratch: Scratch::default(),
            counts: Vec::new(),
            tallies: Default::default(),
            maxima: Default::default(),
            traversal: Duration::ZERO,
            pixels: vec![PixelTallies::default(); pixels],
        }
    }

    fn ask_all<Q: Question>(&mut self, batch: Batch<'_>, answers: &mut Vec<Q::Answer>) {
        answers.clear();
        self.counts.clear();
        with_shapes!(self.shapes, space, objects => {
            for rays in batch.rays.chunks(RAYS_PER_LOOK) {
                if self.progress.is_cancelled() {
                    break;
                }
                for ray in rays {
                    let mut counts = RayCounts::default();
                    let scratch = &mut self.scratch;
                    let objects = (space, objects);
                    answers.push(ask::<Q, _, _, _>(self.tree, objects, ray, scratch, &mut counts));
                    self.counts.push(counts);
                }
            }
        });
        let answered = batch.pixels.iter().zip(&self.counts).zip(&*answers);
        for ((&pixel, counts), &answer) in answered {
            let hit = Q::is_hit(answer);
            self.tallies[batch.kind as usize].add(counts, hit);
            self.maxima[batch.kind as usize].add(counts);
            self.pixels[pixel as usize][batch.kind as usize].add(counts, hit);
        }
        self.walk(batch.rays);
        answers.resize(batch.rays.len(), Q::MISS);
    }

    /// Walks rays to the ends that were just counted, and takes the time.
    fn walk(&mut self, rays: &[Ray]) {
        match self.shapes {
            Shapes::F64(_) => self.walk_in(&World, rays),
            Shapes::F32 { frame, .. } => self.walk_in(frame, rays),
        }
    }

    fn walk_in<S: Space>(&mut self, space: &S, rays: &[Ray]) {
        let start = ThreadTime::now();
        for (ray, counts) in rays.iter().zip(&self.counts) {
            // A ray that misses the root cell visits no leaf; walking it ends there, too.
            let leaves = counts.leaves.max(1);
            let mut walk = Walk { leaves };
            if let Some(inside) = space.enter(ray) {
                inside.walk(self.tree, &mut self.scratch, &mut walk, &mut ());
            }
            std::hint::black_box(&walk.leaves);
        }
        self.traversal += start.elapsed();
    }
}

impl RayTracer for CountingKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        self.ask_all::<WhatIsNearest>(batch, hits);
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        self.ask_all::<IsAnythingHit>(batch, blocked);
    }
}
