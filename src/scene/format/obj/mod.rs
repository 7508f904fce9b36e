//! Wavefront OBJ with MTL (Wavefront Technologies, Advanced Visualizer Manual, Appendix B).
//!
//! | statement | meaning |
//! |---|---|
//! | `v` x y z | a vertex; a weight or color after it is ignored |
//! | `vn` x y z | a vertex normal |
//! | `f` v, v/t, v//n or v/t/n … | a face; indices count from 1, or backward from −1 |
//! | `mtllib` file … | material files in the same folder, see `mtl` |
//! | `usemtl` name | the material of the faces that follow |
//! | `o`, `g`, `s`, `vt` | ignored: groups, smoothing and texture coordinates do not affect hits |
//!
//! Lines, points, curves and unknown statements are skipped and counted.

mod mtl;

use super::builder::{MAX_VERTICES, SceneBuilder};
use super::entry::Format;
use super::error::ReadError;
use super::input::{Input, SiblingError};
use super::lines::{Line, Lines, Words, parse, quoted};
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::material::Material;
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;
use std::collections::HashMap;

pub(super) const FORMAT: Format = Format {
    name: "obj",
    about: "Wavefront OBJ with its materials (MTL)",
    extensions: &["obj"],
    recognizes,
    read,
    write: None,
};

/// Bytes at the start of a file in which the first vertex is looked for.
const SNIFFED_BYTES: usize = 1 << 16;

/// Returns whether the file has a vertex before anything that is not valid in OBJ.
fn recognizes(bytes: &[u8]) -> bool {
    let progress = Progress::new();
    let mut lines = Lines::new(&bytes[..bytes.len().min(SNIFFED_BYTES)], &progress);
    while let Ok(Some(line)) = lines.next_with_words() {
        let mut words = line.words();
        match words.next() {
            Some(b"v") => return words.point("vertex").is_ok(),
            Some(b"o" | b"g" | b"s" | b"vn" | b"vt" | b"mtllib" | b"usemtl") => {}
            Some(word) if word.starts_with(b"#") => {}
            _ => return false,
        }
    }
    false
}

fn read(input: &Input<'_>, progress: &Progress) -> Result<SceneParts, ReadError> {
    let mut reader = Reader {
        input,
        progress,
        builder: SceneBuilder::default(),
        positions: Vec::new(),
        normals: Vec::new(),
        materials: HashMap::new(),
        has_material: false,
        face: Face::default(),
    };
    let mut lines = Lines::new(input.bytes, progress);
    let mut joined = Vec::new();
    while let Some(line) = lines.next()? {
        if !line.bytes.ends_with(b"\\") {
            reader.statement(line)?;
            continue;
        }
        // A backslash at the end of a line continues the statement on the next line.
        joined.clear();
        let mut part = line;
        while let Some(beginning) = part.bytes.strip_suffix(b"\\") {
            joined.extend_from_slice(beginning);
            joined.push(b' ');
            let Some(next) = lines.next()? else { break };
            part = next;
            if !part.bytes.ends_with(b"\\") {
                joined.extend_from_slice(part.bytes);
            }
        }
        let (number, bytes) = (line.number, joined.as_slice());
        reader.statement(Line { number, bytes })?;
    }
    Ok(reader.builder.finish_mesh(Vec3::Y))
}

struct Reader<'a> {
    input: &'a Input<'a>,
    progress: &'a Progress,
    builder: SceneBuilder,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    materials: HashMap<String, Material>,
    /// Whether a material was selected, or its absence noted.
    has_material: bool,
    face: Face,
}

/// Vertices and normals of the current face; kept to reuse their memory.
#[derive(Default)]
struct Face {
    vertices: Vec<Vec3>,
    normals: Vec<Vec3>,
}

impl Reader<'_> {
    fn statement(&mut self, line: Line<'_>) -> Result<(), ReadError> {
        let mut words = line.words();
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        match keyword {
            b"v" => {
                self.positions.push(words.point("the vertex")?);
                if words.nth(2).is_some() {
                    self.skipped("vertex colors", line);
                }
            }
            b"vn" => self.normals.push(words.point("the normal")?),
            b"f" => self.face(words, line)?,
            b"usemtl" => self.use_material(&words.rest(), line),
            b"mtllib" => self.material_files(words, line)?,
            b"l" => self.skipped("line (not a surface)", line),
            b"p" => self.skipped("point (not a surface)", line),
            b"o" | b"g" | b"s" | b"vt" => {}
            comment if comment.starts_with(b"#") => {}
            unknown => {
                let text = format!("unknown statement {}", quoted(unknown));
                self.skipped(&text, line);
            }
        }
        Ok(())
    }

    fn skipped(&mut self, what: &str, line: Line<'_>) {
        self.builder.note(NoteKind::Skipped, what, line.place());
    }

    fn face(&mut self, words: Words<'_>, line: Line<'_>) -> Result<(), ReadError> {
        let Face { vertices, normals } = &mut self.face;
        vertices.clear();
        normals.clear();
        for corner in words {
            // A face with too many vertices is skipped, so the rest of its vertices do not matter.
            if corner.starts_with(b"#") || vertices.len() > MAX_VERTICES {
                break;
            }
            let mut indices = corner.split(|b| *b == b'/');
            let resolve = |what: &str, known: &[Vec3], text: &[u8]| {
                resolve_index(known, text).ok_or_else(|| {
                    let count = known.len();
                    let expected = format_args!(
                        "a {what} index from 1 to {count} (those defined so far) or from -{count} to -1"
                    );
                    words.error(expected, Some(corner))
                })
            };
            let vertex = indices.next().unwrap_or_default();
            vertices.push(resolve("vertex", &self.positions, vertex)?);
            if let Some(normal) = indices.nth(1).filter(|text| !text.is_empty()) {
                normals.push(resolve("normal", &self.normals, normal)?);
            }
        }
        if !self.has_material {
            self.has_material = true;
            const TEXT: &str = "no material before this face; using matte white";
            self.builder.note(NoteKind::Defaulted, TEXT, line.place());
        }
        match vertices.len() {
            0..3 => {
                const TEXT: &str = "face of fewer than 3 vertices";
                self.builder.skip_face(line.place(), TEXT)
            }
            // Normals are used only if every vertex has one.
            count => {
                let normals = (normals.len() == count).then_some(normals.as_slice());
                self.builder.face(line.place(), vertices, normals)
            }
        }
    }

    fn use_material(&mut self, name: &str, line: Line<'_>) {
        self.has_material = true;
        let material = self.materials.get(name).copied();
        if material.is_none() {
            let name = quoted(name.as_bytes());
            let text = format!("material {name} is not defined; using matte white");
            self.builder.note(NoteKind::Defaulted, &text, line.place());
        }
        self.builder.set_material(material.unwrap_or_default());
    }

    /// Reads the material files named by a line: one whose name may contain spaces, or else
    /// several.
    fn material_files(&mut self, words: Words<'_>, line: Line<'_>) -> Result<(), ReadError> {
        let whole = words.rest();
        match self.input.read_sibling(&whole, self.progress) {
            Ok(bytes) => return self.materials_of(&whole, &bytes),
            Err(SiblingError::Cancelled(cancelled)) => return Err(cancelled.into()),
            Err(_) => {}
        }
        for word in words {
            let name = String::from_utf8_lossy(word);
            match self.input.read_sibling(&name, self.progress) {
                Ok(bytes) => self.materials_of(&name, &bytes)?,
                Err(SiblingError::Cancelled(cancelled)) => return Err(cancelled.into()),
                Err(reason) => {
                    let text = format!("material file {}: {reason}", quoted(word));
                    self.skipped(&text, line);
                }
            }
        }
        Ok(())
    }

    fn materials_of(&mut self, name: &str, bytes: &[u8]) -> Result<(), ReadError> {
        let before = self.materials.len();
        // Material files do not advance the progress.
        let progress = self.progress.part(0.0, 0.0);
        let mut note = |kind, text: &str, place: Place| {
            self.builder.note(kind, &format!("{name}: {text}"), place);
        };
        mtl::read(bytes, &progress, &mut self.materials, &mut note).map_err(
            |reason| match reason {
                ReadError::Cancelled(_) => reason,
                _ => ReadError::InSibling {
                    name: name.to_owned(),
                    reason: Box::new(reason),
                },
            },
        )?;
        let count = self.materials.len() - before;
        let text = format!("{name}: {count} materials");
        self.builder.notes.push(Note::new(NoteKind::Read, text));
        Ok(())
    }
}

/// Returns the element with an index: counted from 1, or backward from −1, which is the last.
fn resolve_index(known: &[Vec3], text: &[u8]) -> Option<Vec3> {
    let index: i64 = parse(text)?;
    let place = match index {
        1.. => usize::try_from(index).ok()? - 1,
        _ => {
            let back = usize::try_from(index.unsigned_abs()).ok()?;
            known.len().checked_sub(back)?
        }
    };
    known.get(place).copied()
}
