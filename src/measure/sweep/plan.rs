//! The points of a sweep: what is measured, in which order, and one of them measured.

use super::{Key, Row};
use crate::measure::{MeasureError, measure};
use crate::progress::Progress;
use crate::scene::{Sampling, Scene, SceneRequest};
use crate::structure::{BuildSettings, MaxDepth};
use crate::trace::RenderSettings;

/// One point: a tree's settings and what identifies it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub build: BuildSettings,
    pub key: Key,
}

/// A sweep over one scene, seen by one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub render: RenderSettings,
    /// Methods, then leaf sizes, then depths.
    pub points: Vec<Point>,
}

impl Plan {
    /// Every combination of these settings, one for each method, with depths and leaf sizes.
    pub fn new(
        request: &SceneRequest,
        methods: &[BuildSettings],
        d_max: &[MaxDepth],
        n_oilf: &[u32],
        render: &RenderSettings,
    ) -> Plan {
        let scene = format!("{}, cylinders {}", request.source, request.cylinders);
        let picture = picture(render);
        let mut points = Vec::new();
        for method in methods {
            for &n_oilf in n_oilf {
                for &d_max in d_max {
                    let build = BuildSettings {
                        d_max,
                        n_oilf,
                        ..method.clone()
                    };
                    let key = Key::of(&scene, &build, &picture);
                    points.push(Point { build, key });
                }
            }
        }
        Plan {
            render: *render,
            points,
        }
    }

    /// Measures a point, by its number.
    ///
    /// # Errors
    /// As [`measure`].
    ///
    /// # Panics
    /// If there is no such point.
    pub fn row(
        &self,
        scene: &Scene,
        point: usize,
        progress: &Progress,
    ) -> Result<Row, MeasureError> {
        let Point { build, key } = &self.points[point];
        let measured = measure(scene, build, &self.render, progress)?;
        Ok(Row::of(
            point,
            self.points.len(),
            key.clone(),
            &measured.measurement,
        ))
    }
}

/// Everything of the picture that counts depend on, in words.
fn picture(render: &RenderSettings) -> String {
    format!(
        "{}x{}, D_AREC {}, cut-off {}, {}, samples at {}",
        render.width,
        render.height,
        render.d_arec,
        render.min_contribution,
        render.precision.name(),
        match render.sampling {
            Sampling::Center => "centres",
            Sampling::Corner => "corners",
        }
    )
}
