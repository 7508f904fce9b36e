//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! # What is read, reported and refused
//!
//! - **What is unambiguous is read,** even if a specification forbids it: text in tokens instead of
//!   lines, byte-order marks, whole numbers written as decimals, `-1.#IND` for what is not a
//!   number.
//! - **What was changed or ignored is reported,** with its count and its first place: the load
//!   report consists of the scene's [`Note`](crate::scene::Note)s.
//! - **Only what would give wrong geometry is refused,** with file, line and reason: a coordinate
//!   that is not a finite number, the index of a vertex that does not exist, missing data,
//!   compressed meshes. A bad normal, texture coordinate, color, material, light or camera never
//!   refuses the geometry. Normals are replaced by the face normal, materials and the rest by
//!   defaults.
//! - **Another format or encoding is named:** UTF-16, glTF 1.0, the NFF of Sense8, AFF.
//!
//! `docs/formats.md` lists the details per format.
//!
//! # Parsers
//!
//! All parsers are our own, except for the JSON of glTF (`serde_json`), because the existing crates
//! fail on files that people have:
//!
//! - `tobj` 4.0.5 panics on a material with `Kd 1 2`, reports no line numbers and silently ignores
//!   unknown statements.
//! - `stl_io` 0.11 reads binary files that begin with `solid` as text and stops after the first
//!   solid.
//! - `ply-rs-bw` 4.0.1 reads text in lines instead of tokens and refuses byte-order marks, blank
//!   header lines and whole numbers written as decimals.
//! - `gltf-json` 1.4.1 refuses a file for a single bad material and for whole numbers written as
//!   `3.0`; `gltf` panics if a mesh refers to a missing accessor.
//!
//! # Memory
//!
//! Memory use is bounded by the actual size of a file, not by the counts that it declares. A file
//! can have at most [`MAX_BYTES`] bytes and [`MAX_FACES`] objects of at most [`BYTES_PER_TRIANGLE`]
//! bytes per triangle; polygons take memory in proportion to their vertices. A mesh that a glTF
//! file places many times takes memory for each of its triangles, as if it were written out.

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

pub use builder::{BYTES_PER_TRIANGLE, MAX_FACES, MAX_SPLIT_VERTICES, MAX_VERTICES};
pub use entry::{Format, WriteScene};
pub use error::ReadError;
pub use file::{FormatError, read_file};
pub use input::{Input, MAX_BYTES, SiblingError};
pub use place::Place;
pub use registry::{FORMATS, for_path, names};
