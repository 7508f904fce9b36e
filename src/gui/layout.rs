//! How the window is laid out: which pane lies where, which panels are unfolded, how large and in
//! which theme. It is kept from run to run.

use super::shortcuts::Scope;
use super::tree_panes::TreePane;
use egui_tiles::{Linear, LinearDir, SimplificationOptions, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::mem::discriminant;

/// The name of the file it is kept in.
pub const FILE: &str = "layout.json";

/// The smallest window, in points.
pub const LEAST_SIZE: [f32; 2] = [640.0, 400.0];

/// With tabs, panes can be dragged beside or onto each other.
pub fn simplification() -> SimplificationOptions {
    SimplificationOptions {
        all_panes_must_have_tabs: true,
        ..SimplificationOptions::default()
    }
}

/// What a tile holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pane {
    Picture,
    View3d,
    Tree(TreePane),
}

impl Pane {
    /// All panes, those that are looked at most first.
    pub fn all() -> impl Iterator<Item = Pane> {
        let about_tree = TreePane::ALL.map(Pane::Tree);
        [Pane::Picture, Pane::View3d].into_iter().chain(about_tree)
    }

    /// What its tab says.
    pub const fn title(self) -> &'static str {
        match self {
            Pane::Picture => "Picture",
            Pane::View3d => "3D view",
            Pane::Tree(pane) => pane.title(),
        }
    }

    /// The pane that takes the actions of a scope; `None` for those of the whole window.
    pub const fn of(scope: Scope) -> Option<Pane> {
        match scope {
            Scope::Window => None,
            Scope::Picture => Some(Pane::Picture),
            Scope::View3d => Some(Pane::View3d),
            Scope::Tree => Some(Pane::Tree(TreePane::Outline)),
            Scope::Leaves => Some(Pane::Tree(TreePane::Histograms)),
            Scope::Cost => Some(Pane::Tree(TreePane::Cost)),
            Scope::Trade => Some(Pane::Tree(TreePane::Trade)),
            Scope::Time => Some(Pane::Tree(TreePane::Time)),
            Scope::Sweep => Some(Pane::Tree(TreePane::Sweep)),
        }
    }
}

/// The layout of the window.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    #[serde(serialize_with = "write_tiles", deserialize_with = "read_tiles")]
    pub tiles: Tree<Pane>,
    pub left: SideBar,
    pub right: SideBar,
    /// By title, the panels that were folded or unfolded.
    pub unfolded: BTreeMap<String, bool>,
    /// `None` follows the system.
    pub dark: Option<bool>,
    /// Width and height of the window, in points of the screen; `None` until there was one.
    pub size: Option<[f32; 2]>,
}

/// One of the bars beside the panes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SideBar {
    pub shown: bool,
    /// In points.
    pub width: f32,
}

impl Default for Layout {
    /// For a window with room for everything.
    fn default() -> Self {
        Layout::for_width(f32::INFINITY)
    }
}

impl Layout {
    /// The layout at first, in a window of this width in points.
    pub fn for_width(window: f32) -> Self {
        /// In a narrower window, bars beside and panes below would leave no room for a picture.
        const LEAST: f32 = 900.0;
        let narrow = window < LEAST;
        let bar = |share: f32, most: f32| SideBar {
            shown: !narrow,
            width: (share * window).min(most),
        };
        Layout {
            tiles: default_tiles(narrow),
            left: bar(0.17, 255.0),
            right: bar(0.31, 400.0),
            unfolded: BTreeMap::new(),
            dark: None,
            size: None,
        }
    }

    /// Brings panes, bars and panels back to where they were at first.
    pub fn reset(&mut self, ctx: &egui::Context) {
        // Widths that were dragged.
        ctx.data_mut(|data| data.remove_by_type::<egui::containers::panel::PanelState>());
        *self = Layout {
            dark: self.dark,
            size: self.size,
            ..Layout::for_width(ctx.content_rect().width())
        };
    }

    /// Brings a pane to the front of its tabs.
    pub fn show(&mut self, wanted: Pane) {
        self.tiles
            .make_active(|_, tile| matches!(tile, Tile::Pane(pane) if *pane == wanted));
    }
}

/// Picture beside 3D view, and the panes about the tree as tabs: below them, or in a narrow window
/// with the picture.
fn default_tiles(narrow: bool) -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let [picture, view] = [Pane::Picture, Pane::View3d].map(|pane| tiles.insert_pane(pane));
    let about_tree = TreePane::ALL.map(|pane| tiles.insert_pane(Pane::Tree(pane)));
    let root = if narrow {
        let tabs = [&[picture], &about_tree[..]].concat();
        let tabs = tiles.insert_tab_tile(tabs);
        tiles.insert_horizontal_tile(vec![tabs, view])
    } else {
        let views = tiles.insert_horizontal_tile(vec![picture, view]);
        let tabs = tiles.insert_tab_tile(about_tree.to_vec());
        let mut column = Linear::new(LinearDir::Vertical, vec![views, tabs]);
        column.shares.set_share(views, 0.66);
        column.shares.set_share(tabs, 0.34);
        tiles.insert_container(column)
    };
    tree_of(root, tiles)
}

fn tree_of(root: TileId, tiles: Tiles<Pane>) -> Tree<Pane> {
    let mut tree = Tree::new(egui::Id::unique("panes"), root, tiles);
    tree.simplify(&simplification());
    tree
}

/// The tiles as they are kept: panes by their titles, for other versions may have others.
#[derive(Serialize, Deserialize)]
struct KeptTiles {
    root: TileId,
    tiles: Vec<(TileId, Tile<String>)>,
}

fn write_tiles<S: Serializer>(tree: &Tree<Pane>, serializer: S) -> Result<S::Ok, S::Error> {
    let by_title = |tile: &Tile<Pane>| match tile {
        Tile::Pane(pane) => Tile::Pane(pane.title().to_owned()),
        Tile::Container(container) => Tile::Container(container.clone()),
    };
    let tiles = tree.tiles.iter();
    let mut tiles: Vec<_> = tiles.map(|(&id, tile)| (id, by_title(tile))).collect();
    // The same layout is the same file.
    tiles.sort_by_key(|(id, _)| id.0);
    let kept = tree.root.map(|root| KeptTiles { root, tiles });
    kept.serialize(serializer)
}

/// The tiles that were kept, less the panes that are not known, and with those that are missing.
fn read_tiles<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Tree<Pane>, D::Error> {
    let Some(kept) = Option::<KeptTiles>::deserialize(deserializer)? else {
        return Ok(default_tiles(false));
    };
    let mut tiles = Tiles::default();
    for (id, tile) in kept.tiles {
        match tile {
            Tile::Container(container) => tiles.insert(id, Tile::Container(container)),
            Tile::Pane(title) => {
                if let Some(pane) = Pane::all().find(|pane| pane.title() == title) {
                    tiles.insert(id, Tile::Pane(pane));
                }
            }
        }
    }
    let mut tree = tree_of(kept.root, tiles);
    tree.gc(&mut OnceEach::default());
    // What was emptied just now goes, too.
    tree.simplify(&simplification());
    if tree.root.is_none() {
        return Ok(default_tiles(false));
    }
    for pane in Pane::all() {
        add_if_missing(&mut tree.tiles, pane);
    }
    tree.simplify(&simplification());
    Ok(tree)
}

/// Adds a pane beside one of its kind, or else beside any.
fn add_if_missing(tiles: &mut Tiles<Pane>, missing: Pane) {
    let mut there: Vec<(TileId, Pane)> = tiles
        .iter()
        .filter_map(|(&id, tile)| match tile {
            Tile::Pane(pane) => Some((id, *pane)),
            Tile::Container(_) => None,
        })
        .collect();
    if there.iter().any(|&(_, pane)| pane == missing) {
        return;
    }
    there.sort_by_key(|(_, pane)| discriminant(pane) != discriminant(&missing));
    let beside = there.first().and_then(|&(id, _)| tiles.parent_of(id));
    let added = tiles.insert_pane(missing);
    if let Some(Tile::Container(container)) = beside.and_then(|id| tiles.get_mut(id)) {
        container.add_child(added);
    }
}

/// Keeps one tile of each pane; shows none.
#[derive(Default)]
struct OnceEach(Vec<Pane>);

impl egui_tiles::Behavior<Pane> for OnceEach {
    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.title().into()
    }

    fn pane_ui(&mut self, _: &mut egui::Ui, _: TileId, _: &mut Pane) -> egui_tiles::UiResponse {
        egui_tiles::UiResponse::None
    }

    fn retain_pane(&mut self, pane: &Pane) -> bool {
        let is_first = !self.0.contains(pane);
        self.0.push(*pane);
        is_first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The panes that can be reached from the root, in order of their places.
    fn panes(layout: &Layout) -> Vec<Pane> {
        fn below(tiles: &Tiles<Pane>, id: TileId, found: &mut Vec<Pane>) {
            match tiles.get(id).expect("a tile that is there") {
                Tile::Pane(pane) => found.push(*pane),
                Tile::Container(container) => {
                    for &child in container.children() {
                        below(tiles, child, found);
                    }
                }
            }
        }
        let mut found = Vec::new();
        below(&layout.tiles.tiles, layout.tiles.root.unwrap(), &mut found);
        found
    }

    fn all_are_there(layout: &Layout) {
        let found = panes(layout);
        assert_eq!(found.len(), Pane::all().count(), "{found:?}");
        assert!(Pane::all().all(|pane| found.contains(&pane)), "{found:?}");
    }

    /// A layout unlike the default one.
    fn other() -> Layout {
        let mut layout = Layout::default();
        let views = layout
            .tiles
            .tiles
            .iter_mut()
            .find_map(|(_, tile)| match tile {
                Tile::Container(egui_tiles::Container::Linear(linear))
                    if linear.dir == LinearDir::Horizontal =>
                {
                    Some(linear)
                }
                _ => None,
            });
        let views = views.unwrap();
        views.children.reverse();
        let first = views.children[0];
        views.shares.set_share(first, 3.0);
        layout.show(Pane::Tree(TreePane::Icicle));
        layout.left.shown = false;
        layout.right.width = 300.0;
        layout.unfolded.insert("Picture".into(), false);
        layout.dark = Some(false);
        layout.size = Some([1000.0, 700.0]);
        layout
    }

    #[test]
    fn a_layout_survives_being_kept() {
        let layout = other();
        let text = serde_json::to_string(&layout).unwrap();
        let again: Layout = serde_json::from_str(&text).unwrap();
        assert!(again == layout, "{:?}\n{:?}", again.tiles, layout.tiles);
        assert!(again != Layout::default());
        all_are_there(&again);
    }

    #[test]
    fn panes_that_are_not_known_go_and_missing_ones_come_back() {
        let text = serde_json::to_string(&other()).unwrap();
        assert!(text.contains("\"Icicle\"") && text.contains("\"Picture\""));
        for gone in ["Icicle", "Picture", "3D view"] {
            let from_older =
                text.replace(&format!("{{\"Pane\":\"{gone}\"}}"), "{\"Pane\":\"Old\"}");
            assert_ne!(from_older, text);
            let layout: Layout = serde_json::from_str(&from_older).unwrap();
            all_are_there(&layout);
            assert!(!layout.left.shown, "the rest stays");
        }
        let twice = text.replace("{\"Pane\":\"Icicle\"}", "{\"Pane\":\"Outline\"}");
        all_are_there(&serde_json::from_str(&twice).unwrap());
        let mut none = text.clone();
        for pane in Pane::all() {
            none = none.replace(
                &format!("{{\"Pane\":\"{}\"}}", pane.title()),
                "{\"Pane\":\"\"}",
            );
        }
        let layout: Layout = serde_json::from_str(&none).unwrap();
        assert!(layout.tiles == Layout::default().tiles);
    }

    #[test]
    fn a_file_that_lacks_something_or_has_more_is_no_trouble() {
        let layout: Layout = serde_json::from_str("{\"dark\": true, \"more\": 1}").unwrap();
        assert_eq!(layout.dark, Some(true));
        all_are_there(&layout);
        let mut kept = serde_json::to_value(other()).unwrap();
        kept["tiles"]["root"] = 999.into();
        all_are_there(&serde_json::from_value(kept).unwrap());
    }
}
