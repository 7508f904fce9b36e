//! The values after the header, from text or binary data.

use super::header::{Encoding, Kind, Scalar};
use crate::progress::{Cancelled, Progress};
use crate::scene::format::lines::{number, quoted, whole, whole_of};
use crate::scene::format::place::Place;

/// Elements between two checks for cancellation.
const ELEMENTS_PER_CHECK: u64 = 4096;

/// How the elements of a text file are laid out.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// As a stream of tokens; line breaks do not matter.
    Tokens,
    /// Each element begins on a new line; what follows its values on its last line is skipped.
    Lines,
}

/// Where a value could not be read.
pub(super) enum Failure {
    /// The file ends.
    End,
    /// Something else than a number, quoted.
    Found(String),
}

/// Reads the values of one element after the other.
pub(super) struct Values<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
    layout: Layout,
    /// The current line of a text file, counted from 1.
    line: usize,
    /// The line of the last value of a text file.
    last_line: usize,
    /// Whether a value of the current line was read.
    in_line: bool,
    /// The first element of a text file that does not begin on a new line.
    pub misaligned: Option<Place>,
    /// The first line of a text file with values after those of its element, and their number.
    pub surplus: Option<(Place, usize)>,
    /// Position of the first byte in the file, for messages and progress.
    start: usize,
    progress: &'a Progress,
}

impl<'a> Values<'a> {
    /// Creates a reader of the bytes after a header of the given length and number of lines.
    pub fn new(
        bytes: &'a [u8],
        [start, lines]: [usize; 2],
        encoding: Encoding,
        layout: Layout,
        progress: &'a Progress,
    ) -> Self {
        Values {
            bytes: &bytes[start..],
            at: 0,
            encoding,
            layout,
            line: lines + 1,
            last_line: lines,
            in_line: false,
            misaligned: None,
            surplus: None,
            start,
            progress,
        }
    }

    /// Returns the number of bytes that are left.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Begins an element and returns its place; `number` counts elements of its kind from 0.
    pub fn begin(&mut self, kind: &'static str, number: u64) -> Result<Place, Cancelled> {
        if number.is_multiple_of(ELEMENTS_PER_CHECK) {
            self.progress.check()?;
            let (done, all) = (self.start + self.at, self.start + self.bytes.len());
            self.progress.set(done as f64 / all.max(1) as f64);
        }
        if self.encoding != Encoding::Text {
            return Ok(Place::Element(kind, number as usize));
        }
        if self.layout == Layout::Lines && self.in_line {
            let line = Place::Line(self.line);
            let mut skipped = 0;
            while self.in_line && self.next_on_line() {
                self.token();
                skipped += 1;
            }
            if skipped > 0 {
                self.surplus.get_or_insert((line, 0)).1 += 1;
            }
        }
        self.skip_blanks();
        if self.left() == 0 {
            return Ok(Place::Line(self.last_line));
        }
        let place = Place::Line(self.line);
        if self.in_line {
            self.misaligned.get_or_insert(place);
        }
        Ok(place)
    }

    /// Returns whether another token follows on the current line.
    fn next_on_line(&mut self) -> bool {
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' | b'\r' => return false,
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => return true,
            }
        }
        false
    }

    /// Advances to the next token of a text file, counting lines.
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => {}
                b'\r' if self.bytes.get(self.at + 1) != Some(&b'\n') => {}
                b' ' | b'\t' | b'\r' | b'\x0b' | b'\x0c' => {
                    self.at += 1;
                    continue;
                }
                _ => return,
            }
            self.line += 1;
            self.in_line = false;
            self.at += 1;
        }
    }

    /// Returns the next token of a text file.
    fn token(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let is_blank = |b: &u8| matches!(b, b'\t'..=b'\r' | b' ');
        let length = rest.iter().position(is_blank).unwrap_or(rest.len());
        self.at += length;
        if length > 0 {
            self.in_line = true;
            self.last_line = self.line;
        }
        (length > 0).then(|| &rest[..length])
    }

    /// Returns the line of the last token of a text file.
    pub fn line(&self) -> Place {
        Place::Line(self.last_line)
    }

    /// Returns the place of what follows the last element, if there is anything.
    pub fn rest(&mut self) -> Option<Place> {
        if self.encoding == Encoding::Text {
            self.skip_blanks();
        }
        (self.left() > 0).then(|| match self.encoding {
            Encoding::Text => Place::Line(self.line),
            _ => Place::Byte(self.start + self.at),
        })
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Failure> {
        let bytes = self.bytes.get(self.at..self.at + N);
        let mut bytes: [u8; N] = bytes.and_then(|b| b.try_into().ok()).ok_or(Failure::End)?;
        self.at += N;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// Reads a number of a binary file: integers as such, others as floats.
    fn binary(&mut self, kind: Scalar) -> Result<Result<i64, f64>, Failure> {
        Ok(match kind {
            Scalar::I8 => Ok(i8::from_le_bytes(self.take()?).into()),
            Scalar::U8 => Ok(u8::from_le_bytes(self.take()?).into()),
            Scalar::I16 => Ok(i16::from_le_bytes(self.take()?).into()),
            Scalar::U16 => Ok(u16::from_le_bytes(self.take()?).into()),
            Scalar::I32 => Ok(i32::from_le_bytes(self.take()?).into()),
            Scalar::U32 => Ok(u32::from_le_bytes(self.take()?).into()),
            Scalar::I64 => Ok(i64::from_le_bytes(self.take()?)),
            Scalar::U64 => Ok(i64::try_from(u64::from_le_bytes(self.take()?)).unwrap_or(i64::MAX)),
            Scalar::F32 => Err(f32::from_le_bytes(self.take()?).into()),
            Scalar::F64 => Err(f64::from_le_bytes(self.take()?)),
        })
    }

    /// Reads a number, which need not be finite.
    pub fn number(&mut self, kind: Scalar) -> Result<f64, Failure> {
        if self.encoding != Encoding::Text {
            return Ok(self
                .binary(kind)?
                .map_or_else(|float| float, |whole| whole as f64));
        }
        let token = self.token().ok_or(Failure::End)?;
        number(token).ok_or_else(|| Failure::Found(quoted(token)))
    }

    /// Reads a part of a normal; what cannot be read is not a number.
    pub fn direction(&mut self, kind: Scalar) -> Result<f64, Failure> {
        match self.number(kind) {
            Err(Failure::Found(_)) => Ok(f64::NAN),
            number => number,
        }
    }

    /// Reads a whole number.
    pub fn whole(&mut self, kind: Scalar) -> Result<i64, Failure> {
        if self.encoding != Encoding::Text {
            let number = self.binary(kind)?;
            return number
                .or_else(|float| whole_of(float).ok_or_else(|| Failure::Found(float.to_string())));
        }
        let token = self.token().ok_or(Failure::End)?;
        whole(token).ok_or_else(|| Failure::Found(quoted(token)))
    }

    /// Reads the number of items of a list.
    pub fn count(&mut self, kind: Scalar) -> Result<u64, Failure> {
        let count = self.whole(kind)?;
        u64::try_from(count).map_err(|_| Failure::Found(count.to_string()))
    }

    /// Skips a property. Its values are not checked.
    pub fn skip(&mut self, kind: Kind) -> Result<(), Failure> {
        let (count, item) = match kind {
            Kind::Number(item) => (1, item),
            Kind::List { count, item } => (self.count(count)?, item),
        };
        if self.encoding == Encoding::Text {
            for _ in 0..count {
                self.token().ok_or(Failure::End)?;
            }
            return Ok(());
        }
        let bytes = count.checked_mul(item.size() as u64);
        match bytes {
            Some(bytes) if bytes <= self.left() as u64 => self.at += bytes as usize,
            _ => return Err(Failure::End),
        }
        Ok(())
    }
}
