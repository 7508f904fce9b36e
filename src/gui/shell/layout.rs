//! How the window is laid out: the task on view, the tiles of each task, what is open at the bottom, the
//! size and the theme. It is kept from run to run.

use super::places::{PaneId, Tiles, pane, simplification, tree};
use super::tasks::{TASKS, Task, TaskId, slotted};
use egui_tiles::{Tile, TileId};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// The name of the file it is kept in.
pub const LAYOUT_FILE: &str = "layout.json";

/// The smallest window, in points.
pub const LEAST_SIZE: [f32; 2] = [640.0, 400.0];

/// The layout of the window.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// The tiles of each task, by its id.
    #[serde(serialize_with = "write_tasks", deserialize_with = "read_tasks")]
    tasks: BTreeMap<TaskId, Tiles>,
    /// The task on view.
    pub task: TaskId,
    /// The pane that is open at the bottom, by its id.
    pub open: Option<String>,
    /// Whether the settings are shown.
    pub settings: bool,
    /// `None` follows the system.
    pub dark: Option<bool>,
    /// Width and height of the window, in points of the screen; `None` until there was one.
    pub size: Option<[f32; 2]>,
}

impl Default for Layout {
    fn default() -> Self {
        Layout {
            tasks: (TASKS.iter().map(|task| (TaskId(task.id), (task.tiles)()))).collect(),
            task: TaskId::default(),
            open: None,
            settings: false,
            dark: None,
            size: None,
        }
    }
}

impl Layout {
    pub fn current(&self) -> &'static Task {
        self.task.task()
    }

    /// The tiles of the task on view.
    pub fn tiles(&mut self) -> &mut Tiles {
        let task = self.current();
        self.tasks.entry(self.task).or_insert_with(task.tiles)
    }

    /// Resets the task on view.
    pub fn reset(&mut self) {
        let task = self.current();
        self.tasks.insert(self.task, (task.tiles)());
        self.open = None;
        self.settings = false;
    }

    /// Sets the panes beside a lesson: slots from left to right; the usual ones if there are none.
    pub fn stage(&mut self, slots: &[Vec<&'static str>]) {
        let id = TaskId("lessons");
        let tiles = match slots {
            [] => (id.task().tiles)(),
            slots => slotted(slots),
        };
        self.tasks.insert(id, tiles);
    }

    /// Whether the task on view shows a pane without opening the bottom.
    pub fn has(&self, pane: PaneId) -> bool {
        let tiles = self.tasks.get(&self.task);
        tiles.is_some_and(|tiles| shows(self.current(), tiles, pane))
    }

    /// The panes that no task shows by itself, and the one that is open: the tabs of the bottom strip.
    pub fn strip(&self) -> Vec<PaneId> {
        let opened = self.opened();
        let is_tab = |pane: &PaneId| opened == Some(*pane) || !is_of_a_task(*pane);
        self.elsewhere().filter(is_tab).collect()
    }

    /// The panes that only other tasks show.
    pub fn of_other_tasks(&self) -> Vec<PaneId> {
        let opened = self.opened();
        let is_other = |pane: &PaneId| opened != Some(*pane) && is_of_a_task(*pane);
        self.elsewhere().filter(is_other).collect()
    }

    /// The panes that the task on view does not show by itself.
    fn elsewhere(&self) -> impl Iterator<Item = PaneId> {
        PaneId::all().filter(|pane| !self.has(*pane) && pane.entry().id != "settings")
    }

    /// Brings a pane to the front: its tab, the drawer, or the bottom.
    pub fn show(&mut self, wanted: PaneId) {
        if wanted.entry().id == "settings" {
            self.settings = true;
        } else if self.has(wanted) {
            self.tiles()
                .make_active(|_, tile| matches!(tile, Tile::Pane(pane) if *pane == wanted));
        } else {
            self.open = Some(wanted.entry().id.to_owned());
        }
    }

    /// The pane that is open at the bottom.
    pub fn opened(&self) -> Option<PaneId> {
        let pane = self.open.as_deref().and_then(pane)?;
        (!self.has(pane)).then_some(pane)
    }
}

/// The panes that tasks show at first; made once, because the strip asks in every frame.
static OF_TASKS: LazyLock<Vec<PaneId>> = LazyLock::new(|| {
    let tasks: Vec<_> = TASKS.iter().map(|task| (task, (task.tiles)())).collect();
    let is_of_one = |pane: &PaneId| tasks.iter().any(|(task, tiles)| shows(task, tiles, *pane));
    PaneId::all().filter(is_of_one).collect()
});

/// Whether a task shows this pane at first.
fn is_of_a_task(pane: PaneId) -> bool {
    OF_TASKS.contains(&pane)
}

/// Whether a task with these tiles shows a pane.
fn shows(task: &Task, tiles: &Tiles, pane: PaneId) -> bool {
    let columns = [&task.left, &task.right, &task.below];
    let mut fixed = columns.into_iter().flatten().flat_map(|c| c.panes);
    let mut tiles = tiles.tiles.tiles();
    fixed.any(|id| *id == pane.entry().id)
        || tiles.any(|tile| matches!(tile, Tile::Pane(p) if *p == pane))
}

/// Tiles as they are kept: panes by name, because other versions may have others.
#[derive(Serialize, Deserialize)]
struct KeptTiles {
    root: TileId,
    tiles: Vec<(TileId, Tile<String>)>,
}

impl KeptTiles {
    fn of(tree: &Tiles) -> Option<Self> {
        let named = |tile: &Tile<PaneId>| match tile {
            Tile::Pane(pane) => Tile::Pane(pane.entry().id.to_owned()),
            Tile::Container(container) => Tile::Container(container.clone()),
        };
        let tiles = tree.tiles.iter();
        let mut tiles: Vec<_> = tiles.map(|(&id, tile)| (id, named(tile))).collect();
        // The same layout is the same file.
        tiles.sort_by_key(|(id, _)| id.0);
        tree.root.map(|root| KeptTiles { root, tiles })
    }

    /// The tiles without panes that are unknown or occur twice; `None` if nothing is left.
    fn read(self) -> Option<Tiles> {
        let mut tiles = egui_tiles::Tiles::default();
        for (id, tile) in self.tiles {
            match tile {
                Tile::Container(container) => tiles.insert(id, Tile::Container(container)),
                Tile::Pane(name) => {
                    if let Some(pane) = pane(&name) {
                        tiles.insert(id, Tile::Pane(pane));
                    }
                }
            }
        }
        let mut tree = tree(self.root, tiles);
        tree.gc(&mut OnceEach::default());
        // What was emptied just now goes, too.
        tree.simplify(&simplification());
        tree.root.map(|_| tree)
    }
}

fn write_tasks<S: Serializer>(
    tasks: &BTreeMap<TaskId, Tiles>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let kept = tasks.iter().map(|(id, tree)| (id.0, KeptTiles::of(tree)));
    serializer.collect_map(kept)
}

/// The tiles that were kept, and those of tasks that the file lacks.
fn read_tasks<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<TaskId, Tiles>, D::Error> {
    let mut kept = BTreeMap::<String, Option<KeptTiles>>::deserialize(deserializer)?;
    let tiles = TASKS.iter().map(|task| {
        let read = kept.remove(task.id).flatten().and_then(KeptTiles::read);
        (TaskId(task.id), read.unwrap_or_else(task.tiles))
    });
    Ok(tiles.collect())
}

/// Keeps one tile of each pane; shows none.
#[derive(Default)]
struct OnceEach(Vec<PaneId>);

impl egui_tiles::Behavior<PaneId> for OnceEach {
    fn tab_title_for_pane(&mut self, pane: &PaneId) -> egui::WidgetText {
        pane.entry().title.into()
    }

    fn pane_ui(&mut self, _: &mut egui::Ui, _: TileId, _: &mut PaneId) -> egui_tiles::UiResponse {
        egui_tiles::UiResponse::None
    }

    fn retain_pane(&mut self, pane: &PaneId) -> bool {
        let is_first = !self.0.contains(pane);
        self.0.push(*pane);
        is_first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::panes::PANES;

    /// A layout unlike the default one.
    fn other() -> Layout {
        let mut layout = Layout {
            task: TaskId("lessons"),
            open: Some("icicle".into()),
            settings: true,
            dark: Some(false),
            size: Some([1000.0, 700.0]),
            ..Layout::default()
        };
        let tiles = layout.tiles();
        for (_, tile) in tiles.tiles.iter_mut() {
            if let Tile::Container(egui_tiles::Container::Linear(linear)) = tile {
                linear.children.reverse();
                let first = linear.children[0];
                linear.shares.set_share(first, 3.0);
            }
        }
        layout
    }

    #[test]
    fn a_layout_survives_being_kept() {
        let layout = other();
        let text = serde_json::to_string(&layout).unwrap();
        let again: Layout = serde_json::from_str(&text).unwrap();
        assert!(again == layout, "{text}");
        assert!(again != Layout::default());
    }

    #[test]
    fn every_pane_can_be_reached_in_every_task() {
        for task in &TASKS {
            for pane in PaneId::all() {
                let mut layout = Layout {
                    task: TaskId(task.id),
                    ..Layout::default()
                };
                layout.show(pane);
                let shown = layout.has(pane) || layout.opened() == Some(pane) || layout.settings;
                assert!(shown, "{} in {}", pane.entry().id, task.id);
                layout.open = None;
                let tabs = [layout.strip(), layout.of_other_tasks()].concat();
                let is_tab = tabs.contains(&pane) || pane.entry().id == "settings";
                assert_ne!(layout.has(pane), is_tab);
            }
        }
    }

    #[test]
    fn unknown_and_repeated_panes_are_dropped() {
        let text = serde_json::to_string(&other()).unwrap();
        assert!(text.contains("\"view3d\"") && text.contains("\"picture\""));
        let from_other = text.replace("{\"Pane\":\"view3d\"}", "{\"Pane\":\"old\"}");
        assert_ne!(from_other, text);
        let layout: Layout = serde_json::from_str(&from_other).unwrap();
        assert!(!layout.has(pane("view3d").unwrap()));
        assert!(layout.settings, "the rest stays");
        let twice = text.replace("{\"Pane\":\"view3d\"}", "{\"Pane\":\"picture\"}");
        let layout: Layout = serde_json::from_str(&twice).unwrap();
        assert!(layout.has(pane("picture").unwrap()));
        // Titles of earlier versions name panes, too.
        let titled = text.replace("{\"Pane\":\"view3d\"}", "{\"Pane\":\"3D view\"}");
        let layout: Layout = serde_json::from_str(&titled).unwrap();
        assert!(layout == other());
    }

    #[test]
    fn a_file_that_lacks_something_or_has_more_is_no_trouble() {
        let layout: Layout =
            serde_json::from_str("{\"dark\": true, \"more\": 1, \"left\": {\"shown\": true}}")
                .unwrap();
        assert_eq!(layout.dark, Some(true));
        assert!(layout.has(pane("picture").unwrap()));
        let mut kept = serde_json::to_value(other()).unwrap();
        kept["tasks"]["lessons"]["root"] = 999.into();
        let layout: Layout = serde_json::from_value(kept).unwrap();
        assert!(layout.has(pane("picture").unwrap()));
    }

    #[test]
    fn titles_and_ids_of_panes_are_unique() {
        assert!(!PANES.is_empty());
        for (i, a) in PANES.iter().enumerate() {
            for b in &PANES[..i] {
                assert!(!b.is_called(a.id) && !b.is_called(a.title), "{}", a.title);
                assert!(
                    !a.aliases.iter().any(|alias| b.is_called(alias)),
                    "{}",
                    a.title
                );
            }
        }
    }
}
