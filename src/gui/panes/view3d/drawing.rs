//! Draws the scene, cells, rays and marks, and the legend over them.

use super::ray_lines;
use super::renderer::{Frame3d, Globals};
use super::settings::{Cells, Settings};
use super::view::{SceneKey, View3d};
use super::{framing, legend, marks, scene_mesh};
use crate::geometry::{Aabb, Vec3};
use crate::gui::document::Current;
use crate::jobs::PictureVisits;
use crate::present::overlay::{self, Line};
use crate::trace::RayPath;
use eframe::egui_wgpu;
use egui::{Color32, Rect, vec2};
use std::sync::Arc;

/// Behind everything, in both themes: the color maps are made for a dark ground.
pub const GROUND: [u8; 3] = [24, 27, 33];

/// Boxes that a processor can draw fast enough to follow the mouse, and at rest.
const BOXES_IN_SOFTWARE: [u32; 2] = [12_000, 250_000];

/// How long after the last movement everything is drawn again, in seconds.
const REST: f64 = 0.2;

/// How much of the scene is seen beside the ray in the task *Ray*: the renderer covers one of four samples
/// per pixel.
const GHOST: f32 = 0.25;

impl View3d {
    /// Draws all; numbers only where it `tells` them.
    pub(super) fn draw(
        &mut self,
        ui: &mut egui::Ui,
        rect: Rect,
        current: &Current,
        visits: Option<Result<Arc<PictureVisits>, String>>,
        marks: &marks::Marks,
        tells: bool,
    ) {
        let (scene, tree) = (&current.shown.scene, &current.shown.tree);
        let center = scene_mesh::center_of(scene);
        let ctx = ui.ctx();
        let path = current.picked.as_ref().map(|picked| picked.path());
        let mesh = if self.settings.scene {
            let making = Arc::clone(scene);
            let key = SceneKey(Arc::clone(scene));
            self.mesh
                .get(&key, ctx, move || scene_mesh::scene_mesh(&making, center))
        } else {
            None
        };
        // Without a ray there are no leaves that it visited.
        let of_ray = self.settings.cells == Cells::Visited && path.is_some();
        let shows_boxes = self.settings.cells != Cells::None && !of_ray;
        let (visits, waits_for) = match visits {
            Some(Ok(visits)) => (Some(visits), None),
            Some(Err(why)) => (None, Some(why)),
            None => (None, None),
        };
        let boxes = (shows_boxes && waits_for.is_none())
            .then(|| {
                let Settings { coloring, .. } = self.settings;
                let filter = self.settings.drawn();
                self.boxes.get(tree, filter, coloring, visits, center, ctx)
            })
            .flatten();
        let mut lines = self.lines_for(current, center);
        lines.extend(marks.lines(center));
        let faces = marks.faces(center);
        if *self.faces != faces {
            self.faces = Arc::new(faces);
        }
        if *self.lines != lines {
            self.lines = Arc::new(lines);
        }

        let all = boxes.as_ref().map_or(0, |b| b.instances.len() as u32);
        let resting = ui.input(|i| i.time) - self.moved;
        let software = self.adapter.as_ref().is_some_and(|a| a.software);
        let [moving, at_rest] = BOXES_IN_SOFTWARE;
        let mut drawn = if software { all.min(at_rest) } else { all };
        if software && all > moving && resting < REST {
            drawn = moving;
            ctx.request_repaint_after_secs((REST - resting) as f32 + 0.01);
        }

        let drawn_lines = ray_lines::bounds_of(&self.lines, center);
        let mut bounds = tree.root_cell().union(&drawn_lines);
        if self.shows_picture_camera() {
            let eye = current.shown.measurement.camera.from;
            bounds = bounds.union(&Aabb::new(eye, eye));
        }
        let is_ghost = path.is_some() && self.ray_task.before().is_some();
        let left_out = mesh.as_ref().map_or(0, |mesh| mesh.left_out);
        let pixels = ctx.pixels_per_point();
        let frame = Frame3d {
            globals: Globals {
                opacity: if is_ghost { GHOST } else { 1.0 },
                ..self.globals(rect, center, &bounds, &tree.root_cell())
            },
            size: [
                (rect.width() * pixels).round().max(1.0) as u32,
                (rect.height() * pixels).round().max(1.0) as u32,
            ],
            ground: GROUND,
            mesh,
            boxes: boxes.clone(),
            box_count: drawn,
            lines: Arc::clone(&self.lines),
            faces: Arc::clone(&self.faces),
        };
        ui.painter()
            .add(egui_wgpu::Callback::new_paint_callback(rect, frame));
        if let Some(path) = path.filter(|_| tells) {
            self.number_leaves(ui, rect, path);
        }
        marks.name(&self.camera, ui, rect);
        if !tells {
            return;
        }
        let mut keys = marks.key();
        keys.extend(self.settings.cut.text(&tree.root_cell()));
        let legend = legend::Legend {
            marks: keys,
            settings: &self.settings,
            headline: if boxes.is_some() {
                legend::Headline::Boxes
            } else if of_ray {
                legend::Headline::OfRay
            } else if shows_boxes {
                legend::Headline::Waiting
            } else {
                legend::Headline::None
            },
            pyramid: self.shows_picture_camera(),
            boxes: boxes.as_deref(),
            waits_for: waits_for.as_deref(),
            drawn,
            picked: current.picked.as_ref(),
            left_out,
            open: self.is_legend_open(),
        };
        if legend::show(&legend, ui, rect) {
            self.fold_legend();
        }
    }

    fn globals(&self, rect: Rect, center: Vec3, bounds: &Aabb, root: &Aabb) -> Globals {
        let [forward, right, up] = self.camera.frame();
        let eye = self.camera.camera.from - center;
        let full = |v: Vec3, w: f32| v.as_vec3().extend(w).to_array();
        let clip = self.camera.clip_from_scene(center, bounds);
        Globals {
            clip_from_scene: clip.as_mat4().to_cols_array_2d(),
            eye: full(eye, f32::from(u8::from(self.camera.orthographic))),
            forward: full(forward, 0.0),
            right: full(right, 0.0),
            up: full(up, 0.0),
            cut: self.settings.cut.for_shader(root, center),
            size: [rect.width(), rect.height()],
            radius: bounds.size().length() as f32 * 0.5,
            opacity: 1.0,
        }
    }

    /// The picked pixel's rays with the steps of the selected one and the object hit, and the picture's
    /// camera if it is different.
    fn lines_for(&mut self, current: &Current, center: Vec3) -> Vec<Line> {
        const WHITE: [u8; 4] = [255; 4];
        let others = self.settings.all_rays;
        let mut lines = self.rays.get(current, others, center).to_vec();
        if let Some(picked) = &current.picked
            && picked.path().hit.is_hit()
            && let Some(bounds) = framing::picked(current)
        {
            lines.extend(overlay::box_lines(&bounds, center, WHITE, 1.0));
        }
        if self.shows_picture_camera() {
            let render = &current.shown.setup.render;
            let aspect = f64::from(render.width) / f64::from(render.height);
            let camera = &current.shown.measurement.camera;
            let length = camera.from.distance(camera.at);
            lines.extend(overlay::frustum_lines(camera, aspect, length, center));
        }
        lines
    }

    /// Writes 1, 2, 3 … into the leaves that the ray visited.
    fn number_leaves(&self, ui: &egui::Ui, rect: Rect, path: &RayPath) {
        let painter = ui.painter().with_clip_rect(rect);
        let mut taken: Vec<egui::Pos2> = Vec::new();
        let n = path.leaves().count();
        for (i, leaf) in path.leaves().enumerate() {
            let Some([x, y]) = self.camera.place(leaf.bounds.center()) else {
                continue;
            };
            let half = rect.height() * 0.5;
            let at = rect.center() + vec2(x as f32, -y as f32) * half;
            if !rect.contains(at) || taken.iter().any(|p| p.distance(at) < 13.0) {
                continue;
            }
            taken.push(at);
            let [r, g, b] = overlay::order_color(i, n);
            let font = egui::FontId::proportional(12.0);
            let text = (i + 1).to_string();
            painter.text(
                at + vec2(1.0, 1.0),
                egui::Align2::CENTER_CENTER,
                &text,
                font.clone(),
                Color32::BLACK,
            );
            let color = Color32::from_rgb(r, g, b);
            painter.text(at, egui::Align2::CENTER_CENTER, text, font, color);
        }
    }
}

/// A line of text in the middle of the view.
pub fn note(ui: &egui::Ui, rect: Rect, text: &str) {
    ui.painter().text(
        rect.center(),
        egui::Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(14.0),
        Color32::LIGHT_GRAY,
    );
}
