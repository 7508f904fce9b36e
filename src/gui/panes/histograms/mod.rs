//! Histograms of the leaves and of the rays. Dragging over bars of leaves selects leaves: the 3D view
//! shows them alone. Dragging over bars of rays selects pixels: the picture marks them.

mod plot;

use crate::gui::action::{Gesture, actions, tip};
use crate::gui::document::inspect::{Inspect, LeavesKey, TreeKey};
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::theme::strong;
use crate::gui::widgets::common::{no_picture, waiting};
use crate::gui::widgets::symbol::grouped;
use crate::gui::widgets::visits_note::visits_note;
use crate::present::overlay::{Bars, HISTOGRAMS, Leaf, NODES_PER_RAY, Ranges, ray_bars};
use egui::vec2;
use plot::Plot;
use std::sync::Arc;

/// The histograms of the latest tree and picture.
#[derive(Default)]
pub struct Histograms {
    bars: Option<(LeavesKey, Vec<Bars>)>,
    /// The bar where a drag began.
    from: usize,
    /// Whether heights go by the logarithm, so that low bars are seen beside high ones.
    log: bool,
}

/// The most bars that can be told apart in a third of a narrow pane.
const MOST_BARS: usize = 36;

/// The least width of a histogram beside others, in points.
const LEAST_WIDTH: f32 = 224.0;

impl Pane for Histograms {
    const ID: &'static str = "histograms";
    const TITLE: &'static str = "Histograms";
    const ALIASES: &'static [&'static str] = &["Leaf histograms"];
    const ABOUT: &'static str = "How leaves and rays are distributed; drag to select.";
    const REVEALS: &'static [Fact] = &[Fact::AllCounters];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "histograms.clear-ranges" Here NONE [Delete] "Select all leaves again" => |_, cx| cx.edits.add(|doc| doc.inspect.clear_ranges());
    };
    const GESTURES: &'static [Gesture] = &[Gesture {
        gesture: "Drag",
        about: "Select the leaves of these bars; click: of one bar, again: of all",
    }];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let Some(current) = &doc.current else {
            no_picture(ui, doc);
            return;
        };
        let visits = doc.inspect.visits.of(current, &doc.jobs);
        let Some(leaves) = doc.inspect.leaves(current, visits.as_ref(), ui.ctx()) else {
            waiting(ui);
            return;
        };
        let tree = &current.shown.tree;
        let picture = visits.as_ref().map(|_| current.number);
        let key = (TreeKey(Arc::clone(tree)), picture);
        if self.bars.as_ref().is_none_or(|(of, _)| *of != key) {
            let of_leaves = HISTOGRAMS.iter().map(|h| h.bars(&leaves, MOST_BARS));
            let of_rays = visits.iter().map(|visits| ray_bars(visits, MOST_BARS));
            self.bars = Some((key, of_leaves.chain(of_rays).collect()));
        }
        let selected = doc.inspect.selected_leaves(&leaves);
        ui.horizontal_wrapped(|ui| {
            self.toolbar(ui, &doc.inspect, selected, cx.edits);
            if visits_note(ui, &doc.inspect.visits, current) {
                cx.edits.add(|doc| doc.inspect.visits.cancel_or_restart());
            }
        });
        let node = current.selection.node;
        let marked = node.and_then(|node| {
            let cell = tree.cell_of(node);
            Leaf::of(tree, &cell, visits.as_deref().map(|v| &v.visits))
        });
        let before = (doc.inspect.ranges, doc.inspect.nodes_a_ray);
        let mut after = before;
        self.plots(ui, marked, &mut after);
        if after != before {
            cx.edits
                .add(move |doc| (doc.inspect.ranges, doc.inspect.nodes_a_ray) = after);
        }
    }
}

impl Histograms {
    fn toolbar(
        &mut self,
        ui: &mut egui::Ui,
        inspect: &Inspect,
        [selected, of]: [usize; 2],
        edits: &mut Edits,
    ) {
        ui.label(strong(format!(
            "{} of {} leaves selected",
            grouped(selected),
            grouped(of)
        )));
        let some = inspect.ranges.iter().any(Option::is_some) || inspect.nodes_a_ray.is_some();
        if ui
            .add_enabled(some, egui::Button::new("Clear ranges"))
            .on_hover_text(tip(
                "Select all leaves and rays again.",
                "histograms.clear-ranges",
            ))
            .clicked()
        {
            edits.add(|doc| doc.inspect.clear_ranges());
        }
        ui.checkbox(&mut self.log, "Log heights").on_hover_text(
            "The height of a bar is the logarithm of its count, so that short bars can be seen beside \
             tall ones. Within a bar, the filled part is the share of full leaves.",
        );
        ui.label("filled: full leaves, rays · hollow: empty leaves · drag to select");
    }

    /// Shows the histograms of the leaves and that of the rays.
    fn plots(
        &mut self,
        ui: &mut egui::Ui,
        marked: Option<Leaf>,
        (ranges, nodes_a_ray): &mut (Ranges, Option<[f64; 2]>),
    ) {
        let Some((_, all)) = &self.bars else {
            return;
        };
        let nothing = Bars {
            start: 0.0,
            width: 1.0,
            counts: Vec::new(),
        };
        let plots: Vec<_> = HISTOGRAMS
            .iter()
            .map(|histogram| {
                (
                    &histogram.axis,
                    marked.and_then(|leaf| histogram.value(&leaf)),
                )
            })
            .chain([(&NODES_PER_RAY, None)])
            .collect();
        let mut ranges: Vec<_> = ranges.iter_mut().chain([nodes_a_ray]).collect();
        let size = crate::gui::widgets::common::rest_of(ui);
        let gap = 8.0;
        let columns = ((size.x / LEAST_WIDTH) as usize).clamp(1, plots.len());
        let rows = plots.len().div_ceil(columns);
        let width = (size.x + gap) / columns as f32 - gap;
        let height = ((size.y + gap) / rows as f32 - gap).max(80.0);
        ui.spacing_mut().item_spacing = vec2(gap, gap);
        egui::ScrollArea::vertical().show(ui, |ui| {
            for first in (0..plots.len()).step_by(columns) {
                ui.horizontal(|ui| {
                    for i in first..(first + columns).min(plots.len()) {
                        let (axis, marked) = plots[i];
                        let plot = Plot {
                            axis,
                            bars: all.get(i).unwrap_or(&nothing),
                            log: self.log,
                            marked,
                            selects_pixels: i >= HISTOGRAMS.len(),
                        };
                        plot.ui(ui, vec2(width, height), ranges[i], &mut self.from);
                    }
                });
            }
        });
    }
}
