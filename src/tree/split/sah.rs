//! The surface-area heuristic for kernels that test a block of objects at once.
//!
//! The expected cost of a leaf is the number of blocks its objects fill, not of the objects: a test
//! of 1 costs as much as one of 8 or 16. Candidates are the ends of the objects' bounds, each as the
//! nearest plane that a node can store, so that neighbours in a mesh are parted between them. An
//! object that only touches a cell from outside does not count there: kernels that read leaves in
//! blocks leave it out, as the neighbour has it.

use super::{Cell, Constant, Decision, MethodInfo, SplitRule};
use crate::geometry::Axis;
use crate::tree::frame::is_inside;
use crate::tree::{BuildSettings, StopReason};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah",
    title: "Surface area, leaves in blocks",
    about: "Splits where the surface-area heuristic expects rays to cost least when objects are \
            tested in blocks; favours cutting off empty space.",
    source: "I. Wald and V. Havran, On building fast kd-trees for ray tracing, 2006; V. Havran, \
             Heuristic ray shooting algorithms, 2000",
    paper: None,
    paper_spheres_exactly: false,
    constants: &[
        Constant {
            name: "block",
            default: 16.0,
            lowest: 1.0,
            highest: 64.0,
            step: 1.0,
            unit: "objects",
            about: "How many objects are tested at the cost of one.",
            source: "lanes of a 512-bit vector; 8 and 16 measured by cargo bench --bench peers",
        },
        Constant {
            name: "traversal-cost",
            default: 0.7,
            lowest: 0.01,
            highest: 100.0,
            step: 0.0,
            unit: "blocks",
            about: "Cost of passing an inner node, in tests of a block.",
            source: "measured by cargo bench --bench peers",
        },
        Constant {
            name: "empty-factor",
            default: 0.8,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "Factor on the cost of a split with an empty side; below 1 favours cutting off \
                    empty space.",
            source: "Wald and Havran 2006, section 3",
        },
        Constant {
            name: "exact",
            default: 1024.0,
            lowest: 0.0,
            highest: 1e9,
            step: 1.0,
            unit: "objects",
            about: "Cells with at most this many objects try every plane, larger ones the limits of \
                    64 bins.",
            source: "measured: from 1024 on, more gains nothing",
        },
    ],
    rule: |settings| Box::new(Sah::new(settings)),
};

/// Bins an axis of large cells.
const BINS: usize = 64;

struct Sah {
    block: u32,
    traversal_cost: f32,
    empty_factor: f32,
    exact: usize,
}

/// Where an object begins and ends on an axis, as planes clipped to the cell.
type Extent = [f32; 2];

/// A plane and how many objects have a part on either side of it.
struct Plane {
    at: f32,
    below: usize,
    above: usize,
}

impl Sah {
    fn new(settings: &BuildSettings) -> Self {
        Sah {
            block: settings.constant("block") as u32,
            traversal_cost: settings.constant("traversal-cost") as f32,
            empty_factor: settings.constant("empty-factor") as f32,
            exact: settings.constant("exact") as usize,
        }
    }

    fn blocks(&self, objects: usize) -> f32 {
        (objects as u32).div_ceil(self.block) as f32
    }

    /// Expected cost of a ray through the cell if it is split, in tests of a block.
    fn cost(&self, plane: &Plane, areas: &Areas) -> f32 {
        let work = areas.below(plane.at) * self.blocks(plane.below)
            + areas.above(plane.at) * self.blocks(plane.above);
        let empty = plane.below == 0 || plane.above == 0;
        let factor = if empty { self.empty_factor } else { 1.0 };
        factor * (self.traversal_cost + work)
    }
}

impl SplitRule for Sah {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let extents = inside(cell);
        let objects = extents[0].len();
        let mut best = (self.blocks(objects), None);
        for axis in Axis::ALL {
            let areas = Areas::new(cell, axis);
            let cell_extent = cell.local[axis.index()];
            let mut consider = |plane: Plane| {
                let cost = self.cost(&plane, &areas);
                if cost < best.0 {
                    best = (cost, Some((axis, plane.at)));
                }
            };
            let extents = &extents[axis.index()];
            if objects <= self.exact {
                every_plane(extents, cell_extent, &mut consider);
            } else {
                limits_of_bins(extents, cell_extent, &mut consider);
            }
        }
        match best {
            (_, Some((axis, plane))) => Decision::Split { axis, plane },
            _ => Decision::Leaf(StopReason::NoSplitPays),
        }
    }
}

/// The extents, by axis, of the objects that do more than touch the cell from outside.
fn inside(cell: &Cell<'_>) -> [Vec<Extent>; 3] {
    let mut extents = Axis::ALL.map(|_| Vec::with_capacity(cell.objects.len()));
    for &object in cell.objects {
        let planes = cell
            .frame
            .planes_around(&cell.object_bounds[object as usize]);
        if is_inside(&planes, &cell.local) {
            for (k, extents) in extents.iter_mut().enumerate() {
                let [lo, hi] = cell.local[k];
                extents.push([planes[k][0].max(lo), planes[k][1].min(hi)]);
            }
        }
    }
    extents
}

/// All planes at which an object begins or ends, ascending.
fn every_plane(extents: &[Extent], [lo, hi]: Extent, consider: &mut impl FnMut(Plane)) {
    let mut begins: Vec<f32> = extents.iter().map(|e| e[0]).collect();
    let mut ends: Vec<f32> = extents.iter().map(|e| e[1]).collect();
    let mut flat: Vec<f32> = extents
        .iter()
        .filter(|e| e[0] == e[1])
        .map(|e| e[0])
        .collect();
    for list in [&mut begins, &mut ends, &mut flat] {
        list.sort_unstable_by(f32::total_cmp);
    }
    // How many begin before the plane, end at or before it, and lie in it.
    let (mut i, mut k, mut m) = (0, 0, 0);
    loop {
        let next = match (begins.get(i), ends.get(k)) {
            (Some(&begin), Some(&end)) => begin.min(end),
            (Some(&at), None) | (None, Some(&at)) => at,
            (None, None) => return,
        };
        let begun = i;
        let count =
            |list: &[f32], from: usize| list[from..].iter().take_while(|&&at| at == next).count();
        i += count(&begins, i);
        k += count(&ends, k);
        let in_plane = count(&flat, m);
        m += in_plane;
        if lo < next && next < hi {
            consider(Plane {
                at: next,
                below: begun + in_plane,
                above: extents.len() - k + in_plane,
            });
        }
    }
}

/// The limits of equally wide bins.
fn limits_of_bins(extents: &[Extent], [lo, hi]: Extent, consider: &mut impl FnMut(Plane)) {
    let width = (hi - lo) / BINS as f32;
    let limit = |bin: usize| lo + width * bin as f32;
    // Bin of a plane such that the limits at its ends, as rounded, hold the plane between them.
    let bin = |at: f32| {
        let guess = (((at - lo) / width) as usize).min(BINS - 1);
        if guess > 0 && at < limit(guess) {
            guess - 1
        } else if guess + 1 < BINS && at >= limit(guess + 1) {
            guess + 1
        } else {
            guess
        }
    };
    let (mut begins, mut ends) = ([0; BINS], [0; BINS]);
    for &[begin, end] in extents {
        begins[bin(begin)] += 1;
        ends[bin(end)] += 1;
    }
    let (mut begun, mut ended) = (0, 0);
    for k in 1..BINS {
        begun += begins[k - 1];
        ended += ends[k - 1];
        let at = limit(k);
        if lo < at && at < hi {
            consider(Plane {
                at,
                below: begun,
                above: extents.len() - ended,
            });
        }
    }
}

/// Surface areas of the two parts of a cell as shares of the cell's, linear in the plane.
struct Areas {
    ends: Extent,
    /// Share of the two faces parallel to the plane.
    faces: f32,
    /// Share of the other four faces, a unit of the plane's coordinate.
    rim: f32,
}

impl Areas {
    fn new(cell: &Cell<'_>, axis: Axis) -> Self {
        let (k, size) = (axis.index(), cell.bounds.size());
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        let ends = cell.local[k];
        let area = cell.bounds.surface_area();
        Areas {
            ends,
            faces: (2.0 * u * v / area) as f32,
            rim: (2.0 * (u + v) * size[k] / area) as f32 / (ends[1] - ends[0]),
        }
    }

    fn below(&self, plane: f32) -> f32 {
        self.faces + self.rim * (plane - self.ends[0])
    }

    fn above(&self, plane: f32) -> f32 {
        self.faces + self.rim * (self.ends[1] - plane)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planes(
        extents: &[Extent],
        search: fn(&[Extent], Extent, &mut dyn FnMut(Plane)),
    ) -> Vec<(f32, usize, usize)> {
        let mut found = Vec::new();
        search(extents, [-1.0, 1.0], &mut |p: Plane| {
            found.push((p.at, p.below, p.above))
        });
        found
    }

    /// What a plane cuts, by definition.
    fn counted(extents: &[Extent], at: f32) -> (f32, usize, usize) {
        let flat = |e: &&Extent| e[0] == at && e[1] == at;
        let in_plane = extents.iter().filter(flat).count();
        let below = extents.iter().filter(|e| e[0] < at).count() + in_plane;
        let above = extents.iter().filter(|e| e[1] > at).count() + in_plane;
        (at, below, above)
    }

    #[test]
    fn every_plane_counts_what_has_a_part_on_either_side() {
        let extents = [
            [-1.0, -0.5],
            [-0.5, 0.0],
            [-0.5, -0.5],
            [0.0, 1.0],
            [-0.25, 0.5],
        ];
        let found = planes(&extents, |e, c, mut f| every_plane(e, c, &mut f));
        let expected = [-0.5, -0.25, 0.0, 0.5].map(|at| counted(&extents, at));
        assert_eq!(found, expected);
        assert_eq!(found[0], (-0.5, 2, 4));
    }

    #[test]
    fn limits_of_bins_count_what_reaches_over_them() {
        let extents: Vec<Extent> = (0..200)
            .map(|i| {
                let at = -1.0 + (i * 37 % 200) as f32 * 0.01;
                [at, (at + 0.003 * (i % 7) as f32).min(1.0)]
            })
            .collect();
        let found = planes(&extents, |e, c, mut f| limits_of_bins(e, c, &mut f));
        assert_eq!(found.len(), BINS - 1);
        for (at, below, above) in found {
            let begun = extents.iter().filter(|e| e[0] < at).count();
            let not_ended = extents.iter().filter(|e| e[1] >= at).count();
            assert_eq!((below, above), (begun, not_ended), "{at}");
        }
    }
}
