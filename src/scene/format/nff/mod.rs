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

use super::Format;

pub(super) const FORMAT: Format = Format {
    name: "nff",
    extensions: &["nff"],
    read,
    write,
};
