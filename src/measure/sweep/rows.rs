//! Rows of a sweep as text: CSV or JSON Lines, one line per point, in the order of points.

use super::origin::{self, Origin};
use crate::measure::{Unit, parameters};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The settings that identify a point, independent of its number. Times depend on the machine; keys
/// do not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// The names of the settings that the sweep varies, separated by spaces.
    pub axes: String,
    /// The file or the generator, and how cylinders are represented.
    pub scene: String,
    pub method: String,
    /// The requested depth: a number or `auto`.
    pub d_max: String,
    pub n_oilf: u32,
    /// The structure's other settings, each as `name=value`, separated by spaces.
    pub settings: String,
    /// The settings of picture and camera, in the same form.
    pub picture: String,
}

/// A measured point.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its number in the whole sweep, from 0.
    pub point: usize,
    /// Number of points in the whole sweep.
    pub points: usize,
    pub key: Key,
    pub origin: Origin,
    /// The values of all [`parameters`], in their order. Shares are fractions; times are in
    /// seconds.
    pub values: Vec<Option<f64>>,
    /// Why the point could not be measured; it then has no values. Files have only the row without values.
    pub failure: Option<String>,
}

/// The text format of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Csv,
    JsonLines,
}

/// Why a text cannot be read as rows of a sweep.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RowError {
    #[error("line 1: not the titles of a sweep by this version of the program")]
    Titles,
    #[error("line {line}: not a row of a sweep: {why}")]
    Line { line: usize, why: String },
    #[error(
        "row {row} belongs to another sweep ({why}); rows of different settings are not mixed: choose \
         another file, or the same sweep"
    )]
    Foreign { row: usize, why: String },
}

impl RowError {
    /// Creates the error for a row (from 1) whose key has these differences from the expected one.
    pub(super) fn foreign(row: usize, differences: &[String]) -> RowError {
        let why = match differences {
            [] => "another grid or order of points".to_owned(),
            some => some.join("; "),
        };
        RowError::Foreign { row, why }
    }
}

const TITLES: [&str; 9] = [
    "point", "points", "axes", "scene", "method", "d_max", "n_oilf", "settings", "picture",
];

impl Form {
    /// Returns the format of a file by its extension: `.csv`, or JSON Lines for `.jsonl` and
    /// `.ndjson`.
    pub fn for_path(path: &Path) -> Option<Form> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            "csv" => Some(Form::Csv),
            "jsonl" | "ndjson" => Some(Form::JsonLines),
            _ => None,
        }
    }
}

fn titles() -> impl Iterator<Item = &'static str> {
    let symbols = parameters().iter().map(|p| p.symbol);
    let titles = TITLES.into_iter().chain(origin::TITLES);
    titles.chain(symbols)
}

/// Returns the title line with its line break; empty for JSON Lines.
pub fn header(form: Form) -> String {
    match form {
        Form::Csv => csv_line(titles().map(String::from)),
        Form::JsonLines => String::new(),
    }
}

/// Returns a row as a line with its line break.
pub fn line(row: &Row, form: Form) -> String {
    let cells = cells(row);
    match form {
        Form::Csv => csv_line(cells.map(|value| match value {
            Value::Null => String::new(),
            Value::String(text) => text,
            number => number.to_string(),
        })),
        Form::JsonLines => {
            let object: Map<_, _> = titles().map(String::from).zip(cells).collect();
            format!("{}\n", Value::Object(object))
        }
    }
}

fn cells(row: &Row) -> impl Iterator<Item = Value> {
    let key = &row.key;
    let first = [
        json!(row.point),
        json!(row.points),
        json!(key.axes),
        json!(key.scene),
        json!(key.method),
        json!(key.d_max),
        json!(key.n_oilf),
        json!(key.settings),
        json!(key.picture),
    ];
    let values = parameters()
        .iter()
        .zip(&row.values)
        .map(|(p, value)| match (*value, p.unit) {
            (None, _) => Value::Null,
            (Some(value), Unit::Count) => json!(value as u64),
            (Some(value), Unit::Bytes) if value.fract() == 0.0 => json!(value as u64),
            (Some(value), _) => json!(value),
        });
    let origin = row.origin.cells().map(|cell| json!(cell));
    first.into_iter().chain(origin).chain(values)
}

fn csv_line(cells: impl Iterator<Item = String>) -> String {
    let mut writer = csv::WriterBuilder::new()
        .terminator(csv::Terminator::Any(b'\n'))
        .from_writer(Vec::new());
    let cells: Vec<String> = cells.collect();
    writer
        .write_record(&cells)
        .expect("writing to memory does not fail");
    let bytes = writer
        .into_inner()
        .expect("writing to memory does not fail");
    String::from_utf8(bytes).expect("what was written is UTF-8")
}

/// Reads the rows of a file, and returns the length in bytes of the complete lines. A last line
/// without a line break is ignored, because its writer was interrupted. Text without a complete
/// line has no rows.
///
/// # Errors
/// The first line that is not a row of a sweep.
pub fn read_rows(text: &str, form: Form) -> Result<(Vec<Row>, usize), RowError> {
    let complete = text.rfind('\n').map_or(0, |end| end + 1);
    let text = &text[..complete];
    let rows = match form {
        Form::Csv => read_csv(text),
        Form::JsonLines => read_json_lines(text),
    }?;
    Ok((rows, complete))
}

fn read_csv(text: &str) -> Result<Vec<Row>, RowError> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for (i, record) in reader.records().enumerate() {
        let wrong = |why: String| RowError::Line { line: i + 1, why };
        let record = record.map_err(|error| wrong(error.to_string()))?;
        if i == 0 {
            if !record.iter().eq(titles()) {
                return Err(RowError::Titles);
            }
            continue;
        }
        let cell = |place: usize| record.get(place).map(str::to_owned);
        let number = |place: usize| match record.get(place) {
            Some("") => Some(None),
            Some(text) => text.parse().ok().map(Some),
            None => None,
        };
        rows.push(row(cell, number).ok_or_else(|| wrong("a cell is missing or wrong".into()))?);
    }
    Ok(rows)
}

fn read_json_lines(text: &str) -> Result<Vec<Row>, RowError> {
    let titles: Vec<&str> = titles().collect();
    let mut rows = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let wrong = |why: String| RowError::Line { line: i + 1, why };
        let object: Map<String, Value> =
            serde_json::from_str(line).map_err(|error| wrong(error.to_string()))?;
        let cell = |place: usize| match object.get(titles[place])? {
            Value::String(text) => Some(text.clone()),
            other => Some(other.to_string()),
        };
        let number = |place: usize| match object.get(titles[place])? {
            Value::Null => Some(None),
            value => value.as_f64().map(Some),
        };
        rows.push(row(cell, number).ok_or_else(|| wrong("a cell is missing or wrong".into()))?);
    }
    Ok(rows)
}

/// Builds a row from cells by index; `None` if one is missing or invalid.
fn row(
    cell: impl Fn(usize) -> Option<String>,
    number: impl Fn(usize) -> Option<Option<f64>>,
) -> Option<Row> {
    Some(Row {
        point: cell(0)?.parse().ok()?,
        points: cell(1)?.parse().ok()?,
        key: Key {
            axes: cell(2)?,
            scene: cell(3)?,
            method: cell(4)?,
            d_max: cell(5)?,
            n_oilf: cell(6)?.parse().ok()?,
            settings: cell(7)?,
            picture: cell(8)?,
        },
        origin: Origin {
            processor: cell(9)?,
            instruction_set: cell(10)?,
            kernel: cell(11)?,
            version: cell(12)?,
        },
        values: (0..parameters().len())
            .map(|place| number(TITLES.len() + origin::TITLES.len() + place))
            .collect::<Option<_>>()?,
        failure: None,
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Returns a row of three, with a count and a time.
    pub(in crate::measure::sweep) fn row(point: usize, first: f64) -> Row {
        let mut values = vec![None; parameters().len()];
        values[0] = Some(first);
        let time = parameters().iter().position(|p| p.unit == Unit::Seconds);
        values[time.unwrap()] = Some(0.1 + 0.2);
        Row {
            point,
            points: 3,
            key: Key {
                axes: "method d-max".into(),
                scene: "a, \"b\"".into(),
                method: "midpoint".into(),
                d_max: "auto".into(),
                n_oilf: 2,
                settings: "overlap=paper".into(),
                picture: "resolution=8x8".into(),
            },
            origin: Origin {
                processor: "a, \"b\"".into(),
                instruction_set: "AVX2".into(),
                kernel: "stream".into(),
                version: "1.0.0".into(),
            },
            values,
            failure: None,
        }
    }

    #[test]
    fn rows_come_back_from_both_forms_and_torn_lines_are_left_out() {
        let rows = [row(0, 1.0), row(1, 2.0)];
        for form in [Form::Csv, Form::JsonLines] {
            let mut text = header(form);
            for row in &rows {
                text += &line(row, form);
            }
            let whole = text.len();
            assert_eq!(read_rows(&text, form), Ok((rows.to_vec(), whole)));
            text += &line(&rows[0], form)[..20];
            assert_eq!(read_rows(&text, form), Ok((rows.to_vec(), whole)));
            assert_eq!(read_rows(&text[..5], form), Ok((vec![], 0)));
        }
        assert_eq!(read_rows("a,b\n", Form::Csv), Err(RowError::Titles));
        let no_row = read_rows("{}\n", Form::JsonLines);
        assert!(matches!(no_row, Err(RowError::Line { line: 1, .. })));
    }
}
