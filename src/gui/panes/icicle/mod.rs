//! The tree as an icicle: every node a piece of its parent's width, one row per depth.
//!
//! Pieces narrower than a pixel and a half are not drawn, nor is anything below them, so that a tree of
//! millions of nodes draws as fast as a small one.

use crate::gui::document::inspect::TreeKey;
use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::widgets::coloring_bar::color_bar;
use crate::gui::widgets::common::{no_picture, short, waiting};
use crate::gui::widgets::symbol::grouped;
use crate::gui::widgets::visits_note::visits_note;
use crate::jobs::PictureVisits;
use crate::present::number::{Digits, counted};
use crate::present::overlay::{COLORINGS, Coloring, Leaf};
use crate::structure::{Moment, NodeKind, Tree, TreeIndex};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, pos2, vec2};
use std::sync::Arc;

/// The narrowest piece that is drawn, in points.
const NARROWEST: f32 = 1.5;

/// The color of nodes while their visits are being counted, and of those not decided yet.
const UNKNOWN: [u8; 3] = [120; 3];

/// What a node's width stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Width {
    Leaves,
    Area,
}

/// The icicle's settings and its latest pieces.
pub struct Icicle {
    width: Width,
    coloring: &'static Coloring,
    /// The node that spans the whole width.
    top: u32,
    made: Option<(Key, Pieces)>,
    /// The values at the ends of the colors.
    range: Option<(RangeKey, [f64; 2])>,
}

impl Default for Icicle {
    fn default() -> Self {
        Icicle {
            width: Width::Leaves,
            coloring: &COLORINGS[0],
            top: 0,
            made: None,
            range: None,
        }
    }
}

/// What decides the values of the colors: tree, coloring, and for visits the picture's number.
type RangeKey = (TreeKey, &'static str, Option<u64>);

/// What decides the pieces.
#[derive(Clone, PartialEq)]
struct Key {
    values: RangeKey,
    width: Width,
    top: u32,
    area: Rect,
    moment: Option<Moment>,
}

/// What nodes are colored by.
struct Facts<'a> {
    index: &'a TreeIndex,
    visits: Option<&'a PictureVisits>,
    /// The moment of the build that is shown.
    moment: Option<Moment>,
}

/// The pieces that are drawn; those drawn later lie on top.
struct Pieces {
    rects: Vec<(Rect, u32)>,
    mesh: Arc<egui::Mesh>,
}

impl Pane for Icicle {
    const ID: &'static str = "icicle";
    const TITLE: &'static str = "Icicle";
    const ABOUT: &'static str = "The tree as nested bars, one row per depth.";
    const REVEALS: &'static [Fact] = &[Fact::AllCounters];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
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
        let another = |(made, _): &(Key, Pieces)| made.values.0 != key;
        if self.made.as_ref().is_none_or(another) {
            self.top = 0;
        }
        let visits = self
            .coloring
            .needs_visits()
            .then(|| doc.inspect.visits.of(current, &doc.jobs));
        let waits = matches!(visits, Some(None));
        let visits = visits.flatten();
        let facts = Facts {
            index: &index,
            visits: visits.as_deref(),
            moment: doc.inspect.build.moment(),
        };
        let values = (
            key,
            self.coloring.name,
            visits.as_ref().map(|_| current.number),
        );
        let range = self.range(&values, &facts);
        self.toolbar(ui, current.selection.node, &index);
        if waits {
            let note = ui.horizontal(|ui| visits_note(ui, &doc.inspect.visits, current));
            if note.inner {
                cx.edits.add(|doc| doc.inspect.visits.cancel_or_restart());
            }
        } else {
            self.legend(ui, range, &index);
        }
        let (outer, response) = ui.allocate_exact_size(
            crate::gui::widgets::common::rest_of(ui),
            Sense::click_and_drag(),
        );
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Icicle of the tree")
        });
        let area = Rect::from_min_max(outer.min + vec2(26.0, 0.0), outer.max);
        if !area.is_positive() {
            return;
        }
        let key = Key {
            values,
            width: self.width,
            top: self.top,
            area,
            moment: facts.moment,
        };
        let pieces = match self.made.take() {
            Some((made, pieces)) if made == key => pieces,
            _ => self.pieces(&tree, &facts, area, range),
        };
        let painter = ui.painter().with_clip_rect(outer);
        painter.add(egui::Shape::mesh(Arc::clone(&pieces.mesh)));
        self.labels(
            &painter,
            &tree,
            &index,
            &pieces,
            ui.visuals().text_color(),
            area,
        );
        let node_at = |at: egui::Pos2| {
            let hit = pieces
                .rects
                .iter()
                .rev()
                .find(|(rect, _)| rect.contains(at));
            hit.map(|(_, node)| *node)
        };
        if let Some(node) = response.interact_pointer_pos().and_then(node_at) {
            if response.double_clicked() {
                self.top = node;
            }
            if response.clicked() {
                cx.edits.add(move |doc| doc.select_node(Some(node)));
            }
        }
        if let Some(node) = current.selection.node {
            mark(&painter, &index, &pieces, node);
        }
        if let Some(node) = response.hover_pos().and_then(node_at) {
            response.on_hover_text_at_pointer(about(&tree, &index, node));
        }
        self.made = Some((key, pieces));
    }
}

impl Icicle {
    fn toolbar(&mut self, ui: &mut egui::Ui, selected: Option<u32>, index: &TreeIndex) {
        ui.horizontal(|ui| {
            ui.label("Width");
            for (width, name, about) in [
                (
                    Width::Leaves,
                    "by leaves",
                    "The width of a node is its number of leaves.",
                ),
                (
                    Width::Area,
                    "by area",
                    "The width of a node is divided between its children by their surface areas: by \
                     the chance that a ray meets them.",
                ),
            ] {
                ui.selectable_value(&mut self.width, width, name)
                    .on_hover_text(about);
            }
            egui::ComboBox::from_id_salt("icicle coloring")
                .selected_text(format!("Shade: {}", self.coloring.title))
                .width(120.0)
                .show_ui(ui, |ui| {
                    for coloring in COLORINGS {
                        let chosen = coloring.name == self.coloring.name;
                        if ui.selectable_label(chosen, coloring.title).clicked() {
                            self.coloring = coloring;
                        }
                    }
                })
                .response
                .on_hover_text("What colors the nodes; an inner node stands for all objects below it.");
            let to = selected.filter(|&node| node != self.top);
            if ui
                .add_enabled(to.is_some(), egui::Button::new("Zoom in"))
                .on_hover_text("Show the selected node in the whole width.\nAlso: double-click a node")
                .clicked()
                && let Some(node) = to
            {
                self.top = node;
            }
            if ui
                .add_enabled(self.top != 0, egui::Button::new("Zoom out"))
                .on_hover_text("Show the parent in the whole width.")
                .clicked()
            {
                self.top = index.of(self.top).parent;
            }
        });
    }

    /// What the colors mean, and how much of the tree is drawn.
    fn legend(&self, ui: &mut egui::Ui, range: [f64; 2], index: &TreeIndex) {
        ui.horizontal_wrapped(|ui| {
            let what = match self.coloring.unit {
                "" => self.coloring.title.to_owned(),
                unit => format!("{} ({unit})", self.coloring.title),
            };
            ui.label(what);
            color_bar(self.coloring, range, ui);
            if let Some((_, pieces)) = &self.made {
                ui.label(format!(
                    "{} of {} nodes drawn",
                    grouped(pieces.rects.len()),
                    grouped((index.of(self.top).end - self.top) as usize)
                ));
            }
        });
    }

    /// The values at the ends of the colors.
    fn range(&mut self, key: &RangeKey, facts: &Facts<'_>) -> [f64; 2] {
        if let Some((of, range)) = &self.range
            && of == key
        {
            return *range;
        }
        let nodes = 0..facts.index.len() as u32;
        let values = nodes.filter_map(|node| self.coloring.value(&facts.leaf_like(node)));
        let range = self.coloring.range(values);
        self.range = Some((key.clone(), range));
        range
    }

    fn pieces(&self, tree: &Tree, facts: &Facts<'_>, area: Rect, range: [f64; 2]) -> Pieces {
        let index = facts.index;
        let top = index.of(self.top).depth;
        let mut spans = Vec::new();
        let mut stack = vec![(self.top, area.left(), area.right())];
        while let Some((node, left, right)) = stack.pop() {
            spans.push((node, left, right));
            let share = |child: u32| match self.width {
                Width::Leaves => f64::from(index.of(child).leaves),
                Width::Area => index.of(child).area,
            };
            let all: f64 = tree.child_nodes(node).map(share).sum();
            let (first, mut sum) = (stack.len(), 0.0);
            for child in tree.child_nodes(node) {
                let from = left + (right - left) * (sum / all) as f32;
                sum += share(child);
                let to = left + (right - left) * (sum / all) as f32;
                if to - from >= NARROWEST {
                    stack.push((child, from, to));
                }
            }
            stack[first..].reverse();
        }
        // Rows that nothing is drawn in take no room.
        let depths = spans.iter().map(|&(node, ..)| index.of(node).depth - top);
        let height = area.height() / (depths.max().unwrap_or(0) + 1) as f32;
        let mut rects = Vec::with_capacity(spans.len());
        let mut mesh = egui::Mesh::default();
        for (node, left, right) in spans {
            let parent = index.of(node).parent;
            if node != 0 && !facts.is_decided(tree, parent) {
                continue;
            }
            let y = area.top() + height * (index.of(node).depth - top) as f32;
            let rect = Rect::from_min_max(pos2(left, y), pos2(right, y + height));
            let value = self.coloring.value(&facts.leaf_like(node));
            let value = value.filter(|_| facts.is_decided(tree, node));
            let [r, g, b] = value.map_or(UNKNOWN, |value| self.coloring.color(value, range));
            let gap = if rect.width() > 4.0 { 0.5 } else { 0.0 };
            let drawn = rect.shrink2(vec2(gap, if height > 4.0 { 0.5 } else { 0.0 }));
            mesh.add_colored_rect(drawn, Color32::from_rgb(r, g, b));
            if !facts.is_decided(tree, node) {
                // A hollow piece.
                let inside = drawn.shrink2(vec2(1.0, height * 0.25));
                mesh.add_colored_rect(inside, Color32::from_gray(30));
            }
            rects.push((rect, node));
        }
        Pieces {
            rects,
            mesh: Arc::new(mesh),
        }
    }

    /// Depths beside the rows, and values in the pieces that have room.
    fn labels(
        &self,
        painter: &egui::Painter,
        tree: &Tree,
        index: &TreeIndex,
        pieces: &Pieces,
        color: Color32,
        area: Rect,
    ) {
        let font = FontId::proportional(12.0);
        let Some((first, _)) = pieces.rects.first() else {
            return;
        };
        let height = first.height();
        let top = index.of(self.top).depth;
        let every = (15.0 / height).ceil().max(1.0) as u32;
        let rows = (area.height() / height).round() as u32;
        for row in (0..rows).step_by(every as usize) {
            let at = pos2(area.left() - 4.0, area.top() + height * (row as f32 + 0.5));
            let text = (top + row).to_string();
            painter.text(at, Align2::RIGHT_CENTER, text, font.clone(), color);
        }
        if height < 15.0 {
            return;
        }
        for (rect, node) in pieces.rects.iter().filter(|(rect, _)| rect.width() > 46.0) {
            let objects = index.of(*node).objects;
            let text = match tree.kind(*node) {
                NodeKind::Leaf { count: 0, .. } => "empty".to_owned(),
                _ if rect.width() > 80.0 => counted(objects as usize, "object"),
                _ => format!("{} obj.", grouped(objects as usize)),
            };
            // Readable on dark and on light pieces.
            let galley = painter.layout_no_wrap(text, font.clone(), Color32::WHITE);
            let place = Align2::CENTER_CENTER.anchor_size(rect.center(), galley.size());
            painter.rect_filled(place.expand(1.0), 2.0, Color32::from_black_alpha(150));
            painter.galley(place.min, galley, Color32::WHITE);
        }
    }
}

impl Facts<'_> {
    /// Whether a node was a leaf or split by the moment that is shown.
    fn is_decided(&self, tree: &Tree, node: u32) -> bool {
        let depth = self.index.of(node).depth;
        self.moment
            .is_none_or(|moment| tree.is_decided(node, depth, moment))
    }

    /// A node as colorings see it.
    fn leaf_like(&self, node: u32) -> Leaf {
        let facts = self.index.of(node);
        Leaf {
            depth: facts.depth,
            objects: facts.objects,
            volume: facts.volume,
            visits: self.visits.map(|visits| visits.by_node[node as usize]),
        }
    }
}

/// Outlines the selected node, or the nearest above it that is drawn.
fn mark(painter: &egui::Painter, index: &TreeIndex, pieces: &Pieces, node: u32) {
    let path = index.path_to(node);
    let drawn = path.iter().rev().find_map(|node| {
        let piece = pieces.rects.iter().find(|(_, drawn)| drawn == node);
        piece.map(|(rect, _)| *rect)
    });
    if let Some(rect) = drawn {
        let rect = rect.expand(1.0);
        for (width, color) in [(4.0, Color32::BLACK), (2.0, Color32::WHITE)] {
            painter.rect_stroke(
                rect,
                0.0,
                Stroke::new(width, color),
                egui::StrokeKind::Middle,
            );
        }
    }
}

/// A node in words.
fn about(tree: &Tree, index: &TreeIndex, node: u32) -> String {
    let facts = index.of(node);
    let kind = match (tree.kind(node), tree.plane(node)) {
        (NodeKind::Leaf { stop, .. }, _) => format!("a leaf: {}", stop.text()),
        (_, Some((axis, at))) => format!("split at {axis} = {at:.6}"),
        _ => {
            let children = tree.child_nodes(node);
            let objects = children.map(|child| grouped(index.of(child).objects as usize));
            let parts: Vec<String> = objects.collect();
            format!("divided into boxes of {} objects", parts.join(" + "))
        }
    };
    format!(
        "node {node}, depth {}, {kind}\n{}, {}\nvolume {}, area {} of the root's",
        facts.depth,
        counted(facts.objects as usize, "object"),
        counted(facts.leaves as usize, "leaf"),
        short(facts.volume),
        Digits::Four.percent(facts.area / index.of(0).area),
    )
}
