//! The picture as it refines, with or under a heatmap: zoomed and moved by mouse, pixels picked by
//! click and arrow keys. Of two compared trees both pictures, side by side or parted by a wipe.

mod compare_bar;
mod export;
mod heat;
mod marks;
mod region;

use crate::gui::action::{Gesture, actions};
use crate::gui::document::comparing::{View, Which};
use crate::gui::document::{Current, Document, Fresh};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::rounded::rounded;
use crate::jobs::Stage;
use crate::measure::heat::heatmaps;
use crate::trace::{Picture, Tile};
use crate::workspace;
use crate::workspace::PicturePlace;
use egui::ecolor::gamma_u8_from_linear_f32;
use egui::{Color32, ColorImage, Pos2, Rect, TextureHandle, TextureOptions, Vec2, pos2, vec2};
use heat::HeatView;
use marks::PictureMarks;

/// The pictures' textures and how they are looked at.
#[derive(Default)]
pub struct PicturePane {
    /// Of A and of B.
    textures: [Option<TextureHandle>; 2],
    /// Marks the pixels in which these two pictures differ.
    differing: Option<([u64; 2], TextureHandle)>,
    /// Points a pixel; `None` fits the picture into the pane.
    zoom: Option<f32>,
    /// The picture's middle relative to the pane's, in points.
    offset: Vec2,
    /// The pixel under the pointer.
    hovered: Option<[u32; 2]>,
    /// Whether a key asks to see the other picture.
    flips: bool,
    /// Where a region is being dragged from.
    region_from: Option<Pos2>,
    heat: HeatView,
    marks: PictureMarks,
}

/// One picture's share of the pane.
struct Part {
    which: Which,
    /// What the picture is fitted into.
    pane: Rect,
    /// What is seen of it.
    clip: Rect,
}

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
        "picture.pick-left" Here NONE [ArrowLeft] "Pick the pixel to the left" => |_, cx| step(cx.doc, -1, 0);
        "picture.pick-right" Here NONE [ArrowRight] "Pick the pixel to the right" => |_, cx| step(cx.doc, 1, 0);
        "picture.pick-up" Here NONE [ArrowUp] "Pick the pixel above" => |_, cx| step(cx.doc, 0, -1);
        "picture.pick-down" Here NONE [ArrowDown] "Pick the pixel below" => |_, cx| step(cx.doc, 0, 1);
        "picture.clear-region" Here SHIFT [Delete] "Clear the marked region" => |_, cx| cx.doc.region = None;
        "picture.unpick" Here NONE [Delete] "Clear the pixel" => |_, cx| cx.doc.unpick();
        "picture.pin" Here NONE [P] "Pin the picked pixel to come back to it, or unpin it" => |_, cx| cx.doc.pin_or_unpin();
        "picture.outline-selection" Here NONE [S] "Outline the selected cell and object, or not" => |pane, _| pane.marks.toggle();
        "picture.previous-heatmap" Here SHIFT [H] "Show the previous heatmap" => |pane, cx| pane.turn(false, cx.doc);
        "picture.next-heatmap" Here NONE [H] "Show the next heatmap" => |pane, cx| pane.turn(true, cx.doc);
        "picture.log-scale" Here NONE [G] "Color the heatmap by the logarithm, or not" => |pane, _| pane.heat.turn_scale();
        "picture.lock-range" Here NONE [R] "Lock the range of the heatmap's colors, or unlock it" => |pane, _| pane.heat.toggle_lock();
        "picture.more-expensive" Here SHIFT [N] "Pick the previous pixel in the order of cost" => |pane, _| pane.heat.step_by_cost(-1);
        "picture.less-expensive" Here NONE [N] "Pick the costliest pixel, then the next" => |pane, _| pane.heat.step_by_cost(1);
        "picture.next-view" Here NONE [W] "Show A and B as one, wipe, side by side or difference" => |_, cx| cx.doc.comparing.view = cx.doc.comparing.view.next();
        "picture.flip" Here NONE [F] "Show the other of A and B" held => |pane, _| pane.flips = true;
        "picture.wipe-left" Here NONE [OpenBracket] "Move the line between A and B to the left" => |_, cx| compare_bar::shift(cx.doc, -1.0);
        "picture.wipe-right" Here NONE [CloseBracket] "Move the line between A and B to the right" => |_, cx| compare_bar::shift(cx.doc, 1.0);
        "picture.actual-size" Here COMMAND [Num0] "Show one pixel on one pixel of the screen" => |pane, cx| {
            pane.zoom = Some(1.0 / cx.ctx.pixels_per_point());
            pane.offset = Vec2::ZERO;
        };
        "picture.fit" Here NONE [Home] "Fit the picture into its pane" => |pane, _| {
            pane.zoom = None;
            pane.offset = Vec2::ZERO;
        };
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
        let doc = &mut *cx.doc;
        doc.comparing.flipped = std::mem::take(&mut self.flips);
        self.heat.follow(doc);
        header(ui, doc, &mut self.marks);
        if std::mem::take(&mut doc.comparing.asks_for_pixels) {
            self.heat.show_picture();
        }
        self.heat.controls(ui);
        doc.heatmap = self.heat.shown();
        if doc.other.is_some() {
            compare_bar::show(ui, doc, self.heat.is_picture());
        }
        self.heat.update(ui.ctx(), doc);
        self.picture(ui, doc);
        self.heat.legend(ui, doc, self.hovered);
        let told = self.hovered.filter(|_| !self.heat.is_secret(doc));
        let value = told.and_then(|pixel| self.heat.value_text(pixel));
        doc.hovered = self.hovered.map(|pixel| (pixel, value));
    }

    fn choices(&self) -> Vec<String> {
        let heatmaps = heatmaps().iter();
        let named = heatmaps.map(|h| format!("Heatmap: {} ({})", h.name, h.symbol));
        std::iter::once("Heatmap: none".to_owned())
            .chain(named)
            .collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        cx.doc.heatmap = place.checked_sub(1);
        cx.edits.request(Request::Show(Self::ID));
    }

    fn save(&self, view: &mut workspace::View) {
        view.picture = PicturePlace {
            zoom: self.zoom.map(rounded),
            offset: [self.offset.x, self.offset.y].map(rounded),
        };
        view.heatmap = self.heat.kept();
    }

    fn load(&mut self, view: &workspace::View) {
        let place = &view.picture;
        self.zoom = place.zoom.map(|zoom| zoom as f32);
        let [x, y] = place.offset.map(|by| by as f32);
        self.offset = vec2(x, y);
        self.heat
            .restore(&view.heatmap, view.arrangement == View::Difference);
    }
}

impl PicturePane {
    /// Shows the next heatmap or the previous one.
    fn turn(&mut self, forward: bool, doc: &mut Document) {
        self.heat.follow(doc);
        self.heat.turn(forward);
        doc.heatmap = self.heat.shown();
    }

    /// Shows the picture and picks pixels.
    fn picture(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        let mut size = crate::gui::widgets::common::rest_of(ui);
        let legend = self.heat.legend_height();
        if legend > 0.0 {
            size.y = (size.y - legend - ui.spacing().item_spacing.y).max(16.0);
        }
        let (pane, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Traced picture"));
        self.hovered = None;
        for (texture, current) in self.textures.iter_mut().zip(doc.both_mut()) {
            if let Some(current) = current {
                upload(ui.ctx(), texture, current);
            }
        }
        self.steer(ui, &response, doc);
        if let Some(current) = &mut doc.current
            && self.heat.go(ui.ctx(), current)
        {
            self.reveal(pane, current);
        }
        let parts = self.parts(pane, doc);
        for part in &parts {
            self.paint(ui, part, doc);
        }
        if let [a, _] = &parts[..]
            && doc.comparing.view == View::Wipe
        {
            wipe_line(ui, pane, a.clip.right());
        }
        let under = |pos: Pos2| {
            let part = parts.iter().find(|part| part.clip.contains(pos))?;
            let picture = &doc.both()[part.which as usize]?.shown.picture;
            let size = vec2(picture.width as f32, picture.height as f32);
            let rect = self.place(part.pane, [picture.width, picture.height]);
            let at = (pos - rect.min) / rect.size() * size;
            let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y;
            inside.then_some([at.x as u32, at.y as u32])
        };
        let hovered = response.hover_pos().and_then(under);
        let clicked = response
            .interact_pointer_pos()
            .filter(|_| response.clicked());
        let picked = clicked.and_then(under);
        self.hovered = hovered;
        if let (Some(pixel), Some(current)) = (picked, &mut doc.current) {
            current.pick(pixel);
            ui.ctx().request_repaint();
        }
    }

    /// How the pictures share the pane: the one in front alone, or A before B.
    fn parts(&self, pane: Rect, doc: &Document) -> Vec<Part> {
        let comparing = &doc.comparing;
        let alone = |which| {
            vec![Part {
                which,
                pane,
                clip: pane,
            }]
        };
        if doc.other.is_none() {
            return alone(doc.which);
        }
        let [first, second] = match comparing.flipped {
            false => [Which::A, Which::B],
            true => [Which::B, Which::A],
        };
        match comparing.view {
            View::Difference => alone(doc.which),
            View::One if comparing.flipped => alone(doc.which.other()),
            View::One => alone(doc.which),
            View::Wipe => {
                let x = self.split_at(pane, doc).clamp(pane.left(), pane.right());
                let (left, right) = pane.split_left_right_at_x(x);
                [(first, left), (second, right)]
                    .map(|(which, clip)| Part { which, pane, clip })
                    .into()
            }
            View::Beside => {
                let (left, right) = pane.split_left_right_at_fraction(0.5);
                [(first, left), (second, right)]
                    .map(|(which, half)| Part {
                        which,
                        pane: half.shrink2(vec2(1.0, 0.0)),
                        clip: half.shrink2(vec2(1.0, 0.0)),
                    })
                    .into()
            }
        }
    }

    /// Where the wipe's line lies in the pane.
    fn split_at(&self, pane: Rect, doc: &Document) -> f32 {
        let rect = doc.current.as_ref().map_or(pane, |current| {
            let picture = &current.shown.picture;
            self.place(pane, [picture.width, picture.height])
        });
        egui::lerp(rect.x_range(), doc.comparing.split)
    }

    /// One picture with its heatmap and marks.
    fn paint(&mut self, ui: &egui::Ui, part: &Part, doc: &mut Document) {
        let painter = ui.painter().with_clip_rect(part.clip);
        let comparing = doc.other.is_some();
        let in_front = part.which == doc.which;
        let faded = match (&doc.other, in_front) {
            (Some(other), false) => other.is_previous(doc.reload),
            _ => doc.is_previous() && !doc.only_camera_differs(),
        };
        let picked = doc.current.as_ref().and_then(|c| c.picked_pixel());
        let Some(current) = doc.both()[part.which as usize] else {
            if comparing {
                let text = format!("{} is on its way", part.which.name());
                let font = egui::FontId::proportional(14.0);
                let color = ui.visuals().text_color();
                let at = part.clip.center();
                painter.text(at, egui::Align2::CENTER_CENTER, text, font, color);
            }
            return;
        };
        let picture = [current.shown.picture.width, current.shown.picture.height];
        let rect = self.place(part.pane, picture);
        let Some(texture) = &self.textures[part.which as usize] else {
            return;
        };
        let tint = if faded {
            Color32::from_gray(140)
        } else {
            Color32::WHITE
        };
        painter.image(texture.id(), rect, WHOLE, tint);
        if let Some((heat, tint)) = self.heat.texture(part.which, ui.ctx()) {
            painter.image(heat, rect, WHOLE, tint);
        }
        if comparing && doc.comparing.view == View::Difference && self.heat.is_picture() {
            self.mark_differing(ui.ctx(), &painter, rect, doc);
        }
        if let (true, Some(current)) = (in_front, &doc.current) {
            self.marks.paint(&painter, rect, current, &doc.inspect);
        }
        if let Some(region) = doc.region {
            region::frame(&painter, rect, picture, region);
        }
        pins(&painter, rect, picture, &doc.pinned);
        if let Some([x, y]) = picked
            && x < picture[0]
            && y < picture[1]
        {
            cross_hair(&painter, rect, picture, [x, y]);
        }
        if comparing && doc.comparing.view != View::Difference {
            let right = part.clip.left() > part.pane.left() && doc.comparing.view == View::Wipe;
            badge(&painter, part.clip, part.which.name(), right);
        }
    }

    /// Darkens the picture but for the pixels in which A and B differ.
    fn mark_differing(
        &mut self,
        ctx: &egui::Context,
        painter: &egui::Painter,
        rect: Rect,
        doc: &mut Document,
    ) {
        let [Some(a), Some(b)] = doc.both() else {
            return;
        };
        let key = [a.number, b.number];
        let size = [a.shown.picture.width, a.shown.picture.height].map(|side| side as usize);
        let Some(verdict) = doc.verdict(ctx) else {
            return;
        };
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

    /// Where the picture lies on the screen.
    fn place(&self, pane: Rect, [width, height]: [u32; 2]) -> Rect {
        let size = vec2(width as f32, height as f32);
        let zoom = self.zoom.unwrap_or_else(|| {
            let fit = pane.size() / size;
            fit.x.min(fit.y)
        });
        Rect::from_center_size(pane.center() + self.offset, size * zoom)
    }

    /// Moves the picture so that the picked pixel is in the pane.
    fn reveal(&mut self, pane: Rect, current: &Current) {
        let (width, height) = (current.shown.picture.width, current.shown.picture.height);
        let Some(pixel) = current.picked_pixel() else {
            return;
        };
        let rect = self.place(pane, [width, height]);
        let [x, y] = pixel.map(|i| i as f32 + 0.5);
        let at = rect.min + vec2(x / width as f32, y / height as f32) * rect.size();
        if !pane.contains(at) {
            self.offset += pane.center() - at;
        }
    }

    fn steer(&mut self, ui: &egui::Ui, response: &egui::Response, doc: &mut Document) {
        let Some(current) = &doc.current else {
            return;
        };
        let picture = [current.shown.picture.width, current.shown.picture.height];
        if response.dragged_by(egui::PointerButton::Secondary)
            || response.dragged_by(egui::PointerButton::Middle)
        {
            self.offset += response.drag_delta();
        }
        let shift = ui.input(|i| i.modifiers.shift);
        if response.drag_started_by(egui::PointerButton::Primary) {
            self.region_from = ui.input(|i| i.pointer.press_origin()).filter(|_| shift);
        }
        if let (Some(from), Some(to)) = (self.region_from, response.interact_pointer_pos())
            && response.dragged_by(egui::PointerButton::Primary)
        {
            let parts = self.parts(response.rect, doc);
            if let Some(part) = parts.iter().find(|part| part.clip.contains(from)) {
                let rect = self.place(part.pane, picture);
                doc.region = Some(region::between(rect, picture, from, to));
            }
        }
        let is_wipe =
            self.region_from.is_none() && doc.other.is_some() && doc.comparing.view == View::Wipe;
        if is_wipe
            && response.dragged_by(egui::PointerButton::Primary)
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let rect = self.place(response.rect, picture);
            let split = (pointer.x - rect.left()) / rect.width();
            doc.comparing.split = split.clamp(0.0, 1.0);
        }
        let wheel = ui.input(|i| i.smooth_scroll_delta().y);
        if let Some(pointer) = response.hover_pos()
            && wheel != 0.0
        {
            let parts = self.parts(response.rect, doc);
            let under = parts.iter().find(|part| part.clip.contains(pointer));
            let pane = under.map_or(response.rect, |part| part.pane);
            let before = self.place(pane, picture);
            let zoom = before.width() / picture[0] as f32;
            let [least, most] =
                [PicturePlace::ZOOMS.start(), PicturePlace::ZOOMS.end()].map(|&zoom| zoom as f32);
            let next = (zoom * (wheel * 0.004).exp()).clamp(least, most);
            self.zoom = Some(next);
            // What is under the pointer stays there.
            let from_middle = before.center() - pointer;
            self.offset = pointer + from_middle * (next / zoom) - pane.center();
        }
    }
}

/// Brings a texture up to date: all of it for a new picture, else the new tiles.
fn upload(ctx: &egui::Context, texture: &mut Option<TextureHandle>, current: &mut Current) {
    let picture = &current.shown.picture;
    let fresh = std::mem::replace(&mut current.fresh, Fresh::Tiles(Vec::new()));
    match (fresh, &mut *texture) {
        (Fresh::Tiles(tiles), Some(texture)) => {
            for tile in tiles {
                let at = [tile.x as usize, tile.y as usize];
                texture.set_partial(at, part(picture, &tile), TextureOptions::NEAREST);
            }
        }
        _ => {
            let whole = Tile {
                x: 0,
                y: 0,
                width: picture.width,
                height: picture.height,
            };
            let image = part(picture, &whole);
            match texture {
                Some(texture) if texture.size() == image.size => {
                    texture.set(image, TextureOptions::NEAREST);
                }
                _ => {
                    *texture = Some(ctx.load_texture("picture", image, TextureOptions::NEAREST));
                }
            }
        }
    }
}

/// The colour of pixels that differ: bright on what is dark around.
const DIFFERING: Color32 = Color32::from_rgb(255, 90, 255);

/// A letter in a corner that says whose picture this is.
fn badge(painter: &egui::Painter, clip: Rect, name: &str, right: bool) {
    let size = vec2(20.0, 20.0);
    let corner = if right {
        clip.right_top() + vec2(-4.0 - size.x, 4.0)
    } else {
        clip.left_top() + vec2(4.0, 4.0)
    };
    let rect = Rect::from_min_size(corner, size);
    painter.rect_filled(rect, 4.0, Color32::from_black_alpha(190));
    let font = egui::FontId::proportional(14.0);
    let middle = egui::Align2::CENTER_CENTER;
    painter.text(rect.center(), middle, name, font, Color32::WHITE);
}

/// The line between two pictures, to be seen on any colour.
fn wipe_line(ui: &egui::Ui, pane: Rect, x: f32) {
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        ui.painter()
            .vline(x, pane.y_range(), egui::Stroke::new(width, color));
    }
}

/// Moves the picked pixel by one; without one, the picture's middle is picked.
fn step(doc: &mut Document, dx: i32, dy: i32) {
    let Some(current) = &mut doc.current else {
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
    current.pick(pixel);
}

/// What the picture is of, and whether it is the one asked for.
fn header(ui: &mut egui::Ui, doc: &Document, marks: &mut PictureMarks) {
    ui.horizontal(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        let Some(current) = &doc.current else {
            ui.label("No picture yet");
            return;
        };
        let refining = doc
            .work
            .as_ref()
            .is_some_and(|work| matches!(work.stage, Stage::Previewing | Stage::Rendering));
        let status = if doc.is_previous() {
            "previous settings"
        } else if current.done {
            "finished"
        } else if doc.stopped {
            "stopped"
        } else if refining {
            "refining …"
        } else {
            "traced"
        };
        if doc.other.is_some() {
            ui.strong(doc.which.name());
        }
        ui.strong(status);
        marks.controls(ui, doc);
        ui.label(current.settings_text())
            .on_hover_text(current.settings_text());
    });
}

/// A rectangle of a picture as the screen takes it.
fn part(picture: &Picture, tile: &Tile) -> ColorImage {
    let pixels = (0..tile.height)
        .flat_map(|y| (0..tile.width).map(move |x| (tile.x + x, tile.y + y)))
        .map(|(x, y)| {
            let [r, g, b] = picture.get(x, y).map(gamma_u8_from_linear_f32);
            Color32::from_rgb(r, g, b)
        })
        .collect();
    ColorImage::new([tile.width as usize, tile.height as usize], pixels)
}

/// Marks a pixel so that it can be seen on any colour.
fn cross_hair(painter: &egui::Painter, rect: Rect, [width, height]: [u32; 2], [x, y]: [u32; 2]) {
    let pixel = rect.size() / vec2(width as f32, height as f32);
    let corner = rect.min + pixel * vec2(x as f32, y as f32);
    let mark = Rect::from_min_size(corner, pixel).expand(2.0);
    let arm = 12.0;
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        let stroke = egui::Stroke::new(width, color);
        painter.rect_stroke(mark, 0.0, stroke, egui::StrokeKind::Middle);
        let (middle, half) = (mark.center(), mark.size() * 0.5);
        for sign in [-1.0, 1.0] {
            painter.line_segment(
                [
                    middle + vec2(sign * half.x, 0.0),
                    middle + vec2(sign * (half.x + arm), 0.0),
                ],
                stroke,
            );
            painter.line_segment(
                [
                    middle + vec2(0.0, sign * half.y),
                    middle + vec2(0.0, sign * (half.y + arm)),
                ],
                stroke,
            );
        }
    }
}

/// Numbers the pinned pixels.
fn pins(painter: &egui::Painter, rect: Rect, picture: [u32; 2], pinned: &[[u32; 2]]) {
    let pixel = rect.size() / vec2(picture[0] as f32, picture[1] as f32);
    for (i, [x, y]) in pinned.iter().enumerate() {
        if *x >= picture[0] || *y >= picture[1] {
            continue;
        }
        let at = rect.min + pixel * vec2(*x as f32 + 0.5, *y as f32 + 0.5);
        painter.circle(
            at,
            8.0,
            Color32::from_black_alpha(190),
            (1.0, Color32::WHITE),
        );
        let (font, middle) = (
            egui::FontId::proportional(12.0),
            egui::Align2::CENTER_CENTER,
        );
        painter.text(at, middle, i + 1, font, Color32::WHITE);
    }
}
