//! The picture as it refines, with or under a heatmap: zoomed and moved by mouse, pixels picked by
//! click and arrow keys.

use super::heat::HeatView;
use super::picture_marks::PictureMarks;
use super::shortcuts::{Action, Scope, pressed};
use super::state::{Current, Fresh, State};
use crate::trace::{Picture, Tile};
use crate::worker::Stage;
use egui::ecolor::gamma_u8_from_linear_f32;
use egui::{Color32, ColorImage, Pos2, Rect, TextureHandle, TextureOptions, Vec2, pos2, vec2};

/// The picture's texture and how it is looked at.
#[derive(Default)]
pub struct PicturePane {
    texture: Option<TextureHandle>,
    /// Points a pixel; `None` fits the picture into the pane.
    zoom: Option<f32>,
    /// The picture's middle relative to the pane's, in points.
    offset: Vec2,
    /// The pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    pub heat: HeatView,
    marks: PictureMarks,
}

impl PicturePane {
    /// Shows what there is to see of the pixels, and its legend.
    pub fn ui(&mut self, ui: &mut egui::Ui, state: &mut State) {
        header(ui, state, &mut self.marks);
        self.heat.controls(ui);
        self.heat.update(ui.ctx(), state);
        self.picture(ui, state);
        self.heat.legend(ui, state, self.hovered);
    }

    /// Shows the picture and picks pixels.
    fn picture(&mut self, ui: &mut egui::Ui, state: &mut State) {
        let mut size = super::rest_of(ui);
        let legend = self.heat.legend_height();
        if legend > 0.0 {
            size.y = (size.y - legend - ui.spacing().item_spacing.y).max(16.0);
        }
        let (pane, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Traced picture"));
        self.hovered = None;
        let faded = state.is_previous() && !state.only_camera_differs();
        let Some(current) = &mut state.current else {
            return;
        };
        self.upload(ui.ctx(), current);
        let picture = [current.shown.picture.width, current.shown.picture.height];
        self.steer(ui, &response, current);
        if self.heat.go(ui.ctx(), current) {
            self.reveal(pane, current);
        }
        let rect = self.place(pane, picture);
        let Some(texture) = &self.texture else {
            return;
        };
        let painter = ui.painter().with_clip_rect(pane);
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        let tint = if faded {
            Color32::from_gray(140)
        } else {
            Color32::WHITE
        };
        painter.image(texture.id(), rect, whole, tint);
        if let Some((heat, tint)) = self.heat.texture(ui.ctx()) {
            painter.image(heat, rect, whole, tint);
        }
        self.marks.paint(&painter, rect, current, &state.inspect);
        if let Some(pixel) = current.picked_pixel() {
            cross_hair(&painter, rect, picture, pixel);
        }
        let pixel_at = |pos: Pos2| -> Option<[u32; 2]> {
            let at = (pos - rect.min) / rect.size() * vec2(picture[0] as f32, picture[1] as f32);
            let inside =
                at.x >= 0.0 && at.y >= 0.0 && at.x < picture[0] as f32 && at.y < picture[1] as f32;
            inside.then_some([at.x as u32, at.y as u32])
        };
        self.hovered = response.hover_pos().and_then(pixel_at);
        if response.clicked()
            && let Some(pixel) = response.interact_pointer_pos().and_then(pixel_at)
        {
            current.pick(pixel);
            ui.ctx().request_repaint();
        }
    }

    /// Brings the texture up to date: all of it for a new picture, else the new tiles.
    fn upload(&mut self, ctx: &egui::Context, current: &mut Current) {
        let picture = &current.shown.picture;
        let fresh = std::mem::replace(&mut current.fresh, Fresh::Tiles(Vec::new()));
        match (fresh, &mut self.texture) {
            (Fresh::Tiles(tiles), Some(texture)) => {
                for tile in tiles {
                    let at = [tile.x as usize, tile.y as usize];
                    texture.set_partial(at, part(picture, &tile), TextureOptions::NEAREST);
                }
            }
            (_, texture) => {
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
                        *texture =
                            Some(ctx.load_texture("picture", image, TextureOptions::NEAREST));
                    }
                }
            }
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

    fn steer(&mut self, ui: &egui::Ui, response: &egui::Response, current: &mut Current) {
        let picture = [current.shown.picture.width, current.shown.picture.height];
        let pane = response.rect;
        if response.dragged_by(egui::PointerButton::Secondary)
            || response.dragged_by(egui::PointerButton::Middle)
        {
            self.offset += response.drag_delta();
        }
        let Some(pointer) = response.hover_pos() else {
            return;
        };
        let wheel = ui.input(|i| i.smooth_scroll_delta().y);
        if wheel != 0.0 {
            let before = self.place(pane, picture);
            let zoom = before.width() / picture[0] as f32;
            let next = (zoom * (wheel * 0.004).exp()).clamp(0.02, 200.0);
            self.zoom = Some(next);
            // What is under the pointer stays there.
            let from_middle = before.center() - pointer;
            self.offset = pointer + from_middle * (next / zoom) - pane.center();
        }
        for action in pressed(ui.ctx(), Scope::Picture) {
            match action {
                Action::Fit => {
                    self.zoom = None;
                    self.offset = Vec2::ZERO;
                }
                Action::ActualSize => {
                    self.zoom = Some(1.0 / ui.ctx().pixels_per_point());
                    self.offset = Vec2::ZERO;
                }
                Action::Unpick => current.unpick(),
                Action::PickLeft => step(current, -1, 0),
                Action::PickRight => step(current, 1, 0),
                Action::PickUp => step(current, 0, -1),
                Action::PickDown => step(current, 0, 1),
                Action::OutlineSelection => self.marks.toggle(),
                action => self.heat.act(action),
            }
        }
    }
}

/// Moves the picked pixel by one; without one, the picture's middle is picked.
fn step(current: &mut Current, dx: i32, dy: i32) {
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
fn header(ui: &mut egui::Ui, state: &State, marks: &mut PictureMarks) {
    ui.horizontal(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        let Some(current) = &state.current else {
            ui.label("No picture yet");
            return;
        };
        let tracing = matches!(&state.work, Some((Stage::Previewing | Stage::Tracing, _)));
        let status = if state.is_previous() {
            "previous settings"
        } else if current.done {
            "finished"
        } else if state.stopped {
            "stopped"
        } else if tracing {
            "refining …"
        } else {
            "traced"
        };
        ui.strong(status);
        marks.controls(ui, state);
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

/// A pixel's colour in words: linear values and 8-bit sRGB.
pub fn color_text(color: [f32; 3]) -> String {
    let [r, g, b] = color;
    let [r8, g8, b8] = color.map(gamma_u8_from_linear_f32);
    format!("linear {r:.3} {g:.3} {b:.3} · sRGB #{r8:02x}{g8:02x}{b8:02x}")
}
