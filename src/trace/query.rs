//! Scalar queries: closest hit and any hit of one ray, observed by a probe.

use super::space::{Space, SpaceRay, with_shapes};
use super::{Hit, LeafVisitor, Probe, Scratch};
use crate::geometry::Ray;
use crate::primitive::{Form, Shapes};
use crate::structure::Tree;
use std::cmp::Ordering;

/// Returns whether an object is hit before the best one so far, where both distances are rounded to the same
/// number: whether its exact distance is smaller, or equal and its index lower.
#[cold]
#[inline(never)]
pub(crate) fn wins_tie<F: Form>(objects: &[F], object: u32, best: &Hit, ray: &Ray) -> bool {
    if !best.is_hit() || object == best.object {
        return !best.is_hit();
    }
    let [a, b] = [object, best.object].map(|object| &objects[object as usize]);
    // Objects often stand twice in a scene.
    let order = if a == b {
        Ordering::Equal
    } else {
        a.exact_distance(ray).cmp(&b.exact_distance(ray))
    };
    order.then(object.cmp(&best.object)) == Ordering::Less
}

/// Keeps the closest hit.
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
            probe.test(object, || hit);
            if let Some(t) = hit
                && (t < self.best.t
                    || wins_tie(self.objects, object, &self.best, F::exact_ray(self.ray)))
            {
                self.best = Hit { t, object };
            }
        }
        self.best.t
    }
}

/// Stops at the first hit.
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
            let shape = &self.objects[object as usize];
            let is_hit = shape.is_hit(self.ray);
            // Distances take longer, so only hits are computed twice.
            let hit = || is_hit.then(|| shape.intersect(self.ray, self.t_max));
            probe.test(object, || hit().flatten());
            if is_hit {
                self.blocked = true;
                return f64::NEG_INFINITY;
            }
        }
        self.t_max
    }
}

/// A query about a ray, so that kernels need one loop for both.
pub(super) trait Query {
    type Answer: Copy;
    /// The answer for a ray that hits nothing.
    const MISS: Self::Answer;

    fn run<R: SpaceRay, F: Form<Ray = R>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &R,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> Self::Answer;

    fn is_hit(answer: Self::Answer) -> bool;
}

/// Finds the closest hit.
pub(super) struct ClosestHit;

impl Query for ClosestHit {
    type Answer = Hit;
    const MISS: Hit = Hit::MISS;

    #[inline(always)]
    fn run<R: SpaceRay, F: Form<Ray = R>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &R,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> Hit {
        let best = Hit {
            t: ray.interval()[1],
            object: u32::MAX,
        };
        let mut visitor = Closest { objects, ray, best };
        ray.traverse(tree, scratch, &mut visitor, probe);
        hit_in_world(visitor.best, ray)
    }

    fn is_hit(answer: Hit) -> bool {
        answer.is_hit()
    }
}

/// Finds whether anything is hit before the ray's end.
pub(super) struct AnyHit;

impl Query for AnyHit {
    type Answer = bool;
    const MISS: bool = false;

    #[inline(always)]
    fn run<R: SpaceRay, F: Form<Ray = R>, P: Probe>(
        tree: &Tree,
        objects: &[F],
        ray: &R,
        scratch: &mut Scratch,
        probe: &mut P,
    ) -> bool {
        let mut visitor = Any {
            objects,
            ray,
            t_max: ray.interval()[1],
            blocked: false,
        };
        ray.traverse(tree, scratch, &mut visitor, probe);
        visitor.blocked
    }

    fn is_hit(answer: bool) -> bool {
        answer
    }
}

/// Converts a hit along a ray of some space to one along the ray in the world.
#[inline(always)]
fn hit_in_world<R: SpaceRay>(hit: Hit, ray: &R) -> Hit {
    if hit.is_hit() {
        let t = ray.to_world(hit.t);
        Hit { t, ..hit }
    } else {
        Hit::MISS
    }
}

/// Runs a query for a ray in the world.
#[inline(always)]
pub(super) fn run<Q: Query, S: Space, F: Form<Ray = S::Ray>, P: Probe>(
    tree: &Tree,
    (space, objects): (&S, &[F]),
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> Q::Answer {
    match space.transform(ray) {
        Some(ray) => Q::run(tree, objects, &ray, scratch, probe),
        None => Q::MISS,
    }
}

/// Returns the closest hit of a ray, observed by a probe (`()` observes nothing); of equal distances the
/// lower object index.
pub fn closest_hit<P: Probe>(
    tree: &Tree,
    shapes: &Shapes,
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> Hit {
    with_shapes!(shapes, space, objects => {
        run::<ClosestHit, _, _, P>(tree, (space, objects), ray, scratch, probe)
    })
}

/// Returns whether anything lies on a ray before its end, observed by a probe.
pub fn any_hit<P: Probe>(
    tree: &Tree,
    shapes: &Shapes,
    ray: &Ray,
    scratch: &mut Scratch,
    probe: &mut P,
) -> bool {
    with_shapes!(shapes, space, objects => {
        run::<AnyHit, _, _, P>(tree, (space, objects), ray, scratch, probe)
    })
}

/// [`closest_hit`] by testing every object, without a tree.
pub fn closest_hit_brute_force(shapes: &Shapes, ray: &Ray) -> Hit {
    with_shapes!(shapes, space, objects => {
        let Some(ray) = space.transform(ray) else {
            return Hit::MISS;
        };
        let [_, t_max] = ray.interval();
        let best = Hit {
            t: t_max,
            ..Hit::MISS
        };
        let mut visitor = Closest {
            objects,
            ray: &ray,
            best,
        };
        for object in 0..objects.len() as u32 {
            visitor.visit(&[object], &mut ());
        }
        hit_in_world(visitor.best, &ray)
    })
}
