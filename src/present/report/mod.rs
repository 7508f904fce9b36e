//! Reports of measurements. A writer is one file here and one line in [`WRITERS`].

pub mod accuracy;
mod content;
mod csv;
mod escape;
mod exact;
pub mod grid;
mod json;
mod latex;
mod machine;
mod markdown;
mod page;
pub mod paper;
mod per_kind;
pub mod pixel;
mod registry;
mod sections;
pub mod study;
mod table;
mod text;
pub mod tune;
mod words;
mod writer;

pub use content::{Failure, Report, SceneSummary};
pub use machine::{Machine, now};
pub use page::{Figure, Page};
pub use registry::WRITERS;
pub use table::plain_table;
pub use text::write_summary;
pub use writer::Writer;
