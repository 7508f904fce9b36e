//! Reads rays and answers.

use crate::geometry::{Ray, Vec3};
use crate::measure::judge::Answer;
use crate::trace::Hit;
use std::io;
use std::path::{Path, PathBuf};

/// Maximum size of a file in bytes.
const MAX_BYTES: u64 = 4 << 30;

/// Why a file of rays or answers could not be read.
#[derive(Debug, thiserror::Error)]
pub enum AnswerFileError {
    #[error("{}: {reason}", .path.display())]
    Io { path: PathBuf, reason: io::Error },
    #[error("{}: expected the extension .csv, .f32 or .f64", .0.display())]
    Extension(PathBuf),
    #[error("{}: expected {columns} numbers per row, found {numbers} numbers", .path.display())]
    Size {
        path: PathBuf,
        columns: usize,
        numbers: usize,
    },
    #[error("{}: the last number is incomplete", .0.display())]
    Incomplete(PathBuf),
    #[error("{}: no column '{name}' in the first line", .path.display())]
    Title { path: PathBuf, name: &'static str },
    #[error("{}:{line}: expected {expected}, found '{found}'", .path.display())]
    Value {
        path: PathBuf,
        line: u64,
        expected: &'static str,
        found: String,
    },
    #[error("{}: {reason}", .path.display())]
    Csv { path: PathBuf, reason: csv::Error },
}

type Result<T> = std::result::Result<T, AnswerFileError>;

/// Reads rays.
///
/// # Errors
/// The file cannot be read or has another form.
pub fn read_rays(path: &Path) -> Result<Vec<Ray>> {
    let ray = |[ox, oy, oz, dx, dy, dz, t_min, t_max]: [f64; 8]| Ray {
        origin: Vec3::new(ox, oy, oz),
        direction: Vec3::new(dx, dy, dz),
        t_min,
        t_max,
    };
    let titles = ["ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max"];
    let defaults = [
        None,
        None,
        None,
        None,
        None,
        None,
        Some(0.0),
        Some(f64::INFINITY),
    ];
    let rows = match table(path)? {
        Table::Numbers(numbers) => rows(path, &numbers)?,
        Table::Text(text) => text.rows(path, titles, defaults)?,
    };
    Ok(rows.into_iter().map(ray).collect())
}

/// Reads answers.
///
/// # Errors
/// The file cannot be read or has another form.
pub fn read_answers(path: &Path) -> Result<Vec<Answer>> {
    let hit = |[object, t]: [f64; 2]| {
        // Numbers that are no object become one that no scene has.
        let is_miss = object == -1.0;
        let object = if object >= 0.0 && object.fract() == 0.0 {
            (object as u32).min(u32::MAX - 1)
        } else {
            u32::MAX - 1
        };
        Answer::Nearest(if is_miss {
            Hit::MISS
        } else {
            Hit { t, object }
        })
    };
    match table(path)? {
        Table::Numbers(numbers) => Ok(rows(path, &numbers)?.into_iter().map(hit).collect()),
        Table::Text(text) if text.has("blocked") => {
            let rows = text.rows(path, ["blocked"], [None])?;
            let blocked = rows.into_iter().map(|[n]| Answer::Blocked(n != 0.0));
            Ok(blocked.collect())
        }
        Table::Text(text) => {
            let rows = text.rows(path, ["object", "t"], [None, Some(f64::NAN)])?;
            Ok(rows.into_iter().map(hit).collect())
        }
    }
}

/// What a file has.
enum Table {
    Numbers(Vec<f64>),
    Text(Text),
}

fn table(path: &Path) -> Result<Table> {
    let failed = |reason| AnswerFileError::Io {
        path: path.to_owned(),
        reason,
    };
    let length = std::fs::metadata(path).map_err(failed)?.len();
    if length > MAX_BYTES {
        return Err(failed(io::Error::other("larger than 4 GiB")));
    }
    let bytes = std::fs::read(path).map_err(failed)?;
    let extension = path
        .extension()
        .map(|e| e.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some("f32") => numbers(path, &bytes, |n| f64::from(f32::from_le_bytes(n))),
        Some("f64") => numbers(path, &bytes, f64::from_le_bytes),
        Some("csv") => Ok(Table::Text(Text::new(path, bytes)?)),
        _ => Err(AnswerFileError::Extension(path.to_owned())),
    }
}

/// Returns numbers of `N` bytes.
fn numbers<const N: usize>(path: &Path, bytes: &[u8], number: fn([u8; N]) -> f64) -> Result<Table> {
    match bytes.as_chunks() {
        (all, []) => Ok(Table::Numbers(all.iter().map(|&n| number(n)).collect())),
        _ => Err(AnswerFileError::Incomplete(path.to_owned())),
    }
}

/// Divides numbers into rows.
fn rows<const N: usize>(path: &Path, numbers: &[f64]) -> Result<Vec<[f64; N]>> {
    match numbers.as_chunks() {
        (rows, []) => Ok(rows.to_vec()),
        _ => Err(AnswerFileError::Size {
            path: path.to_owned(),
            columns: N,
            numbers: numbers.len(),
        }),
    }
}

/// Lines of text after their titles.
struct Text {
    titles: csv::StringRecord,
    lines: csv::Reader<io::Cursor<Vec<u8>>>,
}

impl Text {
    fn new(path: &Path, bytes: Vec<u8>) -> Result<Text> {
        let mut lines = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .flexible(true)
            .from_reader(io::Cursor::new(bytes));
        let titles = lines.headers().cloned();
        let titles = titles.map_err(|reason| AnswerFileError::Csv {
            path: path.to_owned(),
            reason,
        })?;
        Ok(Text { titles, lines })
    }

    fn has(&self, name: &str) -> bool {
        self.titles.iter().any(|title| title == name)
    }

    /// Returns the numbers in columns with these titles, one with a default where it is missing or empty.
    fn rows<const N: usize>(
        mut self,
        path: &Path,
        titles: [&'static str; N],
        defaults: [Option<f64>; N],
    ) -> Result<Vec<[f64; N]>> {
        let mut places = [None; N];
        for (k, &name) in titles.iter().enumerate() {
            places[k] = self.titles.iter().position(|title| title == name);
            if places[k].is_none() && defaults[k].is_none() {
                let path = path.to_owned();
                return Err(AnswerFileError::Title { path, name });
            }
        }
        let (mut rows, mut line) = (Vec::new(), csv::StringRecord::new());
        loop {
            let more = self.lines.read_record(&mut line);
            let more = more.map_err(|reason| AnswerFileError::Csv {
                path: path.to_owned(),
                reason,
            })?;
            if !more {
                return Ok(rows);
            }
            let mut row = [0.0; N];
            for (k, number) in row.iter_mut().enumerate() {
                let text = places[k].and_then(|place| line.get(place)).unwrap_or("");
                let default = defaults[k].filter(|_| text.is_empty());
                let read = default.or_else(|| text.parse().ok());
                *number = read.ok_or_else(|| AnswerFileError::Value {
                    path: path.to_owned(),
                    line: line.position().map_or(0, csv::Position::line),
                    expected: "a number",
                    found: text.to_owned(),
                })?;
            }
            rows.push(row);
        }
    }
}
