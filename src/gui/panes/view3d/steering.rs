//! Where the view's camera is: it follows the picture's until the mouse or a key moves it.

use super::marks;
use super::view::View3d;
use crate::geometry::Vec3;
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::present::overlay::Filter;
use crate::primitive::Precision;
use crate::trace::{Scratch, closest_hit};
use egui::Rect;
use std::sync::Arc;

impl View3d {
    /// Follows a new scene and, unless the view has a camera of its own, the picture's camera.
    pub(super) fn follow(&mut self, doc: &Document) {
        self.follow_task(doc);
        let Some(current) = &doc.current else {
            return;
        };
        let shown = &current.shown;
        let camera = shown.measurement.camera;
        let known = self.scene.as_ref();
        if !known.is_some_and(|scene| Arc::ptr_eq(scene, &shown.scene)) {
            self.scene = Some(Arc::clone(&shown.scene));
            self.settings.filter.depth = Filter::default().depth;
            self.ray_task.open(camera);
            self.own = self.ray_task.before().is_some();
            self.camera.camera = camera;
        }
        // While the user moves the linked camera, the picture's is one of before.
        let follows = !(self.own || self.settings.linked && doc.is_previous());
        if follows {
            self.camera.camera = camera;
        }
        if !doc.is_previous()
            && let Some(kept) = self.restoring.take()
        {
            self.end_ray_task();
            self.camera.camera = camera;
            self.take_over(&kept);
            self.follow_task(doc);
        }
    }

    /// Links the picture's camera to this view's, which goes where the picture's is; or ends that.
    pub(super) fn link(&mut self, linked: bool, doc: &Document) {
        self.settings.linked = linked;
        self.own = false;
        self.ray_task.stop();
        if let Some(current) = &doc.current {
            self.camera.camera = current.shown.measurement.camera;
        }
    }

    /// Takes note that the user moved the camera. The picture's camera moves along only while linked.
    pub(super) fn camera_moved(&mut self, edits: &mut Edits) {
        self.ray_task.stop();
        if self.settings.linked {
            let camera = self.camera.camera;
            edits.add(move |doc| doc.wanted.render.camera = camera.into());
        } else {
            self.own = true;
        }
    }

    /// Moves the camera by mouse and keys; returns whether it moved.
    pub(super) fn steer(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        doc: &Document,
    ) -> bool {
        let rect = response.rect;
        let mut moved = false;
        let by = response.drag_delta() / rect.height();
        let (dx, dy) = (f64::from(by.x), f64::from(by.y));
        if by != egui::Vec2::ZERO {
            if response.dragged_by(egui::PointerButton::Primary) {
                self.camera.orbit(dx, dy);
                moved = true;
            } else if response.dragged_by(egui::PointerButton::Secondary)
                || response.dragged_by(egui::PointerButton::Middle)
            {
                self.camera.pan(dx, dy);
                moved = true;
            }
        }
        let wheel = ui.input(|i| i.smooth_scroll_delta().y);
        if wheel != 0.0
            && let Some(pointer) = response.hover_pos()
        {
            let factor = libm::exp(-f64::from(wheel) * 0.004);
            self.camera
                .zoom(factor, self.point_under(pointer, rect, doc));
            moved = true;
        }
        if std::mem::take(&mut self.keyed) {
            moved = true;
            // A key that is held keeps moving.
            ui.ctx().request_repaint();
        }
        moved
    }

    /// Shows the node that another pane asks for; returns whether there was one.
    pub(super) fn frame_wanted(&mut self, doc: &Document, edits: &mut Edits) -> bool {
        let (Some(node), Some(current)) = (doc.inspect.frame, &doc.current) else {
            return false;
        };
        edits.add(|doc| doc.inspect.frame = None);
        self.camera.show(&current.shown.tree.cell_of(node).bounds);
        true
    }

    /// Selects the leaf or cell whose box is clicked.
    pub(super) fn pick(
        &self,
        rect: Rect,
        response: &egui::Response,
        doc: &Document,
        edits: &mut Edits,
    ) {
        if let Some(at) = response.interact_pointer_pos()
            && response.clicked()
        {
            let at = (at - rect.center()) / (rect.height() * 0.5);
            let ray = self.camera.ray(f64::from(at.x), f64::from(-at.y));
            let node = marks::pick_cell(doc, &self.settings, &ray);
            edits.add(move |doc| {
                if let Some(current) = &mut doc.current {
                    current.selection.node = node;
                }
            });
        }
    }

    /// The point of the scene under the pointer; where there is none, at the orbited distance.
    fn point_under(&self, pointer: egui::Pos2, rect: Rect, doc: &Document) -> Vec3 {
        let half = rect.height() * 0.5;
        let at = (pointer - rect.center()) / half;
        let ray = self.camera.ray(f64::from(at.x), f64::from(-at.y));
        if let Some(current) = &doc.current {
            let (scene, tree) = (&current.shown.scene, &current.shown.tree);
            let shapes = scene.shapes(Precision::F64);
            let hit = closest_hit(tree, shapes, &ray, &mut Scratch::default(), &mut ());
            if hit.is_hit() {
                return ray.at(hit.t);
            }
        }
        self.camera.on_target_plane(&ray)
    }
}
