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

impl<'a> Words<'a> {
    /// Returns the rest of the line.
    pub fn rest_bytes(&self) -> &'a [u8] {
        self.rest.trim_ascii()
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
        match number(word) {
            Some(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.error(format_args!("{what} (a finite number)"), Some(word))),
        }
    }

    /// Parses the next word, which must exist, as a finite number.
    pub fn expect_number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        self.number(&what)?.ok_or_else(|| self.error(what, None))
    }

    /// Parses three numbers, which need not be finite.
    pub fn point(&mut self, of: &str) -> Result<Vec3, ReadError> {
        let mut point = [0.0; 3];
        for (coordinate, name) in point.iter_mut().zip(["x", "y", "z"]) {
            let word = self.next();
            *coordinate = word
                .and_then(number)
                .ok_or_else(|| self.error(format_args!("{name} of {of} (a number)"), word))?;
        }
        Ok(Vec3::from_array(point))
    }

    /// Parses three numbers of a direction; what cannot be read is not a number.
    pub fn direction(&mut self) -> Vec3 {
        let mut part = || self.next().and_then(number).unwrap_or(f64::NAN);
        Vec3::new(part(), part(), part())
    }
}

/// Parses a number as programs write it: also with the exponents of Fortran (`1.5D+02`), and with
/// the names that C libraries give to what is not a number (`-1.#IND00`, `nan(ind)`). Returns
/// `None` for anything else.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    parse(word).or_else(|| unusual_number(word))
}

#[cold]
fn unusual_number(word: &[u8]) -> Option<f64> {
    const LONGEST: usize = 64;
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_ascii_lowercase();
    let unsigned = word.strip_prefix(b"-").or(word.strip_prefix(b"+"));
    let unsigned = unsigned.unwrap_or(&word);
    if unsigned.starts_with(b"nan(") && unsigned.ends_with(b")") {
        return Some(f64::NAN);
    }
    if let Some(name) = unsigned.strip_prefix(b"1.#") {
        if let Some(digits) = name.strip_prefix(b"inf")
            && digits.iter().all(u8::is_ascii_digit)
        {
            let infinite = f64::INFINITY;
            return Some(if word[0] == b'-' { -infinite } else { infinite });
        }
        // IND, QNAN or SNAN, or what is left of these in few digits, such as `1.#J`.
        let is_name = name.first().is_some_and(u8::is_ascii_alphabetic)
            && name.iter().all(u8::is_ascii_alphanumeric);
        return is_name.then_some(f64::NAN);
    }
    let exponent = word.iter().position(|b| *b == b'd')?;
    let digits = |bytes: &[u8]| {
        let of_number = |b: &u8| matches!(b, b'0'..=b'9' | b'.' | b'+' | b'-');
        !bytes.is_empty() && bytes.iter().all(of_number)
    };
    if !digits(&word[..exponent]) || !digits(&word[exponent + 1..]) {
        return None;
    }
    let mut word = word;
    word[exponent] = b'e';
    parse(&word)
}

/// Returns where a comment that begins with `#` starts, if there is one. The `#` in the names that
/// C libraries give to what is not a number (`-1.#IND00`) starts none.
pub(super) fn comment_start(line: &[u8]) -> Option<usize> {
    let starts_one = |i: usize| {
        let is_name =
            line[..i].ends_with(b"1.") && line.get(i + 1).is_some_and(u8::is_ascii_alphabetic);
        !is_name
    };
    let mut marks = line.iter().enumerate().filter(|(_, byte)| **byte == b'#');
    marks.find(|(i, _)| starts_one(*i)).map(|(i, _)| i)
}

/// Parses a whole number, which may be written as a decimal (`4.0`).
pub(super) fn whole(word: &[u8]) -> Option<i64> {
    // Longer numbers are left to the general case, which notices an overflow.
    if word.len() <= 18 && !word.is_empty() && word.iter().all(u8::is_ascii_digit) {
        return Some(word.iter().fold(0, |n, b| 10 * n + i64::from(b - b'0')));
    }
    parse(word).or_else(|| whole_of(number(word)?))
}

/// Returns a number as an integer; `None` if it is not whole or does not fit.
pub(super) fn whole_of(number: f64) -> Option<i64> {
    const LARGEST: f64 = (1_u64 << 53) as f64;
    (number.fract() == 0.0 && number.abs() <= LARGEST).then_some(number as i64)
}

/// Parses a word.
pub(super) fn parse<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Refuses text in an encoding other than ASCII and its extensions. Text in UTF-16 or UTF-32 is
/// recognized by its byte-order mark, or by the zeros among its first letters.
pub(super) fn refuse_wide_text(bytes: &[u8]) -> Result<(), ReadError> {
    match wide_text(bytes) {
        None => Ok(()),
        Some(name) => {
            let expected = "text in ASCII or UTF-8 (save the file in that encoding)";
            Err(ReadError::at(
                Place::Line(1),
                expected,
                format_args!("text in {name}"),
            ))
        }
    }
}

/// Returns the name of the encoding of text with more than one byte per letter; `None` for other
/// text.
pub(super) fn wide_text(bytes: &[u8]) -> Option<&'static str> {
    let letter = |b: u8| b.is_ascii_graphic() || b.is_ascii_whitespace();
    match *bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => Some("UTF-32"),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("UTF-16"),
        [a, 0, 0, 0, b, 0, 0, 0, ..] | [0, 0, 0, a, 0, 0, 0, b, ..] if letter(a) && letter(b) => {
            Some("UTF-32")
        }
        [a, 0, b, 0, c, 0, ..] | [0, a, 0, b, 0, c, ..] if letter(a) && letter(b) && letter(c) => {
            Some("UTF-16")
        }
        _ => None,
    }
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
