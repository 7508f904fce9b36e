//! The settings that are tried.

use crate::measure::variations;
use crate::setup::Setup;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// Most objects for which `none`, which tests every object, is a candidate. In larger scenes it is
/// never the best and would take most of the time.
pub const NAIVE_LIMIT: usize = 5_000;

/// Returns whether a method is tried in a scene with this number of objects.
pub fn is_tried(method: Method, objects: usize) -> bool {
    method.name != "none" || objects <= NAIVE_LIMIT
}

/// Returns the candidates of a method: this setup with the method's [`variations`], its defaults first.
pub(super) fn candidates(setup: &Setup, method: Method, objects: usize) -> Vec<Setup> {
    let own = &setup.build;
    let with = |build: BuildSettings| Setup {
        build: BuildSettings {
            root_margin: own.root_margin,
            overlap: own.overlap,
            first_axis: own.first_axis,
            memory_limit: own.memory_limit,
            ..build
        },
        ..setup.clone()
    };
    variations(method, objects).into_iter().map(with).collect()
}

/// Returns whether settings are those with which the search begins with their method.
pub(super) fn is_default(build: &BuildSettings) -> bool {
    build.constants.is_empty() && build.d_max == MaxDepth::Automatic && build.n_oilf == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::{OverlapRule, RootMargin};

    #[test]
    fn candidates_keep_what_applies_to_every_method() {
        let mut setup = Setup::of_method(Method::named("sah-cut").unwrap());
        setup.build.constants.insert("gap-fraction".into(), 0.5);
        setup.build.overlap = OverlapRule::Exact;
        setup.build.root_margin = RootMargin::Length(0.5);
        setup.build.n_oilf = 7;
        for method in Method::all() {
            let all = candidates(&setup, method, 10);
            let first = &all[0].build;
            assert!(is_default(first), "{first:?}");
            assert!(!all[1..].iter().any(|other| is_default(&other.build)));
            for candidate in all {
                assert_eq!(candidate.build.method, method);
                assert_eq!(
                    (candidate.build.overlap, candidate.build.root_margin),
                    (OverlapRule::Exact, RootMargin::Length(0.5))
                );
                assert_eq!(
                    (candidate.scene, candidate.render),
                    (setup.scene.clone(), setup.render)
                );
            }
        }
    }

    #[test]
    fn testing_every_object_is_only_tried_in_small_scenes() {
        let tried = |objects| Method::all().filter(move |method| is_tried(*method, objects));
        assert_eq!(tried(NAIVE_LIMIT).count(), Method::all().count());
        let names: Vec<_> = tried(NAIVE_LIMIT + 1).map(|method| method.name).collect();
        assert_eq!(names.len(), Method::all().count() - 1);
        assert!(!names.contains(&"none"), "{names:?}");
    }

    #[test]
    fn limits_do_not_apply_to_grids_to_no_tree_and_to_merged_hierarchies() {
        let without: Vec<_> = Method::all().filter(|m| !m.has_limits).collect();
        let names: Vec<_> = without.iter().map(|m| m.name).collect();
        let expected = ["grid", "none", "bvh-lbvh", "bvh-ploc", "bvh-reinsert"];
        assert_eq!(names, expected);
    }
}
