//! The pinhole camera, as NFF describes it, and the primary rays through its pixels.

use crate::geometry::{Ray, Vec3};
use serde::{Deserialize, Serialize};

/// A pinhole camera, as NFF describes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Position of the eye.
    pub from: Vec3,
    /// A point on the line of sight.
    pub at: Vec3,
    /// Up direction; need not be perpendicular to the line of sight.
    pub up: Vec3,
    /// Full vertical field of view in degrees, above 0 and below 180. The horizontal field of view
    /// follows from the aspect ratio.
    pub angle: f64,
    /// Distance of the near plane (NFF's `hither`). Kept for writing; rays start at the eye.
    #[serde(alias = "hither")]
    pub near: f64,
    /// The scene's own width and height in pixels.
    pub resolution: [u32; 2],
}

/// Why a camera is invalid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    #[error("the camera has a number that is not finite")]
    NotFinite,
    #[error("the camera looks at its own position")]
    NoDirection,
    #[error("the up vector is zero or parallel to the line of sight")]
    NoUp,
    #[error("the angle of view is {0} degrees; it must be above 0 and below 180")]
    Angle(f64),
}

/// Position of a pixel's first sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sampling {
    /// At the pixel center; the angle of view spans the outer edges of the outermost pixels.
    #[default]
    Center,
    /// On a lattice whose first and last samples span the angle of view, as in the SPD.
    Corner,
}

impl Sampling {
    pub const ALL: [Sampling; 2] = [Sampling::Center, Sampling::Corner];

    /// `center` or `corner`.
    pub const fn name(self) -> &'static str {
        match self {
            Sampling::Center => "center",
            Sampling::Corner => "corner",
        }
    }
}

/// A camera prepared for a picture of a given size; generates primary rays.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: Vec3,
    forward: Vec3,
    /// Half the picture's width and height at distance 1, as vectors pointing right and up.
    right: Vec3,
    up: Vec3,
    width: u32,
    height: u32,
    sampling: Sampling,
}

impl Camera {
    /// Returns the forward, right and up directions: orthogonal unit vectors.
    ///
    /// # Errors
    /// The view or up direction is degenerate, the angle is outside (0, 180), or a number is not
    /// finite.
    pub fn frame(&self) -> Result<[Vec3; 3], CameraError> {
        if !(self.from.is_finite() && self.at.is_finite() && self.up.is_finite()) {
            return Err(CameraError::NotFinite);
        }
        if !(self.angle > 0.0 && self.angle < 180.0) {
            return Err(CameraError::Angle(self.angle));
        }
        let forward = unit(self.at - self.from).ok_or(CameraError::NoDirection)?;
        let up = unit(self.up).ok_or(CameraError::NoUp)?;
        let across = forward.cross(up);
        if across.length() < 1e-9 {
            return Err(CameraError::NoUp);
        }
        let right = across.normalize();
        Ok([forward, right, right.cross(forward)])
    }

    /// Prepares the camera for a picture of `width` × `height` pixels.
    ///
    /// # Errors
    /// The same as for [`Camera::frame`].
    pub fn view(&self, width: u32, height: u32, sampling: Sampling) -> Result<View, CameraError> {
        let [forward, right, up] = self.frame()?;
        let half_height = libm::tan(self.angle.to_radians() * 0.5);
        let half_width = half_height * f64::from(width) / f64::from(height.max(1));
        Ok(View {
            eye: self.from,
            forward,
            right: right * half_width,
            up: up * half_height,
            width,
            height,
            sampling,
        })
    }
}

impl View {
    /// Width and height in pixels.
    pub const fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Returns the primary ray of sample number `sample` in pixel (`x`, `y`), where (0, 0) is the
    /// upper left pixel. Its direction has unit length.
    ///
    /// [`Sampling`] defines where sample 0 lies. The samples after it follow the R₂ sequence around
    /// it (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
    pub fn primary_ray(&self, x: u32, y: u32, sample: u32) -> Ray {
        const G1: f64 = 0.754_877_666_246_692_8;
        const G2: f64 = 0.569_840_290_998_053_2;
        let shift = |g: f64| {
            let u = 0.5 + g * f64::from(sample);
            u - u.floor() - 0.5
        };
        let (sx, sy) = (f64::from(x) + shift(G1), f64::from(y) + shift(G2));
        let place = |s: f64, n: u32| match self.sampling {
            Sampling::Center => (2.0 * s + 1.0) / f64::from(n) - 1.0,
            Sampling::Corner if n > 1 => 2.0 * s / f64::from(n - 1) - 1.0,
            Sampling::Corner => 0.0,
        };
        let (u, v) = (place(sx, self.width), -place(sy, self.height));
        let direction = self.forward + u * self.right + v * self.up;
        Ray::new(self.eye, direction.normalize())
    }
}

impl View {
    /// Projects a line segment into the picture, in pixels from the upper left corner; the center
    /// of pixel (0, 0) is (0.5, 0.5). The part behind the eye is clipped. Returns `None` if all of
    /// the segment is behind the eye.
    pub fn project_line(&self, ends: [Vec3; 2]) -> Option<[[f64; 2]; 2]> {
        let [a, b] = ends.map(|end| end - self.eye);
        let [depth_a, depth_b] = [a, b].map(|end| end.dot(self.forward));
        // A near plane at a distance that is tiny compared with the segment.
        let near = 1e-6 * (a.length() + b.length());
        if depth_a.max(depth_b) <= near {
            return None;
        }
        let cut = |end: Vec3, depth: f64, other: Vec3, other_depth: f64| {
            if depth >= near {
                end
            } else {
                end + (other - end) * ((near - depth) / (other_depth - depth))
            }
        };
        let visible = [cut(a, depth_a, b, depth_b), cut(b, depth_b, a, depth_a)];
        Some(visible.map(|end| self.place(end)))
    }

    /// Projects a point in front of the eye, relative to the eye, into the picture.
    fn place(&self, point: Vec3) -> [f64; 2] {
        let depth = point.dot(self.forward);
        let along = |side: Vec3| point.dot(side) / (side.length_squared() * depth);
        let pixel = |place: f64, n: u32| match self.sampling {
            Sampling::Corner if n > 1 => (place + 1.0) * 0.5 * f64::from(n - 1) + 0.5,
            _ => (place + 1.0) * 0.5 * f64::from(n),
        };
        [
            pixel(along(self.right), self.width),
            pixel(-along(self.up), self.height),
        ]
    }
}

/// Returns the unit vector along `v`, even if the square of its length overflows or underflows.
fn unit(v: Vec3) -> Option<Vec3> {
    let scale = v.abs().max_element();
    if scale > 0.0 && scale.is_finite() {
        Some((v / scale).normalize())
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            from: Vec3::ZERO,
            at: Vec3::Y,
            up: Vec3::Z,
            angle: 90.0,
            near: 1.0,
            resolution: [4, 4],
        }
    }

    #[test]
    fn corner_samples_span_the_angle_and_center_samples_do_not() {
        let corner = camera().view(3, 3, Sampling::Corner).unwrap();
        let first = corner.primary_ray(0, 0, 0).direction;
        assert!((first - Vec3::new(-1.0, 1.0, 1.0).normalize()).length() < 1e-15);
        let center = camera().view(2, 2, Sampling::Center).unwrap();
        let first = center.primary_ray(0, 0, 0).direction;
        assert!((first - Vec3::new(-0.5, 1.0, 0.5).normalize()).length() < 1e-15);
    }

    #[test]
    fn points_on_a_pixels_ray_project_to_its_center() {
        for sampling in [Sampling::Center, Sampling::Corner] {
            let view = camera().view(30, 20, sampling).unwrap();
            for [x, y] in [[0, 0], [29, 19], [7, 13]] {
                let ray = view.primary_ray(x, y, 0);
                let ends = view.project_line([ray.at(0.1), ray.at(50.0)]).unwrap();
                for [u, v] in ends {
                    assert!((u - f64::from(x) - 0.5).abs() < 1e-9);
                    assert!((v - f64::from(y) - 0.5).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn lines_are_clipped_behind_the_eye() {
        let view = camera().view(10, 10, Sampling::Center).unwrap();
        let (ahead, behind) = (Vec3::new(1.0, 2.0, 0.0), Vec3::new(1.0, -3.0, 0.0));
        assert_eq!(view.project_line([behind, behind - Vec3::Y]), None);
        let [a, b] = view.project_line([ahead, behind]).unwrap();
        assert!((a[0] - 7.5).abs() < 1e-9 && (a[1] - 5.0).abs() < 1e-9);
        // The segment leaves the picture on the right as it approaches the eye.
        assert!(b[0] > 1e3 && (b[1] - 5.0).abs() < 1e-9, "{b:?}");
        let [c, d] = view.project_line([behind, ahead]).unwrap();
        assert_eq!([c, d], [b, a]);
    }

    #[test]
    fn cameras_without_a_view_say_why() {
        let mut c = camera();
        c.at = c.from;
        assert_eq!(c.frame(), Err(CameraError::NoDirection));
        let mut c = camera();
        c.up = Vec3::Y;
        assert_eq!(c.frame(), Err(CameraError::NoUp));
        for angle in [0.0, 180.0, f64::NAN] {
            let c = Camera { angle, ..camera() };
            assert!(matches!(c.frame(), Err(CameraError::Angle(_))));
        }
    }

    #[test]
    fn far_away_and_tiny_cameras_keep_their_direction() {
        for scale in [1e-200, 1e200] {
            let mut c = camera();
            c.at = Vec3::Y * scale;
            assert_eq!(c.frame().unwrap()[0], Vec3::Y);
        }
    }
}
