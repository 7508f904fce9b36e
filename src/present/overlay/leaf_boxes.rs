//! The cells of leaves as colored boxes, with a filter.

use super::{Coloring, Leaf, Ranges, in_ranges, ranges_need_visits};
use crate::geometry::Vec3;
use crate::structure::{CellOfNode, Moment, NodeKind, Tree};
use crate::trace::Visits;
use serde::{Deserialize, Serialize};

/// A filter of leaves by visits: whether rays of the picture visited them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Visited {
    /// All leaves.
    #[default]
    Either,
    /// Leaves that a ray visited.
    Yes,
    /// Leaves that no ray visited.
    Never,
}

impl Visited {
    pub const ALL: [Visited; 3] = [Visited::Either, Visited::Yes, Visited::Never];

    /// Returns the display name.
    pub const fn title(self) -> &'static str {
        match self {
            Visited::Either => "Visited or not",
            Visited::Yes => "Visited by the picture",
            Visited::Never => "Never visited",
        }
    }

    /// Returns whether a leaf passes the filter. No leaf passes a filter by visits before they are
    /// counted.
    fn holds(self, leaf: &Leaf) -> bool {
        match self {
            Visited::Either => true,
            Visited::Yes => leaf.visits.is_some_and(|visits| visits > 0),
            Visited::Never => leaf.visits == Some(0),
        }
    }
}

/// How cells outside of a subtree are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outside {
    /// As those within.
    #[default]
    Shown,
    /// In faint colors.
    Faded,
    Hidden,
}

impl Outside {
    pub const ALL: [Outside; 3] = [Outside::Shown, Outside::Faded, Outside::Hidden];

    /// Returns the display name.
    pub const fn title(self) -> &'static str {
        match self {
            Outside::Shown => "Shown",
            Outside::Faded => "Faded",
            Outside::Hidden => "Hidden",
        }
    }
}

/// A subtree that stands out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Focus {
    /// The root of the subtree.
    pub node: u32,
    pub outside: Outside,
}

/// A filter of leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter {
    /// Least and greatest depth shown.
    pub depth: [u32; 2],
    pub empty: bool,
    pub full: bool,
    pub visited: Visited,
    /// The step of the build to show; `None` for the finished tree.
    pub moment: Option<Moment>,
    /// Of a finished tree, the depth at which cells stand in for the leaves below; `None` for leaves
    /// alone.
    pub to_depth: Option<u32>,
    /// The subtree that stands out; the depth at which cells stand in for leaves counts from its root there.
    pub focus: Option<Focus>,
    /// Ranges of the histograms.
    pub ranges: Ranges,
}

impl Default for Filter {
    /// Returns a filter that all leaves pass.
    fn default() -> Self {
        Filter {
            depth: [0, u32::MAX],
            empty: true,
            full: true,
            visited: Visited::default(),
            moment: None,
            to_depth: None,
            focus: None,
            ranges: Ranges::default(),
        }
    }
}

impl Filter {
    /// Returns whether a leaf passes.
    pub fn passes(&self, leaf: &Leaf) -> bool {
        let [lowest, highest] = self.depth;
        let wanted = if leaf.objects == 0 {
            self.empty
        } else {
            self.full
        };
        wanted
            && (lowest..=highest).contains(&leaf.depth)
            && self.visited.holds(leaf)
            && in_ranges(leaf, &self.ranges)
    }

    /// Returns whether the filter needs the visits of leaves to be counted.
    pub fn needs_visits(&self) -> bool {
        self.visited != Visited::Either || ranges_need_visits(&self.ranges)
    }
}

/// A box to draw, relative to a center.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Instance {
    pub lo: [f32; 3],
    pub hi: [f32; 3],
    /// sRGB and line style: 255 for solid edges (full leaves), 0 for dashed edges (empty leaves),
    /// 128 for dotted edges (undecided cells); 223, 32 and 96 for the same in faint colors.
    pub color: [u8; 4],
}

/// The color of undecided cells of an unfinished tree. No coloring of leaves uses it.
pub const UNDECIDED_COLOR: [u8; 3] = [235; 3];

/// What the line style of a faint box differs by, toward dotted edges.
const FAINT: u8 = 32;

/// The boxes of a tree's leaves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafBoxes {
    pub instances: Vec<Instance>,
    /// So many of them at the beginning are of the subtree that stands out; all if none does.
    pub focused: usize,
    /// Number of leaves in the tree, including hidden ones.
    pub leaves: usize,
    /// Number of boxes of undecided cells.
    pub undecided: usize,
    /// Number of boxes of cells that stand in for the leaves below.
    pub coarse: usize,
    /// Least and greatest value of the legend.
    pub range: [f64; 2],
}

/// Returns the colored boxes of the leaves that pass the filter.
///
/// Boxes are relative to `center`, which keeps them precise in `f32`. The legend spans all leaves
/// of the tree, so a filter changes no color. A filter or coloring by visits needs `visits`;
/// without them, no leaf passes or has a color. At a step of the build, undecided cells are
/// filtered by depth only. A cell that stands in for the leaves below has the sum of their references.
pub fn leaf_boxes(
    tree: &Tree,
    filter: &Filter,
    coloring: &Coloring,
    visits: Option<&Visits>,
    center: Vec3,
) -> LeafBoxes {
    let leaves = || {
        tree.cells()
            .filter_map(|cell| Some((cell, Leaf::of(tree, &cell, visits)?)))
    };
    let range = coloring.range(leaves().filter_map(|(_, leaf)| coloring.value(&leaf)));
    let mut boxes = LeafBoxes {
        range,
        ..LeafBoxes::default()
    };
    boxes.leaves = leaves().count();
    // At the greatest depth, the tree is finished.
    let to_depth = filter.to_depth.filter(|_| filter.moment.is_none());
    let end = Moment::Depth(to_depth.unwrap_or(u32::MAX));
    let moment = filter.moment.unwrap_or(end);
    let mut drawing = Drawing {
        tree,
        filter,
        to_depth,
        coloring,
        visits,
        center,
        boxes,
    };
    let focus = filter.focus.and_then(|focus| {
        let built = filter.moment.unwrap_or(Moment::Depth(u32::MAX));
        Some((focus.outside, cell_at(tree, focus.node, built)?))
    });
    let Some((outside, root)) = focus else {
        for (cell, decided) in tree.cells_at(moment) {
            drawing.add(&cell, decided, false);
        }
        drawing.boxes.focused = drawing.boxes.instances.len();
        return drawing.boxes;
    };
    let end = Moment::Depth(to_depth.map_or(u32::MAX, |depth| root.depth + depth));
    for (cell, decided) in tree.cells_below(root, filter.moment.unwrap_or(end)) {
        drawing.add(&cell, decided, false);
    }
    drawing.boxes.focused = drawing.boxes.instances.len();
    if outside != Outside::Hidden {
        let within = root.node..tree.end_of(root.node);
        let others = tree.cells_at(moment);
        for (cell, decided) in others.filter(|(cell, _)| !within.contains(&cell.node)) {
            drawing.add(&cell, decided, outside == Outside::Faded);
        }
    }
    drawing.boxes
}

/// Returns the cell of a node; `None` if it does not exist yet at this moment.
fn cell_at(tree: &Tree, node: u32, moment: Moment) -> Option<CellOfNode> {
    let mut cell = tree.root();
    while cell.node != node {
        if !tree.is_decided(cell.node, cell.depth, moment) {
            return None;
        }
        let children = tree.children(&cell).take_while(|child| child.node <= node);
        cell = children.last()?;
    }
    Some(cell)
}

/// Boxes in the making.
struct Drawing<'a> {
    tree: &'a Tree,
    filter: &'a Filter,
    /// The depth at which cells stand in for leaves.
    to_depth: Option<u32>,
    coloring: &'a Coloring,
    visits: Option<&'a Visits>,
    center: Vec3,
    boxes: LeafBoxes,
}

impl Drawing<'_> {
    /// Adds the box of a cell if it passes the filter.
    fn add(&mut self, cell: &CellOfNode, decided: bool, fades: bool) {
        let [lowest, highest] = self.filter.depth;
        if !decided && self.to_depth.is_none() {
            if (lowest..=highest).contains(&cell.depth) {
                self.push(cell, UNDECIDED_COLOR, 128, fades);
                self.boxes.undecided += 1;
            }
            return;
        }
        let leaf = if decided {
            Leaf::of(self.tree, cell, self.visits)
        } else {
            self.boxes.coarse += 1;
            Some(below(self.tree, cell, self.visits))
        };
        if let Some(leaf) = leaf
            && let Some(value) = self.coloring.value(&leaf)
            && self.filter.passes(&leaf)
        {
            let edges = if leaf.objects == 0 { 0 } else { 255 };
            let color = self.coloring.color(value, self.boxes.range);
            self.push(cell, color, edges, fades);
        }
    }

    fn push(&mut self, cell: &CellOfNode, color: [u8; 3], edges: u8, fades: bool) {
        let edges = match (fades, edges) {
            (false, edges) => edges,
            (true, 0) => FAINT,
            (true, edges) => edges - FAINT,
        };
        let [r, g, b] = color;
        self.boxes.instances.push(Instance {
            lo: (cell.bounds.lo - self.center).as_vec3().to_array(),
            hi: (cell.bounds.hi - self.center).as_vec3().to_array(),
            color: [r, g, b, edges],
        });
    }
}

/// Returns the cell of an inner node as if it were a leaf.
fn below(tree: &Tree, cell: &CellOfNode, visits: Option<&Visits>) -> Leaf {
    let mut objects = 0;
    let mut nodes = vec![cell.node];
    while let Some(node) = nodes.pop() {
        match tree.kind(node) {
            NodeKind::Leaf { count, .. } => objects += count,
            NodeKind::Inner => nodes.extend(tree.child_nodes(node)),
        }
    }
    Leaf {
        depth: cell.depth,
        objects,
        volume: cell.bounds.volume(),
        visits: visits.map(|visits| visits.by_node[cell.node as usize]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::overlay::coloring;

    #[test]
    fn filters_tell_full_from_empty_and_depths_apart() {
        let full = Leaf {
            depth: 3,
            objects: 2,
            volume: 1.0,
            visits: None,
        };
        let empty = Leaf {
            depth: 5,
            objects: 0,
            volume: 1.0,
            visits: None,
        };
        let all = Filter::default();
        assert!(all.passes(&full) && all.passes(&empty));
        let only_full = Filter {
            empty: false,
            ..all
        };
        assert!(only_full.passes(&full) && !only_full.passes(&empty));
        let shallow = Filter {
            depth: [0, 4],
            ..all
        };
        assert!(shallow.passes(&full) && !shallow.passes(&empty));
        let [visited, unvisited] = [Some(7), Some(0)].map(|visits| Leaf { visits, ..full });
        fn only(visited: Visited) -> Filter {
            Filter {
                visited,
                ..Filter::default()
            }
        }
        assert!(!all.needs_visits() && only(Visited::Never).needs_visits());
        assert!(only(Visited::Yes).passes(&visited) && !only(Visited::Yes).passes(&unvisited));
        assert!(!only(Visited::Never).passes(&visited) && only(Visited::Never).passes(&unvisited));
        assert!(!only(Visited::Yes).passes(&full) && !only(Visited::Never).passes(&full));
    }

    #[test]
    fn cells_at_a_depth_fill_the_root_cell_and_none_is_undecided() {
        use crate::progress::Progress;
        use crate::scene::{SceneRequest, load};
        use crate::structure::{BuildSettings, build};
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:2"), &progress).unwrap();
        let tree = build(&scene, &BuildSettings::default(), &progress).unwrap();
        assert!(tree.depth_reached() > 6);
        let filter = Filter {
            to_depth: Some(6),
            ..Filter::default()
        };
        let depth = coloring("depth").unwrap();
        let boxes = leaf_boxes(&tree, &filter, depth, None, Vec3::ZERO);
        assert!(boxes.coarse > 0 && boxes.instances.len() <= 64);
        assert_eq!(boxes.undecided, 0);
        assert!(boxes.instances.iter().all(|cell| cell.color[3] != 128));
        let volume: f64 = boxes
            .instances
            .iter()
            .map(|cell| {
                let sides = (0..3).map(|k| f64::from(cell.hi[k] - cell.lo[k]));
                sides.product::<f64>()
            })
            .sum();
        let root = tree.root_cell().volume();
        assert!((volume - root).abs() < 1e-4 * root, "{volume} of {root}");
    }

    #[test]
    fn a_subtree_stands_out_and_counts_its_own_depth() {
        use crate::progress::Progress;
        use crate::scene::{SceneRequest, load};
        use crate::structure::{BuildSettings, Method, build};
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:2"), &progress).unwrap();
        let depth = coloring("depth").unwrap();
        for method in ["midpoint", "bvh-sweep"] {
            let settings = BuildSettings::for_method(Method::named(method).unwrap());
            let tree = build(&scene, &settings, &progress).unwrap();
            let boxes = |filter: Filter| leaf_boxes(&tree, &filter, depth, None, Vec3::ZERO);
            let all = boxes(Filter::default());
            assert_eq!(all.focused, all.instances.len());
            // The deepest inner node of the first branch.
            let node = (0..).take_while(|&n| tree.kind(n) == NodeKind::Inner);
            let node = node.last().unwrap();
            let with = |node: u32, outside: Outside, to_depth: Option<u32>| Filter {
                to_depth,
                focus: Some(Focus { node, outside }),
                ..Filter::default()
            };
            let leaves = (node..tree.end_of(node)).filter(|&n| tree.kind(n) != NodeKind::Inner);
            let leaves = leaves.count();
            let alone = boxes(with(node, Outside::Hidden, None));
            assert_eq!((alone.instances.len(), alone.focused), (leaves, leaves));
            let faded = boxes(with(node, Outside::Faded, None));
            assert_eq!(faded.instances.len(), all.instances.len());
            assert_eq!(faded.instances[..leaves], alone.instances[..]);
            let is_faint = |i: &Instance| [223, 32].contains(&i.color[3]);
            assert!(faded.instances[leaves..].iter().all(is_faint));
            let shown = boxes(with(node, Outside::Shown, None));
            assert_eq!(shown.instances.len(), all.instances.len());
            // Below the depth to which cells are shown, the subtree is still divided.
            let coarse = boxes(with(node, Outside::Faded, Some(1)));
            assert!(coarse.focused >= 2, "{method}: {}", coarse.focused);
            assert!(coarse.instances.len() - coarse.focused <= 2);
            // Before it is reached, nothing stands out.
            let early = Filter {
                moment: Some(Moment::Node(0)),
                ..with(node, Outside::Hidden, None)
            };
            assert_eq!(boxes(early).undecided, 1);
        }
    }

    #[test]
    fn an_instance_takes_28_bytes_and_colors_differ() {
        assert_eq!(size_of::<Instance>(), 28);
        let depth = coloring("depth").unwrap();
        assert_ne!(
            depth.color(0.0, [0.0, 20.0]),
            depth.color(20.0, [0.0, 20.0])
        );
    }
}
