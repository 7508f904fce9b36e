//! What a case of the torture set declares.

use super::trial::{Outcome, Trial};

/// A case of the torture set.
pub struct Case {
    /// A few words.
    pub name: &'static str,
    /// What is tried, and what counts as right.
    pub rule: &'static str,
    /// Whether it can be tried on a user's own scene.
    pub any_scene: bool,
    pub run: fn(&Trial<'_>) -> Outcome,
}
