//! How the rendering time divides into the terms of equation (1): the counts per pixel, multiplied
//! by the times.

use super::equation::Term;
use super::fit::Fit;
use super::in_place::InPlace;
use super::observe::each_ray;
use crate::primitive::PrimitiveKind;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderError, RenderSettings};
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

const KINDS: usize = PrimitiveKind::ALL.len();

/// Counts of some rays for the corrected equation (1). Arrays are indexed by [`PrimitiveKind`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayTerms<N = u64> {
    /// Rays of all kinds.
    pub rays: N,
    /// Nodes traversed.
    pub nodes: N,
    /// Tests with boxes of children.
    pub boxes: N,
    /// Tests that hit.
    pub hits: [N; KINDS],
    /// Tests that miss.
    pub misses: [N; KINDS],
}

impl RayTerms {
    /// Returns how often a term's time is spent. [`Term::Constant`] counts once per ray.
    pub fn count(&self, term: Term) -> u64 {
        match term {
            Term::Constant => self.rays,
            Term::Node => self.nodes,
            Term::Box => self.boxes,
            Term::Hit(kind) => self.hits[kind as usize],
            Term::Miss(kind) => self.misses[kind as usize],
        }
    }
}

impl AddAssign<&RayTerms<u32>> for RayTerms {
    fn add_assign(&mut self, other: &RayTerms<u32>) {
        self.rays += u64::from(other.rays);
        self.nodes += u64::from(other.nodes);
        self.boxes += u64::from(other.boxes);
        for kind in 0..KINDS {
            self.hits[kind] += u64::from(other.hits[kind]);
            self.misses[kind] += u64::from(other.misses[kind]);
        }
    }
}

/// A rectangle of pixels: first column and row, and width and height, each at least 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// The counts of every pixel of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureTerms {
    pub width: u32,
    pub height: u32,
    /// Pixels row by row.
    pub pixels: Vec<RayTerms<u32>>,
}

impl PictureTerms {
    /// Counts sample 0 of every pixel on the current thread.
    ///
    /// # Errors
    /// A camera without a view, a resolution out of range, or cancellation.
    pub fn count(
        scene: &Scene,
        tree: &Tree,
        render: &RenderSettings,
        progress: &Progress,
    ) -> Result<PictureTerms, RenderError> {
        let (width, height) = (render.width, render.height);
        let mut pixels = vec![RayTerms::default(); width as usize * height as usize];
        each_ray(scene, tree, render, progress, |traced, watcher| {
            let (x, y) = traced.pixel;
            let pixel = &mut pixels[y as usize * width as usize + x as usize];
            pixel.rays += 1;
            pixel.nodes += watcher.nodes as u32;
            pixel.boxes += watcher.boxes as u32;
            for &(object, hit) in &watcher.tests {
                let kind = scene.objects()[object as usize].kind() as usize;
                let counts = match hit {
                    Some(_) => &mut pixel.hits,
                    None => &mut pixel.misses,
                };
                counts[kind] += 1;
            }
        })?;
        Ok(PictureTerms {
            width,
            height,
            pixels,
        })
    }

    /// Returns the sum over the pixels of a region, clipped to the picture; `None` means the whole
    /// picture.
    pub fn sum(&self, region: Option<Region>) -> RayTerms {
        let region = region.unwrap_or(Region {
            x: 0,
            y: 0,
            width: self.width,
            height: self.height,
        });
        let end = |start: u32, length, most| start.saturating_add(length).min(most);
        let columns = region.x.min(self.width)..end(region.x, region.width, self.width);
        let mut sum = RayTerms::default();
        for y in region.y..end(region.y, region.height, self.height) {
            let start = y as usize * self.width as usize;
            let row = start + columns.start as usize..start + columns.end as usize;
            self.pixels[row].iter().for_each(|pixel| sum += pixel);
        }
        sum
    }
}

/// The times of the terms of equation (1), in seconds. The time of [`Term::Constant`] is per ray.
#[derive(Clone, Debug, PartialEq)]
pub struct TermTimes(Vec<(Term, f64)>);

/// The contribution of one term to the time of some rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    pub term: Term,
    /// How often the term's time is spent.
    pub count: u64,
    /// Seconds per unit.
    pub each: f64,
}

impl Part {
    /// Returns the total time in seconds.
    pub fn seconds(&self) -> f64 {
        self.count as f64 * self.each
    }
}

impl TermTimes {
    /// Returns the times of a fit whose pictures had this number of rays.
    pub fn of_fit(fit: &Fit, rays: u64) -> TermTimes {
        let coefficients = fit.coefficients.iter();
        let each = coefficients.map(|c| match c.term {
            Term::Constant => (c.term, c.seconds / rays.max(1) as f64),
            term => (term, c.seconds),
        });
        TermTimes(each.collect())
    }

    /// Returns the times measured in place, without the constant.
    pub fn of_in_place(times: &InPlace) -> TermTimes {
        let kinds = || PrimitiveKind::ALL.into_iter();
        let terms = [Term::Node]
            .into_iter()
            .chain(kinds().map(Term::Miss))
            .chain(kinds().map(Term::Hit));
        let each = terms.filter_map(|term| Some((term, times.seconds(term)?)));
        TermTimes(each.collect())
    }

    /// Returns the time of these counts, term by term.
    pub fn parts(&self, counts: &RayTerms) -> Vec<Part> {
        let each = self.0.iter();
        each.map(|&(term, each)| Part {
            term,
            count: counts.count(term),
            each,
        })
        .collect()
    }
}
