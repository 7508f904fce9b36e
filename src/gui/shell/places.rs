//! Where panes can be: in tiles, or in a column of fixed size.

use crate::gui::pane::Entry;
use crate::gui::panes::PANES;
use egui_tiles::{SimplificationOptions, TileId, Tree};

/// The height of the top bar in points.
pub const TOP_BAR: f32 = 40.0;

/// The height of a pane's title row in points.
pub const TITLE_ROW: f32 = 36.0;

/// A pane by its place in the registry; in files by its id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PaneId(usize);

impl PaneId {
    pub fn entry(self) -> &'static Entry {
        &PANES[self.0]
    }

    /// Its place in the registry.
    pub fn place(self) -> usize {
        self.0
    }

    /// All panes.
    pub fn all() -> impl Iterator<Item = PaneId> {
        (0..PANES.len()).map(PaneId)
    }
}

/// Returns the pane that a name means: an id, or a title of this or an earlier version.
pub fn pane(name: &str) -> Option<PaneId> {
    PANES
        .iter()
        .position(|entry| entry.is_called(name))
        .map(PaneId)
}

/// The tiles of a task.
pub type Tiles = Tree<PaneId>;

/// Panes in a column or row of fixed size.
pub struct Column {
    /// Ids of its panes, from the top.
    pub panes: &'static [&'static str],
    /// Its size in points, in windows of 1600 × 1000 and of 1280 × 720.
    sizes: [f32; 2],
}

impl Column {
    pub const fn new(panes: &'static [&'static str], sizes: [f32; 2]) -> Self {
        Column { panes, sizes }
    }

    /// Its size along its short side, in a window of this size.
    pub fn size(&self, window: egui::Vec2) -> f32 {
        let [large, small] = self.sizes;
        let share = ((window.x - 1280.0) / 320.0).clamp(0.0, 1.0);
        let least = 0.4 * window.min_elem();
        (small + share * (large - small)).min(least.max(small.min(window.x * 0.4)))
    }
}

/// With tabs, panes can be dragged beside or onto each other.
pub fn simplification() -> SimplificationOptions {
    SimplificationOptions {
        all_panes_must_have_tabs: true,
        ..SimplificationOptions::default()
    }
}

/// Makes a tree of tiles.
pub fn tree(root: TileId, tiles: egui_tiles::Tiles<PaneId>) -> Tiles {
    let mut tree = Tree::new(egui::Id::unique("panes"), root, tiles);
    tree.simplify(&simplification());
    tree
}
