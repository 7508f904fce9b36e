//! The content of a report on a search.

use crate::measure::tune::Tuned;

/// A search for the best tree with the name of its scene.
pub struct TuneReport {
    pub scene: String,
    pub tuned: Tuned,
}
