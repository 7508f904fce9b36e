//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! Two readers use third-party parsers: `gltf-json` for the JSON of glTF and `ply-rs-bw` for the
//! values of PLY. OBJ and STL have their own parsers here because the existing crates fail on some
//! files. `tobj` 4.0.5 panics on a material with `Kd 1 2`, reports no line numbers and silently
//! ignores unknown statements. `stl_io` 0.11 reads binary files that begin with `solid` as text and
//! stops after the first solid. (Likewise, `gltf` 1.4.1 panics if a mesh refers to a missing
//! accessor.)
//!
//! Memory use is bounded by the actual size of a file, not by the counts that it declares. A file
//! can have at most [`MAX_BYTES`] bytes and [`MAX_FACES`] objects.

mod builder;
mod choose;
mod complete;
mod entry;
mod error;
mod file;
mod gltf;
mod input;
mod lines;
pub mod nff;
mod obj;
mod place;
mod ply;
mod registry;
mod stl;

pub use builder::{MAX_FACES, MAX_SPLIT_VERTICES, MAX_VERTICES};
pub use entry::{Format, WriteScene};
pub use error::ReadError;
pub use file::{FormatError, read_file};
pub use input::{Input, MAX_BYTES, SiblingError};
pub use place::Place;
pub use registry::{FORMATS, for_path, names};
