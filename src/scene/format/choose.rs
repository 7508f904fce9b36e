//! Which format a file is of.

use super::entry::Format;
use super::registry::{FORMATS, for_path};
use std::path::Path;

/// The format of a file, with what there is to say of the choice; `None` if neither extension nor
/// content tells.
///
/// Where the content is clearly of another format than the extension, the content counts.
pub(super) fn format_of(path: &Path, bytes: &[u8]) -> Option<(&'static Format, String)> {
    let by_name = for_path(path);
    let by_content = FORMATS.iter().find(|format| (format.recognizes)(bytes));
    match (by_name, by_content) {
        (Some(named), None) => Some((named, String::new())),
        (Some(named), Some(_)) if (named.recognizes)(bytes) => Some((named, String::new())),
        (Some(named), Some(found)) => Some((
            found,
            format!(
                ", by its content; the extension is that of {}",
                named.name.to_uppercase()
            ),
        )),
        (None, Some(found)) => Some((found, ", by its content".into())),
        (None, None) => None,
    }
}
