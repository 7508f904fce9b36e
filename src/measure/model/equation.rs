//! The terms of equation (1).

use crate::primitive::PrimitiveKind;
use crate::scene::Scene;

/// How equation (1) counts tests that hit an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equation {
    /// As printed in the paper: `T_I` for every nearest hit of a primary or secondary ray, `T_IUN`
    /// for all other tests. A test that blocks a shadow ray is not counted.
    Printed,
    /// Corrected: `T_I` for every test that hits, of any ray, and `T_IUN` for every other test.
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
    /// `T_T + T_P`, per traversed node.
    Node,
    /// `T_B`, per test of a ray with the box of a child. The paper's trees have none.
    Box,
    /// `T_IUN`, per test of this kind that misses.
    Miss(PrimitiveKind),
    /// `T_I`, per test of this kind that hits.
    Hit(PrimitiveKind),
    /// The part that is the same for all trees of a scene: shading, and hits if their number does
    /// not vary.
    Constant,
}

impl Term {
    /// Returns the terms for a scene. `Constant` comes first; the terms that a fit drops first come
    /// last.
    pub fn of(scene: &Scene) -> Vec<Term> {
        let kinds = || {
            scene
                .requirements()
                .primitives
                .iter()
                .map(|(kind, _)| *kind)
        };
        [Term::Constant, Term::Node, Term::Box]
            .into_iter()
            .chain(kinds().map(Term::Miss))
            .chain(kinds().map(Term::Hit))
            .collect()
    }

    /// Returns the meaning in one sentence.
    pub fn meaning(self) -> String {
        match self {
            Term::Node => {
                "T_T + T_P: the time of a traversal step (T_T) and of the decision in the \
                           parent node (T_P), for one node; the two only occur as a sum."
                    .into()
            }
            Term::Box => {
                "T_B: the time of one test of a ray with the box of a child in a hierarchy.".into()
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

    /// Returns the symbol in the paper, with the kind of primitive.
    pub fn name(self) -> String {
        match self {
            Term::Node => "T_T + T_P".into(),
            Term::Box => "T_B".into(),
            Term::Miss(kind) => format!("T_IUN {}", kind.name()),
            Term::Hit(kind) => format!("T_I {}", kind.name()),
            Term::Constant => "const".into(),
        }
    }
}
