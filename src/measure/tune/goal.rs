//! What the best tree is best for.

/// The figure by which trees are ranked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// The median rendering time, `T_TR`.
    #[default]
    Time,
    /// The memory of the tree, `M_TREE`.
    Memory,
}

impl Goal {
    pub const ALL: [Goal; 2] = [Goal::Time, Goal::Memory];

    /// Returns `time` or `memory`.
    pub const fn name(self) -> &'static str {
        ["time", "memory"][self as usize]
    }

    /// Returns the goal of this name.
    pub fn named(name: &str) -> Option<Goal> {
        Goal::ALL.into_iter().find(|goal| goal.name() == name)
    }
}
