//! What the window shows. Everything has a default and is optional in a file.

use super::names;
use crate::geometry::Axis;
use crate::measure::heat::{RayFilter, heatmaps};
use crate::measure::model::Region;
use crate::present::overlay::{COLORINGS, COLORMAPS, HISTOGRAMS, Outside, Scale, Visited};
use crate::scene::Camera;
use crate::structure::Moment;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// One of the two trees of a comparison. Without a comparison there is only A.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Which {
    #[default]
    A,
    B,
}

impl Which {
    pub const BOTH: [Which; 2] = [Which::A, Which::B];

    pub const fn name(self) -> &'static str {
        match self {
            Which::A => "A",
            Which::B => "B",
        }
    }

    pub const fn other(self) -> Which {
        match self {
            Which::A => Which::B,
            Which::B => Which::A,
        }
    }
}

/// How two pictures are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Arrangement {
    /// Only the picture in front.
    #[serde(rename = "one")]
    One,
    /// A on the left of a movable line, B on the right.
    #[default]
    #[serde(rename = "wipe")]
    Wipe,
    /// A in the left half, B in the right half.
    #[serde(rename = "side by side")]
    Beside,
    /// The difference between B and A.
    #[serde(rename = "difference")]
    Difference,
}

impl Arrangement {
    pub const ALL: [Arrangement; 4] = [
        Arrangement::One,
        Arrangement::Wipe,
        Arrangement::Beside,
        Arrangement::Difference,
    ];

    pub const fn name(self) -> &'static str {
        match self {
            Arrangement::One => "one",
            Arrangement::Wipe => "wipe",
            Arrangement::Beside => "side by side",
            Arrangement::Difference => "difference",
        }
    }

    pub const fn about(self) -> &'static str {
        match self {
            Arrangement::One => "The picture of the tree in front. Hold F to see the other.",
            Arrangement::Wipe => "A on the left of a line, B on the right. Drag the line.",
            Arrangement::Beside => {
                "A in the left half, B in the right half. Both move and zoom together."
            }
            Arrangement::Difference => {
                "The difference B − A of a heatmap, or the pixels in which the pictures differ."
            }
        }
    }

    /// Returns the next arrangement, cyclically.
    pub fn next(self) -> Arrangement {
        let all = Arrangement::ALL;
        let at = all.iter().position(|view| *view == self);
        all[(at.unwrap_or(0) + 1) % all.len()]
    }
}

/// What the window shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct View {
    /// The tree in front, to which settings and panels apply.
    pub front: Which,
    /// How the pictures of two trees are arranged.
    pub arrangement: Arrangement,
    /// Position of the line between them, from 0 (left edge) to 1 (right edge).
    #[serde(deserialize_with = "names::share")]
    pub split: f64,
    /// Pinned pixels: column and row.
    pub pinned: Vec<[u32; 2]>,
    pub picture: PicturePlace,
    /// The region that the pane *Time* shows.
    pub region: Option<Region>,
    pub selected: Selected,
    /// The displayed moment of the build; `None` for the finished tree.
    pub build: Option<Moment>,
    /// Selected ranges of the histograms by name, including both ends.
    #[serde(deserialize_with = "known_ranges")]
    pub ranges: BTreeMap<String, [f64; 2]>,
    pub heatmap: Heat,
    pub view3d: View3dSettings,
}

impl Default for View {
    fn default() -> Self {
        View {
            front: Which::default(),
            arrangement: Arrangement::default(),
            split: 0.5,
            pinned: Vec::new(),
            picture: PicturePlace::default(),
            region: None,
            selected: Selected::default(),
            build: None,
            ranges: BTreeMap::new(),
            heatmap: Heat::default(),
            view3d: View3dSettings::default(),
        }
    }
}

/// Zoom and position of the picture in its pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PicturePlace {
    /// Screen points per pixel of the picture; `None` fits it into the pane.
    #[serde(deserialize_with = "known_zoom")]
    pub zoom: Option<f64>,
    /// Offset of the center of the picture from that of the pane, in points to the right and down.
    pub offset: [f64; 2],
}

impl PicturePlace {
    /// The range of allowed zooms.
    pub const ZOOMS: RangeInclusive<f64> = 0.02..=200.0;
}

/// The name of the histogram of rays in [`View::ranges`].
pub const NODES_PER_RAY: &str = "nodes per ray";

/// Its name in earlier versions.
const NODES_PER_RAY_BEFORE: &str = "nodes a ray";

/// The selection in the tree in front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Selected {
    /// The selected pixel: column and row.
    pub pixel: Option<[u32; 2]>,
    /// Index of the selected ray of the pixel; 0 is the primary ray.
    pub ray: usize,
    /// The selected step of its traversal, counted from 0.
    pub step: usize,
    /// Number of a node of the tree.
    pub node: Option<u32>,
    /// Number of an object of the scene.
    pub object: Option<u32>,
}

/// The heatmap over the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Heat {
    /// Symbol of the heatmap; `None` for only the picture.
    #[serde(deserialize_with = "known_heatmap")]
    pub show: Option<String>,
    #[serde(deserialize_with = "known_rays")]
    pub rays: String,
    #[serde(deserialize_with = "known_scale")]
    pub scale: String,
    /// Color map of values.
    #[serde(deserialize_with = "known_colors")]
    pub colors: String,
    /// Color map of differences.
    #[serde(deserialize_with = "known_colors")]
    pub difference_colors: String,
    /// Fixed range of the colors; `None` for the range of the values.
    pub range: Option<[f64; 2]>,
    /// Opacity over the picture, from 0 to 1.
    #[serde(deserialize_with = "names::share")]
    pub opacity: f64,
}

impl Default for Heat {
    fn default() -> Self {
        let first = |diverging| {
            let map = COLORMAPS.iter().find(|map| map.diverging == diverging);
            map.expect("there are maps of both sorts").name.to_owned()
        };
        Heat {
            show: None,
            rays: RayFilter::default().name().to_owned(),
            scale: Scale::default().name().to_owned(),
            colors: first(false),
            difference_colors: first(true),
            range: None,
            opacity: 1.0,
        }
    }
}

fn known_zoom<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    names::within(from, PicturePlace::ZOOMS).map(Some)
}

fn known_ranges<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<BTreeMap<String, [f64; 2]>, D::Error> {
    /// Validated separately, so that an error has its line.
    #[derive(Deserialize, PartialEq, Eq, PartialOrd, Ord)]
    #[serde(transparent)]
    struct Name(#[serde(deserialize_with = "known_histogram")] String);
    let found = BTreeMap::<Name, _>::deserialize(from)?;
    Ok(found
        .into_iter()
        .map(|(Name(name), range)| (name, range))
        .collect())
}

fn known_histogram<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let known = HISTOGRAMS.iter().map(|histogram| histogram.name);
    let known = known.chain([NODES_PER_RAY]);
    names::one_of_or(
        from,
        "histogram",
        known,
        &[(NODES_PER_RAY_BEFORE, NODES_PER_RAY)],
    )
}

fn known_heatmap<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    names::one_of(from, "heatmap", heatmaps().iter().map(|map| map.symbol)).map(Some)
}

fn known_rays<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    names::one_of(from, "kind of rays", RayFilter::ALL.map(RayFilter::name))
}

fn known_scale<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    names::one_of(from, "scale", Scale::ALL.map(Scale::name))
}

fn known_colors<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    names::one_of(from, "color map", COLORMAPS.iter().map(|map| map.name))
}

fn known_coloring<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    names::one_of(from, "coloring of leaves", COLORINGS.iter().map(|c| c.name))
}

/// The 3D view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct View3dSettings {
    pub objects: bool,
    pub leaf_boxes: bool,
    /// Name of the coloring of leaves.
    #[serde(deserialize_with = "known_coloring")]
    pub coloring: String,
    pub full_leaves: bool,
    pub empty_leaves: bool,
    /// Filter by whether rays of the picture visited the leaves.
    pub visited: Visited,
    /// How cells outside of the selected subtree are shown.
    pub outside: Outside,
    /// Minimum depth of displayed leaves.
    pub least_depth: u32,
    /// Maximum depth of displayed leaves; `None` for all.
    pub greatest_depth: Option<u32>,
    /// Show only leaves that the selected ray visited.
    pub only_visited: bool,
    /// Depth at which cells stand in for the leaves below; `None` for leaves alone.
    pub cells_to_depth: Option<u32>,
    /// Show all rays of the selected pixel instead of only the selected one.
    pub all_rays: bool,
    pub orthographic: bool,
    /// The camera of the view; `None` for the camera of the picture.
    pub camera: Option<Camera>,
    /// Whether moving the view moves the picture's camera.
    pub same_camera: bool,
    pub cut: CutSettings,
}

impl Default for View3dSettings {
    fn default() -> Self {
        View3dSettings {
            objects: true,
            leaf_boxes: true,
            coloring: COLORINGS[0].name.to_owned(),
            full_leaves: true,
            empty_leaves: true,
            visited: Visited::default(),
            outside: Outside::default(),
            least_depth: 0,
            greatest_depth: None,
            only_visited: false,
            cells_to_depth: None,
            all_rays: true,
            orthographic: false,
            camera: None,
            same_camera: false,
            cut: CutSettings::default(),
        }
    }
}

/// The plane that cuts the 3D view open.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct CutSettings {
    pub on: bool,
    pub axis: Axis,
    /// Position of the plane along each axis, from 0 to 1 in the root cell.
    pub places: [f64; 3],
    /// Whether the lower side is hidden instead of the upper.
    pub hides_less: bool,
}

impl Default for CutSettings {
    fn default() -> Self {
        CutSettings {
            on: false,
            axis: Axis::X,
            places: [0.5; 3],
            hides_less: false,
        }
    }
}
