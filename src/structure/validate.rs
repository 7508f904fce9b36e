//! Validation of a finished tree, independent of the build driver.

use super::node::NodeKind;
use super::nodes::Nodes;
use super::tree::Tree;
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::scene::Scene;

/// An invariant that a tree violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    #[error("node {0} has a child outside the array or before itself")]
    Child(u32),
    #[error("node {0}: the plane is not inside the cell")]
    Plane(u32),
    #[error("only {reached} of {nodes} nodes are reachable from the root")]
    Reach { reached: usize, nodes: usize },
    #[error(
        "leaf {0} has a reference outside the array, to a missing object, or twice to the same object"
    )]
    Reference(u32),
    #[error("leaf {node} is at depth {depth}, beyond D_MAX")]
    Depth { node: u32, depth: u32 },
    #[error("the volume of all leaves is {leaves}, but that of the root is {root}")]
    Volume { leaves: f64, root: f64 },
    #[error("{leaves} leaves for {inner} inner nodes")]
    Count { leaves: usize, inner: usize },
    #[error("object {object} overlaps leaf {node}, which does not refer to it")]
    Missing { node: u32, object: u32 },
    #[error("the box of node {0} extends beyond that of its parent")]
    Outside(u32),
    #[error("the boxes of the leaves that refer to object {0} do not cover it")]
    Uncovered(u32),
}

/// Checks structure, depth, volumes and counts. For every leaf of cells and a sample of the objects, also
/// checks that the leaf refers to every object that overlaps the interior of its cell. Of a bounding volume
/// hierarchy, checks that boxes contain those below them, and that the boxes of leaves cover every object.
///
/// # Errors
/// The first violation found.
pub fn validate(scene: &Scene, tree: &Tree) -> Result<(), Invalid> {
    match tree.nodes() {
        Nodes::Planes(_) => validate_cells(scene, tree),
        Nodes::Boxes(_) => validate_boxes(scene, tree),
    }
}

/// Checks that a leaf has references to objects that exist, in ascending order.
fn check_leaf(scene: &Scene, tree: &Tree, node: u32) -> Result<(), Invalid> {
    if let NodeKind::Leaf { first, count, .. } = tree.kind(node)
        && (first as usize + count as usize) > tree.references().len()
    {
        return Err(Invalid::Reference(node));
    }
    let objects = tree.leaf_objects(node);
    let ascending = objects.windows(2).all(|pair| pair[0] < pair[1]);
    let exist = objects
        .iter()
        .all(|&object| (object as usize) < scene.objects().len());
    if ascending && exist {
        Ok(())
    } else {
        Err(Invalid::Reference(node))
    }
}

fn validate_boxes(scene: &Scene, tree: &Tree) -> Result<(), Invalid> {
    let nodes = tree.nodes().len();
    let mut covered = vec![Aabb::EMPTY; scene.objects().len()];
    let contains = |outer: &Aabb, inner: &Aabb| {
        outer.lo.cmple(inner.lo).all() && inner.hi.cmple(outer.hi).all()
    };
    let mut reached = 0;
    for cell in tree.cells() {
        reached += 1;
        let node = cell.node;
        if cell.depth > tree.depth_reached() {
            let depth = cell.depth;
            return Err(Invalid::Depth { node, depth });
        }
        let mut before = node;
        for child in tree.children(&cell) {
            if child.node <= before || child.node as usize >= nodes {
                return Err(Invalid::Child(node));
            }
            before = child.node;
            if !contains(&cell.bounds, &child.bounds) {
                return Err(Invalid::Outside(child.node));
            }
        }
        check_leaf(scene, tree, node)?;
        for &object in tree.leaf_objects(node) {
            let covered = &mut covered[object as usize];
            *covered = covered.union(&cell.bounds);
        }
    }
    if reached != nodes {
        return Err(Invalid::Reach { reached, nodes });
    }
    let mut objects = scene.objects().iter().zip(&covered).zip(0..);
    match objects.find(|((object, covered), _)| !contains(covered, &object.bounds())) {
        Some((_, object)) => Err(Invalid::Uncovered(object)),
        None => Ok(()),
    }
}

fn validate_cells(scene: &Scene, tree: &Tree) -> Result<(), Invalid> {
    let nodes = tree.nodes().len();
    let (mut reached, mut leaves, mut inner, mut volume) = (0, 0, 0, 0.0);
    // Overlap tests are conservative within rounding. An object that overlaps a cell only by a
    // sliver, or by less than the tolerance, does not count as missing.
    let uncertain = tree.root_cell().size().max_element() * 1e-10;
    // Every leaf against a stride of objects: exhaustive for small trees, about 10⁷ pairs for
    // large.
    let stride = (scene.objects().len() * nodes / 10_000_000).max(1);
    for cell in tree.cells() {
        reached += 1;
        let node = cell.node;
        match tree.kind(node) {
            NodeKind::Inner => {
                inner += 1;
                let mut before = node;
                for child in tree.child_nodes(node) {
                    if child <= before || child as usize >= nodes {
                        return Err(Invalid::Child(node));
                    }
                    before = child;
                }
                let is_divided = tree.plane(node).is_some_and(|(axis, plane)| {
                    let k = axis.index();
                    cell.bounds.lo[k] < plane && plane < cell.bounds.hi[k]
                });
                if !is_divided {
                    return Err(Invalid::Plane(node));
                }
            }
            NodeKind::Leaf { .. } => {
                leaves += 1;
                volume += cell.bounds.volume();
                if cell.depth > tree.depth_limit() && tree.voxels().is_none() {
                    return Err(Invalid::Depth {
                        node,
                        depth: cell.depth,
                    });
                }
                check_leaf(scene, tree, node)?;
                let objects = tree.leaf_objects(node);
                let margin = cell.bounds.size() * 1e-6 + uncertain;
                let inside = Aabb::new(cell.bounds.lo + margin, cell.bounds.hi - margin);
                if inside.is_empty() {
                    continue;
                }
                for object in (node as usize % stride..scene.objects().len()).step_by(stride) {
                    let primitive = &scene.objects()[object];
                    let object = object as u32;
                    if primitive.bounds().touches(&inside)
                        && objects.binary_search(&object).is_err()
                        && primitive.overlaps(&inside)
                    {
                        return Err(Invalid::Missing { node, object });
                    }
                }
            }
        }
    }
    if reached != nodes {
        return Err(Invalid::Reach { reached, nodes });
    }
    if leaves != inner + 1 {
        return Err(Invalid::Count { leaves, inner });
    }
    let root = tree.root_cell().volume();
    // Each volume is rounded a few times, and the sum once per leaf.
    if (volume - root).abs() > root * f64::EPSILON * (16 + leaves) as f64 {
        return Err(Invalid::Volume {
            leaves: volume,
            root,
        });
    }
    Ok(())
}
