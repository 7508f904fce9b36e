//! The volume of the union of a hierarchy's leaves.

use crate::geometry::{Aabb, Vec3};
use crate::progress::{Cancelled, Progress};
use crate::structure::{NodeKind, Tree};
use rayon::prelude::*;

/// Most leaves of which the volume is computed exactly.
const MOST_EXACT: usize = 100_000;

/// Boxes in a cell above which both halves are computed at the same time.
const TASK: usize = 1 << 11;

/// Cells along each axis, with a point in each: 2²² in all.
const POINTS: [usize; 3] = [256, 128, 128];

/// A volume with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Union {
    pub volume: f64,
    /// 0 if the volume is exact.
    pub error: f64,
}

/// Returns the volume of the union of the full leaves of a hierarchy whose nodes have these boxes.
///
/// # Errors
/// Cancellation.
pub fn leaf_union(tree: &Tree, boxes: &[Aabb], progress: &Progress) -> Result<Union, Cancelled> {
    let full = |node: &u32| matches!(tree.kind(*node), NodeKind::Leaf { count: 1.., .. });
    let leaves: Vec<Aabb> = (0..boxes.len() as u32)
        .filter(full)
        .map(|node| boxes[node as usize])
        .collect();
    if leaves.len() > MOST_EXACT {
        return by_points(tree, boxes, progress);
    }
    Ok(Union {
        volume: exact(leaves, &boxes[0], progress)?,
        error: 0.0,
    })
}

/// Returns the volume of the union of boxes that lie within a cell. Divides the cell at the median of the boxes'
/// faces until no box has a face inside of it.
fn exact(mut boxes: Vec<Aabb>, cell: &Aabb, progress: &Progress) -> Result<f64, Cancelled> {
    match boxes[..] {
        [] => return Ok(0.0),
        [a] => return Ok(a.volume()),
        [a, b] => return Ok(a.volume() + b.volume() - a.intersection(&b).volume()),
        _ => {}
    }
    if boxes.iter().any(|b| b == cell) {
        return Ok(cell.volume());
    }
    if boxes.len() > TASK {
        progress.check()?;
    }
    let faces_inside = |k: usize| {
        let faces = boxes.iter().flat_map(move |b| [b.lo[k], b.hi[k]]);
        faces.filter(move |&face| face > cell.lo[k] && face < cell.hi[k])
    };
    let counts = [0, 1, 2].map(|k| faces_inside(k).count());
    let k = (1..3).fold(0, |most, k| if counts[k] > counts[most] { k } else { most });
    if counts[k] == 0 {
        // Only flat boxes do not fill the cell then.
        return Ok(0.0);
    }
    let mut faces: Vec<f64> = faces_inside(k).collect();
    let middle = faces.len() / 2;
    let plane = *faces.select_nth_unstable_by(middle, f64::total_cmp).1;
    drop(faces);
    let (mut below, mut above) = (*cell, *cell);
    (below.hi[k], above.lo[k]) = (plane, plane);
    let mut upper = Vec::with_capacity(boxes.len() / 2 + 1);
    boxes.retain_mut(|b| {
        if b.hi[k] > plane {
            let mut part = *b;
            part.lo[k] = part.lo[k].max(plane);
            upper.push(part);
        }
        b.hi[k] = b.hi[k].min(plane);
        b.lo[k] < plane
    });
    if boxes.len() + upper.len() > TASK {
        let halves = rayon::join(
            || exact(boxes, &below, progress),
            || exact(upper, &above, progress),
        );
        return Ok(halves.0? + halves.1?);
    }
    Ok(exact(boxes, &below, progress)? + exact(upper, &above, progress)?)
}

/// Estimates the volume of the union of all full leaves from fixed points, one in each cell of a grid.
fn by_points(tree: &Tree, boxes: &[Aabb], progress: &Progress) -> Result<Union, Cancelled> {
    let root = boxes[0];
    let [nx, ny, nz] = POINTS;
    let rows: Vec<usize> = (0..ny * nz)
        .into_par_iter()
        .map(|row| {
            if row % 16 == 0 {
                progress.check()?;
            }
            let mut stack = Vec::new();
            let inside = |x: &usize| {
                let place = [*x, row % ny, row / ny];
                let shares = random_shares((row * nx + x) as u64);
                let at = |k: usize| (place[k] as f64 + shares[k]) / POINTS[k] as f64;
                let point = root.lo + root.size() * Vec3::new(at(0), at(1), at(2));
                is_in_leaf(tree, boxes, point, &mut stack)
            };
            Ok((0..nx).filter(inside).count())
        })
        .collect::<Result<_, Cancelled>>()?;
    let all = (nx * ny * nz) as f64;
    let share = rows.iter().sum::<usize>() as f64 / all;
    // That of independent points; with one per cell, it is smaller.
    let error = (share * (1.0 - share) / all).sqrt();
    Ok(Union {
        volume: root.volume() * share,
        error: root.volume() * error,
    })
}

/// Returns whether a full leaf contains a point.
fn is_in_leaf(tree: &Tree, boxes: &[Aabb], point: Vec3, stack: &mut Vec<u32>) -> bool {
    stack.clear();
    stack.push(0);
    while let Some(node) = stack.pop() {
        if !boxes[node as usize].contains(point) {
            continue;
        }
        match tree.kind(node) {
            NodeKind::Leaf { count, .. } if count > 0 => return true,
            NodeKind::Leaf { .. } => {}
            NodeKind::Inner => stack.extend(tree.child_nodes(node)),
        }
    }
    false
}

/// Returns three fixed numbers from 0 to 1 (SplitMix64).
fn random_shares(number: u64) -> [f64; 3] {
    let mut bits = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    [0, 21, 42].map(|from| (bits >> from & 0x1F_FFFF) as f64 / f64::from(1 << 21))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(at: f64, size: f64) -> Aabb {
        Aabb::new(Vec3::splat(at), Vec3::splat(at + size))
    }

    #[test]
    fn what_boxes_have_in_common_counts_once() {
        let volume = |boxes: &[Aabb]| {
            let cell = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(b));
            exact(boxes.to_vec(), &cell, &Progress::new()).unwrap()
        };
        assert_eq!(volume(&[]), 0.0);
        assert_eq!(volume(&[cube(0.0, 2.0), cube(1.0, 2.0)]), 15.0);
        // A third inside of the first, a flat one, and one apart from the rest.
        let flat = Aabb::new(Vec3::ZERO, Vec3::new(9.0, 9.0, 0.0));
        let boxes = [
            cube(0.0, 2.0),
            cube(1.0, 2.0),
            cube(0.5, 0.5),
            flat,
            cube(7.0, 1.0),
        ];
        assert_eq!(volume(&boxes), 16.0);
        // Diagonal cubes, each with an eighth in common with the next.
        let many: Vec<Aabb> = (0..100).map(|i| cube(f64::from(i), 2.0)).collect();
        assert_eq!(volume(&many), 800.0 - 99.0);
    }
}
