//! The build of the tree step by step: which moment of it the panes show, and how it plays.

use crate::structure::{Moment, Tree};
use std::ops::RangeInclusive;

/// The speeds that can be chosen, in steps per second.
pub const RATES: RangeInclusive<f64> = 0.5..=100_000.0;

/// Which moment of the build is shown.
pub struct BuildView {
    /// Whether a moment of the build is shown rather than the finished tree.
    pub on: bool,
    /// Node by node rather than depth by depth.
    pub by_node: bool,
    /// The node that is decided next; as many as there are nodes once all are decided.
    pub node: u32,
    pub depth: u32,
    /// When the last step was taken, in seconds, while the build is played.
    pub playing: Option<f64>,
    /// Steps per second.
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
