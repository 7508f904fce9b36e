//! The content of a report, independent of its format.

use crate::geometry::Aabb;
use crate::measure::Measurement;
use crate::scene::{Camera, Note, Requirements, Scene, SceneRequest};
use serde::Serialize;
use std::fmt;

/// The measurements of one scene with one or more methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub scene: SceneSummary,
    /// One per method, in the order of the request.
    pub runs: Vec<Measurement>,
    /// The methods that could not be measured.
    pub failures: Vec<Failure>,
    /// Whether there are tables for each kind of ray.
    pub per_kind: bool,
}

/// A method that could not be measured, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failure {
    pub method: &'static str,
    pub reason: String,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: not measured: {}", self.method, self.reason)
    }
}

/// The scene of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSummary {
    pub name: String,
    /// The file or the generator, and how cylinders are represented.
    pub request: SceneRequest,
    /// The tight box around all objects; empty without objects.
    pub bounds: Aabb,
    pub objects: usize,
    pub lights: usize,
    pub requirements: Requirements,
    /// Notes of the file reader.
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
            failures: Vec::new(),
            per_kind: false,
        }
    }
}
