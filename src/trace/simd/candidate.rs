//! What SIMD traversal hands over to exact tests.

use super::ray::RayBuffer;

/// An object that the ray in a lane may hit.
#[derive(Clone, Copy, Default)]
pub(super) struct Candidate {
    /// Index of the ray's limit.
    pub(super) lane: u32,
    /// The ray's slot in the [`RayBuffer`].
    pub(super) ray: u32,
    /// The object's block and its place there.
    pub(super) block: u32,
    pub(super) place: u32,
    pub(super) object: u32,
}

/// The exact tests of candidates, and the answers that they lead to.
pub(super) trait ExactTests {
    /// Returns whether any hit answers the query, wherever it is.
    fn any_hit_suffices(&self) -> bool;

    /// Initializes the answers of a chunk's rays.
    fn begin(&mut self, rays: &RayBuffer, chunk: usize);

    /// Finishes the answers of a chunk's rays. No further candidates follow.
    fn end(&mut self, rays: &RayBuffer, chunk: usize);

    /// Records that the rays in these slots certainly hit something; only where any hit suffices.
    fn mark_hit(&mut self, rays: &RayBuffer, slots: &[u32]);

    /// Tests candidates and lowers the limits of rays that are hit. A limit is the distance in the unit
    /// frame beyond which nothing matters, or −1 where nothing matters at all.
    fn test(&mut self, rays: &RayBuffer, candidates: &[Candidate], limits: &mut [f32]);
}
