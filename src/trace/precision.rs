//! The precision of rendering, and whether `f32` can represent a scene as the camera sees it.

use super::{PrecisionChoice, RenderSettings};
use crate::primitive::{Precision, Shape, Shapes, ThinnestObject};
use crate::scene::{Camera, Scene};

/// Minimum width of an object, and of a pixel, in multiples of its rounding in `f32`.
///
/// Rounding ([`Shapes::rounding`]) bounds the distance between a surface and the exact one, and rays that
/// leave a surface start 2 roundings away from it. With 16 every object keeps its shape to 1/16 of its
/// width, no ray starts on its other side, and a hit has an error of at most 1/16 of a pixel.
const MIN_ROUNDINGS: f64 = 16.0;

/// Why `f32` cannot represent a scene as a camera sees it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotInF32 {
    #[error(
        "object {} is only {:.1} times as wide as the rounding of its coordinates in f32, at least \
         {MIN_ROUNDINGS} times is needed",
        .0.object, .0.min_width
    )]
    Object(ThinnestObject),
    /// The width of a pixel, in multiples of the rounding of a hit.
    #[error(
        "from so near, a pixel is only {0:.1} times as wide as the rounding of a hit in f32, at least \
         {MIN_ROUNDINGS} times is needed"
    )]
    Pixel(f64),
}

/// The precision used, and the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenPrecision {
    pub precision: Precision,
    /// A sentence without its full stop.
    pub why: String,
    /// Whether `f32` is used although it cannot represent the scene as the camera sees it.
    pub is_doubtful: bool,
}

impl ChosenPrecision {
    /// Returns a warning without its full stop if `f32` is used although it cannot represent the scene:
    /// its shadows and small objects may be wrong.
    pub fn warning(&self) -> Option<String> {
        self.is_doubtful.then(|| format!("Precision: {self}"))
    }
}

/// Checks whether `f32` can represent a scene as a camera sees it in an image of `height` pixels. A scene
/// without objects always passes.
///
/// The size and position of the scene do not matter ([`crate::primitive::UnitFrame`]), and neither does
/// the distance of the camera: rays are moved near the scene before they are rounded.
///
/// # Errors
/// The first reason why it cannot.
pub fn fits_f32(scene: &Scene, camera: &Camera, height: u32) -> Result<(), NotInF32> {
    objects_fit_f32(scene)?;
    let Shapes::F32 { frame, .. } = scene.shapes(Precision::F32) else {
        return Ok(());
    };
    // An object whose bounds contain the eye may be near or far, so it is ignored.
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
    if width < MIN_ROUNDINGS {
        return Err(NotInF32::Pixel(width));
    }
    Ok(())
}

/// Checks whether `f32` can represent the objects of a scene, wherever the camera is.
///
/// # Errors
/// The thinnest object.
pub fn objects_fit_f32(scene: &Scene) -> Result<(), NotInF32> {
    match scene.shapes(Precision::F32) {
        Shapes::F32 {
            thinnest: Some(thinnest),
            ..
        } if thinnest.min_width < MIN_ROUNDINGS => Err(NotInF32::Object(*thinnest)),
        _ => Ok(()),
    }
}

impl RenderSettings {
    /// Returns the precision of rendering a scene with these settings.
    pub fn precision_for(&self, scene: &Scene) -> ChosenPrecision {
        let camera = self.camera.resolve(scene.camera());
        let fits = || fits_f32(scene, &camera, self.height);
        let mut is_doubtful = false;
        let (precision, why) = match self.precision {
            PrecisionChoice::F64 => (Precision::F64, "as chosen".into()),
            PrecisionChoice::F32 => match fits() {
                Ok(()) => (Precision::F32, "as chosen".into()),
                Err(reason) => {
                    is_doubtful = true;
                    (Precision::F32, format!("as chosen, though {reason}"))
                }
            },
            PrecisionChoice::Auto => match fits() {
                Ok(()) => (
                    Precision::F32,
                    "every object and every pixel is wide enough for f32".into(),
                ),
                Err(reason) => (Precision::F64, format!("because {reason}")),
            },
        };
        ChosenPrecision {
            precision,
            why,
            is_doubtful,
        }
    }
}

impl std::fmt::Display for ChosenPrecision {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.precision.name(), self.why)
    }
}
