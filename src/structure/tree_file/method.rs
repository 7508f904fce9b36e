//! A file as a build method: its tree is read instead of built.

use super::header::{Header, Kind, MAX_HEADER};
use crate::files;
use crate::structure::method::{Constant, Structure};
use crate::structure::settings::{Builder, Method, MethodInfo};
use std::ffi::OsStr;
use std::io::Read;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Extension of tree files.
pub const EXTENSION: &str = "bstree";

/// Returns whether a text is the path of a tree file, by its extension.
pub fn is_tree_file(text: &str) -> bool {
    let extension = Path::new(text).extension();
    extension.is_some_and(|e| e.eq_ignore_ascii_case(EXTENSION))
}

/// Returns the name of a method in little space: that of a tree file without its folders.
pub fn short_name(method: &str) -> &str {
    let file = Path::new(method).file_name().and_then(OsStr::to_str);
    file.filter(|_| is_tree_file(method)).unwrap_or(method)
}

/// Returns the method that reads a file. Of a file that cannot be read, the method exists, too; building its
/// tree fails.
///
/// Methods live as long as the process, like those of the registries. So the descriptions of all files that
/// were opened are kept, a few hundred bytes each.
pub fn of_file(path: &str) -> Method {
    static KNOWN: Mutex<Vec<Method>> = Mutex::new(Vec::new());
    let (structure, width) = shape_of(path).unwrap_or((Structure::Bvh, 2));
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let is_same = |method: &&Method| {
        let of_width = method
            .constants
            .iter()
            .all(|c| c.default == f64::from(width));
        method.name == path && method.structure == structure && of_width
    };
    if let Some(&method) = known.iter().find(is_same) {
        return method;
    }
    let name: &'static str = String::leak(path.to_owned());
    let constants: &'static [Constant] = match structure {
        Structure::Bvh => Box::leak(Box::new([of_width(width)])),
        _ => &[],
    };
    let method = Method::new(Box::leak(Box::new(MethodInfo {
        name,
        summary: "the tree of a file",
        about: "Reads the tree of a file instead of building one.",
        source: "the file",
        paper: None,
        paper_spheres_exactly: false,
        structure,
        has_limits: false,
        constants,
        builder: Builder::File(Path::new(name)),
    })));
    known.push(method);
    method
}

/// Returns structure and width of the tree of a file; `None` if its header cannot be read.
fn shape_of(path: &str) -> Option<(Structure, u32)> {
    let header = header_of(Path::new(path))?;
    let width = if header.kind == Kind::Bvh {
        header.width
    } else {
        2
    };
    Some((header.structure(), width))
}

/// Returns whether a tree file states another checksum than that of the file of the scene.
pub fn is_of_another_scene(file: &Path, scene: &Path) -> bool {
    let stated = header_of(file).and_then(|header| header.sha256);
    let differs = |stated: String| {
        files::sha256(scene).is_ok_and(|found| !found.eq_ignore_ascii_case(&stated))
    };
    stated.is_some_and(differs)
}

fn header_of(path: &Path) -> Option<Header> {
    let mut start = Vec::new();
    let file = std::fs::File::open(path).ok()?;
    // Reading a pipe might block forever.
    if !file.metadata().ok()?.is_file() {
        return None;
    }
    file.take(MAX_HEADER as u64).read_to_end(&mut start).ok()?;
    let (header, _) = Header::parse(&start).ok()?;
    Some(header)
}

fn of_width(width: u32) -> Constant {
    let width = f64::from(width);
    Constant {
        name: "width",
        default: width,
        lowest: width,
        highest: width,
        step: 1.0,
        unit: "children",
        about: "Children per inner node at most, as in the file.",
        source: "the file",
    }
}
