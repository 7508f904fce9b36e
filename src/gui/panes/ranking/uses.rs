//! What can be done with a candidate.

use crate::gui::edits::{Edits, Request};
use crate::measure::tune::Row;
use crate::setup::measure_command;

/// Builds the tree on view with the settings of a candidate.
pub fn use_this(row: &Row, edits: &mut Edits) {
    let setup = row.setup.clone();
    edits.add(move |doc| doc.use_tree_of(setup));
}

/// Copies the command that measures a candidate.
pub fn copy(row: &Row, edits: &mut Edits) {
    edits.request(Request::Copy(measure_command(&row.setup)));
}
