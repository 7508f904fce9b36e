//! What the tree's panes and the 3D view share: facts of the nodes, ranges of the histograms, and
//! the plane that is tried out.

use super::build_view::BuildView;
use super::result::Current;
use super::tasks::Latest;
use super::visits::VisitsJob;
use crate::geometry::Axis;
use crate::jobs::PictureVisits;
use crate::present::overlay::{HISTOGRAMS, Leaf, Ranges, in_ranges, leaves};
use crate::scene::Scene;
use crate::structure::{NodeCost, Tree, TreeIndex};
use crate::workspace::NODES_PER_RAY;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What decides the facts of leaves: the tree and, where visits are known, the picture's number.
pub type LeavesKey = (TreeKey, Option<u64>);

/// A tree by identity.
#[derive(Clone)]
pub struct TreeKey(pub Arc<Tree>);

impl PartialEq for TreeKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Up to this many nodes or references, facts take less time to work out than a frame to draw.
const AT_ONCE: usize = 30_000;

/// A plane tried out in a node's cell; it changes no tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhatIf {
    pub node: u32,
    pub axis: Axis,
    pub plane: f64,
}

/// What the tree's panes and the 3D view share. Facts are worked out when a pane first needs them: hence
/// the cells.
#[derive(Default)]
pub struct Inspect {
    /// The tree that all else is about.
    tree: Option<TreeKey>,
    /// The scene that the ranges were chosen in.
    scene: Option<Arc<Scene>>,
    index: RefCell<Latest<TreeKey, TreeIndex>>,
    leaves: RefCell<Latest<LeavesKey, Vec<Leaf>>>,
    /// How often rays of the picture visited every node.
    pub visits: VisitsJob,
    cost: RefCell<Latest<(TreeKey, u32), NodeCost>>,
    counted: Cell<Option<(Ranges, bool, usize)>>,
    /// Ranges of the histograms: leaves outside are not shown.
    pub ranges: Ranges,
    /// Numbers of nodes that a ray visits: pixels without a ray in this range are dimmed.
    pub nodes_a_ray: Option<[f64; 2]>,
    pub what_if: Option<WhatIf>,
    /// The moment of the build that is shown.
    pub build: BuildView,
    /// A node that the 3D view is to show.
    pub frame: Option<u32>,
}

impl Inspect {
    /// Forgets what was about another tree or scene, or about another selection.
    pub fn follow(&mut self, current: &Current) {
        if self.visits.follow(current) {
            self.counted.take();
        }
        let key = TreeKey(Arc::clone(&current.shown.tree));
        if self.tree.as_ref() != Some(&key) {
            self.tree = Some(key);
            self.counted.take();
            self.what_if = None;
            self.frame = None;
            self.build.reset();
        }
        let scene = &current.shown.scene;
        if !self.scene.as_ref().is_some_and(|s| Arc::ptr_eq(s, scene)) {
            self.scene = Some(Arc::clone(scene));
            self.clear_ranges();
        }
        self.what_if = self
            .what_if
            .filter(|tried| current.selection.node == Some(tried.node));
    }

    /// Facts of all nodes; `None` while they are being worked out.
    pub fn index(&self, current: &Current, ctx: &egui::Context) -> Option<Arc<TreeIndex>> {
        let key = TreeKey(Arc::clone(&current.shown.tree));
        let objects = current.shown.scene.objects().len();
        let making = Arc::clone(&key.0);
        let size = making.nodes().len() + making.references().len();
        let make = move || TreeIndex::new(&making, objects);
        get(&self.index, key, size, ctx, make)
    }

    /// All leaves, with their visits if those are there; `None` while they are being gathered.
    pub fn leaves(
        &self,
        current: &Current,
        visits: Option<&Arc<PictureVisits>>,
        ctx: &egui::Context,
    ) -> Option<Arc<Vec<Leaf>>> {
        let tree = Arc::clone(&current.shown.tree);
        let size = tree.nodes().len();
        let picture = visits.map(|_| current.number);
        let key = (TreeKey(Arc::clone(&tree)), picture);
        let visits = visits.cloned();
        get(&self.leaves, key, size, ctx, move || {
            leaves(&tree, visits.as_ref().map(|visits| &visits.visits))
        })
    }

    /// The cost of splitting a node; `None` while it is being worked out.
    pub fn cost(&self, current: &Current, node: u32, ctx: &egui::Context) -> Option<Arc<NodeCost>> {
        let index = self.index(current, ctx)?;
        let key = (TreeKey(Arc::clone(&current.shown.tree)), node);
        let (scene, tree) = (Arc::clone(&current.shown.scene), Arc::clone(&key.0.0));
        let size = index.of(node).references as usize;
        get(&self.cost, key, size, ctx, move || {
            NodeCost::new(&scene, &tree, &index, node)
        })
    }

    /// How many leaves lie in all ranges, and of how many.
    pub fn selected_leaves(&self, leaves: &[Leaf]) -> [usize; 2] {
        let visited = leaves.first().is_some_and(|leaf| leaf.visits.is_some());
        let count = match self.counted.get() {
            Some((ranges, known, count)) if (ranges, known) == (self.ranges, visited) => count,
            _ => leaves
                .iter()
                .filter(|leaf| in_ranges(leaf, &self.ranges))
                .count(),
        };
        self.counted.set(Some((self.ranges, visited, count)));
        [count, leaves.len()]
    }

    /// Selects all leaves and rays again.
    pub fn clear_ranges(&mut self) {
        self.ranges = Ranges::default();
        self.nodes_a_ray = None;
    }

    /// The ranges that are chosen, by the names of the histograms.
    pub fn named_ranges(&self) -> BTreeMap<String, [f64; 2]> {
        let leaves = HISTOGRAMS.iter().map(|histogram| histogram.name);
        let all = leaves
            .zip(self.ranges)
            .chain([(NODES_PER_RAY, self.nodes_a_ray)]);
        all.filter_map(|(name, range)| Some((name.to_owned(), range?)))
            .collect()
    }

    /// Chooses these ranges and no others.
    pub fn select_ranges(&mut self, named: &BTreeMap<String, [f64; 2]>) {
        for (histogram, range) in HISTOGRAMS.iter().zip(&mut self.ranges) {
            *range = named.get(histogram.name).copied();
        }
        self.nodes_a_ray = named.get(NODES_PER_RAY).copied();
    }

    /// Takes the tried plane away; says whether there was one.
    pub fn undo(&mut self) -> bool {
        self.what_if.take().is_some()
    }
}

/// Works a value out at once if that is quick, else in the background.
fn get<K: Clone + PartialEq, T: Send + 'static>(
    latest: &RefCell<Latest<K, T>>,
    key: K,
    size: usize,
    ctx: &egui::Context,
    make: impl FnOnce() -> T + Send + 'static,
) -> Option<Arc<T>> {
    let mut latest = latest.borrow_mut();
    if let Some(ready) = latest.ready(&key) {
        Some(ready)
    } else if size <= AT_ONCE {
        Some(latest.put(key, make()))
    } else {
        latest.get(&key, ctx, make)
    }
}
