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

impl Case {
    /// Returns a case that makes its own scenes.
    pub const fn of_its_own_scenes(
        name: &'static str,
        rule: &'static str,
        run: fn(&Trial<'_>) -> Outcome,
    ) -> Self {
        Case {
            name,
            rule,
            any_scene: false,
            run,
        }
    }

    /// Returns a case that can run on a user's own scene.
    pub const fn of_any_scene(
        name: &'static str,
        rule: &'static str,
        run: fn(&Trial<'_>) -> Outcome,
    ) -> Self {
        Case {
            any_scene: true,
            ..Case::of_its_own_scenes(name, rule, run)
        }
    }
}
