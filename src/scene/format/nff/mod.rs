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

mod read;
mod words;
mod write;

pub use read::read;
pub use write::write;

use super::complete;
use super::entry::Format;
use super::lines::Lines;
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

/// How far into a file its view is looked for, in bytes.
const LOOKED_AT: usize = 1 << 16;

/// A `v` alone is OBJ's vertex, too: what follows tells.
fn recognizes(bytes: &[u8]) -> bool {
    let progress = Progress::new();
    let mut lines = Lines::new(&bytes[..bytes.len().min(LOOKED_AT)], &progress);
    let mut last_is_v = false;
    while let Ok(Some(line)) = lines.next() {
        let before_comment = line.bytes.split(|b| *b == b'#').next();
        for word in before_comment
            .unwrap_or_default()
            .split(u8::is_ascii_whitespace)
        {
            if last_is_v && !word.is_empty() {
                return word == b"from";
            }
            last_is_v |= word == b"v";
        }
    }
    false
}
