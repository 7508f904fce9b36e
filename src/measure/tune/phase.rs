//! The two parts of a search.

/// A part of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// All methods with automatic depth.
    Methods,
    /// Depth and leaf size of the best two methods.
    Refinement,
}
