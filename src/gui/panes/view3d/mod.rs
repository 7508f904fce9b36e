//! The 3D view: the scene, the leaves of its tree, and the rays of the picked pixel.

mod camera;
mod controls;
mod cut;
mod export;
mod kept;
mod leaf_boxes;
mod legend;
mod marks;
mod pipelines;
mod ray_lines;
mod renderer;
mod scene_mesh;

use crate::geometry::{Aabb, Vec3};
use crate::gui::action::Gesture;
use crate::gui::document::tasks::Latest;
use crate::gui::document::{Current, Document};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::jobs::PictureVisits;
use crate::present::overlay::{self, Line};
use crate::primitive::Precision;
use crate::scene::Scene;
use crate::trace::{Scratch, closest_hit};
use crate::workspace::{self, View3dSettings};
use camera::ViewCamera;
use controls::Settings;
use eframe::egui_wgpu::{self, wgpu};
use egui::{Color32, Rect, vec2};
use renderer::{Frame3d, Globals};
use std::sync::Arc;

/// Behind everything, in both themes: the colour maps are made for a dark ground.
const GROUND: [u8; 3] = [24, 27, 33];

/// Boxes that a processor can draw fast enough to follow the mouse, and at rest.
const BOXES_IN_SOFTWARE: [u32; 2] = [12_000, 250_000];

/// How long after the last movement everything is drawn again, in seconds.
const REST: f64 = 0.2;

/// The 3D view's state.
pub struct View3d {
    /// `None` where there is no graphics adapter.
    adapter: Option<Adapter>,
    camera: ViewCamera,
    settings: Settings,
    /// The scene that the camera was set for.
    scene: Option<Arc<Scene>>,
    mesh: Latest<SceneKey, scene_mesh::SceneMesh>,
    boxes: leaf_boxes::Boxes,
    rays: ray_lines::RayLines,
    lines: Arc<Vec<Line>>,
    faces: Arc<Vec<overlay::FaceCorner>>,
    /// When the camera or the build moved last, in seconds.
    moved: f64,
    /// Whether a key moved the camera since the last frame.
    keyed: bool,
    /// Whether the legend is unfolded; `None` until the user said, by the room that there is.
    legend_open: Option<bool>,
    /// Whether there is room for an unfolded legend.
    roomy: bool,
    /// What a workspace shows, until its scene is there.
    restoring: Option<View3dSettings>,
    /// Where it was shown last, and in which frame.
    shown: Option<(u64, Rect)>,
}

/// What draws.
struct Adapter {
    /// The processor does the drawing.
    software: bool,
}

/// A scene by identity.
#[derive(Clone)]
struct SceneKey(Arc<Scene>);

impl PartialEq for SceneKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Pane for View3d {
    const ID: &'static str = "view3d";
    const TITLE: &'static str = "3D";
    const ALIASES: &'static [&'static str] = &["3D view"];
    const ABOUT: &'static str =
        "The scene, the leaves of its tree, and the rays of the picked pixel.";
    const REVEALS: &'static [Fact] = &[];
    const ACTIONS: &'static [PaneAction<Self>] = controls::ACTIONS;
    const GESTURES: &'static [Gesture] = &[
        Gesture {
            gesture: "Left-drag",
            about: "Orbit",
        },
        Gesture {
            gesture: "Right-drag",
            about: "Pan",
        },
        Gesture {
            gesture: "Wheel",
            about: "Zoom to the pointer",
        },
        Gesture {
            gesture: "Click",
            about: "Select the nearest leaf shown; again: the next behind it",
        },
    ];

    fn start(&mut self, graphics: Option<&egui_wgpu::RenderState>) {
        self.adapter = graphics.map(|state| {
            renderer::install(state);
            Adapter {
                software: state.adapter.get_info().device_type == wgpu::DeviceType::Cpu,
            }
        });
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = &mut *cx.doc;
        self.follow(doc);
        let marks = marks::Marks::of(doc, ui.ctx());
        controls::toolbar(self, ui, doc);
        let size = crate::gui::widgets::common::rest_of(ui);
        let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Canvas, true, "3D view of scene and tree")
        });
        self.camera.aspect = f64::from(rect.width() / rect.height());
        self.roomy = legend::fits(rect);
        self.shown = Some((ui.ctx().cumulative_frame_nr(), rect));
        let framed = self.frame_wanted(doc);
        if self.steer(ui, &response, doc) || framed {
            self.moved = ui.input(|i| i.time);
            if self.settings.linked {
                doc.wanted.render.camera = self.camera.camera.into();
            }
        }
        self.settings.filter.ranges = doc.inspect.ranges;
        let moment = doc.inspect.build.moment();
        if self.settings.filter.moment != moment {
            self.settings.filter.moment = moment;
            self.moved = ui.input(|i| i.time);
        }
        let visits = self.visits(doc);
        self.pick(rect, &response, doc);
        let [r, g, b] = GROUND;
        ui.painter()
            .rect_filled(rect, 0.0, Color32::from_rgb(r, g, b));
        match (&self.adapter, &doc.current) {
            (None, _) => {
                note(
                    ui,
                    rect,
                    "The 3D view needs a graphics adapter; there is none.",
                );
            }
            (Some(_), None) => note(ui, rect, "No scene yet"),
            (Some(_), Some(current)) => {
                let tells = !doc.hides(&[Fact::Tree, Fact::Steps]);
                self.draw(ui, rect, current, visits, &marks, tells);
            }
        }
    }

    fn choices(&self) -> Vec<String> {
        let titles = overlay::COLORINGS.iter().map(|coloring| coloring.title);
        titles
            .map(|title| format!("Color leaves by: {title}"))
            .collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        self.settings.coloring = &overlay::COLORINGS[place];
        cx.edits.request(Request::Show(Self::ID));
    }

    fn save(&self, view: &mut workspace::View) {
        view.view3d = self.kept();
    }

    fn load(&mut self, view: &workspace::View) {
        self.restoring = Some(view.view3d.clone());
    }
}

impl Default for View3d {
    fn default() -> Self {
        View3d {
            adapter: None,
            camera: ViewCamera::default(),
            settings: Settings::default(),
            scene: None,
            mesh: Latest::default(),
            boxes: leaf_boxes::Boxes::default(),
            rays: ray_lines::RayLines::default(),
            lines: Arc::default(),
            faces: Arc::default(),
            moved: f64::NEG_INFINITY,
            keyed: false,
            legend_open: None,
            roomy: true,
            restoring: None,
            shown: None,
        }
    }
}

impl View3d {
    /// The visits that the boxes shown need: those of the picture, or why there are none yet. `None`
    /// where they need none.
    fn visits(&self, doc: &mut Document) -> Option<Result<Arc<PictureVisits>, String>> {
        let current = doc.current.as_ref()?;
        let Settings {
            filter, coloring, ..
        } = &self.settings;
        if !filter.needs_visits() && !coloring.needs_visits() {
            return None;
        }
        let visits = doc.inspect.visits.of(current, &doc.jobs);
        Some(visits.ok_or_else(|| doc.inspect.visits.note(current).unwrap_or_default()))
    }

    /// Shows the node that another pane asks for; says whether there was one.
    fn frame_wanted(&mut self, doc: &mut Document) -> bool {
        let (Some(node), Some(current)) = (doc.inspect.frame.take(), &doc.current) else {
            return false;
        };
        self.camera.show(&current.shown.tree.cell_of(node).bounds);
        true
    }

    /// Where it is on the screen; `None` where another pane hides it, or nothing can be drawn.
    pub fn on_screen(&self, ctx: &egui::Context) -> Option<Rect> {
        let (frame, rect) = self.shown?;
        let fresh = frame + 1 >= ctx.cumulative_frame_nr();
        (fresh && self.adapter.is_some()).then_some(rect)
    }

    /// Which leaves are shown; of the finished tree.
    pub fn filter(&self) -> overlay::Filter {
        overlay::Filter {
            moment: None,
            ..self.settings.filter
        }
    }

    fn is_legend_open(&self) -> bool {
        self.legend_open.unwrap_or(self.roomy)
    }

    /// Folds the legend, or unfolds it.
    fn fold_legend(&mut self) {
        self.legend_open = Some(!self.is_legend_open());
    }

    /// Takes over a new scene's camera, or the picture's while linked.
    fn follow(&mut self, doc: &Document) {
        let Some(current) = &doc.current else {
            return;
        };
        let shown = &current.shown;
        let known = self
            .scene
            .as_ref()
            .is_some_and(|scene| Arc::ptr_eq(scene, &shown.scene));
        let reset =
            self.settings.linked && doc.wanted.render.camera.is_none() && !doc.is_previous();
        if !known || reset {
            self.camera.camera = shown.measurement.camera;
        }
        if !known {
            self.scene = Some(Arc::clone(&shown.scene));
            self.settings.filter.depth = overlay::Filter::default().depth;
        }
        if !doc.is_previous()
            && let Some(kept) = self.restoring.take()
        {
            self.camera.camera = shown.measurement.camera;
            self.take_over(&kept);
        }
    }

    /// Links the picture's camera to this view's, which goes where the picture's is.
    fn link(&mut self, linked: bool, doc: &Document) {
        self.settings.linked = linked;
        if linked && let Some(current) = &doc.current {
            self.camera.camera = current.shown.measurement.camera;
        }
    }

    /// Mouse and keys; says whether the camera moved.
    fn steer(&mut self, ui: &egui::Ui, response: &egui::Response, doc: &Document) -> bool {
        let rect = response.rect;
        let mut moved = false;
        let by = response.drag_delta() / rect.height();
        let (dx, dy) = (f64::from(by.x), f64::from(by.y));
        if by != egui::Vec2::ZERO {
            if response.dragged_by(egui::PointerButton::Primary) {
                self.camera.orbit(dx, dy);
                moved = true;
            } else if response.dragged_by(egui::PointerButton::Secondary)
                || response.dragged_by(egui::PointerButton::Middle)
            {
                self.camera.pan(dx, dy);
                moved = true;
            }
        }
        let wheel = ui.input(|i| i.smooth_scroll_delta().y);
        if wheel != 0.0
            && let Some(pointer) = response.hover_pos()
        {
            let factor = libm::exp(-f64::from(wheel) * 0.004);
            self.camera
                .zoom(factor, self.point_under(pointer, rect, doc));
            moved = true;
        }
        if std::mem::take(&mut self.keyed) {
            moved = true;
            // A key that is held keeps moving.
            ui.ctx().request_repaint();
        }
        moved
    }

    /// Selects the leaf whose box is clicked.
    fn pick(&self, rect: Rect, response: &egui::Response, doc: &mut Document) {
        if let Some(at) = response.interact_pointer_pos()
            && response.clicked()
            && self.settings.boxes
        {
            let at = (at - rect.center()) / (rect.height() * 0.5);
            let ray = self.camera.ray(f64::from(at.x), f64::from(-at.y));
            let leaf = marks::pick_leaf(doc, &self.settings, &ray);
            if let Some(current) = &mut doc.current {
                current.selection.node = leaf;
            }
        }
    }

    /// The point of the scene under the pointer; where there is none, at the orbited distance.
    fn point_under(&self, pointer: egui::Pos2, rect: Rect, doc: &Document) -> Vec3 {
        let half = rect.height() * 0.5;
        let at = (pointer - rect.center()) / half;
        let ray = self.camera.ray(f64::from(at.x), f64::from(-at.y));
        if let Some(current) = &doc.current {
            let (scene, tree) = (&current.shown.scene, &current.shown.tree);
            let shapes = scene.shapes(Precision::F64);
            let hit = closest_hit(tree, shapes, &ray, &mut Scratch::default(), &mut ());
            if hit.is_hit() {
                return ray.at(hit.t);
            }
        }
        self.camera.on_target_plane(&ray)
    }

    /// Draws the scene and the tree; numbers only where it `tells` them.
    fn draw(
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
        let only_visited = self.settings.only_visited && path.is_some();
        let (visits, waits_for) = match visits {
            Some(Ok(visits)) => (Some(visits), None),
            Some(Err(why)) => (None, Some(why)),
            None => (None, None),
        };
        let boxes = (self.settings.boxes && !only_visited && waits_for.is_none())
            .then(|| {
                let Settings {
                    filter, coloring, ..
                } = self.settings;
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
        if !self.settings.linked {
            let eye = current.shown.measurement.camera.from;
            bounds = bounds.union(&Aabb::new(eye, eye));
        }
        let left_out = mesh.as_ref().map_or(0, |mesh| mesh.left_out);
        let pixels = ctx.pixels_per_point();
        let frame = Frame3d {
            globals: self.globals(rect, center, &bounds, &tree.root_cell()),
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
        marks.name(self, ui, rect);
        if !tells {
            return;
        }
        let mut keys = marks.key();
        keys.extend(self.settings.cut.text(&tree.root_cell()));
        let legend = legend::Legend {
            marks: keys,
            settings: &self.settings,
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
            size: [
                rect.width(),
                rect.height(),
                bounds.size().length() as f32 * 0.5,
                0.0,
            ],
        }
    }

    /// The picked pixel's rays with the selected one's walk and the object hit, and the picture's camera if it is another.
    fn lines_for(&mut self, current: &Current, center: Vec3) -> Vec<Line> {
        const WHITE: [u8; 4] = [255; 4];
        let others = self.settings.all_rays;
        let mut lines = self.rays.get(current, others, center).to_vec();
        if let Some(picked) = &current.picked
            && picked.path().hit.is_hit()
            && let Some(bounds) = controls::selection(current)
        {
            lines.extend(overlay::box_lines(&bounds, center, WHITE, 1.0));
        }
        if !self.settings.linked {
            let render = &current.shown.setup.render;
            let aspect = f64::from(render.width) / f64::from(render.height);
            let camera = &current.shown.measurement.camera;
            let length = camera.from.distance(camera.at);
            lines.extend(overlay::frustum_lines(camera, aspect, length, center));
        }
        lines
    }

    /// Writes 1, 2, 3 … into the leaves that the ray visited.
    fn number_leaves(&self, ui: &egui::Ui, rect: Rect, path: &crate::trace::RayPath) {
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
fn note(ui: &egui::Ui, rect: Rect, text: &str) {
    ui.painter().text(
        rect.center(),
        egui::Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(14.0),
        Color32::LIGHT_GRAY,
    );
}
