//! The document's build of the tree: stepped through by hand or played.

use super::Document;

impl Document {
    /// Shows the build step by step, or the finished tree.
    pub fn toggle_build(&mut self) {
        let build = &mut self.inspect.build;
        (build.on, build.playing) = (!build.on, None);
        if build.on {
            self.go_in_build(self.inspect.build.position());
        }
    }

    /// Goes by nodes or by depths.
    pub fn set_build_by_node(&mut self, by_node: bool) {
        let build = &mut self.inspect.build;
        (build.by_node, build.playing) = (by_node, None);
        self.go_in_build(self.inspect.build.position());
    }

    /// Shows the build at a position, and selects the node that is decided next.
    pub fn go_in_build(&mut self, position: u32) {
        let Some(current) = &mut self.current else {
            return;
        };
        let build = &mut self.inspect.build;
        let last = build.last(&current.shown.tree);
        let position = position.min(last);
        if build.by_node {
            build.node = position;
            current.selection.node = (position < last).then_some(position);
        } else {
            build.depth = position;
        }
    }

    /// Goes some steps forward, or back.
    pub fn step_build(&mut self, by: i64) {
        let position = i64::from(self.inspect.build.position()) + by;
        self.go_in_build(position.clamp(0, i64::from(u32::MAX)) as u32);
    }

    /// Plays the build from where it stands, from the beginning if it is over; or pauses.
    pub fn play_build(&mut self, now: f64) {
        let Some(current) = &self.current else {
            return;
        };
        let build = &mut self.inspect.build;
        if build.playing.take().is_some() {
            return;
        }
        let over = build.position() >= build.last(&current.shown.tree);
        build.playing = Some(now);
        if over {
            self.go_in_build(0);
        }
    }

    /// Takes the steps that are due while the build is played; once per frame.
    pub fn play_build_on(&mut self, ctx: &egui::Context) {
        let (Some(then), Some(current)) = (self.inspect.build.playing, &self.current) else {
            return;
        };
        let build = &mut self.inspect.build;
        if build.position() >= build.last(&current.shown.tree) {
            build.playing = None;
            return;
        }
        let period = 1.0 / build.rate;
        let now = ctx.input(|i| i.time);
        // A frame may take longer than a step.
        let due = ((now - then) / period + 1e-6).floor().max(0.0);
        let then = then + due * period;
        build.playing = Some(then);
        ctx.request_repaint_after_secs((then + period - now).max(0.0) as f32);
        if due > 0.0 {
            self.step_build(due as i64);
        }
    }
}
