//! Counting the visits of all nodes by the rays of a picture.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderSettings, Visits, count_visits, thread_pool};
use std::ops::Deref;
use std::sync::Arc;

/// Counts how often the rays of a picture visit each node.
pub struct CountVisits {
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub render: RenderSettings,
}

/// The visits of a picture's rays.
pub struct PictureVisits {
    pub visits: Visits,
    /// Leaves, most visited first.
    pub leaves: Vec<u32>,
}

impl Deref for PictureVisits {
    type Target = Visits;

    fn deref(&self) -> &Visits {
        &self.visits
    }
}

impl PictureVisits {
    /// The most visited leaf; from a selected leaf on, the next in the order of visits, or with
    /// `back` the one before.
    pub fn step(&self, selected: Option<u32>, back: bool) -> Option<u32> {
        let at = self.leaves.iter().position(|leaf| Some(*leaf) == selected);
        let to = match (at, back) {
            (None, _) => 0,
            (Some(at), true) => at.saturating_sub(1),
            (Some(at), false) => (at + 1).min(self.leaves.len() - 1),
        };
        self.leaves.get(to).copied()
    }
}

impl Job for CountVisits {
    type Partial = ();
    type Output = PictureVisits;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("visits"), Priority::Pane)
    }

    fn run(self, context: &Context<()>) -> Result<PictureVisits, JobError> {
        context.stage("counting visits");
        let pool = thread_pool(self.render.threads)?;
        let visits = context.unit(|progress| {
            count_visits(&self.scene, &self.tree, &self.render, &pool, progress)
        })?;
        let leaves = visits.leaves_by_visits(&self.tree);
        Ok(PictureVisits { visits, leaves })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_visited_in_the_order_of_their_visits() {
        let visits = PictureVisits {
            visits: Visits::default(),
            leaves: vec![7, 3, 9],
        };
        assert_eq!(visits.step(None, false), Some(7));
        assert_eq!(visits.step(Some(1), true), Some(7));
        assert_eq!(visits.step(Some(7), false), Some(3));
        assert_eq!(visits.step(Some(9), false), Some(9));
        assert_eq!(visits.step(Some(3), true), Some(7));
    }
}
