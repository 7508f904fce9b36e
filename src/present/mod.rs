//! Presentation of results: number formats, words, charts, overlays as plain geometry and colors,
//! reports, exports.

pub mod chart;
pub mod export;
pub mod number;
pub mod overlay;
pub mod report;
pub mod words;
