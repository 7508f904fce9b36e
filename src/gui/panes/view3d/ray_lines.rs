//! The lines of the picked pixel's rays and of the current step, made when they change.

use crate::geometry::{Aabb, Vec3};
use crate::gui::document::Current;
use crate::present::overlay::{Line, RaysShown, ray_lines, step_lines, visited_lines};
use crate::trace::PixelRecord;
use std::sync::Arc;

/// What decides the lines.
#[derive(Clone)]
struct Key {
    record: Arc<PixelRecord>,
    ray: usize,
    step: usize,
    others: bool,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.record, &other.record)
            && (self.ray, self.step, self.others) == (other.ray, other.step, other.others)
    }
}

/// The lines made last.
#[derive(Default)]
pub struct RayLines {
    made: Option<(Key, Vec<Line>)>,
}

impl RayLines {
    /// The lines of what is picked; none if nothing is. `others`: those of unselected rays, too.
    pub fn get(&mut self, current: &Current, others: bool, center: Vec3) -> &[Line] {
        let Some(picked) = &current.picked else {
            self.made = None;
            return &[];
        };
        let key = Key {
            record: Arc::clone(&picked.record),
            ray: picked.ray,
            step: picked.step,
            others,
        };
        if self.made.as_ref().is_none_or(|(made, _)| *made != key) {
            let tree = &current.shown.tree;
            let camera = &current.shown.measurement.camera;
            let root = tree.root_cell();
            let shown = RaysShown {
                selected: picked.ray,
                others,
                // Lights may stand far outside the scene.
                space: root.enlarged(root.size().length()),
                mark: camera.from.distance(camera.at) * 0.008,
            };
            let mut lines = visited_lines(picked.path(), picked.step, center);
            lines.extend(ray_lines(&picked.record, &shown, center));
            lines.extend(step_lines(tree, picked.path(), picked.step, center));
            self.made = Some((key, lines));
        }
        self.made.as_ref().map_or(&[], |(_, lines)| lines)
    }
}

/// The box around the ends of lines.
pub fn bounds_of(lines: &[Line], center: Vec3) -> Aabb {
    let ends = lines.iter().flat_map(|line| [line.a, line.b]);
    Aabb::around(ends.map(|end| center + Vec3::from(end.map(f64::from))))
}
