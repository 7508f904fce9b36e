//! The outline of the tree: a table of the unfolded nodes, of which only the visible rows are laid
//! out.

use find_bar::{FindBar, Step};
mod find_bar;

use crate::gui::action::{actions, tip};
use crate::gui::document::inspect::TreeKey;
use crate::gui::document::visits;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::theme;
use crate::gui::widgets::common::{no_picture, short, waiting};
use crate::gui::widgets::symbol::grouped;
use crate::gui::widgets::tree_rows::Rows;
use crate::gui::widgets::visits_note::visits_note;
use crate::jobs::PictureVisits;
use crate::present::number::{Digits, counted};
use crate::structure::{NodeKind, Nodes, Tree, TreeIndex};
use egui::{Align, Sense};
use egui_extras::{Column, TableBuilder, TableRow};
use std::sync::Arc;

/// The outline.
#[derive(Default)]
pub struct Outline {
    rows: Option<(TreeKey, Rows)>,
    /// The selection that was scrolled to.
    followed: Option<u32>,
    find: FindBar,
    /// What keys asked for since the last frame.
    moves: Vec<Move>,
}

/// A move of the selection.
#[derive(Clone, Copy)]
enum Move {
    RowUp,
    RowDown,
    Unfold,
    Fold,
    Find(Step),
    /// Through the leaves in the order of their visits.
    Visits {
        back: bool,
    },
}

/// Title, least and usual width in points, and meaning of every column.
const COLUMNS: [(&str, [f32; 2], &str); 9] = [
    (
        "node",
        [86.0, 164.0],
        "Index of the node in the tree's array; 0 is the root",
    ),
    ("depth", [42.0, 48.0], "Levels below the root"),
    (
        "plane, or why a leaf",
        [76.0, 240.0],
        "Axis and place of the split plane, in units of length; or why the cell was not split",
    ),
    (
        "objects",
        [54.0, 62.0],
        "Objects in the cell, each counted once",
    ),
    ("refs", [50.0, 66.0], "References of all leaves below"),
    (
        "area",
        [56.0, 64.0],
        "Surface area of the cell, in percent of the root's",
    ),
    (
        "tests",
        [42.0, 58.0],
        "Expected cost: intersection tests of a ray through the cell that nothing stops (MacDonald \
         and Booth 1990)",
    ),
    (
        "exp. nodes",
        [74.0, 80.0],
        "Expected nodes: those that such a ray is expected to visit, this one included",
    ),
    ("visits", [104.0, 150.0], visits::ABOUT),
];

/// The column of planes, and its title and meaning in a hierarchy.
const SPLIT: usize = 2;
const BOXES: (&str, &str) = (
    "boxes, or why a leaf",
    "Objects in the box of each child; or why the node was not divided",
);

/// The widths of the columns in a table of this width: as usual, or down to the least where there is
/// less room.
fn widths(room: f32) -> [f32; COLUMNS.len()] {
    let sum = |which: usize| {
        COLUMNS
            .iter()
            .map(|(_, width, _)| width[which])
            .sum::<f32>()
    };
    let share = ((room - sum(0)) / (sum(1) - sum(0))).clamp(0.0, 1.0);
    COLUMNS.map(|(_, [least, usual], _)| least + share * (usual - least))
}

impl Pane for Outline {
    const ID: &'static str = "outline";
    const TITLE: &'static str = "Outline";
    const ABOUT: &'static str = "The nodes of the tree as a table that unfolds.";
    const REVEALS: &'static [Fact] = &[Fact::AllCounters, Fact::Steps];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "outline.row-up" Here NONE [ArrowUp] "Select the row above" => |pane, _| pane.moves.push(Move::RowUp);
        "outline.row-down" Here NONE [ArrowDown] "Select the row below" => |pane, _| pane.moves.push(Move::RowDown);
        "outline.unfold" Here NONE [ArrowRight] "Unfold the node, or go to its first child" => |pane, _| pane.moves.push(Move::Unfold);
        "outline.fold" Here NONE [ArrowLeft] "Fold the node, or go to its parent" => |pane, _| pane.moves.push(Move::Fold);
        "outline.frame-node" Here NONE [Enter] "Show the selected node's cell in 3D" => |_, cx| cx.edits.add(|doc| doc.inspect.frame = doc.current.as_ref().and_then(|c| c.selection.node));
        "outline.find-previous" Here SHIFT [N] "Select the previous match" => |pane, _| pane.moves.push(Move::Find(Step::Previous));
        "outline.find-next" Here NONE [N] "Select the next match" => |pane, _| pane.moves.push(Move::Find(Step::Next));
        "outline.more-visited" Here SHIFT [V] "Select the previous leaf in the order of visits" => |pane, _| pane.moves.push(Move::Visits { back: true });
        "outline.less-visited" Here NONE [V] "Select the most visited leaf, then the next" => |pane, _| pane.moves.push(Move::Visits { back: false });
    };

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let moment = doc.inspect.build.moment();
        let Some(current) = &doc.current else {
            no_picture(ui, doc);
            return;
        };
        let Some(index) = doc.inspect.index(current, ui.ctx()) else {
            waiting(ui);
            return;
        };
        let tree = Arc::clone(&current.shown.tree);
        let key = TreeKey(Arc::clone(&tree));
        if self.rows.as_ref().is_none_or(|(of, _)| *of != key) {
            self.rows = Some((key.clone(), Rows::new(&tree, &index)));
            self.followed = None;
        }
        let visits = doc.inspect.visits.of(current, &doc.jobs);
        let picture = current.number;
        let matches = self
            .find
            .matches(&key, &index, visits.clone(), picture, ui.ctx());
        let found = matches.as_deref().map(Vec::as_slice);
        let before = current.selection.node;
        let mut node = before;
        if let Some(to) = self.find.ui(ui, found, before) {
            node = find_bar::step(found.unwrap_or_default(), before, to).or(before);
        }
        let Some((_, rows)) = &mut self.rows else {
            return;
        };
        rows.show(&tree, &index, moment);
        for step in self.moves.drain(..) {
            // In a list of matches, up and down go from match to match.
            let step = match step {
                Move::RowUp if self.find.only => Move::Find(Step::Previous),
                Move::RowDown if self.find.only => Move::Find(Step::Next),
                step => step,
            };
            match step {
                Move::Visits { back } => step_by_visits(&mut node, visits.as_deref(), back),
                Move::Find(to) => {
                    node = find_bar::step(found.unwrap_or_default(), node, to).or(node);
                }
                step => walk(step, &mut node, rows, &tree, &index),
            }
        }
        ui.horizontal_wrapped(|ui| {
            by_visits(ui, &mut node, visits.as_deref());
            if visits_note(ui, &doc.inspect.visits, current) {
                cx.edits.add(|doc| doc.inspect.visits.cancel_or_restart());
            }
            // The row stays one line high while visits are counted.
            if !doc.inspect.visits.is_counting(current) {
                summary(ui, current.selection.object, node, &index, &mut self.find);
            }
        });
        let listed = found.filter(|_| self.find.only);
        let mut scroll = None;
        if node != self.followed {
            self.followed = node;
            if let Some(node) = node {
                let row = rows.reveal(&tree, &index, node);
                scroll = match listed {
                    Some(list) => list.binary_search(&node).ok(),
                    None => row,
                };
            }
        }
        let shown: Vec<u32>;
        let nodes = match listed {
            Some(list) => list,
            None => {
                shown = rows.nodes().to_vec();
                &shown
            }
        };
        let mut table = Table {
            tree: &tree,
            index: &index,
            visits: visits.as_deref(),
            rows,
            selected: &mut node,
            flat: listed.is_some(),
        };
        table.ui(ui, nodes, scroll);
        if node != before {
            cx.edits.add(move |doc| doc.select_node(node));
        }
    }
}

/// Moves the selection by a key.
fn walk(step: Move, selected: &mut Option<u32>, rows: &mut Rows, tree: &Tree, index: &TreeIndex) {
    let Some(node) = *selected else {
        *selected = Some(0);
        return;
    };
    let inner = matches!(tree.kind(node), NodeKind::Inner) && rows.is_decided(tree, index, node);
    let row = rows.row_of(node).unwrap_or(0);
    match step {
        Move::RowUp => *selected = rows.nodes().get(row.saturating_sub(1)).copied(),
        Move::RowDown => {
            *selected = rows.nodes().get(row + 1).copied().or(Some(node));
        }
        Move::Unfold if inner && rows.is_unfolded(node) => *selected = Some(node + 1),
        Move::Unfold => rows.set(tree, index, node, inner),
        Move::Fold if inner && rows.is_unfolded(node) => rows.set(tree, index, node, false),
        Move::Fold => *selected = Some(index.of(node).parent),
        Move::Find(_) | Move::Visits { .. } => {}
    }
}

/// Selects the most visited leaf, or from a leaf on the next or the one before.
fn step_by_visits(selected: &mut Option<u32>, visits: Option<&PictureVisits>, back: bool) {
    if let Some(visits) = visits {
        *selected = visits.step(*selected, back).or(*selected);
    }
}

/// The way through the leaves in the order of their visits.
fn by_visits(ui: &mut egui::Ui, selected: &mut Option<u32>, visits: Option<&PictureVisits>) {
    for (name, about, action) in [
        (
            "More visited",
            "Select the leaf that comes before in the order of visits.",
            "outline.more-visited",
        ),
        (
            "Less visited",
            "Select the most visited leaf, then the next in the order of visits.",
            "outline.less-visited",
        ),
    ] {
        let button = ui.add_enabled(visits.is_some(), egui::Button::new(name));
        if button.on_hover_text(tip(about, action)).clicked() {
            step_by_visits(selected, visits, action == "outline.more-visited");
        }
    }
}

/// What is selected, in words.
fn summary(
    ui: &mut egui::Ui,
    object: Option<u32>,
    node: Option<u32>,
    index: &TreeIndex,
    find: &mut FindBar,
) {
    if let Some(object) = object {
        let leaves = counted(index.leaves_of(object).len(), "leaf");
        if ui
            .button(format!("Object {object} is in {leaves}"))
            .on_hover_text("List the leaves that refer to the selected object.")
            .clicked()
        {
            find.text = format!("object {object}");
            find.only = true;
        }
    }
    let Some(node) = node else {
        ui.weak("No node selected: click one here, in 3D or in the icicle.");
        return;
    };
    let facts = index.of(node);
    let mut text = format!("Selected: node {node}, depth {}, ", facts.depth);
    text += &if facts.end == node + 1 {
        format!("a leaf with {}", counted(facts.objects as usize, "object"))
    } else {
        format!(
            "{} and {} below",
            counted(facts.leaves as usize, "leaf"),
            counted((facts.end - node - 1) as usize, "node")
        )
    };
    text += &format!(", volume {}", short(facts.volume));
    ui.label(text);
}

/// One frame of the table.
struct Table<'a> {
    tree: &'a Tree,
    index: &'a TreeIndex,
    visits: Option<&'a PictureVisits>,
    rows: &'a mut Rows,
    selected: &'a mut Option<u32>,
    /// A list of matches instead of an outline.
    flat: bool,
}

impl Table<'_> {
    fn ui(&mut self, ui: &mut egui::Ui, nodes: &[u32], scroll: Option<usize>) {
        let height = ui.text_style_height(&egui::TextStyle::Body) + 2.0;
        let width = ui.available_width();
        egui::ScrollArea::horizontal()
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                ui.style_mut().override_text_style = Some(theme::named(theme::HINT));
                ui.set_min_width(width);
                let mut builder = TableBuilder::new(ui)
                    .striped(true)
                    .sense(Sense::click())
                    .auto_shrink(false)
                    .cell_layout(egui::Layout::left_to_right(Align::Center))
                    .animate_scrolling(false);
                for width in widths(width - 6.0 * COLUMNS.len() as f32) {
                    builder = builder.column(Column::exact(width).clip(true));
                }
                if let Some(row) = scroll {
                    builder = builder.scroll_to_row(row, Some(Align::Center));
                }
                builder
                    .header(height, |mut header| {
                        let has_boxes = matches!(self.tree.nodes(), Nodes::Boxes(_));
                        for (i, (title, _, about)) in COLUMNS.into_iter().enumerate() {
                            let (title, about) = match i {
                                SPLIT if has_boxes => BOXES,
                                _ => (title, about),
                            };
                            header.col(|ui| {
                                ui.strong(title).on_hover_text(about);
                            });
                        }
                    })
                    .body(|body| {
                        body.rows(height, nodes.len(), |mut row| {
                            let node = nodes[row.index()];
                            self.row(&mut row, node);
                        });
                    });
            });
    }

    fn row(&mut self, row: &mut TableRow<'_, '_>, node: u32) {
        let facts = *self.index.of(node);
        row.set_selected(*self.selected == Some(node));
        row.col(|ui| {
            if !self.flat {
                self.fold(ui, node, facts.depth);
            }
            let label = egui::Label::new(format!("node {node}"))
                .selectable(false)
                .sense(Sense::click());
            if ui.add(label).clicked() {
                *self.selected = Some(node);
            }
        });
        let decided = self.rows.is_decided(self.tree, self.index, node);
        let (about, objects) = match self.tree.kind(node) {
            _ if !decided => ("not decided yet".to_owned(), facts.objects),
            NodeKind::Inner => {
                let plane = self.tree.plane(node);
                let text = match plane {
                    Some((axis, at)) => format!("{axis} = {at:.6}"),
                    None => self.parts_text(node),
                };
                (text, facts.objects)
            }
            NodeKind::Leaf { count, stop, .. } => (format!("leaf: {}", stop.text()), count),
        };
        let root = self.index.of(0).area;
        // What the subtree will amount to is not known before it is built.
        let later = |text: String| if decided { text } else { "–".to_owned() };
        for text in [
            facts.depth.to_string(),
            about,
            grouped(objects as usize),
            later(grouped(facts.references as usize)),
            Digits::Three.percent(facts.area / root),
            later(short(facts.tests)),
            later(short(facts.expected_visits)),
            later(self.visits_text(node)),
        ] {
            row.col(|ui| {
                ui.add(egui::Label::new(text).selectable(false).truncate());
            });
        }
        if row.response().clicked() {
            *self.selected = Some(node);
        }
    }

    /// The number of objects in each child.
    fn parts_text(&self, node: u32) -> String {
        let objects = self.tree.child_nodes(node).map(|child| {
            let objects = self.index.of(child).objects;
            grouped(objects as usize)
        });
        let parts: Vec<String> = objects.collect();
        format!("{} objects", parts.join(" + "))
    }

    /// Number of visits and their share of all rays; a dash where they are not counted.
    fn visits_text(&self, node: u32) -> String {
        let Some(visits) = self.visits else {
            return "–".to_owned();
        };
        let count = visits.by_node[node as usize];
        let share = Digits::Three.percent(count as f64 / visits.rays() as f64);
        format!("{} · {share}", grouped(count as usize))
    }

    /// The indentation and the triangle that folds and unfolds.
    fn fold(&mut self, ui: &mut egui::Ui, node: u32, depth: u32) {
        // The deepest node still has room for its name.
        let levels = self.tree.depth_reached().max(1);
        ui.add_space(depth as f32 * (64.0 / levels as f32).min(8.0));
        let size = egui::vec2(14.0, ui.available_height());
        let inner = matches!(self.tree.kind(node), NodeKind::Inner);
        if !inner || !self.rows.is_decided(self.tree, self.index, node) {
            ui.allocate_space(size);
            return;
        }
        let unfolded = self.rows.is_unfolded(node);
        let (_, response) = ui.allocate_exact_size(size, Sense::click());
        let verb = if unfolded { "Fold" } else { "Unfold" };
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Button, true, format!("{verb} node {node}"))
        });
        let icon = response.clone().with_new_rect(response.rect.shrink(2.0));
        egui::collapsing_header::paint_default_icon(ui, f32::from(u8::from(unfolded)), &icon);
        let action = if unfolded {
            "outline.fold"
        } else {
            "outline.unfold"
        };
        if response.on_hover_text(tip(verb, action)).clicked() {
            self.rows.set(self.tree, self.index, node, !unfolded);
        }
    }
}
