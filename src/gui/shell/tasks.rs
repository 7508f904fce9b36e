//! The five tasks: what a person wants to do, and which panes that needs.

use super::places::{Column, Tiles};
use egui_tiles::{Linear, LinearDir};
use serde::{Deserialize, Deserializer, Serialize};

/// A task: a column of fixed width on either side, a row of fixed height below, tiles in between.
pub struct Task {
    pub id: &'static str,
    pub title: &'static str,
    pub about: &'static str,
    /// The action that switches to it.
    pub action: &'static str,
    pub left: Option<Column>,
    pub right: Option<Column>,
    pub below: Option<Column>,
    /// The tiles at first.
    pub tiles: fn() -> Tiles,
}

/// The tasks, in the order of the bar and of the keys Ctrl+1 to Ctrl+5.
pub static TASKS: [Task; 5] = [
    Task {
        id: "explore",
        title: "Explore",
        about: "The picture, the tree in 3D, and the figures.",
        action: "window.explore",
        left: None,
        right: Some(Column::new(&["figures"], [280.0, 280.0])),
        below: None,
        tiles: || beside(&["picture", "view3d"]),
    },
    Task {
        id: "ray",
        title: "Ray",
        about: "One pixel's rays, step by step.",
        action: "window.ray",
        left: Some(Column::new(&["picture", "rays"], [440.0, 368.0])),
        right: None,
        below: Some(Column::new(&["ray"], [300.0, 244.0])),
        tiles: || beside(&["view3d"]),
    },
    Task {
        id: "compare",
        title: "Compare",
        about: "Two trees of the same scene, side by side.",
        action: "window.compare",
        left: None,
        right: Some(Column::new(&["comparison"], [416.0, 416.0])),
        below: None,
        tiles: || beside(&["picture"]),
    },
    Task {
        id: "tune",
        title: "Tune",
        about: "The best tree for this scene.",
        action: "window.tune",
        left: Some(Column::new(&["tune"], [360.0, 300.0])),
        right: None,
        below: None,
        tiles: || {
            above(
                ("ranking", 396.0),
                (&["sweep", "time", "accuracy", "measures"], 532.0),
            )
        },
    },
    Task {
        id: "lessons",
        title: "Lessons",
        about: "Guided tours that ask for a prediction, then measure.",
        action: "window.lessons",
        left: Some(Column::new(&["lesson"], [420.0, 420.0])),
        right: None,
        below: None,
        tiles: || beside(&["picture", "view3d"]),
    },
];

/// Returns the task with this id; the first one if there is none.
pub fn task(id: &str) -> &'static Task {
    let known = TASKS.iter().find(|task| task.id == id);
    known.unwrap_or(&TASKS[0])
}

/// A task by its id; in a file, an unknown one is the first task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct TaskId(pub &'static str);

impl Default for TaskId {
    fn default() -> Self {
        TaskId(TASKS[0].id)
    }
}

impl TaskId {
    pub fn task(self) -> &'static Task {
        task(self.0)
    }
}

impl<'de> Deserialize<'de> for TaskId {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(TaskId(task(&String::deserialize(from)?).id))
    }
}

/// A pane above others, which are tabs, with their shares of the height.
fn above(
    (upper, upper_share): (&'static str, f32),
    (lower, lower_share): (&[&'static str], f32),
) -> Tiles {
    let pane = |id: &str| super::places::pane(id).expect("tasks name known panes");
    let mut tiles = egui_tiles::Tiles::default();
    let upper = tiles.insert_pane(pane(upper));
    let lower = lower.iter().map(|id| tiles.insert_pane(pane(id))).collect();
    let lower = tiles.insert_tab_tile(lower);
    let mut both = Linear::new(LinearDir::Vertical, vec![upper, lower]);
    both.shares.set_share(upper, upper_share);
    both.shares.set_share(lower, lower_share);
    let root = tiles.insert_container(both);
    super::places::tree(root, tiles)
}

/// Panes of equal width beside each other.
fn beside(panes: &[&'static str]) -> Tiles {
    let slots: Vec<_> = panes.iter().map(|pane| vec![*pane]).collect();
    slotted(&slots)
}

/// Slots of equal width from left to right, each with panes of equal height from the top.
pub fn slotted(slots: &[Vec<&'static str>]) -> Tiles {
    let mut tiles = egui_tiles::Tiles::default();
    let mut columns = Vec::new();
    for slot in slots {
        let panes = slot.iter().map(|id| {
            let pane = super::places::pane(id).expect("slots name known panes");
            tiles.insert_pane(pane)
        });
        let panes: Vec<_> = panes.collect();
        columns.push(tiles.insert_container(Linear::new(LinearDir::Vertical, panes)));
    }
    let root = tiles.insert_container(Linear::new(LinearDir::Horizontal, columns));
    super::places::tree(root, tiles)
}
