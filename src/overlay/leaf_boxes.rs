//! The cells of leaves as coloured boxes, filtered.

use super::{Coloring, Leaf, Ranges, in_ranges};
use crate::geometry::Vec3;
use crate::tree::{NodeKind, Tree};

/// Which leaves are shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter {
    /// Least and greatest depth shown.
    pub depth: [u32; 2],
    pub empty: bool,
    pub full: bool,
    /// Ranges of the histograms.
    pub ranges: Ranges,
}

impl Default for Filter {
    /// All leaves.
    fn default() -> Self {
        Filter {
            depth: [0, u32::MAX],
            empty: true,
            full: true,
            ranges: Ranges::default(),
        }
    }
}

impl Filter {
    /// Whether a leaf is shown.
    pub fn passes(&self, leaf: Leaf) -> bool {
        let [lowest, highest] = self.depth;
        let wanted = if leaf.objects == 0 {
            self.empty
        } else {
            self.full
        };
        wanted && (lowest..=highest).contains(&leaf.depth) && in_ranges(&leaf, &self.ranges)
    }
}

/// A box to draw, relative to a centre.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Instance {
    pub lo: [f32; 3],
    pub hi: [f32; 3],
    /// sRGB; the fourth is 255 for solid edges (full leaves), 0 for dashed ones (empty leaves).
    pub color: [u8; 4],
}

/// The boxes of a tree's leaves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafBoxes {
    pub instances: Vec<Instance>,
    /// Leaves of the tree, hidden ones included.
    pub leaves: usize,
    /// The value at the upper end of the legend.
    pub highest: f64,
}

/// The boxes of the leaves that pass the filter, coloured, relative to `center` to stay precise in
/// 32 bits. The legend spans all leaves of the tree, so that a filter changes no colour.
pub fn leaf_boxes(tree: &Tree, filter: &Filter, coloring: &Coloring, center: Vec3) -> LeafBoxes {
    let mut boxes = LeafBoxes::default();
    for (index, node) in (0u32..).zip(tree.nodes()) {
        if let NodeKind::Leaf { count, .. } = node.kind(index) {
            boxes.leaves += 1;
            let leaf = Leaf {
                depth: tree.depth_reached(),
                objects: count,
                volume: tree.root_cell().volume(),
            };
            boxes.highest = boxes.highest.max(coloring.value(leaf));
        }
    }
    for cell in tree.cells() {
        let NodeKind::Leaf { count, .. } = tree.kind(cell.node) else {
            continue;
        };
        let leaf = Leaf {
            depth: cell.depth,
            objects: count,
            volume: cell.bounds.volume(),
        };
        if filter.passes(leaf) {
            let [r, g, b] = coloring.color(coloring.value(leaf), boxes.highest);
            boxes.instances.push(Instance {
                lo: (cell.bounds.lo - center).as_vec3().to_array(),
                hi: (cell.bounds.hi - center).as_vec3().to_array(),
                color: [r, g, b, if count == 0 { 0 } else { 255 }],
            });
        }
    }
    boxes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::overlay::coloring;

    #[test]
    fn filters_tell_full_from_empty_and_depths_apart() {
        let full = Leaf {
            depth: 3,
            objects: 2,
            volume: 1.0,
        };
        let empty = Leaf {
            depth: 5,
            objects: 0,
            volume: 1.0,
        };
        let all = Filter::default();
        assert!(all.passes(full) && all.passes(empty));
        let only_full = Filter {
            empty: false,
            ..all
        };
        assert!(only_full.passes(full) && !only_full.passes(empty));
        let shallow = Filter {
            depth: [0, 4],
            ..all
        };
        assert!(shallow.passes(full) && !shallow.passes(empty));
    }

    #[test]
    fn an_instance_takes_28_bytes_and_colours_differ() {
        assert_eq!(size_of::<Instance>(), 28);
        let depth = coloring("depth").unwrap();
        assert_ne!(depth.color(0.0, 20.0), depth.color(20.0, 20.0));
    }
}
