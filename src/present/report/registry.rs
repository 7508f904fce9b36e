//! All writers.

use super::writer::Writer;
use super::{csv, json, latex, markdown, text};

/// All writers; the first is the default.
pub static WRITERS: &[Writer] = &[
    text::WRITER,
    json::WRITER,
    csv::WRITER,
    markdown::WRITER,
    latex::WRITER,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_extensions_of_writers_are_unique() {
        assert!(!WRITERS.is_empty());
        for (i, writer) in WRITERS.iter().enumerate() {
            assert!(
                WRITERS[..i]
                    .iter()
                    .all(|w| w.name != writer.name && w.extension != writer.extension)
            );
        }
    }
}
