//! The search for the best tree: the settings of the next one, and what the last one has found.

use super::study::Study;
use crate::jobs::{FindBestTree, Tried};
use crate::measure::tune::{Goal, Rank, Row, Score, Search, Spread, Tuned, best, rank};
use crate::structure::Method;
use std::sync::Arc;

/// The last search, and the settings of the next.
pub struct Tuning {
    pub goal: Goal,
    /// The methods that are chosen.
    pub methods: Vec<Method>,
    /// Time for the measurements in seconds.
    pub budget: u64,
    /// How many rays are traced after building once, at least 1.
    pub rays: Switched<u64>,
    /// The most memory of a tree in MiB, more than 0.
    pub memory: Switched<f64>,
    pub study: Study<FindBestTree, Found>,
}

/// A setting that can be switched off, and keeps its value meanwhile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switched<T> {
    pub is_on: bool,
    pub value: T,
}

impl<T: Copy> Switched<T> {
    /// Returns the value, if it is on.
    pub fn get(self) -> Option<T> {
        self.is_on.then_some(self.value)
    }
}

impl Default for Tuning {
    fn default() -> Self {
        Tuning {
            goal: Goal::default(),
            methods: Method::all().collect(),
            budget: 60,
            rays: Switched {
                is_on: false,
                value: 1_000_000,
            },
            memory: Switched {
                is_on: false,
                value: 64.0,
            },
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
    /// Returns the time by which a candidate is ranked, in seconds: of the picture, or of building once and tracing
    /// the rays that were asked for.
    pub fn time(&self, row: &Row) -> Spread {
        row.score(self.search.rays).seconds
    }

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
