//! The 3D view: the scene, the leaves of its tree, and the rays of the picked pixel.

mod actions;
mod camera;
mod controls;
mod cut;
mod drawing;
mod export;
mod kept;
mod leaf_boxes;
mod legend;
mod marks;
mod pipelines;
mod ray_lines;
mod ray_task;
mod renderer;
mod scene_mesh;
mod settings;
mod side_view;
mod steering;

use crate::gui::action::Gesture;
use crate::gui::document::Document;
use crate::gui::document::tasks::Latest;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::widgets::common::rest_of;
use crate::jobs::PictureVisits;
use crate::present::overlay::{self, Line};
use crate::scene::Scene;
use crate::workspace::{self, View3dSettings};
use camera::ViewCamera;
use eframe::egui_wgpu::{self, wgpu};
use egui::{Color32, Rect};
use ray_task::RayTask;
use settings::Settings;
use std::sync::Arc;

/// Behind everything, in both themes: the color maps are made for a dark ground.
const GROUND: [u8; 3] = [24, 27, 33];

/// The 3D view's state.
pub struct View3d {
    /// `None` where there is no graphics adapter.
    adapter: Option<Adapter>,
    camera: ViewCamera,
    /// Whether the camera was moved away from the picture's.
    own: bool,
    settings: Settings,
    /// What the task *Ray* changes for as long as it lasts.
    ray_task: RayTask,
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
    const ACTIONS: &'static [PaneAction<Self>] = actions::ACTIONS;
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
            about: "Select the nearest cell shown; again: the next behind it",
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
        let doc: &Document = cx.doc;
        self.follow(doc);
        let marks = marks::Marks::of(doc, ui.ctx());
        let size = rest_of(ui);
        let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click_and_drag());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Canvas, true, "3D view of scene and tree")
        });
        self.camera.aspect = f64::from(rect.width() / rect.height());
        self.roomy = legend::fits(rect);
        self.shown = Some((ui.ctx().cumulative_frame_nr(), rect));
        let framed = self.frame_wanted(doc, cx.edits);
        if self.steer(ui, &response, doc) || framed {
            self.camera_moved(cx.edits);
            self.moved = ui.input(|i| i.time);
        }
        if self.glide(doc, ui.ctx()) {
            self.moved = ui.input(|i| i.time);
        }
        self.settings.filter.ranges = doc.inspect.ranges;
        let moment = doc.inspect.build.moment();
        if self.settings.filter.moment != moment {
            self.settings.filter.moment = moment;
            self.moved = ui.input(|i| i.time);
        }
        let visits = self.visits(doc);
        self.pick(rect, &response, doc, cx.edits);
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
            (Some(_), Some(current)) => self.draw(ui, rect, current, visits, &marks),
        }
    }

    fn controls(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        controls::show(self, ui, cx.doc);
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
            own: false,
            settings: Settings::default(),
            ray_task: RayTask::default(),
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
    fn visits(&self, doc: &Document) -> Option<Result<Arc<PictureVisits>, String>> {
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
