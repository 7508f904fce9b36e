//! The record of a pixel as text and JSON.

mod json;
mod report;
mod text;

pub use json::write as write_json;
pub use report::PixelReport;
pub use text::write as write_text;
