//! The 3D view's state.

use super::camera::ViewCamera;
use super::ray_task::RayTask;
use super::settings::Settings;
use super::{leaf_boxes, ray_lines, scene_mesh};
use crate::gui::document::Document;
use crate::gui::document::tasks::Latest;
use crate::jobs::PictureVisits;
use crate::present::overlay::{FaceCorner, Filter, Line, Outside};
use crate::scene::Scene;
use crate::structure::{NodeKind, Tree};
use crate::workspace::View3dSettings;
use egui::Rect;
use std::sync::Arc;

/// The 3D view's state.
pub struct View3d {
    /// `None` where there is no graphics adapter.
    pub(super) adapter: Option<Adapter>,
    pub(super) camera: ViewCamera,
    /// Whether the camera was moved away from the picture's.
    pub(super) own: bool,
    pub(super) settings: Settings,
    /// The tree of which a subtree stands out.
    pub(super) focused: Option<Arc<Tree>>,
    /// What the task *Ray* changes for as long as it lasts.
    pub(super) ray_task: RayTask,
    /// The scene that the camera was set for.
    pub(super) scene: Option<Arc<Scene>>,
    pub(super) mesh: Latest<SceneKey, scene_mesh::SceneMesh>,
    pub(super) boxes: leaf_boxes::Boxes,
    pub(super) rays: ray_lines::RayLines,
    pub(super) lines: Arc<Vec<Line>>,
    pub(super) faces: Arc<Vec<FaceCorner>>,
    /// When the camera or the build moved last, in seconds.
    pub(super) moved: f64,
    /// Whether a key moved the camera since the last frame.
    pub(super) keyed: bool,
    /// Whether the legend is unfolded; `None` until the user said, by the room that there is.
    pub(super) legend_open: Option<bool>,
    /// Whether there is room for an unfolded legend.
    pub(super) roomy: bool,
    /// What a workspace shows, until its scene is there.
    pub(super) restoring: Option<View3dSettings>,
    /// Where it was shown last, and in which frame.
    pub(super) shown: Option<(u64, Rect)>,
}

/// What draws.
pub struct Adapter {
    /// The processor does the drawing.
    pub(super) software: bool,
}

/// A scene by identity.
#[derive(Clone)]
pub struct SceneKey(pub Arc<Scene>);

impl PartialEq for SceneKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Default for View3d {
    fn default() -> Self {
        View3d {
            adapter: None,
            camera: ViewCamera::default(),
            own: false,
            settings: Settings::default(),
            focused: None,
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
    pub fn visits(&self, doc: &Document) -> Option<Result<Arc<PictureVisits>, String>> {
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

    /// Lets the subtree of the selected node stand out. A leaf that is selected in it, as by a click on a box,
    /// changes nothing.
    pub(super) fn follow_selection(&mut self, doc: &Document) {
        let current = doc.current.as_ref();
        let selected = current.and_then(|c| Some((&c.shown.tree, c.selection.node?)));
        let Some((tree, node)) = selected.filter(|_| self.settings.outside != Outside::Shown)
        else {
            self.settings.focus = None;
            return;
        };
        let is_same = self.focused.as_ref().is_some_and(|t| Arc::ptr_eq(t, tree));
        let focus = self.settings.focus.filter(|_| is_same);
        let is_leaf = tree.kind(node) != NodeKind::Inner;
        let is_within = focus.is_some_and(|root| (root..tree.end_of(root)).contains(&node));
        if !(is_leaf && is_within) {
            self.settings.focus = Some(node);
        }
        if !is_same {
            self.focused = Some(Arc::clone(tree));
        }
    }

    /// Where it is on the screen; `None` where another pane hides it, or nothing can be drawn.
    pub fn on_screen(&self, ctx: &egui::Context) -> Option<Rect> {
        let (frame, rect) = self.shown?;
        let fresh = frame + 1 >= ctx.cumulative_frame_nr();
        (fresh && self.adapter.is_some()).then_some(rect)
    }

    /// Which leaves are shown; of the finished tree.
    pub fn filter(&self) -> Filter {
        Filter {
            moment: None,
            ..self.settings.filter
        }
    }

    /// Whether the picture's camera is drawn: where the view has one of its own, unless it is beside a ray.
    pub fn shows_picture_camera(&self) -> bool {
        self.own && self.ray_task.before().is_none()
    }

    pub fn is_legend_open(&self) -> bool {
        self.legend_open.unwrap_or(self.roomy)
    }

    /// Folds the legend, or unfolds it.
    pub fn fold_legend(&mut self) {
        self.legend_open = Some(!self.is_legend_open());
    }
}
