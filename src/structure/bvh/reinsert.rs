//! Reinsertion: subtrees of a finished hierarchy move to where the surface-area heuristic expects less work.

use super::binary::{Binary, Content};
use super::binned::{BINS, Binned};
use super::builder::{BvhBuilder, Input};
use super::collapse::collapse;
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::lbvh::radix_tree;
use super::ploc::{RADIUS, clustered};
use super::sweep::Sweep;
use crate::geometry::Aabb;
use crate::progress::{Cancelled, Progress};
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use rayon::prelude::*;
use std::cmp::Reverse;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-reinsert",
    summary: "bounding volume hierarchy, moves subtrees of another one to better places (SAH)",
    about: "Begins with the hierarchy of another builder. In each round, finds the best new place for the nodes \
            of the largest boxes, and moves those whose move makes the boxes of inner nodes smaller, the best \
            move first. At the end, subtrees become leaves where that is not more expensive by the surface-area \
            heuristic. D_MAX applies only to the hierarchy at the beginning.",
    source: "J. Bittner, M. Hapala and V. Havran, Fast insertion-based optimization of bounding volume \
             hierarchies, 2013; D. Meister and J. Bittner, Parallel reinsertion for bounding volume hierarchy \
             optimization, 2018; as in madmann91/bvh, version 2",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: false,
    constants: &[
        WIDTH,
        MAX_LEAF,
        BLOCK,
        START,
        BATCH,
        ROUNDS,
        BINS,
        RADIUS,
        COST_TRAVERSAL,
        COST_TEST,
    ],
    builder: Builder::Boxes(|settings| Box::new(Reinsert::new(settings))),
};

const START: Constant = Constant {
    name: "start",
    default: 1.0,
    lowest: 0.0,
    highest: 3.0,
    step: 1.0,
    unit: "",
    about: "The builder of the hierarchy at the beginning: 0 bvh-sweep, 1 bvh-binned, 2 bvh-lbvh, 3 bvh-ploc. The \
            last two begin with one object per leaf.",
    source: "ours",
};

const BATCH: Constant = Constant {
    name: "batch",
    default: 5.0,
    lowest: 0.0,
    highest: 100.0,
    step: 0.0,
    unit: "%",
    about: "Share of the nodes that may move per round: those of the largest boxes.",
    source: "madmann91/bvh, version 2",
};

const ROUNDS: Constant = Constant {
    name: "rounds",
    default: 3.0,
    lowest: 0.0,
    highest: 100.0,
    step: 1.0,
    unit: "",
    about: "Number of rounds. The later ones find little.",
    source: "madmann91/bvh, version 2",
};

struct Reinsert {
    costs: Costs,
    start: Start,
    share: f64,
    rounds: u32,
}

/// The hierarchy at the beginning.
enum Start {
    Sweep(Sweep),
    Binned(Binned),
    Lbvh,
    Ploc { radius: usize },
}

impl Reinsert {
    fn new(settings: &BuildSettings) -> Self {
        let start = match settings.constant("start") as u32 {
            0 => Start::Sweep(Sweep::new(settings)),
            1 => Start::Binned(Binned::new(settings)),
            2 => Start::Lbvh,
            _ => Start::Ploc {
                radius: settings.constant("radius") as usize,
            },
        };
        Reinsert {
            costs: Costs::of(settings),
            start,
            share: settings.constant("batch") / 100.0,
            rounds: settings.constant("rounds") as u32,
        }
    }
}

impl BvhBuilder for Reinsert {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        let part = input.progress.part(0.0, 0.3);
        let first = Input {
            progress: &part,
            ..*input
        };
        let start = match &self.start {
            Start::Sweep(sweep) => sweep.build(&first),
            Start::Binned(binned) => binned.build(&first),
            Start::Lbvh => radix_tree(&first),
            Start::Ploc { radius } => clustered(&first, *radius),
        }?;
        let mut moving = Moving::new(start);
        for round in 0..self.rounds {
            let span = |i: u32| 0.3 + 0.7 * f64::from(i) / f64::from(self.rounds);
            moving.round(
                self.share,
                &input.progress.part(span(round), span(round + 1)),
            )?;
        }
        collapse(&moving.hierarchy, self.costs, input.progress)
    }
}

/// A hierarchy whose subtrees can be moved.
struct Moving {
    hierarchy: Binary,
    /// The parents of all nodes; the root is its own parent.
    parents: Vec<u32>,
    /// The surface areas of all boxes.
    areas: Vec<f64>,
    root_area: f64,
}

/// A subtree with a new place: beside node `to`.
#[derive(Clone, Copy, Debug)]
struct Move {
    gain: i64,
    from: u32,
    to: u32,
}

impl Moving {
    fn new(hierarchy: Binary) -> Self {
        let mut parents = vec![hierarchy.root; hierarchy.nodes.len()];
        for (node, parent) in hierarchy.nodes.iter().zip(0..) {
            if let Content::Children(children) = node.content {
                for child in children {
                    parents[child as usize] = parent;
                }
            }
        }
        let areas = hierarchy.nodes.iter().map(|n| n.bounds.surface_area());
        Moving {
            areas: areas.collect(),
            root_area: hierarchy.nodes[hierarchy.root as usize]
                .bounds
                .surface_area(),
            hierarchy,
            parents,
        }
    }

    /// Searches in parallel for the moves of a share of the nodes, then makes those that pay.
    fn round(&mut self, share: f64, progress: &Progress) -> Result<(), Cancelled> {
        /// Moves between two checks for cancellation.
        const CHUNK: usize = 64;
        let mut nodes: Vec<u32> = (0..self.parents.len() as u32).collect();
        nodes.retain(|&node| node != self.hierarchy.root);
        nodes.par_sort_unstable_by_key(|&node| {
            (Reverse(self.steps(self.areas[node as usize])), node)
        });
        nodes.truncate((self.parents.len() as f64 * share).ceil() as usize);
        progress.check()?;
        let found = nodes.par_chunks(CHUNK).map(|nodes| {
            progress.check()?;
            Ok(nodes
                .iter()
                .filter_map(|&node| self.best_move(node))
                .collect())
        });
        let found: Vec<Vec<Move>> = found.collect::<Result<_, _>>()?;
        progress.set(0.8);
        let mut moves = found.concat();
        moves.par_sort_unstable_by_key(|found| (Reverse(found.gain), found.from));
        for (i, chosen) in moves.into_iter().enumerate() {
            if i.is_multiple_of(CHUNK) {
                progress.check()?;
            }
            self.try_move(chosen);
        }
        progress.set(1.0);
        Ok(())
    }

    /// Returns an area in 2⁻⁴⁰ of the root's, so that rounding does not decide between equal areas.
    fn steps(&self, area: f64) -> i64 {
        (area / self.root_area * (1_u64 << 40) as f64).round() as i64
    }

    fn bounds(&self, node: u32) -> Aabb {
        self.hierarchy.nodes[node as usize].bounds
    }

    fn children(&self, node: u32) -> Option<[u32; 2]> {
        match self.hierarchy.nodes[node as usize].content {
            Content::Children(children) => Some(children),
            Content::Leaf { .. } => None,
        }
    }

    fn sibling(&self, node: u32) -> u32 {
        match self.children(self.parents[node as usize]) {
            Some([a, b]) if a == node => b,
            Some([a, _]) => a,
            None => unreachable!("parents have children"),
        }
    }

    /// Returns the move of a node that makes the sum of the areas of inner nodes smallest, if any makes it
    /// smaller.
    ///
    /// Without the node, its parent is replaced by its sibling, and the ancestors become smaller. For every
    /// ancestor in turn, the search descends into its other child. It keeps the gain so far: what has become
    /// smaller, minus what would become larger on the way down. It ends where not even a place that costs nothing
    /// but the node's own area pays more than the best one found.
    fn best_move(&self, from: u32) -> Option<Move> {
        let root = self.hierarchy.root;
        let (moved, own_area) = (self.bounds(from), self.areas[from as usize]);
        let parent = self.parents[from as usize];
        let mut sibling = self.sibling(from);
        let neighbor = sibling;
        let mut best = Move {
            gain: 0,
            from,
            to: neighbor,
        };
        // The box of the ancestor without the node, and the gain of removing it.
        let mut rest = self.bounds(sibling);
        let mut removed = self.areas[parent as usize];
        let mut ancestor = parent;
        let mut stack = Vec::new();
        loop {
            stack.push((removed, sibling));
            while let Some((gain, node)) = stack.pop() {
                if self.steps(gain - own_area) <= best.gain {
                    continue;
                }
                let union = self.bounds(node).union(&moved).surface_area();
                let gain = gain - union;
                let steps = self.steps(gain);
                if steps > best.gain && node != neighbor {
                    best = Move {
                        gain: steps,
                        from,
                        to: node,
                    };
                }
                if let Some(children) = self.children(node) {
                    let below = gain + self.areas[node as usize];
                    stack.extend(children.map(|child| (below, child)));
                }
            }
            if ancestor == root {
                break;
            }
            // The next ancestor contains the rest of this one and its sibling.
            sibling = self.sibling(ancestor);
            if ancestor != parent {
                removed += self.areas[ancestor as usize] - rest.surface_area();
            }
            rest = rest.union(&self.bounds(sibling));
            ancestor = self.parents[ancestor as usize];
        }
        (best.gain > 0).then_some(best)
    }

    /// Moves a subtree, unless that no longer pays or is no longer possible after other moves.
    fn try_move(&mut self, Move { from, to, .. }: Move) {
        let root = self.hierarchy.root;
        let (parent, neighbor) = (self.parents[from as usize], self.sibling(from));
        let mut ancestor = to;
        while ancestor != root {
            if ancestor == from {
                return;
            }
            ancestor = self.parents[ancestor as usize];
        }
        if from == root || to == neighbor || to == parent {
            return;
        }
        let increase = self.reinsert(from, to);
        if self.steps(increase) >= 0 {
            self.reinsert(from, neighbor);
        }
    }

    /// Moves a subtree beside node `to`, which is neither in it nor its parent or sibling. Returns how much the
    /// sum of the areas of inner nodes increases.
    fn reinsert(&mut self, from: u32, to: u32) -> f64 {
        let (parent, neighbor) = (self.parents[from as usize], self.sibling(from));
        let above = self.replace(parent, neighbor);
        let mut increase = above.map_or(0.0, |above| self.refit(above));
        self.replace(to, parent);
        self.hierarchy.nodes[parent as usize].content = Content::Children([from, to]);
        self.parents[to as usize] = parent;
        increase += self.refit(parent);
        // The box of the parent may be what it was elsewhere.
        increase + self.refit(self.parents[parent as usize])
    }

    /// Puts a node in the place of another one. Returns its parent; `None` if it becomes the root.
    fn replace(&mut self, old: u32, new: u32) -> Option<u32> {
        let above = self.parents[old as usize];
        if old == self.hierarchy.root {
            self.hierarchy.root = new;
            self.parents[new as usize] = new;
            return None;
        }
        self.parents[new as usize] = above;
        if let Content::Children(children) = &mut self.hierarchy.nodes[above as usize].content {
            for child in children.iter_mut().filter(|child| **child == old) {
                *child = new;
            }
        }
        Some(above)
    }

    /// Fits the boxes of an inner node and its ancestors to their children. Returns how much their areas
    /// increase.
    fn refit(&mut self, mut node: u32) -> f64 {
        let mut increase = 0.0;
        loop {
            let Some([a, b]) = self.children(node) else {
                return increase;
            };
            let bounds = self.bounds(a).union(&self.bounds(b));
            if bounds == self.bounds(node) {
                return increase;
            }
            let area = bounds.surface_area();
            increase += area - self.areas[node as usize];
            self.hierarchy.nodes[node as usize].bounds = bounds;
            self.areas[node as usize] = area;
            if node == self.hierarchy.root {
                return increase;
            }
            node = self.parents[node as usize];
        }
    }
}
