//! Default camera and lights for files without them.

use crate::geometry::{Aabb, Vec3};
use crate::primitive::{Primitive, Shape};
use crate::scene::camera::Camera;
use crate::scene::material::Light;
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;

/// Background for formats without one: gray, so that both dark and light objects stand out.
pub(super) const BACKGROUND: Vec3 = Vec3::splat(0.18);

/// Full field of view in degrees.
const ANGLE: f64 = 40.0;

/// Default width and height in pixels.
pub(super) const RESOLUTION: u32 = 512;

/// Factor on the distance of the eye, so that nothing touches the edge of the picture.
const MARGIN: f64 = 1.05;

/// Returns the tight bounding box of all objects.
pub(super) fn bounds(objects: &[Primitive]) -> Aabb {
    let around = |bounds: Aabb, object: &Primitive| bounds.union(&object.bounds());
    objects.iter().fold(Aabb::EMPTY, around)
}

/// Returns a camera that frames `bounds` from the front, slightly from the right and above. The
/// front faces Z if `up` is Y, and −Y if `up` is Z. If `bounds` is empty or too extreme for `f64`,
/// the camera frames the unit cube around the origin.
pub(super) fn camera(bounds: &Aabb, up: Vec3) -> Camera {
    let front = if up == Vec3::Z { Vec3::NEG_Y } else { Vec3::Z };
    let right = up.cross(front);
    let backward = (front + 0.5 * right + 0.4 * up).normalize();
    let framing = |bounds: &Aabb| {
        let center = bounds.center();
        let across = up.cross(backward).normalize();
        let above = backward.cross(across);
        let slope = libm::tan(0.5 * ANGLE.to_radians());
        let distance = bounds.corners().iter().fold(0.0_f64, |distance, corner| {
            let offset = *corner - center;
            let lateral = offset.dot(across).abs().max(offset.dot(above).abs());
            distance.max(lateral / slope + offset.dot(backward))
        });
        Camera {
            from: center + MARGIN * distance * backward,
            at: center,
            up,
            angle: ANGLE,
            near: 0.01 * distance,
            resolution: [RESOLUTION; 2],
        }
    };
    let camera = framing(bounds);
    if !bounds.is_empty() && camera.frame().is_ok() {
        camera
    } else {
        framing(&Aabb::new(Vec3::NEG_ONE, Vec3::ONE))
    }
}

/// Adds default lights to a scene that has objects but no light, with a note. If the eye is inside
/// the bounding box of the objects, the light is at the eye. Otherwise there are two lights outside
/// the box: a bright one at the upper left of the eye and a faint one at its right.
pub(super) fn lights(parts: &mut SceneParts) {
    let bounds = bounds(&parts.objects);
    let Ok([forward, right, up]) = parts.camera.frame() else {
        return;
    };
    if !parts.lights.is_empty() || bounds.is_empty() {
        return;
    }
    let eye = parts.camera.from;
    let text = if bounds.contains(eye) {
        parts.lights.push(Light {
            position: eye,
            color: None,
        });
        "no light in the file; using one at the eye"
    } else {
        let far = 2.0 * bounds.size().length();
        for (side, height, brightness) in [(-0.8, 1.0, 0.7), (1.0, 0.2, 0.3)] {
            let direction = side * right + height * up - forward;
            parts.lights.push(Light {
                position: bounds.center() + far * direction,
                color: Some(Vec3::splat(brightness)),
            });
        }
        "no light in the file; using two, at the upper left and at the right of the eye"
    };
    parts.notes.push(Note::new(NoteKind::Defaulted, text));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Sampling;

    /// Every corner of the box is visible, and one is near the edge of the picture.
    #[test]
    fn a_camera_frames_its_box() {
        let boxes = [
            Aabb::new(Vec3::NEG_ONE, Vec3::ONE),
            Aabb::new(Vec3::new(1e6, 2e6, 3e6), Vec3::new(1.1e6, 2e6, 3.7e6)),
            Aabb::new(Vec3::ZERO, Vec3::new(1e-6, 1e-9, 1e-7)),
            Aabb::new(Vec3::new(-3.0, 0.0, 0.0), Vec3::new(500.0, 1.0, 2.0)),
        ];
        for up in [Vec3::Y, Vec3::Z] {
            for bounds in &boxes {
                let camera = camera(bounds, up);
                let view = camera.view(100, 100, Sampling::Center).unwrap();
                let mut widest = 0.0_f64;
                for corner in bounds.corners() {
                    let [place, _] = view.project_line([corner, bounds.center()]).unwrap();
                    for along in place {
                        assert!((0.0..=100.0).contains(&along), "{bounds:?} {place:?}");
                        widest = widest.max((along - 50.0).abs());
                    }
                }
                assert!(widest > 44.0, "{bounds:?}: {widest}");
            }
        }
    }

    #[test]
    fn there_is_a_camera_whatever_the_box() {
        let huge = Aabb::new(Vec3::splat(-1e308), Vec3::splat(1e308));
        let point = Aabb::new(Vec3::splat(1e20), Vec3::splat(1e20));
        for bounds in [Aabb::EMPTY, huge, point] {
            assert!(camera(&bounds, Vec3::Y).frame().is_ok(), "{bounds:?}");
        }
    }
}
