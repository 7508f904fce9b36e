//! The figures of each kind of ray: tables for people, values for programs.

use super::content::Report;
use super::exact::exact;
use super::grid::Grid;
use super::sections::value_titles;
use crate::measure::{Change, RayFigure, change, ray_figures};
use crate::present::number::NO_VALUE;
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

/// Returns the values of a figure in all runs. If there are exactly two runs, also returns the
/// second relative to the first.
fn values(
    report: &Report,
    figure: &RayFigure,
    kind: RayKind,
) -> (Vec<Option<f64>>, Option<Change>) {
    let values: Vec<_> = report.runs.iter().map(|run| figure.of(run, kind)).collect();
    let change = match values[..] {
        [first, second] => change(figure.unit, first, second),
        _ => None,
    };
    (values, change)
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
    let (values, change) = values(report, figure, kind);
    let none = || NO_VALUE.to_owned();
    let two = values.len() == 2;
    let values = values.into_iter();
    [figure.name.to_owned()]
        .into_iter()
        .chain(values.map(|value| value.map_or_else(none, |value| figure.unit.number(value))))
        .chain(two.then(|| change.map_or_else(none, |change| change.to_string())))
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
            let (values, change) = values(report, figure, kind);
            let values: Vec<_> = values.into_iter().map(|v| exact(v, figure.unit)).collect();
            let value = json!({"values": values, "second_to_first": change.map(Change::value)});
            (figure.key.to_owned(), value)
        });
        figures.collect()
    };
    let kinds = kinds(report).map(|kind| (kind.name().to_owned(), Value::Object(of_kind(kind))));
    report.per_kind.then(|| Value::Object(kinds.collect()))
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
            let (values, change) = values(report, figure, kind);
            let line = |run, value| Line {
                kind,
                figure,
                run,
                value,
            };
            let of_runs = values.iter().enumerate();
            lines.extend(of_runs.map(|(run, v)| line(Some(run), exact(*v, figure.unit))));
            if values.len() == 2 {
                lines.push(line(None, json!(change.map(Change::value))));
            }
        }
    }
    lines
}
