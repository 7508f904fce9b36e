//! The order of candidates, and which of them tie.
//!
//! Candidates are sorted by the median of the figure of the goal; among equal ones by the other
//! figure, then by the order in which they were given. For time, candidates of a later rung come before those that
//! were dropped earlier: the latter were timed less often, so one lucky time must not put them in front. The first one
//! begins a group. Every next one of the same rung joins the group if its range overlaps the range of the *first* of
//! the group, ends included; if not, it begins the next group. All of a group share the rank of the first: one more
//! than the number of candidates before it. Comparing with the first only, rather than with any of the group, keeps
//! chains of overlaps from tying the fastest with the slowest.
//!
//! Memory is exact, whatever the rung: candidates tie for memory only if they need the same number of bytes.

use super::goal::Goal;

/// Least, median and greatest of several times, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    pub least: f64,
    pub median: f64,
    pub most: f64,
}

/// The figures by which a candidate is judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Of rendering, or of building once and tracing some rays.
    pub seconds: Spread,
    /// Memory of the tree.
    pub bytes: u64,
    /// The last rung in which it was timed.
    pub rung: usize,
}

/// The rank of one of several candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rank {
    /// Index of the candidate in the list that was ranked.
    pub place: usize,
    /// From 1.
    pub rank: usize,
    /// Whether it shares the rank with another candidate.
    pub is_tied: bool,
}

/// A tree that saves memory is recommended only if it renders in at most this many times the time of
/// the fastest candidate. Otherwise the answer would always be not to build a tree.
pub const MOST_SLOWDOWN: f64 = 2.0;

impl Spread {
    /// Returns the spread of some times in any order, at least one. For an even number, the median is the lower of
    /// the two in the middle.
    pub(super) fn of(mut seconds: Vec<f64>) -> Spread {
        seconds.sort_by(f64::total_cmp);
        let last = seconds.len() - 1;
        Spread {
            least: seconds[0],
            median: seconds[last / 2],
            most: seconds[last],
        }
    }
}

impl Goal {
    /// Returns the figure of this goal.
    fn spread(self, score: &Score) -> Spread {
        let bytes = score.bytes as f64;
        match self {
            Goal::Time => score.seconds,
            Goal::Memory => Spread {
                least: bytes,
                median: bytes,
                most: bytes,
            },
        }
    }

    /// Returns the rung that counts before the figure; always 0 for memory.
    const fn rung(self, score: &Score) -> usize {
        match self {
            Goal::Time => score.rung,
            Goal::Memory => 0,
        }
    }

    const fn other(self) -> Goal {
        match self {
            Goal::Time => Goal::Memory,
            Goal::Memory => Goal::Time,
        }
    }
}

/// Ranks candidates, the best first.
pub fn rank(scores: &[Score], goal: Goal) -> Vec<Rank> {
    let key = |place: usize, goal: Goal| goal.spread(&scores[place]).median;
    let mut places: Vec<usize> = (0..scores.len()).collect();
    places.sort_by(|&a, &b| {
        let by = |goal| key(a, goal).total_cmp(&key(b, goal));
        let rung = |place: usize| goal.rung(&scores[place]);
        let by_rung = rung(b).cmp(&rung(a));
        by_rung.then(by(goal)).then(by(goal.other()))
    });
    let mut ranks: Vec<Rank> = Vec::with_capacity(places.len());
    let mut group = 0;
    for (i, &place) in places.iter().enumerate() {
        let (score, first) = (&scores[place], &scores[places[group]]);
        // Within a rung, its median is not below that of the first, so only one end can lie apart.
        let is_apart = goal.spread(score).least > goal.spread(first).most;
        if is_apart || goal.rung(score) < goal.rung(first) {
            group = i;
        }
        let is_tied = group < i;
        ranks[group..]
            .iter_mut()
            .for_each(|rank| rank.is_tied |= is_tied);
        ranks.push(Rank {
            place,
            rank: group + 1,
            is_tied,
        });
    }
    ranks
}

/// Returns the indices of the candidates that may be recommended, the best first. For time these are
/// all; for memory, those that are at most [`MOST_SLOWDOWN`] times as slow as the fastest.
pub fn best(scores: &[Score], goal: Goal) -> Vec<usize> {
    let medians = scores.iter().map(|score| score.seconds.median);
    let fastest = medians.fold(f64::INFINITY, f64::min);
    let is_eligible = |score: &Score| match goal {
        Goal::Time => true,
        Goal::Memory => score.seconds.median <= MOST_SLOWDOWN * fastest,
    };
    let places = rank(scores, goal).into_iter().map(|rank| rank.place);
    places
        .filter(|&place| is_eligible(&scores[place]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn score(least: f64, median: f64, most: f64, bytes: u64) -> Score {
        let seconds = Spread {
            least,
            median,
            most,
        };
        Score {
            seconds,
            bytes,
            rung: 0,
        }
    }

    fn ranks(scores: &[Score], goal: Goal) -> Vec<(usize, usize, bool)> {
        let ranks = rank(scores, goal).into_iter();
        ranks.map(|r| (r.place, r.rank, r.is_tied)).collect()
    }

    #[test]
    fn ranges_that_overlap_tie_and_others_do_not() {
        let scores = [
            score(5.0, 5.5, 6.0, 1),
            score(1.0, 2.0, 3.0, 1),
            score(2.5, 2.8, 4.0, 1),
            score(4.5, 4.6, 4.7, 1),
        ];
        assert_eq!(
            ranks(&scores, Goal::Time),
            [(1, 1, true), (2, 1, true), (3, 3, false), (0, 4, false)]
        );
        // Ranges that touch overlap.
        let touching = [score(3.0, 3.5, 4.0, 1), score(1.0, 2.0, 3.0, 1)];
        assert_eq!(ranks(&touching, Goal::Time), [(1, 1, true), (0, 1, true)]);
        assert_eq!(ranks(&[], Goal::Time), []);
        assert_eq!(ranks(&scores[..1], Goal::Time), [(0, 1, false)]);
    }

    #[test]
    fn a_chain_of_overlaps_does_not_tie_its_ends() {
        let scores = [
            score(1.0, 1.5, 2.0, 1),
            score(1.9, 2.5, 3.0, 1),
            score(2.9, 3.5, 4.0, 1),
            score(3.9, 4.5, 5.0, 1),
        ];
        assert_eq!(
            ranks(&scores, Goal::Time),
            [(0, 1, true), (1, 1, true), (2, 3, true), (3, 3, true)]
        );
    }

    #[test]
    fn a_wide_range_behind_a_group_does_not_rejoin_it() {
        let scores = [
            score(1.0, 1.5, 2.0, 1),
            score(2.1, 2.2, 2.3, 1),
            score(1.2, 2.4, 9.0, 1),
        ];
        assert_eq!(
            ranks(&scores, Goal::Time),
            [(0, 1, false), (1, 2, true), (2, 2, true)]
        );
    }

    #[test]
    fn who_was_dropped_ranks_behind_who_stayed() {
        let mut scores = [
            score(1.0, 1.0, 1.0, 9),
            score(2.0, 2.5, 3.0, 5),
            score(2.0, 2.6, 3.0, 5),
        ];
        scores[1].rung = 2;
        scores[2].rung = 2;
        assert_eq!(
            ranks(&scores, Goal::Time),
            [(1, 1, true), (2, 1, true), (0, 3, false)]
        );
        assert_eq!(best(&scores, Goal::Time), [1, 2, 0]);
        // Memory is the same however often the time is measured.
        scores[0].bytes = 1;
        assert_eq!(best(&scores, Goal::Memory), [0]);
    }

    #[test]
    fn equal_medians_are_ordered_by_memory_and_then_as_given() {
        let scores = [
            score(1.0, 1.0, 1.0, 9),
            score(1.0, 1.0, 1.0, 5),
            score(1.0, 1.0, 1.0, 9),
        ];
        assert_eq!(
            ranks(&scores, Goal::Time),
            [(1, 1, true), (0, 1, true), (2, 1, true)]
        );
    }

    #[test]
    fn memory_ties_only_if_it_is_equal() {
        let scores = [
            score(1.0, 2.0, 9.0, 30),
            score(1.0, 3.0, 9.0, 20),
            score(1.0, 1.0, 9.0, 20),
            score(1.0, 1.0, 9.0, 21),
        ];
        assert_eq!(
            ranks(&scores, Goal::Memory),
            [(2, 1, true), (1, 1, true), (3, 3, false), (0, 4, false)]
        );
    }

    #[test]
    fn a_slow_tree_is_not_recommended_for_its_memory() {
        let scores = [
            score(1.0, 1.0, 1.0, 90),
            score(2.0, 2.0, 2.0, 40),
            score(2.1, 2.1, 2.1, 10),
        ];
        assert_eq!(best(&scores, Goal::Memory), [1, 0]);
        assert_eq!(best(&scores, Goal::Time), [0, 1, 2]);
        assert_eq!(best(&[], Goal::Memory), [0; 0]);
    }
}
