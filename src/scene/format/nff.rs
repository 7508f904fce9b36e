//! Neutral File Format (E. Haines, Standard Procedural Databases).

use super::{Format, ReadError};
use crate::progress::Progress;
use crate::scene::SceneParts;
use std::io::Write;

pub(super) const FORMAT: Format = Format {
    name: "nff",
    extensions: &["nff"],
    read,
    write,
};

/// Reads a whole NFF file.
///
/// # Errors
/// The first mistake, with its line.
pub fn read(_bytes: &[u8], _progress: &Progress) -> Result<SceneParts, ReadError> {
    todo!()
}

/// Writes NFF.
///
/// # Errors
/// Those of `out`.
pub fn write(_parts: &SceneParts, _out: &mut dyn Write) -> std::io::Result<()> {
    todo!()
}
