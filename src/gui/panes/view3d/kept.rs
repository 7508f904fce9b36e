//! What the 3D view shows, to and from a workspace.

use super::View3d;
use super::controls::Settings;
use super::cut::Cut;
use crate::present::overlay::{self, Filter};
use crate::workspace::View3dSettings;

impl View3d {
    /// As a workspace has it.
    pub(super) fn kept(&self) -> View3dSettings {
        if let Some(waiting) = &self.restoring {
            return waiting.clone();
        }
        let Settings {
            scene,
            boxes,
            coloring,
            filter,
            cut,
            linked,
            only_visited,
            all_rays,
        } = &self.settings;
        let [least_depth, greatest] = filter.depth;
        View3dSettings {
            objects: *scene,
            leaf_boxes: *boxes,
            coloring: coloring.name.to_owned(),
            full_leaves: filter.full,
            empty_leaves: filter.empty,
            visited: filter.visited,
            least_depth,
            greatest_depth: (greatest != u32::MAX).then_some(greatest),
            only_visited: *only_visited,
            all_rays: *all_rays,
            orthographic: self.camera.orthographic,
            camera: (!linked).then_some(self.camera.camera),
            cut: cut.kept(),
        }
    }

    /// Takes over what waits for the scene that is there now.
    pub(super) fn take_over(&mut self, kept: &View3dSettings) {
        let all = Filter::default();
        self.settings = Settings {
            scene: kept.objects,
            boxes: kept.leaf_boxes,
            coloring: overlay::coloring(&kept.coloring).unwrap_or(self.settings.coloring),
            filter: Filter {
                depth: [kept.least_depth, kept.greatest_depth.unwrap_or(u32::MAX)],
                full: kept.full_leaves,
                empty: kept.empty_leaves,
                visited: kept.visited,
                ..all
            },
            cut: Cut::of(&kept.cut),
            linked: kept.camera.is_none(),
            only_visited: kept.only_visited,
            all_rays: kept.all_rays,
        };
        self.camera.orthographic = kept.orthographic;
        if let Some(camera) = kept.camera {
            self.camera.camera = camera;
        }
    }
}
