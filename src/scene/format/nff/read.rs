//! The NFF reader: one function per entity.

use super::words::{Word, Words, syntax};
use super::write::Point;
use crate::geometry::Vec3;
use crate::primitive::{Cone, Primitive, Sphere};
use crate::progress::Progress;
use crate::scene::camera::{Camera, CameraError};
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::{Lines, number, refuse_wide_text};
use crate::scene::format::place::Place;
use crate::scene::material::{Light, Material};
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;

/// Maximum width and height in pixels.
const MAX_RESOLUTION: u32 = 65_536;

/// Reads a whole NFF file. The scene's name is left empty because the file does not contain one.
///
/// Comments that begin with `# Note: ` become remarks in the load report.
///
/// A polygon with three vertices becomes a triangle. Equal materials are merged, and unused
/// materials are dropped. These are repaired, with a note for each:
/// - no `b`: the background is black; no `f` before an object: [`Material::default`];
/// - more than one `v` or `b`: the last one is used;
/// - a polygon with zero area, a cylinder or cone with zero length: skipped;
/// - a non-planar polygon: split into triangles, where each vertex keeps its normal;
/// - a vertex normal that is zero or not finite: replaced by the normal of the polygon;
/// - a number of a material or color that is not finite: replaced by the default;
/// - a negative radius, by which only the inside is visible: both sides are visible here.
///
/// Memory use is at most a constant times the size of the file, whatever counts it declares.
///
/// # Errors
/// The first error, with its line; a missing `v` is reported at the last line. Cancellation.
pub fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    refuse_wide_text(bytes)?;
    refuse_sense8(bytes, progress)?;
    let mut reader = Reader::new(Words::new(bytes, progress));
    while let Some(word) = reader.words.next()? {
        reader.entity(word)?;
    }
    if let Some(line) = reader.words.open_comment {
        return Err(syntax(
            line,
            "'*/' at the end of the comment",
            "the end of the file",
        ));
    }
    let parts = reader.finish()?;
    progress.set(1.0);
    Ok(parts)
}

/// Refuses the Neutral File Format of Sense8's WorldToolKit, whose first word is `nff`, perhaps
/// after lines of comments that begin with `//`.
fn refuse_sense8(bytes: &[u8], progress: &Progress) -> Result<(), ReadError> {
    let mut lines = Lines::new(bytes, progress);
    while let Some(line) = lines.next_with_words()? {
        match line.words().next().unwrap_or_default() {
            comment if comment.starts_with(b"//") || comment.starts_with(b"#") => {}
            word if word.eq_ignore_ascii_case(b"nff") => {
                let expected = "the Neutral File Format of E. Haines";
                let found = "that of Sense8's WorldToolKit, another format of the same name";
                return Err(ReadError::at(line.place(), expected, found));
            }
            _ => return Ok(()),
        }
    }
    Ok(())
}

/// Entities of AFF, the Animated File Format of BART, that NFF does not have.
const AFF_ENTITIES: [&[u8]; 23] = [
    b"a",
    b"am",
    b"animparams",
    b"d",
    b"detail_level",
    b"e",
    b"em",
    b"fm",
    b"g",
    b"i",
    b"include",
    b"k",
    b"keyframe",
    b"la",
    b"m",
    b"mesh",
    b"t",
    b"tp",
    b"tpp",
    b"tt",
    b"x",
    b"xs",
    b"}",
];

/// The state of the reader.
struct Reader<'a> {
    words: Words<'a>,
    builder: SceneBuilder,
    /// Whether there was a material.
    has_fill: bool,
    /// Keyword and line of the previous entity.
    last_entity: Option<(&'static str, usize)>,
    /// Vertices and normals (none for `p`) of the current polygon; kept to reuse their memory.
    vertices: Vec<Vec3>,
    normals: Vec<Vec3>,
}

impl<'a> Reader<'a> {
    fn new(words: Words<'a>) -> Self {
        Reader {
            words,
            builder: SceneBuilder::default(),
            has_fill: false,
            last_entity: None,
            vertices: Vec::new(),
            normals: Vec::new(),
        }
    }

    /// Reads the entity that begins with `word`.
    fn entity(&mut self, word: Word) -> Result<(), ReadError> {
        let line = word.line;
        type Read<'a> = fn(&mut Reader<'a>, usize) -> Result<(), ReadError>;
        let (letter, read): (_, Read<'_>) = match word.bytes {
            b"s" => ("s", Self::sphere),
            b"p" => ("p", |reader, line| reader.polygon(line, false)),
            b"pp" => ("pp", |reader, line| reader.polygon(line, true)),
            b"f" => ("f", Self::read_fill),
            b"c" => ("c", Self::cone),
            b"l" => ("l", Self::light),
            b"b" => ("b", Self::background),
            b"v" => ("v", Self::view),
            _ => return Err(self.no_entity(&word)),
        };
        read(self, line)?;
        self.last_entity = Some((letter, line));
        Ok(())
    }

    /// Creates the error that a word does not begin an entity. For a surplus number, the message
    /// names the entity before it.
    fn no_entity(&self, word: &Word) -> ReadError {
        const ENTITIES: &str = "v, b, l, f, c, s, p or pp";
        match self.last_entity {
            Some((letter, line)) if number(word.bytes).is_some() => syntax(
                word.line,
                format_args!("an entity ({ENTITIES}) after the complete '{letter}' of line {line}"),
                format_args!("the number {}", word.quoted()),
            ),
            _ if AFF_ENTITIES.contains(&word.bytes) => syntax(
                word.line,
                format_args!("an entity of NFF ({ENTITIES})"),
                format_args!(
                    "{} of AFF, the Animated File Format of BART, which is another format",
                    word.quoted()
                ),
            ),
            _ => word.unexpected(format_args!("an entity ({ENTITIES})")),
        }
    }

    fn view(&mut self, line: usize) -> Result<(), ReadError> {
        self.keyword("from")?;
        let from = self.words.point("the view's 'from'")?;
        let at_line = self.keyword("at")?;
        let at = self.words.point("the view's 'at'")?;
        let up_line = self.keyword("up")?;
        let up = self.words.point("the view's 'up'")?;
        self.keyword("angle")?;
        let (angle, angle_word) = self.words.number_word("the view's angle")?;
        self.keyword("hither")?;
        let near = self.words.number("the view's hither distance")?;
        self.keyword("resolution")?;
        let resolution = [self.pixels("width")?, self.pixels("height")?];
        let camera = Camera {
            from,
            at,
            up,
            angle,
            near,
            resolution,
        };
        camera.frame().map_err(|reason| match reason {
            CameraError::Angle(_) => {
                angle_word.unexpected("the view's angle, above 0 and below 180 degrees")
            }
            CameraError::NoDirection | CameraError::NotFinite => syntax(
                at_line,
                "a point 'at' other than 'from'",
                format_args!("at {}", Point(at)),
            ),
            CameraError::NoUp => syntax(
                up_line,
                "a direction 'up' that is neither zero nor along the line of sight",
                format_args!("up {}", Point(up)),
            ),
        })?;
        if self.builder.camera.replace(camera).is_some() {
            self.replaced("view", line);
        }
        Ok(())
    }

    /// Reads a keyword of the view and returns its line.
    fn keyword(&mut self, keyword: &str) -> Result<usize, ReadError> {
        let expected = format_args!("'{keyword}' of the view");
        let word = self.words.expect(expected)?;
        if word.bytes == keyword.as_bytes() {
            Ok(word.line)
        } else {
            Err(word.unexpected(expected))
        }
    }

    fn pixels(&mut self, side: &str) -> Result<u32, ReadError> {
        let expected =
            format_args!("the {side} in pixels, a whole number from 1 to {MAX_RESOLUTION}");
        let word = self.words.expect(expected)?;
        word.parse()
            .filter(|pixels| (1..=MAX_RESOLUTION).contains(pixels))
            .ok_or_else(|| word.unexpected(expected))
    }

    fn background(&mut self, line: usize) -> Result<(), ReadError> {
        let mut color = self.words.color("the background")?;
        if !color.is_finite() {
            let text = "background color that is not finite; using black";
            self.builder
                .note(NoteKind::Changed, text, Place::Line(line));
            color = Vec3::ZERO;
        }
        if self.builder.background.replace(color).is_some() {
            self.replaced("background", line);
        }
        Ok(())
    }

    fn replaced(&mut self, what: &str, line: usize) {
        let text = format!("{what} overridden by a later one");
        self.builder
            .note(NoteKind::Skipped, &text, Place::Line(line));
    }

    fn light(&mut self, line: usize) -> Result<(), ReadError> {
        let position = self.words.point("the light")?;
        let mut color = if self.words.number_follows() {
            Some(self.words.color("the light's color")?)
        } else {
            None
        };
        if color.is_some_and(|color| !color.is_finite()) {
            let text = "color of a light that is not finite; using the default";
            self.builder
                .note(NoteKind::Changed, text, Place::Line(line));
            color = None;
        }
        self.builder.lights.push(Light { position, color });
        Ok(())
    }

    fn read_fill(&mut self, line: usize) -> Result<(), ReadError> {
        let names = [
            "red",
            "green",
            "blue",
            "Kd",
            "Ks",
            "Shine",
            "T",
            "index of refraction",
        ];
        let default = Material::default();
        let Vec3 { x, y, z } = default.color;
        let mut numbers = [
            x,
            y,
            z,
            default.diffuse,
            default.specular,
            default.shine,
            default.transmittance,
            default.index_of_refraction,
        ];
        for (number, name) in numbers.iter_mut().zip(names) {
            let given = self
                .words
                .any_number(format_args!("{name} of the material"))?;
            if given.is_finite() {
                *number = given;
            } else {
                let text = format!("{name} of a material that is not finite; using {number}");
                let place = Place::Line(line);
                self.builder.note(NoteKind::Changed, &text, place);
            }
        }
        let [
            r,
            g,
            b,
            diffuse,
            specular,
            shine,
            transmittance,
            index_of_refraction,
        ] = numbers;
        self.builder.set_material(Material {
            color: Vec3::new(r, g, b),
            diffuse,
            specular,
            shine,
            transmittance,
            index_of_refraction,
        });
        self.has_fill = true;
        Ok(())
    }

    /// Notes a negative radius: only the inside of the object is visible then.
    fn note_negative(&mut self, line: usize) {
        const TEXT: &str = "negative radius (visible from the inside); using both sides";
        self.builder
            .note(NoteKind::Changed, TEXT, Place::Line(line));
    }

    fn sphere(&mut self, line: usize) -> Result<(), ReadError> {
        let center = self.words.point("the sphere's center")?;
        let radius = self.words.number("the sphere's radius")?;
        if radius < 0.0 {
            self.note_negative(line);
        }
        let sphere = Sphere::new(center, radius.abs()).map(Primitive::Sphere);
        self.begin_object(line);
        self.builder.object(Place::Line(line), "a sphere", sphere)
    }

    fn cone(&mut self, line: usize) -> Result<(), ReadError> {
        let base = self.words.point("the cone's base")?;
        let base_radius = self.words.number("the cone's radius at its base")?;
        let apex = self.words.point("the cone's apex")?;
        let (apex_radius, word) = self.words.number_word("the cone's radius at its apex")?;
        if base_radius < 0.0 || apex_radius < 0.0 {
            if base_radius > 0.0 || apex_radius > 0.0 {
                return Err(word.unexpected(
                    "the cone's radius at its apex, of the same sign as that at its base",
                ));
            }
            self.note_negative(line);
        }
        let [base_radius, apex_radius] = [base_radius.abs(), apex_radius.abs()];
        let cone = Cone::new(base, base_radius, apex, apex_radius).map(Primitive::Cone);
        self.begin_object(line);
        let place = Place::Line(line);
        self.builder.object(place, "a cylinder or cone", cone)
    }

    fn polygon(&mut self, line: usize, with_normals: bool) -> Result<(), ReadError> {
        let expected = "the number of the polygon's vertices, 3 or more";
        let word = self.words.expect(expected)?;
        let count = word
            .parse::<usize>()
            .filter(|&count| count >= 3)
            .ok_or_else(|| word.unexpected(expected))?;
        self.vertices.clear();
        self.normals.clear();
        // No memory is reserved for the declared count: the lists grow as vertices are read.
        for number in 1..=count {
            let vertex = self
                .words
                .point(format_args!("vertex {number} of {count}"))?;
            self.vertices.push(vertex);
            if with_normals {
                let of = format_args!("the normal at vertex {number} of {count}");
                let normal = self.words.direction(of)?;
                self.normals.push(normal);
            }
        }
        self.begin_object(line);
        let normals = with_normals.then_some(self.normals.as_slice());
        self.builder
            .face(Place::Line(line), &self.vertices, normals)
    }

    /// Notes that the first object has no material.
    fn begin_object(&mut self, line: usize) {
        if !self.has_fill {
            self.has_fill = true;
            const TEXT: &str = "no material before this object; using matte white";
            let place = Place::Line(line);
            self.builder.note(NoteKind::Defaulted, TEXT, place);
        }
    }

    fn finish(mut self) -> Result<SceneParts, ReadError> {
        let camera = self.builder.camera.ok_or_else(|| {
            syntax(
                self.words.last_line(),
                "a view ('v') somewhere in the file",
                "the end of the file",
            )
        })?;
        let remarks = std::mem::take(&mut self.words.notes).into_iter();
        self.builder.notes = remarks
            .map(|text| Note::new(NoteKind::Remark, text))
            .collect();
        if self.builder.background.is_none() {
            const TEXT: &str = "no background color in the file; using black";
            self.builder
                .notes
                .push(Note::new(NoteKind::Defaulted, TEXT));
        }
        Ok(self.builder.finish(camera))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Cancelled;

    #[test]
    fn reading_stops_when_cancelled() {
        let progress = Progress::new();
        progress.cancel();
        let spheres = "s 0 0 0 1\n".repeat(2000);
        assert_eq!(
            read(spheres.as_bytes(), &progress),
            Err(ReadError::Cancelled(Cancelled))
        );
    }
}
