//! The right answers about rays, by rational arithmetic.

use crate::geometry::{Aabb, Ray};
use crate::measure::judge::{Line, Meeting, Surface, Tolerance, enlarged};
use crate::primitive::exact::Root;
use crate::primitive::{PackedRay, Precision, Shapes, UnitFrame};
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::trace::Hit;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Rays between two checks for cancellation.
const CHUNK: usize = 64;

/// A scene in one precision, for exact answers.
pub struct Oracle {
    surfaces: Vec<Surface>,
    boxes: Vec<Aabb>,
    /// The coordinates of the surfaces; `None` in `f64`, where they are those of the world.
    frame: Option<UnitFrame>,
}

impl Oracle {
    pub fn new(scene: &Scene, precision: Precision) -> Self {
        let frame = match scene.shapes(precision) {
            Shapes::F64(_) => None,
            Shapes::F32 { frame, .. } => Some(*frame),
        };
        let surface = |object| {
            let surface = Surface::of(object);
            match &frame {
                Some(frame) => surface.rounded(frame),
                None => surface,
            }
        };
        let surfaces: Vec<_> = scene.objects().iter().map(surface).collect();
        Oracle {
            boxes: surfaces.iter().map(|s| enlarged(&s.bounds())).collect(),
            surfaces,
            frame,
        }
    }

    pub fn precision(&self) -> Precision {
        match self.frame {
            None => Precision::F64,
            Some(_) => Precision::F32,
        }
    }

    /// Returns the closest hit of a ray, with the distance rounded to the nearest number. Something blocks
    /// the ray if and only if there is a hit.
    pub fn closest(&self, ray: &Ray) -> Hit {
        let Some(frame) = &self.frame else {
            return self.hit(ray);
        };
        let Some(packed) = PackedRay::new(frame, ray) else {
            return Hit::MISS;
        };
        let hit = self.hit(&packed.as_f64);
        if hit.is_hit() {
            Hit {
                t: packed.to_world(hit.t),
                ..hit
            }
        } else {
            hit
        }
    }

    /// Does the same in the coordinates of the surfaces.
    fn hit(&self, ray: &Ray) -> Hit {
        let is_usable = ray.direction.abs().max_element() > 0.0
            && ray.origin.is_finite()
            && ray.direction.is_finite()
            && ray.t_min.is_finite()
            && ray.t_min <= ray.t_max;
        if !is_usable {
            return Hit::MISS;
        }
        let (line, meeting) = (Line::new(ray, &Tolerance::NONE), Meeting::of(ray));
        let near = self.boxes.iter().zip(&self.surfaces).zip(0..);
        let near = near.filter(|((bounds, _), _)| meeting.may_meet(bounds));
        let crossings = near.flat_map(|((_, surface), object)| {
            let all = surface.crossings(&line, &Tolerance::NONE);
            all.into_iter().map(move |c| (c.earliest, object))
        });
        let nearest: Option<(Root, u32)> = crossings.min();
        nearest.map_or(Hit::MISS, |(t, object)| Hit {
            t: t.nearest(self.precision()),
            object,
        })
    }

    /// Returns [`Oracle::closest`] of every ray.
    ///
    /// # Errors
    /// Cancellation.
    pub fn closest_of_all(
        &self,
        rays: &[Ray],
        pool: &rayon::ThreadPool,
        progress: &Progress,
    ) -> Result<Vec<Hit>, Cancelled> {
        let (done, total) = (AtomicUsize::new(0), rays.len());
        let hits_of = |rays: &[Ray]| {
            if progress.is_cancelled() {
                return Vec::new();
            }
            let hits: Vec<Hit> = rays.iter().map(|ray| self.closest(ray)).collect();
            let before = done.fetch_add(hits.len(), Ordering::Relaxed);
            progress.set((before + hits.len()) as f64 / total as f64);
            hits
        };
        let chunks: Vec<Vec<Hit>> = pool.install(|| rays.par_chunks(CHUNK).map(hits_of).collect());
        progress.check()?;
        Ok(chunks.concat())
    }
}
