//! What people are shown of results: overlays as plain geometry and colors, reports, exports.

pub mod export;
pub mod overlay;
pub mod report;
