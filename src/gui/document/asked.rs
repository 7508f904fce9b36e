//! What a lesson asks for. Nothing that shows it is on view before the prediction is checked.

use super::Document;
use crate::lesson::Secret;
use crate::measure::heat::heatmaps;
use crate::measure::{Class, parameters};

/// What a pane shows and a lesson may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// These counters of the whole picture, by their symbols.
    Counters(&'static [&'static str]),
    /// All counters of the whole picture.
    AllCounters,
    /// The counters that result from building the tree.
    Tree,
    /// What each ray of a pixel did.
    Rays,
    /// The steps of a ray.
    Steps,
    /// How the pictures of A and B differ.
    Difference,
}

impl Fact {
    pub const ALL: &'static [Fact] =
        &[Fact::AllCounters, Fact::Rays, Fact::Steps, Fact::Difference];

    fn is_part_of(self, secret: &Secret) -> bool {
        let hides = |symbol: &&str| secret.hides_counter(symbol);
        match self {
            Fact::Counters(symbols) => symbols.iter().any(hides),
            Fact::AllCounters => parameters().iter().any(|p| hides(&p.symbol)),
            Fact::Tree => {
                let mut built = parameters().iter().filter(|p| p.class == Class::C);
                built.any(|p| hides(&p.symbol))
            }
            Fact::Rays => secret.hides_rays(),
            Fact::Steps => secret.hides_steps(),
            Fact::Difference => secret.hides_difference(),
        }
    }
}

impl Document {
    /// Whether one of these facts must not be shown yet.
    pub fn hides(&self, facts: &[Fact]) -> bool {
        facts.iter().any(|fact| fact.is_part_of(&self.asked))
    }

    /// Whether the heatmap on view must not be told in numbers yet.
    pub fn hides_heatmap(&self) -> bool {
        let shown = self.heatmap.and_then(|place| heatmaps().get(place));
        shown.is_some_and(|heatmap| self.asked.hides_heatmap(heatmap.symbol))
    }
}
