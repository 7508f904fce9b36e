//! Least squares with nonnegative times. Every observation is weighted by its time, so that the fit
//! minimizes relative errors.

use super::equation::{Equation, Term};
use super::observe::{Observation, Terms};

/// A time found by regression.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficient {
    pub term: Term,
    /// Seconds per unit, at least 0.
    pub seconds: f64,
    /// Half the width of the 95 % confidence interval. `None` if the time is clamped to 0, or if no
    /// observations are left to estimate it.
    pub half_width: Option<f64>,
}

/// Times that explain a set of observations.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    pub equation: Equation,
    pub coefficients: Vec<Coefficient>,
    /// Share of the (weighted) variance of `T_TR` that the fit explains, at most 1.
    pub r_squared: f64,
    /// What the observations cannot separate, in sentences.
    pub notes: Vec<String>,
}

/// Why no fit is possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    #[error("{observations} trees are too few for {terms} times")]
    TooFew { observations: usize, terms: usize },
    #[error("the trees do not differ enough to tell anything from them")]
    Singular,
}

/// A term is inseparable if its counts are a linear combination of the other terms' counts, except
/// for this share.
const INSEPARABLE: f64 = 0.02;

impl Fit {
    /// Predicts `T_TR` in seconds for these counts.
    pub fn predict(&self, terms: &Terms) -> f64 {
        self.coefficients
            .iter()
            .map(|c| c.seconds * terms.count(c.term, self.equation))
            .sum()
    }

    /// Returns the relative error of every prediction: predicted / measured − 1.
    pub fn errors(&self, observations: &[&Observation]) -> Vec<f64> {
        observations
            .iter()
            .map(|o| self.predict(&o.terms) / o.seconds - 1.0)
            .collect()
    }

    /// Returns the time of a term in seconds; `None` if the term was dropped.
    pub fn seconds(&self, term: Term) -> Option<f64> {
        let found = self.coefficients.iter().find(|c| c.term == term);
        found.map(|c| c.seconds)
    }
}

/// Fits the times of these terms. A term that cannot be separated from the terms before it is
/// dropped, with a note. Its time becomes part of the others' times.
///
/// # Errors
/// There are not more observations than times, or the trees do not determine the times.
pub fn fit(
    observations: &[&Observation],
    terms: &[Term],
    equation: Equation,
) -> Result<Fit, FitError> {
    let column = |term: Term| -> Vec<f64> {
        observations
            .iter()
            .map(|o| o.terms.count(term, equation) / o.seconds)
            .collect()
    };
    let mut notes =
        vec!["T_T and T_P only occur as a sum: no set of trees tells them apart.".to_owned()];
    let mut kept: Vec<(Term, Vec<f64>)> = Vec::new();
    for &term in terms {
        let column = column(term);
        if length(&column) == 0.0 {
            continue;
        }
        let known: Vec<&[f64]> = kept.iter().map(|(_, column)| column.as_slice()).collect();
        let rest = apart(&column, &known);
        if rest < INSEPARABLE {
            notes.push(format!(
                "{} cannot be told from the times before it: but for {:.2} %, its counts are a \
                 combination of theirs; its time is part of those.",
                term.name(),
                rest * 100.0
            ));
        } else {
            kept.push((term, column));
        }
    }
    if observations.len() <= kept.len() {
        return Err(FitError::TooFew {
            observations: observations.len(),
            terms: kept.len(),
        });
    }
    // Each equation is divided by the measured time, so every target is 1.
    let target = vec![1.0; observations.len()];
    let columns: Vec<&[f64]> = kept.iter().map(|(_, column)| column.as_slice()).collect();
    let (active, solution) = not_negative(&columns, &target).ok_or(FitError::Singular)?;

    let mut times = vec![0.0; kept.len()];
    let mut half_widths = vec![None; kept.len()];
    let residual: f64 = residuals(&columns, &target, &active, &solution.x);
    let freedom = observations.len() - active.len();
    for (i, &place) in active.iter().enumerate() {
        times[place] = solution.x[i];
        half_widths[place] = (freedom > 0).then(|| {
            let variance = residual / freedom as f64 * solution.inverse_diagonal[i];
            student_95(freedom) * variance.sqrt()
        });
    }
    Ok(Fit {
        equation,
        coefficients: kept
            .iter()
            .zip(times.into_iter().zip(half_widths))
            .map(|((term, _), (seconds, half_width))| Coefficient {
                term: *term,
                seconds,
                half_width,
            })
            .collect(),
        r_squared: 1.0 - residual / variance(observations),
        notes,
    })
}

/// Returns the weighted sum of squares around the weighted mean time.
fn variance(observations: &[&Observation]) -> f64 {
    let weight = |o: &Observation| 1.0 / (o.seconds * o.seconds);
    let sum: f64 = observations.iter().map(|o| weight(o)).sum();
    let mean = observations
        .iter()
        .map(|o| weight(o) * o.seconds)
        .sum::<f64>()
        / sum;
    let squares = observations
        .iter()
        .map(|o| weight(o) * (o.seconds - mean).powi(2));
    squares.sum()
}

/// Returns the 97.5 % quantile of Student's t-distribution (Cornish–Fisher expansion, accurate to 1
/// % from 4 degrees of freedom on).
fn student_95(freedom: usize) -> f64 {
    let v = freedom as f64;
    1.959964 + 2.372271 / v + 2.822499 / v.powi(2) + 2.555852 / v.powi(3) + 1.589536 / v.powi(4)
}

struct Solution {
    x: Vec<f64>,
    /// Diagonal of the inverse of the normal matrix.
    inverse_diagonal: Vec<f64>,
}

/// Solves nonnegative least squares by trying every subset of columns. Returns the subset with the
/// smallest residual among those whose unconstrained solution is nonnegative; `None` if there is
/// none.
fn not_negative(columns: &[&[f64]], target: &[f64]) -> Option<(Vec<usize>, Solution)> {
    let mut best: Option<(f64, Vec<usize>, Solution)> = None;
    for subset in 1u32..1 << columns.len() {
        let active: Vec<usize> = (0..columns.len())
            .filter(|i| subset >> i & 1 == 1)
            .collect();
        let chosen: Vec<&[f64]> = active.iter().map(|&i| columns[i]).collect();
        let Some(solution) = least_squares(&chosen, target) else {
            continue;
        };
        if solution.x.iter().any(|&x| x < 0.0) {
            continue;
        }
        let residual = residuals(columns, target, &active, &solution.x);
        if best.as_ref().is_none_or(|(least, ..)| residual < *least) {
            best = Some((residual, active, solution));
        }
    }
    best.map(|(_, active, solution)| (active, solution))
}

/// Returns the sum of the squared residuals.
fn residuals(columns: &[&[f64]], target: &[f64], active: &[usize], x: &[f64]) -> f64 {
    let residual = |row: usize| {
        let fitted: f64 = active
            .iter()
            .zip(x)
            .map(|(&i, x)| columns[i][row] * x)
            .sum();
        target[row] - fitted
    };
    (0..target.len()).map(|row| residual(row).powi(2)).sum()
}

/// Returns the share of a column's length that is not a linear combination of other columns, 0 to
/// 1.
fn apart(column: &[f64], others: &[&[f64]]) -> f64 {
    let all: Vec<usize> = (0..others.len()).collect();
    match least_squares(others, column) {
        Some(solution) => residuals(others, column, &all, &solution.x).sqrt() / length(column),
        None => 0.0,
    }
}

fn length(column: &[f64]) -> f64 {
    dot(column, column).sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Solves the normal equations of normalized columns by Gauss–Jordan elimination. Returns `None` if
/// the columns are linearly dependent.
fn least_squares(columns: &[&[f64]], target: &[f64]) -> Option<Solution> {
    const DEPENDENT: f64 = 1e-12;
    let n = columns.len();
    let lengths: Vec<f64> = columns.iter().map(|column| length(column)).collect();
    let entry = |i: usize, k: usize| dot(columns[i], columns[k]) / (lengths[i] * lengths[k]);
    // The matrix, augmented with the identity matrix, which elimination turns into the inverse.
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let unit = (0..n).map(|k| f64::from(u8::from(i == k)));
            (0..n).map(|k| entry(i, k)).chain(unit).collect()
        })
        .collect();
    for i in 0..n {
        // The matrix is positive definite, so its pivots are on the diagonal.
        let pivot = rows[i][i];
        if pivot < DEPENDENT {
            return None;
        }
        rows[i].iter_mut().for_each(|value| *value /= pivot);
        let row = rows[i].clone();
        let others = rows.iter_mut().enumerate().filter(|(k, _)| *k != i);
        for (_, other) in others {
            let factor = other[i];
            other
                .iter_mut()
                .zip(&row)
                .for_each(|(value, of_row)| *value -= factor * of_row);
        }
    }
    let right: Vec<f64> = (0..n)
        .map(|i| dot(columns[i], target) / lengths[i])
        .collect();
    Some(Solution {
        x: (0..n)
            .map(|i| dot(&rows[i][n..], &right) / lengths[i])
            .collect(),
        inverse_diagonal: (0..n)
            .map(|i| rows[i][n + i] / (lengths[i] * lengths[i]))
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::PrimitiveKind::{Polygon, Sphere};
    use crate::structure::BuildSettings;

    /// Returns synthetic times: 10 ns per node, 20 and 50 ns per miss, 30 ns per hit of a sphere,
    /// and 2 ms constant.
    fn made_up(noise: f64) -> Vec<Observation> {
        (1..=12u64)
            .map(|i| {
                let mut terms = Terms {
                    nodes: 100_000 + 70_000 * (i * i % 7),
                    ..Terms::default()
                };
                terms.hits = [40_000 + 9_000 * (i * 5 % 11), 0, 30_000, 0];
                terms.tests = [0, 1, 2, 3].map(|k| terms.hits[k]);
                terms.tests[0] += 200_000 + 90_000 * (i % 5);
                terms.tests[2] += 10_000 + 20_000 * (i * 3 % 8);
                let count = |term| terms.count(term, Equation::Corrected);
                let exact = 2e-3
                    + 1e-8 * count(Term::Node)
                    + 2e-8 * count(Term::Miss(Sphere))
                    + 5e-8 * count(Term::Miss(Polygon))
                    + 3e-8 * count(Term::Hit(Sphere));
                let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
                Observation {
                    build: BuildSettings::default(),
                    terms,
                    seconds: exact * (1.0 + sign * noise),
                }
            })
            .collect()
    }

    const TERMS: [Term; 6] = [
        Term::Constant,
        Term::Node,
        Term::Miss(Sphere),
        Term::Miss(Polygon),
        Term::Hit(Sphere),
        Term::Hit(Polygon),
    ];

    #[test]
    fn times_that_observations_are_made_of_are_found() {
        let all = made_up(0.0);
        let all: Vec<_> = all.iter().collect();
        let fit = fit(&all, &TERMS, Equation::Corrected).unwrap();
        for (term, seconds) in TERMS.into_iter().zip([2e-3, 1e-8, 2e-8, 5e-8, 3e-8]) {
            let found = fit.seconds(term).unwrap();
            assert!((found / seconds - 1.0).abs() < 1e-6, "{term:?}: {found}");
        }
        assert!(fit.r_squared > 1.0 - 1e-9);
        assert!(fit.errors(&all).iter().all(|error| error.abs() < 1e-6));
        // The number of polygon hits is the same for every tree, as the constant is.
        assert_eq!(fit.seconds(Term::Hit(Polygon)), None);
        assert!(fit.notes.iter().any(|note| note.starts_with("T_I polygon")));
    }

    #[test]
    fn noise_widens_the_intervals_and_no_time_is_negative() {
        let all = made_up(0.03);
        let all: Vec<_> = all.iter().collect();
        let fit = fit(&all, &TERMS, Equation::Corrected).unwrap();
        let node = &fit.coefficients[1];
        let half = node.half_width.unwrap();
        assert!(half > 1e-10 && (node.seconds - 1e-8).abs() < half);
        assert!(fit.coefficients.iter().all(|c| c.seconds >= 0.0));
        assert!(fit.r_squared < 1.0);
        // A column that would need a negative time is clamped to zero.
        let (columns, target) = ([&[1.0, 1.0, 1.0][..], &[1.0, 2.0, 3.0]], [3.0, 2.0, 1.0]);
        let (active, solution) = not_negative(&columns, &target).unwrap();
        assert_eq!(active, [0]);
        assert!((solution.x[0] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn too_few_trees_are_refused() {
        let all = made_up(0.0);
        let few: Vec<_> = all.iter().take(2).collect();
        let error = fit(&few, &TERMS[..3], Equation::Corrected);
        assert!(error.is_err(), "{error:?}");
        assert!((student_95(10) - 2.228).abs() < 0.01);
    }
}
