//! What a generator declares, and what generators share.

use crate::geometry::Vec3;
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;

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

/// Linear background color of the Standard Procedural Databases.
pub(super) const SPD_BACKGROUND: Vec3 = Vec3::new(0.078, 0.361, 0.753);

/// Returns the note of a scene that was published, on the root margin with which the paper's figures are
/// reproduced to the integer.
pub(super) fn margin_note() -> Note {
    const SOURCE: &str = "V. Havran and J. Žára, Evaluation of BSP properties for ray-tracing";
    Note::of_root_margin(0.001, SOURCE)
}

/// Returns the note of a scene that replaces one that was never published.
pub(super) fn reconstruction_note(name: &str) -> Note {
    let text = format!(
        "A reconstruction: the scene '{name}' of the paper was never published. This one was designed \
         to match its figures in Table 4 and the directions in Table 6."
    );
    Note::new(NoteKind::Remark, text)
}
