//! What splitting the selected node costs at every plane along x, y and z, with the plane chosen
//! and a plane of one's own to try. In a hierarchy, a plane divides the objects by their centers into two boxes.

use crate::geometry::Axis;
use crate::gui::action::{Gesture, actions, tip};
use crate::gui::document::inspect::{TreeKey, WhatIf};
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::{no_picture, short, waiting};
use crate::gui::widgets::linear_axis::Marks;
use crate::gui::widgets::symbol::grouped;
use crate::present::number::{Digits, counted};
use crate::structure::{NodeCost, SplitCost};
use egui::{Color32, vec2};
use egui_plot::{AxisHints, HLine, LineStyle, Plot, PlotPoint, Text, VLine};
use std::sync::Arc;

/// Points of a drawn curve: more than a screen is wide.
const MOST_POINTS: usize = 3000;

const CHOSEN: Color32 = Color32::from_rgb(20, 150, 220);
const TRIED: Color32 = Color32::from_rgb(230, 110, 40);

/// The curves of the latest node, ready to draw.
#[derive(Default)]
pub struct CostPane {
    drawn: Option<Drawn>,
}

/// Curves of one node of one tree.
struct Drawn {
    of: (TreeKey, u32),
    curves: [Vec<[f64; 2]>; 3],
    highest: f64,
}

impl Pane for CostPane {
    const ID: &'static str = "split-cost";
    const TITLE: &'static str = "Split cost";
    const ABOUT: &'static str = "The cost of every split of the selected node.";
    const REVEALS: &'static [Fact] = &[Fact::Tree];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "split-cost.undo-what-if" Here NONE [Delete] "Remove the tried split" => |_, cx| cx.edits.add(|doc| doc.inspect.what_if = None);
    };
    const GESTURES: &'static [Gesture] = &[Gesture {
        gesture: "Drag",
        about: "Try a split; it changes no tree",
    }];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let Some(current) = &doc.current else {
            no_picture(ui, doc);
            return;
        };
        let Some(node) = current.selection.node else {
            ui.weak("Select a node: in the outline, in 3D or in the icicle.");
            return;
        };
        let Some(cost) = doc.inspect.cost(current, node, ui.ctx()) else {
            waiting(ui);
            return;
        };
        let of = (TreeKey(Arc::clone(&current.shown.tree)), node);
        if self.drawn.as_ref().is_none_or(|drawn| drawn.of != of) {
            self.drawn = Some(Drawn::new(of, &cost));
        }
        let Some(drawn) = &self.drawn else {
            return;
        };
        let before = doc.inspect.what_if;
        let mut tried = before;
        words(ui, &cost, &mut tried);
        if cost.objects == 0 {
            ui.weak("The node is empty: there is nothing to split.");
            tried = None;
        } else {
            let size = crate::gui::widgets::common::rest_of(ui);
            let size = vec2(((size.x - 16.0) / 3.0).max(60.0), size.y - 4.0);
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 8.0;
                for axis in Axis::ALL {
                    if let Some(plane) = drawn.plot(ui, axis, size, &cost, tried) {
                        tried = Some(WhatIf { node, axis, plane });
                    }
                }
            });
        }
        if tried != before {
            cx.edits.add(move |doc| doc.inspect.what_if = tried);
        }
    }
}

/// The numbers of the node, of the plane chosen and of the plane tried, on lines of their own.
fn words(ui: &mut egui::Ui, cost: &NodeCost, tried: &mut Option<WhatIf>) {
    let leaf = cost.leaf_cost();
    let chosen = match (&cost.chosen, &cost.division) {
        (Some((axis, chosen)), _) => Some((plane_text(cost, *axis, chosen), chosen.cost)),
        (None, Some(division)) => {
            let parts: Vec<_> = division.objects.iter().map(|&n| grouped(n)).collect();
            let parts = parts.join(" + ");
            let text = format!("{parts} objects, cost {} tests", short(division.cost));
            Some((text, division.cost))
        }
        (None, None) => None,
    };
    let text = match &chosen {
        Some((text, chosen)) => format!(
            "node {}: chosen {text} · {} compared with the leaf's {} tests",
            cost.node,
            Digits::Three.signed_percent((chosen - leaf) / leaf.max(1.0)),
            short(leaf),
        ),
        None => format!(
            "node {}: a leaf with {} costs {} tests{}",
            cost.node,
            counted(cost.objects, "object"),
            short(leaf),
            cost.cheapest()
                .map(|(axis, s)| format!("; the cheapest split is {}", plane_text(cost, axis, &s)))
                .unwrap_or_default(),
        ),
    };
    let about = if cost.has_boxes {
        format!(
            "Cost: intersection tests that a ray through the box is expected to make if both parts \
             become leaves (MacDonald and Booth 1990), and {} for the tests of their boxes. The objects \
             are sorted by the centers of their bounds; every object is in one part.",
            short(cost.traversal)
        )
    } else {
        "Cost: intersection tests that a ray through the cell is expected to make if both parts \
         become leaves (MacDonald and Booth 1990). Objects count by their bounds; those that meet the \
         plane count on both sides."
            .to_owned()
    };
    ui.add(egui::Label::new(&text).wrap()).on_hover_text(about);
    let chosen = chosen.map(|(_, cost)| cost);
    let (what, try_it) = if cost.has_boxes {
        (
            "the chosen boxes",
            "Drag or click in a curve to try other boxes.",
        )
    } else {
        (
            "the chosen plane",
            "Drag or click in a curve to try a plane.",
        )
    };
    ui.horizontal_wrapped(|ui| {
        let some = tried.is_some();
        if ui
            .add_enabled(some, egui::Button::new("Undo what-if"))
            .on_hover_text(tip("Remove the tried split.", "split-cost.undo-what-if"))
            .clicked()
        {
            *tried = None;
        }
        ui.label(match tried {
            Some(what_if) => {
                let s = cost.curves[what_if.axis.index()].at(what_if.plane);
                let (other, than) = match chosen {
                    Some(chosen) => (chosen, what),
                    None => (leaf, "the leaf"),
                };
                let sign = if s.cost > other { "more" } else { "fewer" };
                format!(
                    "what if {} · {} tests {sign} than {than}",
                    plane_text(cost, what_if.axis, &s),
                    short((s.cost - other).abs())
                )
            }
            None => try_it.to_owned(),
        });
    });
}

/// A split with its cost in words.
fn plane_text(cost: &NodeCost, axis: Axis, s: &SplitCost) -> String {
    let [below, above] = s.objects;
    if cost.has_boxes {
        return format!(
            "centers at {axis} = {:.5}: {} + {} objects, cost {} tests",
            s.plane,
            grouped(below),
            grouped(above),
            short(s.cost)
        );
    }
    format!(
        "{axis} = {:.5}: {} below, {} above, cost {} tests",
        s.plane,
        grouped(below),
        grouped(above),
        short(s.cost)
    )
}

impl Drawn {
    fn new(of: (TreeKey, u32), cost: &NodeCost) -> Self {
        let curves = Axis::ALL.map(|axis| {
            let samples = cost.curves[axis.index()].simplified(MOST_POINTS);
            samples
                .into_iter()
                .map(|s| [s.plane, s.cost])
                .collect::<Vec<_>>()
        });
        let highest = curves
            .iter()
            .flatten()
            .map(|[_, cost]| *cost)
            .fold(cost.leaf_cost(), f64::max);
        Drawn {
            of,
            curves,
            highest,
        }
    }

    /// One axis; gives the plane that the pointer tries.
    fn plot(
        &self,
        ui: &mut egui::Ui,
        axis: Axis,
        size: egui::Vec2,
        cost: &NodeCost,
        tried: Option<WhatIf>,
    ) -> Option<f64> {
        let curve = &cost.curves[axis.index()];
        let [lo, hi] = curve.range;
        let color = ui.visuals().text_color();
        let top = self.highest * 1.3;
        let chosen = cost.chosen.filter(|(of, _)| *of == axis);
        let what_if = tried.filter(|tried| tried.axis == axis);
        let plot = Plot::new(("cost", axis.index()))
            .width(size.x)
            .height(size.y)
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .allow_axis_zoom_drag(false)
            .show_x(false)
            .show_y(false)
            .label_formatter(move |_| None);
        // The three plots have the same height only if all have numbers below.
        let across = Marks::new([lo, hi], size.x / 64.0);
        let up = Marks::new([0.0, top], size.y / 32.0);
        let below = AxisHints::new_x()
            .label(format!("{axis} in units of length"))
            .label_spacing(20.0..=30.0)
            .formatter(move |mark, _| across.text(mark.value));
        let left = AxisHints::new_y()
            .label("tests")
            .min_thickness(40.0)
            .label_spacing(12.0..=16.0)
            .formatter(move |mark, _| up.text(mark.value));
        let plot = plot
            .x_grid_spacer(move |_| across.all())
            .y_grid_spacer(move |_| up.all())
            .custom_x_axes(vec![below])
            .custom_y_axes(vec![left]);
        let shown = plot.show(ui, |plot| {
            // Room for the labels on top.
            plot.set_plot_bounds_x(lo..=hi);
            plot.set_plot_bounds_y(0.0..=top);
            let leaf = cost.leaf_cost();
            let dashed = LineStyle::dashed_loose();
            plot.hline(HLine::new("leaf", leaf).color(color).style(dashed));
            let mut label = |x: f64, y: f64, text: &str, color: Color32| {
                // Labels stay inside: on the right half they end at their line.
                let anchor = if x > (lo + hi) * 0.5 + (hi - lo) * 0.1 {
                    egui::Align2::RIGHT_BOTTOM
                } else {
                    egui::Align2::LEFT_BOTTOM
                };
                let text = egui::RichText::new(text).size(12.0);
                let text = Text::new("label", PlotPoint::new(x, y), text);
                plot.text(text.color(color).anchor(anchor));
            };
            label(hi, leaf, "as a leaf ", color);
            label(curve.spatial_median, top * 0.0, " middle", color);
            if let Some(median) = curve.object_median {
                let what = if cost.has_boxes {
                    " median center "
                } else {
                    " object median "
                };
                label(median, top * 0.075, what, color);
            }
            if let Some((_, s)) = chosen {
                label(s.plane, top * 0.93, " chosen ", CHOSEN);
            }
            if let Some(tried) = what_if {
                label(tried.plane, top * 0.85, " what if ", TRIED);
            }
            let dotted = LineStyle::dotted_dense();
            plot.vline(
                VLine::new("middle", curve.spatial_median)
                    .color(color)
                    .style(dashed),
            );
            if let Some(median) = curve.object_median {
                plot.vline(
                    VLine::new("object median", median)
                        .color(color)
                        .style(dotted),
                );
            }
            if let Some((_, s)) = chosen {
                plot.vline(VLine::new("chosen", s.plane).color(CHOSEN).width(2.5));
            }
            if let Some(tried) = what_if {
                plot.vline(VLine::new("what if", tried.plane).color(TRIED).width(2.5));
            }
        });
        // A piece at a time: a line that turns back on itself, as at jumps, gets spikes.
        let painter = ui.painter().with_clip_rect(*shown.transform.frame());
        for pair in self.curves[axis.index()].windows(2) {
            let ends = [pair[0], pair[1]].map(|[plane, cost]| {
                shown
                    .transform
                    .position_from_point(&PlotPoint::new(plane, cost))
            });
            painter.line_segment(ends, egui::Stroke::new(1.5, color));
        }
        let response = shown.response;
        response.widget_info(|| {
            let name = format!("Cost along {axis}");
            egui::WidgetInfo::labeled(egui::Role::Canvas, true, name)
        });
        let plane_at = |at: egui::Pos2| shown.transform.value_from_position(at).x.clamp(lo, hi);
        // A quick drag moves in the frame in which the button is released, too.
        let tries = response.dragged() || response.drag_stopped() || response.clicked();
        let pointer = response.interact_pointer_pos();
        let tried = pointer.filter(|_| tries).map(plane_at);
        if let Some(at) = response.hover_pos().or(pointer).map(plane_at) {
            response.on_hover_text_at_pointer(plane_text(cost, axis, &curve.at(at)));
        }
        tried
    }
}
