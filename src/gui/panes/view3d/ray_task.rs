//! What the task *Ray* changes in the view for as long as it lasts.

use super::camera::ViewCamera;
use super::settings::Settings;
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
    /// Width of the pane by its height, for which the camera frames the ray; `None` once the user moved
    /// the camera.
    aspect: Option<f64>,
}

impl RayTask {
    /// Begins the task; `before` is shown again when it ends.
    pub fn begin(&mut self, before: Before) {
        self.before = Some(before);
    }

    /// Ends the task; returns what the view showed before.
    pub fn end(self) -> Option<Before> {
        self.before
    }

    /// Returns what the view showed before the task; `None` outside of it.
    pub fn before(&self) -> Option<&Before> {
        self.before.as_ref()
    }

    /// Returns whether the camera is beside this ray, or on the way there.
    pub fn is_beside(&self, record: &Arc<PixelRecord>, ray: usize) -> bool {
        self.beside
            .as_ref()
            .is_some_and(|(known, place)| Arc::ptr_eq(known, record) && *place == ray)
    }

    /// Begins to move the camera to a place beside this ray, in a pane of this width by its height.
    pub fn glide(
        &mut self,
        beside: (Arc<PixelRecord>, usize),
        cameras: [Camera; 2],
        aspect: f64,
        now: f64,
    ) {
        let [from, to] = cameras;
        self.beside = Some(beside);
        self.aspect = Some(aspect);
        self.glide = Some(Glide {
            from,
            to,
            start: now,
        });
    }

    /// Returns where the camera is now; `None` while nothing moves it. Without animation it arrives at
    /// once.
    pub fn camera(&mut self, now: f64, is_animated: bool) -> Option<Camera> {
        let glide = self.glide.as_ref()?;
        let done = if is_animated {
            ((now - glide.start) / GLIDE).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let camera = between(&glide.from, &glide.to, done);
        if done >= 1.0 {
            self.glide = None;
        }
        Some(camera)
    }

    /// Returns whether the pane has another shape than the one for which the camera frames the ray.
    pub fn is_reshaped(&self, aspect: f64) -> bool {
        self.aspect.is_some_and(|known| known != aspect)
    }

    /// Frames the ray in a pane of this width by its height, with the camera that `framed` makes of the
    /// one at the end of the movement. Returns the camera, which is there at once.
    pub fn reframe(
        &mut self,
        now: Camera,
        aspect: f64,
        framed: impl FnOnce(Camera) -> Camera,
    ) -> Camera {
        self.aspect = Some(aspect);
        let end = self.glide.take().map_or(now, |glide| glide.to);
        framed(end)
    }

    /// Ends a movement of the camera, which the mouse or a key moves now.
    pub fn stop(&mut self) {
        (self.glide, self.aspect) = (None, None);
    }

    /// Takes over the camera of a scene that was opened during the task.
    pub fn open(&mut self, camera: Camera) {
        if let Some(before) = &mut self.before {
            before.camera.camera = camera;
            before.own = false;
        }
        (self.beside, self.glide, self.aspect) = (None, None, None);
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
