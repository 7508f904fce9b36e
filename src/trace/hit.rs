//! Rays in batches and the answers to them.

use crate::geometry::Ray;

/// The closest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray; infinite for a miss.
    pub t: f64,
    /// Index of the object; that of [`Hit::MISS`] is no object.
    pub object: u32,
}

impl Hit {
    /// No hit.
    pub const MISS: Hit = Hit {
        t: f64::INFINITY,
        object: u32::MAX,
    };

    #[inline]
    pub fn is_hit(&self) -> bool {
        self.object != u32::MAX
    }
}

/// The kinds of rays that the paper's Table 3 distinguishes. Reflected and refracted rays are its
/// secondary rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RayKind {
    Primary = 0,
    Shadow = 1,
    Reflected = 2,
    Refracted = 3,
}

impl RayKind {
    pub const ALL: [RayKind; 4] = [
        RayKind::Primary,
        RayKind::Shadow,
        RayKind::Reflected,
        RayKind::Refracted,
    ];

    pub const fn name(self) -> &'static str {
        ["primary", "shadow", "reflected", "refracted"][self as usize]
    }
}

/// Rays of one kind.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    pub kind: RayKind,
    pub rays: &'a [Ray],
    /// The pixel of the tile that each ray contributes to.
    pub pixels: &'a [u32],
}

/// A kernel as the renderer uses it, batch by batch. After cancellation, the remaining rays of a batch
/// are not traced and count as misses.
pub trait RayTracer {
    /// Finds the closest hit of every ray; of equal distances the lower object index. Overwrites `hits`
    /// and resizes it to the length of the batch.
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>);

    /// Finds whether anything lies on each ray before its end. Overwrites `blocked` and resizes it.
    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>);
}
