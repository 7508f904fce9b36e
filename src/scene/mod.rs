//! Scenes: objects, materials, lights, background and camera, and which features rendering them
//! requires.

pub mod builtin;
mod camera;
mod camera_override;
pub mod format;
mod material;
mod model;
mod note;
mod parts;
mod prepared;
mod requirements;
mod source;
mod tessellate;

pub use camera::{Camera, CameraError, Sampling, View};
pub use camera_override::CameraOverride;
pub use material::{Light, Material};
pub use model::Scene;
pub use note::{Note, NoteKind};
pub use parts::SceneParts;
pub use requirements::Requirements;
pub use source::{LoadError, SceneRequest, SceneSource, load};
pub use tessellate::Cylinders;
