//! The structures that a study compares.

use crate::scene::Scene;
use crate::structure::split::Structure;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// Differences from the automatic depth.
const DEPTHS: [i32; 7] = [-6, -4, -3, -2, -1, 0, 2];

/// Most objects of a leaf, `N_OILF`, of kd-trees and octrees.
const LEAF_SIZES: [u32; 3] = [1, 4, 16];

/// Most objects of a leaf of hierarchies, `max-leaf`.
const LARGEST_LEAVES: [f64; 3] = [1.0, 4.0, 16.0];

const WIDTHS: [f64; 3] = [2.0, 4.0, 8.0];

/// Voxels per object of grids.
const DENSITIES: [f64; 5] = [0.5, 1.0, 2.0, 5.0, 10.0];

/// Returns the structures for a scene: every method but `none`, with depths around the automatic one and leaf
/// sizes, and hierarchies of several widths. Well over a hundred; some may turn out to be the same tree.
pub fn structures(scene: &Scene) -> Vec<BuildSettings> {
    let methods = Method::all().filter(|method| method.name != "none");
    methods
        .flat_map(|method| match method.structure {
            Structure::Bintree | Structure::Octree => cells(method, scene.objects().len()),
            Structure::Grid => with_each(
                vec![BuildSettings::for_method(method)],
                "density",
                &DENSITIES,
            ),
            Structure::Bvh => {
                let all = with_each(vec![BuildSettings::for_method(method)], "width", &WIDTHS);
                with_each(all, "max-leaf", &LARGEST_LEAVES)
            }
        })
        .collect()
}

/// Returns a method that splits cells, with every depth and leaf size.
fn cells(method: Method, objects: usize) -> Vec<BuildSettings> {
    let automatic = MaxDepth::Automatic.resolve(objects);
    let mut all: Vec<BuildSettings> = Vec::new();
    for difference in DEPTHS {
        let depth = automatic.saturating_add_signed(difference);
        for n_oilf in LEAF_SIZES {
            let build = BuildSettings {
                d_max: MaxDepth::Fixed(depth.clamp(1, MaxDepth::LIMIT)),
                n_oilf,
                ..BuildSettings::for_method(method)
            };
            if !all.contains(&build) {
                all.push(build);
            }
        }
    }
    all
}

/// Returns the settings with each value of a constant; unchanged if the method does not have it.
fn with_each(all: Vec<BuildSettings>, constant: &str, values: &[f64]) -> Vec<BuildSettings> {
    let has = |build: &BuildSettings| build.method.constants.iter().any(|c| c.name == constant);
    let with = |build: BuildSettings| -> Vec<BuildSettings> {
        if !has(&build) {
            return vec![build];
        }
        let with = |&value: &f64| {
            let mut build = build.clone();
            build.constants.insert(constant.to_owned(), value);
            build
        };
        values.iter().map(with).collect()
    };
    all.into_iter().flat_map(with).collect()
}
