//! The visits of all nodes by the rays of the current picture: counted in the background when a pane
//! wants them.

use super::picture_pass::{PicturePass, Standing};
use super::state::Current;
use super::symbol::grouped;
use crate::measure::heat::PIXEL_COUNTS_LIMIT;
use crate::trace::{Visits, count_visits, thread_pool};
use std::ops::Deref;
use std::sync::Arc;

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

/// The pass that counts visits.
pub type VisitsPass = PicturePass<PictureVisits>;

impl VisitsPass {
    /// The visits of the current picture; `None` while they are not counted. Counting begins when
    /// the picture is finished and the worker is `resting`.
    pub fn of(
        &mut self,
        current: &Current,
        resting: bool,
        ctx: &egui::Context,
    ) -> Option<Arc<PictureVisits>> {
        let shown = &current.shown;
        let render = shown.setup.render;
        if is_too_large(current) {
            return None;
        }
        let (scene, tree) = (Arc::clone(&shown.scene), Arc::clone(&shown.tree));
        self.get(current, resting, ctx, move |progress| {
            let pool = thread_pool(render.threads)?;
            let visits = count_visits(&scene, &tree, &render, &pool, progress)?;
            let leaves = visits.leaves_by_visits(&tree);
            Ok(PictureVisits { visits, leaves })
        })
    }

    /// Why there are no visits yet, in words; `None` where they are counted.
    pub fn note(&self, current: &Current) -> Option<String> {
        if is_too_large(current) {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            return Some(format!(
                "Visits are counted of pictures of up to {limit} pixels."
            ));
        }
        match self.standing() {
            Standing::Waiting => Some("visits: counted when the picture is finished".to_owned()),
            Standing::Running(done) => Some(format!("counting visits … {:.0} %", done * 100.0)),
            Standing::Done => None,
            Standing::Ended(why) => Some(format!("visits not counted: {why}")),
        }
    }

    /// Shows how counting stands, with a button to cancel it or to begin it again.
    pub fn show(&mut self, ui: &mut egui::Ui, current: &Current) {
        let Some(note) = self.note(current) else {
            return;
        };
        ui.label(note);
        let (name, about) = match self.standing() {
            Standing::Running(_) => ("Cancel counting", "Stop counting visits."),
            Standing::Ended(_) => ("Count again", "Begin counting visits again."),
            Standing::Waiting | Standing::Done => return,
        };
        if ui.button(name).on_hover_text(about).clicked() {
            if name == "Count again" {
                self.again();
            } else {
                self.cancel();
            }
        }
    }
}

/// What is counted, for tooltips.
pub const ABOUT: &str = "Rays of the picture that visited the node, and their share of all its rays: \
                         primary, shadow, reflected and refracted ones, as they run. Over the leaves \
                         they sum to the visited leaves of all rays.";

fn is_too_large(current: &Current) -> bool {
    let picture = &current.shown.picture;
    u64::from(picture.width) * u64::from(picture.height) > PIXEL_COUNTS_LIMIT
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_walked_in_the_order_of_their_visits() {
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
