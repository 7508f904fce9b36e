//! PLY (G. Turk, "The PLY Polygon File Format", Stanford, 1994), as text or binary of either byte
//! order.
//!
//! Reads the properties x, y, z and nx, ny, nz of the element `vertex`, the list `vertex_indices`
//! or `vertex_index` of `face`, and that of `tristrips`: strips of triangles, where −1 begins a new
//! strip. Everything else is skipped and counted. The up direction is Y.
//!
//! Text is read as tokens: an element may extend over several lines, and a line may hold several
//! elements. If that leaves values over, each element is read from a line of its own instead, and
//! the values after it are skipped, as other programs do.
//!
//! `ply-rs-bw` 4.0.1 was used before. It reads text one line per element and refuses byte-order
//! marks, blank header lines and whole numbers written as decimals, so that header and values are
//! read here.

mod header;
mod values;

use super::builder::{MAX_VERTICES, SceneBuilder};
use super::entry::Format;
use super::error::ReadError;
use super::lines::quoted;
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;
use header::{Element, Encoding, Header, Kind, Property, Scalar, unusable};
use std::collections::HashMap;
use values::{Failure, Layout, Values};

pub(super) const FORMAT: Format = Format {
    name: "ply",
    about: "Polygon File Format of Stanford, text or binary",
    extensions: &["ply"],
    recognizes: header::is_ply,
    read: |input, progress| read(input.bytes, progress),
    write: None,
};

/// The properties that are read from a vertex: position and normal.
const NUMBERS: [&[u8]; 6] = [b"x", b"y", b"z", b"nx", b"ny", b"nz"];

/// The names of a face's or strip's list of vertices.
const LISTS: [&[u8]; 2] = [b"vertex_indices", b"vertex_index"];

/// Bytes that a triangle takes at least, with indices of four bytes.
const BYTES_PER_FACE: usize = 13;

/// Number of property names in a note.
const SHOWN_NAMES: usize = 4;

fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    let header = header::read(bytes, progress)?;
    let values = |layout| {
        let start = [header.length, header.lines];
        Values::new(bytes, start, header.encoding, layout, progress)
    };
    let mut tokens = values(Layout::Tokens);
    let mesh = Mesh::read(&header, &mut tokens);
    let is_complete = mesh.is_ok() && tokens.rest().is_none();
    if is_complete || tokens.misaligned.is_none() || progress.is_cancelled() {
        return Ok(mesh?.finish(&header, &mut tokens));
    }
    // Some element did not begin on a new line: perhaps the lines hold more than the header says.
    let error = mesh.err();
    let mut lines = values(Layout::Lines);
    match Mesh::read(&header, &mut lines) {
        Ok(mesh) => Ok(mesh.finish(&header, &mut lines)),
        Err(ReadError::Cancelled(cancelled)) => Err(cancelled.into()),
        // Without an error, values are left over: one may have been mistaken for another.
        Err(reason) => Err(error.unwrap_or(reason)),
    }
}

#[derive(Default)]
struct Mesh {
    builder: SceneBuilder,
    positions: Vec<Vec3>,
    /// One per position, or none at all.
    normals: Vec<Vec3>,
    /// The places of vertices that are not finite, by their index.
    infinite: HashMap<usize, Place>,
    /// Notes on what is skipped; dropped if there are no faces.
    skipped: Vec<(String, usize, Place)>,
}

impl Mesh {
    fn read(header: &Header, values: &mut Values<'_>) -> Result<Self, ReadError> {
        let mut mesh = Mesh::default();
        for element in &header.elements {
            match element.name.as_slice() {
                b"vertex" => mesh.vertices(element, values)?,
                b"face" => mesh.faces("face", element, values)?,
                b"tristrips" => mesh.faces("tristrips", element, values)?,
                _ => mesh.skip(element, values)?,
            }
        }
        Ok(mesh)
    }

    fn finish(mut self, header: &Header, values: &mut Values<'_>) -> SceneParts {
        if self.builder.faces() == 0 && !self.positions.is_empty() {
            // One line says it all: the properties of points do not matter.
            self.builder.note_points(self.positions.len());
        } else {
            for (text, count, place) in &self.skipped {
                let builder = &mut self.builder;
                builder.note_times(NoteKind::Skipped, text, *count, *place);
            }
        }
        if let Some((place, lines)) = values.surplus {
            const TEXT: &str = "line with more values than the header declares";
            self.builder
                .note_times(NoteKind::Skipped, TEXT, lines, place);
        }
        if let Some(place) = values.rest() {
            let what = match header.encoding {
                Encoding::Text => "lines after the last element",
                _ => "bytes after the last element",
            };
            self.builder.note(NoteKind::Skipped, what, place);
        }
        self.builder.finish_mesh(Vec3::Y)
    }

    fn skip(&mut self, element: &Element, values: &mut Values<'_>) -> Result<(), ReadError> {
        // These take neither bytes nor tokens, however many there are.
        if element.properties.is_empty() {
            return Ok(());
        }
        let name = quoted(&element.name);
        let mut first = None;
        for number in 0..element.count {
            let place = values.begin("element", number)?;
            first.get_or_insert(place);
            for property in &element.properties {
                let skipped = values.skip(property.kind);
                skipped.map_err(|failure| failed(failure, "element", element, place, values))?;
            }
        }
        if let Some(place) = first {
            let count = element.count as usize;
            self.skipped.push((format!("element {name}"), count, place));
        }
        Ok(())
    }

    /// Notes the properties that are not read, in one line.
    fn skip_properties<'a>(
        &mut self,
        of: &str,
        names: impl Iterator<Item = &'a Property>,
        place: Place,
    ) {
        let names: Vec<_> = names.map(|property| quoted(&property.name)).collect();
        let mut shown = names[..names.len().min(SHOWN_NAMES)].join(", ");
        if names.len() > SHOWN_NAMES {
            shown.push_str(&format!(" and {} more", names.len() - SHOWN_NAMES));
        }
        let what = match names.len() {
            0 => return,
            1 => "property",
            _ => "properties",
        };
        let text = format!("{what} {shown} of {of}");
        self.skipped.push((text, 1, place));
    }

    fn vertices(&mut self, element: &Element, values: &mut Values<'_>) -> Result<(), ReadError> {
        let start = Place::Element("vertex", 0);
        let number_of = |property: &Property| match property.kind {
            Kind::Number(kind) => {
                let known = NUMBERS.iter().position(|name| *name == property.name);
                known.map(|place| (place, kind))
            }
            Kind::List { .. } => None,
        };
        let has = |places: std::ops::Range<usize>| {
            let mut places = places.into_iter();
            let properties = &element.properties;
            places.all(|place| {
                let is_it = |p| number_of(p).is_some_and(|(found, _)| found == place);
                properties.iter().any(is_it)
            })
        };
        if !has(0..3) {
            let expected = "vertices with the numbers x, y and z";
            return Err(unusable("vertex", expected));
        }
        let has_normals = has(3..6);
        let others = element.properties.iter().filter(|p| number_of(p).is_none());
        self.skip_properties("vertices", others, start);
        let steps: Vec<_> = element
            .properties
            .iter()
            .map(|property| (number_of(property), property.kind))
            .collect();
        for number in 0..element.count {
            let place = values.begin("vertex", number)?;
            let mut numbers = [0.0; 6];
            for (step, kind) in &steps {
                let done = match *step {
                    Some((at @ 0..3, kind)) => values.number(kind).map(|n| numbers[at] = n),
                    Some((at, kind)) => values.direction(kind).map(|n| numbers[at] = n),
                    None => values.skip(*kind),
                };
                done.map_err(|failure| failed(failure, "vertex", element, place, values))?;
            }
            let [x, y, z, nx, ny, nz] = numbers;
            let position = Vec3::new(x, y, z);
            if !position.is_finite() {
                self.infinite.insert(self.positions.len(), place);
            }
            self.positions.push(position);
            if has_normals {
                self.normals.push(Vec3::new(nx, ny, nz));
            }
        }
        Ok(())
    }

    /// Reads faces, or strips of triangles.
    fn faces(
        &mut self,
        kind: &'static str,
        element: &Element,
        values: &mut Values<'_>,
    ) -> Result<(), ReadError> {
        let is_list = |property: &Property| {
            LISTS.contains(&property.name.as_slice()) && matches!(property.kind, Kind::List { .. })
        };
        let Some(list) = element.properties.iter().position(is_list) else {
            if element.count == 0 {
                return Ok(());
            }
            let expected = "a list of whole numbers vertex_indices or vertex_index";
            return Err(unusable(kind, expected));
        };
        let start = Place::Element(kind, 0);
        let others = element.properties.iter().enumerate();
        let others = others.filter(|(i, _)| *i != list).map(|(_, p)| p);
        self.skip_properties(
            if kind == "face" { "faces" } else { "strips" },
            others,
            start,
        );
        if kind == "face" {
            let most = values.left() / BYTES_PER_FACE;
            let count = usize::try_from(element.count).unwrap_or(usize::MAX);
            self.builder.reserve(count.min(most));
        }
        let mut indices = Vec::new();
        let mut corners = Corners::default();
        for number in 0..element.count {
            let place = values.begin(kind, number)?;
            for (i, property) in element.properties.iter().enumerate() {
                let done = match property.kind {
                    Kind::List { count, item } if i == list => {
                        read_list(values, [count, item], &mut indices)
                    }
                    other => values.skip(other),
                };
                done.map_err(|failure| failed(failure, kind, element, place, values))?;
            }
            if kind == "face" {
                self.face(place, &indices, &mut corners)?;
            } else {
                self.strips(place, &indices, &mut corners)?;
            }
        }
        Ok(())
    }

    fn face(
        &mut self,
        place: Place,
        indices: &[i64],
        corners: &mut Corners,
    ) -> Result<(), ReadError> {
        if indices.len() < 3 {
            const TEXT: &str = "face of fewer than 3 vertices";
            return self.builder.skip_face(place, TEXT);
        }
        let Corners { vertices, normals } = corners;
        vertices.clear();
        normals.clear();
        // A face with too many vertices is skipped, so the rest of its vertices do not matter.
        for &index in indices.iter().take(MAX_VERTICES + 1) {
            let at = usize::try_from(index).unwrap_or(usize::MAX);
            let Some(&vertex) = self.positions.get(at) else {
                let count = self.positions.len();
                let expected = format_args!("the index of one of the {count} vertices above");
                return Err(ReadError::at(place, expected, index));
            };
            if !self.infinite.is_empty()
                && let Some(defined) = self.infinite.get(&at)
            {
                let expected = "vertices with finite coordinates";
                let found = match defined {
                    Place::Line(line) => format!("vertex {at} of line {line}"),
                    _ => format!("vertex {at}"),
                };
                return Err(ReadError::at(place, expected, found));
            }
            vertices.push(vertex);
            normals.extend(self.normals.get(at));
        }
        let normals = (!self.normals.is_empty()).then_some(normals.as_slice());
        self.builder.face(place, vertices, normals)
    }

    /// Adds the triangles of strips, between which −1 stands.
    fn strips(
        &mut self,
        place: Place,
        indices: &[i64],
        corners: &mut Corners,
    ) -> Result<(), ReadError> {
        let ends = |index: &i64| *index == -1 || *index == i64::from(u32::MAX);
        for strip in indices.split(ends) {
            for (i, triangle) in strip.windows(3).enumerate() {
                let &[a, b, c] = triangle else { continue };
                // Strips are joined by triangles with a repeated vertex, which are no faces.
                if a == b || b == c || c == a {
                    continue;
                }
                // Every other triangle of a strip has the opposite orientation.
                let triangle = if i % 2 == 1 { [b, a, c] } else { [a, b, c] };
                self.face(place, &triangle, corners)?;
            }
        }
        Ok(())
    }
}

/// Vertices and normals of a face; kept to reuse their memory.
#[derive(Default)]
struct Corners {
    vertices: Vec<Vec3>,
    normals: Vec<Vec3>,
}

/// Reads a list of whole numbers. No memory is reserved for the declared count.
fn read_list(
    values: &mut Values<'_>,
    [count, item]: [Scalar; 2],
    list: &mut Vec<i64>,
) -> Result<(), Failure> {
    list.clear();
    for _ in 0..values.count(count)? {
        list.push(values.whole(item)?);
    }
    Ok(())
}

/// Returns the error that an element cannot be read.
fn failed(
    failure: Failure,
    kind: &str,
    of: &Element,
    place: Place,
    values: &Values<'_>,
) -> ReadError {
    match failure {
        Failure::End => {
            let expected = format_args!("{} of element {}", of.count, quoted(&of.name));
            ReadError::at(place, expected, "the end of the file")
        }
        Failure::Found(found) => {
            let place = match place {
                Place::Line(_) => values.line(),
                place => place,
            };
            let article = if kind == "element" { "an" } else { "a" };
            ReadError::at(
                place,
                format_args!("the numbers of {article} {kind}"),
                found,
            )
        }
    }
}
