//! The camera of the 3D view: the scene's own kind of camera, and how the mouse moves it.

use crate::geometry::{Aabb, Ray, Vec3};
use crate::scene::Camera;

/// A camera that the mouse moves; `at` is the point it orbits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewCamera {
    pub camera: Camera,
    /// Parallel rays, in this view alone; pictures are always in perspective.
    pub orthographic: bool,
    /// Width of the pane by its height.
    pub aspect: f64,
}

/// The closest that the view comes to straight up and straight down, in radians.
const POLE: f64 = 0.01;

impl Default for ViewCamera {
    /// Stands in until a scene brings its own camera.
    fn default() -> Self {
        ViewCamera {
            camera: Camera {
                from: Vec3::ZERO,
                at: Vec3::Y,
                up: Vec3::Z,
                angle: 45.0,
                near: 1.0,
                resolution: [512, 512],
            },
            orthographic: false,
            aspect: 1.0,
        }
    }
}

impl ViewCamera {
    /// Forward, right and up; the coordinate axes for a camera without a view.
    pub fn frame(&self) -> [Vec3; 3] {
        self.camera.frame().unwrap_or([Vec3::Y, Vec3::X, Vec3::Z])
    }

    /// Distance from the eye to the point it orbits.
    pub fn distance(&self) -> f64 {
        self.camera.from.distance(self.camera.at)
    }

    /// Half of what is seen at distance 1, upwards. In a pane higher than wide, the camera's angle
    /// spans its width, so that a square picture is always seen whole.
    fn half(&self) -> f64 {
        libm::tan(self.camera.angle.to_radians() * 0.5) / self.aspect.clamp(0.05, 1.0)
    }

    /// Length in the scene of a pane's height, at the distance of the point it orbits.
    pub fn height_at_target(&self) -> f64 {
        2.0 * self.half() * self.distance()
    }

    /// Turns around the point it orbits, by fractions of the pane's height.
    pub fn orbit(&mut self, dx: f64, dy: f64) {
        use std::f64::consts::PI;
        let [forward, right, _] = self.frame();
        let pole = self.camera.up.normalize_or(Vec3::Z);
        let pitch = forward.angle_between(pole);
        let tilt = (-dy * PI).clamp(POLE - (PI - pitch), pitch - POLE);
        let turn = glam::DQuat::from_axis_angle(pole, -dx * PI)
            * glam::DQuat::from_axis_angle(right, tilt);
        self.camera.from = self.camera.at + turn * (self.camera.from - self.camera.at);
    }

    /// Moves sideways by fractions of the pane's height, so that the scene follows the pointer.
    pub fn pan(&mut self, dx: f64, dy: f64) {
        let [_, right, up] = self.frame();
        let by = self.height_at_target() * (dy * up - dx * right);
        self.camera.from += by;
        self.camera.at += by;
    }

    /// Comes closer to a point (`factor` below 1) or goes away from it; the point keeps its place
    /// on the screen.
    pub fn zoom(&mut self, factor: f64, point: Vec3) {
        self.camera.from = point + (self.camera.from - point) * factor;
        self.camera.at = point + (self.camera.at - point) * factor;
    }

    /// Moves along its own forward, right and up.
    pub fn fly(&mut self, by: Vec3) {
        let [forward, right, up] = self.frame();
        let by = self.distance() * (by.x * forward + by.y * right + by.z * up);
        self.camera.from += by;
        self.camera.at += by;
    }

    /// Shows all of a box from where it looks now; an empty box changes nothing.
    pub fn show(&mut self, bounds: &Aabb) {
        let radius = bounds.size().length() * 0.5;
        if bounds.is_empty() || !radius.is_finite() {
            return;
        }
        let [forward, ..] = self.frame();
        let half_angle = self.camera.angle.to_radians() * 0.5;
        let distance = radius.max(1e-9 * bounds.magnitude()) / libm::sin(half_angle);
        self.camera.at = bounds.center();
        self.camera.from = self.camera.at - forward * distance.max(f64::MIN_POSITIVE);
    }

    /// Looks along a direction, at the same point from the same distance.
    pub fn look(&mut self, forward: Vec3, up: Vec3) {
        self.camera.from = self.camera.at - forward * self.distance();
        self.camera.up = up;
    }

    /// The ray through a place in the pane: −1 to 1 upwards, `aspect` times that to the right.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let [forward, right, up] = self.frame();
        if self.orthographic {
            let half = self.height_at_target() * 0.5;
            let start = self.camera.from + half * (x * right + y * up);
            // Parallel rays come from behind the eye, too.
            Ray::new(start - forward * self.distance() * 1e3, forward)
        } else {
            let half = self.half();
            let direction = forward + half * (x * right + y * up);
            Ray::new(self.camera.from, direction.normalize())
        }
    }

    /// Where a ray meets the plane through the point it orbits.
    pub fn on_target_plane(&self, ray: &Ray) -> Vec3 {
        let [forward, ..] = self.frame();
        let across = ray.direction.dot(forward).max(1e-6);
        ray.at((self.camera.at - ray.origin).dot(forward) / across)
    }

    /// Place of a point in the pane, as for [`ViewCamera::ray`]; `None` behind the eye.
    pub fn place(&self, point: Vec3) -> Option<[f64; 2]> {
        let [forward, right, up] = self.frame();
        let v = point - self.camera.from;
        let depth = v.dot(forward);
        let scale = if self.orthographic {
            self.height_at_target() * 0.5
        } else if depth > 1e-9 * self.distance() {
            self.half() * depth
        } else {
            return None;
        };
        Some([v.dot(right) / scale, v.dot(up) / scale])
    }

    /// Clip space from the scene relative to `center`, for a scene inside `bounds`.
    pub fn clip_from_scene(&self, center: Vec3, bounds: &Aabb) -> glam::DMat4 {
        use glam::dcamera::rh::{proj::directx as proj, view};
        let [forward, _, up] = self.frame();
        let eye = self.camera.from - center;
        let view = view::look_to_mat4(eye, forward, up);
        let radius = (bounds.size().length() * 0.5).max(1e-12) * 1.01;
        let ahead = (bounds.center() - self.camera.from).dot(forward);
        let half_height = self.height_at_target() * 0.5;
        let projection = if self.orthographic {
            let half_width = half_height * self.aspect;
            let (near, far) = (ahead - radius, ahead + radius);
            proj::orthographic(
                -half_width,
                half_width,
                -half_height,
                half_height,
                near,
                far,
            )
        } else {
            let far = (ahead + radius).max(radius * 1e-3);
            let near = (ahead - radius).max(far * 1e-4);
            let angle = 2.0 * libm::atan(self.half());
            proj::perspective(angle, self.aspect, near, far)
        };
        projection * view
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> ViewCamera {
        ViewCamera {
            camera: Camera {
                from: Vec3::new(0.0, -4.0, 1.0),
                at: Vec3::ZERO,
                up: Vec3::Z,
                angle: 40.0,
                near: 1.0,
                resolution: [8, 8],
            },
            ..ViewCamera::default()
        }
    }

    #[test]
    fn orbiting_keeps_the_distance_and_never_reaches_a_pole() {
        let mut view = camera();
        let distance = view.distance();
        for (dx, dy) in [(0.3, 0.2), (0.0, 9.0), (1.0, -9.0), (0.0, -9.0)] {
            view.orbit(dx, dy);
            assert!((view.distance() - distance).abs() < 1e-9);
            assert!(view.camera.frame().is_ok());
        }
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        for orthographic in [false, true] {
            let mut view = ViewCamera {
                orthographic,
                ..camera()
            };
            let ray = view.ray(0.3, -0.6);
            let point = view.on_target_plane(&ray);
            for factor in [0.5, 3.0] {
                view.zoom(factor, point);
                let [x, y] = view.place(point).unwrap();
                assert!((x - 0.3).abs() < 1e-9 && (y + 0.6).abs() < 1e-9, "{x} {y}");
            }
        }
    }

    #[test]
    fn places_agree_with_the_matrix() {
        let bounds = Aabb::new(Vec3::splat(-1.0), Vec3::ONE);
        for (orthographic, aspect) in [(false, 1.5), (true, 1.5), (false, 0.4)] {
            let view = ViewCamera {
                orthographic,
                aspect,
                ..camera()
            };
            let (center, point) = (Vec3::new(5.0, 0.0, 1.0), Vec3::new(0.2, 0.7, -0.4));
            let clip = view.clip_from_scene(center, &bounds) * (point - center).extend(1.0);
            let [x, y] = view.place(point).unwrap();
            assert!((clip.x / clip.w * aspect - x).abs() < 1e-9);
            assert!((clip.y / clip.w - y).abs() < 1e-9);
            assert!((0.0..=1.0).contains(&(clip.z / clip.w)));
        }
    }
}
