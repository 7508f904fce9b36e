//! The one build driver: termination, distribution of objects, arrays, memory, cancellation.

use super::split::{Cell, Decision, SplitRule};
use super::{BuildSettings, Frame, Node, OverlapRule, SettingsError, StopReason, Tree};
use crate::geometry::{Aabb, Axis};
use crate::primitive::{Primitive, PrimitiveKind, Shape};
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;

/// Why there is no tree.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(
        "the tree needs more than the memory limit of {} MiB: stopped at depth {depth} after \
         {nodes} nodes and {references} references; lower D_MAX, raise N_OILF or the limit",
        .limit >> 20
    )]
    MemoryLimit {
        /// Bytes.
        limit: u64,
        depth: u32,
        nodes: usize,
        references: usize,
    },
    #[error("the scene has {0} objects; a tree can hold {most}", most = Node::MAX_LEAF - 1)]
    TooManyObjects(usize),
}

/// Builds the tree of a scene. The same scene and settings give the same tree, always.
///
/// A scene without objects gives a tree of one empty leaf.
///
/// # Errors
/// Settings out of range, cancellation, or a tree that would not fit the memory limit.
pub fn build(
    scene: &Scene,
    settings: &BuildSettings,
    progress: &Progress,
) -> Result<Tree, BuildError> {
    settings.check()?;
    let objects = scene.objects();
    if objects.len() >= Node::MAX_LEAF {
        return Err(BuildError::TooManyObjects(objects.len()));
    }
    let frame = Frame::around(&scene.bounds(), settings.root_margin);
    let depth_limit = settings.d_max.resolve(objects.len());
    let rule = (settings.method.rule)(settings);
    let mut driver = Driver {
        overlap: Overlap::new(settings, objects, frame.slack()),
        frame: &frame,
        rule: rule.as_ref(),
        settings,
        depth_limit,
        progress,
        bounds: objects.iter().map(Shape::bounds).collect(),
        nodes: Vec::new(),
        references: Vec::new(),
        waiting: (0..objects.len() as u32).collect(),
        depth_reached: 0,
        done: 0.0,
    };
    driver.check_memory(0, 0, 0)?;
    driver.cell(frame.cell(), [[-1.0, 1.0]; 3], 0, 0)?;
    let Driver {
        mut nodes,
        mut references,
        depth_reached,
        ..
    } = driver;
    nodes.shrink_to_fit();
    references.shrink_to_fit();
    Ok(Tree {
        nodes,
        references,
        frame,
        settings: settings.clone(),
        depth_limit,
        depth_reached,
        derived: Default::default(),
    })
}

/// Decides whether an object belongs to a cell into whose parent it came.
struct Overlap<'a> {
    objects: &'a [Primitive],
    /// The kinds held against the cell exactly; all others by their bounds.
    exact: [bool; PrimitiveKind::ALL.len()],
    slack: f64,
}

impl<'a> Overlap<'a> {
    fn new(settings: &BuildSettings, objects: &'a [Primitive], slack: f64) -> Self {
        let exact = PrimitiveKind::ALL.map(|kind| match settings.overlap {
            OverlapRule::Paper => {
                kind == PrimitiveKind::Sphere && settings.method.paper_spheres_exactly
            }
            OverlapRule::Bounds => false,
            OverlapRule::Exact => true,
        });
        Overlap {
            objects,
            exact,
            slack,
        }
    }

    fn belongs(&self, object: u32, bounds: &Aabb, cell: &Aabb, split_axis: Axis) -> bool {
        let k = split_axis.index();
        let near =
            bounds.lo[k] <= cell.hi[k] + self.slack && bounds.hi[k] >= cell.lo[k] - self.slack;
        near && {
            let primitive = &self.objects[object as usize];
            !self.exact[primitive.kind() as usize] || primitive.overlaps(&cell.enlarged(self.slack))
        }
    }
}

/// A cell in the coordinates of the root cell: lower and upper end by axis.
type Local = [[f32; 2]; 3];

/// The parts of a cell below and above a slab, which has no thickness for a split.
fn beside(local: Local, axis: Axis, slab: [f32; 2]) -> [Local; 2] {
    let (mut below, mut above) = (local, local);
    below[axis.index()][1] = slab[0];
    above[axis.index()][0] = slab[1];
    [below, above]
}

struct Driver<'a> {
    overlap: Overlap<'a>,
    frame: &'a Frame,
    rule: &'a dyn SplitRule,
    settings: &'a BuildSettings,
    depth_limit: u32,
    progress: &'a Progress,
    bounds: Vec<Aabb>,
    nodes: Vec<Node>,
    references: Vec<u32>,
    /// Objects of the cells on the way from the root to the cell in work, innermost last.
    waiting: Vec<u32>,
    depth_reached: u32,
    /// Share of the work that is done, where every level counts half as much as the one above.
    done: f64,
}

impl Driver<'_> {
    /// Builds the subtree of a cell whose objects are `waiting[from..]`.
    fn cell(
        &mut self,
        bounds: Aabb,
        local: Local,
        from: usize,
        depth: u32,
    ) -> Result<(), BuildError> {
        let decision = {
            let cell = Cell {
                frame: self.frame,
                bounds,
                local,
                depth,
                depth_limit: self.depth_limit,
                objects: &self.waiting[from..],
                object_bounds: &self.bounds,
            };
            let decision = if cell.objects.is_empty() {
                Decision::Leaf(StopReason::Empty)
            } else if cell.objects.len() <= self.settings.n_oilf as usize {
                Decision::Leaf(StopReason::FewObjects)
            } else if depth >= self.depth_limit {
                Decision::Leaf(StopReason::MaxDepth)
            } else {
                self.rule.decide(&cell)
            };
            match decision {
                Decision::Split { axis, plane } if !cell.divides(axis, plane) => {
                    Decision::Leaf(StopReason::TooThin)
                }
                Decision::Cut { axis, slab } => {
                    debug_assert!(slab.iter().all(|&p| cell.divides(axis, p)) && slab[0] < slab[1]);
                    decision
                }
                _ => decision,
            }
        };
        match decision {
            Decision::Leaf(stop) => self.leaf(from, depth, stop),
            Decision::Split { axis, plane } => self.split(bounds, local, from, depth, axis, plane),
            Decision::Cut { axis, slab } => self.cut(bounds, local, from, depth, axis, slab),
        }
    }

    fn leaf(&mut self, from: usize, depth: u32, stop: StopReason) -> Result<(), BuildError> {
        let count = self.waiting.len() - from;
        self.check_memory(depth, 1, count)?;
        self.nodes
            .push(Node::leaf(self.references.len() as u32, count as u32, stop));
        self.references.extend_from_slice(&self.waiting[from..]);
        self.depth_reached = self.depth_reached.max(depth);
        self.done += libm::exp2(-f64::from(depth));
        if self.nodes.len().is_multiple_of(64) {
            self.progress.check()?;
            self.progress.set(self.done);
        }
        Ok(())
    }

    fn split(
        &mut self,
        bounds: Aabb,
        local: Local,
        from: usize,
        depth: u32,
        axis: Axis,
        plane: f32,
    ) -> Result<(), BuildError> {
        let world = self.frame.to_world(axis, f64::from(plane));
        let (below, above) = bounds.split(axis, world);
        let [local_below, local_above] = beside(local, axis, [plane, plane]);
        let node = self.inner(depth)?;
        self.child(below, local_below, from, depth, axis)?;
        self.close(node, axis, plane);
        self.child(above, local_above, from, depth, axis)
    }

    /// Two planes at once: below | empty | above. One level of depth, with two inner nodes.
    fn cut(
        &mut self,
        bounds: Aabb,
        local: Local,
        from: usize,
        depth: u32,
        axis: Axis,
        slab: [f32; 2],
    ) -> Result<(), BuildError> {
        let [first, second] = slab.map(|plane| self.frame.to_world(axis, f64::from(plane)));
        let (below, rest) = bounds.split(axis, first);
        let (_, above) = rest.split(axis, second);
        let [local_below, local_above] = beside(local, axis, slab);
        let outer = self.inner(depth)?;
        self.child(below, local_below, from, depth, axis)?;
        self.close(outer, axis, slab[0]);
        let inner = self.inner(depth)?;
        let nothing = self.waiting.len();
        self.leaf(nothing, depth + 1, StopReason::CutOut)?;
        self.close(inner, axis, slab[1]);
        self.child(above, local_above, from, depth, axis)
    }

    /// Takes over from the parent's objects those of a child, builds it and drops them again.
    fn child(
        &mut self,
        bounds: Aabb,
        local: Local,
        parent_from: usize,
        parent_depth: u32,
        axis: Axis,
    ) -> Result<(), BuildError> {
        let from = self.waiting.len();
        for place in parent_from..from {
            let object = self.waiting[place];
            if self
                .overlap
                .belongs(object, &self.bounds[object as usize], &bounds, axis)
            {
                self.waiting.push(object);
            }
        }
        self.cell(bounds, local, from, parent_depth + 1)?;
        self.waiting.truncate(from);
        Ok(())
    }

    /// Puts an inner node in place whose upper child is not known yet; gives its index.
    fn inner(&mut self, depth: u32) -> Result<usize, BuildError> {
        self.check_memory(depth, 1, 0)?;
        self.nodes.push(Node::inner(Axis::X, 0.0, 0));
        Ok(self.nodes.len() - 1)
    }

    /// The upper child of `node` comes next.
    fn close(&mut self, node: usize, axis: Axis, plane: f32) {
        self.nodes[node] = Node::inner(axis, plane, self.nodes.len() as u32);
    }

    /// Makes room for so many more nodes and references, unless that passes the limit.
    fn check_memory(
        &mut self,
        depth: u32,
        nodes: usize,
        references: usize,
    ) -> Result<(), BuildError> {
        /// Bytes that a vector holds at the worst moment of making room: the old and the new block.
        fn peak<T>(vector: &Vec<T>, more: usize) -> usize {
            let needed = vector.len() + more;
            let capacity = vector.capacity();
            let blocks = if needed <= capacity {
                capacity
            } else {
                capacity + needed.max(2 * capacity)
            };
            blocks * size_of::<T>()
        }
        let bytes = peak(&self.nodes, nodes)
            + peak(&self.references, references)
            + self.waiting.capacity() * size_of::<u32>()
            + self.bounds.capacity() * size_of::<Aabb>();
        let fits = bytes as u64 <= self.settings.memory_limit
            && self.nodes.len() + nodes < Node::MAX_NODES
            && self.references.len() + references < u32::MAX as usize;
        if !fits {
            return Err(BuildError::MemoryLimit {
                limit: self.settings.memory_limit,
                depth,
                nodes: self.nodes.len(),
                references: self.references.len(),
            });
        }
        self.nodes.reserve(nodes);
        self.references.reserve(references);
        Ok(())
    }
}
