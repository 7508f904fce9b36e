//! The surface-area heuristic for kernels that test a block of objects at once.
//!
//! The cost of a leaf is the number of blocks that its objects fill, not the number of objects:
//! testing 1 object takes as long as testing 8 or 16. Candidates are the ends of the objects'
//! bounds, rounded to the nearest plane that a node can store, so that neighboring triangles of a
//! mesh are separated exactly. Large cells try only the limits of bins, so that building takes O(N
//! log N) time. Objects that only touch a cell from outside are not counted: kernels that read
//! leaves in blocks skip them, because the neighboring cell contains them.

mod bins;
mod cost;
mod every_plane;
mod extents;
mod grid;

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::Axis;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use bins::Bins;
use cost::{Areas, Best, Costs};
use every_plane::Search;
use extents::Extents;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah",
    summary: "surface-area heuristic for leaves that are tested in blocks",
    about: "Splits at the plane with the lowest expected cost by the surface-area heuristic if objects \
            are tested in blocks. Favors cutting off empty space.",
    source: "I. Wald and V. Havran, On building fast kd-trees for ray tracing, 2006; V. Havran, \
             Heuristic ray shooting algorithms, 2000",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[
        Constant {
            name: "block",
            default: 16.0,
            lowest: 1.0,
            highest: 64.0,
            step: 1.0,
            unit: "objects",
            about: "Number of objects that are tested at the cost of one.",
            source: "elements of a 512-bit vector; 8 and 16 measured by cargo bench --bench peers",
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
    builder: Builder::Cells(|settings| Box::new(Sah::new(settings))),
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

struct Sah {
    costs: Costs,
    exact: usize,
    clip: bool,
}

impl Sah {
    fn new(settings: &BuildSettings) -> Self {
        Sah {
            costs: Costs::new(settings),
            exact: settings.constant("exact") as usize,
            clip: settings.constant(CLIP.name) > 0.5,
        }
    }

    /// Returns the cheapest bin limit.
    fn best_bin_limit(&self, cell: &Cell<'_>) -> Best {
        let bins = Bins::of(cell, self.clip);
        let mut best = Best {
            cost: self.costs.blocks(bins.objects()),
            plane: None,
        };
        for axis in Axis::ALL {
            let areas = Areas::new(cell, axis);
            for plane in bins.planes(axis).filter(|p| cell.divides(axis, p.at)) {
                best.offer(axis, plane.at, self.costs.cost(&plane, &areas));
            }
        }
        best
    }

    /// Returns the cheapest of all planes.
    fn best_plane(&self, cell: &Cell<'_>) -> Best {
        Extents::with(cell, self.clip, |extents, scratch| {
            let mut best = Best {
                cost: self.costs.blocks(extents.objects()),
                plane: None,
            };
            let size = cell.bounds.size();
            let mut axes = Axis::ALL;
            axes.sort_by(|a, b| size[b.index()].total_cmp(&size[a.index()]));
            for axis in axes {
                let areas = Areas::new(cell, axis);
                let ends = cell.local[axis.index()];
                Search::new(&self.costs, &areas, axis, ends, &mut best)
                    .run(extents.along(axis), scratch);
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
