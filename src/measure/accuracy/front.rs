//! The Pareto front: the points that no other point beats in both time and error.

/// Returns, for each point of time and error, whether it is on the Pareto front. Smaller is better.
///
/// A point is on the front if no other point is at least as good in both values and better in one.
/// Equal points are on the front together. A point with a NaN is never on it.
pub fn pareto_front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
    points
        .iter()
        .map(|p| p.iter().all(|v| !v.is_nan()) && !points.iter().any(|other| beats(other, p)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [
            [1.0, 0.0],
            [0.5, 0.1],
            [0.6, 0.1],
            [0.5, 0.2],
            [0.1, 0.9],
            [0.1, 0.9],
            [2.0, 0.0],
            [0.05, f64::NAN],
        ];
        let expected = [true, true, false, false, true, true, false, false];
        assert_eq!(pareto_front(&points), expected);
        assert!(pareto_front(&[]).is_empty());
    }
}
