//! Trees as files, `.bstree`: hierarchies and trees with planes of this and of other programs.
//!
//! # The format, version 1
//!
//! The first line is a JSON object, the header. Bytes of any value pad it to the next multiple of 64 bytes;
//! there the data begin. Numbers of the data are little-endian.
//!
//! | header | |
//! |---|---|
//! | `format` | `"bstree"` |
//! | `version` | 1 |
//! | `kind` | `"bvh"`: every node has a box; `"kd"`: every inner node has a plane |
//! | `structure` | optional, of kind `kd`: `"bintree"` (the default), `"octree"` or `"grid"` |
//! | `width` | of kind `bvh`: the most children of an inner node, 2 to 8; the default is 2 |
//! | `objects` | number of objects of the scene |
//! | `order` | what references count: `"file-face"`, the faces of the file from 0 in their order (the default), or `"object"`, the objects of bspscope. A scene in which faces were skipped or split has another number of objects, and the file is refused |
//! | `sha256` | optional: SHA-256 of the file of the scene in hexadecimal digits |
//! | `split` | of kind `bvh`: `true` if a leaf may hold a part of an object, so that its box need not contain the whole object; the default is `false` |
//! | `root` | the root cell: `center` and `half` (half its size), three numbers each in the scene's units of length, and optionally `margin`, the length by which it extends beyond the objects. Required for kind `kd` |
//! | `stops` | names of the reasons for leaves, which `stop` refers to by index |
//! | `arrays` | a list of `[name, type, shape, offset]`; the offset is in bytes from the beginning of the data |
//!
//! | array | type and shape | |
//! |---|---|---|
//! | `leaf` | `u8` \[n\] | 1 for a leaf, 0 for an inner node. Node 0 is the root; nodes are in any order |
//! | `first`, `count` | `u32` \[n\] | of a leaf: its references; of an inner node of kind `bvh`: its children |
//! | `ref` | `u32` | references to objects |
//! | `stop` | `u8` \[n\], optional | why a cell is a leaf: an index of `stops` |
//! | `box` | `f32` or `f64` \[n, 6\] | kind `bvh`: lower and upper corner in the scene's units of length |
//! | `child` | `u32` | kind `bvh`: the children of inner nodes |
//! | `axis` | `u8` \[n\] | kind `kd`: 0, 1 or 2 for x, y or z; ignored for leaves |
//! | `plane` | `f32` \[n\] | kind `kd`: where the plane is, from −1 to 1 across the root cell |
//! | `below`, `above` | `u32` \[n\] | kind `kd`: the two children |
//!
//! Unknown arrays and header fields are ignored.
//!
//! # What is made of it
//!
//! Boxes are computed anew from the bounds of the objects, wider than rounding, so that the box of another
//! program cannot lose hits. With `split` that is impossible. Boxes in `f32` are then widened by their
//! rounding; boxes in `f64` are used as they are. The box of an inner node is always that around its children.
//!
//! What is wrong with a tree is counted and reported with the first place of each kind ([`Faults`]). A file whose
//! nodes form no tree (a cycle, an index out of range) is refused. A bad tree (an object in no leaf) can be
//! measured, and `bspscope verify` shows which rays miss.

mod boxes;
mod columns;
mod data;
mod error;
mod faults;
mod graph;
mod header;
mod hierarchy;
mod method;
mod planes;
mod read;
mod write;

pub use error::TreeFileError;
pub use faults::{Fault, FaultKind, Faults};
pub use hierarchy::{Hierarchy, Holds};
pub(super) use method::of_file;
pub use method::{EXTENSION, is_of_another_scene, is_tree_file, short_name};
pub use read::{FileTree, load, read};
pub use write::{Origin, write};
