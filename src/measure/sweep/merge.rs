//! Parts of a sweep become one.

use super::Row;
use crate::measure::{Class, parameters};

/// Why rows cannot be merged into one sweep.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MergeError {
    #[error("there are no rows")]
    Empty,
    #[error("point {point} is of another sweep than the first row ({why})")]
    Foreign { point: usize, why: String },
    #[error("point {0} is there twice with different counts")]
    Unequal(usize),
}

/// Merges the rows of a sweep's parts in the order of points. Also returns the points that are
/// missing. If a point occurs twice, the first row is kept, with its times; the counts of both must
/// be equal.
///
/// # Errors
/// There are no rows, rows belong to different sweeps, or a point has different counts.
pub fn merge(mut rows: Vec<Row>) -> Result<(Vec<Row>, Vec<usize>), MergeError> {
    let first = rows.first().ok_or(MergeError::Empty)?;
    let points = first.points;
    for row in &rows {
        let mut differ = first.key.differences(&row.key);
        if row.points != points || row.point >= points {
            differ.push(format!("{points} points vs {}", row.points));
        }
        if !differ.is_empty() {
            return Err(MergeError::Foreign {
                point: row.point,
                why: differ.join("; "),
            });
        }
    }
    rows.sort_by_key(|row| row.point);
    for pair in rows.windows(2) {
        if pair[0].point == pair[1].point && !same_but_times(&pair[0], &pair[1]) {
            return Err(MergeError::Unequal(pair[0].point));
        }
    }
    rows.dedup_by_key(|row| row.point);
    let is_missing = |point: &usize| rows.binary_search_by_key(point, |row| row.point).is_err();
    let missing = (0..points).filter(is_missing).collect();
    Ok((rows, missing))
}

/// Returns whether two rows have the same key and agree in all values except times.
fn same_but_times(a: &Row, b: &Row) -> bool {
    a.key == b.key
        && parameters()
            .iter()
            .zip(a.values.iter().zip(&b.values))
            .filter(|(p, _)| p.class != Class::T)
            .all(|(_, (a, b))| a == b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::sweep::rows::tests::row;

    #[test]
    fn parts_become_one_sweep_or_it_is_said_why_not() {
        let [a, b, c] = [row(0, 1.0), row(1, 2.0), row(2, 3.0)];
        let merged = merge(vec![c.clone(), a.clone(), c.clone()]).unwrap();
        assert_eq!(merged, (vec![a.clone(), c], vec![1]));
        assert_eq!(merge(vec![]), Err(MergeError::Empty));
        let other = row(1, 5.0);
        assert_eq!(merge(vec![b.clone(), other]), Err(MergeError::Unequal(1)));
        let mut foreign = b;
        foreign.key.picture = "resolution=9x9".into();
        let why = "resolution: 8x8 vs 9x9".to_owned();
        let expected = MergeError::Foreign { point: 1, why };
        assert_eq!(merge(vec![a, foreign]), Err(expected));
    }
}
