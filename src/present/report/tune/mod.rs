//! Reports of the search for the best tree, in every format of [`super::WRITERS`].

mod content;
mod csv;
mod json;
mod registry;
mod table;
mod words;

pub use content::TuneReport;
pub use registry::TUNE_WRITERS;
pub use words::{left_out, rays_in_words, recommendation};
