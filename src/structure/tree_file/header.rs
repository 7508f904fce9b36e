//! The first line of a file.

use super::error::TreeFileError;
use crate::structure::method::Structure;
use crate::structure::node::StopReason;
use serde::{Deserialize, Serialize};

/// The value of `format`.
pub const FORMAT: &str = "bstree";

/// The version that is read and written.
pub const VERSION: u32 = 1;

/// Multiple of bytes at which the data and every array that is written begin.
pub const ALIGNMENT: usize = 64;

/// Maximum length of the header in bytes.
pub const MAX_HEADER: usize = 1 << 20;

/// What inner nodes have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Boxes.
    Bvh,
    /// Planes.
    Kd,
}

/// What references count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    #[default]
    FileFace,
    Object,
}

/// How the cells of a tree with planes are traversed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cells {
    #[default]
    Bintree,
    Octree,
    Grid,
}

/// The root cell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Root {
    pub center: [f64; 3],
    /// Half its size.
    pub half: [f64; 3],
    /// The length by which it extends beyond the objects.
    #[serde(default)]
    pub margin: f64,
}

/// Type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Number {
    U8,
    U32,
    F32,
    F64,
}

impl Number {
    /// Returns the size in bytes.
    pub const fn bytes(self) -> usize {
        match self {
            Number::U8 => 1,
            Number::U32 | Number::F32 => 4,
            Number::F64 => 8,
        }
    }
}

/// Name, type, shape, and offset in bytes from the beginning of the data.
pub type Array = (String, Number, Vec<u64>, u64);

/// The header.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    pub format: String,
    pub version: u32,
    pub kind: Kind,
    #[serde(default, skip_serializing_if = "is_default")]
    pub structure: Cells,
    #[serde(default = "two", skip_serializing_if = "is_two")]
    pub width: u32,
    pub objects: u32,
    #[serde(default)]
    pub order: Order,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub split: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<Root>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stops: Vec<StopReason>,
    pub arrays: Vec<Array>,
}

fn two() -> u32 {
    2
}

fn is_two(width: &u32) -> bool {
    *width == 2
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Header {
    /// Creates a header without arrays and with the defaults of all that is optional.
    pub fn new(kind: Kind, objects: u32, order: Order) -> Header {
        Header {
            format: FORMAT.into(),
            version: VERSION,
            kind,
            structure: Cells::default(),
            width: two(),
            objects,
            order,
            sha256: None,
            split: false,
            root: None,
            stops: Vec::new(),
            arrays: Vec::new(),
        }
    }

    /// Reads the header at the beginning of a file. Also returns the data after it.
    ///
    /// # Errors
    /// There is no header, it is not one of this format and version, or a value is out of its range.
    pub fn parse(bytes: &[u8]) -> Result<(Header, &[u8]), TreeFileError> {
        let start = &bytes[..bytes.len().min(MAX_HEADER)];
        let length = start.iter().position(|&byte| byte == b'\n');
        let length = length.ok_or_else(|| {
            TreeFileError::Header(format!("no line of at most {MAX_HEADER} bytes"))
        })?;
        let header: Header = serde_json::from_slice(&start[..length])
            .map_err(|error| TreeFileError::Header(error.to_string()))?;
        if header.format != FORMAT || header.version != VERSION {
            return Err(TreeFileError::Header(format!(
                "expected format {FORMAT}, version {VERSION}, found {}, version {}",
                header.format, header.version
            )));
        }
        let highest = crate::structure::box_node::MAX_WIDTH as u32;
        if header.kind == Kind::Bvh && !(2..=highest).contains(&header.width) {
            return Err(TreeFileError::Header(format!(
                "expected a width from 2 to {highest}, found {}",
                header.width
            )));
        }
        let data = (length + 1).next_multiple_of(ALIGNMENT);
        Ok((header, bytes.get(data..).unwrap_or_default()))
    }

    /// Returns the structure that the nodes form.
    pub fn structure(&self) -> Structure {
        match (self.kind, self.structure) {
            (Kind::Bvh, _) => Structure::Bvh,
            (Kind::Kd, Cells::Bintree) => Structure::Bintree,
            (Kind::Kd, Cells::Octree) => Structure::Octree,
            (Kind::Kd, Cells::Grid) => Structure::Grid,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_data_begin_at_the_next_multiple_of_64_bytes() {
        let mut file =
            br#"{"format":"bstree","version":1,"kind":"bvh","objects":3,"arrays":[["leaf","u8",[1],0]]}"#
                .to_vec();
        file.push(b'\n');
        file.resize(file.len().next_multiple_of(ALIGNMENT), b' ');
        file.push(7);
        let (header, data) = Header::parse(&file).unwrap();
        assert_eq!((header.width, header.objects, data), (2, 3, &[7_u8][..]));
        assert_eq!(header.arrays, [("leaf".into(), Number::U8, vec![1], 0)]);
        assert_eq!(header.structure(), Structure::Bvh);
    }

    #[test]
    fn other_files_are_refused_with_a_reason() {
        for (file, reason) in [
            ("", "no line"),
            ("v 0 0 0\n", "expected"),
            (
                "{\"format\":\"bstree\",\"version\":2,\"kind\":\"kd\",\"objects\":0,\"arrays\":[]}\n",
                "version 2",
            ),
            (
                "{\"format\":\"bstree\",\"version\":1,\"kind\":\"bvh\",\"width\":9,\"objects\":0,\"arrays\":[]}\n",
                "width from 2 to 8",
            ),
        ] {
            let error = Header::parse(file.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
    }
}
