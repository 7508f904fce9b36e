//! Build methods. A method is one file here and one line in [`SPLIT_RULES`].

mod grid;
mod midpoint;
mod midpoint_longest;
mod none;
mod object_median;
mod octree;
pub(super) mod rule;
mod sah;
mod sah_auto;
mod sah_cut;
mod sah_sampled;
mod sweep;

pub use super::method::{Constant, Structure};
pub use super::settings::MethodInfo;
pub use rule::{Cell, Decision, SplitRule};

/// All build methods.
pub static SPLIT_RULES: &[MethodInfo] = &[
    midpoint::METHOD,
    sah_cut::METHOD,
    sah_auto::METHOD,
    sah_sampled::METHOD,
    sah::METHOD,
    midpoint_longest::METHOD,
    object_median::METHOD,
    octree::METHOD,
    grid::METHOD,
    none::METHOD,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_defaults_lie_in_their_ranges() {
        assert!(!SPLIT_RULES.is_empty());
        for (i, method) in SPLIT_RULES.iter().enumerate() {
            assert!(SPLIT_RULES[..i].iter().all(|m| m.name != method.name));
            assert!(!method.source.is_empty() && !method.about.is_empty());
            for (k, c) in method.constants.iter().enumerate() {
                assert!(
                    method.constants[..k]
                        .iter()
                        .all(|other| other.name != c.name)
                );
                assert!((c.lowest..=c.highest).contains(&c.default), "{}", c.name);
                assert!(!c.source.is_empty() && !c.about.is_empty());
            }
        }
    }

    #[test]
    fn the_paper_has_two_methods() {
        let numbers: Vec<_> = SPLIT_RULES.iter().filter_map(|m| m.paper).collect();
        assert_eq!(numbers, [1, 2]);
    }
}
