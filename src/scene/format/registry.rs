//! All formats, and the format for a path.

use super::entry::Format;
use super::{gltf, nff, obj, ply, stl};
use std::path::Path;

/// All formats.
pub static FORMATS: &[Format] = &[
    nff::FORMAT,
    obj::FORMAT,
    ply::FORMAT,
    gltf::FORMAT,
    stl::FORMAT,
];

/// Returns the names of all formats in capitals, separated by commas.
pub fn names() -> String {
    let names: Vec<_> = FORMATS.iter().map(|f| f.name.to_uppercase()).collect();
    names.join(", ")
}

/// Returns the format for the extension of a path.
pub fn for_path(path: &Path) -> Option<&'static Format> {
    let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
    let has_it = |f: &&Format| f.extensions.contains(&extension.as_str());
    FORMATS.iter().find(has_it)
}
