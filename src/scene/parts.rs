//! The parts that a scene is made of.

use super::camera::Camera;
use super::material::{Light, Material};
use super::note::Note;
use crate::geometry::Vec3;
use crate::primitive::Primitive;

/// The parts that a reader or a generator produces; [`Scene::new`](super::Scene::new) turns them
/// into a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneParts {
    /// Short name for titles and reports, such as `balls:4` or the stem of a file name.
    pub name: String,
    /// The objects; an object's number is its index in this list.
    pub objects: Vec<Primitive>,
    /// For each object, the index of its material in `materials`.
    pub material_of: Vec<u32>,
    pub materials: Vec<Material>,
    pub lights: Vec<Light>,
    /// Linear color of rays that hit nothing.
    pub background: Vec3,
    pub camera: Camera,
    /// The load report: what was read, skipped, changed and defaulted, and the author's remarks.
    pub notes: Vec<Note>,
}
