//! The sets of rays that a study traces.

use crate::geometry::{Ray, Vec3};
use crate::measure::random::Random;
use crate::measure::sample_rays;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{Batch, RayKind, RenderError, RenderSettings, thread_pool};

/// Where the rays of a set come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayOrigin {
    /// Rays of this kind of the picture.
    Picture(RayKind),
    /// Long rays through the scene, as `C_SAH` assumes them: between random points of the sphere around it.
    Random,
}

impl RayOrigin {
    /// All origins, in the order of reports.
    pub const ALL: [RayOrigin; 4] = [
        RayOrigin::Picture(RayKind::Primary),
        RayOrigin::Picture(RayKind::Shadow),
        RayOrigin::Picture(RayKind::Reflected),
        RayOrigin::Random,
    ];

    /// Returns the name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            RayOrigin::Picture(RayKind::Primary) => "primary",
            RayOrigin::Picture(RayKind::Shadow) => "shadow",
            RayOrigin::Picture(RayKind::Reflected) => "reflected",
            RayOrigin::Picture(RayKind::Refracted) => "refracted",
            RayOrigin::Random => "random",
        }
    }

    /// Returns the kind as which the rays are traced and counted.
    pub const fn kind(self) -> RayKind {
        match self {
            RayOrigin::Picture(kind) => kind,
            RayOrigin::Random => RayKind::Primary,
        }
    }
}

/// Rays that are traced as one batch.
#[derive(Clone, Debug)]
pub struct RaySet {
    pub origin: RayOrigin,
    /// At least one.
    pub rays: Vec<Ray>,
    /// For batches: all rays belong to pixel 0.
    pixels: Vec<u32>,
}

impl RaySet {
    /// Returns the sets of a scene that are not empty, with at most `count` rays each. The tree only helps to find
    /// the rays of the picture.
    ///
    /// # Errors
    /// A camera without a view, or cancellation.
    pub fn all(
        scene: &Scene,
        tree: &Tree,
        render: &RenderSettings,
        count: usize,
        progress: &Progress,
    ) -> Result<Vec<RaySet>, RenderError> {
        let pool = thread_pool(render.threads)?;
        let sample = sample_rays(scene, tree, render, count, &pool, progress)?;
        let sets = RayOrigin::ALL.map(|origin| {
            let rays = match origin {
                RayOrigin::Picture(kind) => sample.rays[kind as usize].clone(),
                RayOrigin::Random => chords(scene, count),
            };
            let pixels = vec![0; rays.len()];
            RaySet {
                origin,
                rays,
                pixels,
            }
        });
        Ok(sets
            .into_iter()
            .filter(|set| !set.rays.is_empty())
            .collect())
    }

    pub fn batch(&self) -> Batch<'_> {
        Batch {
            kind: self.origin.kind(),
            rays: &self.rays,
            pixels: &self.pixels,
        }
    }
}

/// Returns rays between pairs of points of the sphere around a scene, the same for each call.
fn chords(scene: &Scene, count: usize) -> Vec<Ray> {
    let bounds = scene.bounds();
    let radius = 0.5 * bounds.size().length();
    if !(radius > 0.0 && radius.is_finite()) {
        return Vec::new();
    }
    let mut random = Random::new(0);
    let mut point = || bounds.center() + radius * random.unit();
    let mut chord = || -> Ray {
        let (from, to): (Vec3, Vec3) = (point(), point());
        Ray::new(from, (to - from).normalize_or(Vec3::X))
    };
    (0..count).map(|_| chord()).collect()
}
