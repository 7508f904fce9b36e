//! How well one column of numbers predicts another.

use crate::measure::random::Random;

/// A figure with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// A straight line y = `slope` · x + `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub slope: f64,
    pub offset: f64,
}

impl Line {
    /// Returns the line of least squares; `None` if all x are equal or there are none.
    pub fn through(x: &[f64], y: &[f64]) -> Option<Line> {
        let [mean_x, mean_y] = [x, y].map(mean);
        let (square, product) = (
            centered(x, mean_x, x, mean_x),
            centered(x, mean_x, y, mean_y),
        );
        (square > 0.0).then(|| {
            let slope = product / square;
            let offset = mean_y - slope * mean_x;
            Line { slope, offset }
        })
    }

    pub fn at(self, x: f64) -> f64 {
        self.slope * x + self.offset
    }
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

fn centered(x: &[f64], mean_x: f64, y: &[f64], mean_y: f64) -> f64 {
    let products = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y));
    products.sum()
}

/// Returns the coefficient of correlation, −1 to 1; `None` if one of the columns is constant or empty.
pub fn correlation(x: &[f64], y: &[f64]) -> Option<f64> {
    let [mean_x, mean_y] = [x, y].map(mean);
    let squares = centered(x, mean_x, x, mean_x) * centered(y, mean_y, y, mean_y);
    (squares > 0.0).then(|| (centered(x, mean_x, y, mean_y) / squares.sqrt()).clamp(-1.0, 1.0))
}

/// Returns R², the share of the variance of y that a straight line over x explains. `None` as [`correlation`].
pub fn r_squared(x: &[f64], y: &[f64]) -> Option<f64> {
    Some(correlation(x, y)?.powi(2))
}

/// Returns Spearman's rank correlation, −1 to 1: the correlation of the ranks. `None` as [`correlation`].
pub fn rank_correlation(x: &[f64], y: &[f64]) -> Option<f64> {
    correlation(&ranks(x), &ranks(y))
}

/// Returns the rank of every number, from 0. Equal ones have the mean of their ranks.
fn ranks(x: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
    let mut ranks = vec![0.0; x.len()];
    for group in order.chunk_by(|&a, &b| x[a] == x[b]) {
        let before = x.iter().filter(|other| **other < x[group[0]]).count();
        for &place in group {
            ranks[place] = before as f64 + (group.len() - 1) as f64 / 2.0;
        }
    }
    ranks
}

/// How often a bootstrap draws the pairs anew.
const DRAWS: usize = 500;

/// Estimates a statistic of pairs. The interval is that between the 2.5 % and the 97.5 % quantile over samples
/// of as many pairs, drawn with repetition by a generator that starts the same each time. `None` if the statistic
/// has no value.
pub fn estimate(
    x: &[f64],
    y: &[f64],
    statistic: impl Fn(&[f64], &[f64]) -> Option<f64>,
) -> Option<Estimate> {
    let value = statistic(x, y)?;
    let mut random = Random::new(1);
    let mut draws: Vec<f64> = (0..DRAWS)
        .filter_map(|_| {
            let places: Vec<usize> = x.iter().map(|_| random.below(x.len())).collect();
            let [x, y] = [x, y].map(|all| places.iter().map(|&i| all[i]).collect::<Vec<_>>());
            statistic(&x, &y)
        })
        .collect();
    draws.sort_by(f64::total_cmp);
    Some(Estimate {
        value,
        low: quantile(&draws, 0.025)?,
        high: quantile(&draws, 0.975)?,
    })
}

/// Returns a quantile of sorted numbers, the nearest of them; `None` if there are none.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    Some(sorted[(share * last as f64).round() as usize])
}

/// Returns the median, for an even number the lower of the two in the middle; `None` if there are no numbers.
pub fn median(numbers: &[f64]) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len().checked_sub(1)? / 2;
    Some(sorted[middle])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_found_and_explains_all() {
        let x = [1.0, 2.0, 4.0, 7.0];
        let y = x.map(|x| 3.0 - 2.0 * x);
        let line = Line::through(&x, &y).unwrap();
        assert!((line.at(10.0) + 17.0).abs() < 1e-12, "{line:?}");
        assert!((r_squared(&x, &y).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(rank_correlation(&x, &y), Some(-1.0));
        assert_eq!(Line::through(&[1.0, 1.0], &[1.0, 2.0]), None);
        assert_eq!(correlation(&[], &[]), None);
    }

    #[test]
    fn ranks_of_equal_numbers_are_their_mean() {
        assert_eq!(ranks(&[5.0, 1.0, 5.0, 9.0]), [1.5, 0.0, 1.5, 3.0]);
        // The textbook formula 1 − 6 Σd² / (n³ − n), for numbers that differ.
        let (x, y) = ([1.0, 2.0, 3.0, 4.0, 5.0], [2.0, 1.0, 4.0, 3.0, 50.0]);
        let expected = 1.0 - 6.0 * 4.0 / 120.0;
        assert!((rank_correlation(&x, &y).unwrap() - expected).abs() < 1e-12);
    }

    #[test]
    fn intervals_hold_their_value_and_shrink_with_more_pairs() {
        let pairs = |n: usize| -> (Vec<f64>, Vec<f64>) {
            let mut random = Random::new(7);
            let pair = |i| (f64::from(i), f64::from(i) + 8.0 * random.number());
            (0..n as u32).map(pair).unzip()
        };
        let width = |n| {
            let (x, y) = pairs(n);
            let found = estimate(&x, &y, |x, y| Some(Line::through(x, y)?.slope)).unwrap();
            assert!(
                found.low <= found.value && found.value <= found.high,
                "{found:?}"
            );
            found.high - found.low
        };
        assert!(width(100) < 0.5 * width(20));
    }

    #[test]
    fn the_median_is_the_lower_of_two() {
        assert_eq!(median(&[4.0, 1.0, 3.0, 2.0]), Some(2.0));
        assert_eq!(median(&[]), None);
        assert_eq!(quantile(&[1.0, 2.0, 3.0], 1.0), Some(3.0));
    }
}
