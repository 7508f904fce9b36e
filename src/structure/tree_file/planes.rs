//! The nodes of a tree with planes from those of a file.

use super::columns::Columns;
use super::error::TreeFileError;
use super::faults::{FaultKind, Faults};
use super::graph::{Graph, Placed, check_now_and_then};
use crate::geometry::Axis;
use crate::progress::Progress;
use crate::structure::node::Node;
use crate::structure::voxels::Voxels;

/// The planes of a file, for each of its nodes.
pub struct Planes<'a> {
    pub axis: &'a [u8],
    /// In local coordinates.
    pub plane: Vec<f32>,
}

/// Makes the children of inner nodes, given as two arrays, those of a graph: returns where they are for each
/// node, how many there are, and all of them.
///
/// # Errors
/// An array is missing or has another shape.
pub fn children_of(
    columns: &Columns<'_>,
    leaf: &[u8],
    mut first: Vec<u32>,
    mut count: Vec<u32>,
) -> Result<[Vec<u32>; 3], TreeFileError> {
    let rows = Some(leaf.len());
    let (below, above) = (columns.u32s("below", rows)?, columns.u32s("above", rows)?);
    let mut child = Vec::new();
    for node in (0..leaf.len()).filter(|&node| leaf[node] == 0) {
        (first[node], count[node]) = (child.len() as u32, 2);
        child.extend([below[node], above[node]]);
    }
    Ok([first, count, child])
}

impl Planes<'_> {
    /// Returns the nodes in depth-first order with their references, and counts what is wrong with planes.
    ///
    /// # Errors
    /// Cancellation.
    pub fn lay_out(
        &self,
        graph: &Graph<'_>,
        order: &[Placed],
        faults: &mut Faults,
        progress: &Progress,
    ) -> Result<(Vec<Node>, Vec<u32>), TreeFileError> {
        let mut place = vec![0; graph.leaf.len()];
        for (i, placed) in order.iter().enumerate() {
            place[placed.node as usize] = i as u32;
        }
        let (mut nodes, mut references) = (Vec::with_capacity(order.len()), Vec::new());
        let mut cells = vec![[[-1.0_f32, 1.0]; 3]];
        for (i, placed) in order.iter().enumerate() {
            check_now_and_then(i, progress)?;
            let node = placed.node;
            let cell = cells.pop().unwrap_or_default();
            if graph.is_leaf(node) {
                let first = references.len() as u32;
                let count = graph.copy_objects(node, &mut references, faults);
                nodes.push(Node::leaf(first, count, graph.stop(node)));
                continue;
            }
            let (axis, plane) = (self.axis[node as usize], self.plane[node as usize]);
            let k = usize::from(axis.min(2));
            if axis > 2 {
                faults.add(FaultKind::Axis, || {
                    format!("node {node}: its axis is {axis}; expected 0, 1 or 2")
                });
            }
            let [lo, hi] = cell[k];
            if !(lo < plane && plane < hi) {
                faults.add(FaultKind::Plane, || {
                    format!(
                        "node {node}: its plane at {plane} is not inside its cell, {lo} to {hi}"
                    )
                });
            }
            let (mut below, mut above) = (cell, cell);
            (below[k][1], above[k][0]) = (plane, plane);
            cells.extend([above, below]);
            let upper = graph.children(node).get(1).copied().unwrap_or_default();
            nodes.push(Node::inner(
                Axis::from_index(k),
                plane,
                place[upper as usize],
            ));
        }
        Ok((nodes, references))
    }
}

/// Returns the voxels of a grid; `None` if its planes have many more between them than there are leaves.
pub fn voxels_of(nodes: &[Node], faults: &mut Faults) -> Option<Voxels> {
    /// A leaf can be several voxels where an end was put to splitting.
    const VOXELS_PER_NODE: usize = 8;
    let found = Voxels::at_most(VOXELS_PER_NODE * nodes.len(), nodes);
    if found.is_none() {
        faults.add(FaultKind::Grid, || {
            "not a grid: many planes do not extend through the root cell".into()
        });
    }
    found
}
