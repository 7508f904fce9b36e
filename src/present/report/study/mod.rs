//! Reports of the study of measures.

mod content;
mod csv;
mod document;
mod json;
mod registry;
mod table;
mod words;

pub use content::StudyReport;
pub use registry::STUDY_WRITERS;
pub use words::{estimate, paragraph};
