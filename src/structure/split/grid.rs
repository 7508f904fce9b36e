//! A uniform grid of about cubic voxels.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::{Axis, Vec3};
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, MethodInfo};
use std::sync::OnceLock;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "grid",
    title: "Uniform grid",
    about: "Divides the scene into equal, about cubic voxels, through which rays step from one to the \
            next. D_MAX and N_OILF do not apply, and there are no inner nodes to pass: the window's \
            tree panes show planes between the voxels that only SIMD rays (--kernel stream) traverse.",
    source: "A. Fujimoto, T. Tanaka and K. Iwata, ARTS: accelerated ray-tracing system, 1986; \
             J. G. Cleary and G. Wyvill, Analysis of an algorithm for fast ray tracing using uniform \
             space subdivision, 1988; J. Amanatides and A. Woo, A fast voxel traversal algorithm for \
             ray tracing, 1987",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Grid,
    constants: &[Constant {
        name: "density",
        default: 5.0,
        lowest: 0.001,
        highest: 1000.0,
        step: 0.0,
        unit: "voxels an object",
        about: "Voxels for every object of the scene, at most 1024 along an axis.",
        source: "I. Wald, T. Ize, A. Kensler, A. Knoll and S. G. Parker, Ray tracing animated scenes \
                 using coherent grid traversal, 2006",
    }],
    rule: |settings| Box::new(UniformGrid::new(settings)),
};

/// The most voxels along an axis.
const MAX_VOXELS_PER_AXIS: f64 = 1024.0;

struct UniformGrid {
    density: f64,
    /// Voxels along each axis, once they are known.
    voxels: OnceLock<[u32; 3]>,
}

impl UniformGrid {
    fn new(settings: &BuildSettings) -> Self {
        UniformGrid {
            density: settings.constant("density"),
            voxels: OnceLock::new(),
        }
    }

    /// The voxels between the ends of a cell along an axis.
    fn range(&self, cell: &Cell<'_>, axis: Axis) -> [u32; 2] {
        let voxels = self.voxels.get_or_init(|| {
            let size = cell.frame.cell().size();
            about_cubic(size, self.density * cell.primitives.len() as f64)
        });
        let voxels = f64::from(voxels[axis.index()]);
        cell.local[axis.index()].map(|end| ((f64::from(end) + 1.0) * 0.5 * voxels).round() as u32)
    }

    /// The plane below a voxel, in the coordinates of the root cell.
    fn plane(&self, axis: Axis, voxel: u32) -> f32 {
        let voxels = self.voxels.get().map_or(1, |voxels| voxels[axis.index()]);
        (2.0 * f64::from(voxel) / f64::from(voxels) - 1.0) as f32
    }
}

/// How many voxels along each axis divide a box of this size into about `wanted` that are about cubic.
/// An axis shorter than a voxel is not divided.
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
        // The axis with the most voxels, so that neighbours lie near to each other in memory.
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
