//! The lines of a text file, with their numbers.

use super::error::ReadError;
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
use std::fmt::Display;

/// Lines between two checks for cancellation.
const LINES_PER_CHECK: usize = 4096;

/// An iterator over the lines of a file. Lines end with LF, CR LF or CR.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
    progress: &'a Progress,
}

/// A line without its line break.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// Counted from 1.
    pub number: usize,
    pub bytes: &'a [u8],
}

impl<'a> Lines<'a> {
    pub fn new(bytes: &'a [u8], progress: &'a Progress) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Lines::after(0, bytes, progress)
    }

    /// Creates an iterator over the rest of a file, after the given number of lines.
    pub fn after(lines: usize, bytes: &'a [u8], progress: &'a Progress) -> Self {
        Lines {
            bytes,
            at: 0,
            number: lines,
            progress,
        }
    }

    /// Returns the next line; `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<Line<'a>>, Cancelled> {
        if self.number.is_multiple_of(LINES_PER_CHECK) {
            self.progress.check()?;
            self.progress
                .set(self.at as f64 / self.bytes.len().max(1) as f64);
        }
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let bytes = &rest[..end.unwrap_or(rest.len())];
        let is_cr_lf = rest[bytes.len()..].starts_with(b"\r\n");
        let ends = usize::from(end.is_some()) + usize::from(is_cr_lf);
        self.at += bytes.len() + ends;
        self.number += 1;
        let number = self.number;
        Ok(Some(Line { number, bytes }))
    }

    /// Returns the next line that is not blank; `None` at the end of the file.
    pub fn next_with_words(&mut self) -> Result<Option<Line<'a>>, Cancelled> {
        while let Some(line) = self.next()? {
            if !line.bytes.trim_ascii().is_empty() {
                return Ok(Some(line));
            }
        }
        Ok(None)
    }

    /// Creates the error that the file ends too early.
    pub fn unexpected_end(&self, expected: impl Display) -> ReadError {
        let place = Place::Line(self.number.max(1));
        ReadError::at(place, expected, "the end of the file")
    }
}

impl<'a> Line<'a> {
    pub fn place(&self) -> Place {
        Place::Line(self.number)
    }

    /// Returns the words of the line, separated by white space.
    pub fn words(&self) -> Words<'a> {
        Words {
            number: self.number,
            rest: self.bytes,
        }
    }
}

/// The remaining words of a line.
#[derive(Clone, Copy)]
pub(super) struct Words<'a> {
    number: usize,
    rest: &'a [u8],
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }
}

impl Words<'_> {
    /// Returns the rest of the line as text.
    pub fn rest(&self) -> String {
        String::from_utf8_lossy(self.rest.trim_ascii()).into_owned()
    }

    /// Creates the error that a word, or the end of the line if `None`, was not expected here.
    pub fn error(&self, expected: impl Display, found: Option<&[u8]>) -> ReadError {
        let found = found.map_or_else(|| "the end of the line".to_owned(), quoted);
        ReadError::at(Place::Line(self.number), expected, found)
    }

    /// Parses the next word as a finite number; `None` at the end of the line.
    pub fn number(&mut self, what: impl Display) -> Result<Option<f64>, ReadError> {
        let Some(word) = self.next() else {
            return Ok(None);
        };
        match parse::<f64>(word) {
            Some(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.error(format_args!("{what} (a finite number)"), Some(word))),
        }
    }

    /// Parses the next word, which must exist, as a finite number.
    pub fn expect_number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        self.number(&what)?.ok_or_else(|| self.error(what, None))
    }

    /// Parses three numbers.
    pub fn point(&mut self, of: &str) -> Result<Vec3, ReadError> {
        let mut point = [0.0; 3];
        for (number, name) in point.iter_mut().zip(["x", "y", "z"]) {
            *number = self.expect_number(format_args!("{name} of {of}"))?;
        }
        Ok(Vec3::from_array(point))
    }
}

/// Parses a word.
pub(super) fn parse<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Quotes text for a message: truncated to a short length, with control characters escaped.
pub(super) fn quoted(bytes: &[u8]) -> String {
    const SHOWN: usize = 32;
    let head = &bytes[..bytes.len().min(4 * SHOWN)];
    let text = String::from_utf8_lossy(head);
    let mut shown: String = text.chars().take(SHOWN).collect();
    if shown.len() < text.len() || head.len() < bytes.len() {
        shown.push('…');
    }
    format!("'{}'", shown.escape_debug())
}
