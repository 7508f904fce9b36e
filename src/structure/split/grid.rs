//! A uniform grid of approximately cubic voxels.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::{Axis, Vec3};
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use std::sync::OnceLock;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "grid",
    summary: "equal voxels",
    about: "Divides the scene into equal, approximately cubic voxels, and rays step from one to the \
            next. D_MAX and N_OILF do not apply, and rays traverse no inner nodes. The tree panes of \
            the window show the planes between the voxels; only SIMD kernels (--kernel stream) \
            traverse these planes.",
    source: "A. Fujimoto, T. Tanaka and K. Iwata, ARTS: accelerated ray-tracing system, 1986; \
             J. G. Cleary and G. Wyvill, Analysis of an algorithm for fast ray tracing using uniform \
             space subdivision, 1988; J. Amanatides and A. Woo, A fast voxel traversal algorithm for \
             ray tracing, 1987",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Grid,
    has_limits: false,
    constants: &[Constant {
        name: "density",
        default: 5.0,
        lowest: 0.001,
        highest: 1000.0,
        step: 0.0,
        unit: "voxels per object",
        about: "Number of voxels per object of the scene; at most 1024 voxels along an axis.",
        source: "I. Wald, T. Ize, A. Kensler, A. Knoll and S. G. Parker, Ray tracing animated scenes \
                 using coherent grid traversal, 2006",
    }],
    builder: Builder::Cells(|settings| Box::new(UniformGrid::new(settings))),
};

/// Maximum number of voxels along an axis.
const MAX_VOXELS_PER_AXIS: f64 = 1024.0;

struct UniformGrid {
    density: f64,
    /// Number of voxels along each axis; computed once.
    voxels: OnceLock<[u32; 3]>,
}

impl UniformGrid {
    fn new(settings: &BuildSettings) -> Self {
        UniformGrid {
            density: settings.constant("density"),
            voxels: OnceLock::new(),
        }
    }

    /// Returns the range of voxels that a cell spans along an axis.
    fn range(&self, cell: &Cell<'_>, axis: Axis) -> [u32; 2] {
        let voxels = self.voxels.get_or_init(|| {
            let size = cell.frame.cell().size();
            about_cubic(size, self.density * cell.primitives.len() as f64)
        });
        let voxels = f64::from(voxels[axis.index()]);
        cell.local[axis.index()].map(|end| ((f64::from(end) + 1.0) * 0.5 * voxels).round() as u32)
    }

    /// Returns the plane below a voxel, in local coordinates.
    fn plane(&self, axis: Axis, voxel: u32) -> f32 {
        let voxels = self.voxels.get().map_or(1, |voxels| voxels[axis.index()]);
        (2.0 * f64::from(voxel) / f64::from(voxels) - 1.0) as f32
    }
}

/// Returns the numbers of voxels along each axis that divide a box of this size into about `wanted`
/// approximately cubic voxels. An axis shorter than a voxel is not divided.
fn about_cubic(size: Vec3, wanted: f64) -> [u32; 3] {
    let size = (size / size.max_element()).to_array();
    let mut divided = [true; 3];
    loop {
        let axes = divided.iter().filter(|&&d| d).count();
        let extent: f64 = (0..3).filter(|&k| divided[k]).map(|k| size[k]).product();
        let per_length = libm::pow(wanted / extent, 1.0 / axes as f64);
        let short = (0..3).find(|&k| divided[k] && size[k] * per_length < 1.0);
        match short {
            Some(axis) if axes > 1 => divided[axis] = false,
            _ => {
                return std::array::from_fn(|k| {
                    let voxels = if divided[k] {
                        size[k] * per_length
                    } else {
                        1.0
                    };
                    voxels.round().clamp(1.0, MAX_VOXELS_PER_AXIS) as u32
                });
            }
        }
    }
}

impl SplitRule for UniformGrid {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        // Splitting the axis with the most voxels keeps neighbors close in memory.
        let (axis, [from, to]) = Axis::ALL
            .map(|axis| (axis, self.range(cell, axis)))
            .into_iter()
            .max_by_key(|(_, [from, to])| to - from)
            .expect("there are three axes");
        if to - from > 1 {
            Decision::Split {
                axis,
                plane: self.plane(axis, from + (to - from) / 2),
            }
        } else if cell.object_count() == 0 {
            Decision::Leaf(StopReason::Empty)
        } else {
            Decision::Leaf(StopReason::Voxel)
        }
    }

    fn slices(&self, cell: &Cell<'_>, _levels: u32) -> Option<[f64; 3]> {
        Some(Axis::ALL.map(|axis| {
            let [from, to] = self.range(cell, axis);
            f64::from(to - from)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_are_about_cubic_and_as_many_as_wanted() {
        for (size, wanted, expected) in [
            (Vec3::new(1.0, 1.0, 1.0), 27_000.0, [30, 30, 30]),
            (Vec3::new(4.0, 2.0, 1.0), 64_000.0, [80, 40, 20]),
            (Vec3::new(3e30, 1e-9, 1e30), 30_000.0, [300, 1, 100]),
            (Vec3::new(1e-3, 1e-3, 9.0), 500.0, [1, 1, 500]),
            (Vec3::new(1e-9, 1e-9, 9.0), 1e9, [1, 1, 1024]),
            (Vec3::new(1.0, 2.0, 3.0), 0.5, [1, 1, 1]),
            (Vec3::new(1.0, 2.0, 3.0), 0.0, [1, 1, 1]),
        ] {
            assert_eq!(about_cubic(size, wanted), expected, "{size:?}, {wanted}");
        }
    }
}
