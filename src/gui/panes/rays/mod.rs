//! The tree of rays of the picked pixel as an outline, and what they sum to.

mod pixel;

use crate::gui::action::shortcut;
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::widgets::rows::{Column, List, Row, chip};
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::measure::heat::RayFilter;
use crate::present::overlay::ray_style;
use crate::scene::Scene;
use crate::trace::{RayKind, RecordedRay, Tally};
use egui::{Rect, pos2, vec2};

/// With less room, in points, nothing is shown.
const LEAST_HEIGHT: f32 = 140.0;

/// The height of a row in points.
const ROW: f32 = 21.0;

const COLUMNS: &[Column] = &[
    Column {
        title: "ray",
        about: "Indented below the ray from whose hit it starts",
        width: 92.0,
    },
    Column {
        title: "nodes",
        about: "Inner nodes traversed",
        width: 44.0,
    },
    Column {
        title: "leaves",
        about: "Leaves visited, empty ones included",
        width: 44.0,
    },
    Column {
        title: "tests",
        about: "Intersection tests",
        width: 38.0,
    },
    Column {
        title: "weight",
        about: "Its share of the pixel's color; for a shadow ray what the light \
                adds if it is reached: the largest of red, green and blue",
        width: 50.0,
    },
    Column {
        title: "ends at",
        about: "What it hits, or where it goes. A shadow ray ends at the object that blocks the light, \
                or at the light",
        width: 80.0,
    },
];

const TOTALS: &[Column] = &[
    Column {
        title: "totals",
        about: "Sums over the rays of a kind, as the counting kernel has them for this pixel",
        width: 84.0,
    },
    Column {
        title: "rays",
        about: "Rays formed",
        width: 40.0,
    },
    Column {
        title: "hits",
        about: "Rays that hit an object; shadow rays that are blocked",
        width: 40.0,
    },
    Column {
        title: "tests",
        about: "Intersection tests",
        width: 52.0,
    },
    Column {
        title: "nodes",
        about: "Inner nodes traversed",
        width: 56.0,
    },
    Column {
        title: "leaves",
        about: "Leaves visited, empty ones included",
        width: 52.0,
    },
    Column {
        title: "empty",
        about: "Empty leaves visited",
        width: 50.0,
    },
];

/// How far a ray is indented below its parent, in points, and at most.
const INDENT: f32 = 8.0;
const MOST_INDENT: f32 = 36.0;

#[derive(Default)]
pub struct RaysPane;

impl Pane for RaysPane {
    const ID: &'static str = "rays";
    const TITLE: &'static str = "Rays of the pixel";
    const ALIASES: &'static [&'static str] = &["Picked pixel"];
    const ABOUT: &'static str = "The picked pixel, its rays and what they did.";
    const REVEALS: &'static [Fact] = &[Fact::Rays, Fact::Steps];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        // Below the picture there may be no room; *Steps of the ray* has a list of the rays, too.
        if ui.clip_rect().bottom() - ui.cursor().top() < LEAST_HEIGHT {
            return;
        }
        pixel::show(ui, doc);
        ui.add_space(8.0);
        show(ui, doc, cx.edits);
    }
}

fn show(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let Some(current) = &doc.current else {
        return;
    };
    let Some(picked) = &current.picked else {
        return;
    };
    let (record, scene) = (&picked.record, &current.shown.scene);
    let n = record.rays.len();
    ui.horizontal(|ui| {
        ui.label(step_text::count(n as u32, "ray", "rays")).on_hover_text(format!(
            "Of the pixel's first sample, with up to {} bounces (D_AREC).\nShortcuts: {} and {} select a ray",
            current.shown.setup.render.d_arec,
            shortcut("ray.previous-ray"),
            shortcut("ray.next-ray")
        ));
        if record.cut {
            ui.strong("cut short: there are too many to keep");
        } else if let Some(counts) = &current.pixel_counts {
            // The same rays, counted apart from this record.
            let [x, y] = picked.pixel;
            let place = y as usize * current.shown.setup.render.width as usize + x as usize;
            if counts.tally(place, RayFilter::All) == record.tallies().into_iter().sum() {
                ui.weak("· sums equal those of the counting kernel");
            } else {
                ui.strong("· sums differ from those of the counting kernel");
            }
        }
    });
    let list = List {
        name: "rays",
        columns: COLUMNS,
        rows: n,
        selected: Some(picked.ray),
        most: 8,
        row: ROW,
    };
    let clicked = list.show(
        ui,
        |i| row(scene, i, &record.rays[i]),
        |i, painter, rect, color| {
            let kind = record.rays[i].path.kind;
            let at = pos2(rect.left() + indent(&record.rays[i]), rect.top() + 2.0);
            let chip_rect = Rect::from_min_size(at, vec2(14.0, rect.height() - 4.0));
            chip(painter, chip_rect, letter(kind), ray_style(kind).color);
            let name = at + vec2(18.0, chip_rect.height() * 0.5);
            let font = egui::FontId::proportional(12.5);
            let left = egui::Align2::LEFT_CENTER;
            painter
                .with_clip_rect(rect.intersect(painter.clip_rect()))
                .text(name, left, kind.name(), font, color);
        },
    );
    totals(ui, &record.tallies());
    if let Some(ray) = clicked {
        edits.add(move |doc| {
            if let Some(current) = &mut doc.current {
                current.select_ray(ray);
            }
        });
    }
}

fn indent(ray: &RecordedRay) -> f32 {
    let level = ray.depth + u32::from(ray.path.kind == RayKind::Shadow);
    (level as f32 * INDENT).min(MOST_INDENT)
}

const fn letter(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "P",
        RayKind::Shadow => "S",
        RayKind::Reflected => "R",
        RayKind::Refracted => "T",
    }
}

fn row(scene: &Scene, i: usize, ray: &RecordedRay) -> Row {
    let (path, counts) = (&ray.path, ray.path.counts());
    let weight = percent(ray.weight.max_element());
    let outcome = step_text::outcome(scene, path);
    let from = ray.parent.map_or_else(String::new, |parent| {
        format!(", from the hit of ray {}", parent + 1)
    });
    Row {
        label: format!(
            "Ray {}: {}{from}: {outcome}; {}, {} ({} empty), {}{}, weight {weight}",
            i + 1,
            path.kind.name(),
            step_text::count(counts.inner_nodes, "inner node", "inner nodes"),
            step_text::count(counts.leaves, "leaf", "leaves"),
            counts.empty_leaves,
            step_text::count(counts.tests, "test", "tests"),
            box_tests(counts.box_tests.into(), counts.culled.into()),
        ),
        cells: vec![
            String::new(),
            grouped(counts.inner_nodes as usize),
            grouped(counts.leaves as usize),
            grouped(counts.tests as usize),
            weight,
            match (path.kind, path.hit.is_hit()) {
                (_, true) => step_text::object(scene, path.hit.object),
                (RayKind::Shadow, false) => "light".to_owned(),
                (_, false) => "background".to_owned(),
            },
        ],
    }
}

/// What only rays in a hierarchy do, to end a list; empty in a tree of planes.
fn box_tests(tests: u64, culled: u64) -> String {
    if tests == 0 {
        return String::new();
    }
    let [tests, culled] = [tests, culled].map(|n| grouped(n as usize));
    format!(", {tests} box tests, {culled} culled")
}

fn percent(share: f64) -> String {
    match share * 100.0 {
        p if p >= 10.0 => format!("{p:.0} %"),
        p if p >= 0.1 => format!("{p:.1} %"),
        p if p > 0.0 => "<0.1 %".to_owned(),
        _ => "0 %".to_owned(),
    }
}

/// A row for every kind and one for all.
fn totals(ui: &mut egui::Ui, tallies: &[Tally<u32>; 4]) {
    let all: Tally = tallies.iter().copied().sum();
    let rows: Vec<(&str, Tally)> = RayKind::ALL
        .into_iter()
        .map(|kind| (kind.name(), [tallies[kind as usize]].into_iter().sum()))
        .chain([("all", all)])
        .collect();
    ui.add_space(3.0);
    let list = List {
        name: "totals",
        columns: TOTALS,
        rows: rows.len(),
        selected: None,
        most: rows.len(),
        row: ROW,
    };
    list.show(
        ui,
        |i| {
            let (name, t) = rows[i];
            let numbers = [
                t.rays,
                t.hits,
                t.tests,
                t.inner_nodes,
                t.leaves,
                t.empty_leaves,
            ];
            let mut cells = vec![name.to_owned()];
            cells.extend(numbers.map(|n| grouped(n as usize)));
            Row {
                label: format!(
                    "Total of {name}: {} rays, {} hits, {} tests, {} inner nodes, {} leaves, {} \
                     empty leaves{}",
                    t.rays,
                    t.hits,
                    t.tests,
                    t.inner_nodes,
                    t.leaves,
                    t.empty_leaves,
                    box_tests(t.box_tests, t.culled)
                ),
                cells,
            }
        },
        |_, _, _, _| {},
    );
}
