//! What is selected: one thing for all panels and panes.

/// The selected node of the tree and the selected object; they are independent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Index of a node of the shown tree.
    pub node: Option<u32>,
    /// Number of an object of the shown scene.
    pub object: Option<u32>,
}
