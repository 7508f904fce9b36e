//! Which precision a picture is traced in, and whether `f32` can hold the scene as the camera sees it.

use super::RenderSettings;
use crate::primitive::{Precision, Shape, Shapes, ThinnestObject};
use crate::scene::{Camera, Scene};
use serde::{Deserialize, Serialize};

/// The precision asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PrecisionChoice {
    F32,
    #[default]
    F64,
    /// `f32` where it can hold the scene as the camera sees it, else `f64`.
    Auto,
}

impl PrecisionChoice {
    pub const ALL: [PrecisionChoice; 3] = [
        PrecisionChoice::F32,
        PrecisionChoice::F64,
        PrecisionChoice::Auto,
    ];

    /// `f32`, `f64` or `auto`.
    pub const fn name(self) -> &'static str {
        ["f32", "f64", "auto"][self as usize]
    }

    /// The choice of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name)
    }
}

/// How many times its rounding in `f32` an object must be wide, and a pixel.
///
/// Rounding ([`Shapes::rounding`]) bounds how far a surface may lie from where it should, and rays
/// that leave a surface start 2 roundings off it. At 16, every object keeps its shape to 1/16 of its
/// width and no ray starts on its other side; a hit is off by no more than 1/16 of a pixel.
const FEWEST_ROUNDINGS: f64 = 16.0;

/// Why `f32` cannot hold a scene as a camera sees it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotInF32 {
    #[error(
        "object {} is {:.1} times as wide as f32 rounds its coordinates, {FEWEST_ROUNDINGS} are needed",
        .0.object, .0.min_width
    )]
    Object(ThinnestObject),
    /// How wide a pixel is, over the rounding of a hit.
    #[error(
        "so near, a pixel is {0:.1} times as wide as f32 rounds a hit, {FEWEST_ROUNDINGS} are needed"
    )]
    Pixel(f64),
}

/// The precision that is used, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenPrecision {
    pub precision: Precision,
    /// A sentence without its full stop.
    pub why: String,
}

/// Whether `f32` can hold a scene as it is seen by a camera in a picture of `height` pixels; one
/// without objects, always.
///
/// The extent of the scene and its place do not matter ([`crate::primitive::UnitFrame`]), nor does
/// how far away the camera is: rays are moved near the scene before they are rounded.
///
/// # Errors
/// The first reason against it.
pub fn fits_f32(scene: &Scene, camera: &Camera, height: u32) -> Result<(), NotInF32> {
    objects_fit_f32(scene)?;
    let Shapes::F32 { frame, .. } = scene.shapes(Precision::F32) else {
        return Ok(());
    };
    // What a box around the eye holds may be near or far: it tells nothing.
    let near = |object: &crate::primitive::Primitive| {
        let bounds = object.bounds();
        let distance = camera
            .from
            .distance(camera.from.clamp(bounds.lo, bounds.hi));
        (distance > 0.0).then_some(distance)
    };
    let Some(distance) = scene.objects().iter().filter_map(near).reduce(f64::min) else {
        return Ok(());
    };
    let pixel = 2.0 * libm::tan(camera.angle.to_radians() * 0.5) / f64::from(height.max(1));
    let origin = frame.point(camera.from).abs().max_element().min(2.0);
    let rounding = 4.0 * f64::from(f32::EPSILON) * (1.0 + origin);
    let width = distance * frame.scale() * pixel / rounding;
    if width < FEWEST_ROUNDINGS {
        return Err(NotInF32::Pixel(width));
    }
    Ok(())
}

/// Whether `f32` can hold the objects of a scene, wherever they are seen from.
///
/// # Errors
/// The object that it can hold least.
pub fn objects_fit_f32(scene: &Scene) -> Result<(), NotInF32> {
    match scene.shapes(Precision::F32) {
        Shapes::F32 {
            thinnest: Some(thinnest),
            ..
        } if thinnest.min_width < FEWEST_ROUNDINGS => Err(NotInF32::Object(*thinnest)),
        _ => Ok(()),
    }
}

impl RenderSettings {
    /// The precision that a scene is traced in with these settings.
    pub fn precision_for(&self, scene: &Scene) -> ChosenPrecision {
        let camera = self.camera.resolve(scene.camera());
        let fits = || fits_f32(scene, &camera, self.height);
        let (precision, why) = match self.precision {
            PrecisionChoice::F64 => (Precision::F64, "as asked".into()),
            PrecisionChoice::F32 => match fits() {
                Ok(()) => (Precision::F32, "as asked".into()),
                Err(reason) => (Precision::F32, format!("as asked, though {reason}")),
            },
            PrecisionChoice::Auto => match fits() {
                Ok(()) => (
                    Precision::F32,
                    "every object and every pixel is wide enough for it".into(),
                ),
                Err(reason) => (Precision::F64, format!("because {reason}")),
            },
        };
        ChosenPrecision { precision, why }
    }
}

impl std::fmt::Display for ChosenPrecision {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.precision.name(), self.why)
    }
}
