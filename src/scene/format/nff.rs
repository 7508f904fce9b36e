//! Neutral File Format (E. Haines, Standard Procedural Databases, NFF 3.1).
//!
//! A file is a stream of words; white space and line ends only separate them, and `#` starts a
//! comment that runs to the end of its line. An entity is a letter and its numbers:
//!
//! | entity | what follows |
//! |---|---|
//! | `v` | `from` x y z `at` x y z `up` x y z `angle` degrees `hither` distance `resolution` w h |
//! | `b` | background r g b |
//! | `l` | light at x y z, and r g b where the light has a colour |
//! | `f` | r g b `Kd` `Ks` `Shine` `T` and index of refraction, for the objects that follow |
//! | `c` | cylinder or cone: base x y z radius, apex x y z radius |
//! | `s` | sphere: centre x y z, radius |
//! | `p` | polygon: number of vertices, then x y z of each |
//! | `pp` | polygon: number of vertices, then x y z and the normal's x y z of each |
//!
//! Read more strictly than the format's text: a negative radius ("seen from inside only") is a
//! mistake, since surfaces here are seen from both sides. Read more leniently: what can be
//! repaired is repaired and noted (see [`read`]).

use super::{Format, ReadError};
use crate::geometry::Vec3;
use crate::primitive::{Cone, Polygon, Primitive, ShapeError, Sphere, Triangle};
use crate::progress::{Cancelled, Progress};
use crate::scene::{Camera, CameraError, Light, Material, SceneParts};
use std::collections::HashMap;
use std::fmt::{self, Display};
use std::io::{BufWriter, Write};

pub(super) const FORMAT: Format = Format {
    name: "nff",
    extensions: &["nff"],
    read,
    write,
};

/// The most pixels a side that a file may ask for.
const MAX_RESOLUTION: u32 = 65_536;

/// How many remarks of one kind name their lines; those after them are only counted.
const REMARKS_LISTED: usize = 10;

/// Words between two looks at whether the task was cancelled.
const WORDS_PER_CHECK: u32 = 4096;

/// Reads a whole NFF file. The scene's name stays empty, since the bytes carry none.
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

/// Writes NFF: view, background, lights, then the objects in order, an `f` where the material
/// changes. Numbers are the shortest that read back to the same bits, so that [`read`] gives the
/// same scene again. Two things it cannot give back: a polygon of three vertices comes back as a
/// triangle, and materials come back once each in the order of their first use.
///
/// # Errors
/// Those of `out`.
pub fn write(parts: &SceneParts, out: &mut dyn Write) -> std::io::Result<()> {
    let mut out = BufWriter::new(out);
    let title = parts.name.replace(char::is_control, " ");
    writeln!(out, "# {title}")?;
    writeln!(out, "# {} objects", parts.objects.len())?;
    let camera = &parts.camera;
    writeln!(out, "v")?;
    writeln!(out, "from {}", Point(camera.from))?;
    writeln!(out, "at {}", Point(camera.at))?;
    writeln!(out, "up {}", Point(camera.up))?;
    writeln!(out, "angle {}", Number(camera.angle))?;
    writeln!(out, "hither {}", Number(camera.hither))?;
    let [width, height] = camera.resolution;
    writeln!(out, "resolution {width} {height}")?;
    writeln!(out, "b {}", Point(parts.background))?;
    for light in &parts.lights {
        write!(out, "l {}", Point(light.position))?;
        match light.color {
            Some(color) => writeln!(out, " {}", Point(color))?,
            None => writeln!(out)?,
        }
    }
    let mut current = None;
    for (object, &material) in parts.objects.iter().zip(&parts.material_of) {
        if current != Some(material) {
            current = Some(material);
            write_material(&parts.materials[material as usize], &mut out)?;
        }
        write_object(object, &mut out)?;
    }
    out.flush()
}

fn write_material(material: &Material, out: &mut impl Write) -> std::io::Result<()> {
    write!(out, "f {}", Point(material.color))?;
    for number in [
        material.diffuse,
        material.specular,
        material.shine,
        material.transmittance,
        material.index_of_refraction,
    ] {
        write!(out, " {}", Number(number))?;
    }
    writeln!(out)
}

fn write_object(object: &Primitive, out: &mut impl Write) -> std::io::Result<()> {
    match object {
        Primitive::Sphere(s) => writeln!(out, "s {} {}", Point(s.center), Number(s.radius)),
        Primitive::Triangle(t) => {
            write_polygon(&t.vertices, t.normals.as_ref().map(|n| n.as_slice()), out)
        }
        Primitive::Polygon(p) => write_polygon(p.vertices(), p.vertex_normals(), out),
        Primitive::Cone(c) => {
            writeln!(out, "c")?;
            writeln!(out, "{} {}", Point(c.base()), Number(c.base_radius()))?;
            writeln!(out, "{} {}", Point(c.apex()), Number(c.apex_radius()))
        }
    }
}

fn write_polygon(
    vertices: &[Vec3],
    normals: Option<&[Vec3]>,
    out: &mut impl Write,
) -> std::io::Result<()> {
    match normals {
        None => {
            writeln!(out, "p {}", vertices.len())?;
            for &vertex in vertices {
                writeln!(out, "{}", Point(vertex))?;
            }
        }
        Some(normals) => {
            writeln!(out, "pp {}", vertices.len())?;
            for (&vertex, &normal) in vertices.iter().zip(normals) {
                writeln!(out, "{} {}", Point(vertex), Point(normal))?;
            }
        }
    }
    Ok(())
}

/// The shortest text that reads back to the same bits; with an exponent where `%g` has one.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-4..1e16).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// Three numbers with a space between them.
struct Point(Vec3);

impl Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(Number);
        write!(f, "{x} {y} {z}")
    }
}

/// A word of the file and the line it stands in, counted from 1.
#[derive(Clone, Copy)]
struct Word<'a> {
    bytes: &'a [u8],
    line: usize,
}

impl Word<'_> {
    fn parse<T: std::str::FromStr>(&self) -> Option<T> {
        std::str::from_utf8(self.bytes).ok()?.parse().ok()
    }

    /// Quoted for a message: never long, and free of control characters, whatever the file holds.
    fn quoted(&self) -> String {
        const SHOWN: usize = 32;
        let head = &self.bytes[..self.bytes.len().min(4 * SHOWN)];
        let text = String::from_utf8_lossy(head);
        let mut shown: String = text.chars().take(SHOWN).collect();
        if shown.len() < text.len() || head.len() < self.bytes.len() {
            shown.push('…');
        }
        format!("'{}'", shown.escape_debug())
    }

    /// The mistake that this word is not what was expected here.
    fn instead_of(&self, expected: impl Display) -> ReadError {
        syntax(self.line, expected, self.quoted())
    }
}

fn syntax(line: usize, expected: impl Display, found: impl Display) -> ReadError {
    ReadError::Syntax {
        line,
        expected: expected.to_string(),
        found: found.to_string(),
    }
}

/// The words of a file, one after the other, without comments.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    taken: u32,
    progress: &'a Progress,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8], progress: &'a Progress) -> Self {
        Words {
            bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            at: 0,
            line: 1,
            taken: 0,
            progress,
        }
    }

    /// Moves to the start of the next word or to the end. Lines end with LF, CR LF or CR.
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => {
                    let rest = &self.bytes[self.at..];
                    let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
                    self.at += end.unwrap_or(rest.len());
                    continue;
                }
                b'\n' => self.line += 1,
                b'\r' if self.bytes.get(self.at + 1) != Some(&b'\n') => self.line += 1,
                b'\r' | b' ' | b'\t' | b'\x0b' | b'\x0c' => {}
                _ => break,
            }
            self.at += 1;
        }
    }

    /// The next word; `None` at the end of the file.
    fn next(&mut self) -> Result<Option<Word<'a>>, Cancelled> {
        self.taken += 1;
        if self.taken >= WORDS_PER_CHECK {
            self.taken = 0;
            self.progress.check()?;
            self.progress.set(self.at as f64 / self.bytes.len() as f64);
        }
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let is_end = |b: &u8| matches!(b, b'\t'..=b'\r' | b' ' | b'#');
        let length = rest.iter().position(is_end).unwrap_or(rest.len());
        self.at += length;
        Ok((length > 0).then_some(Word {
            bytes: &rest[..length],
            line: self.line,
        }))
    }

    /// The next word, which must exist.
    fn expect(&mut self, expected: impl Display) -> Result<Word<'a>, ReadError> {
        let word = self.next()?;
        word.ok_or_else(|| syntax(self.last_line(), expected, "the end of the file"))
    }

    /// Whether the next word begins as a number does.
    fn number_follows(&mut self) -> bool {
        self.skip_blanks();
        let first = self.bytes.get(self.at);
        first.is_some_and(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.'))
    }

    /// The next number and its word.
    fn number_word(&mut self, what: impl Display) -> Result<(f64, Word<'a>), ReadError> {
        let word = self.expect(&what)?;
        match word.parse::<f64>() {
            Some(number) if number.is_finite() => Ok((number, word)),
            _ => Err(word.instead_of(format_args!("{what} (a finite number)"))),
        }
    }

    fn number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        self.number_word(what).map(|(number, _)| number)
    }

    fn triple(&mut self, names: [&str; 3], of: impl Display) -> Result<Vec3, ReadError> {
        let mut numbers = [0.0; 3];
        for (number, name) in numbers.iter_mut().zip(names) {
            *number = self.number(format_args!("{name} of {of}"))?;
        }
        Ok(Vec3::from_array(numbers))
    }

    fn point(&mut self, of: impl Display) -> Result<Vec3, ReadError> {
        self.triple(["x", "y", "z"], of)
    }

    fn color(&mut self, of: impl Display) -> Result<Vec3, ReadError> {
        self.triple(["red", "green", "blue"], of)
    }

    /// A radius, 0 or more.
    fn radius(&mut self, what: &str) -> Result<f64, ReadError> {
        let (radius, word) = self.number_word(what)?;
        if radius < 0.0 {
            return Err(word.instead_of(format_args!("{what}, 0 or more")));
        }
        Ok(radius)
    }

    /// The line of the last character; 1 for an empty file. Only at the end of the file.
    fn last_line(&self) -> usize {
        match self.bytes.last() {
            Some(b'\n' | b'\r') => self.line - 1,
            _ => self.line,
        }
    }
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

    #[test]
    fn numbers_are_written_short_and_read_back_to_the_same_bits() {
        let cases = [
            0.1,
            -0.0,
            1.0,
            123456.0,
            1e-5,
            5e-324,
            f64::MAX,
            1.0 / 3.0,
            -2.5e-17,
        ];
        for number in cases {
            let text = Number(number).to_string();
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), number.to_bits());
            assert!(text.len() <= 24, "{text}");
        }
        assert_eq!(Number(0.930995).to_string(), "0.930995");
        assert_eq!(Number(1.22461e-16).to_string(), "1.22461e-16");
    }

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
