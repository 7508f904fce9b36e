//! What a form of report declares.

use super::content::Report;
use std::io::Write;

/// A form that a report can be written in.
pub struct Writer<R: ?Sized = Report> {
    /// Name on the command line.
    pub name: &'static str,
    /// One phrase: what it is good for.
    pub about: &'static str,
    /// File name extension, lower case, without the dot.
    pub extension: &'static str,
    /// Writes the whole report.
    pub write: fn(&R, &mut dyn Write) -> std::io::Result<()>,
}
