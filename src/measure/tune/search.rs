//! What is searched for, and what is found.

use super::goal::Goal;
use super::ranking::{Rank, Score, best, rank};
use super::row::Row;
use crate::setup::Setup;
use crate::structure::{BuildError, Method};
use crate::trace::RenderSettings;
use std::time::Duration;

/// What is searched for.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// The scene, the picture and the camera; of its structure, what applies to every method.
    pub setup: Setup,
    pub goal: Goal,
    /// How many rays are traced in a tree after it is built once. Time is then that of both; `None` means only
    /// that of rendering.
    pub rays: Option<u64>,
    /// Trees that need more memory (`M_TREE`, in bytes) are left out.
    pub most_bytes: Option<u64>,
    /// The methods that are measured, as far as the scene is not too large for them.
    pub methods: Vec<Method>,
    /// Time for the measurements. When it is spent, no further turn begins, except that every method
    /// is timed at least once with its defaults. Two thirds of it are for trying settings, and the rest for timing the
    /// better ones again.
    pub budget: Duration,
}

/// What was not measured, and why.
#[derive(Clone, Debug, PartialEq)]
pub enum LeftOut {
    /// A method that is not tried in a scene with so many objects.
    Method { method: Method, objects: usize },
    /// A tree that could not be built.
    Refused { setup: Setup, why: BuildError },
    /// A tree that needs more bytes than the search allows.
    Memory { setup: Setup, bytes: u64 },
    /// Settings with which a method builds the same tree as with others that are measured.
    SameTree { setup: Setup },
    /// The time for trying settings was spent before so many were tried.
    Untried { settings: usize },
    /// The budget was spent when so many candidates were left, each of which was timed at least this often.
    Unfinished { candidates: usize, rounds: usize },
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuned {
    pub search: Search,
    /// How the small picture was rendered.
    pub render: RenderSettings,
    /// In the order in which they were first measured; at least one.
    pub rows: Vec<Row>,
    pub left_out: Vec<LeftOut>,
    /// Time that the measurements took.
    pub spent: Duration,
}

impl Tuned {
    fn scores(&self) -> Vec<Score> {
        let rows = self.rows.iter();
        rows.map(|row| row.score(self.search.rays)).collect()
    }

    /// Ranks the rows by the goal of the search, the best first.
    pub fn ranking(&self) -> Vec<Rank> {
        rank(&self.scores(), self.search.goal)
    }

    /// Returns the ranks of the best row of every method, and of all rows that were timed longest.
    pub fn short_ranking(&self) -> Vec<Rank> {
        let last = self.rows.iter().map(|row| row.rung).max();
        let mut methods = Vec::new();
        let mut ranking = self.ranking();
        ranking.retain(|rank| {
            let row = &self.rows[rank.place];
            let method = row.setup.build.method.name;
            let is_first = !methods.contains(&method);
            methods.push(method);
            is_first || (row.rung > 0 && Some(row.rung) == last)
        });
        ranking
    }

    /// Returns the index of the row that is recommended, and the row.
    ///
    /// # Panics
    /// If there are no rows.
    pub fn recommended(&self) -> (usize, &Row) {
        let place = best(&self.scores(), self.search.goal)[0];
        (place, &self.rows[place])
    }
}
