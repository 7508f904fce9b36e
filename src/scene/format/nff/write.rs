//! The NFF writer.

use crate::geometry::Vec3;
use crate::primitive::Primitive;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;
use std::fmt::{self, Display};
use std::io::{BufWriter, Write};

/// The start of a comment that contains a note.
pub(super) const NOTE: &str = "# Note: ";

/// Writes a scene as NFF: notes as comments (except those on what was read), view, background,
/// lights, then the objects in order, with an `f` where the material changes.
///
/// Numbers are written in the shortest form that reads back to the same bits, so [`super::read`]
/// returns the same scene, with two exceptions: a polygon with three vertices is read back as a
/// triangle, and materials are read back once each, in the order of their first use.
///
/// # Errors
/// I/O errors of `out`.
pub fn write(parts: &SceneParts, out: &mut dyn Write) -> std::io::Result<()> {
    let mut out = BufWriter::new(out);
    let title = parts.name.replace(char::is_control, " ");
    writeln!(out, "# {title}")?;
    writeln!(out, "# {} objects", parts.objects.len())?;
    for note in &parts.notes {
        let text = match note.kind {
            // These describe the original file.
            NoteKind::Read => continue,
            NoteKind::Remark => note.text.clone(),
            _ => note.to_string(),
        };
        writeln!(out, "{NOTE}{}", text.replace(char::is_control, " "))?;
    }
    let camera = &parts.camera;
    writeln!(out, "v")?;
    writeln!(out, "from {}", Point(camera.from))?;
    writeln!(out, "at {}", Point(camera.at))?;
    writeln!(out, "up {}", Point(camera.up))?;
    writeln!(out, "angle {}", Number(camera.angle))?;
    writeln!(out, "hither {}", Number(camera.near))?;
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

/// Writes the shortest text that reads back to the same bits, with an exponent where `%g` uses one.
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

/// Writes three numbers, separated by spaces.
pub(super) struct Point(pub Vec3);

impl Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(Number);
        write!(f, "{x} {y} {z}")
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
}
