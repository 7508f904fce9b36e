//! The selected cell with its split plane, as lines and translucent faces, and the cells along a
//! ray.

use super::lines::{Line, box_lines};
use crate::geometry::{Aabb, Axis, Ray, Vec3};
use crate::structure::{CellOfNode, Tree};

/// A vertex of a translucent triangle, relative to a center.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct FaceCorner {
    pub place: [f32; 3],
    /// sRGB and opacity.
    pub color: [u8; 4],
}

/// The color of the selected cell and its split plane. No coloring of leaves and no ray uses it.
pub const CELL_COLOR: [u8; 3] = [255, 176, 0];
pub const PLANE_COLOR: [u8; 3] = [90, 200, 255];

/// The color of what the boxes of a node's children have in common.
pub const OVERLAP_COLOR: [u8; 3] = [200, 160, 255];

/// The color of the leaves that contain the selected object.
pub const REFERRING_COLOR: [u8; 3] = [255, 80, 70];

/// Returns the edges of a cell, and the outline and diagonals of its split plane, if any.
pub fn cell_lines(cell: &Aabb, plane: Option<(Axis, f64)>, center: Vec3) -> Vec<Line> {
    let [r, g, b] = CELL_COLOR;
    let mut lines = box_lines(cell, center, [r, g, b, 255], 3.5);
    if let Some(quad) = plane.map(|(axis, at)| quad(cell, axis, at)) {
        let [r, g, b] = PLANE_COLOR;
        for [a, c] in [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]] {
            lines.push(Line {
                a: (quad[a] - center).as_vec3().to_array(),
                b: (quad[c] - center).as_vec3().to_array(),
                color: [r, g, b, 255],
                width: 2.0,
            });
        }
    }
    lines
}

/// Returns the faces of a cell and its split plane as triangles.
pub fn cell_faces(cell: &Aabb, plane: Option<(Axis, f64)>, center: Vec3) -> Vec<FaceCorner> {
    let mut faces = Vec::new();
    let mut add = |quad: [Vec3; 4], [r, g, b]: [u8; 3], cover: u8| {
        faces.extend([0, 1, 2, 0, 2, 3].map(|corner| FaceCorner {
            place: (quad[corner] - center).as_vec3().to_array(),
            color: [r, g, b, cover],
        }));
    };
    for axis in Axis::ALL {
        for at in [cell.lo[axis.index()], cell.hi[axis.index()]] {
            add(quad(cell, axis, at), CELL_COLOR, 40);
        }
    }
    if let Some((axis, at)) = plane {
        add(quad(cell, axis, at), PLANE_COLOR, 110);
    }
    faces
}

/// Returns the edges of the boxes of a node's children.
pub fn child_lines(children: &[Aabb], center: Vec3) -> Vec<Line> {
    let [r, g, b] = PLANE_COLOR;
    let lines = children.iter();
    lines
        .flat_map(|child| box_lines(child, center, [r, g, b, 255], 2.0))
        .collect()
}

/// Returns the faces of what boxes have in common, as triangles.
pub fn overlap_faces(boxes: &[Aabb], center: Vec3) -> Vec<FaceCorner> {
    let [r, g, b] = OVERLAP_COLOR;
    let quads = overlaps(boxes).into_iter().flat_map(|shared| {
        let sides = move |axis: Axis| [shared.lo[axis.index()], shared.hi[axis.index()]];
        Axis::ALL
            .into_iter()
            .flat_map(move |axis| sides(axis).map(|at| quad(&shared, axis, at)))
    });
    quads
        .flat_map(|quad| [0, 1, 2, 0, 2, 3].map(|corner| quad[corner]))
        .map(|corner| FaceCorner {
            place: (corner - center).as_vec3().to_array(),
            color: [r, g, b, 80],
        })
        .collect()
}

/// Returns what each two of these boxes have in common. Boxes that only touch have nothing in common; the
/// boxes of a tree are a little larger than what they hold.
pub fn overlaps(boxes: &[Aabb]) -> Vec<Aabb> {
    /// The share of the smaller box's width that a common part has at least.
    const LEAST: f64 = 1e-3;
    let mut found = Vec::new();
    for (i, a) in boxes.iter().enumerate() {
        for b in &boxes[i + 1..] {
            let shared = a.intersection(b);
            let least = LEAST * a.size().min(b.size());
            if (shared.hi - shared.lo).cmpge(least).all() && shared.surface_area() > 0.0 {
                found.push(shared);
            }
        }
    }
    found
}

/// Returns the volume of what each two of these boxes have in common, as a share of the volume of a box around
/// them; `None` if that box has no volume.
pub fn overlap_share(around: &Aabb, boxes: &[Aabb]) -> Option<f64> {
    let volume = around.volume();
    let shared: f64 = overlaps(boxes).iter().map(Aabb::volume).sum();
    (volume > 0.0).then(|| shared / volume)
}

/// Returns the rectangle where a plane intersects a cell, as corners in order.
fn quad(cell: &Aabb, axis: Axis, at: f64) -> [Vec3; 4] {
    let (k, u, v) = (
        axis.index(),
        axis.next().index(),
        axis.next().next().index(),
    );
    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| {
        let mut corner = Vec3::ZERO;
        corner[k] = at;
        corner[u] = [cell.lo[u], cell.hi[u]][a];
        corner[v] = [cell.lo[v], cell.hi[v]][b];
        corner
    })
}

/// Returns the leaves in a cell that a ray passes through, nearest first; below a depth, the cells at that
/// depth. Objects do not stop the ray. The cell in which the ray starts is not included.
pub fn cells_along(tree: &Tree, from: CellOfNode, ray: &Ray, depth: u32) -> Vec<CellOfNode> {
    let mut found: Vec<(f64, CellOfNode)> = Vec::new();
    let mut stack = vec![from];
    while let Some(cell) = stack.pop() {
        let Some(enter) = entry(&cell.bounds, ray) else {
            continue;
        };
        let from = stack.len();
        if cell.depth < depth {
            stack.extend(tree.children(&cell));
        }
        if stack.len() == from && enter > ray.t_min {
            found.push((enter, cell));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, cell)| cell).collect()
}

/// Returns the ray parameter where a ray enters a box. Returns its start if it starts inside, and
/// `None` if it misses.
fn entry(bounds: &Aabb, ray: &Ray) -> Option<f64> {
    let (mut enter, mut exit) = (ray.t_min, ray.t_max);
    for k in 0..3 {
        let (origin, direction) = (ray.origin[k], ray.direction[k]);
        if direction == 0.0 {
            if origin < bounds.lo[k] || origin > bounds.hi[k] {
                return None;
            }
            continue;
        }
        let a = (bounds.lo[k] - origin) / direction;
        let b = (bounds.hi[k] - origin) / direction;
        enter = enter.max(a.min(b));
        exit = exit.min(a.max(b));
    }
    (enter < exit).then_some(enter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::{BuildSettings, build};

    #[test]
    fn a_ray_from_outside_passes_leaves_without_gaps() {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:1"), &progress).unwrap();
        let tree = build(&scene, &BuildSettings::default(), &progress).unwrap();
        let root = tree.root_cell();
        let direction = Vec3::new(0.31, 0.84, -0.05).normalize();
        let ray = Ray::new(root.center() - direction * root.size().length(), direction);
        let leaves = cells_along(&tree, tree.root(), &ray, u32::MAX);
        assert!(leaves.len() > 2);
        for pair in leaves.windows(2) {
            let gap = pair[0].bounds.intersection(&pair[1].bounds);
            assert!(gap.lo.cmple(gap.hi + 1e-9).all());
        }
        let away = Ray::new(ray.origin, -direction);
        assert!(cells_along(&tree, tree.root(), &away, u32::MAX).is_empty());
    }

    #[test]
    fn boxes_overlap_where_they_have_more_than_a_face_in_common() {
        let at = |x: f64| Aabb::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0));
        let around = Aabb::new(Vec3::ZERO, Vec3::new(1.5, 1.0, 1.0));
        assert_eq!(overlap_share(&around, &[at(0.0), at(0.5)]), Some(0.5 / 1.5));
        assert_eq!(overlap_faces(&[at(0.0), at(0.5)], Vec3::ZERO).len(), 36);
        for apart in [1.0, 0.9999, 2.0] {
            assert!(overlaps(&[at(0.0), at(apart)]).is_empty(), "{apart}");
        }
        // Three boxes have three pairs.
        assert_eq!(overlaps(&[at(0.0), at(0.25), at(0.5)]).len(), 3);
        let flat = |x: f64| Aabb::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 0.0));
        assert_eq!(overlaps(&[flat(0.0), flat(0.5)]).len(), 1);
        assert_eq!(overlap_share(&flat(0.0), &[flat(0.0)]), None);
        assert_eq!(child_lines(&[at(0.0), at(0.5)], Vec3::ZERO).len(), 24);
    }

    #[test]
    fn a_cell_has_twelve_edges_and_six_faces_and_a_plane_adds_its_own() {
        let cell = Aabb::new(Vec3::ZERO, Vec3::ONE);
        assert_eq!(cell_lines(&cell, None, Vec3::ZERO).len(), 12);
        assert_eq!(cell_faces(&cell, None, Vec3::ZERO).len(), 36);
        let plane = Some((Axis::Y, 0.25));
        assert_eq!(cell_lines(&cell, plane, Vec3::ZERO).len(), 18);
        let faces = cell_faces(&cell, plane, Vec3::ZERO);
        assert!(faces[36..].iter().all(|corner| corner.place[1] == 0.25));
    }
}
