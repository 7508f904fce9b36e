//! Finding the best tree for a scene.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::tune::{LeftOut, Row, Search, Tuned, Tuning, Turn, Upcoming, rounds_after};
use crate::scene::Scene;
use std::sync::Arc;

/// Parts into which the bar of the search is divided.
const PARTS: usize = 1000;

/// Measures all build methods with many settings, and the better ones more often.
pub struct FindBestTree {
    /// As the setup of `search` describes it.
    pub scene: Arc<Scene>,
    pub search: Search,
}

impl FindBestTree {
    pub const SLOT: Slot = Slot::named("best tree");
}

/// What is known after one candidate was timed once more.
pub struct Tried {
    /// Which of the rows has another time now; the number of the rows before if it is new.
    pub place: usize,
    pub row: Row,
}

impl Job for FindBestTree {
    type Partial = Tried;
    type Output = Tuned;

    fn place(&self) -> (Slot, Priority) {
        (FindBestTree::SLOT, Priority::Study)
    }

    fn run(self, context: &Context<Tried>) -> Result<Tuned, JobError> {
        let FindBestTree { scene, search } = self;
        let mut tuning = Tuning::new(&scene, search)?;
        while let Some(upcoming) = tuning.upcoming() {
            context.stage(stage(&upcoming));
            context.part((upcoming.fraction * PARTS as f64) as usize, PARTS);
            // A turn that was interrupted continues with the tree and the counts that it has.
            let turn = context.timed(|progress| tuning.turn(progress))?;
            if let Some(Turn::Timed(place)) = turn {
                let row = tuning.rows()[place].clone();
                context.send(Tried { place, row });
            }
        }
        let is_empty = tuning.rows().is_empty();
        let tuned = tuning.into_result();
        if is_empty {
            return Err(JobError::new(nothing_left(&tuned)));
        }
        Ok(tuned)
    }
}

/// Returns why a search found nothing.
fn nothing_left(tuned: &Tuned) -> String {
    let bytes = tuned.left_out.iter().filter_map(|left_out| match left_out {
        LeftOut::Memory { bytes, .. } => Some(*bytes),
        _ => None,
    });
    match bytes.min() {
        Some(least) => format!(
            "no tree is small enough: the smallest needs {least} bytes; allow more memory or choose more methods"
        ),
        None => "no method was measured".to_owned(),
    }
}

/// Describes the next turn.
fn stage(upcoming: &Upcoming<'_>) -> String {
    let Upcoming {
        rung,
        rounds,
        candidates,
        candidate,
        ..
    } = upcoming;
    let of = rounds_after(*rung);
    format!(
        "{candidates} candidates, round {} of {of}: {}",
        rounds + 1,
        candidate.build.in_words()
    )
}
