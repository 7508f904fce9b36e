//! The voxels of a uniform grid by position, so that rays can step from one to the next.

use super::node::Node;

/// All voxels of a grid with their leaves, and the planes between them.
#[derive(Debug)]
pub struct Voxels {
    /// Per axis, ascending, in local coordinates.
    planes: [Vec<f32>; 3],
    /// x varies fastest, then y.
    voxels: Vec<Voxel>,
}

/// The leaf of a voxel, and the index of that node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Voxel {
    pub(crate) leaf: Node,
    pub(crate) node: u32,
}

impl Voxels {
    /// Collects the voxels of a tree in which every plane extends through the whole root cell.
    pub(super) fn of(nodes: &[Node]) -> Self {
        Voxels::between(planes_of(nodes), nodes)
    }

    /// Collects the voxels between all planes of a tree; `None` if there are more than `most`.
    pub(super) fn at_most(most: usize, nodes: &[Node]) -> Option<Self> {
        let planes = planes_of(nodes);
        let mut counts = planes.iter().map(|planes| planes.len() + 1);
        let count = counts.try_fold(1_usize, usize::checked_mul);
        count.filter(|&count| count <= most)?;
        Some(Voxels::between(planes, nodes))
    }

    fn between(planes: [Vec<f32>; 3], nodes: &[Node]) -> Self {
        let counts = planes.each_ref().map(|planes| planes.len() + 1);
        let first = Voxel {
            leaf: nodes[0],
            node: 0,
        };
        let mut voxels = Voxels {
            planes,
            voxels: vec![first; counts.iter().product()],
        };
        let mut stack = vec![(0_u32, counts.map(|count| [0, count]))];
        while let Some((node, ranges)) = stack.pop() {
            let at = nodes[node as usize];
            if at.is_leaf() {
                voxels.fill(ranges, at, node);
                continue;
            }
            let (k, plane, above) = at.as_inner();
            let (mut lower, mut upper) = (ranges, ranges);
            let middle = 1 + voxels.planes[k].partition_point(|&p| p < plane);
            (lower[k][1], upper[k][0]) = (middle, middle);
            stack.extend([(node + 1, lower), (above, upper)]);
        }
        voxels
    }

    fn fill(&mut self, [x, y, z]: [[usize; 2]; 3], leaf: Node, node: u32) {
        for z in z[0]..z[1] {
            for y in y[0]..y[1] {
                for x in x[0]..x[1] {
                    let index = self.index([x, y, z]);
                    self.voxels[index] = Voxel { leaf, node };
                }
            }
        }
    }

    #[inline]
    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.counts();
        x + nx * (y + ny * z)
    }

    /// Returns the number of voxels along each axis.
    #[inline]
    pub fn counts(&self) -> [usize; 3] {
        self.planes.each_ref().map(|planes| planes.len() + 1)
    }

    /// Returns the planes between voxels along an axis (0 to 2), ascending, in local coordinates.
    #[inline]
    pub(crate) fn planes(&self, axis: usize) -> &[f32] {
        &self.planes[axis]
    }

    /// Returns the voxel with the given indices along each axis.
    #[inline]
    pub(crate) fn at(&self, place: [usize; 3]) -> Voxel {
        self.voxels[self.index(place)]
    }

    /// Bytes of a voxel.
    pub(super) const VOXEL_BYTES: usize = size_of::<Voxel>();

    pub(super) fn bytes(&self) -> usize {
        let planes: usize = self.planes.iter().map(|p| size_of_val(p.as_slice())).sum();
        planes + size_of_val(self.voxels.as_slice())
    }
}

/// Returns the planes along each axis, ascending, each once.
fn planes_of(nodes: &[Node]) -> [Vec<f32>; 3] {
    let mut planes = [const { Vec::new() }; 3];
    for node in nodes.iter().filter(|node| !node.is_leaf()) {
        let (axis, plane, _) = node.as_inner();
        planes[axis].push(plane);
    }
    for planes in &mut planes {
        planes.sort_unstable_by(f32::total_cmp);
        planes.dedup();
        planes.shrink_to_fit();
    }
    planes
}
