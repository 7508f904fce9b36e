//! The words of an NFF file, with their line numbers.

use super::write::NOTE;
use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::{comment_start, number, parse, quoted};
use crate::scene::format::place::Place;
use std::fmt::Display;

/// Words between two checks for cancellation.
const WORDS_PER_CHECK: u32 = 4096;

/// A word of the file and its line.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    pub bytes: &'a [u8],
    /// Counted from 1.
    pub line: usize,
}

impl Word<'_> {
    pub(super) fn parse<T: std::str::FromStr>(&self) -> Option<T> {
        parse(self.bytes)
    }

    /// Returns the word, quoted for a message.
    pub(super) fn quoted(&self) -> String {
        quoted(self.bytes)
    }

    /// Creates the error that this word is not what was expected here.
    pub(super) fn unexpected(&self, expected: impl Display) -> ReadError {
        syntax(self.line, expected, self.quoted())
    }
}

pub(super) fn syntax(line: usize, expected: impl Display, found: impl Display) -> ReadError {
    ReadError::at(Place::Line(line), expected, found)
}

/// Maximum number of notes kept from a file, and bytes kept of each.
const MAX_NOTES: usize = 16;
const MAX_NOTE_BYTES: usize = 1024;

/// An iterator over the words of a file. Skips comments, from `#` to the end of the line or from
/// `/*` to `*/`, but keeps the notes among them.
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    /// The notes found so far.
    pub notes: Vec<String>,
    at: usize,
    line: usize,
    /// The line of a comment that does not end.
    pub open_comment: Option<usize>,
    taken: u32,
    progress: &'a Progress,
}

impl<'a> Words<'a> {
    pub(super) fn new(bytes: &'a [u8], progress: &'a Progress) -> Self {
        Words {
            bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            notes: Vec::new(),
            at: 0,
            line: 1,
            open_comment: None,
            taken: 0,
            progress,
        }
    }

    /// Advances to the next word or to the end of the file. Lines end with LF, CR LF or CR.
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => {
                    let rest = &self.bytes[self.at..];
                    let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
                    let comment = &rest[..end.unwrap_or(rest.len())];
                    if let Some(note) = comment.strip_prefix(NOTE.as_bytes())
                        && self.notes.len() < MAX_NOTES
                    {
                        let shown = &note[..note.len().min(MAX_NOTE_BYTES)];
                        let text = String::from_utf8_lossy(shown);
                        self.notes.push(text.replace(char::is_control, " "));
                    }
                    self.at += comment.len();
                    continue;
                }
                b'/' if self.bytes[self.at..].starts_with(b"/*") => {
                    self.skip_block_comment();
                    continue;
                }
                b'\n' => self.line += 1,
                b'\r' if self.bytes.get(self.at + 1) != Some(&b'\n') => self.line += 1,
                b'\r' | b' ' | b'\t' | b'\x0b' | b'\x0c' => {}
                _ => break,
            }
            self.at += 1;
        }
    }

    /// Advances to the end of a comment in `/*` and `*/`, counting its lines.
    fn skip_block_comment(&mut self) {
        let rest = &self.bytes[self.at..];
        let end = rest[2..].windows(2).position(|two| two == b"*/");
        let comment = &rest[..end.map_or(rest.len(), |end| end + 4)];
        if end.is_none() {
            self.open_comment.get_or_insert(self.line);
        }
        let breaks = comment.iter().enumerate().filter(|(i, byte)| {
            **byte == b'\n' || (**byte == b'\r' && comment.get(i + 1) != Some(&b'\n'))
        });
        self.line += breaks.count();
        self.at += comment.len();
    }

    /// Returns the next word; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Word<'a>>, Cancelled> {
        self.taken += 1;
        if self.taken >= WORDS_PER_CHECK {
            self.taken = 0;
            self.progress.check()?;
            self.progress.set(self.at as f64 / self.bytes.len() as f64);
        }
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let is_end = |b: &u8| matches!(b, b'\t'..=b'\r' | b' ');
        let length = rest.iter().position(is_end).unwrap_or(rest.len());
        let length = comment_start(&rest[..length]).unwrap_or(length);
        let comment = rest[..length].windows(2).position(|two| two == b"/*");
        let length = comment.unwrap_or(length);
        self.at += length;
        Ok((length > 0).then_some(Word {
            bytes: &rest[..length],
            line: self.line,
        }))
    }

    /// Returns the next word, which must exist.
    pub(super) fn expect(&mut self, expected: impl Display) -> Result<Word<'a>, ReadError> {
        let word = self.next()?;
        word.ok_or_else(|| syntax(self.last_line(), expected, "the end of the file"))
    }

    /// Returns whether the next word is a number or begins like one.
    pub(super) fn number_follows(&mut self) -> bool {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..end.unwrap_or(rest.len())];
        let first = word.first();
        first.is_some_and(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.'))
            || number(word).is_some()
    }

    /// Parses the next word as a number and returns both.
    pub(super) fn number_word(&mut self, what: impl Display) -> Result<(f64, Word<'a>), ReadError> {
        let word = self.expect(&what)?;
        match number(word.bytes) {
            Some(number) if number.is_finite() => Ok((number, word)),
            _ => Err(word.unexpected(format_args!("{what} (a finite number)"))),
        }
    }

    pub(super) fn number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        self.number_word(what).map(|(number, _)| number)
    }

    /// Parses the next word as a number that need not be finite.
    pub(super) fn any_number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        let word = self.expect(&what)?;
        let unexpected = || word.unexpected(format_args!("{what} (a number)"));
        number(word.bytes).ok_or_else(unexpected)
    }

    pub(super) fn point(&mut self, of: impl Display) -> Result<Vec3, ReadError> {
        let mut numbers = [0.0; 3];
        for (number, name) in numbers.iter_mut().zip(["x", "y", "z"]) {
            *number = self.number(format_args!("{name} of {of}"))?;
        }
        Ok(Vec3::from_array(numbers))
    }

    /// Parses a direction or a color, whose numbers need not be finite.
    pub(super) fn any_triple(
        &mut self,
        names: [&str; 3],
        of: impl Display,
    ) -> Result<Vec3, ReadError> {
        let mut numbers = [0.0; 3];
        for (number, name) in numbers.iter_mut().zip(names) {
            *number = self.any_number(format_args!("{name} of {of}"))?;
        }
        Ok(Vec3::from_array(numbers))
    }

    pub(super) fn direction(&mut self, of: impl Display) -> Result<Vec3, ReadError> {
        self.any_triple(["x", "y", "z"], of)
    }

    pub(super) fn color(&mut self, of: impl Display) -> Result<Vec3, ReadError> {
        self.any_triple(["red", "green", "blue"], of)
    }

    /// Returns the line of the last character; 1 for an empty file. Valid only at the end of the
    /// file.
    pub(super) fn last_line(&self) -> usize {
        match self.bytes.last() {
            Some(b'\n' | b'\r') => self.line - 1,
            _ => self.line,
        }
    }
}
