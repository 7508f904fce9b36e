//! Materials of OBJ files (Wavefront MTL).
//!
//! | statement | meaning |
//! |---|---|
//! | `Kd` r g b | color |
//! | `Ks` r g b | `Ks`: the mean of the three, if the surface is a mirror |
//! | `Ns` exponent | `Shine` |
//! | `d` or 1 − `Tr` | opacity; the rest is `T` |
//! | `Ni` | index of refraction |
//! | `illum` 0, 1, 2 | not a mirror: `Ks` is ignored, because here `Ks` also reflects rays |
//!
//! Textures and the rest are skipped and counted.

use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::{Line, Lines, Words, quoted};
use crate::scene::format::place::Place;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use std::collections::HashMap;

/// One material of a file.
#[derive(Default)]
struct Found {
    name: String,
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    shine: f64,
    opacity: Option<f64>,
    index_of_refraction: Option<f64>,
    illumination: Option<f64>,
}

/// Adds the materials of a file by name; the first material of a name wins. Calls `note` for
/// everything that is skipped or changed.
///
/// # Errors
/// The first error, with its line; cancellation.
pub(super) fn read(
    bytes: &[u8],
    progress: &Progress,
    materials: &mut HashMap<String, Material>,
    note: &mut dyn FnMut(NoteKind, &str, Place),
) -> Result<(), ReadError> {
    let mut current: Option<(Found, Place)> = None;
    let mut lines = Lines::new(bytes, progress);
    while let Some(line) = lines.next()? {
        let mut words = line.words();
        match (words.next(), &mut current) {
            (None, _) => {}
            (Some(comment), _) if comment.starts_with(b"#") => {}
            (Some(b"newmtl"), _) => {
                let found = Found {
                    name: words.rest(),
                    ..Found::default()
                };
                if let Some((before, place)) = current.replace((found, line.place())) {
                    before.finish(place, materials, note);
                }
            }
            (Some(keyword), Some((found, _))) => found.statement(keyword, words, line, note)?,
            (Some(keyword), None) => {
                return Err(words.error("'newmtl' as the first statement", Some(keyword)));
            }
        }
    }
    if let Some((last, place)) = current {
        last.finish(place, materials, note);
    }
    Ok(())
}

impl Found {
    fn statement(
        &mut self,
        keyword: &[u8],
        mut words: Words<'_>,
        line: Line<'_>,
        note: &mut dyn FnMut(NoteKind, &str, Place),
    ) -> Result<(), ReadError> {
        match keyword {
            b"Kd" | b"Ks" => {
                let is_file = |word: &[u8]| matches!(word, b"spectral" | b"xyz");
                if words.clone().next().is_some_and(is_file) {
                    note(NoteKind::Skipped, "color given as a spectrum", line.place());
                    return Ok(());
                }
                let red = words.expect_number("red")?;
                // A single number is a gray value.
                let green = words.number("green")?.unwrap_or(red);
                let blue = words.number("blue")?.unwrap_or(red);
                let color = Some(Vec3::new(red, green, blue));
                match keyword {
                    b"Kd" => self.diffuse = color,
                    _ => self.specular = color,
                }
            }
            b"Ns" => self.shine = words.expect_number("the exponent")?.max(0.0),
            b"Ni" => {
                let index = words.expect_number("the index of refraction")?;
                self.index_of_refraction = Some(index);
            }
            b"d" if words.clone().next() == Some(b"-halo") => {
                note(
                    NoteKind::Skipped,
                    "view-dependent opacity (d -halo)",
                    line.place(),
                );
            }
            b"d" => self.opacity = Some(words.expect_number("the opacity")?),
            // `d` takes precedence over `Tr`.
            b"Tr" => {
                let transparency = words.expect_number("the transparency")?;
                self.opacity.get_or_insert(1.0 - transparency);
            }
            b"illum" => self.illumination = Some(words.expect_number("the illumination model")?),
            // Ambient light and transmission filters are not part of the shading.
            b"Ka" | b"Tf" => {}
            unknown => {
                let text = format!("statement {}", quoted(unknown));
                note(NoteKind::Skipped, &text, line.place());
            }
        }
        Ok(())
    }

    fn finish(
        self,
        place: Place,
        materials: &mut HashMap<String, Material>,
        note: &mut dyn FnMut(NoteKind, &str, Place),
    ) {
        let specular = self
            .specular
            .map_or(0.0, |c| c.element_sum() / 3.0)
            .max(0.0);
        let mirrors = self.illumination.is_none_or(|model| model >= 3.0);
        if specular > 0.0 && !mirrors && self.illumination == Some(2.0) {
            const TEXT: &str = "Ks of a material that is not a mirror (illum 2)";
            note(NoteKind::Skipped, TEXT, place);
        }
        let index = self.index_of_refraction.unwrap_or(1.0);
        if index <= 0.0 {
            const TEXT: &str = "index of refraction is not above 0; using 1";
            note(NoteKind::Changed, TEXT, place);
        }
        let opacity = self.opacity.unwrap_or(1.0).clamp(0.0, 1.0);
        let material = Material {
            color: self.diffuse.unwrap_or(Vec3::ONE),
            diffuse: opacity,
            specular: if mirrors { specular } else { 0.0 },
            shine: self.shine,
            transmittance: 1.0 - opacity,
            index_of_refraction: if index > 0.0 { index } else { 1.0 },
        };
        materials.entry(self.name).or_insert(material);
    }
}
