//! What a case of the torture set declares.

use super::trial::{Outcome, Trial};

/// A case of the torture set.
pub struct Case {
    /// Name, a few words.
    pub name: &'static str,
    /// What the case tests, and which result is correct.
    pub rule: &'static str,
    /// Whether the case can run on a user's own scene.
    pub any_scene: bool,
    pub run: fn(&Trial<'_>) -> Outcome,
}
