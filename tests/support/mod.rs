//! What several test binaries share.
#![allow(dead_code)] // Each binary uses its part of this.

pub mod closed_meshes;
pub mod glb;
pub mod program;
pub mod random;
pub mod scenes;
pub mod tough;
pub mod wording;
