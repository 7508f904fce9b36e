//! The pinhole camera of NFF and where its samples lie.

use crate::geometry::{Ray, Vec3};
use serde::{Deserialize, Serialize};

/// A pinhole camera as NFF describes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// The eye.
    pub from: Vec3,
    /// A point on the axis of view.
    pub at: Vec3,
    /// Up; need not be perpendicular to the axis of view.
    pub up: Vec3,
    /// Full vertical angle of view in degrees, above 0 and below 180; at 1:1 the horizontal one too.
    pub angle: f64,
    /// Distance of NFF's `hither` plane; kept for writing, ray tracing starts at the eye.
    pub hither: f64,
    /// Width and height in pixels that the scene asks for.
    pub resolution: [u32; 2],
}

/// Why a camera has no view.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    #[error("the camera's numbers are not all finite")]
    NotFinite,
    #[error("the camera looks at the point it stands on")]
    NoDirection,
    #[error("up is zero or along the line of sight")]
    NoUp,
    #[error("the angle of view is {0} degrees; it must lie above 0 and below 180")]
    Angle(f64),
}

/// Where in a pixel its first sample lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sampling {
    /// At the pixel's centre; the angle of view spans the outer edges of the outer pixels.
    #[default]
    Center,
    /// On a lattice whose first and last samples span the angle of view (the SPD's way).
    Corner,
}

/// A camera made ready to give rays for a picture of a certain size.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: Vec3,
    forward: Vec3,
    /// Half the picture's width and height at distance 1, as vectors to the right and up.
    right: Vec3,
    up: Vec3,
    width: u32,
    height: u32,
    sampling: Sampling,
}

impl Camera {
    /// Direction of view, to the right and up: unit vectors at right angles.
    ///
    /// # Errors
    /// No direction, no up, an angle outside (0, 180), or numbers that are not finite.
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

    /// The camera made ready for a picture of `width` × `height` pixels.
    ///
    /// # Errors
    /// As [`Camera::frame`].
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

    /// The primary ray of sample number `sample` in pixel (`x`, `y`); (0, 0) is the upper left.
    /// Its direction has unit length.
    ///
    /// Sample 0 lies where [`Sampling`] says; those after it follow the R₂ sequence around it
    /// (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
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
    /// Where a line shows in the picture, in pixels from its upper left corner; the centre of pixel
    /// (0, 0) lies at (0.5, 0.5). What lies behind the eye is cut off; `None` where that is all.
    pub fn project_line(&self, ends: [Vec3; 2]) -> Option<[[f64; 2]; 2]> {
        let [a, b] = ends.map(|end| end - self.eye);
        let [depth_a, depth_b] = [a, b].map(|end| end.dot(self.forward));
        // In front of the eye by far less than the line is long.
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

    /// Place in the picture of a point before the eye, given from the eye.
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

/// The unit vector along `v` for any finite length, also where its square over- or underflows.
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
            hither: 1.0,
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
    fn points_on_a_pixels_ray_show_at_its_centre() {
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
    fn lines_are_cut_off_behind_the_eye() {
        let view = camera().view(10, 10, Sampling::Center).unwrap();
        let (ahead, behind) = (Vec3::new(1.0, 2.0, 0.0), Vec3::new(1.0, -3.0, 0.0));
        assert_eq!(view.project_line([behind, behind - Vec3::Y]), None);
        let [a, b] = view.project_line([ahead, behind]).unwrap();
        assert!((a[0] - 7.5).abs() < 1e-9 && (a[1] - 5.0).abs() < 1e-9);
        // It leaves the picture to the right, where it is seen while it comes nearer.
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
