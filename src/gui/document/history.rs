//! The last results of a series: one scene and picture size, with changing settings.

use super::result::Current;
use crate::measure::Measurement;
use crate::setup::Setup;

/// The most results that are kept.
const MOST: usize = 20;

/// A setup with its final figures.
pub struct Measured {
    /// Number of the request that it answers.
    pub number: u64,
    pub setup: Setup,
    pub measurement: Measurement,
}

/// The figures on view: the newest final ones, until newer ones are final.
pub struct Figures<'a> {
    pub now: &'a Measured,
    /// The result before them.
    pub before: Option<&'a Measured>,
    /// Whether they answer what is wanted.
    pub are_current: bool,
}

/// The last results of a series, the oldest first. Results of another scene or picture size begin a new
/// series.
#[derive(Default)]
pub struct History(Vec<Measured>);

impl History {
    /// Adds the final figures of a picture.
    pub fn add(&mut self, current: &Current) {
        self.put(Measured {
            number: current.number,
            setup: current.shown.setup.clone(),
            measurement: current.shown.measurement.clone(),
        });
    }

    fn put(&mut self, result: Measured) {
        let series = |of: &Measured| {
            let render = &of.setup.render;
            (of.setup.scene.clone(), render.width, render.height)
        };
        if self
            .last()
            .is_some_and(|last| series(last) != series(&result))
        {
            self.0.clear();
        }
        if self.0.len() == MOST {
            self.0.remove(0);
        }
        self.0.push(result);
    }

    /// Returns the results, the oldest first.
    pub fn results(&self) -> &[Measured] {
        &self.0
    }

    /// Returns the newest result.
    pub fn last(&self) -> Option<&Measured> {
        self.0.last()
    }

    /// Returns the result before the newest.
    pub fn previous(&self) -> Option<&Measured> {
        self.0.iter().rev().nth(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::measure;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::{BuildSettings, MaxDepth};
    use crate::trace::RenderSettings;
    use std::sync::LazyLock;

    /// Of any tree: what was measured plays no part in a series.
    static MEASUREMENT: LazyLock<Measurement> = LazyLock::new(|| {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:1"), &progress).unwrap();
        let render = RenderSettings {
            width: 4,
            height: 4,
            ..RenderSettings::default()
        };
        let measured = measure(&scene, &BuildSettings::default(), &render, &progress);
        measured.unwrap().measurement
    });

    fn result(number: u64, scene: &str, depth: u32, width: u32) -> Measured {
        let mut setup = Setup::new(SceneRequest::parse(scene));
        setup.build.d_max = MaxDepth::Fixed(depth);
        setup.render.width = width;
        Measured {
            number,
            setup,
            measurement: MEASUREMENT.clone(),
        }
    }

    fn numbers(history: &History) -> Vec<u64> {
        history
            .results()
            .iter()
            .map(|result| result.number)
            .collect()
    }

    #[test]
    fn a_series_ends_with_the_scene_and_the_picture_size() {
        let mut history = History::default();
        assert!(history.last().is_none() && history.previous().is_none());
        history.put(result(1, "balls:1", 20, 48));
        history.put(result(2, "balls:1", 12, 48));
        assert_eq!(numbers(&history), [1, 2]);
        assert_eq!(history.previous().unwrap().number, 1);
        history.put(result(3, "balls:2", 12, 48));
        assert_eq!(numbers(&history), [3]);
        history.put(result(4, "balls:2", 12, 64));
        assert_eq!(numbers(&history), [4]);
        assert!(history.previous().is_none());
    }

    #[test]
    fn the_last_twenty_results_are_kept() {
        let mut history = History::default();
        for number in 1..=25 {
            history.put(result(number, "balls:1", number as u32, 48));
        }
        assert_eq!(numbers(&history), (6..=25).collect::<Vec<_>>());
    }
}
