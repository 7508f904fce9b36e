//! The content of a pixel report.

use crate::scene::Scene;
use crate::structure::Method;
use crate::trace::{PixelRecord, RenderSettings};

/// Records of the rays of one pixel, in the trees of one or more methods.
pub struct PixelReport<'a> {
    pub scene: &'a Scene,
    pub render: RenderSettings,
    /// All of the same pixel.
    pub records: Vec<(Method, PixelRecord)>,
}
