//! The 3D view: the scene, the leaves of its tree, and the rays of the picked pixel.

mod actions;
mod beside_ray;
mod camera;
mod controls;
mod cut;
mod drawing;
mod export;
mod framing;
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
mod view;

use crate::gui::action::Gesture;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::rest_of;
use crate::present::overlay::COLORINGS;
use crate::workspace;
use eframe::egui_wgpu::{self, wgpu};
use egui::Color32;
use view::Adapter;
pub use view::View3d;

impl Pane for View3d {
    const ID: &'static str = "view3d";
    const TITLE: &'static str = "3D";
    const ALIASES: &'static [&'static str] = &["3D view"];
    const ABOUT: &'static str =
        "The scene, the leaves of its tree, and the rays of the picked pixel.";
    const REVEALS: &'static [Fact] = &[];
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
        let doc = cx.doc;
        self.follow(doc);
        self.follow_selection(doc);
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
        let [r, g, b] = drawing::GROUND;
        ui.painter()
            .rect_filled(rect, 0.0, Color32::from_rgb(r, g, b));
        match (&self.adapter, &doc.current) {
            (None, _) => {
                drawing::note(
                    ui,
                    rect,
                    "The 3D view needs a graphics adapter; there is none.",
                );
            }
            (Some(_), None) => drawing::note(ui, rect, "No scene yet"),
            (Some(_), Some(current)) => {
                let tells = !doc.hides(&[Fact::Tree, Fact::Steps]);
                self.draw(ui, rect, current, visits, &marks, tells);
            }
        }
    }

    fn controls(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        controls::show(self, ui, cx.doc);
    }

    fn choices(&self) -> Vec<String> {
        let titles = COLORINGS.iter().map(|coloring| coloring.title);
        titles
            .map(|title| format!("Color leaves by: {title}"))
            .collect()
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        self.settings.coloring = &COLORINGS[place];
        cx.edits.request(Request::Show(Self::ID));
    }

    fn save(&self, view: &mut workspace::View) {
        view.view3d = self.kept();
    }

    fn load(&mut self, view: &workspace::View) {
        self.restoring = Some(view.view3d.clone());
    }
}
