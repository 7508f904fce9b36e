//! The time model of the paper's equation (1): what an intersection test that hits, one that misses
//! and a traversed node take, found by regression over a set of trees and by timing in place.
//!
//! T_TR = (T_T + T_P) · N_NODES + T_I · hits + T_IUN · misses + const, with T_I and T_IUN for every
//! kind of primitive. `T_T` and `T_P` only occur as a sum, so no regression can tell them apart.

mod fit;
mod in_place;
mod observe;
mod picture;

pub use fit::{Coefficient, Fit, FitError, fit};
pub use in_place::{InPlace, time_in_place};
pub use observe::{Observation, Terms, observe};
pub use picture::{Part, PictureTerms, RayTerms, Region, TermTimes};

use crate::primitive::PrimitiveKind;
use crate::scene::Scene;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// How equation (1) counts tests that hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equation {
    /// As printed: `T_I` for every nearest hit of a primary or secondary ray, nothing for blocked
    /// shadow rays, `T_IUN` for all other tests.
    Printed,
    /// `T_I` for every test that hits, of whatever ray, `T_IUN` for every other one.
    Corrected,
}

impl Equation {
    pub const ALL: [Equation; 2] = [Equation::Corrected, Equation::Printed];

    pub const fn name(self) -> &'static str {
        match self {
            Equation::Printed => "printed",
            Equation::Corrected => "corrected",
        }
    }
}

/// A term of the equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// `T_T + T_P`: for every traversed node.
    Node,
    /// `T_IUN`: for every test of this kind that misses.
    Miss(PrimitiveKind),
    /// `T_I`: for every test of this kind that hits.
    Hit(PrimitiveKind),
    /// What is the same for every tree of a scene: shading, and hits where they do not vary.
    Constant,
}

impl Term {
    /// The terms for a scene: `Constant` first, then those that are given up for it, if need be,
    /// last.
    pub fn of(scene: &Scene) -> Vec<Term> {
        let kinds = || {
            scene
                .requirements()
                .primitives
                .iter()
                .map(|(kind, _)| *kind)
        };
        [Term::Constant, Term::Node]
            .into_iter()
            .chain(kinds().map(Term::Miss))
            .chain(kinds().map(Term::Hit))
            .collect()
    }

    /// What it stands for, in a sentence.
    pub fn meaning(self) -> String {
        match self {
            Term::Node => {
                "T_T + T_P: the time of a traversal step (T_T) and of the decision in the \
                           parent node (T_P), for one node; the two only occur as a sum."
                    .into()
            }
            Term::Miss(kind) => format!(
                "T_IUN: the time of one intersection test of a {} that misses.",
                kind.name()
            ),
            Term::Hit(kind) => format!(
                "T_I: the time of one intersection test of a {} that hits.",
                kind.name()
            ),
            Term::Constant => "const: what is the same for every tree, such as shading and making \
                               rays; shared out ray by ray."
                .into(),
        }
    }

    /// Its symbol in the paper, with the kind of primitive.
    pub fn name(self) -> String {
        match self {
            Term::Node => "T_T + T_P".into(),
            Term::Miss(kind) => format!("T_IUN {}", kind.name()),
            Term::Hit(kind) => format!("T_I {}", kind.name()),
            Term::Constant => "const".into(),
        }
    }
}

/// The trees that a model of a scene is made from: the paper's methods, depths around the automatic
/// one, two leaf sizes.
pub fn trees(scene: &Scene) -> Vec<BuildSettings> {
    let automatic = MaxDepth::Automatic.resolve(scene.objects().len());
    let mut all = Vec::new();
    for method in Method::of_the_paper() {
        for depth in [-4, -3, -2, -1, 0, 2] {
            for n_oilf in [1, 4] {
                let depth = automatic.saturating_add_signed(depth).clamp(1, 30);
                all.push(BuildSettings {
                    d_max: MaxDepth::Fixed(depth),
                    n_oilf,
                    ..BuildSettings::for_method(method)
                });
            }
        }
    }
    all
}

/// Observations parted in those that a model is fitted to and those it is tested on: every third
/// one is left out of the fit.
pub fn parted(observations: &[Observation]) -> [Vec<&Observation>; 2] {
    let numbered = || observations.iter().enumerate();
    let left_out = |i: usize| i % 3 == 1;
    [
        numbered()
            .filter(|(i, _)| !left_out(*i))
            .map(|(_, o)| o)
            .collect(),
        numbered()
            .filter(|(i, _)| left_out(*i))
            .map(|(_, o)| o)
            .collect(),
    ]
}
