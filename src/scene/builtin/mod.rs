//! Generated scenes. A generator is one file here and one line in [`BUILTINS`].

mod balls;
mod entry;
mod fluid;
mod lattice;
mod m_fluid;
mod percent_g;
mod rings;
mod room;
mod teaching;
mod terrain;
mod tetra;

pub use entry::Builtin;

use crate::scene::parts::SceneParts;

/// All generators.
pub static BUILTINS: &[Builtin] = &[
    balls::BUILTIN,
    rings::BUILTIN,
    tetra::BUILTIN,
    fluid::BUILTIN,
    m_fluid::BUILTIN,
    room::BUILTIN,
    lattice::BUILTIN,
    terrain::BUILTIN,
    teaching::BUILTIN,
];

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
