//! What the window shows, to and from a workspace.

use super::picked::Wish;
use super::restoring::Restoring;
use super::selection::Selection;
use super::{Current, Document, Wanted};
use crate::gui::widgets::rounded::rounded;
use crate::measure::heat::heatmaps;
use crate::setup::Setup;
use crate::workspace::{Selected, Workspace};

impl Document {
    /// What is wanted and selected, as a workspace; what the panes show is left to them.
    pub fn workspace(&self) -> Workspace {
        let Wanted { a, b } = self.all_wanted();
        let mut workspace = Workspace::new(a);
        workspace.b = b;
        workspace.notes.clone_from(&self.notes);
        let view = &mut workspace.view;
        view.front = self.which;
        view.arrangement = self.comparing.view;
        view.split = rounded(self.comparing.split);
        view.pinned.clone_from(&self.pinned);
        view.region = self.region;
        view.heatmap.show = self
            .heatmap
            .map(|place| heatmaps()[place].symbol.to_owned());
        if let Some(restoring) = &self.restoring {
            view.selected = restoring.selected;
            view.build = restoring.build;
            view.ranges.clone_from(&restoring.ranges);
        } else {
            view.selected = self.current.as_ref().map(selected).unwrap_or_default();
            view.build = self.inspect.build.moment();
            view.ranges = self.inspect.named_ranges();
        }
        workspace
    }

    /// Wants what a workspace says; pictures are at most `largest` pixels wide and high.
    pub fn restore(&mut self, workspace: &Workspace, largest: u32) {
        let limited = |setup: &Setup| {
            let mut setup = setup.clone();
            setup.render.width = setup.render.width.min(largest);
            setup.render.height = setup.render.height.min(largest);
            setup
        };
        let (a, b) = (limited(&workspace.a), workspace.b.as_ref().map(limited));
        self.want(Wanted { a, b });
        let view = &workspace.view;
        self.show(view.front);
        self.comparing.view = view.arrangement;
        self.comparing.split = view.split as f32;
        self.notes.clone_from(&workspace.notes);
        self.pinned.clone_from(&view.pinned);
        self.region = view.region;
        let kept = view.heatmap.show.as_deref();
        self.heatmap = heatmaps().iter().position(|map| Some(map.symbol) == kept);
        self.restoring = Some(Restoring {
            selected: view.selected,
            build: view.build,
            ranges: view.ranges.clone(),
            asked: false,
        });
        self.failure = None;
        self.stopped = false;
    }

    /// Selects again what a workspace had selected, as soon as its picture and its rays are there;
    /// once a frame.
    pub fn restore_selection(&mut self) {
        if self.is_previous() {
            return;
        }
        let (Some(restoring), Some(current)) = (&mut self.restoring, &mut self.current) else {
            return;
        };
        let Selected {
            pixel,
            ray,
            step,
            node,
            object,
        } = restoring.selected;
        if !std::mem::replace(&mut restoring.asked, true) {
            current.unpick();
            if let Some(pixel) = pixel {
                current.pick(pixel);
                current.wish = current.wish.map(|wish| Wish { ray, ..wish });
            }
        }
        if current.wish.is_some() {
            return;
        }
        self.inspect.select_ranges(&restoring.ranges);
        self.inspect
            .build
            .show(restoring.build, &current.shown.tree);
        current.go_to_step(step);
        let (nodes, objects) = (
            current.shown.tree.nodes().len(),
            current.shown.scene.objects().len(),
        );
        current.selection = Selection {
            node: node.filter(|&node| (node as usize) < nodes),
            object: object.filter(|&object| (object as usize) < objects),
        };
        self.restoring = None;
    }

    /// Pins the picked pixel, or takes its pin away.
    pub fn pin_or_unpin(&mut self) {
        let picked = self.current.as_ref().and_then(Current::picked_pixel);
        let Some(pixel) = picked else {
            return;
        };
        match self.pinned.iter().position(|pinned| *pinned == pixel) {
            Some(place) => {
                self.pinned.remove(place);
            }
            None => self.pinned.push(pixel),
        }
    }
}

fn selected(current: &Current) -> Selected {
    let picked = current.picked.as_ref().filter(|_| current.wish.is_none());
    Selected {
        pixel: current.picked_pixel(),
        ray: current
            .wish
            .map_or_else(|| picked.map_or(0, |picked| picked.ray), |wish| wish.ray),
        step: picked.map_or(0, |picked| picked.step),
        node: current.selection.node,
        object: current.selection.object,
    }
}
