//! Build settings: method, limits, overlap rule and constants.

use super::bvh::builder::BvhBuilder;
use super::method::{Constant, Structure};
use super::split::rule::SplitRule;
use crate::geometry::Axis;
use crate::scene::Scene;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::path::Path;

/// A build method: one of [`SPLIT_RULES`](super::split::SPLIT_RULES) or
/// [`BVH_BUILDERS`](super::bvh::BVH_BUILDERS).
#[derive(Clone, Copy)]
pub struct Method(&'static MethodInfo);

impl Method {
    /// Creates a method that is not in the registry, for programs that use the library. Settings with
    /// such a method can be written, but not read.
    pub const fn new(info: &'static MethodInfo) -> Method {
        Method(info)
    }

    /// Returns its description.
    pub const fn info(self) -> &'static MethodInfo {
        self.0
    }
}

impl std::ops::Deref for Method {
    type Target = MethodInfo;

    fn deref(&self) -> &MethodInfo {
        self.0
    }
}

impl PartialEq for Method {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.structure == other.structure
    }
}

impl std::fmt::Debug for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl Serialize for Method {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

/// The description of a build method.
pub struct MethodInfo {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// What it does in a few words, to be read after the name.
    pub summary: &'static str,
    /// A short description of how it splits.
    pub about: &'static str,
    /// Publications that describe it.
    pub source: &'static str,
    /// Its number in the paper, if it is one of the paper's methods.
    pub paper: Option<u32>,
    /// What [`OverlapRule::Paper`] means for it: whether spheres are tested against cells exactly.
    pub paper_spheres_exactly: bool,
    /// The structure that its cells form.
    pub structure: Structure,
    /// Whether `D_MAX` and `N_OILF` limit the depth and the leaves of its trees.
    pub has_limits: bool,
    /// The settings of this method.
    pub constants: &'static [Constant],
    pub builder: Builder,
}

/// How a method builds its structure, for valid settings.
#[derive(Clone, Copy)]
pub enum Builder {
    /// A rule splits cells by planes.
    Cells(fn(&BuildSettings) -> Box<dyn SplitRule>),
    /// A builder makes a bounding volume hierarchy.
    Boxes(fn(&BuildSettings) -> Box<dyn BvhBuilder>),
    /// The tree is read from this file.
    File(&'static Path),
}

impl MethodInfo {
    /// Returns whether it reads the tree of a file instead of building one.
    pub fn is_file(&self) -> bool {
        matches!(self.builder, Builder::File(_))
    }

    /// Describes the overlap rule, for reports.
    pub fn overlap_text(&self, rule: OverlapRule) -> &'static str {
        match rule {
            OverlapRule::Paper if self.paper_spheres_exactly => {
                "spheres exactly, all others by bounds"
            }
            OverlapRule::Paper | OverlapRule::Bounds => "bounds",
            OverlapRule::Exact => "exactly",
        }
    }
}

/// The text of a value that follows from the scene.
const AUTOMATIC: &str = "auto";

/// Maximum depth, `D_MAX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaxDepth {
    Fixed(u32),
    /// 1.2 · log₂ `N_O` + 2, rounded to the nearest integer (V. Havran, "Heuristic ray shooting
    /// algorithms", 2000, constants as commonly quoted).
    Automatic,
}

impl MaxDepth {
    /// Upper limit of the maximum depth, because it limits the size of traversal stacks.
    pub const LIMIT: u32 = 100;

    /// Returns the depth for a scene with `objects` objects.
    pub fn resolve(self, objects: usize) -> u32 {
        match self {
            MaxDepth::Fixed(depth) => depth,
            MaxDepth::Automatic => {
                let depth = 1.2 * libm::log2(objects.max(1) as f64) + 2.0;
                (depth.round() as u32).min(Self::LIMIT)
            }
        }
    }
}

impl std::str::FromStr for MaxDepth {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.parse::<u32>() {
            Ok(depth) if depth <= Self::LIMIT => Ok(MaxDepth::Fixed(depth)),
            _ if text == AUTOMATIC => Ok(MaxDepth::Automatic),
            _ => Err(format!(
                "expected a depth from 0 to {} or '{AUTOMATIC}', found '{text}'",
                Self::LIMIT
            )),
        }
    }
}

impl std::fmt::Display for MaxDepth {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            MaxDepth::Fixed(depth) => write!(f, "{depth}"),
            MaxDepth::Automatic => f.write_str(AUTOMATIC),
        }
    }
}

/// A number, or `"auto"`.
impl Serialize for MaxDepth {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            MaxDepth::Fixed(depth) => serializer.serialize_u32(*depth),
            MaxDepth::Automatic => serializer.collect_str(self),
        }
    }
}

impl<'de> Deserialize<'de> for MaxDepth {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Number(i64),
            Text(String),
        }
        let text = match Written::deserialize(deserializer)? {
            Written::Number(number) => number.to_string(),
            Written::Text(text) => text,
        };
        text.parse().map_err(serde::de::Error::custom)
    }
}

/// How far the root cell extends beyond the scene's bounds on every side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RootMargin {
    /// A length in the scene's units.
    Length(f64),
    /// The margin that was published with the scene ([`Scene::published_margin`]), or else
    /// [`RootMargin::SHARE`] of half the longest edge of the scene's bounds. A scene that is scaled as
    /// a whole then keeps its tree.
    Automatic,
}

impl RootMargin {
    /// The automatic margin, as a share of half the longest edge. A sphere of radius 1 gets the
    /// paper's margin of 0.001.
    pub const SHARE: f64 = 0.001;

    /// Returns the margin of a scene as a length.
    pub fn resolve(self, scene: &Scene) -> f64 {
        match self {
            RootMargin::Length(length) => length,
            RootMargin::Automatic => scene.published_margin().unwrap_or_else(|| {
                // Halves first: the difference of extreme bounds may overflow.
                let bounds = scene.bounds();
                let half = (bounds.hi * 0.5 - bounds.lo * 0.5).max_element();
                if half > 0.0 { Self::SHARE * half } else { 0.0 }
            }),
        }
    }
}

impl std::fmt::Display for RootMargin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RootMargin::Length(length) => write!(f, "{length}"),
            RootMargin::Automatic => f.write_str(AUTOMATIC),
        }
    }
}

/// A number, or `"auto"`.
impl Serialize for RootMargin {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            RootMargin::Length(length) => serializer.serialize_f64(*length),
            RootMargin::Automatic => serializer.serialize_str(AUTOMATIC),
        }
    }
}

impl<'de> Deserialize<'de> for RootMargin {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Number(f64),
            Text(String),
        }
        match Written::deserialize(deserializer)? {
            Written::Number(length) => Ok(RootMargin::Length(length)),
            Written::Text(text) if text == AUTOMATIC => Ok(RootMargin::Automatic),
            Written::Text(text) => Err(serde::de::Error::custom(format!(
                "expected a length or '{AUTOMATIC}', found '{text}'"
            ))),
        }
    }
}

/// The rule that decides whether an object belongs to a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum OverlapRule {
    /// As in the paper's figures for the method: `midpoint` tests spheres exactly and all others by
    /// their bounds, `sah-cut` tests all by their bounds.
    #[default]
    Paper,
    /// If its bounding box touches the closed cell.
    Bounds,
    /// If it shares a point with the closed cell (spheres, cylinders and cones are solid).
    Exact,
}

impl OverlapRule {
    pub const ALL: [OverlapRule; 3] = [OverlapRule::Paper, OverlapRule::Bounds, OverlapRule::Exact];

    pub const fn name(self) -> &'static str {
        match self {
            OverlapRule::Paper => "paper",
            OverlapRule::Bounds => "bounds",
            OverlapRule::Exact => "exact",
        }
    }
}

impl std::str::FromStr for OverlapRule {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        OverlapRule::ALL
            .into_iter()
            .find(|rule| rule.name() == text)
            .ok_or_else(|| format!("expected paper, bounds or exact, found '{text}'"))
    }
}

/// Constants of a method that differ from their defaults, by name.
pub type Constants = BTreeMap<String, f64>;

/// Everything that determines the tree of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildSettings {
    /// How planes are chosen.
    pub method: Method,
    /// Maximum depth of a leaf, `D_MAX`; the root has depth 0.
    pub d_max: MaxDepth,
    /// A cell with at most this many objects becomes a leaf, `N_OILF`.
    pub n_oilf: u32,
    /// How far the root cell extends beyond the scene's bounds on every side.
    pub root_margin: RootMargin,
    /// Whether an object belongs to a cell.
    pub overlap: OverlapRule,
    /// The axis that methods in cyclic order split first.
    pub first_axis: Axis,
    /// Constants of the method that differ from their defaults.
    pub constants: Constants,
    /// Memory limit in bytes; the build stops with an error before it exceeds it.
    pub memory_limit: u64,
}

/// Why settings are invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    #[error("no build method is called '{found}'; there are {known}")]
    UnknownMethod { found: String, known: String },
    #[error("D_MAX is {0}; it may be at most {limit}", limit = MaxDepth::LIMIT)]
    Depth(u32),
    #[error("the root margin is {0}; it must be finite and not negative")]
    RootMargin(f64),
    #[error("method {method} has no setting '{found}'; it has {known}")]
    UnknownConstant {
        method: &'static str,
        found: String,
        known: String,
    },
    #[error("{method}: {name} is {found}; it must lie between {lowest} and {highest}")]
    ConstantRange {
        method: &'static str,
        name: &'static str,
        found: f64,
        lowest: f64,
        highest: f64,
    },
}

impl BuildSettings {
    /// Returns the default settings with this method: the paper's `D_MAX` 20 and `N_OILF` 1, and the
    /// automatic margin.
    pub fn for_method(method: Method) -> Self {
        BuildSettings {
            method,
            d_max: MaxDepth::Fixed(20),
            n_oilf: 1,
            root_margin: RootMargin::Automatic,
            overlap: OverlapRule::Paper,
            first_axis: Axis::X,
            constants: Constants::new(),
            memory_limit: 4 << 30,
        }
    }

    /// Changes the method. The constants of another method return to their defaults; everything else
    /// stays.
    pub fn set_method(&mut self, method: Method) {
        if self.method != method {
            self.method = method;
            self.constants.clear();
        }
    }

    /// Returns the value of a constant of the method: as set, or its default.
    ///
    /// # Panics
    /// If the method has no constant of this name.
    pub fn constant(&self, name: &str) -> f64 {
        self.constants.get(name).copied().unwrap_or_else(|| {
            self.method
                .constants
                .iter()
                .find(|c| c.name == name)
                .unwrap_or_else(|| panic!("{} has no constant {name}", self.method.name))
                .default
        })
    }

    /// Names the method with the limits of its cells and the constants that are set, such as
    /// `sah, D_MAX 16, N_OILF 4` and `bvh-sweep, width 8`.
    pub fn in_words(&self) -> String {
        let mut words = vec![self.method.name.to_owned()];
        if self.method.structure != Structure::Bvh && self.method.has_limits {
            words.push(format!("D_MAX {}, N_OILF {}", self.d_max, self.n_oilf));
        }
        let constants = self.constants.iter();
        words.extend(constants.map(|(name, value)| format!("{name} {value}")));
        words.join(", ")
    }

    /// Checks ranges and names.
    ///
    /// # Errors
    /// The first setting that is out of its range.
    pub fn check(&self) -> Result<(), SettingsError> {
        if let MaxDepth::Fixed(depth) = self.d_max
            && depth > MaxDepth::LIMIT
        {
            return Err(SettingsError::Depth(depth));
        }
        if let RootMargin::Length(length) = self.root_margin
            && !(length >= 0.0 && length.is_finite())
        {
            return Err(SettingsError::RootMargin(length));
        }
        for (name, &value) in &self.constants {
            let known = self.method.constants;
            let Some(constant) = known.iter().find(|c| c.name == name) else {
                return Err(SettingsError::UnknownConstant {
                    method: self.method.name,
                    found: name.clone(),
                    known: if known.is_empty() {
                        "none".into()
                    } else {
                        known.iter().map(|c| c.name).collect::<Vec<_>>().join(", ")
                    },
                });
            };
            if !(constant.lowest..=constant.highest).contains(&value) {
                return Err(SettingsError::ConstantRange {
                    method: self.method.name,
                    name: constant.name,
                    found: value,
                    lowest: constant.lowest,
                    highest: constant.highest,
                });
            }
        }
        Ok(())
    }
}
