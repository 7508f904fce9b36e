//! Successive halving: how often candidates are timed, and which of them stay.
//!
//! All candidates are timed once. The better half stays and is timed as often again, and so on, so that every
//! rung takes about as long as the one before it, and most of the time is spent on the candidates among which the
//! choice is difficult. A candidate of the worse half stays, too, if it cannot be told apart from the best.
//!
//! K. Jamieson and A. Talwalkar, Non-stochastic best arm identification and hyperparameter optimization, 2016.

use super::goal::Goal;
use super::ranking::{MOST_SLOWDOWN, Score, best};

/// Most rungs.
pub const RUNGS: usize = 7;

/// This many candidates are few enough.
pub(super) const FEW: usize = 2;

/// Even a few candidates are timed this often, so that the spread of their times is known.
const FEWEST_ROUNDS: usize = 8;

/// Returns how often a candidate has been timed after a rung, counted from 0.
pub fn rounds_after(rung: usize) -> usize {
    1 << rung
}

/// Returns how often a candidate is timed in a rung.
pub(super) fn rounds_in(rung: usize) -> usize {
    rounds_after(rung) - rung.checked_sub(1).map_or(0, rounds_after)
}

/// Returns whether a search ends after a rung, with so many candidates left.
pub(super) fn is_last(rung: usize, left: usize) -> bool {
    rung + 1 == RUNGS || (left <= FEW && rounds_after(rung) >= FEWEST_ROUNDS)
}

/// Returns how many candidates stay if all can be told apart from the best.
pub(super) fn half(standing: usize) -> usize {
    standing.min(standing.div_ceil(2).max(FEW))
}

/// Returns which of the standing candidates stay, the best first: the better half, and those of the others that
/// cannot be told apart from the best. `scores` are those of all candidates that were timed; `standing` are indices
/// into them.
///
/// For time, a candidate cannot be told apart if its least time is at most the median of the best. (The greatest time
/// of the best would be no limit: any other program on the machine prolongs one of the times, and the more there
/// are, the more likely.) For memory, it cannot be told apart if it is as small as the best, and its least time makes it
/// possible that it is fast enough to be recommended.
pub(super) fn survivors(scores: &[Score], standing: &[usize], goal: Goal) -> Vec<usize> {
    let mut order: Vec<usize> = (best(scores, goal).into_iter())
        .filter(|place| standing.contains(place))
        .collect();
    let median = |place: usize| scores[place].seconds.median;
    let mut others: Vec<usize> = (standing.iter().copied())
        .filter(|place| !order.contains(place))
        .collect();
    others.sort_by(|&a, &b| median(a).total_cmp(&median(b)));
    order.extend(others);
    let Some(&first) = order.first() else {
        return order;
    };
    let fastest = (0..scores.len()).map(median).fold(f64::INFINITY, f64::min);
    let is_open = |place: usize| {
        let least = scores[place].seconds.least;
        match goal {
            Goal::Time => least <= median(first),
            Goal::Memory => {
                scores[place].bytes <= scores[first].bytes && least <= MOST_SLOWDOWN * fastest
            }
        }
    };
    let (better, worse) = order.split_at(half(order.len()));
    let open = worse.iter().copied().filter(|place| is_open(*place));
    better.iter().copied().chain(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::random::Random;
    use crate::measure::tune::Spread;

    fn score(seconds: Vec<f64>, bytes: u64, rung: usize) -> Score {
        let seconds = Spread::of(seconds);
        Score {
            seconds,
            bytes,
            rung,
        }
    }

    fn once(seconds: f64) -> Score {
        score(vec![seconds], 1, 0)
    }

    /// Runs a whole search on injected times. Returns the candidates of the last rung, the best first, and how often
    /// each one was timed.
    fn search(count: usize, mut time: impl FnMut(usize) -> f64) -> (Vec<usize>, Vec<usize>) {
        let mut seconds = vec![Vec::new(); count];
        let mut rungs = vec![0; count];
        let mut standing: Vec<usize> = (0..count).collect();
        for rung in 0.. {
            for _ in 0..rounds_in(rung) {
                for &place in &standing {
                    seconds[place].push(time(place));
                    rungs[place] = rung;
                }
            }
            let all = seconds.iter().zip(&rungs);
            let scores: Vec<_> = all.map(|(s, rung)| score(s.clone(), 1, *rung)).collect();
            let before = standing.len();
            standing = survivors(&scores, &standing, Goal::Time);
            assert!(standing.len() >= half(before));
            if is_last(rung, standing.len()) {
                break;
            }
        }
        (standing, seconds.iter().map(Vec::len).collect())
    }

    #[test]
    fn every_rung_doubles_how_often_a_candidate_is_timed() {
        let rounds: Vec<_> = (0..RUNGS).map(rounds_in).collect();
        assert_eq!(rounds, [1, 1, 2, 4, 8, 16, 32]);
        let mut all = 0;
        for (rung, rounds) in rounds.into_iter().enumerate() {
            all += rounds;
            assert_eq!(rounds_after(rung), all);
        }
        assert!(is_last(RUNGS - 1, 100));
        assert!(is_last(3, 2) && !is_last(2, 2) && !is_last(3, 3));
        assert_eq!([0, 1, 2, 3, 4, 5, 230].map(half), [0, 1, 2, 2, 2, 3, 115]);
    }

    #[test]
    fn exact_times_leave_the_best_two_after_halving() {
        let (left, rounds) = search(200, |place| ((place * 77) % 200 + 1) as f64);
        assert_eq!((left.len(), left[0]), (2, 0));
        let of = |n| rounds.iter().filter(|rounds| **rounds == n).count();
        assert_eq!([1, 2, 4, 8, 16, 32, 64].map(of), [100, 50, 25, 12, 6, 3, 4]);
        let (left, rounds) = search(3, |place| (place + 1) as f64);
        assert_eq!(left, [0, 1]);
        assert_eq!(rounds, [8, 8, 1]);
        assert_eq!(search(1, |_| 1.0), (vec![0], vec![8]));
        assert_eq!(search(0, |_| 1.0), (vec![], vec![]));
    }

    #[test]
    fn noise_does_not_lose_the_best() {
        for seed in 0..20 {
            let mut random = Random::new(seed);
            // Candidates that are up to 5 times as slow as the first, all with times up to 30 % too long.
            let (left, rounds) = search(200, |place| {
                (1.0 + place as f64 / 50.0) * (1.0 + 0.3 * random.number().abs())
            });
            assert!(left[0] <= 2, "seed {seed}: {left:?}");
            assert!(rounds[0] >= 32, "seed {seed}: {rounds:?}");
        }
    }

    #[test]
    fn who_was_as_fast_as_the_best_stays() {
        let mut scores: Vec<_> = (1..=6).map(|i| once(f64::from(i))).collect();
        let standing: Vec<usize> = (0..6).collect();
        assert_eq!(survivors(&scores, &standing, Goal::Time), [0, 1, 2]);
        scores[5] = score(vec![1.0, 9.0, 9.0], 1, 0);
        assert_eq!(survivors(&scores, &standing, Goal::Time), [0, 1, 2, 5]);
        scores[5] = score(vec![1.1, 9.0, 9.0], 1, 0);
        assert_eq!(survivors(&scores, &standing, Goal::Time), [0, 1, 2]);
        // Only those that stand.
        assert_eq!(survivors(&scores, &[4, 3], Goal::Time), [3, 4]);
        assert_eq!(survivors(&scores, &[], Goal::Time), [0; 0]);
    }

    #[test]
    fn for_memory_the_smallest_that_are_fast_enough_stay() {
        let scores = [
            score(vec![1.0], 90, 0),
            score(vec![1.9], 40, 0),
            score(vec![1.2], 60, 0),
            score(vec![9.0], 10, 0),
            score(vec![1.5], 50, 0),
            score(vec![1.9, 2.2, 2.3], 30, 0),
        ];
        let standing: Vec<usize> = (0..6).collect();
        // The last one may still turn out to be fast enough.
        assert_eq!(survivors(&scores, &standing, Goal::Memory), [1, 4, 2, 5]);
        // The fastest decides even after it was dropped.
        assert_eq!(survivors(&scores, &[1, 4, 3], Goal::Memory), [1, 4]);
    }
}
