//! The stack of a walk, told from its steps.

use super::{Children, RayPath, Step};

/// A far child that waits for its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PendingNode {
    /// Index of the node.
    pub node: u32,
    /// Where on the ray the node's cell lies between, widened by rounding.
    pub t_enter: f64,
    pub t_exit: f64,
}

impl RayPath {
    /// The nodes that wait once a step is done; the last of them is the next to be visited. Empty
    /// where there is no such step.
    pub fn pending(&self, step: usize) -> Vec<PendingNode> {
        let mut stack = Vec::new();
        for (i, taken) in self.steps.iter().enumerate().take(step + 1) {
            match taken {
                Step::Inner(inner) if inner.children == Children::Both => stack.push(PendingNode {
                    node: inner.far,
                    t_enter: inner.t_far,
                    t_exit: inner.t_exit,
                }),
                // LeafOutcome a leaf, the walk goes on with the last that waits.
                Step::Leaf(_) if i < step => {
                    stack.pop();
                }
                _ => {}
            }
        }
        stack
    }
}
