//! What a lesson asks for. Nothing that shows it is on view before the prediction is checked.

use super::Document;

/// A kind of information that the window shows and a lesson may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// Counts of the tree: nodes, leaves, references, memory.
    Tree,
    /// What all rays of the picture did.
    Rays,
    /// What the rays of single pixels did.
    Pixel,
    /// How long something took.
    Time,
    /// How the pictures of A and B differ.
    Difference,
}

impl Fact {
    pub const ALL: &'static [Fact] = &[
        Fact::Tree,
        Fact::Rays,
        Fact::Pixel,
        Fact::Time,
        Fact::Difference,
    ];
}

impl Document {
    /// Whether one of these facts must not be shown yet.
    pub fn hides(&self, facts: &[Fact]) -> bool {
        facts.iter().any(|fact| self.asked.contains(fact))
    }
}
