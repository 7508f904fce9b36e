//! The stack of a recorded traversal, derived from its steps.

use super::{Children, RayPath, Step};

/// A node that is pending on the stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PendingNode {
    /// Index of the node.
    pub node: u32,
    /// The interval of the ray within the node's cell, widened for rounding.
    pub t_enter: f64,
    pub t_exit: f64,
}

impl RayPath {
    /// Returns the nodes that are pending after a step; the last is visited next. Empty if there is no such
    /// step.
    pub fn pending(&self, step: usize) -> Vec<PendingNode> {
        let mut stack = Vec::new();
        for (i, taken) in self.steps.iter().enumerate().take(step + 1) {
            // Whether traversal resumes with the last pending node.
            let mut resumes = true;
            match taken {
                Step::Inner(inner) => {
                    resumes = false;
                    if inner.children == Children::Both {
                        stack.push(PendingNode {
                            node: inner.far,
                            t_enter: inner.t_far,
                            t_exit: inner.t_exit,
                        });
                    }
                }
                Step::Boxes(boxes) => {
                    stack.extend(boxes.entered().into_iter().rev().map(|test| PendingNode {
                        node: test.node,
                        t_enter: test.within[0],
                        t_exit: test.within[1],
                    }));
                }
                Step::Leaf(_) | Step::Culled(_) => {}
            }
            if resumes && i < step {
                stack.pop();
            }
        }
        stack
    }
}
