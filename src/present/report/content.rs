//! What a report says, in whatever form.

use crate::geometry::Aabb;
use crate::measure::Measurement;
use crate::scene::{Camera, Note, Requirements, Scene, SceneRequest};

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
