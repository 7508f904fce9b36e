//! What a step of a lesson looks at: a scene, one or two trees of it, and a picture.

use crate::setup::Setup;

/// What is built, rendered and shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    pub a: Setup,
    /// The second setup, where two are compared.
    pub b: Option<Setup>,
    /// The pixel whose rays are followed: column and row.
    pub pixel: Option<[u32; 2]>,
    pub look: Look,
}

/// What is brought into view. Names are those that the window shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// Symbol of the heatmap that comes with the answer.
    pub heatmap: Option<&'static str>,
    /// How two pictures share the pane.
    pub view: Option<Named>,
    /// Panes that come to the front of their tabs.
    pub panes: Vec<Named>,
    /// Panels that are unfolded; all others are folded.
    pub panels: Vec<Named>,
}

/// A name with the line of the file where it stands, from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    pub line: usize,
    pub name: String,
}
