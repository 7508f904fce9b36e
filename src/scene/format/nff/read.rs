//! From words to a scene: one function an entity.

use super::words::{Word, Words, syntax};
use super::write::Point;
use crate::geometry::Vec3;
use crate::primitive::{Cone, Primitive, Sphere};
use crate::progress::Progress;
use crate::scene::camera::{Camera, CameraError};
use crate::scene::format::error::ReadError;
use crate::scene::format::gather::Gatherer;
use crate::scene::format::place::Place;
use crate::scene::material::{Light, Material};
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;

/// The most pixels a side that a file may ask for.
const MAX_RESOLUTION: u32 = 65_536;

/// Reads a whole NFF file. The scene's name stays empty, since the bytes carry none.
///
/// Comments that begin with `# Note: ` are remarks among the scene's notes.
///
/// Three vertices make a triangle, more a polygon. Equal materials become one, and a material that
/// no object has is left out. Repaired, with a note for each:
/// - no `b`: black; no `f` before an object: [`Material::default`]; no object at all: none;
/// - a second `v` or `b`: the last counts;
/// - a polygon without area, a cylinder or cone without length: skipped;
/// - vertices off a common plane: split into triangles, each vertex keeping its normal;
/// - a vertex normal without length: the polygon's own normal takes its place.
///
/// Memory stays within a constant times the file's size,
/// whatever counts the file claims.
///
/// # Errors
/// The first mistake, with its line; a file without `v` at its last line. Cancellation.
pub fn read(bytes: &[u8], progress: &Progress) -> Result<SceneParts, ReadError> {
    let mut reader = Reader::new(Words::new(bytes, progress));
    while let Some(word) = reader.words.next()? {
        reader.entity(word)?;
    }
    let parts = reader.finish()?;
    progress.set(1.0);
    Ok(parts)
}

/// What has been read so far.
struct Reader<'a> {
    words: Words<'a>,
    found: Gatherer,
    /// Whether there was a material.
    has_fill: bool,
    /// Letter and line of the entity read last.
    last_entity: Option<(&'static str, usize)>,
    /// Vertices and normals (none for `p`) of the polygon being read, kept to be filled again.
    vertices: Vec<Vec3>,
    normals: Vec<Vec3>,
}

impl<'a> Reader<'a> {
    fn new(words: Words<'a>) -> Self {
        Reader {
            words,
            found: Gatherer::default(),
            has_fill: false,
            last_entity: None,
            vertices: Vec::new(),
            normals: Vec::new(),
        }
    }

    /// Reads the entity that `word` begins.
    fn entity(&mut self, word: Word) -> Result<(), ReadError> {
        let line = word.line;
        let letter = match word.bytes {
            b"s" => {
                self.sphere(line)?;
                "s"
            }
            b"p" => {
                self.polygon(line, false)?;
                "p"
            }
            b"pp" => {
                self.polygon(line, true)?;
                "pp"
            }
            b"f" => {
                self.read_fill()?;
                "f"
            }
            b"c" => {
                self.cone(line)?;
                "c"
            }
            b"l" => {
                self.light()?;
                "l"
            }
            b"b" => {
                self.background(line)?;
                "b"
            }
            b"v" => {
                self.view(line)?;
                "v"
            }
            _ => return Err(self.no_entity(&word)),
        };
        self.last_entity = Some((letter, line));
        Ok(())
    }

    /// The mistake of a word where an entity should begin; for a surplus number says of which.
    fn no_entity(&self, word: &Word) -> ReadError {
        const ENTITIES: &str = "v, b, l, f, c, s, p or pp";
        match self.last_entity {
            Some((letter, line)) if word.parse::<f64>().is_some() => syntax(
                word.line,
                format_args!("an entity ({ENTITIES}) after the complete '{letter}' of line {line}"),
                format_args!("the number {}", word.quoted()),
            ),
            _ => word.instead_of(format_args!("an entity ({ENTITIES})")),
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
        let hither = self.words.number("the view's hither distance")?;
        self.keyword("resolution")?;
        let resolution = [self.pixels("width")?, self.pixels("height")?];
        let camera = Camera {
            from,
            at,
            up,
            angle,
            hither,
            resolution,
        };
        camera.frame().map_err(|reason| match reason {
            CameraError::Angle(_) => {
                angle_word.instead_of("the view's angle, above 0 and below 180 degrees")
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
        if self.found.camera.replace(camera).is_some() {
            self.replaced("view", line);
        }
        Ok(())
    }

    /// Takes a word that the view must have here; gives its line.
    fn keyword(&mut self, keyword: &str) -> Result<usize, ReadError> {
        let expected = format_args!("'{keyword}' of the view");
        let word = self.words.expect(expected)?;
        if word.bytes == keyword.as_bytes() {
            Ok(word.line)
        } else {
            Err(word.instead_of(expected))
        }
    }

    fn pixels(&mut self, side: &str) -> Result<u32, ReadError> {
        let expected =
            format_args!("the {side} in pixels, a whole number from 1 to {MAX_RESOLUTION}");
        let word = self.words.expect(expected)?;
        word.parse()
            .filter(|pixels| (1..=MAX_RESOLUTION).contains(pixels))
            .ok_or_else(|| word.instead_of(expected))
    }

    fn background(&mut self, line: usize) -> Result<(), ReadError> {
        let color = self.words.color("the background")?;
        if self.found.background.replace(color).is_some() {
            self.replaced("background", line);
        }
        Ok(())
    }

    fn replaced(&mut self, what: &str, line: usize) {
        let text = format!("{what} replaced by a later one");
        self.found.note(NoteKind::Skipped, &text, Place::Line(line));
    }

    fn light(&mut self) -> Result<(), ReadError> {
        let position = self.words.point("the light")?;
        let color = if self.words.number_follows() {
            Some(self.words.color("the light's colour")?)
        } else {
            None
        };
        self.found.lights.push(Light { position, color });
        Ok(())
    }

    fn read_fill(&mut self) -> Result<(), ReadError> {
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
        let mut numbers = [0.0; 8];
        for (number, name) in numbers.iter_mut().zip(names) {
            *number = self.words.number(format_args!("{name} of the material"))?;
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
        self.found.set_material(Material {
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

    fn sphere(&mut self, line: usize) -> Result<(), ReadError> {
        let center = self.words.point("the sphere's centre")?;
        let radius = self.words.radius("the sphere's radius")?;
        let sphere = Sphere::new(center, radius).map(Primitive::Sphere);
        self.begin_object(line);
        self.found.object(Place::Line(line), "a sphere", sphere)
    }

    fn cone(&mut self, line: usize) -> Result<(), ReadError> {
        let base = self.words.point("the cone's base")?;
        let base_radius = self.words.radius("the cone's radius at its base")?;
        let apex = self.words.point("the cone's apex")?;
        let apex_radius = self.words.radius("the cone's radius at its apex")?;
        let cone = Cone::new(base, base_radius, apex, apex_radius).map(Primitive::Cone);
        self.begin_object(line);
        let place = Place::Line(line);
        self.found.object(place, "a cylinder or cone", cone)
    }

    fn polygon(&mut self, line: usize, with_normals: bool) -> Result<(), ReadError> {
        let expected = "the number of the polygon's vertices, 3 or more";
        let word = self.words.expect(expected)?;
        let count = word
            .parse::<usize>()
            .filter(|&count| count >= 3)
            .ok_or_else(|| word.instead_of(expected))?;
        self.vertices.clear();
        self.normals.clear();
        // The count is not trusted with memory: the lists grow as vertices are really found.
        for number in 1..=count {
            let vertex = self
                .words
                .point(format_args!("vertex {number} of {count}"))?;
            self.vertices.push(vertex);
            if with_normals {
                let of = format_args!("the normal at vertex {number} of {count}");
                let normal = self.words.point(of)?;
                self.normals.push(normal);
            }
        }
        self.begin_object(line);
        let normals = with_normals.then_some(self.normals.as_slice());
        self.found.face(Place::Line(line), &self.vertices, normals)
    }

    /// Notes where the first object has no material.
    fn begin_object(&mut self, line: usize) {
        if !self.has_fill {
            self.has_fill = true;
            const TEXT: &str = "no material before this object, white matt taken";
            self.found.note(NoteKind::MadeUp, TEXT, Place::Line(line));
        }
    }

    fn finish(mut self) -> Result<SceneParts, ReadError> {
        let camera = self.found.camera.ok_or_else(|| {
            syntax(
                self.words.last_line(),
                "a view ('v') somewhere in the file",
                "the end of the file",
            )
        })?;
        let remarks = std::mem::take(&mut self.words.notes).into_iter();
        self.found.notes = remarks
            .map(|text| Note::new(NoteKind::Remark, text))
            .collect();
        if self.found.background.is_none() {
            const TEXT: &str = "no background, black taken";
            self.found.notes.push(Note::new(NoteKind::MadeUp, TEXT));
        }
        Ok(self.found.finish(camera))
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
