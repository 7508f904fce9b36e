//! The rays of the picked pixel: recorded when a pixel is picked; and how their steps are gone through.

use super::picked::Picked;
use super::result::Current;
use super::tasks::Latest;
use crate::trace::{PixelRecord, RayPath, Step, record_pixel_within};
use std::sync::Arc;
use std::time::Duration;

/// The most steps and tests of a pixel's rays that are kept: about 100 MiB.
const MOST_RECORDED: usize = 1_000_000;

/// How long a frame waits for a record, so that most pixels are shown without a delay of a frame.
const PATIENCE: Duration = Duration::from_millis(2);

/// The speeds that can be chosen, in steps per second.
pub const RATES: std::ops::RangeInclusive<f64> = 0.5..=60.0;

/// Where to go among the steps of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Go {
    First,
    Previous,
    Next,
    Last,
}

/// How the steps of rays are gone through.
pub struct Walking {
    records: Latest<(u64, [u32; 2]), PixelRecord>,
    /// When the last step was taken, in seconds, while steps are played; `None` while they are not.
    pub playing: Option<f64>,
    /// Steps per second.
    pub rate: f64,
    /// Whether inner nodes are skipped.
    pub leaves_only: bool,
}

impl Default for Walking {
    fn default() -> Self {
        Walking {
            records: Latest::default(),
            playing: None,
            rate: 2.0,
            leaves_only: false,
        }
    }
}

impl Walking {
    /// Records the rays of the pixel that was picked, if there is a new one.
    pub fn grant(&mut self, current: &mut Current, ctx: &egui::Context) {
        let Some(wish) = current.wish else {
            return;
        };
        if current
            .shown
            .setup
            .render
            .view(&current.shown.scene)
            .is_err()
        {
            current.unpick();
            return;
        }
        let (scene, tree) = (
            Arc::clone(&current.shown.scene),
            Arc::clone(&current.shown.tree),
        );
        let render = current.shown.setup.render;
        let key = (current.number, wish.pixel);
        let make = move || {
            record_pixel_within(&scene, &tree, &render, wish.pixel, MOST_RECORDED)
                .expect("the camera has a view")
        };
        if let Some(record) = self.records.get_soon(&key, ctx, PATIENCE, make) {
            current.wish = None;
            let hit = record.rays[0].path.hit;
            current.selection.object = hit.is_hit().then_some(hit.object);
            current.picked = Some(Picked {
                pixel: wish.pixel,
                ray: wish.ray.min(record.rays.len() - 1),
                record,
                step: 0,
            });
            current.go_to_step(0);
        }
    }
}

/// Returns the indices of the steps that are listed: all, or those of leaves.
pub fn listed(path: &RayPath, leaves_only: bool) -> Vec<usize> {
    let shown = |step: &Step| !leaves_only || matches!(step, Step::Leaf(_));
    let steps = path.steps.iter().enumerate();
    steps
        .filter_map(|(i, step)| shown(step).then_some(i))
        .collect()
}

/// Returns where a move leads in a list of steps; `None` where it leads nowhere.
pub fn target(listed: &[usize], step: usize, go: Go) -> Option<usize> {
    let to = match go {
        Go::First => listed.first(),
        Go::Last => listed.last(),
        Go::Next => listed.iter().find(|&&i| i > step),
        Go::Previous => listed.iter().rev().find(|&&i| i < step),
    };
    to.copied().filter(|&to| to != step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_keep_to_the_list_and_end_at_its_ends() {
        let leaves = [3, 4, 9];
        assert_eq!(target(&leaves, 0, Go::Next), Some(3));
        assert_eq!(target(&leaves, 4, Go::Next), Some(9));
        assert_eq!(target(&leaves, 9, Go::Next), None);
        assert_eq!(target(&leaves, 9, Go::Last), None);
        assert_eq!(target(&leaves, 4, Go::Previous), Some(3));
        assert_eq!(target(&leaves, 3, Go::Previous), None);
        assert_eq!(target(&leaves, 9, Go::First), Some(3));
        assert_eq!(target(&[], 0, Go::First), None);
    }
}
