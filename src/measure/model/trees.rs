//! The trees that a time model is fitted to and tested on.

use super::observe::Observation;
use crate::scene::Scene;
use crate::structure::{BuildSettings, MaxDepth, Method};

/// Returns the trees that a model of a scene is fitted to: the paper's methods with depths around
/// the automatic one and two leaf sizes.
pub fn trees(scene: &Scene) -> Vec<BuildSettings> {
    let automatic = MaxDepth::Automatic.resolve(scene.objects().len());
    let mut all = Vec::new();
    for method in Method::of_the_paper() {
        for depth in [-4, -3, -2, -1, 0, 2] {
            for n_oilf in [1, 4] {
                let depth = automatic.saturating_add_signed(depth).clamp(1, 30);
                all.push(BuildSettings {
                    d_max: MaxDepth::Fixed(depth),
                    n_oilf,
                    ..BuildSettings::for_method(method)
                });
            }
        }
    }
    all
}

/// Splits observations into a training set and a test set. Every third observation is for testing.
pub fn parted(observations: &[Observation]) -> [Vec<&Observation>; 2] {
    let numbered = || observations.iter().enumerate();
    let left_out = |i: usize| i % 3 == 1;
    [
        numbered()
            .filter(|(i, _)| !left_out(*i))
            .map(|(_, o)| o)
            .collect(),
        numbered()
            .filter(|(i, _)| left_out(*i))
            .map(|(_, o)| o)
            .collect(),
    ]
}

/// Returns the observation with the least time; `None` if there is none.
pub fn fastest(observations: &[Observation]) -> Option<&Observation> {
    observations
        .iter()
        .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}
