//! The settings that are tried.

use crate::setup::Setup;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// Most objects for which `none`, which tests every object, is a candidate. In larger scenes it is
/// never the best and would take most of the time.
pub const NAIVE_LIMIT: usize = 5_000;

/// Differences from the automatic depth, the nearest first, because a search may end early.
const DEPTHS: [i32; 5] = [0, -2, 2, -4, 4];

const LEAF_SIZES: [u32; 4] = [1, 2, 4, 8];

/// Most candidates of the second phase.
pub(super) const MOST_REFINEMENTS: usize = REFINED * DEPTHS.len() * LEAF_SIZES.len();

/// How many methods are refined.
pub(super) const REFINED: usize = 2;

/// Returns whether a method is tried in a scene with this number of objects.
pub fn is_tried(method: Method, objects: usize) -> bool {
    method.name != "none" || objects <= NAIVE_LIMIT
}

/// Returns the candidates of the first phase: this setup with every one of these methods that is tried.
pub(super) fn all_methods(setup: &Setup, methods: &[Method], objects: usize) -> Vec<Setup> {
    let tried = methods.iter().copied();
    tried
        .filter(|method| is_tried(*method, objects))
        .map(|method| {
            let mut candidate = setup.clone();
            candidate.build = BuildSettings {
                d_max: MaxDepth::Automatic,
                root_margin: setup.build.root_margin,
                overlap: setup.build.overlap,
                first_axis: setup.build.first_axis,
                memory_limit: setup.build.memory_limit,
                ..BuildSettings::for_method(method)
            };
            candidate
        })
        .collect()
}

/// Returns the candidates of the second phase: each of these setups with every depth and leaf size.
/// Setups are interleaved, so that a search that ends early has tried as many of each.
pub(super) fn refinements(setups: &[Setup], objects: usize) -> Vec<Setup> {
    let automatic = MaxDepth::Automatic.resolve(objects);
    let mut depths = Vec::new();
    for difference in DEPTHS {
        let depth = automatic.saturating_add_signed(difference);
        let depth = match depth.clamp(1, MaxDepth::LIMIT) {
            depth if depth == automatic => MaxDepth::Automatic,
            depth => MaxDepth::Fixed(depth),
        };
        if !depths.contains(&depth) {
            depths.push(depth);
        }
    }
    let mut all = Vec::new();
    for d_max in depths {
        for n_oilf in LEAF_SIZES {
            all.extend(setups.iter().map(|setup| {
                let mut candidate = setup.clone();
                candidate.build.d_max = d_max;
                candidate.build.n_oilf = n_oilf;
                candidate
            }));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::{OverlapRule, RootMargin};

    #[test]
    fn every_method_is_tried_under_equal_conditions_and_none_only_in_small_scenes() {
        let mut setup = Setup::of_method(Method::named("sah-cut").unwrap());
        setup.build.constants.insert("gap-fraction".into(), 0.5);
        setup.build.overlap = OverlapRule::Exact;
        setup.build.root_margin = RootMargin::Length(0.5);
        setup.build.n_oilf = 7;
        let methods: Vec<_> = Method::all().collect();
        let names = |objects| -> Vec<_> {
            let all = all_methods(&setup, &methods, objects);
            all.iter().map(|s| s.build.method.name).collect()
        };
        let all: Vec<_> = Method::all().map(|m| m.name).collect();
        assert_eq!(names(NAIVE_LIMIT), all);
        let without: Vec<_> = all.iter().copied().filter(|name| *name != "none").collect();
        assert_eq!(without.len(), all.len() - 1);
        assert_eq!(names(NAIVE_LIMIT + 1), without);
        let chosen = all_methods(&setup, &methods[..2], 10);
        assert_eq!(
            chosen.iter().map(|s| s.build.method).collect::<Vec<_>>(),
            methods[..2]
        );
        for candidate in all_methods(&setup, &methods, 10) {
            let build = &candidate.build;
            assert!(build.constants.is_empty(), "{build:?}");
            assert_eq!((build.d_max, build.n_oilf), (MaxDepth::Automatic, 1));
            assert_eq!(
                (build.overlap, build.root_margin),
                (OverlapRule::Exact, RootMargin::Length(0.5))
            );
            assert_eq!(
                (candidate.scene, candidate.render),
                (setup.scene.clone(), setup.render)
            );
        }
    }

    #[test]
    fn refinements_surround_the_automatic_depth() {
        let bases = ["sah", "midpoint"].map(|name| Setup::of_method(Method::named(name).unwrap()));
        let all = refinements(&bases, 1_000);
        assert_eq!(all.len(), MOST_REFINEMENTS);
        let automatic = MaxDepth::Automatic.resolve(1_000);
        assert_eq!(automatic, 14);
        let of = |place: usize| {
            let build = &all[place].build;
            (build.method.name, build.d_max.to_string(), build.n_oilf)
        };
        assert_eq!(of(0), ("sah", "auto".into(), 1));
        assert_eq!(of(1), ("midpoint", "auto".into(), 1));
        assert_eq!(of(2), ("sah", "auto".into(), 2));
        let mut depths: Vec<_> = all.iter().map(|s| s.build.d_max.resolve(1_000)).collect();
        depths.sort_unstable();
        depths.dedup();
        assert_eq!(depths, [10, 12, 14, 16, 18]);
        for (place, setup) in all.iter().enumerate() {
            assert!(!all[..place].contains(setup), "twice: {setup:?}");
        }
        // The automatic depth of an empty scene is 2, and no tree is less than 1 deep.
        let mut few: Vec<_> = refinements(&bases[..1], 0)
            .iter()
            .map(|s| s.build.d_max.resolve(0))
            .collect();
        few.dedup();
        assert_eq!(few, [2, 1, 4, 6]);
    }

    #[test]
    fn limits_do_not_apply_to_grids_to_no_tree_and_to_merged_hierarchies() {
        let without: Vec<_> = Method::all().filter(|m| !m.has_limits).collect();
        let names: Vec<_> = without.iter().map(|m| m.name).collect();
        let expected = ["grid", "none", "bvh-lbvh", "bvh-ploc", "bvh-reinsert"];
        assert_eq!(names, expected);
    }
}
