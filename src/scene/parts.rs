//! The parts that a scene is made of.

use super::camera::Camera;
use super::material::{Light, Material};
use super::note::Note;
use crate::geometry::Vec3;
use crate::primitive::Primitive;

/// What a reader or a generator gathers; [`Scene::new`](super::Scene::new) makes a scene of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneParts {
    /// Short name for titles and reports, such as `balls:4` or a file's name.
    pub name: String,
    /// The objects; an object's number is its place here.
    pub objects: Vec<Primitive>,
    /// For every object its material's place in `materials`.
    pub material_of: Vec<u32>,
    pub materials: Vec<Material>,
    pub lights: Vec<Light>,
    /// Linear colour of rays that hit nothing.
    pub background: Vec3,
    pub camera: Camera,
    /// The load report: what was read, skipped, changed and made up, and the author's remarks.
    pub notes: Vec<Note>,
}
