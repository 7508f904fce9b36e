//! The surface-area heuristic for kernels that test a block of objects at once.
//!
//! The cost of a leaf is the number of blocks that its objects fill, not the number of objects:
//! testing 1 object takes as long as testing 8 or 16. Candidates are the ends of the objects'
//! bounds, rounded to the nearest plane that a node can store, so that neighboring triangles of a
//! mesh are separated exactly. Large cells try only the limits of bins, so that building takes O(N
//! log N) time. Objects that only touch a cell from outside are not counted: kernels that read
//! leaves in blocks skip them, because the neighboring cell contains them.

mod bins;
mod every_plane;
mod extents;
mod grid;

use super::{Cell, Constant, Decision, MethodInfo, SplitRule, Structure};
use crate::geometry::Axis;
use crate::structure::{BuildSettings, StopReason};
use bins::Bins;
use every_plane::Search;
use extents::Extents;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah",
    title: "SAH, leaves in blocks",
    about: "Splits at the plane with the lowest expected cost by the surface-area heuristic if objects \
            are tested in blocks. Favors cutting off empty space.",
    source: "I. Wald and V. Havran, On building fast kd-trees for ray tracing, 2006; V. Havran, \
             Heuristic ray shooting algorithms, 2000",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    constants: &[
        Constant {
            name: "block",
            default: 16.0,
            lowest: 1.0,
            highest: 64.0,
            step: 1.0,
            unit: "objects",
            about: "Number of objects that are tested at the cost of one.",
            source: "lanes of a 512-bit vector; 8 and 16 measured by cargo bench --bench peers",
        },
        Constant {
            name: "traversal-cost",
            default: 0.55,
            lowest: 0.01,
            highest: 100.0,
            step: 0.0,
            unit: "blocks",
            about: "Cost of traversing an inner node, relative to testing a block.",
            source: "measured by cargo bench --bench peers",
        },
        Constant {
            name: "empty-factor",
            default: 0.8,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "Factor on the cost of a split with an empty side; below 1 favors cutting off empty \
                    space.",
            source: "Wald and Havran 2006, section 3",
        },
        Constant {
            name: "exact",
            default: 16384.0,
            lowest: 0.0,
            highest: 1e9,
            step: 1.0,
            unit: "objects",
            about: "Cells with at most this many objects try every plane, larger cells only the limits of \
                    64 bins.",
            source: "measured by cargo bench --bench peers and growth: builds as fast as with 1024, and \
                     rays are up to 5 % faster",
        },
        CLIP,
    ],
    rule: |settings| Box::new(Sah::new(settings)),
};

/// Whether objects are clipped to the cell before they are counted.
pub(super) const CLIP: Constant = Constant {
    name: "clip",
    default: 0.0,
    lowest: 0.0,
    highest: 1.0,
    step: 1.0,
    unit: "",
    about: "1 counts an object by the bounds of its part within the cell, 0 by its bounds clipped to the \
            cell. Best with --overlap exact.",
    source: "V. Havran, Heuristic ray shooting algorithms, 2000 (split clipping)",
};

/// The ends of an extent along an axis, as planes.
type Extent = [f32; 2];

struct Sah {
    block: u32,
    traversal_cost: f32,
    empty_factor: f32,
    exact: usize,
    clip: bool,
}

/// A plane and the number of objects with a part on each side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    at: f32,
    below: usize,
    above: usize,
}

/// The cheapest choice found for a cell.
struct Best {
    cost: f32,
    /// `None` for a leaf.
    plane: Option<(Axis, f32)>,
}

impl Best {
    /// Takes a plane if it is cheaper. Among planes of equal cost, the lowest on the first axis
    /// wins.
    fn offer(&mut self, axis: Axis, at: f32, cost: f32) {
        let earlier = |(other, plane): (Axis, f32)| (axis.index(), at) < (other.index(), plane);
        let earlier = self.plane.is_some_and(earlier);
        if cost < self.cost || cost == self.cost && earlier {
            *self = Best {
                cost,
                plane: Some((axis, at)),
            };
        }
    }
}

impl Sah {
    fn new(settings: &BuildSettings) -> Self {
        Sah {
            block: settings.constant("block") as u32,
            traversal_cost: settings.constant("traversal-cost") as f32,
            empty_factor: settings.constant("empty-factor") as f32,
            exact: settings.constant("exact") as usize,
            clip: settings.constant(CLIP.name) > 0.5,
        }
    }

    fn blocks(&self, objects: usize) -> f32 {
        (objects as u32).div_ceil(self.block) as f32
    }

    /// Returns the expected cost of a ray through the split cell, in block tests, without the
    /// factor for empty sides.
    fn cost_of_parts(&self, plane: &Plane, areas: &Areas) -> f32 {
        let work = areas.below(plane.at) * self.blocks(plane.below)
            + areas.above(plane.at) * self.blocks(plane.above);
        self.traversal_cost + work
    }

    /// Returns the same with the factor for empty sides.
    fn cost(&self, plane: &Plane, areas: &Areas) -> f32 {
        let empty = plane.below == 0 || plane.above == 0;
        let factor = if empty { self.empty_factor } else { 1.0 };
        factor * self.cost_of_parts(plane, areas)
    }

    /// Returns the cheapest bin limit.
    fn best_bin_limit(&self, cell: &Cell<'_>) -> Best {
        let bins = Bins::of(cell, self.clip);
        let mut best = Best {
            cost: self.blocks(bins.objects()),
            plane: None,
        };
        for axis in Axis::ALL {
            let areas = Areas::new(cell, axis);
            for plane in bins.planes(axis).filter(|p| cell.divides(axis, p.at)) {
                best.offer(axis, plane.at, self.cost(&plane, &areas));
            }
        }
        best
    }

    /// Returns the cheapest of all planes.
    fn best_plane(&self, cell: &Cell<'_>) -> Best {
        Extents::with(cell, self.clip, |extents, scratch| {
            let mut best = Best {
                cost: self.blocks(extents.objects()),
                plane: None,
            };
            let size = cell.bounds.size();
            let mut axes = Axis::ALL;
            axes.sort_by(|a, b| size[b.index()].total_cmp(&size[a.index()]));
            for axis in axes {
                let areas = Areas::new(cell, axis);
                let ends = cell.local[axis.index()];
                Search::new(self, &areas, axis, ends, &mut best).run(extents.along(axis), scratch);
            }
            best
        })
    }
}

impl SplitRule for Sah {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let best = if cell.object_count() > self.exact {
            self.best_bin_limit(cell)
        } else {
            self.best_plane(cell)
        };
        match best.plane {
            Some((axis, plane)) => Decision::Split { axis, plane },
            None => Decision::Leaf(StopReason::LeafIsCheaper),
        }
    }
}

/// Surface areas of the two parts of a cell, as fractions of the cell's area; linear in the plane.
struct Areas {
    ends: Extent,
    /// Fraction in the two faces parallel to the plane.
    faces: f32,
    /// Fraction in the other four faces, per unit of the plane's coordinate.
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
