//! The structures among which the study of measures and the search for the best tree compare.

use crate::scene::Scene;
use crate::structure::split::Structure;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// Differences from the automatic depth, the nearest first, because a search may end early.
const DEPTHS: [i32; 7] = [0, -1, -2, 2, -3, -4, -6];

/// Most objects of a leaf, `N_OILF`, of kd-trees and octrees.
const LEAF_SIZES: [u32; 3] = [1, 4, 16];

/// Children per inner node of hierarchies, `width`.
const WIDTHS: [f64; 3] = [2.0, 4.0, 8.0];

/// Most objects of a leaf of hierarchies, `max-leaf`, and how many of them are tested at the cost of one, `block`.
const LEAVES: [[f64; 2]; 4] = [[8.0, 1.0], [1.0, 1.0], [4.0, 1.0], [16.0, 8.0]];

/// Voxels per object of grids, `density`.
const DENSITIES: [f64; 5] = [5.0, 2.0, 10.0, 1.0, 0.5];

/// Returns the structures for a scene: every method but `none`, with its variations. Well over a hundred; some may
/// turn out to be the same tree.
pub fn structures(scene: &Scene) -> Vec<BuildSettings> {
    let methods = Method::all().filter(|method| method.name != "none");
    methods
        .flat_map(|method| variations(method, scene.objects().len()))
        .collect()
}

/// Returns a method with its default settings and automatic depth, and then with other ones: of kd-trees and octrees
/// depths around the automatic one and leaf sizes, of hierarchies widths and leaves, of grids densities. None occurs
/// twice.
pub fn variations(method: Method, objects: usize) -> Vec<BuildSettings> {
    let default = BuildSettings {
        d_max: MaxDepth::Automatic,
        ..BuildSettings::for_method(method)
    };
    match method.structure {
        Structure::Bintree | Structure::Octree if method.has_limits => cells(&default, objects),
        Structure::Bintree | Structure::Octree => vec![default],
        Structure::Grid => {
            let densities = DENSITIES.into_iter();
            let each = densities.map(|density| with(&default, &[("density", density)]));
            each.collect()
        }
        Structure::Bvh => {
            let each = LEAVES
                .into_iter()
                .flat_map(|leaves| WIDTHS.map(|width| (width, leaves)));
            let each = each.map(|(width, [most, block])| {
                with(
                    &default,
                    &[("width", width), ("max-leaf", most), ("block", block)],
                )
            });
            each.collect()
        }
    }
}

/// Returns the settings of a method that splits cells, with every depth and leaf size.
fn cells(default: &BuildSettings, objects: usize) -> Vec<BuildSettings> {
    let automatic = MaxDepth::Automatic.resolve(objects);
    let mut all: Vec<BuildSettings> = Vec::new();
    for difference in DEPTHS {
        let depth = automatic.saturating_add_signed(difference);
        let d_max = match depth.clamp(1, MaxDepth::LIMIT) {
            depth if depth == automatic => MaxDepth::Automatic,
            depth => MaxDepth::Fixed(depth),
        };
        for n_oilf in LEAF_SIZES {
            let build = BuildSettings {
                d_max,
                n_oilf,
                ..default.clone()
            };
            if !all.contains(&build) {
                all.push(build);
            }
        }
    }
    all
}

/// Returns settings with other values of constants. Values that are defaults are not stored.
fn with(default: &BuildSettings, values: &[(&str, f64)]) -> BuildSettings {
    let mut build = default.clone();
    for &(name, value) in values {
        if build.constant(name) != value {
            build.constants.insert(name.to_owned(), value);
        }
    }
    build
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, objects: usize) -> Vec<BuildSettings> {
        variations(Method::named(name).unwrap(), objects)
    }

    #[test]
    fn a_method_begins_with_its_defaults_and_never_repeats_itself() {
        for method in Method::all() {
            let all = variations(method, 1_000);
            assert!(all[0].constants.is_empty(), "{:?}", all[0]);
            assert_eq!((all[0].d_max, all[0].n_oilf), (MaxDepth::Automatic, 1));
            for (place, build) in all.iter().enumerate() {
                build.check().unwrap();
                assert!(!all[..place].contains(build), "twice: {build:?}");
            }
        }
    }

    #[test]
    fn cells_surround_the_automatic_depth_and_hierarchies_differ_in_width_and_leaves() {
        let depths = |objects| {
            let mut depths: Vec<_> = (of("sah", objects).iter())
                .map(|b| b.d_max.resolve(objects))
                .collect();
            depths.dedup();
            depths
        };
        assert_eq!(depths(1_000), [14, 13, 12, 16, 11, 10, 8]);
        // The automatic depth of an empty scene is 2, and no tree is less than 1 deep.
        assert_eq!(depths(0), [2, 1, 4]);
        let names = |name| -> Vec<String> {
            let all = of(name, 1_000);
            all.iter().map(BuildSettings::in_words).collect()
        };
        assert_eq!(names("none"), ["none"]);
        assert_eq!(names("sah")[1], "sah, D_MAX auto, N_OILF 4");
        assert_eq!(names("grid")[1], "grid, density 2");
        let hierarchies = names("bvh-lbvh");
        assert_eq!(hierarchies.len(), 12);
        assert_eq!(
            [&hierarchies[0], &hierarchies[2], &hierarchies[11]],
            [
                "bvh-lbvh",
                "bvh-lbvh, width 8",
                "bvh-lbvh, block 8, max-leaf 16, width 8"
            ]
        );
    }
}
