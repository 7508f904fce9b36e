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
    /// A short description.
    pub about: &'static str,
    /// The size that the paper used; 1 if there is only one.
    pub default_size: u32,
    /// The allowed sizes.
    pub sizes: std::ops::RangeInclusive<u32>,
    /// Generates the scene of a size.
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

/// Linear background color of the Standard Procedural Databases.
const SPD_BACKGROUND: Vec3 = Vec3::new(0.078, 0.361, 0.753);

/// Returns the note of a scene that replaces one that was never published.
fn reconstruction_note(name: &str) -> Note {
    let text = format!(
        "A reconstruction: the scene '{name}' of the paper was never published. This one was designed \
         to match its figures in Table 4 and the directions in Table 6."
    );
    Note::new(NoteKind::Remark, text)
}

/// Why a scene could not be generated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuiltinError {
    #[error("there is no generator '{0}'")]
    Unknown(String),
    #[error("the size of {name} must be from {lowest} to {highest}, found {found}")]
    Size {
        name: &'static str,
        lowest: u32,
        highest: u32,
        found: u32,
    },
}

/// Returns the generator with this name.
pub fn find(name: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|b| b.name == name)
}

/// Generates a scene; the default size is that of the paper.
///
/// # Errors
/// The name is unknown or the size out of range.
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
