//! The terms of equation (1).

use crate::primitive::PrimitiveKind;
use crate::scene::Scene;

/// How equation (1) counts tests that hit an object.
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
    /// What is the same for all trees of a scene: shading, and hits if they do not vary.
    Constant,
}

impl Term {
    /// Returns the terms for a scene: `Constant` first, and last those that a fit drops first.
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

    /// Returns its meaning, in a sentence.
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
            Term::Constant => {
                "const: what is the same for every tree, such as shading and forming \
                               rays; distributed over the rays."
                    .into()
            }
        }
    }

    /// Returns its symbol in the paper, with the kind of primitive.
    pub fn name(self) -> String {
        match self {
            Term::Node => "T_T + T_P".into(),
            Term::Miss(kind) => format!("T_IUN {}", kind.name()),
            Term::Hit(kind) => format!("T_I {}", kind.name()),
            Term::Constant => "const".into(),
        }
    }
}
