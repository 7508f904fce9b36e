//! PLY (G. Turk, "The PLY Polygon File Format", Stanford, 1994), as text or binary of either byte
//! order.
//!
//! Reads the properties x, y, z and nx, ny, nz of the element `vertex`, and the list
//! `vertex_indices` or `vertex_index` of `face`. Everything else is skipped and counted. The up
//! direction is Y. `ply-rs-bw` parses the values one element at a time, so a header that declares
//! too many elements costs no memory.

use super::builder::{MAX_VERTICES, SceneBuilder};
use super::entry::Format;
use super::error::ReadError;
use super::lines::{Lines, quoted};
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

pub(super) const FORMAT: Format = Format {
    name: "ply",
    about: "Polygon File Format of Stanford, text or binary",
    extensions: &["ply"],
    recognizes: |bytes| bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r"),
    read: |input, progress| read(input.bytes, progress),
    write: None,
};

/// Elements between two checks for cancellation.
const ELEMENTS_PER_CHECK: usize = 4096;

/// The properties that are read from a vertex, in the order of [`Values::numbers`].
const NUMBERS: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];

/// The values of an element that are used here.
struct Values {
    numbers: [Option<f64>; 6],
    /// A face's list of vertices.
    indices: Option<Property>,
}

impl PropertyAccess for Values {
    fn new() -> Self {
        Values {
            numbers: [None; 6],
            indices: None,
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if let Some(place) = NUMBERS.iter().position(|known| *known == name) {
            self.numbers[place] = number(&value);
        } else if matches!(name, "vertex_indices" | "vertex_index") {
            self.indices = Some(value);
        }
        PropertyAccessResult::Set
    }
}

fn number(value: &Property) -> Option<f64> {
    Some(match *value {
        Property::Char(v) => v.into(),
        Property::UChar(v) => v.into(),
        Property::Short(v) => v.into(),
        Property::UShort(v) => v.into(),
        Property::Int(v) => v.into(),
        Property::UInt(v) => v.into(),
        Property::Float(v) => v.into(),
        Property::Double(v) => v,
        _ => return None,
    })
}

/// Returns the integers of a list; `None` for other values.
fn whole_numbers(value: &Property) -> Option<Vec<i64>> {
    fn all<T: Copy + Into<i64>>(list: &[T]) -> Vec<i64> {
        list.iter().map(|&v| v.into()).collect()
    }
    Some(match value {
        Property::ListChar(list) => all(list),
        Property::ListUChar(list) => all(list),
        Property::ListShort(list) => all(list),
        Property::ListUShort(list) => all(list),
        Property::ListInt(list) => all(list),
        Property::ListUInt(list) => all(list),
        _ => return None,
    })
}

fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Values>::new()
        .read_header(&mut reader)
        .map_err(|error| {
            let place = Place::Line(error.line().unwrap_or(1));
            ReadError::at(place, "a PLY header", truncated(&error))
        })?;
    let mut mesh = Mesh::default();
    let lines_before = reader.line() - 1;
    let rest = reader.into_inner();
    let mut elements = Elements {
        encoding: header.encoding,
        parser: Parser::new(),
        total: rest.len(),
        lines: Lines::after(lines_before, rest, progress),
        rest,
        progress,
    };
    for element in header.elements.values() {
        mesh.element(element, &mut elements)?;
    }
    let (what, left) = match header.encoding {
        Encoding::Ascii => match elements.lines.next_with_words()? {
            Some(line) => ("lines after the last element", Some(line.place())),
            None => ("", None),
        },
        _ => (
            "bytes after the last element",
            (!elements.rest.is_empty()).then_some(Place::Byte(bytes.len() - elements.rest.len())),
        ),
    };
    if let Some(place) = left {
        mesh.builder.note(NoteKind::Skipped, what, place);
    }
    Ok(mesh.builder.finish_mesh(Vec3::Y))
}

/// The values after the header, one element at a time.
struct Elements<'a> {
    encoding: Encoding,
    parser: Parser<Values>,
    /// The rest of a text file.
    lines: Lines<'a>,
    /// The rest of a binary file.
    rest: &'a [u8],
    /// Bytes after the header.
    total: usize,
    progress: &'a Progress,
}

impl Elements<'_> {
    /// Returns the next element with its position; `number` counts elements of its kind from 0.
    fn next(
        &mut self,
        kind: &'static str,
        number: usize,
        of: &ElementDef,
    ) -> Result<(Values, Place), ReadError> {
        let expected = || format!("{} of element {}", of.count, quoted(of.name.as_bytes()));
        let (values, place) = if self.encoding == Encoding::Ascii {
            let Some(line) = self.lines.next_with_words()? else {
                return Err(self.lines.unexpected_end(expected()));
            };
            let text = std::str::from_utf8(line.bytes).map_err(|_| {
                let expected = format_args!("the numbers of a {kind}");
                ReadError::at(line.place(), expected, quoted(line.bytes))
            })?;
            (self.parser.read_ascii_element(text, of), line.place())
        } else {
            if number.is_multiple_of(ELEMENTS_PER_CHECK) {
                self.progress.check()?;
                let done = 1.0 - self.rest.len() as f64 / self.total.max(1) as f64;
                self.progress.set(done);
            }
            let values = match self.encoding {
                Encoding::BinaryBigEndian => {
                    self.parser.read_big_endian_element(&mut self.rest, of)
                }
                _ => self.parser.read_little_endian_element(&mut self.rest, of),
            };
            (values, Place::Element(kind, number))
        };
        match values {
            Ok(values) => Ok((values, place)),
            Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                Err(ReadError::at(place, expected(), "the end of the file"))
            }
            Err(error) => {
                let expected = format_args!("the numbers of a {kind}");
                Err(ReadError::at(place, expected, truncated(&error)))
            }
        }
    }
}

#[derive(Default)]
struct Mesh {
    builder: SceneBuilder,
    positions: Vec<Vec3>,
    /// One per position, or none at all.
    normals: Vec<Vec3>,
}

impl Mesh {
    fn element(&mut self, of: &ElementDef, elements: &mut Elements<'_>) -> Result<(), ReadError> {
        match of.name.as_str() {
            "vertex" => self.vertices(of, elements),
            "face" => self.faces(of, elements),
            // Elements without properties take no bytes in a binary file, but a line in a text
            // file.
            _ if of.properties.is_empty() && elements.encoding != Encoding::Ascii => Ok(()),
            name => {
                let text = format!("element {}", quoted(name.as_bytes()));
                for number in 0..of.count {
                    let (_, place) = elements.next("element", number, of)?;
                    self.builder.note(NoteKind::Skipped, &text, place);
                }
                Ok(())
            }
        }
    }

    fn vertices(&mut self, of: &ElementDef, elements: &mut Elements<'_>) -> Result<(), ReadError> {
        let start = Place::Element("vertex", 0);
        let has = |names: &[&str]| names.iter().all(|name| of.properties.contains_key(*name));
        if !has(&NUMBERS[..3]) {
            let expected = "vertices with the properties x, y and z";
            return Err(ReadError::at(start, expected, "others"));
        }
        let has_normals = has(&NUMBERS[3..]);
        for name in of.properties.keys() {
            if !NUMBERS.contains(&name.as_str()) {
                let text = format!("property {} of vertices", quoted(name.as_bytes()));
                self.builder.note(NoteKind::Skipped, &text, start);
            }
        }
        for number in 0..of.count {
            let (values, place) = elements.next("vertex", number, of)?;
            let part = |from: usize| match values.numbers[from..from + 3] {
                [Some(x), Some(y), Some(z)] => Ok(Vec3::new(x, y, z)),
                _ => Err(ReadError::at(place, "numbers for coordinates", "lists")),
            };
            self.positions.push(part(0)?);
            if has_normals {
                self.normals.push(part(3)?);
            }
        }
        Ok(())
    }

    fn faces(&mut self, of: &ElementDef, elements: &mut Elements<'_>) -> Result<(), ReadError> {
        let start = Place::Element("face", 0);
        let is_list = |name: &&String| matches!(name.as_str(), "vertex_indices" | "vertex_index");
        let Some(list) = of.properties.keys().find(is_list) else {
            let expected = "faces with a list vertex_indices or vertex_index";
            return Err(ReadError::at(start, expected, "others"));
        };
        for name in of.properties.keys().filter(|name| *name != list) {
            let text = format!("property {} of faces", quoted(name.as_bytes()));
            self.builder.note(NoteKind::Skipped, &text, start);
        }
        let data_type = &of.properties[list].data_type;
        if matches!(
            data_type,
            PropertyType::List(_, ScalarType::Int | ScalarType::UInt)
        ) {
            // A triangle takes at least 13 bytes.
            self.builder.reserve(of.count.min(elements.rest.len() / 13));
        }
        let (mut vertices, mut normals) = (Vec::new(), Vec::new());
        for number in 0..of.count {
            let (values, place) = elements.next("face", number, of)?;
            let indices = values.indices.as_ref().and_then(whole_numbers);
            let Some(indices) = indices else {
                let expected = "a list of whole numbers";
                return Err(ReadError::at(place, expected, "others"));
            };
            vertices.clear();
            normals.clear();
            // A face with too many vertices is skipped, so the rest of its vertices do not matter.
            for index in indices.into_iter().take(MAX_VERTICES + 1) {
                let at = usize::try_from(index).unwrap_or(usize::MAX);
                let Some(&vertex) = self.positions.get(at) else {
                    let count = self.positions.len();
                    let expected = format_args!("the index of one of the {count} vertices above");
                    return Err(ReadError::at(place, expected, index));
                };
                vertices.push(vertex);
                normals.extend(self.normals.get(at));
            }
            let normals = (!self.normals.is_empty()).then_some(normals.as_slice());
            match vertices.len() {
                0..3 => {
                    const TEXT: &str = "face of fewer than 3 vertices";
                    self.builder.skip_face(place, TEXT)?;
                }
                _ => self.builder.face(place, &vertices, normals)?,
            }
        }
        Ok(())
    }
}

/// Returns the parser's message in one short line.
fn truncated(error: &ParseError) -> String {
    const SHOWN: usize = 160;
    let text = error.to_string();
    let mut short: String = text.chars().take(SHOWN).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short.replace(char::is_control, " ")
}
