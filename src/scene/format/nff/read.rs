//! From words to a scene: one function an entity.

use super::words::{Word, Words, syntax};
use super::write::Point;
use crate::geometry::Vec3;
use crate::primitive::{Cone, Polygon, Primitive, ShapeError, Sphere, Triangle};
use crate::progress::Progress;
use crate::scene::format::ReadError;
use crate::scene::{Camera, CameraError, Light, Material, SceneParts};
use std::collections::HashMap;

/// The most pixels a side that a file may ask for.
const MAX_RESOLUTION: u32 = 65_536;

/// How many remarks of one kind name their lines; those after them are only counted.
const REMARKS_LISTED: usize = 10;

/// Reads a whole NFF file. The scene's name stays empty, since the bytes carry none.
///
/// Comments that begin with `# Note: ` are the scene's notes.
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

/// What was repaired while reading, in the words of a note.
#[derive(Clone, Copy)]
enum Remark {
    NoArea,
    NoLength,
    NotPlanar,
    NormalWithoutLength,
}

impl Remark {
    const ALL: [Remark; 4] = [
        Remark::NoArea,
        Remark::NoLength,
        Remark::NotPlanar,
        Remark::NormalWithoutLength,
    ];

    const fn text(self) -> &'static str {
        match self {
            Remark::NoArea => "polygon without area skipped",
            Remark::NoLength => "cylinder or cone without length skipped",
            Remark::NotPlanar => "polygon off a common plane split into triangles",
            Remark::NormalWithoutLength => "vertex normal without length, the polygon's own taken",
        }
    }
}

/// What has been read so far.
struct Reader<'a> {
    words: Words<'a>,
    camera: Option<Camera>,
    background: Option<Vec3>,
    lights: Vec<Light>,
    objects: Vec<Primitive>,
    material_of: Vec<u32>,
    materials: Vec<Material>,
    /// Where each material stands in `materials`, by the bits of its numbers.
    places: HashMap<[u64; 8], u32>,
    /// The numbers of the last `f`; `None` before the first.
    fill: Option<[f64; 8]>,
    /// The place of `fill` in `materials`, once an object has it.
    place: Option<u32>,
    notes: Vec<String>,
    remarks: [usize; Remark::ALL.len()],
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
            camera: None,
            background: None,
            lights: Vec::new(),
            objects: Vec::new(),
            material_of: Vec::new(),
            materials: Vec::new(),
            places: HashMap::new(),
            fill: None,
            place: None,
            notes: Vec::new(),
            remarks: [0; Remark::ALL.len()],
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
        if self.camera.replace(camera).is_some() {
            self.notes
                .push(format!("line {line}: this view replaces the one before"));
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
        if self.background.replace(color).is_some() {
            self.notes.push(format!(
                "line {line}: this background replaces the one before"
            ));
        }
        Ok(())
    }

    fn light(&mut self) -> Result<(), ReadError> {
        let position = self.words.point("the light")?;
        let color = if self.words.number_follows() {
            Some(self.words.color("the light's colour")?)
        } else {
            None
        };
        self.lights.push(Light { position, color });
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
        self.fill = Some(numbers);
        self.place = None;
        Ok(())
    }

    fn sphere(&mut self, line: usize) -> Result<(), ReadError> {
        let center = self.words.point("the sphere's centre")?;
        let radius = self.words.radius("the sphere's radius")?;
        self.add(
            line,
            "a sphere",
            Sphere::new(center, radius).map(Primitive::Sphere),
        )
    }

    fn cone(&mut self, line: usize) -> Result<(), ReadError> {
        let base = self.words.point("the cone's base")?;
        let base_radius = self.words.radius("the cone's radius at its base")?;
        let apex = self.words.point("the cone's apex")?;
        let apex_radius = self.words.radius("the cone's radius at its apex")?;
        let cone = Cone::new(base, base_radius, apex, apex_radius);
        self.add(line, "a cylinder or cone", cone.map(Primitive::Cone))
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
        let mut without_length = false;
        // The count is not trusted with memory: the lists grow as vertices are really found.
        for number in 1..=count {
            let vertex = self
                .words
                .point(format_args!("vertex {number} of {count}"))?;
            self.vertices.push(vertex);
            if with_normals {
                let of = format_args!("the normal at vertex {number} of {count}");
                let normal = self.words.point(of)?;
                without_length |= normal == Vec3::ZERO;
                self.normals.push(normal);
            }
        }
        if without_length {
            self.remark(line, Remark::NormalWithoutLength);
        }
        if let &[a, b, c] = self.vertices.as_slice() {
            let triangle = self.triangle([0, 1, 2], [a, b, c]);
            return self.add(line, "a triangle", triangle);
        }
        let normals = with_normals.then(|| self.normals.clone());
        match Polygon::new(self.vertices.clone(), normals) {
            Err(ShapeError::NotPlanar(_)) => self.split_polygon(line),
            polygon => self.add(line, "a polygon", polygon.map(Primitive::Polygon)),
        }
    }

    /// A triangle of the polygon being read, by the numbers of its vertices.
    fn triangle(&self, numbers: [u32; 3], vertices: [Vec3; 3]) -> Result<Primitive, ShapeError> {
        let smooth = !self.normals.is_empty();
        let normals = smooth.then(|| numbers.map(|i| self.normals[i as usize]));
        Triangle::new(vertices, normals).map(Primitive::Triangle)
    }

    /// Adds the polygon being read as triangles; those without area are left out silently.
    fn split_polygon(&mut self, line: usize) -> Result<(), ReadError> {
        let before = self.objects.len();
        for numbers in Polygon::triangulate(&self.vertices) {
            let vertices = numbers.map(|i| self.vertices[i as usize]);
            match self.triangle(numbers, vertices) {
                Err(ShapeError::ZeroArea) => {}
                triangle => self.add(line, "a triangle", triangle)?,
            }
        }
        let remark = if self.objects.len() > before {
            Remark::NotPlanar
        } else {
            Remark::NoArea
        };
        self.remark(line, remark);
        Ok(())
    }

    /// Adds an object of the current material, or skips it where it has no extent.
    fn add(
        &mut self,
        line: usize,
        what: &str,
        object: Result<Primitive, ShapeError>,
    ) -> Result<(), ReadError> {
        match object {
            Ok(object) => {
                let place = self.material(line);
                self.objects.push(object);
                self.material_of.push(place);
            }
            Err(ShapeError::ZeroArea) => self.remark(line, Remark::NoArea),
            Err(ShapeError::NoLength) => self.remark(line, Remark::NoLength),
            Err(reason) => {
                return Err(syntax(
                    line,
                    format_args!("numbers that make {what}"),
                    reason,
                ));
            }
        }
        Ok(())
    }

    /// The place of the current material, which is entered when its first object is met.
    fn material(&mut self, line: usize) -> u32 {
        if let Some(place) = self.place {
            return place;
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
        ] = self.fill.unwrap_or_else(|| {
            self.notes.push(format!(
                "line {line}: no material before this object, white matt taken"
            ));
            let m = Material::default();
            let [r, g, b] = m.color.to_array();
            let index = m.index_of_refraction;
            [
                r,
                g,
                b,
                m.diffuse,
                m.specular,
                m.shine,
                m.transmittance,
                index,
            ]
        });
        let numbers = [
            r,
            g,
            b,
            diffuse,
            specular,
            shine,
            transmittance,
            index_of_refraction,
        ];
        let materials = &mut self.materials;
        let place = *self
            .places
            .entry(numbers.map(f64::to_bits))
            .or_insert_with(|| {
                materials.push(Material {
                    color: Vec3::new(r, g, b),
                    diffuse,
                    specular,
                    shine,
                    transmittance,
                    index_of_refraction,
                });
                (materials.len() - 1) as u32
            });
        self.place = Some(place);
        place
    }

    fn remark(&mut self, line: usize, remark: Remark) {
        let count = &mut self.remarks[remark as usize];
        *count += 1;
        if *count <= REMARKS_LISTED {
            self.notes.push(format!("line {line}: {}", remark.text()));
        }
    }

    fn finish(mut self) -> Result<SceneParts, ReadError> {
        let camera = self.camera.ok_or_else(|| {
            syntax(
                self.words.last_line(),
                "a view ('v') somewhere in the file",
                "the end of the file",
            )
        })?;
        self.notes
            .splice(0..0, std::mem::take(&mut self.words.notes));
        for remark in Remark::ALL {
            let count = self.remarks[remark as usize];
            if count > REMARKS_LISTED {
                let more = count - REMARKS_LISTED;
                self.notes
                    .push(format!("{more} more times: {}", remark.text()));
            }
        }
        if self.background.is_none() {
            self.notes.push("no background, black taken".into());
        }
        if self.objects.is_empty() {
            self.notes.push("no objects".into());
        }
        Ok(SceneParts {
            name: String::new(),
            objects: self.objects,
            material_of: self.material_of,
            materials: self.materials,
            lights: self.lights,
            background: self.background.unwrap_or(Vec3::ZERO),
            camera,
            notes: self.notes,
        })
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
