//! The picked pixel: its rays, which of them is selected, and the step its walk has been followed
//! to; by hand or by itself.

use super::state::{Current, State};
use super::tasks::Latest;
use crate::trace::{PixelRecord, RayPath, Step, record_pixel_within};
use std::sync::Arc;
use std::time::Duration;

/// The most steps and tests of a pixel's rays that are kept: some 100 MiB.
const MOST_RECORDED: usize = 1_000_000;

/// How long a frame waits for a record, rather than to show the pixel a frame later.
const PATIENCE: Duration = Duration::from_millis(2);

/// The speeds that can be chosen, in steps a second.
pub const RATES: std::ops::RangeInclusive<f64> = 0.5..=60.0;

/// A pixel whose rays are to be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wish {
    pub pixel: [u32; 2],
    /// The ray to be selected, by its place.
    pub ray: usize,
}

/// A pixel whose rays were followed.
pub struct Picked {
    pub pixel: [u32; 2],
    pub record: Arc<PixelRecord>,
    /// The selected ray, by its place in the record.
    pub ray: usize,
    /// The current step of its walk; 0 where it has none.
    pub step: usize,
}

impl Picked {
    /// The selected ray.
    pub fn path(&self) -> &RayPath {
        &self.record.rays[self.ray].path
    }

    /// The primary ray.
    pub fn primary(&self) -> &RayPath {
        &self.record.rays[0].path
    }

    /// The current step; `None` where the ray misses the tree.
    pub fn current(&self) -> Option<&Step> {
        self.path().steps.get(self.step)
    }
}

/// Where to go in a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Go {
    First,
    Previous,
    Next,
    Last,
}

/// How walks are followed.
pub struct Walking {
    records: Latest<(u64, [u32; 2]), PixelRecord>,
    /// When the last step was taken while the walk plays, in seconds; `None` while it does not.
    playing: Option<f64>,
    /// Steps a second.
    pub rate: f64,
    /// Inner nodes are passed over.
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

/// The steps that are shown, by their places: all or the leaves.
pub fn listed(path: &RayPath, leaves_only: bool) -> Vec<usize> {
    let shown = |step: &Step| !leaves_only || matches!(step, Step::Leaf(_));
    let steps = path.steps.iter().enumerate();
    steps
        .filter_map(|(i, step)| shown(step).then_some(i))
        .collect()
}

/// Where a move leads in a list of steps; `None` where it leads nowhere.
fn target(listed: &[usize], step: usize, go: Go) -> Option<usize> {
    let to = match go {
        Go::First => listed.first(),
        Go::Last => listed.last(),
        Go::Next => listed.iter().find(|&&i| i > step),
        Go::Previous => listed.iter().rev().find(|&&i| i < step),
    };
    to.copied().filter(|&to| to != step)
}

impl Current {
    /// Asks for the rays of a pixel; one outside the picture picks none.
    pub fn pick(&mut self, [x, y]: [u32; 2]) {
        let inside = x < self.shown.setup.render.width && y < self.shown.setup.render.height;
        self.wish = inside.then_some(Wish {
            pixel: [x, y],
            ray: 0,
        });
    }

    /// Follows no pixel's rays any more.
    pub fn unpick(&mut self) {
        (self.wish, self.picked) = (None, None);
    }

    /// The pixel that is picked, be its rays followed yet or not.
    pub fn picked_pixel(&self) -> Option<[u32; 2]> {
        let wished = self.wish.map(|wish| wish.pixel);
        wished.or(self.picked.as_ref().map(|picked| picked.pixel))
    }

    /// Selects a ray, at the beginning of its walk.
    pub fn select_ray(&mut self, ray: usize) {
        if let Some(picked) = &mut self.picked
            && ray < picked.record.rays.len()
        {
            picked.ray = ray;
            self.go_to_step(0);
        }
    }

    /// Goes to a step of the walk, and selects its node.
    pub fn go_to_step(&mut self, step: usize) {
        if let Some(picked) = &mut self.picked {
            picked.step = step.min(picked.path().steps.len().saturating_sub(1));
            self.selection.node = picked.current().map(Step::node);
        }
    }
}

impl State {
    /// Follows the rays of the pixel that is wished for, and plays the walk; once a frame.
    pub fn follow_rays(&mut self, ctx: &egui::Context) {
        if let Some(current) = &mut self.current {
            current.grant(&mut self.walking.records, ctx);
        }
        self.play_on(ctx);
    }

    /// Whether the walk goes on by itself.
    pub fn is_playing(&self) -> bool {
        self.walking.playing.is_some()
    }

    /// Lets the walk go on by itself from where it is, from the beginning if it is over; or stops.
    pub fn play_or_pause(&mut self, now: f64) {
        if self.walking.playing.take().is_some() {
            return;
        }
        if self.step_to(Go::Next).is_none() {
            self.go(Go::First);
        }
        if self.step_to(Go::Next).is_some() {
            self.walking.playing = Some(now);
        }
    }

    /// Where a move leads; `None` where it leads nowhere.
    pub fn step_to(&self, go: Go) -> Option<usize> {
        let picked = self.current.as_ref()?.picked.as_ref()?;
        let listed = listed(picked.path(), self.walking.leaves_only);
        target(&listed, picked.step, go)
    }

    /// Goes there.
    pub fn go(&mut self, go: Go) {
        if let (Some(step), Some(current)) = (self.step_to(go), &mut self.current) {
            current.go_to_step(step);
        }
    }

    /// Selects the next or the previous ray.
    pub fn next_ray(&mut self, by: isize) {
        if let Some(current) = &mut self.current
            && let Some(picked) = &current.picked
            && let Some(ray) = picked.ray.checked_add_signed(by)
        {
            current.select_ray(ray);
        }
    }

    /// Passes over inner nodes, or not. The current step is then a leaf: the next one, if any.
    pub fn set_leaves_only(&mut self, only: bool) {
        self.walking.leaves_only = only;
        let picked = self.current.as_ref().and_then(|c| c.picked.as_ref());
        if only && matches!(picked.and_then(Picked::current), Some(Step::Inner(_))) {
            let to = self.step_to(Go::Next).or(self.step_to(Go::Last));
            if let (Some(step), Some(current)) = (to, &mut self.current) {
                current.go_to_step(step);
            }
        }
    }

    fn play_on(&mut self, ctx: &egui::Context) {
        let Some(then) = self.walking.playing else {
            return;
        };
        let period = 1.0 / self.walking.rate;
        let now = ctx.input(|i| i.time);
        // A frame may take longer than a step.
        let due = ((now - then) / period + 1e-6).floor();
        for _ in 0..due as u32 {
            self.go(Go::Next);
        }
        if self.step_to(Go::Next).is_none() {
            self.walking.playing = None;
            return;
        }
        let then = then + due * period;
        self.walking.playing = Some(then);
        ctx.request_repaint_after_secs((then + period - now).max(0.0) as f32);
    }
}

impl Current {
    fn grant(&mut self, records: &mut Latest<(u64, [u32; 2]), PixelRecord>, ctx: &egui::Context) {
        let Some(wish) = self.wish else {
            return;
        };
        if self.shown.setup.render.view(&self.shown.scene).is_err() {
            self.unpick();
            return;
        }
        let (scene, tree) = (Arc::clone(&self.shown.scene), Arc::clone(&self.shown.tree));
        let render = self.shown.setup.render;
        let key = (self.number, wish.pixel);
        let make = move || {
            record_pixel_within(&scene, &tree, &render, wish.pixel, MOST_RECORDED)
                .expect("the camera has a view")
        };
        if let Some(record) = records.get_soon(&key, ctx, PATIENCE, make) {
            self.wish = None;
            let hit = record.rays[0].path.hit;
            self.selection.object = hit.is_hit().then_some(hit.object);
            self.picked = Some(Picked {
                pixel: wish.pixel,
                ray: wish.ray.min(record.rays.len() - 1),
                record,
                step: 0,
            });
            self.go_to_step(0);
        }
    }
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
