//! The view in the task *Ray*: it glides to the side of the selected ray, and returns to what it showed
//! when the task ends.

use super::View3d;
use super::camera::ViewCamera;
use super::settings::{Cells, Settings};
use super::side_view::side_view;
use crate::gui::document::Document;
use crate::scene::Camera;
use crate::trace::PixelRecord;
use std::sync::Arc;

/// How long the camera glides, in seconds.
const GLIDE: f64 = 0.6;

/// What the view showed before.
pub struct Before {
    pub camera: ViewCamera,
    pub settings: Settings,
    pub own: bool,
}

/// A movement of the camera.
struct Glide {
    from: Camera,
    to: Camera,
    /// When it began, in seconds.
    start: f64,
}

/// The state of the view in the task *Ray*.
#[derive(Default)]
pub struct RayTask {
    before: Option<Before>,
    /// The ray that the camera is beside.
    beside: Option<(Arc<PixelRecord>, usize)>,
    glide: Option<Glide>,
}

impl RayTask {
    /// Returns what the view showed before the task; `None` outside of it.
    pub fn before(&self) -> Option<&Before> {
        self.before.as_ref()
    }

    /// Ends a movement of the camera, which the mouse or a key moves now.
    pub fn stop(&mut self) {
        self.glide = None;
    }

    /// Takes over the camera of a scene that was opened during the task.
    pub fn open(&mut self, camera: Camera) {
        if let Some(before) = &mut self.before {
            before.camera.camera = camera;
            before.own = false;
        }
        (self.beside, self.glide) = (None, None);
    }
}

impl View3d {
    /// Begins the task or ends it, as the window did.
    pub(super) fn follow_task(&mut self, doc: &Document) {
        if doc.task == "ray" {
            if self.ray_task.before.is_none() {
                self.ray_task.before = Some(Before {
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
    pub(super) fn end_ray_task(&mut self) {
        if let Some(before) = std::mem::take(&mut self.ray_task).before {
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
    pub(super) fn glide(&mut self, doc: &Document, ctx: &egui::Context) -> bool {
        if self.ray_task.before.is_none() {
            return false;
        }
        let now = ctx.input(|i| i.time);
        if let Some(current) = &doc.current
            && let Some(picked) = &current.picked
        {
            let is_beside = self.ray_task.beside.as_ref();
            let is_beside = is_beside.is_some_and(|(record, ray)| {
                Arc::ptr_eq(record, &picked.record) && *ray == picked.ray
            });
            if !is_beside {
                let (scene, tree) = (&current.shown.scene, &current.shown.tree);
                let to = side_view(&self.camera, scene, tree, picked.path());
                self.ray_task.beside = Some((Arc::clone(&picked.record), picked.ray));
                self.ray_task.glide = Some(Glide {
                    from: self.camera.camera,
                    to,
                    start: now,
                });
            }
        }
        let Some(glide) = &self.ray_task.glide else {
            return false;
        };
        // Without animations, such as with reduced motion, it is there at once.
        let is_animated = ctx.global_style().animation_time > 0.0;
        let done = if is_animated {
            ((now - glide.start) / GLIDE).clamp(0.0, 1.0)
        } else {
            1.0
        };
        self.camera.camera = between(&glide.from, &glide.to, done);
        if done == 1.0 {
            self.ray_task.glide = None;
        }
        ctx.request_repaint();
        true
    }
}

/// Returns a camera on the way from one to another; `done` is 0 at the beginning and 1 at the end.
fn between(from: &Camera, to: &Camera, done: f64) -> Camera {
    if done >= 1.0 {
        return *to;
    }
    let eased = done * done * (3.0 - 2.0 * done);
    let at = from.at.lerp(to.at, eased);
    let offset = (from.from - from.at).slerp(to.from - to.at, eased);
    Camera {
        from: at + offset,
        at,
        up: from.up.lerp(to.up, eased),
        ..*to
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec3;

    #[test]
    fn a_glide_begins_and_ends_exactly_and_keeps_its_distance() {
        let to = Camera {
            from: Vec3::new(0.0, 4.0, 0.0),
            at: Vec3::ZERO,
            ..ViewCamera::default().camera
        };
        let from = Camera {
            from: Vec3::new(0.0, 0.0, 4.0),
            ..to
        };
        assert_eq!(between(&from, &to, 1.0), to);
        assert!(between(&from, &to, 0.0).from.distance(from.from) < 1e-12);
        for done in [0.2, 0.5, 0.9] {
            let on_the_way = between(&from, &to, done);
            assert!((on_the_way.from.length() - 4.0).abs() < 1e-9);
        }
    }
}
