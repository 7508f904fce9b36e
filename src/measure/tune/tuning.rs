//! The search for the best tree, turn by turn.

use super::candidates::{candidates, is_default, is_tried};
use super::halving::{self, RUNGS, half, rounds_after, rounds_in, survivors};
use super::ranking::{Score, best};
use super::row::Row;
use super::search::{LeftOut, Search, Tuned};
use crate::measure::{MeasureError, Measurement, Times};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::setup::Setup;
use crate::structure::{BuildError, Tree, build};
use crate::trace::{RenderSettings, render_counted, render_timed, thread_pool};
use rayon::ThreadPool;
use std::time::{Duration, Instant};

/// Width of the picture that is timed; narrower pictures are timed as they are.
const WIDTH: u32 = 128;

/// The most bytes that the trees between two rounds may take. Trees beyond this are built again in
/// every round.
const MOST_KEPT: usize = 1 << 30;

/// The part of the budget in which settings are tried.
const FOR_TRYING: f64 = 2.0 / 3.0;

/// In the first rung, the untimed picture is as many times narrower and lower than the timed one: there are many
/// candidates, and their times need not be exact.
const SMALLER: u32 = 4;

/// What a turn will do.
pub struct Upcoming<'a> {
    /// From 0.
    pub rung: usize,
    /// How often each candidate that is left has been timed, not counting this round.
    pub rounds: usize,
    /// How many candidates are left; in the first rung, how many there are.
    pub candidates: usize,
    pub candidate: &'a Setup,
    /// How much of the whole search is done, 0 to 1: of its turns or of its budget, whichever is
    /// more.
    pub fraction: f64,
}

/// The result of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The row at this index has another time; in the first rung, it can be new.
    Timed(usize),
    /// The candidate is not measured; [`Tuned::left_out`] says why.
    LeftOut,
}

/// A search that runs turn by turn. A turn times one candidate once; in its first, the candidate is
/// also built. The defaults of a method are counted in their first turn, others in their second. A cancelled turn can be
/// run again, and continues after what was complete.
pub struct Tuning<'a> {
    scene: &'a Scene,
    search: Search,
    render: RenderSettings,
    pool: ThreadPool,
    rung: usize,
    /// Completed rounds of the rung.
    round: usize,
    /// Index of the next candidate of the round.
    next: usize,
    /// Those that are left.
    candidates: Vec<Candidate>,
    /// Other settings of every method, before all methods were timed with their defaults.
    variations: Vec<Vec<Setup>>,
    rows: Vec<Row>,
    left_out: Vec<LeftOut>,
    turns_done: usize,
    spent: Duration,
    has_ended: bool,
}

/// A candidate that is left.
struct Candidate {
    setup: Setup,
    /// Index of its row, once it was timed.
    row: Option<usize>,
    tree: Option<Tree>,
    /// With counts, once it was counted.
    known: Option<Measurement>,
}

impl Candidate {
    fn new(setup: Setup) -> Self {
        Candidate {
            setup,
            row: None,
            tree: None,
            known: None,
        }
    }
}

/// Returns the settings of the small picture: the user's, at most [`WIDTH`] pixels wide, with the
/// same ratio of width to height.
fn small(render: &RenderSettings) -> RenderSettings {
    let width = render.width.min(WIDTH);
    let height = f64::from(render.height) * f64::from(width) / f64::from(render.width.max(1));
    RenderSettings {
        width,
        height: (height.round() as u32).max(1),
        samples: 1,
        ..*render
    }
}

impl<'a> Tuning<'a> {
    /// Creates a search in the scene that its setup describes. Measures nothing yet.
    ///
    /// # Errors
    /// The picture has no view, settings are out of range, or the threads cannot be created.
    pub fn new(scene: &'a Scene, search: Search) -> Result<Self, MeasureError> {
        let objects = scene.objects().len();
        let render = small(&search.setup.render);
        search.setup.render.view(scene)?;
        let methods = search.methods.iter().copied();
        let (tried, untried): (Vec<_>, Vec<_>) =
            methods.partition(|method| is_tried(*method, objects));
        let mut defaults = Vec::new();
        let mut variations = Vec::new();
        for method in tried {
            let mut all = candidates(&search.setup, method, objects);
            for candidate in &all {
                candidate.build.check().map_err(BuildError::from)?;
            }
            variations.push(all.split_off(1));
            defaults.extend(all.into_iter().map(Candidate::new));
        }
        Ok(Tuning {
            scene,
            pool: thread_pool(render.threads)?,
            search,
            render,
            rung: 0,
            round: 0,
            next: 0,
            candidates: defaults,
            variations,
            rows: Vec::new(),
            left_out: untried
                .into_iter()
                .map(|method| LeftOut::Method { method, objects })
                .collect(),
            turns_done: 0,
            spent: Duration::ZERO,
            has_ended: false,
        })
    }

    /// Returns the rows so far.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Returns the result, for now or at the end, if there are rows.
    pub fn into_result(self) -> Tuned {
        Tuned {
            search: self.search,
            render: self.render,
            rows: self.rows,
            left_out: self.left_out,
            spent: self.spent,
        }
    }

    /// Returns what the next turn will do; `None` if the search has ended.
    pub fn upcoming(&mut self) -> Option<Upcoming<'_>> {
        self.advance();
        if self.has_ended {
            return None;
        }
        let waiting = self.variations.iter().flatten().count();
        Some(Upcoming {
            rung: self.rung,
            rounds: self.rounds(),
            candidates: self.candidates.len() + waiting,
            candidate: &self.candidates[self.next].setup,
            fraction: self.fraction(),
        })
    }

    /// Runs the next turn. Returns `None` if the search has ended.
    ///
    /// # Errors
    /// No tree at all could be built, or cancellation.
    pub fn turn(&mut self, progress: &Progress) -> Result<Option<Turn>, MeasureError> {
        self.advance();
        if self.has_ended {
            return Ok(None);
        }
        let start = Instant::now();
        let result = self.measure(progress);
        self.spent += start.elapsed();
        match result {
            Ok(turn) => {
                self.turns_done += 1;
                match turn {
                    Turn::Timed(_) => self.next += 1,
                    Turn::LeftOut => drop(self.candidates.remove(self.next)),
                }
                Ok(Some(turn))
            }
            Err(MeasureError::Build(why))
                if why.is_too_large() && (self.candidates.len() > 1 || !self.rows.is_empty()) =>
            {
                let setup = self.candidates.remove(self.next).setup;
                self.left_out.push(LeftOut::Refused { setup, why });
                Ok(Some(Turn::LeftOut))
            }
            Err(error) => Err(error),
        }
    }

    /// Returns how often all candidates that are left have been timed.
    fn rounds(&self) -> usize {
        rounds_after(self.rung) - rounds_in(self.rung) + self.round
    }

    /// Goes to the next candidate, round or rung, and ends the search after the last one or when
    /// the budget is spent.
    fn advance(&mut self) {
        let budget = self.search.budget;
        let is_trying = self.rung == 0 && self.variations.is_empty();
        if is_trying && self.spent >= budget.mul_f64(FOR_TRYING) {
            let settings = self.candidates.len() - self.next;
            self.candidates.truncate(self.next);
            if settings > 0 {
                self.left_out.push(LeftOut::Untried { settings });
            }
        }
        while !self.has_ended && self.next >= self.candidates.len() {
            if !self.variations.is_empty() {
                self.vary();
                return self.advance();
            }
            self.next = 0;
            self.round += 1;
            if self.round >= rounds_in(self.rung) {
                self.halve();
            }
        }
        if !self.has_ended && self.rung > 0 && self.spent >= budget {
            self.has_ended = true;
            self.left_out.push(LeftOut::Unfinished {
                candidates: self.candidates.len(),
                rounds: self.rounds(),
            });
        }
    }

    /// Adds the other settings of all methods: the next one of each method, beginning with the best, and so on. What
    /// suits one method often suits another, so all get their turn before the time is spent.
    fn vary(&mut self) {
        let order = best(&self.scores(), self.search.goal);
        let place = |variations: &Vec<Setup>| {
            let method = variations.first()?.build.method;
            let is_it = |place: &usize| self.rows[*place].setup.build.method == method;
            order.iter().position(is_it)
        };
        let mut all = std::mem::take(&mut self.variations);
        all.sort_by_key(|variations| place(variations).unwrap_or(usize::MAX));
        let longest = all.iter().map(Vec::len).max().unwrap_or(0);
        let mut all: Vec<_> = all.into_iter().map(Vec::into_iter).collect();
        for _ in 0..longest {
            let next = all.iter_mut().filter_map(Iterator::next);
            self.candidates.extend(next.map(Candidate::new));
        }
    }

    /// Drops the worse half of the candidates, and begins the next rung.
    fn halve(&mut self) {
        let standing: Vec<usize> = self.candidates.iter().filter_map(|c| c.row).collect();
        let order = survivors(&self.scores(), &standing, self.search.goal);
        let place =
            |candidate: &Candidate| order.iter().position(|row| candidate.row == Some(*row));
        self.candidates
            .retain(|candidate| place(candidate).is_some());
        self.candidates.sort_by_key(place);
        self.has_ended = order.is_empty() || halving::is_last(self.rung, order.len());
        if !self.has_ended {
            self.rung += 1;
            self.round = 0;
        }
    }

    fn scores(&self) -> Vec<Score> {
        let rays = self.search.rays;
        self.rows.iter().map(|row| row.score(rays)).collect()
    }

    /// Returns how much of the search is done, if the worse half is dropped after every rung.
    fn fraction(&self) -> f64 {
        let mut left = self.candidates.len() + self.variations.iter().flatten().count();
        let mut turns = (rounds_in(self.rung) - self.round) * left - self.next;
        for rung in self.rung + 1..RUNGS {
            left = half(left);
            if halving::is_last(rung - 1, left) {
                break;
            }
            turns += rounds_in(rung) * left;
        }
        let of_turns = self.turns_done as f64 / (self.turns_done + turns) as f64;
        let of_budget = self.spent.as_secs_f64() / self.search.budget.as_secs_f64();
        // Without a budget there is only the round that it does not limit.
        if of_budget.is_finite() {
            of_turns.max(of_budget).min(1.0)
        } else {
            of_turns
        }
    }

    /// Measures the next candidate once more.
    fn measure(&mut self, progress: &Progress) -> Result<Turn, MeasureError> {
        let (scene, render, pool) = (self.scene, &self.render, &self.pool);
        let kept = self.candidates.iter().filter_map(|c| c.tree.as_ref());
        let kept: usize = kept.map(Tree::bytes).sum();
        let candidate = &mut self.candidates[self.next];
        if candidate.tree.is_none() {
            let part = progress.part(0.0, 0.4);
            let (tree, time) = Times::of(pool, || build(scene, &candidate.setup.build, &part));
            let tree = tree?;
            if candidate.known.is_none() {
                let known = Measurement::of_tree(scene, &tree, time, render);
                let bytes = known.tree.bytes;
                if self.search.most_bytes.is_some_and(|most| bytes > most) {
                    let setup = candidate.setup.clone();
                    self.left_out.push(LeftOut::Memory { setup, bytes });
                    return Ok(Turn::LeftOut);
                }
                let is_same = |row: &Row| {
                    row.setup.build.method == candidate.setup.build.method
                        && row.measurement.tree == known.tree
                };
                if self.rows.iter().any(is_same) {
                    let setup = candidate.setup.clone();
                    self.left_out.push(LeftOut::SameTree { setup });
                    return Ok(Turn::LeftOut);
                }
                candidate.known = Some(known);
            }
            candidate.tree = Some(tree);
        }
        let (Some(tree), Some(known)) = (&candidate.tree, &mut candidate.known) else {
            unreachable!("both were made above");
        };
        // Most candidates are dropped after their first time. Counting takes longer than that.
        let is_counted = self.rung > 0 || is_default(&candidate.setup.build);
        if is_counted && known.counted.is_none() {
            let part = progress.part(0.4, 0.8);
            let counted = render_counted(scene, tree, render, pool, &part, |_| ())?;
            if let Some(place) = candidate.row {
                self.rows[place].measurement.counted = Some(counted);
            }
            known.counted = Some(counted);
        }
        let warming = match self.rung {
            0 => RenderSettings {
                width: (render.width / SMALLER).max(1),
                height: (render.height / SMALLER).max(1),
                ..*render
            },
            _ => *render,
        };
        let untimed = progress.part(0.8, 0.9);
        render_timed(scene, tree, &warming, 0, pool, &untimed, |_, _| ())?;
        let timed = progress.part(0.9, 1.0);
        let time = render_timed(scene, tree, render, 0, pool, &timed, |_, _| ())?;
        let place = match candidate.row {
            Some(place) => {
                self.rows[place].add(self.rung, time);
                place
            }
            None => {
                let row = Row::new(candidate.setup.clone(), known.clone(), time);
                self.rows.push(row);
                self.rows.len() - 1
            }
        };
        candidate.row = Some(place);
        if kept > MOST_KEPT {
            candidate.tree = None;
        }
        Ok(Turn::Timed(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_small_picture_has_the_shape_of_the_large_one() {
        let of = |width, height| {
            let render = RenderSettings {
                width,
                height,
                samples: 8,
                ..RenderSettings::default()
            };
            let small = small(&render);
            assert_eq!(small.samples, 1);
            [small.width, small.height]
        };
        assert_eq!(of(512, 512), [128, 128]);
        assert_eq!(of(1920, 1080), [128, 72]);
        assert_eq!(of(1000, 1), [128, 1]);
        assert_eq!(of(64, 48), [64, 48]);
    }
}
