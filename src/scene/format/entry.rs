//! What a file format declares.

use super::error::ReadError;
use super::input::Input;
use crate::progress::Progress;
use crate::scene::parts::SceneParts;

/// Writes a scene to a stream.
pub type WriteScene = fn(&SceneParts, &mut dyn std::io::Write) -> std::io::Result<()>;

/// A file format: its reader and, optionally, its writer.
pub struct Format {
    /// Lower-case name, such as `nff`.
    pub name: &'static str,
    /// A short description.
    pub about: &'static str,
    /// File name extensions, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// Returns whether the bytes are clearly a file of this format.
    pub recognizes: fn(&[u8]) -> bool,
    /// Reads a whole file.
    pub read: fn(&Input<'_>, &Progress) -> Result<SceneParts, ReadError>,
    /// Writes a scene so that reading it back gives an identical scene; `None` for formats that
    /// cannot represent every scene.
    pub write: Option<WriteScene>,
}
