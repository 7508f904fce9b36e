//! The declaration of a report format.

use super::content::Report;
use std::io::Write;

/// A format in which a report can be written.
pub struct Writer<R: ?Sized = Report> {
    /// Name on the command line.
    pub name: &'static str,
    /// A short phrase: what the format is good for.
    pub about: &'static str,
    /// File name extension, lower case, without the dot.
    pub extension: &'static str,
    /// Writes the whole report.
    pub write: fn(&R, &mut dyn Write) -> std::io::Result<()>,
}
