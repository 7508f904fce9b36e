//! The subject of a step of a lesson: a scene, one or two trees, and a picture.

use super::figures::Side;
use crate::setup::Setup;

/// What is built, rendered and shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    pub a: Setup,
    /// The second setup, if two are compared.
    pub b: Option<Setup>,
    /// The pixel whose rays are followed: column and row.
    pub pixel: Option<[u32; 2]>,
    pub look: Look,
}

/// What the window shows. Names are those in the window.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// Symbol of the heatmap to show with the answer.
    pub heatmap: Option<&'static str>,
    /// The tree in front: the 3D view, the heatmap and the panes are about it.
    pub front: Side,
    /// How two pictures are shown.
    pub view: Option<Named>,
    /// Panes to bring to the front.
    pub panes: Vec<Named>,
    /// Panels to unfold; all others are folded.
    pub panels: Vec<Named>,
}

/// A name with its line in the file, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    pub line: usize,
    pub name: String,
}
