//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! Third-party readers are used where they hold: `gltf-json` for glTF's JSON and `ply-rs-bw` for
//! PLY's values. OBJ and STL are read here, since the readers there are cannot be trusted with any
//! file: `tobj` 4.0.5 panics at a material's `Kd 1 2`, names no lines and passes over what it does
//! not know; `stl_io` 0.11 takes binary files that begin with `solid` for text and stops after the
//! first solid. (Likewise `gltf` 1.4.1 panics where a mesh names an accessor that is not there.)
//!
//! Whatever a file claims, memory grows with the bytes that are there: files have at most
//! [`MOST_BYTES`] and come to at most [`MOST_FACES`] objects.

mod choose;
mod complete;
mod entry;
mod error;
mod file;
mod gather;
mod gltf;
mod input;
mod lines;
pub mod nff;
mod obj;
mod place;
mod ply;
mod registry;
mod stl;

pub use entry::{Format, WriteScene};
pub use error::ReadError;
pub use file::{FormatError, read_file};
pub use gather::{MOST_FACES, MOST_VERTICES, MOST_VERTICES_SPLIT};
pub use input::{BesideError, Input, MOST_BYTES};
pub use place::Place;
pub use registry::{FORMATS, for_path, names};
