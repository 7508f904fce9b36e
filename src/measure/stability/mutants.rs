//! Mutation tests of the torture set: a traversal with one wrong decision must fail at least one
//! case.

use super::super::judge::Answer;
use super::{CASES, Kernel, Outcome, Trial};
use crate::geometry::Ray;
use crate::primitive::{Precision, Primitive, Shape};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{Method, Tree};
use crate::trace::{
    Hit, LeafVisitor, PlaneCrossing, Probe, RayKind, Scratch, TraversalRay, TraversalRayF64,
    traverse,
};
use std::marker::PhantomData;

/// A mutation of the decisions about a ray. The default methods change nothing.
trait Break {
    fn crossing(right: PlaneCrossing<f64>) -> PlaneCrossing<f64> {
        right
    }

    /// Returns whether the ray runs backward along an axis. `is_zero` is true if the direction has no
    /// component along the axis.
    fn is_backward(right: bool, is_zero: bool) -> bool {
        let _ = is_zero;
        right
    }

    fn reaches(right: bool, limit: f64) -> bool {
        let _ = limit;
        right
    }
}

/// A ray with mutated decisions.
struct Broken<B>(TraversalRayF64, PhantomData<B>);

impl<B: Break> TraversalRay for Broken<B> {
    type T = f64;
    const PENDING_IN_ORDER: bool = TraversalRayF64::PENDING_IN_ORDER;

    fn widened(interval: [f64; 2]) -> (f64, f64) {
        TraversalRayF64::widened(interval)
    }

    fn clip(&self, interval: (f64, f64), lo: &[f32; 3], hi: &[f32; 3]) -> Option<(f64, f64)> {
        self.0.clip(interval, lo, hi)
    }

    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<f64> {
        B::crossing(self.0.crossing(axis, plane))
    }

    fn is_backward(&self, axis: usize) -> bool {
        B::is_backward(self.0.is_backward(axis), self.0.is_along(axis))
    }

    fn reaches(t_enter: f64, limit: f64) -> bool {
        B::reaches(TraversalRayF64::reaches(t_enter, limit), limit)
    }
}

struct Nothing;

impl Break for Nothing {}

/// Mutation: the ray ends before every plane, so only near children are visited.
struct NearOnly;

impl Break for NearOnly {
    fn crossing(right: PlaneCrossing<f64>) -> PlaneCrossing<f64> {
        PlaneCrossing {
            surely_before: f64::INFINITY,
            ..right
        }
    }
}

/// Mutation: the ray starts behind every plane unless it ends before it.
struct FarOnly;

impl Break for FarOnly {
    fn crossing(right: PlaneCrossing<f64>) -> PlaneCrossing<f64> {
        PlaneCrossing {
            surely_behind: f64::NEG_INFINITY,
            ..right
        }
    }
}

/// Mutation: −0 counts as 0, although its inverse is −∞.
struct ZeroHasNoSign;

impl Break for ZeroHasNoSign {
    fn is_backward(right: bool, is_zero: bool) -> bool {
        right && !is_zero
    }
}

/// Mutation: any hit ends the traversal, even if a nearer hit may follow.
struct EndsAtAnyHit;

impl Break for EndsAtAnyHit {
    fn reaches(_: bool, limit: f64) -> bool {
        limit == f64::INFINITY
    }
}

/// Mutation: the far child is visited first.
struct FarFirst;

impl Break for FarFirst {
    fn is_backward(right: bool, _: bool) -> bool {
        !right
    }
}

/// Finds the nearest hit, or any hit.
struct Nearest<'a> {
    ray: &'a Ray,
    objects: &'a [Primitive],
    best: Hit,
    any: bool,
}

impl LeafVisitor for Nearest<'_> {
    fn visit<P: Probe>(&mut self, objects: &[u32], _: &mut P) -> f64 {
        for &object in objects {
            if let Some(t) = self.objects[object as usize].intersect(self.ray, self.best.t)
                && (t < self.best.t || object < self.best.object)
            {
                self.best = Hit { t, object };
            }
        }
        if self.any && self.best.is_hit() {
            f64::NEG_INFINITY
        } else {
            self.best.t
        }
    }
}

fn ask<B: Break>(
    scene: &Scene,
    tree: &Tree,
    kind: RayKind,
    rays: &[Ray],
    _: &Progress,
) -> Vec<Answer> {
    let mut scratch = Scratch::default();
    rays.iter()
        .map(|ray| {
            let mut nearest = Nearest {
                ray,
                objects: scene.objects(),
                best: Hit {
                    t: ray.t_max,
                    ..Hit::MISS
                },
                any: kind == RayKind::Shadow,
            };
            let line = Broken::<B>(TraversalRayF64::new(tree, ray), PhantomData);
            let interval = [ray.t_min, ray.t_max];
            let nodes = tree.nodes().planes();
            traverse(
                tree,
                nodes,
                interval,
                &line,
                &mut scratch,
                &mut nearest,
                &mut (),
            );
            let hit = Some(nearest.best).filter(Hit::is_hit);
            match kind {
                RayKind::Shadow => Answer::Blocked(hit.is_some()),
                _ => Answer::Nearest(hit.unwrap_or(Hit::MISS)),
            }
        })
        .collect()
}

/// Returns whether a kernel with this mutation fails a case about rays.
fn fails_a_case<B: Break>() -> bool {
    let kernel = Kernel {
        precision: Precision::F64,
        ask: ask::<B>,
    };
    let progress = Progress::new();
    let trial = Trial {
        scene: None,
        method: Method::of_the_paper()[0],
        kernel: &kernel,
        quick: true,
        progress: &progress,
    };
    let about_rays = CASES.iter().filter(|(theme, _)| *theme == "rays");
    about_rays
        .flat_map(|(_, cases)| *cases)
        .any(|case| matches!((case.run)(&trial), Outcome::Fail { .. }))
}

#[test]
fn unbroken_decisions_fail_no_case() {
    assert!(!fails_a_case::<Nothing>());
}

#[test]
fn the_near_child_alone_fails_a_case() {
    assert!(fails_a_case::<NearOnly>());
}

#[test]
fn the_far_child_alone_fails_a_case() {
    assert!(fails_a_case::<FarOnly>());
}

#[test]
fn a_zero_without_a_sign_fails_a_case() {
    assert!(fails_a_case::<ZeroHasNoSign>());
}

#[test]
fn ending_at_any_hit_fails_a_case() {
    assert!(fails_a_case::<EndsAtAnyHit>());
}

#[test]
fn the_far_child_first_fails_a_case() {
    assert!(fails_a_case::<FarFirst>());
}
