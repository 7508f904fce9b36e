//! Answers of other programs about rays, checked by exact arithmetic.
//!
//! # Files
//!
//! Rays and answers are text or numbers in binary form, by the extension of the file.
//!
//! | file | rays | answers |
//! |---|---|---|
//! | `.csv`, with these titles in the first line, in any order | `ox`, `oy`, `oz`, `dx`, `dy`, `dz`, and optionally `t_min` (0) and `t_max` (no end) | `object` and `t`, or `blocked` (0 or 1) |
//! | `.f32` and `.f64`: little-endian numbers without a header | eight per ray, in the same order | two per ray: object and `t` |
//!
//! Points of a ray are origin + `t` · direction. Objects are counted from 0; −1 is a miss, whose `t` is ignored
//! and can be empty.

mod check;
mod files;

pub use check::{AnswerCheck, AnswerClass, AnswerFault, check_answers};
pub use files::{AnswerFileError, read_answers, read_rays};
