//! Neutral File Format (E. Haines, Standard Procedural Databases, NFF 3.1).
//!
//! A file is a stream of words, separated by white space and line breaks. `#` starts a comment that
//! extends to the end of its line; `/* */` encloses one, too, as in the examples of many courses.
//! An entity is a keyword followed by its numbers:
//!
//! | entity | what follows |
//! |---|---|
//! | `v` | `from` x y z `at` x y z `up` x y z `angle` degrees `hither` distance `resolution` w h |
//! | `b` | background r g b |
//! | `l` | light at x y z, and r g b if the light has a color |
//! | `f` | r g b `Kd` `Ks` `Shine` `T` and index of refraction, for the objects that follow |
//! | `c` | cylinder or cone: base x y z radius, apex x y z radius |
//! | `s` | sphere: center x y z, radius |
//! | `p` | polygon: number of vertices, then x y z of each |
//! | `pp` | polygon: number of vertices, then x y z and the normal's x y z of each |
//!
//! A negative radius means that only the inside of the object is visible. Surfaces are visible from
//! both sides here, so that it is read as the positive radius, with a note. What can be repaired is
//! repaired and noted (see [`read`]).
//!
//! Two formats that are easily mistaken for this one are refused by name: the Neutral File Format
//! of Sense8's WorldToolKit, and AFF, the Animated File Format of BART (J. Lext, U. Assarsson and
//! T. Möller, 2000), which extends NFF by animations.

mod read;
mod words;
mod write;

pub use read::read;
pub use write::write;

use words::Words;

use super::complete;
use super::entry::Format;
use crate::progress::Progress;

pub(super) const FORMAT: Format = Format {
    name: "nff",
    about: "Neutral File Format of the Standard Procedural Databases",
    extensions: &["nff"],
    recognizes,
    read: |input, progress| {
        let mut parts = read(input.bytes, progress)?;
        complete::lights(&mut parts);
        Ok(parts)
    },
    write: Some(write),
};

/// Bytes at the start of a file in which the view is looked for.
const SNIFFED_BYTES: usize = 1 << 16;

/// Returns whether the file has a view. `v` is also a vertex in OBJ, so the next word decides.
fn recognizes(bytes: &[u8]) -> bool {
    let progress = Progress::new();
    let mut words = Words::new(&bytes[..bytes.len().min(SNIFFED_BYTES)], &progress);
    let mut last_is_v = false;
    while let Ok(Some(word)) = words.next() {
        if last_is_v {
            return word.bytes == b"from";
        }
        last_is_v = word.bytes == b"v";
    }
    false
}
