//! Generated scenes. A generator is one file here and one line in [`BUILTINS`].

mod balls;
mod fluid;
mod m_fluid;
mod percent_g;
mod rings;
mod room;
mod teaching;
mod tetra;

use super::{Note, NoteKind, SceneParts};
use crate::geometry::Vec3;

/// A scene generator.
pub struct Builtin {
    /// Name on the command line and in lists.
    pub name: &'static str,
    /// One sentence: what it shows.
    pub about: &'static str,
    /// The size that the paper used; 1 where there is no other.
    pub default_size: u32,
    /// The sizes allowed.
    pub sizes: std::ops::RangeInclusive<u32>,
    /// Makes the scene of this size.
    pub generate: fn(u32) -> SceneParts,
}

/// All generators.
pub static BUILTINS: &[Builtin] = &[
    balls::BUILTIN,
    rings::BUILTIN,
    tetra::BUILTIN,
    fluid::BUILTIN,
    m_fluid::BUILTIN,
    room::BUILTIN,
    teaching::BUILTIN,
];

/// Linear background colour of the Standard Procedural Databases.
const SPD_BACKGROUND: Vec3 = Vec3::new(0.078, 0.361, 0.753);

/// What a scene says that stands in for one that was never published.
fn reconstruction_note(name: &str) -> Note {
    let text = format!(
        "A reconstruction: the scene '{name}' of the paper was never published. This one was made \
         anew to meet its figures in Table 4 and the directions in Table 6."
    );
    Note::new(NoteKind::Remark, text)
}

/// Why a generator gave no scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuiltinError {
    #[error("no generator is called '{0}'")]
    Unknown(String),
    #[error("{name} takes sizes {lowest} to {highest}, found {found}")]
    Size {
        name: &'static str,
        lowest: u32,
        highest: u32,
        found: u32,
    },
}

/// The generator of this name.
pub fn find(name: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|b| b.name == name)
}

/// Generates a scene; without a size, the paper's.
///
/// # Errors
/// An unknown name or a size out of range.
pub fn generate(name: &str, size: Option<u32>) -> Result<SceneParts, BuiltinError> {
    let builtin = find(name).ok_or_else(|| BuiltinError::Unknown(name.to_owned()))?;
    let size = size.unwrap_or(builtin.default_size);
    if !builtin.sizes.contains(&size) {
        return Err(BuiltinError::Size {
            name: builtin.name,
            lowest: *builtin.sizes.start(),
            highest: *builtin.sizes.end(),
            found: size,
        });
    }
    Ok((builtin.generate)(size))
}
