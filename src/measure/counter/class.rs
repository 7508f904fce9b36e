//! The paper's classes of parameters, and units.

use serde::Serialize;

/// Where the paper lists a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Table {
    /// Table 1: scene and image.
    Scene,
    /// Table 2: static properties of the tree.
    Static,
    /// Table 3: dynamic properties of the tree.
    Dynamic,
    /// Not in the tables: an input of Λ, or an addition of this program.
    Ours,
}

/// The paper's classes of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Class {
    /// Specified before rendering.
    S,
    /// Determined by the specified ones and by ray tracing itself.
    D,
    /// Results from building the tree.
    C,
    /// Results from rendering.
    R,
    /// A time: depends on the implementation and the machine.
    T,
}

/// The unit of a value, which determines how it is formatted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// A count.
    Count,
    /// A mean or a ratio.
    Ratio,
    /// A share, shown in percent; the value is a fraction.
    Percent,
    /// Cubed scene units.
    Volume,
    Seconds,
    Bytes,
    /// Rays per second.
    Rate,
}
