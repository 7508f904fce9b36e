//! The view in the task *Ray*: it glides to the side of the selected ray, and returns to what it showed
//! when the task ends.

use super::camera::ViewCamera;
use super::ray_task::Before;
use super::settings::Cells;
use super::side_view;
use super::view::View3d;
use crate::gui::document::Document;
use std::sync::Arc;

impl View3d {
    /// Begins the task or ends it, as the window did.
    pub fn follow_task(&mut self, doc: &Document) {
        if doc.task == "ray" {
            if self.ray_task.before().is_none() {
                self.ray_task.begin(Before {
                    camera: self.camera,
                    settings: self.settings,
                    own: self.own,
                });
                self.settings.linked = false;
                self.settings.cells = Cells::Visited;
                self.settings.cut.on = false;
                self.own = true;
            }
        } else {
            self.end_ray_task();
        }
    }

    /// Shows again what was shown before the task.
    pub fn end_ray_task(&mut self) {
        if let Some(before) = std::mem::take(&mut self.ray_task).end() {
            let aspect = self.camera.aspect;
            self.camera = ViewCamera {
                aspect,
                ..before.camera
            };
            self.settings = before.settings;
            self.own = before.own;
        }
    }

    /// Moves the camera to the side of the selected ray; returns whether it moved. It needs the size of
    /// the pane.
    pub fn glide(&mut self, doc: &Document, ctx: &egui::Context) -> bool {
        if self.ray_task.before().is_none() {
            return false;
        }
        let now = ctx.input(|i| i.time);
        let aspect = self.camera.aspect;
        if let Some(current) = &doc.current
            && let Some(picked) = &current.picked
        {
            let (scene, tree) = (&current.shown.scene, &current.shown.tree);
            let (from, path) = (self.camera.camera, picked.path());
            if !self.ray_task.is_beside(&picked.record, picked.ray) {
                // Where it sees the ray well, such as that of the pixel beside the last, it stays.
                let to = if side_view::is_beside(&self.camera, scene, tree, path) {
                    from
                } else {
                    side_view::side_view(&self.camera, scene, tree, path)
                };
                let beside = (Arc::clone(&picked.record), picked.ray);
                self.ray_task.glide(beside, [from, to], aspect, now);
            } else if self.ray_task.is_reshaped(aspect) {
                let view = self.camera;
                let framed = |camera| {
                    let view = ViewCamera { camera, ..view };
                    side_view::framed(&view, tree, path)
                };
                self.camera.camera = self.ray_task.reframe(from, aspect, framed);
                return true;
            }
        }
        // With reduced motion there are no animations.
        let is_animated = ctx.global_style().animation_time > 0.0;
        let Some(camera) = self.ray_task.camera(now, is_animated) else {
            return false;
        };
        self.camera.camera = camera;
        ctx.request_repaint();
        true
    }
}
