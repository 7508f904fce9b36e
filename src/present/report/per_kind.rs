//! The figures of each kind of ray: tables for people, values for programs.

use super::content::Report;
use super::exact::exact;
use super::grid::Grid;
use super::sections::value_titles;
use crate::measure::{Change, Comparison, RayFigure, ray_figures};
use crate::present::number::{NO_VALUE, OTHER_UNIT};
use crate::trace::RayKind;
use serde_json::{Map, Value, json};

/// Returns the kinds that occur in any run; none if the report has no such tables.
fn kinds(report: &Report) -> impl Iterator<Item = RayKind> {
    let has_rays = |kind: &RayKind| {
        let mut tallies = report.runs.iter().filter_map(|run| run.tally(*kind));
        tallies.any(|tally| tally.rays > 0)
    };
    RayKind::ALL
        .into_iter()
        .filter(move |kind| report.per_kind && has_rays(kind))
}

/// Returns the values of a figure in all runs. If there are exactly two runs, also compares the second with
/// the first.
fn values(
    report: &Report,
    figure: &RayFigure,
    kind: RayKind,
) -> (Vec<Option<f64>>, Option<Comparison>) {
    let values: Vec<_> = report.runs.iter().map(|run| figure.of(run, kind)).collect();
    let comparison = match &report.runs[..] {
        [first, second] => Some(figure.compare(first, second, kind)),
        _ => None,
    };
    (values, comparison)
}

/// Returns one table per kind of ray.
pub fn grids(report: &Report) -> Vec<Grid> {
    kinds(report)
        .map(|kind| Grid {
            title: format!("{} rays", capitalised(kind.name())),
            header: [String::new()]
                .into_iter()
                .chain(value_titles(report))
                .collect(),
            rows: ray_figures()
                .iter()
                .map(|figure| row(report, figure, kind))
                .collect(),
            first_number: 1,
        })
        .collect()
}

fn row(report: &Report, figure: &RayFigure, kind: RayKind) -> Vec<String> {
    let (values, comparison) = values(report, figure, kind);
    let none = || NO_VALUE.to_owned();
    let values = values.into_iter();
    [figure.name.to_owned()]
        .into_iter()
        .chain(values.map(|value| value.map_or_else(none, |value| figure.unit.number(value))))
        .chain(comparison.map(|comparison| comparison.to_string()))
        .collect()
}

fn capitalised(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

/// Returns, by kind and figure, the values of all runs and the second relative to the first. `None`
/// if the report does not include them.
pub fn json(report: &Report) -> Option<Value> {
    let of_kind = |kind| -> Map<String, Value> {
        let figures = ray_figures().iter().map(|figure| {
            let (values, comparison) = values(report, figure, kind);
            let values: Vec<_> = values.into_iter().map(|v| exact(v, figure.unit)).collect();
            let mut value = json!({"values": values});
            add_comparison(&mut value, comparison);
            (figure.key.to_owned(), value)
        });
        figures.collect()
    };
    let kinds = kinds(report).map(|kind| (kind.name().to_owned(), Value::Object(of_kind(kind))));
    report.per_kind.then(|| Value::Object(kinds.collect()))
}

/// Adds the second value relative to the first, or null and the reason.
pub fn add_comparison(value: &mut Value, comparison: Option<Comparison>) {
    let change = comparison.and_then(Comparison::change);
    value["second_to_first"] = json!(change.map(Change::value));
    if comparison == Some(Comparison::OtherUnit) {
        value["reason"] = json!(OTHER_UNIT);
    }
}

/// One value of one figure.
pub struct Line {
    pub kind: RayKind,
    pub figure: &'static RayFigure,
    /// Index of the run; `None` for the second relative to the first.
    pub run: Option<usize>,
    pub value: Value,
}

/// Returns one line per value.
pub fn lines(report: &Report) -> Vec<Line> {
    let mut lines = Vec::new();
    for kind in kinds(report) {
        for figure in ray_figures() {
            let (values, comparison) = values(report, figure, kind);
            let line = |run, value| Line {
                kind,
                figure,
                run,
                value,
            };
            let of_runs = values.iter().enumerate();
            lines.extend(of_runs.map(|(run, v)| line(Some(run), exact(*v, figure.unit))));
            if let Some(comparison) = comparison {
                lines.push(line(None, json!(comparison.change().map(Change::value))));
            }
        }
    }
    lines
}
