//! A traversal with one decision broken fails cases: they would notice.

use super::super::judge::{Answer, Precision};
use super::{CASES, Kernel, Outcome, Trial};
use crate::geometry::Ray;
use crate::primitive::{Primitive, Shape};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::trace::{
    Conservative, Decisions, Hit, LeafVisitor, Probe, RayKind, Scratch, traverse_by,
};
use crate::tree::{Method, Tree};

/// Only the near child where the plane is met within the cell.
struct NearFlipped;

impl Decisions for NearFlipped {
    fn is_near_only(t: f64, t_exit: f64) -> bool {
        t < t_exit
    }
}

/// Only the far child where the plane is met within the cell.
struct FarFlipped;

impl Decisions for FarFlipped {
    fn is_far_only(t: f64, t_enter: f64) -> bool {
        t > t_enter
    }
}

/// −0 counts as 0, though its inverse is −∞.
struct ZeroHasNoSign;

impl Decisions for ZeroHasNoSign {
    fn comes_from_above(direction: f64) -> bool {
        direction < 0.0
    }
}

/// A hit always ends the walk.
struct EndsAtAnyHit;

impl Decisions for EndsAtAnyHit {
    fn goes_on(_: f64, limit: f64) -> bool {
        limit == f64::INFINITY
    }
}

/// The far child comes first.
struct FarFirst;

impl Decisions for FarFirst {
    fn comes_from_above(direction: f64) -> bool {
        direction >= 0.0
    }
}

/// The nearest hit, or any.
struct Nearest<'a> {
    objects: &'a [Primitive],
    best: Hit,
    any: bool,
}

impl LeafVisitor for Nearest<'_> {
    fn visit<P: Probe>(&mut self, ray: &Ray, objects: &[u32], _: &mut P) -> f64 {
        for &object in objects {
            if let Some(t) = self.objects[object as usize].intersect(ray, self.best.t)
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

fn ask<D: Decisions>(
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
                objects: scene.objects(),
                best: Hit {
                    t: ray.t_max,
                    ..Hit::MISS
                },
                any: kind == RayKind::Shadow,
            };
            traverse_by::<D, _, _>(tree, ray, &mut scratch, &mut nearest, &mut ());
            let hit = Some(nearest.best).filter(Hit::is_hit);
            match kind {
                RayKind::Shadow => Answer::Blocked(hit.is_some()),
                _ => Answer::Nearest(hit.unwrap_or(Hit::MISS)),
            }
        })
        .collect()
}

/// Whether a case about rays fails by a kernel with these decisions.
fn fails_a_case<D: Decisions>() -> bool {
    let kernel = Kernel {
        precision: Precision::F64,
        ask: ask::<D>,
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
    assert!(!fails_a_case::<Conservative>());
}

#[test]
fn a_flipped_comparison_with_the_exit_fails_a_case() {
    assert!(fails_a_case::<NearFlipped>());
}

#[test]
fn a_flipped_comparison_with_the_entry_fails_a_case() {
    assert!(fails_a_case::<FarFlipped>());
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
