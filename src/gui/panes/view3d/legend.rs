//! What the colors and lines of the 3D view mean.

use super::settings::Settings;
use crate::gui::action::tip;
use crate::gui::document::picked::Picked;
use crate::gui::widgets::coloring_bar::color_bar;
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::{
    CULLED, INTERVAL, LeafBoxes, Outside, RaysShown, Visited, WAITING, order_color, ray_style,
};
use crate::trace::{RayKind, Step};
use egui::{Color32, Rect, vec2};

/// In a view of this height, in points, the whole legend hides little.
const ROOMY: f32 = 640.0;

/// What the first line of a legend is about.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Headline {
    /// No cells are drawn.
    None,
    /// Cells are being made.
    Waiting,
    /// Cells in the colors of a property.
    Boxes,
    /// The leaves of the selected ray.
    OfRay,
}

/// What a legend tells.
pub struct Legend<'a> {
    pub settings: &'a Settings,
    pub headline: Headline,
    /// Whether the picture's camera is drawn.
    pub pyramid: bool,
    pub boxes: Option<&'a LeafBoxes>,
    /// What is to be done before there can be boxes.
    pub waits_for: Option<&'a str>,
    /// How many of the boxes are drawn.
    pub drawn: u32,
    pub picked: Option<&'a Picked>,
    /// What the marks of the selection mean.
    pub marks: Vec<String>,
    /// Objects that were left out.
    pub left_out: usize,
    /// Whether it is unfolded; folded, it tells what the colors mean.
    pub open: bool,
}

/// Whether an unfolded legend leaves most of a view to be seen.
pub fn fits(view: Rect) -> bool {
    view.width() >= 340.0 && view.height() >= 420.0
}

/// Shows the legend in the lower left corner of the view; says whether it is to be folded or unfolded.
pub fn show(legend: &Legend<'_>, ui: &mut egui::Ui, view: Rect) -> bool {
    /// Around the contents.
    const MARGIN: f32 = 6.0;
    // The ground is dark in both themes, and so is the legend.
    let visuals = ui.ctx().style_of(egui::Theme::Dark).visuals.clone();
    // Its height is known once it was laid out: the last frame's tells where it begins.
    let id = ui.scope_id().with("legend height");
    let height = ui.data(|data| data.get_temp::<f32>(id)).unwrap_or(100.0);
    let corner = view.left_bottom() + vec2(8.0, -8.0 - height);
    let space = Rect::from_min_max(corner, view.right_bottom());
    let builder = egui::UiBuilder::new()
        .max_rect(space)
        .layout(egui::Layout::top_down(egui::Align::LEFT));
    let shown = ui.scope_builder(builder, |ui| {
        *ui.visuals_mut() = visuals;
        ui.shrink_clip_rect(view);
        egui::Frame::new()
            .fill(Color32::from_black_alpha(190))
            .corner_radius(4)
            .inner_margin(MARGIN)
            .show(ui, |ui| {
                ui.set_max_width((view.width() - 30.0).clamp(80.0, 330.0));
                ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Wrap);
                ui.spacing_mut().item_spacing.y = 2.0;
                let most = (view.height() - 16.0 - 2.0 * MARGIN).max(20.0);
                egui::ScrollArea::vertical()
                    .max_height(most)
                    .min_scrolled_height(most)
                    .show(ui, |ui| contents(legend, view.height() > ROOMY, ui))
                    .inner
            })
    });
    let now = shown.inner.response.rect.height();
    if now != height {
        ui.data_mut(|data| data.insert_temp(id, now));
        ui.ctx().request_repaint();
    }
    shown.inner.inner
}

/// The whole legend, or its colors alone; whether the button that folds it was clicked. `roomy` where
/// there is room for all of it without hiding the view.
fn contents(legend: &Legend<'_>, roomy: bool, ui: &mut egui::Ui) -> bool {
    let coloring = legend.settings.coloring;
    let folds = ui
        .horizontal(|ui| {
            let folds = fold_button(legend.open, ui);
            match legend.headline {
                Headline::Boxes if coloring.unit.is_empty() => {
                    ui.strong(format!("Leaves by {}", coloring.title.to_lowercase()));
                }
                Headline::Boxes => {
                    ui.strong(format!("{} ({})", coloring.title, coloring.unit));
                }
                Headline::OfRay => {
                    ui.strong("Leaves visited by the selected ray");
                }
                Headline::Waiting => {
                    ui.label(legend.waits_for.unwrap_or("Preparing the leaf boxes …"));
                }
                Headline::None => {
                    ui.label("Leaf boxes are not shown");
                }
            }
            folds
        })
        .inner;
    if let Some(boxes) = legend.boxes {
        color_bar(coloring, boxes.range, ui);
    }
    if legend.open {
        lines(legend, roomy, ui);
    }
    folds
}

/// The triangle that folds or unfolds the legend; whether it was clicked.
fn fold_button(open: bool, ui: &mut egui::Ui) -> bool {
    let (_, response) = ui.allocate_exact_size(vec2(14.0, 14.0), egui::Sense::click());
    let name = if open {
        "Fold the legend"
    } else {
        "Unfold the legend"
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    let icon = response.clone().with_new_rect(response.rect.shrink(2.0));
    egui::collapsing_header::paint_default_icon(ui, f32::from(u8::from(open)), &icon);
    let about = "All that the colors, lines and boxes of the view mean, or the colors alone.";
    let response = response.on_hover_text(tip(about, "view3d.fold-legend"));
    response.clicked()
}

/// What else there is to say of boxes, rays and marks.
fn lines(legend: &Legend<'_>, roomy: bool, ui: &mut egui::Ui) {
    if let Some(boxes) = legend.boxes {
        ui.label("solid edges: full leaf · dashed edges: empty leaf");
        let visited = legend.settings.filter.visited;
        if visited != Visited::Either {
            ui.label(format!("leaves shown: {}", visited.title().to_lowercase()));
        }
        if let Some(node) = legend.settings.focus {
            ui.label(match legend.settings.outside {
                Outside::Hidden => format!("only below node {node}"),
                _ => format!("bright: below node {node}; faint: all others"),
            });
        }
        if boxes.undecided > 0 {
            ui.label(format!(
                "dotted white: {} not decided yet",
                step_text::count(boxes.undecided as u32, "cell", "cells")
            ));
        }
        let shown = boxes.instances.len() - boxes.undecided - boxes.coarse;
        let shown = format!(
            "{} of {} leaves shown",
            grouped(shown),
            grouped(boxes.leaves)
        );
        ui.label(match (legend.settings.drawn().to_depth, boxes.coarse) {
            (None, _) | (_, 0) => shown,
            (Some(_), cells) if legend.settings.focus.is_some() => format!(
                "{} that are split further, {shown}",
                step_text::count(cells as u32, "cell", "cells")
            ),
            (Some(depth), cells) => format!(
                "{} at depth {depth} that are split further, {shown}",
                step_text::count(cells as u32, "cell", "cells")
            ),
        });
        if (legend.drawn as usize) < boxes.instances.len() {
            ui.label(format!(
                "drawn by the processor: {} of them",
                grouped(legend.drawn as usize)
            ));
        }
    }
    if let Some(picked) = legend.picked {
        egui::CollapsingHeader::new("Lines of the rays")
            // Whether it was opened counts for views of this size alone.
            .id_salt(roomy)
            .default_open(roomy)
            .show_unindented(ui, |ui| path_key(legend, picked, ui));
    }
    for line in &legend.marks {
        ui.label(line);
    }
    if legend.pyramid {
        ui.label("white pyramid: the picture's camera");
    }
    if legend.left_out > 0 {
        ui.label(format!(
            "{} objects left out: too many for the graphics card",
            grouped(legend.left_out)
        ));
    }
}

/// What is drawn of the picked pixel's rays and of the current step.
fn path_key(legend: &Legend<'_>, picked: &Picked, ui: &mut egui::Ui) {
    let path = picked.path();
    let n = path.leaves().count();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        for i in 0..6 {
            let [r, g, b] = order_color(i, 6);
            let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), egui::Sense::hover());
            ui.painter()
                .rect_filled(rect, 0.0, Color32::from_rgb(r, g, b));
        }
        ui.add_space(6.0);
        ui.label(match n {
            0 => "the selected ray visits no leaf".to_owned(),
            1 => "the 1 leaf visited by the selected ray".to_owned(),
            _ => format!("leaves visited by the ray, 1 to {n} in order"),
        });
    });
    ui.label("thick: the selected ray · white box: the object hit");
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let kinds = RayKind::ALL.into_iter().filter(|kind| {
            let mut rays = picked.record.rays.iter();
            legend.settings.all_rays && rays.any(|ray| ray.path.kind == *kind) || path.kind == *kind
        });
        for kind in kinds {
            let style = ray_style(kind);
            sample(ui, style.color, style.strokes);
            ui.label(format!("{} ray, {}", kind.name(), style.text));
        }
    });
    ui.label("cross: a hit · star: a light that is reached");
    if picked.current().is_some() {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 5.0;
            for (color, strokes, what) in [
                (INTERVAL, &[][..], "the ray in the current cell"),
                (WAITING, &[1.0, 1.0], "pending cells"),
            ] {
                sample(ui, color, strokes);
                ui.label(what);
            }
        });
    }
    if path
        .steps
        .iter()
        .any(|step| matches!(step, Step::Culled(_)))
    {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 5.0;
            sample(ui, CULLED, &[1.0, 1.0]);
            ui.label("culled nodes: boxes that begin beyond the hit");
        });
    }
    let rays = picked.record.rays.len();
    if legend.settings.all_rays && rays > RaysShown::MOST {
        ui.label(format!(
            "{} of {} rays drawn",
            grouped(RaysShown::MOST),
            grouped(rays)
        ));
    }
}

/// A short piece of a line.
fn sample(ui: &mut egui::Ui, [r, g, b]: [u8; 3], strokes: &[f64]) {
    let (rect, _) = ui.allocate_exact_size(vec2(26.0, 10.0), egui::Sense::hover());
    let stroke = egui::Stroke::new(2.5, Color32::from_rgb(r, g, b));
    let pattern: &[f64] = if strokes.is_empty() {
        &[f64::INFINITY, 0.0]
    } else {
        strokes
    };
    let mut x = rect.left();
    for pair in pattern.chunks(2).cycle() {
        if x >= rect.right() {
            break;
        }
        let [on, off] = [pair[0] as f32 * 3.0, pair[1] as f32 * 3.0];
        let end = (x + on).min(rect.right());
        ui.painter().hline(x..=end, rect.center().y, stroke);
        x = end + off;
    }
}
