//! The build of the tree step by step: which moment of it the panes show, and how it plays.

use super::state::State;
use crate::structure::{Moment, Tree};
use std::ops::RangeInclusive;

/// The speeds that can be chosen, in steps a second.
pub const RATES: RangeInclusive<f64> = 0.5..=100_000.0;

/// Which moment of the build is shown.
pub struct BuildView {
    /// Whether a moment of the build is shown rather than the finished tree.
    pub on: bool,
    /// Node by node rather than depth by depth.
    pub by_node: bool,
    /// The node that is decided next; as many as there are nodes once all are decided.
    node: u32,
    depth: u32,
    /// When the last step was taken while the build plays, in seconds.
    playing: Option<f64>,
    /// Steps a second.
    pub rate: f64,
}

impl Default for BuildView {
    fn default() -> Self {
        BuildView {
            on: false,
            by_node: true,
            node: 0,
            depth: 0,
            playing: None,
            rate: 4.0,
        }
    }
}

impl BuildView {
    /// The moment that is shown; `None` for the finished tree.
    pub fn moment(&self) -> Option<Moment> {
        self.on.then_some(if self.by_node {
            Moment::Node(self.node)
        } else {
            Moment::Depth(self.depth)
        })
    }

    /// Shows a moment of a tree's build, at the latest the last; `None` is the finished tree.
    pub fn show(&mut self, moment: Option<Moment>, tree: &Tree) {
        (self.on, self.playing) = (moment.is_some(), None);
        if let Some(moment) = moment {
            self.by_node = matches!(moment, Moment::Node(_));
            let last = self.last(tree);
            match moment {
                Moment::Node(node) => self.node = node.min(last),
                Moment::Depth(depth) => self.depth = depth.min(last),
            }
        }
    }

    /// The finished tree again, and for another tree the build from its beginning.
    pub fn reset(&mut self) {
        *self = BuildView {
            by_node: self.by_node,
            rate: self.rate,
            ..BuildView::default()
        };
    }

    /// Where the build stands.
    pub fn position(&self) -> u32 {
        if self.by_node { self.node } else { self.depth }
    }

    /// The position at which the tree is finished.
    pub fn last(&self, tree: &Tree) -> u32 {
        if self.by_node {
            tree.nodes().len() as u32
        } else {
            tree.depth_reached()
        }
    }

    pub fn is_playing(&self) -> bool {
        self.playing.is_some()
    }
}

impl State {
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

    /// Goes some steps on, or back.
    pub fn step_build(&mut self, by: i64) {
        let position = i64::from(self.inspect.build.position()) + by;
        self.go_in_build(position.clamp(0, i64::from(u32::MAX)) as u32);
    }

    /// Lets the build go on by itself from where it is, from the beginning if it is over; or stops.
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

    /// Takes the steps that are due while the build plays; once a frame.
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
