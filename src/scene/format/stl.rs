//! STL (3D Systems, StereoLithography Interface Specification, 1989): triangles, as text or binary.
//!
//! Facet normals are ignored: they follow from the vertices, and many writers set them to 0. A text
//! file can contain several solids, and facets with more than three vertices, which become
//! polygons. The up direction is Z, as on the machines that STL was designed for.

use super::builder::SceneBuilder;
use super::entry::Format;
use super::error::ReadError;
use super::lines::Lines;
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;

pub(super) const FORMAT: Format = Format {
    name: "stl",
    about: "StereoLithography, text or binary",
    extensions: &["stl"],
    recognizes: |bytes| is_binary(bytes) || is_text(bytes),
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

/// Returns whether the file begins like a text file. Binary files with `solid` in their free text
/// do, too.
fn is_text(bytes: &[u8]) -> bool {
    let head = bytes[..bytes.len().min(1024)].to_ascii_lowercase();
    let holds = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    head.trim_ascii_start().starts_with(b"solid")
        && !head.contains(&0)
        && (holds(b"facet") || holds(b"endsolid"))
}

fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    let builder = if !is_binary(bytes) && is_text(bytes) {
        read_text(bytes, progress)?
    } else {
        read_binary(bytes, progress)?
    };
    Ok(builder.finish_mesh(Vec3::Z))
}

fn read_binary(bytes: &[u8], progress: &Progress) -> Result<SceneBuilder, ReadError> {
    let declared = declared_facets(bytes).ok_or_else(|| {
        let expected = "'solid', or a binary header of 84 bytes";
        ReadError::at(Place::Byte(bytes.len()), expected, "the end of the file")
    })?;
    let facets = bytes[HEADER..].chunks_exact(FACET);
    if facets.len() < declared {
        let expected = format_args!("{declared} facets, as declared in the header");
        let end = Place::Element("facet", facets.len());
        return Err(ReadError::at(end, expected, "the end of the file"));
    }
    let mut builder = SceneBuilder::default();
    builder.reserve(declared);
    for (number, facet) in facets.take(declared).enumerate() {
        if number.is_multiple_of(FACETS_PER_CHECK) {
            progress.check()?;
            progress.set(number as f64 / declared as f64);
        }
        let number_at = |i: usize| {
            let bytes = [facet[i], facet[i + 1], facet[i + 2], facet[i + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        let vertex = |i: usize| Vec3::new(number_at(i), number_at(i + 4), number_at(i + 8));
        let vertices = [vertex(12), vertex(24), vertex(36)];
        builder.face(Place::Element("facet", number), &vertices, None)?;
    }
    let end = HEADER + declared * FACET;
    if bytes.len() > end {
        let text = format!("{} bytes after the last facet", bytes.len() - end);
        builder.note(NoteKind::Skipped, &text, Place::Byte(end));
    }
    Ok(builder)
}

fn read_text(bytes: &[u8], progress: &Progress) -> Result<SceneBuilder, ReadError> {
    let mut builder = SceneBuilder::default();
    let mut lines = Lines::new(bytes, progress);
    // The words that may come next, and the position of the current facet.
    let mut expected = "'solid'";
    let mut facet = Place::Line(1);
    let mut vertices = Vec::new();
    while let Some(line) = lines.next_with_words()? {
        let mut words = line.words();
        let word = words.next().unwrap_or_default().to_ascii_lowercase();
        expected = match (expected, word.as_slice()) {
            (SOLID, b"solid") => FACET_OR_END,
            (FACET_OR_END, b"facet") => {
                facet = line.place();
                vertices.clear();
                "'outer loop'"
            }
            ("'outer loop'", b"outer") => VERTEX,
            (VERTEX, b"vertex") => {
                vertices.push(words.point("the vertex")?);
                VERTEX
            }
            (VERTEX, b"endloop") => "'endfacet'",
            ("'endfacet'", b"endfacet") => {
                match vertices.len() {
                    0..3 => builder.skip_face(facet, "facet of fewer than 3 vertices")?,
                    _ => builder.face(facet, &vertices, None)?,
                }
                FACET_OR_END
            }
            (FACET_OR_END, b"endsolid") => SOLID,
            _ => return Err(words.error(expected, Some(&word))),
        };
    }
    if expected != SOLID {
        return Err(lines.unexpected_end(expected));
    }
    Ok(builder)
}

const SOLID: &str = "'solid'";
const FACET_OR_END: &str = "'facet' or 'endsolid'";
const VERTEX: &str = "'vertex' or 'endloop'";
