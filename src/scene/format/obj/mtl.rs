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
//! Textures and the rest are skipped and counted, as are statements that cannot be read: a damaged
//! material file never refuses the geometry.

use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::{Line, Lines, Words, comment_start, quoted, wide_text};
use crate::scene::format::place::Place;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use std::collections::HashMap;

/// One material of a file.
#[derive(Default)]
struct Found {
    name: Vec<u8>,
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    shine: f64,
    opacity: Option<f64>,
    index_of_refraction: Option<f64>,
    illumination: Option<f64>,
}

/// Bytes at the start of a file in which it is checked that it is text.
const SNIFFED_BYTES: usize = 1 << 12;

/// Returns what a file is if it cannot be a material file.
fn another_kind(bytes: &[u8]) -> Option<String> {
    let head = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    if let Some(encoding) = wide_text(head) {
        return Some(format!("text in {encoding}"));
    }
    if head.contains(&0) {
        return Some("not text".to_owned());
    }
    let is_page = text.trim_ascii_start().starts_with(b"<");
    is_page.then(|| "a page in HTML or XML".to_owned())
}

/// Adds the materials of a file by name; the first material of a name wins. Calls `note` for
/// everything that is skipped or changed.
///
/// # Errors
/// Cancellation.
pub(super) fn read(
    bytes: &[u8],
    progress: &Progress,
    materials: &mut HashMap<Vec<u8>, Material>,
    note: &mut dyn FnMut(NoteKind, &str, Place),
) -> Result<(), Cancelled> {
    if let Some(what) = another_kind(bytes) {
        let text = format!("{what}, not a material file");
        note(NoteKind::Skipped, &text, Place::Line(1));
        return Ok(());
    }
    let mut current: Option<(Found, Place)> = None;
    let mut lines = Lines::new(bytes, progress);
    while let Some(line) = lines.next()? {
        let mut words = line.words();
        match (words.next(), &mut current) {
            (None, _) => {}
            (Some(comment), _) if comment.starts_with(b"#") => {}
            (Some(b"newmtl"), _) => {
                let found = Found {
                    name: words.rest_bytes().to_owned(),
                    ..Found::default()
                };
                if let Some((before, place)) = current.replace((found, line.place())) {
                    before.finish(place, materials, note);
                }
            }
            (Some(keyword), Some((found, _))) => {
                let end = comment_start(line.bytes);
                let bytes = &line.bytes[..end.unwrap_or(line.bytes.len())];
                let mut words = Line { bytes, ..line }.words();
                words.next();
                match found.statement(keyword, words, line, note) {
                    Ok(()) => {}
                    Err(ReadError::Cancelled(cancelled)) => return Err(cancelled),
                    Err(ReadError::Syntax {
                        expected, found, ..
                    }) => {
                        let keyword = quoted(keyword);
                        let text = format!("{keyword}: expected {expected}, found {found}");
                        note(NoteKind::Skipped, &text, line.place());
                    }
                }
            }
            (Some(keyword), None) => {
                let text = format!("statement {} before the first 'newmtl'", quoted(keyword));
                note(NoteKind::Skipped, &text, line.place());
            }
        }
    }
    match current {
        Some((last, place)) => last.finish(place, materials, note),
        None => note(
            NoteKind::Skipped,
            "a file without materials",
            Place::Line(1),
        ),
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
        materials: &mut HashMap<Vec<u8>, Material>,
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
