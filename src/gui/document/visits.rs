//! The visits of all nodes by the rays of the current picture: counted in the background when a pane
//! wants them.

use super::picture_job::{PictureJob, Progress};
use super::result::Current;
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{CountVisits, PictureVisits, Scheduler};
use crate::measure::heat::PIXEL_COUNTS_LIMIT;
use std::sync::Arc;

/// The job that counts visits.
pub type VisitsJob = PictureJob<CountVisits>;

impl VisitsJob {
    /// The visits of the current picture; `None` while they are not counted. Counting starts when
    /// the picture is finished.
    pub fn of(&self, current: &Current, jobs: &Scheduler) -> Option<Arc<PictureVisits>> {
        if is_too_large(current) {
            return None;
        }
        let shown = &current.shown;
        self.get(current, jobs, || CountVisits {
            scene: Arc::clone(&shown.scene),
            tree: Arc::clone(&shown.tree),
            render: shown.setup.render,
        })
    }

    /// Returns whether visits are being counted, or will be without a click.
    pub fn is_counting(&self, current: &Current) -> bool {
        let waits = matches!(self.progress(), Progress::Waiting | Progress::Running(_));
        waits && !is_too_large(current)
    }

    /// Why there are no visits yet, in words; `None` where they are counted.
    pub fn note(&self, current: &Current) -> Option<String> {
        if is_too_large(current) {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            return Some(format!(
                "Visits are counted of pictures of up to {limit} pixels."
            ));
        }
        match self.progress() {
            Progress::Waiting => Some("visits: counted when the picture is finished".to_owned()),
            Progress::Running(done) => Some(format!("counting visits … {:.0} %", done * 100.0)),
            Progress::Done => None,
            Progress::Ended(why) => Some(format!("visits not counted: {why}")),
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
