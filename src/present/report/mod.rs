//! Reports of measurements. A writer is one file here and one line in [`WRITERS`].

pub mod accuracy;
mod csv;
pub mod grid;
mod json;
mod latex;
mod machine;
mod markdown;
mod page;
pub mod paper;
mod per_kind;
pub mod pixel;
mod sections;
mod text;
mod words;

pub use machine::{Machine, now};
pub use page::{Figure, Page};
pub use text::{plain_table, write_summary};

use crate::geometry::Aabb;
use crate::measure::{Measurement, Parameter, Unit};
use crate::scene::{Camera, Note, Requirements, Scene, SceneRequest};
use serde_json::Value;
use std::io::Write;

/// A form that a report can be written in.
pub struct Writer<R: ?Sized = Report> {
    /// Name on the command line.
    pub name: &'static str,
    /// One phrase: what it is good for.
    pub about: &'static str,
    /// File name extension, lower case, without the dot.
    pub extension: &'static str,
    /// Writes the whole report.
    pub write: fn(&R, &mut dyn Write) -> std::io::Result<()>,
}

/// All writers; the first is the default.
pub static WRITERS: &[Writer] = &[
    text::WRITER,
    json::WRITER,
    csv::WRITER,
    markdown::WRITER,
    latex::WRITER,
];

/// What was measured of one scene, with one or more methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub scene: SceneSummary,
    /// One for every method, in the order in which they were asked for.
    pub runs: Vec<Measurement>,
    /// Whether what rays did is told kind by kind, too.
    pub per_kind: bool,
}

/// What a report says of the scene itself.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSummary {
    pub name: String,
    /// The file or the generator, and how cylinders were taken.
    pub request: SceneRequest,
    /// The tight box around all objects; empty without objects.
    pub bounds: Aabb,
    pub objects: usize,
    pub lights: usize,
    pub requirements: Requirements,
    /// The load report: what the reader had to say about the file.
    pub notes: Vec<Note>,
    /// The scene's own camera.
    pub camera: Camera,
}

impl Report {
    pub fn new(scene: &Scene, request: &SceneRequest, runs: Vec<Measurement>) -> Self {
        Report {
            scene: SceneSummary {
                name: scene.name().to_owned(),
                request: request.clone(),
                bounds: scene.bounds(),
                objects: scene.objects().len(),
                lights: scene.lights().len(),
                requirements: scene.requirements().clone(),
                notes: scene.notes().to_vec(),
                camera: *scene.camera(),
            },
            runs,
            per_kind: false,
        }
    }
}

/// A parameter's value for machines, as [`exact`].
fn exact_value(parameter: &Parameter, measurement: &Measurement) -> Value {
    exact((parameter.value)(measurement), parameter.unit)
}

/// A value for machines: whole numbers for what is counted, fractions for shares; null where there is
/// no value.
fn exact(value: Option<f64>, unit: Unit) -> Value {
    match (value, unit) {
        (None, _) => Value::Null,
        (Some(value), Unit::Count | Unit::Bytes) => Value::from(value as u64),
        (Some(value), Unit::Ratio | Unit::Percent | Unit::Volume | Unit::Seconds) => {
            Value::from(value)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_extensions_of_writers_are_unique() {
        assert!(!WRITERS.is_empty());
        for (i, writer) in WRITERS.iter().enumerate() {
            assert!(
                WRITERS[..i]
                    .iter()
                    .all(|w| w.name != writer.name && w.extension != writer.extension)
            );
        }
    }
}
