//! The JSON of a glTF file, as far as it is read here.
//!
//! Whole numbers may be written as decimals (`3.0`). What never refuses the geometry (materials,
//! cameras, lights) is kept as plain JSON and converted field by field.

use super::super::lines::whole_of;
use serde::de::{Deserializer, Error, IgnoredAny, Unexpected, Visitor};
use serde::{Deserialize, de};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt;

/// A whole number that is not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Whole(pub u64);

impl Whole {
    /// Returns the number as an index; one that does not fit is an index of nothing.
    pub fn index(self) -> usize {
        usize::try_from(self.0).unwrap_or(usize::MAX)
    }

    /// Returns the whole number that a value is; `None` for other values.
    pub fn of(value: &Value) -> Option<Self> {
        Whole::deserialize(value).ok()
    }
}

impl<'de> Deserialize<'de> for Whole {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl Visitor<'_> for Number {
            type Value = Whole;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number that is not negative")
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Whole, E> {
                Ok(Whole(number))
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Whole, E> {
                let whole = whole_of(number).and_then(|n| u64::try_from(n).ok());
                whole
                    .map(Whole)
                    .ok_or_else(|| de::Error::invalid_value(Unexpected::Float(number), &self))
            }
        }
        deserializer.deserialize_any(Number)
    }
}

pub(super) type Extensions = Map<String, Value>;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root {
    pub asset: Asset,
    pub scene: Option<Whole>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub materials: Vec<Value>,
    #[serde(default)]
    pub cameras: Vec<Value>,
    #[serde(default)]
    pub animations: Vec<IgnoredAny>,
    #[serde(default)]
    pub skins: Vec<IgnoredAny>,
    #[serde(default)]
    pub extensions: Extensions,
    #[serde(default)]
    pub extensions_used: Vec<String>,
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

#[derive(Deserialize)]
pub(super) struct Asset {
    #[serde(default)]
    version: Value,
}

impl Asset {
    /// Returns the version as text; `None` if the file does not contain it.
    pub fn version(&self) -> Option<String> {
        match &self.version {
            Value::Null => None,
            Value::String(text) => Some(text.clone()),
            other => Some(other.to_string()),
        }
    }
}

/// The part of a file that tells its version, whatever the rest is.
#[derive(Deserialize)]
pub(super) struct Head {
    pub asset: Asset,
}

#[derive(Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub nodes: Vec<Whole>,
}

#[derive(Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub children: Vec<Whole>,
    pub mesh: Option<Whole>,
    pub camera: Option<Value>,
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    #[serde(default)]
    pub extensions: Extensions,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub attributes: BTreeMap<String, Value>,
    pub indices: Option<Whole>,
    pub material: Option<Value>,
    pub mode: Option<Whole>,
    pub targets: Option<IgnoredAny>,
    #[serde(default)]
    pub extensions: Extensions,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<Whole>,
    #[serde(default)]
    pub byte_offset: Whole,
    pub component_type: Whole,
    pub count: Whole,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default)]
    pub normalized: bool,
    pub sparse: Option<Box<Sparse>>,
}

/// Elements that replace some of an accessor's.
#[derive(Deserialize)]
pub(super) struct Sparse {
    pub count: Whole,
    pub indices: SparseIndices,
    pub values: SparseValues,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    pub buffer_view: Whole,
    #[serde(default)]
    pub byte_offset: Whole,
    pub component_type: Whole,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    pub buffer_view: Whole,
    #[serde(default)]
    pub byte_offset: Whole,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub buffer: Whole,
    pub byte_length: Whole,
    #[serde(default)]
    pub byte_offset: Whole,
    #[serde(default)]
    pub byte_stride: Whole,
    #[serde(default)]
    pub extensions: Extensions,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    #[serde(default)]
    pub byte_length: Whole,
    pub uri: Option<String>,
    #[serde(default)]
    pub extensions: Extensions,
}

/// The fields of an object that is read leniently.
pub(super) struct Fields<'a> {
    object: Option<&'a Value>,
    /// Names of fields that could not be read.
    pub unreadable: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    pub fn of(object: Option<&'a Value>) -> Self {
        let is_bad = object.is_some_and(|value| !value.is_object());
        Fields {
            object,
            unreadable: if is_bad {
                vec!["the whole object"]
            } else {
                Vec::new()
            },
        }
    }

    /// Returns whether a field is there.
    pub fn has(&self, name: &str) -> bool {
        self.object.is_some_and(|object| object.get(name).is_some())
    }

    /// Returns the fields of an object within this one.
    pub fn inner(&self, name: &str) -> Fields<'a> {
        Fields::of(self.object.and_then(|object| object.get(name)))
    }

    /// Returns a field that is a text.
    pub fn text(&self, name: &str) -> Option<&'a str> {
        self.object?.get(name)?.as_str()
    }

    /// Returns a number, or `default` if the field is absent or cannot be read.
    pub fn number(&mut self, name: &'static str, default: f64) -> f64 {
        let Some(value) = self.object.and_then(|object| object.get(name)) else {
            return default;
        };
        value.as_f64().unwrap_or_else(|| {
            self.unreadable.push(name);
            default
        })
    }

    /// Returns numbers, or `default` if the field is absent or cannot be read.
    pub fn numbers<const N: usize>(&mut self, name: &'static str, default: [f64; N]) -> [f64; N] {
        let Some(value) = self.object.and_then(|object| object.get(name)) else {
            return default;
        };
        <Vec<f64>>::deserialize(value)
            .ok()
            .and_then(|list| list.try_into().ok())
            .unwrap_or_else(|| {
                self.unreadable.push(name);
                default
            })
    }
}
