//! Builders that divide the objects of a node again and again: termination, threads, order.

use super::binary::Binary;
use super::builder::Input;
use super::costs::Costs;
use crate::geometry::Aabb;
use crate::progress::Cancelled;
use crate::structure::node::StopReason;
use std::sync::atomic::{AtomicU64, Ordering};

/// A division of a node's references with its cost: the areas of both boxes, each multiplied by the number
/// of blocks that its references take.
#[derive(Clone, Copy, Debug)]
pub struct Split<D> {
    pub how: D,
    pub cost: f64,
}

/// How a builder divides the references of a node.
pub trait Divide: Sync {
    /// The references of a node.
    type References: Send;
    /// A way to divide them.
    type How;
    /// Memory that is reused for the next node.
    type Memory: Default + Send;

    /// Returns the number of references, at least 1.
    fn count(&self, references: &Self::References) -> usize;

    /// Returns the bounds of all references.
    fn bounds(&self, input: &Input<'_>, references: &Self::References) -> Aabb;

    /// Returns the objects of all references.
    fn objects(&self, references: &Self::References) -> impl Iterator<Item = u32>;

    /// Returns the cheapest division; `None` if the centers coincide.
    fn cheapest(
        &self,
        input: &Input<'_>,
        references: &mut Self::References,
        bounds: &Aabb,
        memory: &mut Self::Memory,
    ) -> Option<Split<Self::How>>;

    /// Divides the references.
    fn divide(
        &self,
        input: &Input<'_>,
        references: Self::References,
        how: Self::How,
    ) -> [Self::References; 2];

    /// Divides the references in two halves along the longest axis of their centers; of equal centers, by
    /// object number.
    fn halve(&self, input: &Input<'_>, references: Self::References) -> [Self::References; 2];
}

/// Subtrees of nodes with more references may be built at the same time.
const TASK: usize = 1 << 12;

/// Tasks per thread, about. More would balance better, but the results of all are copied.
const TASKS_PER_THREAD: usize = 16;

/// Nodes with more references always check for cancellation.
const LARGE: usize = 1 << 8;

struct Driver<'a, D> {
    divide: &'a D,
    input: &'a Input<'a>,
    costs: Costs,
    /// References in finished leaves.
    done: AtomicU64,
    all: usize,
    /// Subtrees of nodes with more references are built at the same time.
    task: usize,
}

/// Builds a hierarchy of references from the root downward.
pub fn build<D: Divide>(
    divide: &D,
    root: D::References,
    costs: Costs,
    input: &Input<'_>,
) -> Result<Binary, Cancelled> {
    let (all, threads) = (divide.count(&root), rayon::current_num_threads());
    let driver = Driver {
        divide,
        input,
        costs,
        done: AtomicU64::new(0),
        all,
        task: match threads {
            1 => all,
            _ => TASK.max(all / (TASKS_PER_THREAD * threads)),
        },
    };
    let mut built = Binary::default();
    driver.node(&mut built, root, 0, &mut D::Memory::default())?;
    Ok(built)
}

impl<D: Divide> Driver<'_, D> {
    /// Builds the subtree of references and returns the index of its root.
    fn node(
        &self,
        built: &mut Binary,
        mut references: D::References,
        depth: u32,
        memory: &mut D::Memory,
    ) -> Result<u32, Cancelled> {
        let count = self.divide.count(&references);
        if count > LARGE || built.nodes.len().is_multiple_of(64) {
            self.input.progress.check()?;
        }
        let bounds = self.divide.bounds(self.input, &references);
        let split = match self.decide(&mut references, &bounds, depth, memory) {
            Ok(split) => split,
            Err(stop) => {
                let before = self.done.fetch_add(count as u64, Ordering::Relaxed);
                let done = (before + count as u64) as f64;
                self.input.progress.set(done / self.all as f64);
                return Ok(built.leaf(bounds, self.divide.objects(&references), stop));
            }
        };
        let [left, right] = match split {
            Some(how) => self.divide.divide(self.input, references, how),
            None => self.divide.halve(self.input, references),
        };
        let children = if count > self.task {
            let separately = || {
                let (mut part, mut memory) = (Binary::default(), D::Memory::default());
                let root = self.node(&mut part, right, depth + 1, &mut memory);
                root.map(|_| part)
            };
            let here = || self.node(built, left, depth + 1, memory);
            let (left, right) = rayon::join(here, separately);
            [left?, built.append(right?)]
        } else {
            [
                self.node(built, left, depth + 1, memory)?,
                self.node(built, right, depth + 1, memory)?,
            ]
        };
        Ok(built.inner(children))
    }

    /// Returns how the references are divided, where `None` halves them; or why they become a leaf.
    fn decide(
        &self,
        references: &mut D::References,
        bounds: &Aabb,
        depth: u32,
        memory: &mut D::Memory,
    ) -> Result<Option<D::How>, StopReason> {
        let count = self.divide.count(references);
        let Costs {
            traversal,
            test,
            max_leaf,
            min_leaf,
            ..
        } = self.costs;
        if count <= min_leaf.max(1) {
            return Err(StopReason::FewObjects);
        }
        if depth >= self.input.depth_limit {
            return Err(StopReason::MaxDepth);
        }
        // Below this node, even halves would reach D_MAX with too many objects.
        let levels = self.input.depth_limit - depth;
        if levels < 64 && count as u128 > (max_leaf as u128) << levels {
            return Ok(None);
        }
        let split = self.divide.cheapest(self.input, references, bounds, memory);
        let leaf_may_do = count <= max_leaf;
        match split {
            None if leaf_may_do => Err(StopReason::CentersCoincide),
            None => Ok(None),
            Some(split) => {
                let area = bounds.surface_area();
                let leaf_cost = test * self.costs.blocks(count) * area;
                if leaf_may_do && leaf_cost <= traversal * area + test * split.cost {
                    return Err(StopReason::LeafIsCheaper);
                }
                Ok(Some(split.how))
            }
        }
    }
}
