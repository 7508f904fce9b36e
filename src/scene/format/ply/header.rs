//! The header: which elements follow, with which properties.

use crate::progress::Progress;
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::{Line, Lines, quoted, refuse_wide_text, whole};
use crate::scene::format::place::Place;

/// How the values after the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Scalar {
    /// Returns the size in bytes.
    pub fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::I64 | Scalar::U64 | Scalar::F64 => 8,
        }
    }

    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"int64" => Scalar::I64,
            b"uint64" => Scalar::U64,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number(Scalar),
    List { count: Scalar, item: Scalar },
}

pub(super) struct Property {
    pub name: Vec<u8>,
    pub kind: Kind,
}

/// Elements of a kind, such as vertices.
pub(super) struct Element {
    pub name: Vec<u8>,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// The number of lines of the header.
    pub lines: usize,
    /// The number of bytes of the header.
    pub length: usize,
}

/// Returns whether the file begins like a PLY file.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
    text.trim_ascii_start()
        .strip_prefix(b"ply")
        .and_then(|rest| rest.iter().find(|b| !matches!(b, b' ' | b'\t')))
        .is_some_and(is_end)
}

/// Reads the header. Blank lines in it, and white space around its words, do not matter.
pub(super) fn read(bytes: &[u8], progress: &Progress) -> Result<Header, ReadError> {
    refuse_wide_text(bytes)?;
    let expect = |line: &Line<'_>, expected: &str| {
        ReadError::at(line.place(), expected, quoted(line.bytes.trim_ascii()))
    };
    let mut lines = Lines::new(bytes, progress);
    let first = lines.next_with_words()?;
    if first.is_none_or(|line| line.bytes.trim_ascii() != b"ply") {
        let expected = "'ply' as the first line of a PLY header";
        return Err(match first {
            Some(line) => expect(&line, expected),
            None => lines.unexpected_end(expected),
        });
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let Some(line) = lines.next_with_words()? else {
            return Err(lines.unexpected_end("'end_header' at the end of the PLY header"));
        };
        let mut words = line.words();
        match words.next().unwrap_or_default() {
            b"comment" | b"obj_info" => {}
            b"format" => {
                encoding = Some(match words.next() {
                    Some(b"ascii") => Encoding::Text,
                    Some(b"binary_little_endian") => Encoding::LittleEndian,
                    Some(b"binary_big_endian") => Encoding::BigEndian,
                    _ => {
                        let expected = "'format' with ascii, binary_little_endian or \
                                        binary_big_endian";
                        return Err(expect(&line, expected));
                    }
                });
            }
            b"element" => {
                let name = words.next().map(<[u8]>::to_vec);
                let count = words.next().and_then(|word| {
                    let large = || std::str::from_utf8(word).ok()?.parse().ok();
                    large().or_else(|| u64::try_from(whole(word)?).ok())
                });
                let (Some(name), Some(count)) = (name, count) else {
                    return Err(expect(
                        &line,
                        "'element' with a name and a number of elements",
                    ));
                };
                elements.push(Element {
                    name,
                    count,
                    properties: Vec::new(),
                });
            }
            b"property" => {
                let property = property(&mut words);
                let (Some(element), Some(property)) = (elements.last_mut(), property) else {
                    let expected = "'property' of an element, with types and a name";
                    return Err(expect(&line, expected));
                };
                element.properties.push(property);
            }
            b"end_header" => {
                let encoding = encoding.ok_or_else(|| {
                    let expected = "a line 'format' before the end of the PLY header";
                    expect(&line, expected)
                })?;
                return Ok(Header {
                    encoding,
                    elements,
                    lines: line.number,
                    length: end_of_header(bytes, &line),
                });
            }
            _ => return Err(expect(&line, "a line of a PLY header")),
        }
    }
}

fn property<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<Property> {
    let kind = match words.next()? {
        b"list" => {
            let [count, item] = [words.next()?, words.next()?];
            let (count, item) = (Scalar::named(count)?, Scalar::named(item)?);
            Kind::List { count, item }
        }
        name => Kind::Number(Scalar::named(name)?),
    };
    let name = words.next()?.to_vec();
    Some(Property { name, kind })
}

/// Returns where the values begin: after the line break of the header's last line. In a header whose
/// lines end with CR alone, an LF after it is the first value of a binary file.
fn end_of_header(bytes: &[u8], last: &Line<'_>) -> usize {
    let at = last.bytes.as_ptr() as usize - bytes.as_ptr() as usize + last.bytes.len();
    let is_break = |b: &u8| matches!(b, b'\n' | b'\r');
    let first_break = bytes.iter().position(is_break).unwrap_or(bytes.len());
    let is_cr_lf = |at: usize| bytes[at..].starts_with(b"\r\n");
    let ends_with_cr = bytes.get(first_break) == Some(&b'\r') && !is_cr_lf(first_break);
    match bytes.get(at) {
        None => at,
        Some(_) if is_cr_lf(at) && !ends_with_cr => at + 2,
        Some(_) => at + 1,
    }
}

/// Returns the error that an element cannot be used.
pub(super) fn unusable(kind: &'static str, expected: &str) -> ReadError {
    ReadError::at(Place::Element(kind, 0), expected, "others")
}
