//! The complete scene.

use super::camera::Camera;
use super::material::{Light, Material};
use super::note::Note;
use super::parts::SceneParts;
use super::prepared::Prepared;
use super::requirements::Requirements;
use crate::geometry::{Aabb, Vec3};
use crate::primitive::{Precision, Primitive, Shape, Shapes};

/// A complete, immutable scene. Derived facts are computed once, when it is created.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    parts: SceneParts,
    bounds: Aabb,
    requirements: Requirements,
    published_margin: Option<f64>,
    prepared: Prepared,
}

impl Scene {
    /// Creates a scene from its parts.
    ///
    /// # Panics
    /// If `material_of` does not refer to an existing material for every object.
    pub fn new(parts: SceneParts) -> Self {
        assert_eq!(parts.objects.len(), parts.material_of.len());
        assert!(
            parts
                .material_of
                .iter()
                .all(|&m| (m as usize) < parts.materials.len())
        );
        let bounds = parts
            .objects
            .iter()
            .fold(Aabb::EMPTY, |b, object| b.union(&object.bounds()));
        let requirements = Requirements::of(&parts);
        let published_margin = parts.notes.iter().find_map(Note::root_margin);
        Scene {
            parts,
            bounds,
            requirements,
            published_margin,
            prepared: Prepared::default(),
        }
    }

    pub fn name(&self) -> &str {
        &self.parts.name
    }

    /// Returns the objects; an object's number is its index.
    pub fn objects(&self) -> &[Primitive] {
        &self.parts.objects
    }

    /// Returns the material of an object.
    pub fn material(&self, object: u32) -> &Material {
        &self.parts.materials[self.parts.material_of[object as usize] as usize]
    }

    pub fn lights(&self) -> &[Light] {
        &self.parts.lights
    }

    pub fn background(&self) -> Vec3 {
        self.parts.background
    }

    pub fn camera(&self) -> &Camera {
        &self.parts.camera
    }

    /// Returns the tight bounding box of all objects; empty if there are none.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Returns how far the root cell extends beyond the bounds in the scene's publication, in the
    /// scene's units of length ([`Note::of_root_margin`]); `None` without such a note.
    pub fn published_margin(&self) -> Option<f64> {
        self.published_margin
    }

    /// Returns which features rendering this scene requires.
    pub fn requirements(&self) -> &Requirements {
        &self.requirements
    }

    /// Returns the objects prepared for intersection in a precision. They are prepared on first use
    /// and then cached.
    pub fn shapes(&self, precision: Precision) -> &Shapes {
        self.prepared
            .get(precision, &self.parts.objects, &self.bounds)
    }

    /// Returns the load report.
    pub fn notes(&self) -> &[Note] {
        &self.parts.notes
    }

    /// Returns the parts that the scene was created from.
    pub fn parts(&self) -> &SceneParts {
        &self.parts
    }
}
