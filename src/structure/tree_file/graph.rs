//! The nodes of a file before their geometry: which is below which, and what leaves hold.

use super::error::TreeFileError;
use super::faults::{FaultKind, Faults};
use crate::progress::{Cancelled, Progress};
use crate::structure::node::{Node, StopReason};

/// Maximum depth of a node. Kernels reserve memory for stacks in proportion to it.
const MAX_DEPTH: u32 = 2000;

/// Nodes between two checks for cancellation.
const CHUNK: usize = 1 << 14;

/// Nodes with their children and references, as in the file.
pub struct Graph<'a> {
    pub leaf: &'a [u8],
    /// Of a leaf: its references. Of an inner node: its children.
    pub first: Vec<u32>,
    pub count: Vec<u32>,
    pub child: Vec<u32>,
    pub references: Vec<u32>,
    pub stop: Option<&'a [u8]>,
    pub stops: &'a [StopReason],
    /// The most children of an inner node.
    pub width: u32,
    /// Number of objects of the scene.
    pub objects: usize,
}

/// A node in its place in the tree.
#[derive(Clone, Copy)]
pub struct Placed {
    /// Index in the file.
    pub node: u32,
    /// Index in depth-first order of its parent; the root is its own parent.
    pub parent: u32,
}

impl Graph<'_> {
    pub fn is_leaf(&self, node: u32) -> bool {
        self.leaf[node as usize] != 0
    }

    /// Returns the entries of an array that belong to a node; `None` if they are outside it.
    fn part<'b>(&self, node: u32, all: &'b [u32]) -> Option<&'b [u32]> {
        let (first, count) = (self.first[node as usize], self.count[node as usize]);
        all.get(first as usize..first as usize + count as usize)
    }

    /// Returns the children of an inner node; none if they are outside the array.
    pub fn children(&self, node: u32) -> &[u32] {
        self.part(node, &self.child).unwrap_or_default()
    }

    /// Returns the objects of a leaf in the order of the file; none if they are outside the array.
    pub fn objects(&self, node: u32) -> &[u32] {
        self.part(node, &self.references).unwrap_or_default()
    }

    /// Returns why a node is a leaf.
    pub fn stop(&self, node: u32) -> StopReason {
        let given = self.stop.map(|stop| usize::from(stop[node as usize]));
        match given.and_then(|stop| self.stops.get(stop)) {
            Some(&stop) => stop,
            None if self.objects(node).is_empty() => StopReason::Empty,
            None => StopReason::InFile,
        }
    }

    /// Returns all nodes below the root in depth-first order, children in the order of the file, and counts
    /// what is wrong with them.
    ///
    /// # Errors
    /// There is no node, or cancellation.
    pub fn order(
        &self,
        faults: &mut Faults,
        progress: &Progress,
    ) -> Result<Vec<Placed>, TreeFileError> {
        if self.leaf.is_empty() {
            let reason = "expected at least one node".into();
            return Err(TreeFileError::Array {
                name: "leaf",
                reason,
            });
        }
        let nodes = self.leaf.len();
        let mut order: Vec<Placed> = Vec::with_capacity(nodes);
        let mut reached = vec![false; nodes];
        let mut held = vec![false; self.objects];
        // Leaves that share references could have many more than the file has bytes.
        let mut free = self.references.len();
        reached[0] = true;
        let mut stack = vec![(0_u32, 0_u32, 0_u32)];
        while let Some((node, parent, depth)) = stack.pop() {
            if order.len().is_multiple_of(CHUNK) {
                progress.check()?;
            }
            let place = order.len() as u32;
            order.push(Placed { node, parent });
            if self.leaf[node as usize] > 1 {
                let flag = self.leaf[node as usize];
                faults.add(FaultKind::LeafFlag, || {
                    format!("node {node}: leaf is {flag}; expected 0 or 1")
                });
            }
            if self.is_leaf(node) {
                let count = self.count[node as usize] as usize;
                self.check_leaf(node, &mut held, count <= free, faults);
                free = free.saturating_sub(count);
                continue;
            }
            if depth == MAX_DEPTH {
                faults.add(FaultKind::Depth, || {
                    format!("node {node} has children deeper than {MAX_DEPTH}")
                });
                continue;
            }
            let from = stack.len();
            for &child in self.checked_children(node, faults) {
                match reached.get_mut(child as usize) {
                    None => faults.add(FaultKind::ChildIndex, || {
                        format!("node {node}: child {child} is not one of {nodes} nodes")
                    }),
                    Some(true) => self.reached_twice(node, child, &order, faults),
                    Some(reached) => {
                        *reached = true;
                        stack.push((child, place, depth + 1));
                    }
                }
            }
            stack[from..].reverse();
        }
        if !faults.are_fatal() {
            for node in (0..nodes).filter(|&node| !reached[node]) {
                faults.add(FaultKind::Unreached, || {
                    format!("node {node} is not below the root")
                });
            }
            for object in (0..self.objects).filter(|&object| !held[object]) {
                faults.add(FaultKind::Lost, || {
                    format!("object {object} is lost: no leaf refers to it")
                });
            }
        }
        Ok(order)
    }

    /// Returns the children of a node and counts what is wrong with their number.
    fn checked_children(&self, node: u32, faults: &mut Faults) -> &[u32] {
        let (count, width) = (self.count[node as usize], self.width);
        if !(2..=width).contains(&count) {
            faults.add(FaultKind::ChildCount, || {
                format!("node {node} has {count} children; expected 2 to {width}")
            });
            return &[];
        }
        if self.part(node, &self.child).is_none() {
            let (first, all) = (self.first[node as usize], self.child.len());
            faults.add(FaultKind::ChildIndex, || {
                format!("node {node}: {count} children from {first} on, but 'child' has {all}")
            });
        }
        self.children(node)
    }

    /// Counts what is wrong with a leaf. `is_own` is whether `ref` is long enough for references of its own.
    fn check_leaf(&self, node: u32, held: &mut [bool], is_own: bool, faults: &mut Faults) {
        let count = self.count[node as usize];
        let is_inside = self.part(node, &self.references).is_some();
        if !is_inside || !is_own || count as usize >= Node::MAX_LEAF {
            let (first, all) = (self.first[node as usize], self.references.len());
            faults.add(FaultKind::ReferenceIndex, || match is_inside {
                false => {
                    format!("leaf {node}: {count} references from {first} on, but 'ref' has {all}")
                }
                true => {
                    format!("leaf {node} shares some of its {count} references with another leaf")
                }
            });
            return;
        }
        for &object in self.objects(node) {
            match held.get_mut(object as usize) {
                Some(held) => *held = true,
                None => faults.add(FaultKind::ObjectIndex, || {
                    let objects = self.objects;
                    format!("leaf {node} refers to object {object}; there are {objects} objects")
                }),
            }
        }
        if let Some(stop) = self.stop.map(|stop| stop[node as usize])
            && usize::from(stop) >= self.stops.len()
        {
            faults.add(FaultKind::Stop, || {
                format!(
                    "leaf {node}: stop is {stop}, but 'stops' has {}",
                    self.stops.len()
                )
            });
        }
    }

    /// Counts a node that was reached before.
    fn reached_twice(&self, node: u32, child: u32, order: &[Placed], faults: &mut Faults) {
        let mut place = order.len() - 1;
        loop {
            if order[place].node == child {
                return faults.add(FaultKind::Cycle, || {
                    format!("node {node}: child {child} is the node itself or above it")
                });
            }
            match order[place].parent as usize {
                parent if parent == place => break,
                parent => place = parent,
            }
        }
        faults.add(FaultKind::TwoParents, || {
            format!("node {node}: child {child} is also the child of another node")
        });
    }

    /// Copies the references of a leaf in ascending order to the end of `all` and returns how many there are.
    pub fn copy_objects(&self, node: u32, all: &mut Vec<u32>, faults: &mut Faults) -> u32 {
        let from = all.len();
        let mut own = self.objects(node).to_vec();
        own.sort_unstable();
        own.dedup();
        all.extend(own);
        if all.len() - from != self.objects(node).len() {
            faults.add(FaultKind::Repeated, || {
                format!("leaf {node} refers to an object twice")
            });
        }
        (all.len() - from) as u32
    }
}

/// Checks for cancellation once per chunk of nodes.
pub fn check_now_and_then(i: usize, progress: &Progress) -> Result<(), Cancelled> {
    match i.is_multiple_of(CHUNK) {
        true => progress.check(),
        false => Ok(()),
    }
}
