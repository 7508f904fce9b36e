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
//!
//! A backslash at the end of a line continues the statement, unless the line ends with a comment or
//! the next line begins with a statement of its own: names such as `D:\\lab\\` end in a backslash,
//! too. A material may be defined after its use, by a `mtllib` anywhere in the file.
//!
//! A coordinate that is not a finite number is an error only if a face uses the vertex. Normals
//! that cannot be read, and indices of normals that do not exist, are replaced by the face normal. A
//! polygon with a normal that cannot be read is split into triangles.

mod mtl;

use super::builder::{MAX_VERTICES, SceneBuilder};
use super::entry::Format;
use super::error::ReadError;
use super::input::{Input, SiblingError};
use super::lines::{Line, Lines, Words, comment_start, quoted, refuse_wide_text, whole};
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
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

/// Keywords that begin a statement.
const KEYWORDS: [&[u8]; 12] = [
    b"v", b"vn", b"vt", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"usemtl", b"mtllib",
];

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
    refuse_wide_text(input.bytes)?;
    let mut reader = Reader {
        input,
        progress,
        builder: SceneBuilder::default(),
        positions: Vec::new(),
        infinite: HashMap::new(),
        normals: Vec::new(),
        materials: HashMap::new(),
        uses: Vec::new(),
        use_of: HashMap::new(),
        has_material: false,
        first_unknown: None,
        is_obj: false,
        face: Face::default(),
    };
    let mut lines = Lines::new(input.bytes, progress);
    let mut joined = Vec::new();
    let mut next = lines.next()?;
    while let Some(line) = next {
        next = lines.next()?;
        if !is_continued(line.bytes, next) {
            reader.statement(line)?;
            continue;
        }
        joined.clear();
        let mut part = line.bytes;
        while is_continued(part, next) {
            joined.extend_from_slice(without_backslash(part));
            joined.push(b' ');
            part = next.map_or(&[], |line| line.bytes);
            next = lines.next()?;
        }
        joined.extend_from_slice(part);
        let (number, bytes) = (line.number, joined.as_slice());
        reader.statement(Line { number, bytes })?;
    }
    reader.finish()
}

/// Returns whether the statement of a line continues on the next one.
fn is_continued(line: &[u8], next: Option<Line<'_>>) -> bool {
    // The last byte decides for almost every line.
    let ends_in_backslash = match line.last() {
        Some(b'\\') => true,
        Some(b' ' | b'\t') => line.trim_ascii_end().ends_with(b"\\"),
        _ => false,
    };
    if !ends_in_backslash {
        return false;
    }
    let mut words = Line {
        number: 0,
        bytes: line,
    }
    .words();
    let first_of_next = next.and_then(|line| line.words().next());
    let is_statement =
        first_of_next.is_some_and(|word| word.starts_with(b"#") || KEYWORDS.contains(&word));
    !is_statement && next.is_some() && !words.any(|word| word.starts_with(b"#"))
}

/// Returns a line without the backslash at its end, if there is one.
fn without_backslash(line: &[u8]) -> &[u8] {
    let trimmed = line.trim_ascii_end();
    trimmed.strip_suffix(b"\\").unwrap_or(line)
}

/// Returns the part of a line before its comment.
fn without_comment(line: &[u8]) -> &[u8] {
    &line[..comment_start(line).unwrap_or(line.len())]
}

struct Reader<'a> {
    input: &'a Input<'a>,
    progress: &'a Progress,
    builder: SceneBuilder,
    positions: Vec<Vec3>,
    /// The lines of vertices that are not finite, by their index.
    infinite: HashMap<usize, usize>,
    normals: Vec<Vec3>,
    /// The materials of the material files, by name.
    materials: HashMap<Vec<u8>, Material>,
    /// The distinct materials that `usemtl` names.
    uses: Vec<Use>,
    /// The index in `uses` of each name.
    use_of: HashMap<Vec<u8>, usize>,
    /// Whether a material was selected, or its absence noted.
    has_material: bool,
    /// The line of the first unknown statement, and its keyword.
    first_unknown: Option<(Place, String)>,
    /// Whether there was a known statement.
    is_obj: bool,
    face: Face,
}

/// A material that is used; its definition may follow.
struct Use {
    name: Vec<u8>,
    first: Place,
    count: usize,
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
        let numbers = || {
            let mut words = Line {
                bytes: without_backslash(without_comment(line.bytes)),
                ..line
            }
            .words();
            words.next();
            words
        };
        match keyword {
            b"v" => self.vertex(numbers(), line)?,
            b"vn" => self.normals.push(numbers().direction()),
            b"f" => self.face(numbers(), line)?,
            b"usemtl" => self.use_material(words.rest_bytes(), line),
            b"mtllib" => self.material_files(words.rest_bytes(), line)?,
            b"l" => self.skipped("line (not a surface)", line),
            b"p" => self.skipped("point (not a surface)", line),
            b"o" | b"g" | b"s" | b"vt" => {}
            comment if comment.starts_with(b"#") => return Ok(()),
            unknown => {
                let text = format!("unknown statement {}", quoted(unknown));
                self.skipped(&text, line);
                let first = || (line.place(), quoted(unknown));
                self.first_unknown.get_or_insert_with(first);
                return Ok(());
            }
        }
        self.is_obj = true;
        Ok(())
    }

    fn skipped(&mut self, what: &str, line: Line<'_>) {
        self.builder.note(NoteKind::Skipped, what, line.place());
    }

    fn vertex(&mut self, mut words: Words<'_>, line: Line<'_>) -> Result<(), ReadError> {
        let vertex = words.point("the vertex")?;
        if !vertex.is_finite() {
            self.infinite.insert(self.positions.len(), line.number);
        }
        self.positions.push(vertex);
        if words.nth(2).is_some() {
            self.skipped("vertex colors", line);
        }
        Ok(())
    }

    fn face(&mut self, words: Words<'_>, line: Line<'_>) -> Result<(), ReadError> {
        let Face { vertices, normals } = &mut self.face;
        vertices.clear();
        normals.clear();
        let mut has_bad_normal = false;
        for corner in words {
            // A face with too many vertices is skipped, so the rest of its vertices do not matter.
            if vertices.len() > MAX_VERTICES {
                break;
            }
            let mut indices = corner.split(|b| *b == b'/');
            let index = indices.next().unwrap_or_default();
            let known = self.positions.len();
            let Some(index) = resolve_index(known, index) else {
                let expected = format_args!(
                    "a vertex index from 1 to {known} (those defined so far) or from -{known} to -1"
                );
                return Err(words.error(expected, Some(corner)));
            };
            if !self.infinite.is_empty()
                && let Some(defined) = self.infinite.get(&index)
            {
                let expected = "vertices with finite coordinates";
                let found = format!("vertex {} of line {defined}", index + 1);
                return Err(ReadError::at(line.place(), expected, found));
            }
            vertices.push(self.positions[index]);
            if let Some(normal) = indices.nth(1).filter(|text| !text.is_empty()) {
                let index = resolve_index(self.normals.len(), normal);
                has_bad_normal |= index.is_none();
                normals.push(index.map_or(Vec3::ZERO, |index| self.normals[index]));
            }
        }
        if !self.has_material {
            self.has_material = true;
            const TEXT: &str = "no material before this face; using matte white";
            self.builder.note(NoteKind::Defaulted, TEXT, line.place());
        }
        if vertices.len() < 3 {
            const TEXT: &str = "face of fewer than 3 vertices";
            return self.builder.skip_face(line.place(), TEXT);
        }
        // Normals are used only if every vertex refers to one.
        let normals = (normals.len() == vertices.len()).then_some(normals.as_slice());
        if has_bad_normal {
            const TEXT: &str = "index of a normal that is not defined; using the face normal";
            self.builder.note(NoteKind::Changed, TEXT, line.place());
            return self.builder.face_as_noted(line.place(), vertices, normals);
        }
        self.builder
            .face_or_triangles(line.place(), vertices, normals)
    }

    fn use_material(&mut self, name: &[u8], line: Line<'_>) {
        self.has_material = true;
        let number = match self.use_of.get(name) {
            Some(&number) => number,
            None => {
                self.uses.push(Use {
                    name: name.to_owned(),
                    first: line.place(),
                    count: 0,
                });
                let number = self.uses.len() - 1;
                self.use_of.insert(name.to_owned(), number);
                number
            }
        };
        self.uses[number].count += 1;
        self.builder.set_named_material(number);
    }

    /// Reads the material files that a line names: one whose name may contain spaces, or else
    /// several.
    fn material_files(&mut self, rest: &[u8], line: Line<'_>) -> Result<(), ReadError> {
        let plain = without_final_comment(rest);
        for name in [rest, plain, unquoted(plain)] {
            if self.material_file(name)?.is_ok() {
                return Ok(());
            }
        }
        for name in file_names(plain) {
            if let Err(reason) = self.material_file(name)? {
                let text = format!("material file {}: {reason}", quoted(name));
                self.skipped(&text, line);
            }
        }
        Ok(())
    }

    /// Reads a material file, if it can be opened.
    fn material_file(&mut self, name: &[u8]) -> Result<Result<(), SiblingError>, Cancelled> {
        let name = String::from_utf8_lossy(name);
        let bytes = match self.input.read_sibling(&name, self.progress) {
            Ok(bytes) => bytes,
            Err(SiblingError::Cancelled(cancelled)) => return Err(cancelled),
            Err(reason) => return Ok(Err(reason)),
        };
        let before = self.materials.len();
        // Material files do not advance the progress.
        let progress = self.progress.part(0.0, 0.0);
        let mut note = |kind, text: &str, place: Place| {
            self.builder.note(kind, &format!("{name}: {text}"), place);
        };
        mtl::read(&bytes, &progress, &mut self.materials, &mut note)?;
        let count = self.materials.len() - before;
        let text = format!("{name}: {count} materials");
        self.builder.notes.push(Note::new(NoteKind::Read, text));
        Ok(Ok(()))
    }

    fn finish(mut self) -> Result<SceneParts, ReadError> {
        if let Some((place, found)) = self.first_unknown
            && !self.is_obj
        {
            let expected = "a statement of OBJ, such as 'v', 'f' or 'usemtl'";
            return Err(ReadError::at(place, expected, found));
        }
        let mut materials = Vec::new();
        for used in &self.uses {
            let plain = without_final_comment(&used.name);
            let names = [used.name.as_slice(), plain, unquoted(plain)];
            let found = names.into_iter().find_map(|name| self.materials.get(name));
            if found.is_none() {
                let name = quoted(&used.name);
                let text = format!("material {name} is not defined; using matte white");
                let builder = &mut self.builder;
                builder.note_times(NoteKind::Defaulted, &text, used.count, used.first);
            }
            materials.push(found.copied().unwrap_or_default());
        }
        self.builder.define(&materials);
        if self.builder.faces() == 0 {
            self.builder.note_points(self.positions.len());
        }
        Ok(self.builder.finish_mesh(Vec3::Y))
    }
}

/// Returns the index in a list of a length: in the file, indices count from 1, or backward from −1,
/// which is the last.
fn resolve_index(length: usize, text: &[u8]) -> Option<usize> {
    let index = whole(text)?;
    let place = match index {
        1.. => usize::try_from(index).ok()? - 1,
        _ => {
            let back = usize::try_from(index.unsigned_abs()).ok()?;
            length.checked_sub(back)?
        }
    };
    (place < length).then_some(place)
}

/// Returns a name without the comment that follows it: a `#` after white space.
fn without_final_comment(name: &[u8]) -> &[u8] {
    let starts = |i: &usize| name[*i] == b'#' && (*i == 0 || name[*i - 1].is_ascii_whitespace());
    let end = (0..name.len()).find(starts);
    name[..end.unwrap_or(name.len())].trim_ascii_end()
}

/// Returns a name without the quotation marks around it.
fn unquoted(name: &[u8]) -> &[u8] {
    match name {
        [b'"', inner @ .., b'"'] | [b'\'', inner @ .., b'\''] => inner,
        _ => name,
    }
}

/// Returns the file names of a list, separated by white space; names in quotation marks may contain
/// some.
fn file_names(list: &[u8]) -> Vec<&[u8]> {
    let mut names = Vec::new();
    let mut rest = list.trim_ascii();
    while let Some(first) = rest.first() {
        let closing = match first {
            b'"' | b'\'' => rest[1..].iter().position(|b| b == first),
            _ => None,
        };
        let end = match closing {
            Some(length) => length + 2,
            None => rest
                .iter()
                .position(u8::is_ascii_whitespace)
                .unwrap_or(rest.len()),
        };
        names.push(unquoted(&rest[..end]));
        rest = rest[end..].trim_ascii_start();
    }
    names
}
