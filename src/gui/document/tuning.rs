//! The search for the best tree: the settings of the next one, and what the last one has found.

use super::study::Study;
use crate::jobs::{FindBestTree, Tried};
use crate::measure::tune::{Goal, Rank, Row, Score, Search, Tuned, best, rank};
use crate::structure::Method;
use std::sync::Arc;

/// The last search, and the settings of the next.
pub struct Tuning {
    pub goal: Goal,
    /// The methods that are chosen.
    pub methods: Vec<Method>,
    /// Time for the measurements in seconds.
    pub budget: u64,
    pub study: Study<FindBestTree, Found>,
}

impl Default for Tuning {
    fn default() -> Self {
        Tuning {
            goal: Goal::default(),
            methods: Method::all().collect(),
            budget: 60,
            study: Study::default(),
        }
    }
}

/// What is known of a search; it grows with every time that is taken.
#[derive(Clone)]
pub struct Found {
    pub search: Search,
    /// The scene's name.
    pub scene: String,
    /// The candidates so far, in the order in which they were first measured.
    pub rows: Vec<Row>,
    /// The whole result, once the search is complete.
    pub tuned: Option<Arc<Tuned>>,
}

impl Found {
    fn scores(&self) -> Vec<Score> {
        let rows = self.rows.iter();
        rows.map(|row| row.score(self.search.rays)).collect()
    }

    /// Ranks the candidates so far, the best first.
    pub fn ranking(&self) -> Vec<Rank> {
        let scores = self.scores();
        rank(&scores, self.search.goal)
    }

    /// Returns the candidate that is recommended so far.
    pub fn best(&self) -> Option<&Row> {
        let scores = self.scores();
        let place = *best(&scores, self.search.goal).first()?;
        self.rows.get(place)
    }
}

impl Tuning {
    /// Adds what has been measured since the last frame.
    pub fn receive(&mut self) {
        let tuned =
            self.study.receive(
                |found, Tried { place, row }| match found.rows.get_mut(place) {
                    Some(known) => *known = row,
                    None => found.rows.push(row),
                },
            );
        if let (Some(tuned), Some(found)) = (tuned, self.study.found_mut()) {
            found.tuned = Some(Arc::new(tuned));
        }
    }
}
