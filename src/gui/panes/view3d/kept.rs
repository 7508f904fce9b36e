//! What the 3D view shows, to and from a workspace.

use super::cut::Cut;
use super::settings::{Cells, Settings};
use super::view::View3d;
use crate::present::overlay::{self, Filter};
use crate::workspace::View3dSettings;

impl View3d {
    /// As a workspace has it.
    pub(super) fn kept(&self) -> View3dSettings {
        if let Some(waiting) = &self.restoring {
            return waiting.clone();
        }
        // In the task *Ray*, what returns with its end.
        let (camera, settings, own) = match self.ray_task.before() {
            Some(before) => (&before.camera, &before.settings, before.own),
            None => (&self.camera, &self.settings, self.own),
        };
        let Settings {
            scene,
            cells,
            coloring,
            filter,
            outside,
            focus: _,
            cut,
            linked,
            all_rays,
        } = settings;
        let [least_depth, greatest] = filter.depth;
        View3dSettings {
            objects: *scene,
            leaf_boxes: *cells != Cells::None,
            coloring: coloring.name.to_owned(),
            full_leaves: filter.full,
            empty_leaves: filter.empty,
            visited: filter.visited,
            outside: *outside,
            least_depth,
            greatest_depth: (greatest != u32::MAX).then_some(greatest),
            only_visited: *cells == Cells::Visited,
            cells_to_depth: match cells {
                Cells::ToDepth(depth) => Some(*depth),
                _ => None,
            },
            all_rays: *all_rays,
            orthographic: camera.orthographic,
            camera: own.then_some(camera.camera),
            same_camera: *linked,
            cut: cut.kept(),
        }
    }

    /// Takes over what waits for the scene that is there now.
    pub(super) fn take_over(&mut self, kept: &View3dSettings) {
        let all = Filter::default();
        self.settings = Settings {
            scene: kept.objects,
            cells: match kept.cells_to_depth {
                _ if !kept.leaf_boxes => Cells::None,
                _ if kept.only_visited => Cells::Visited,
                Some(depth) => Cells::ToDepth(depth),
                None => Cells::All,
            },
            coloring: overlay::coloring(&kept.coloring).unwrap_or(self.settings.coloring),
            filter: Filter {
                depth: [kept.least_depth, kept.greatest_depth.unwrap_or(u32::MAX)],
                full: kept.full_leaves,
                empty: kept.empty_leaves,
                visited: kept.visited,
                ..all
            },
            outside: kept.outside,
            focus: None,
            cut: Cut::of(&kept.cut),
            linked: kept.same_camera,
            all_rays: kept.all_rays,
        };
        self.own = kept.camera.is_some();
        self.camera.orthographic = kept.orthographic;
        if let Some(camera) = kept.camera {
            self.camera.camera = camera;
        }
    }
}
