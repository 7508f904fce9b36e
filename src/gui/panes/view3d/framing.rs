//! The boxes that the view can be made to show.

use crate::geometry::Aabb;
use crate::gui::document::Current;
use crate::primitive::Shape;

/// What F shows: the selected node's cell, or else what is picked.
pub fn selected(current: &Current) -> Option<Aabb> {
    match current.selection.node {
        Some(node) => Some(current.shown.tree.cell_of(node).bounds),
        None => picked(current),
    }
}

/// The box of what is picked: the object hit, or else the leaves visited.
pub fn picked(current: &Current) -> Option<Aabb> {
    let path = current.picked.as_ref()?.path();
    if path.hit.is_hit() {
        return Some(current.shown.scene.objects()[path.hit.object as usize].bounds());
    }
    path.leaves()
        .map(|leaf| leaf.bounds)
        .reduce(|a, b| a.union(&b))
}
