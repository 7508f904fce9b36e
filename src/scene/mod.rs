//! A scene: objects, materials, lights, a background and a camera, and what it requires.

pub mod builtin;
mod camera;
mod camera_override;
pub mod format;
mod material;
mod note;
mod prepared;
mod requirements;
mod source;
mod tessellate;

pub use camera::{Camera, CameraError, Sampling, View};
pub use camera_override::CameraOverride;
pub use material::{Light, Material};
pub use note::{Note, NoteKind};
pub use requirements::Requirements;
pub use source::{LoadError, SceneRequest, SceneSource, load};
pub use tessellate::Cylinders;

use crate::geometry::{Aabb, Vec3};
use crate::primitive::{Precision, Primitive, Shape, Shapes};
use prepared::Prepared;

/// What a reader or a generator gathers; [`Scene::new`] makes a scene of it.
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

/// A scene, complete and immutable: derived facts are worked out once, here.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    parts: SceneParts,
    bounds: Aabb,
    requirements: Requirements,
    prepared: Prepared,
}

impl Scene {
    /// # Panics
    /// If `material_of` does not name one existing material for every object.
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
        Scene {
            parts,
            bounds,
            requirements,
            prepared: Prepared::default(),
        }
    }

    pub fn name(&self) -> &str {
        &self.parts.name
    }

    /// The objects; an object's number is its place.
    pub fn objects(&self) -> &[Primitive] {
        &self.parts.objects
    }

    /// The material of an object.
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

    /// The tight box around all objects; empty without objects.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What rendering this scene takes, and what it does not.
    pub fn requirements(&self) -> &Requirements {
        &self.requirements
    }

    /// The objects made ready for tracing in a precision: when first asked for, then kept.
    pub fn shapes(&self, precision: Precision) -> &Shapes {
        self.prepared
            .get(precision, &self.parts.objects, &self.bounds)
    }

    /// The load report: what the reader had to say about the file.
    pub fn notes(&self) -> &[Note] {
        &self.parts.notes
    }

    /// Everything the scene was made of.
    pub fn parts(&self) -> &SceneParts {
        &self.parts
    }
}
