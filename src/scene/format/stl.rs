//! STL (3D Systems, StereoLithography Interface Specification, 1989): triangles, as text or binary.
//!
//! Facet normals are ignored: they follow from the vertices, and many writers set them to 0. A text
//! file can contain several solids, and facets with more than three vertices, which become
//! polygons. The up direction is Z, as on the machines that STL was designed for.
//!
//! Text is read as tokens, in any case and with or without `solid` and `endsolid`; line breaks
//! matter only for the names of solids. In a binary file whose size disagrees with the declared
//! number of facets, the size decides, because many writers never fill in the number.

use super::builder::SceneBuilder;
use super::entry::Format;
use super::error::ReadError;
use super::lines::{number, quoted, wide_text};
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;

pub(super) const FORMAT: Format = Format {
    name: "stl",
    about: "StereoLithography, text or binary",
    extensions: &["stl"],
    recognizes: |bytes| is_binary(bytes) || is_surely_text(bytes),
    read: |input, progress| read(input.bytes, progress),
    write: None,
};

/// Bytes of the free text at the start of a binary file.
const TITLE: usize = 80;
/// Bytes before the first binary facet: the free text and the number of facets.
const HEADER: usize = TITLE + 4;
/// Bytes of a binary facet: normal and three vertices in `f32`, and two unused bytes.
const FACET: usize = 50;
/// Facets between two checks for cancellation.
const FACETS_PER_CHECK: usize = 4096;
/// Tokens between two checks for cancellation.
const TOKENS_PER_CHECK: usize = 65_536;
/// Bytes at the start of a file by which text and binary data are told apart.
const SNIFFED_BYTES: usize = 1 << 16;

/// Returns the number of facets that a binary header declares.
fn declared_facets(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(TITLE..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

/// Returns whether the file has exactly the length that its binary header declares.
fn is_binary(bytes: &[u8]) -> bool {
    declared_facets(bytes).and_then(|facets| facets.checked_mul(FACET))
        == bytes.len().checked_sub(HEADER)
        && bytes.len() >= HEADER
}

/// Returns the file without a byte-order mark.
fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Returns the start of the file, in lower case.
fn head(bytes: &[u8]) -> Vec<u8> {
    let head = without_mark(bytes);
    head[..head.len().min(SNIFFED_BYTES)].to_ascii_lowercase()
}

/// Returns whether the file begins like a text file. Binary files with `solid` in their free text
/// do, too, but contain zeros.
fn is_text(head: &[u8]) -> bool {
    let start = head.trim_ascii_start();
    (start.starts_with(b"solid") || start.starts_with(b"facet")) && !head.contains(&0)
}

/// Returns whether the file is text of this format and no other.
fn is_surely_text(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let holds = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    is_text(&head) && (holds(b"facet") || holds(b"endsolid"))
}

fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    let builder = if is_binary(bytes) {
        read_binary(bytes, progress)?
    } else {
        let head = head(bytes);
        if is_text(&head) {
            read_text(bytes, progress)?
        } else {
            refuse_other_text(bytes, &head)?;
            read_binary(bytes, progress)?
        }
    };
    Ok(builder.finish_mesh(Vec3::Z))
}

/// Refuses text in UTF-16 and text that is not STL: as binary data it would give wild triangles.
fn refuse_other_text(bytes: &[u8], head: &[u8]) -> Result<(), ReadError> {
    const EXPECTED: &str = "STL as text in ASCII or UTF-8, or binary";
    let refuse = |found: String| Err(ReadError::at(Place::Line(1), EXPECTED, found));
    let has_mark = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let letters: Vec<u8> = head.iter().copied().filter(|b| *b != 0).collect();
    let holds = |word: &[u8]| letters.windows(word.len()).any(|part| part == word);
    if let Some(encoding) = wide_text(bytes)
        && (has_mark || holds(b"facet") || holds(b"solid"))
    {
        return refuse(format!("text in {encoding}"));
    }
    let is_printable = |b: &u8| b.is_ascii_graphic() || b.is_ascii_whitespace() || *b >= 0x80;
    if bytes.len() > HEADER && head.iter().all(is_printable) {
        let line = head.trim_ascii_start();
        let end = line.iter().position(|b| matches!(b, b'\n' | b'\r'));
        return refuse(quoted(&line[..end.unwrap_or(line.len())]));
    }
    Ok(())
}

/// Returns the number at an offset of a binary facet.
fn number_at(facet: &[u8], i: usize) -> f64 {
    f64::from(f32::from_le_bytes([
        facet[i],
        facet[i + 1],
        facet[i + 2],
        facet[i + 3],
    ]))
}

/// Returns the vertices of a binary facet.
fn vertices(facet: &[u8]) -> [Vec3; 3] {
    [12, 24, 36].map(|i| {
        let part = |offset: usize| number_at(facet, i + offset);
        Vec3::new(part(0), part(4), part(8))
    })
}

/// Returns whether bytes look like a facet rather than other data: there, coordinates are often
/// extremely large or small, or not finite.
fn is_plausible(facet: &[u8]) -> bool {
    let usual = |number: f64| number == 0.0 || (1e-20..1e20).contains(&number.abs());
    let vertices = vertices(facet);
    vertices.iter().all(|v| v.to_array().into_iter().all(usual))
}

/// Returns the number of facets to read, and notes it if it is not the one that the header
/// declares.
fn facets(bytes: &[u8], builder: &mut SceneBuilder) -> Result<usize, ReadError> {
    let declared = declared_facets(bytes).ok_or_else(|| {
        let expected = "'solid', or a binary header of 84 bytes";
        ReadError::at(Place::Byte(bytes.len()), expected, "the end of the file")
    })?;
    let data = &bytes[HEADER..];
    let held = data.len() / FACET;
    let ends_after_a_facet = data.len().is_multiple_of(FACET);
    // Some programs append data of their own after the last facet.
    if declared == held || (0 < declared && declared < held && !ends_after_a_facet) {
        return Ok(declared);
    }
    if held == 0 || !data.chunks_exact(FACET).all(is_plausible) {
        let expected = format_args!("{declared} facets, as declared in the header");
        let place = Place::Element("facet", held);
        return Err(ReadError::at(place, expected, "the end of the file"));
    }
    let text = format!(
        "count of {declared} facets in the header; using the {held} that the size of the file gives"
    );
    builder.note(NoteKind::Changed, &text, Place::Byte(TITLE));
    Ok(held)
}

fn read_binary(bytes: &[u8], progress: &Progress) -> Result<SceneBuilder, ReadError> {
    let mut builder = SceneBuilder::default();
    let count = facets(bytes, &mut builder)?;
    builder.reserve(count);
    let facets = bytes[HEADER..].chunks_exact(FACET).take(count);
    for (number, facet) in facets.enumerate() {
        if number.is_multiple_of(FACETS_PER_CHECK) {
            progress.check()?;
            progress.set(number as f64 / count as f64);
        }
        builder.face(Place::Element("facet", number), &vertices(facet), None)?;
    }
    let end = HEADER + count * FACET;
    if bytes.len() > end {
        let text = format!("{} bytes after the last facet", bytes.len() - end);
        builder.note(NoteKind::Skipped, &text, Place::Byte(end));
    }
    Ok(builder)
}

/// The tokens of a text file.
struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The current line, counted from 1.
    line: usize,
    /// The line of the last token.
    last_line: usize,
    taken: usize,
    progress: &'a Progress,
}

impl<'a> Tokens<'a> {
    fn place(&self) -> Place {
        Place::Line(self.last_line)
    }

    /// Returns the next token; `None` at the end of the file.
    fn next(&mut self) -> Result<Option<&'a [u8]>, ReadError> {
        self.taken += 1;
        if self.taken.is_multiple_of(TOKENS_PER_CHECK) {
            self.progress.check()?;
            let done = self.at as f64 / self.bytes.len() as f64;
            self.progress.set(done);
        }
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => self.line += 1,
                b'\r' if self.bytes.get(self.at + 1) != Some(&b'\n') => self.line += 1,
                byte if byte.is_ascii_whitespace() || byte == 0x0b => {}
                _ => break,
            }
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let is_blank = |b: &u8| matches!(b, b'\t'..=b'\r' | b' ');
        let length = rest.iter().position(is_blank).unwrap_or(rest.len());
        self.at += length;
        if length > 0 {
            self.last_line = self.line;
        }
        Ok((length > 0).then(|| &rest[..length]))
    }

    /// Returns the next token without reading it.
    fn peek(&mut self) -> Result<Option<&'a [u8]>, ReadError> {
        let before = (self.at, self.line, self.last_line, self.taken);
        let token = self.next();
        (self.at, self.line, self.last_line, self.taken) = before;
        token
    }

    /// Reads the next keyword: in two words (`end loop`) or in one.
    fn keyword(&mut self) -> Result<Keyword<'a>, ReadError> {
        let Some(word) = self.next()? else {
            return Ok(Keyword::End);
        };
        let is = |word: &[u8], known: &str| word.eq_ignore_ascii_case(known.as_bytes());
        for (keyword, name, [first, second]) in KEYWORDS {
            if is(word, name) {
                return Ok(*keyword);
            }
            if !second.is_empty() && is(word, first) {
                let before = (self.at, self.line, self.last_line);
                if self.next()?.is_some_and(|next| is(next, second)) {
                    return Ok(*keyword);
                }
                (self.at, self.line, self.last_line) = before;
            }
        }
        Ok(Keyword::Other(word))
    }

    /// Skips the name of a solid: the rest of the line, unless a facet begins there.
    fn skip_name(&mut self) {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let line = rest[..end.unwrap_or(rest.len())].to_ascii_lowercase();
        let find = |word: &[u8], from: usize| {
            let mut places = line[from..].windows(word.len());
            places.position(|part| part == word).map(|at| from + at)
        };
        let facet = find(b"facet normal", 0);
        let solid = facet.and_then(|facet| find(b"solid ", 0).filter(|solid| *solid < facet));
        self.at += solid.or(facet).unwrap_or(line.len());
    }

    fn vertex(&mut self) -> Result<Vec3, ReadError> {
        let place = self.place();
        let mut vertex = [0.0; 3];
        for (coordinate, name) in vertex.iter_mut().zip(["x", "y", "z"]) {
            let word = self.next()?;
            let finite = word.and_then(number).filter(|n| n.is_finite());
            *coordinate = finite.ok_or_else(|| {
                let expected = format_args!("{name} of the vertex (a finite number)");
                ReadError::at(place, expected, found(word))
            })?;
        }
        Ok(Vec3::from_array(vertex))
    }
}

fn found(word: Option<&[u8]>) -> String {
    word.map_or_else(|| "the end of the file".to_owned(), quoted)
}

/// A keyword of a text file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Keyword<'a> {
    Solid,
    Facet,
    OuterLoop,
    Vertex,
    EndLoop,
    EndFacet,
    EndSolid,
    /// The end of the file.
    End,
    Other(&'a [u8]),
}

/// The keywords in one word and in two.
const KEYWORDS: &[(Keyword<'static>, &str, [&str; 2])] = &[
    (Keyword::Vertex, "vertex", ["", ""]),
    (Keyword::Facet, "facet", ["", ""]),
    (Keyword::OuterLoop, "outerloop", ["outer", "loop"]),
    (Keyword::EndLoop, "endloop", ["end", "loop"]),
    (Keyword::EndFacet, "endfacet", ["end", "facet"]),
    (Keyword::EndSolid, "endsolid", ["end", "solid"]),
    (Keyword::Solid, "solid", ["", ""]),
];

impl Keyword<'_> {
    /// Returns the keyword as quoted in messages.
    fn quoted(self) -> String {
        match self {
            Keyword::End => "the end of the file".to_owned(),
            Keyword::Other(word) => quoted(word),
            known => {
                let name = KEYWORDS.iter().find(|(keyword, ..)| *keyword == known);
                format!("'{}'", name.map_or("", |(_, name, _)| *name))
            }
        }
    }
}

fn read_text(bytes: &[u8], progress: &Progress) -> Result<SceneBuilder, ReadError> {
    progress.check()?;
    let mut builder = SceneBuilder::default();
    let mut tokens = Tokens {
        bytes: without_mark(bytes),
        at: 0,
        line: 1,
        last_line: 1,
        taken: 0,
        progress,
    };
    let mut in_solid = false;
    let mut vertices = Vec::new();
    loop {
        let keyword = tokens.keyword()?;
        let error = |expected: &str, keyword: Keyword<'_>, tokens: &Tokens<'_>| {
            Err(ReadError::at(tokens.place(), expected, keyword.quoted()))
        };
        match keyword {
            Keyword::Solid if !in_solid => {
                in_solid = true;
                tokens.skip_name();
            }
            Keyword::EndSolid => {
                in_solid = false;
                tokens.skip_name();
            }
            Keyword::End if !in_solid => return Ok(builder),
            Keyword::Facet => {
                let facet = tokens.place();
                skip_normal(&mut tokens)?;
                let keyword = tokens.keyword()?;
                if keyword != Keyword::OuterLoop {
                    return error("'outer loop'", keyword, &tokens);
                }
                vertices.clear();
                loop {
                    match tokens.keyword()? {
                        Keyword::Vertex => vertices.push(tokens.vertex()?),
                        Keyword::EndLoop => break,
                        other => return error("'vertex' or 'endloop'", other, &tokens),
                    }
                }
                let keyword = tokens.keyword()?;
                if keyword != Keyword::EndFacet {
                    return error("'endfacet'", keyword, &tokens);
                }
                match vertices.len() {
                    0..3 => builder.skip_face(facet, "facet of fewer than 3 vertices")?,
                    _ => builder.face(facet, &vertices, None)?,
                }
            }
            other if in_solid => return error("'facet' or 'endsolid'", other, &tokens),
            other => return error("'solid' or 'facet'", other, &tokens),
        }
    }
}

/// Skips the normal of a facet, whatever it consists of.
fn skip_normal(tokens: &mut Tokens<'_>) -> Result<(), ReadError> {
    if tokens
        .peek()?
        .is_some_and(|word| word.eq_ignore_ascii_case(b"normal"))
    {
        tokens.next()?;
    }
    for _ in 0..3 {
        let begins_a_number = |word: &[u8]| {
            number(word).is_some() || word[0].is_ascii_digit() || b"+-.".contains(&word[0])
        };
        if !tokens.peek()?.is_some_and(begins_a_number) {
            return Ok(());
        }
        tokens.next()?;
    }
    Ok(())
}
