//! The document's picked ray: recorded when a pixel is picked, stepped through by hand or played.

use super::Document;
use super::picked::Picked;
use super::walk::{Go, listed, target};
use crate::trace::Step;

impl Document {
    /// Records the rays of a pixel that was picked, and plays their steps; once per frame.
    pub fn follow_rays(&mut self, ctx: &egui::Context) {
        if let Some(current) = &mut self.current {
            self.walking.grant(current, ctx);
        }
        self.play_on(ctx);
    }

    /// Returns whether steps are played.
    pub fn is_playing(&self) -> bool {
        self.walking.playing.is_some()
    }

    /// Plays the steps from the current one, from the first if it is the last; or pauses.
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

    /// Returns where a move leads; `None` where it leads nowhere.
    pub fn step_to(&self, go: Go) -> Option<usize> {
        let picked = self.current.as_ref()?.picked.as_ref()?;
        let listed = listed(picked.path(), self.walking.leaves_only);
        target(&listed, picked.step, go)
    }

    /// Makes a move.
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

    /// Skips inner nodes, or not. The current step is then a leaf: the next one, if any.
    pub fn set_leaves_only(&mut self, only: bool) {
        self.walking.leaves_only = only;
        let picked = self.current.as_ref().and_then(|c| c.picked.as_ref());
        let current = picked.and_then(Picked::current);
        if only && current.is_some_and(|step| !matches!(step, Step::Leaf(_))) {
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
