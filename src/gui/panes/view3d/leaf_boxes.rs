//! The leaf boxes of the tree on view, made off the window's thread where there are many.

use crate::geometry::Vec3;
use crate::gui::document::tasks::Latest;
use crate::jobs::PictureVisits;
use crate::present::overlay::{Coloring, Filter, LeafBoxes, leaf_boxes};
use crate::structure::Tree;
use std::sync::Arc;

/// What decides the boxes.
#[derive(Clone)]
struct Key {
    tree: Arc<Tree>,
    filter: Filter,
    coloring: &'static Coloring,
    /// Of the picture, where filter or coloring need them.
    visits: Option<Arc<PictureVisits>>,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.tree, &other.tree)
            && self.filter == other.filter
            && self.coloring.name == other.coloring.name
            && self.visits.as_ref().map(Arc::as_ptr) == other.visits.as_ref().map(Arc::as_ptr)
    }
}

/// Up to this many nodes, boxes take less time to make than a frame to draw.
const NODES_AT_ONCE: usize = 30_000;

/// Buffers may take 256 MiB, a box takes 28 bytes.
const MOST_BOXES: usize = 9_000_000;

/// The boxes of the latest tree, filter and coloring.
#[derive(Default)]
pub struct Boxes {
    made: Latest<Key, LeafBoxes>,
    /// The last that were given.
    given: Option<(Key, Arc<LeafBoxes>)>,
}

impl Boxes {
    /// The boxes; `None` while they are being made. While others of the same build are made, or others in which
    /// another subtree stands out, those of before are given; those of another tree never are.
    pub fn get(
        &mut self,
        tree: &Arc<Tree>,
        filter: Filter,
        coloring: &'static Coloring,
        visits: Option<Arc<PictureVisits>>,
        center: Vec3,
        ctx: &egui::Context,
    ) -> Option<Arc<LeafBoxes>> {
        let key = Key {
            tree: Arc::clone(tree),
            filter,
            coloring,
            visits,
        };
        let boxes = self.make(&key, center, ctx);
        if let Some(boxes) = boxes {
            self.given = Some((key, Arc::clone(&boxes)));
            return Some(boxes);
        }
        let (before, boxes) = self.given.as_ref()?;
        let mut now = key;
        now.filter.moment = before.filter.moment;
        now.filter.focus = before.filter.focus;
        (now == *before).then(|| Arc::clone(boxes))
    }

    fn make(&mut self, key: &Key, center: Vec3, ctx: &egui::Context) -> Option<Arc<LeafBoxes>> {
        if let Some(boxes) = self.made.ready(key) {
            return Some(boxes);
        }
        let make = {
            let key = key.clone();
            move || {
                let visits = key.visits.as_ref().map(|visits| &visits.visits);
                let mut boxes = leaf_boxes(&key.tree, &key.filter, key.coloring, visits, center);
                // The subtree that stands out comes first: of edges in the same place, the first is seen.
                let (within, outside) = boxes.instances.split_at(boxes.focused);
                boxes.instances = [spread(within), spread(outside)].concat();
                boxes.instances.truncate(MOST_BOXES);
                boxes
            }
        };
        if key.tree.nodes().len() <= NODES_AT_ONCE {
            Some(self.made.put(key.clone(), make()))
        } else {
            self.made.get(key, ctx, make)
        }
    }
}

/// The same in an order of which every beginning is spread over the whole.
fn spread<T: Copy>(items: &[T]) -> Vec<T> {
    let n = items.len();
    let mut step = (n as f64 * 0.618) as usize;
    while step > 1 && gcd(step, n) != 1 {
        step -= 1;
    }
    (0..n).map(|i| items[i * step.max(1) % n]).collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreading_keeps_everything_once() {
        for n in [0, 1, 2, 3, 10, 97, 1000] {
            let items: Vec<usize> = (0..n).collect();
            let mut mixed = spread(&items);
            mixed.sort_unstable();
            assert_eq!(mixed, items);
        }
    }
}
