//! The picture as it is rendered, with or under a heatmap: zoomed and moved by mouse, pixels picked by
//! click and arrow keys. Of two compared trees both pictures, side by side or parted by a wipe.

mod export;
mod heat;
mod marks;
mod parts;
mod place;
mod region;
mod row;
mod symbols;
mod upload;

use crate::gui::action::{Gesture, actions};
use crate::gui::document::Document;
use crate::gui::document::comparing::{Verdict, View};
use crate::gui::edits::{Edits, Request};
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::theme::ROW;
use crate::measure::heat::heatmaps;
use crate::workspace;
use egui::{Color32, ColorImage, Pos2, Rect, TextureHandle, TextureOptions, Vec2, pos2, vec2};
use heat::{HeatView, legend, next_heatmap};
use marks::PictureMarks;
use parts::{Part, parts, room_below, size_of};
use place::Place;
use row::Row;
use std::sync::Arc;
use upload::Uploaded;

/// The pictures' textures and how they are looked at.
#[derive(Default)]
pub struct PicturePane {
    /// Of A and of B.
    textures: [Option<Uploaded>; 2],
    /// Marks the pixels in which these two pictures differ.
    differing: Option<([u64; 2], TextureHandle)>,
    place: Place,
    /// Whether a key asks to see the other picture.
    flips: bool,
    /// Where a region is being dragged from.
    region_from: Option<Pos2>,
    row: Row,
    /// Whether the row is in the pane's title row in this frame.
    has_title_row: bool,
    heat: HeatView,
    marks: PictureMarks,
}

/// How far a key moves the line of the wipe, as a share of the picture's width.
const WIPE_STEP: f32 = 0.05;

/// The color of pixels that differ: bright on dark surroundings.
const DIFFERING: Color32 = Color32::from_rgb(255, 90, 255);

const WHOLE: Rect = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));

impl Pane for PicturePane {
    const ID: &'static str = "picture";
    const TITLE: &'static str = "Picture";
    const ABOUT: &'static str = "The ray-traced picture, or a heatmap of what each pixel cost.";
    const REVEALS: &'static [Fact] = &[];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "picture.export" Everywhere ALT [Num1] "Export the picture: PNG or EXR" => |_, cx| {
            let export = export::picture(cx.doc);
            cx.edits.request(Request::Export(Box::new(export)));
        };
        "picture.export-heatmap" Everywhere ALT [Num2] "Export the heatmap: PNG with its legend, or EXR" => |pane, cx| {
            let export = export::heatmap(&pane.heat, cx.doc);
            cx.edits.request(Request::Export(Box::new(export)));
        };
        "picture.pick-left" Here NONE [ArrowLeft] "Pick the pixel to the left" => |_, cx| step(cx, -1, 0);
        "picture.pick-right" Here NONE [ArrowRight] "Pick the pixel to the right" => |_, cx| step(cx, 1, 0);
        "picture.pick-up" Here NONE [ArrowUp] "Pick the pixel above" => |_, cx| step(cx, 0, -1);
        "picture.pick-down" Here NONE [ArrowDown] "Pick the pixel below" => |_, cx| step(cx, 0, 1);
        "picture.clear-region" Here SHIFT [Delete] "Clear the marked region" => |_, cx| cx.edits.add(|doc| doc.region = None);
        "picture.unpick" Here NONE [Delete] "Clear the pixel" => |_, cx| cx.edits.add(Document::unpick);
        "picture.pin" Here NONE [P] "Pin the picked pixel to come back to it, or unpin it" => |_, cx| cx.edits.add(Document::pin_or_unpin);
        "picture.outline-selection" Here NONE [S] "Outline the selected cell and object, or not" => |pane, _| pane.marks.toggle();
        "picture.previous-heatmap" Here SHIFT [H] "Show the previous heatmap" => |_, cx| turn(cx, false);
        "picture.next-heatmap" Here NONE [H] "Show the next heatmap" => |_, cx| turn(cx, true);
        "picture.log-scale" Here NONE [G] "Color the heatmap by the logarithm, or not" => |pane, _| pane.heat.turn_scale();
        "picture.lock-range" Here NONE [R] "Lock the range of the heatmap's colors, or unlock it" => |pane, cx| pane.heat.toggle_lock(cx.doc);
        "picture.more-expensive" Here SHIFT [N] "Pick the previous pixel in the order of cost" => |pane, _| pane.heat.step_by_cost(-1);
        "picture.less-expensive" Here NONE [N] "Pick the costliest pixel, then the next" => |pane, _| pane.heat.step_by_cost(1);
        "picture.next-view" Here NONE [W] "Show A and B as one, wipe, side by side or difference" => |_, cx| cx.edits.add(|doc| doc.comparing.view = doc.comparing.view.next());
        "picture.flip" Here NONE [F] "Show the other of A and B" held => |pane, _| pane.flips = true;
        "picture.wipe-left" Here NONE [OpenBracket] "Move the line between A and B to the left" => |_, cx| shift_wipe(cx, -1.0);
        "picture.wipe-right" Here NONE [CloseBracket] "Move the line between A and B to the right" => |_, cx| shift_wipe(cx, 1.0);
        "picture.actual-size" Here COMMAND [Num0] "Show one pixel on one pixel of the screen" => |pane, cx| pane.place.zoom_to(1.0 / cx.ctx.pixels_per_point());
        "picture.fit" Here NONE [Home] "Fit the picture into its pane" => |pane, _| pane.place.fit();
    };
    const GESTURES: &'static [Gesture] = &[
        Gesture {
            gesture: "Click",
            about: "Name the object in a pixel and follow its ray",
        },
        Gesture {
            gesture: "Wheel",
            about: "Zoom to the pointer",
        },
        Gesture {
            gesture: "Right-drag",
            about: "Move the picture",
        },
        Gesture {
            gesture: "Shift+drag",
            about: "Mark a region, whose time by term the pane Time by term shows",
        },
        Gesture {
            gesture: "Drag",
            about: "Move the line between A and B",
        },
    ];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let verdict = verdict(doc, cx.ctx);
        let edits = &mut *cx.edits;
        // A column has no title rows.
        if !std::mem::take(&mut self.has_title_row) {
            let size = vec2(ui.available_width(), ROW);
            let to_the_left = egui::Layout::right_to_left(egui::Align::Center);
            ui.allocate_ui_with_layout(size, to_the_left, |ui| {
                ui.set_min_size(size);
                self.row(ui, doc, verdict.as_deref(), edits);
            });
        }
        self.marks.note(ui, doc);
        self.heat.update(ui.ctx(), doc);
        let rest = crate::gui::widgets::common::rest_of(ui);
        let room = room_below(rest, doc);
        let mut size = rest;
        if doc.heatmap.is_some() {
            let used = legend::height(room) + ui.spacing().item_spacing.y;
            size.y = (size.y - used).max(16.0);
        }
        let hovered = self.picture(ui, size, doc, verdict.as_ref(), edits);
        if doc.heatmap.is_some() {
            self.heat.legend(ui, doc, room, hovered);
        }
        let told = hovered.filter(|_| !doc.hides_heatmap());
        let value = told.and_then(|pixel| self.heat.value_text(pixel));
        let hovered = hovered.map(|pixel| (pixel, value));
        edits.add(move |doc| doc.hovered = hovered);
    }

    fn controls(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        self.has_title_row = true;
        let doc: &Document = cx.doc;
        let verdict = verdict(doc, cx.ctx);
        self.row(ui, doc, verdict.as_deref(), cx.edits);
    }

    fn choices(&self) -> Vec<String> {
        let heatmaps = heatmaps().iter();
        let named = heatmaps.map(|h| format!("Heatmap: {} ({})", h.name, h.symbol));
        std::iter::once("Heatmap: none".to_owned())
            .chain(named)
            .collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        cx.edits.add(move |doc| doc.heatmap = place.checked_sub(1));
        cx.edits.request(Request::Show(Self::ID));
    }

    fn save(&self, view: &mut workspace::View) {
        view.picture = self.place.kept();
        self.heat.save(&mut view.heatmap);
    }

    fn load(&mut self, view: &workspace::View) {
        self.place.load(&view.picture);
        let differences = view.arrangement == View::Difference;
        self.heat.load(&view.heatmap, differences);
    }
}

/// How the two pictures differ; `None` while a lesson asks for it, too.
fn verdict(doc: &Document, ctx: &egui::Context) -> Option<Arc<Verdict>> {
    let compares = doc.other.is_some() && !doc.hides(&[Fact::Difference]);
    compares.then(|| doc.verdict(ctx)).flatten()
}

impl PicturePane {
    fn row(
        &mut self,
        ui: &mut egui::Ui,
        doc: &Document,
        verdict: Option<&Verdict>,
        edits: &mut Edits,
    ) {
        let shown = (&mut self.heat, &mut self.marks);
        self.row.show(ui, shown, doc, verdict, edits);
    }

    /// Shows the picture and picks pixels. Returns the pixel under the pointer.
    fn picture(
        &mut self,
        ui: &mut egui::Ui,
        size: Vec2,
        doc: &Document,
        verdict: Option<&Arc<Verdict>>,
        edits: &mut Edits,
    ) -> Option<[u32; 2]> {
        let (pane, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Traced picture"));
        if let Some(current) = &doc.current {
            // For screen readers: what the picture is of.
            let text = current.settings_text();
            let describe = |node: &mut egui::accesskit::Node| node.set_description(text);
            ui.ctx().accesskit_node_builder(response.id, describe);
        }
        for (slot, current) in self.textures.iter_mut().zip(doc.both()) {
            match current {
                Some(current) => Uploaded::update(slot, ui.ctx(), current),
                None => *slot = None,
            }
        }
        let flipped = std::mem::take(&mut self.flips);
        let parts = parts(&self.place, pane, doc, flipped);
        self.steer(ui, &response, &parts, doc, edits);
        if let Some(pixel) = self.heat.costly_pixel(doc, ui.ctx())
            && let Some(picture) = size_of(doc, doc.which)
        {
            self.place.reveal(pane, picture, pixel);
            edits.add(move |doc| doc.pick(pixel));
        }
        for part in &parts {
            self.paint(ui, part, doc, verdict);
        }
        if let [a, _] = &parts[..]
            && doc.comparing.view == View::Wipe
        {
            symbols::wipe_line(ui, pane, a.clip.right());
        }
        let under = |pos: Pos2| {
            let part = parts.iter().find(|part| part.clip.contains(pos))?;
            let picture = size_of(doc, part.which)?;
            self.place.pixel_at(part.pane, picture, pos)
        };
        let clicked = response
            .interact_pointer_pos()
            .filter(|_| response.clicked());
        if let Some(pixel) = clicked.and_then(under) {
            edits.add(move |doc| doc.pick(pixel));
            if doc.task == "explore" {
                edits.request(Request::Task("ray"));
            }
            ui.ctx().request_repaint();
        }
        response.hover_pos().and_then(under)
    }

    /// One picture with its heatmap and marks.
    fn paint(
        &mut self,
        ui: &egui::Ui,
        part: &Part,
        doc: &Document,
        verdict: Option<&Arc<Verdict>>,
    ) {
        let painter = ui.painter().with_clip_rect(part.clip);
        let comparing = doc.other.is_some();
        let (Some(picture), Some(texture)) = (
            size_of(doc, part.which),
            &self.textures[part.which as usize],
        ) else {
            if comparing {
                let text = format!("Tracing {}", part.which.name());
                let font = egui::TextStyle::Body.resolve(ui.style());
                let color = ui.visuals().text_color();
                let at = part.clip.center();
                painter.text(at, egui::Align2::CENTER_CENTER, text, font, color);
            }
            return;
        };
        let rect = self.place.rect(part.pane, picture);
        let tint = if doc.picture_will_differ(part.which) {
            heat::DIM
        } else {
            Color32::WHITE
        };
        painter.image(texture.id(), rect, WHOLE, tint);
        if let Some((heat, tint)) = self.heat.texture(part.which, doc, ui.ctx()) {
            painter.image(heat, rect, WHOLE, tint);
        }
        if comparing && doc.comparing.view == View::Difference && doc.heatmap.is_none() {
            self.mark_differing(ui.ctx(), &painter, rect, doc, verdict);
        }
        // Nothing is marked outside the picture.
        let inside = painter.with_clip_rect(part.clip.intersect(rect));
        let in_front = part.which == doc.which;
        if let (true, Some(current)) = (in_front, &doc.current) {
            self.marks.paint(&inside, rect, current, &doc.inspect);
        }
        if let Some(region) = doc.region {
            region::frame(&inside, rect, picture, region);
        }
        symbols::pins(&painter, rect, picture, &doc.pinned);
        let picked = doc.current.as_ref().and_then(|c| c.picked_pixel());
        if let Some([x, y]) = picked
            && x < picture[0]
            && y < picture[1]
        {
            symbols::cross_hair(&painter, rect, picture, [x, y]);
        }
        if comparing && doc.comparing.view != View::Difference {
            let right = part.clip.left() > part.pane.left() && doc.comparing.view == View::Wipe;
            symbols::badge(&painter, part.clip, part.which, right);
        }
    }

    /// Darkens the picture but for the pixels in which A and B differ.
    fn mark_differing(
        &mut self,
        ctx: &egui::Context,
        painter: &egui::Painter,
        rect: Rect,
        doc: &Document,
        verdict: Option<&Arc<Verdict>>,
    ) {
        let ([Some(a), Some(b)], Some(verdict)) = (doc.both(), verdict) else {
            return;
        };
        let key = [a.number, b.number];
        let size = [a.shown.picture.width, a.shown.picture.height].map(|side| side as usize);
        let stale = self.differing.as_ref().is_none_or(|(of, _)| *of != key);
        if stale {
            let mut image = ColorImage::filled(size, Color32::from_black_alpha(200));
            for &pixel in &verdict.pixels {
                image.pixels[pixel as usize] = DIFFERING;
            }
            let texture = ctx.load_texture("differing pixels", image, TextureOptions::NEAREST);
            self.differing = Some((key, texture));
        }
        if let Some((_, texture)) = &self.differing {
            painter.image(texture.id(), rect, WHOLE, Color32::WHITE);
        }
    }

    /// Moves and zooms the picture, marks a region, moves the line of the wipe.
    fn steer(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        parts: &[Part],
        doc: &Document,
        edits: &mut Edits,
    ) {
        let Some(picture) = size_of(doc, doc.which) else {
            return;
        };
        if response.dragged_by(egui::PointerButton::Secondary)
            || response.dragged_by(egui::PointerButton::Middle)
        {
            self.place.drag(response.drag_delta());
        }
        let shift = ui.input(|i| i.modifiers.shift);
        if response.drag_started_by(egui::PointerButton::Primary) {
            self.region_from = ui.input(|i| i.pointer.press_origin()).filter(|_| shift);
        }
        let to = response
            .interact_pointer_pos()
            .filter(|_| response.dragged_by(egui::PointerButton::Primary));
        let is_wipe = doc.other.is_some() && doc.comparing.view == View::Wipe;
        match (self.region_from, to) {
            (Some(from), Some(to)) => {
                if let Some(part) = parts.iter().find(|part| part.clip.contains(from)) {
                    let rect = self.place.rect(part.pane, picture);
                    let region = region::between(rect, picture, from, to);
                    edits.add(move |doc| doc.region = Some(region));
                }
            }
            (None, Some(pointer)) if is_wipe => {
                let rect = self.place.rect(response.rect, picture);
                let split = ((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
                edits.add(move |doc| doc.comparing.split = split);
            }
            _ => {}
        }
        let wheel = ui.input(|i| i.smooth_scroll_delta().y);
        if let Some(pointer) = response.hover_pos()
            && wheel != 0.0
        {
            let under = parts.iter().find(|part| part.clip.contains(pointer));
            let pane = under.map_or(response.rect, |part| part.pane);
            self.place.zoom_at(pane, picture, pointer, wheel);
        }
    }
}

/// Moves the picked pixel by one; without one, the picture's center is picked.
fn step(cx: &mut Cx<'_>, dx: i32, dy: i32) {
    let Some(current) = &cx.doc.current else {
        return;
    };
    let (width, height) = (current.shown.picture.width, current.shown.picture.height);
    let pixel = match current.picked_pixel() {
        Some([x, y]) => [
            x.saturating_add_signed(dx).min(width - 1),
            y.saturating_add_signed(dy).min(height - 1),
        ],
        None => [width / 2, height / 2],
    };
    cx.edits.add(move |doc| doc.pick(pixel));
}

/// Shows the next heatmap or the previous one; the picture alone is one of the circle.
fn turn(cx: &mut Cx<'_>, forward: bool) {
    cx.edits
        .add(move |doc| doc.heatmap = next_heatmap(doc.heatmap, forward));
}

/// Moves the wipe's line by steps, to the right if positive.
fn shift_wipe(cx: &mut Cx<'_>, steps: f32) {
    cx.edits.add(move |doc| {
        let split = doc.comparing.split + steps * WIPE_STEP;
        doc.comparing.split = split.clamp(0.0, 1.0);
    });
}
