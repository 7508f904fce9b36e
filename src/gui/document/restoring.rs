//! A selection to come back to.

use crate::structure::Moment;
use crate::workspace::Selected;
use std::collections::BTreeMap;

/// A selection to come back to once its picture is there.
pub struct Restoring {
    pub selected: Selected,
    /// The moment of the build that is shown.
    pub build: Option<Moment>,
    pub ranges: BTreeMap<String, [f64; 2]>,
    /// Whether the pixel was asked for.
    pub asked: bool,
}
