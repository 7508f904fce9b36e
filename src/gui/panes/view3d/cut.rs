//! The plane that cuts the 3D view open: what lies on one side of it is hidden.

use crate::geometry::{Aabb, Axis, Vec3};
use crate::gui::action::{shortcut, tip};
use crate::gui::widgets::common::name_widget;
use crate::workspace::CutSettings;

/// How far a key moves the plane: a share of the root cell.
const STEP: f64 = 0.02;

/// A plane across an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    pub on: bool,
    pub axis: Axis,
    /// Where on each axis the plane lies, 0 to 1 through the root cell.
    places: [f64; 3],
    /// Whether the lesser side is hidden rather than the greater.
    pub hides_less: bool,
}

impl Default for Cut {
    /// Off; through the middle.
    fn default() -> Self {
        Cut {
            on: false,
            axis: Axis::X,
            places: [0.5; 3],
            hides_less: false,
        }
    }
}

impl Cut {
    /// As a workspace has it.
    pub fn kept(&self) -> CutSettings {
        CutSettings {
            on: self.on,
            axis: self.axis,
            places: self.places,
            hides_less: self.hides_less,
        }
    }

    /// As a workspace says; places beyond the root cell at its ends.
    pub fn of(kept: &CutSettings) -> Self {
        Cut {
            on: kept.on,
            axis: kept.axis,
            places: kept.places.map(|place| place.clamp(0.0, 1.0)),
            hides_less: kept.hides_less,
        }
    }

    /// Where the plane lies, in units of length.
    pub fn at(&self, root: &Aabb) -> f64 {
        let k = self.axis.index();
        root.lo[k] + self.places[k] * (root.hi[k] - root.lo[k])
    }

    /// As the shaders take it: a point is hidden where its product with the first three, relative
    /// to `center`, is greater than the fourth; nowhere while the cut is off.
    pub fn for_shader(&self, root: &Aabb, center: Vec3) -> [f32; 4] {
        if !self.on {
            return [0.0; 4];
        }
        let k = self.axis.index();
        let sign = if self.hides_less { -1.0 } else { 1.0 };
        let mut plane = [0.0; 4];
        plane[k] = sign as f32;
        plane[3] = (sign * (self.at(root) - center[k])) as f32;
        plane
    }

    /// Whether all of a box is hidden.
    pub fn hides(&self, bounds: &Aabb, root: &Aabb) -> bool {
        let (k, at) = (self.axis.index(), self.at(root));
        self.on
            && if self.hides_less {
                bounds.hi[k] <= at
            } else {
                bounds.lo[k] >= at
            }
    }

    /// Cuts the view open, or not.
    pub fn toggle(&mut self) {
        self.on ^= true;
    }

    /// Cuts across the next axis.
    pub fn turn(&mut self) {
        self.axis = self.axis.next();
    }

    /// Hides the other side.
    pub fn flip(&mut self) {
        self.hides_less ^= true;
    }

    /// Moves the plane along its axis, by steps.
    pub fn shift(&mut self, steps: f64) {
        let place = &mut self.places[self.axis.index()];
        *place = (*place + steps * STEP).clamp(0.0, 1.0);
    }

    /// The widgets of the cut.
    pub fn controls(&mut self, ui: &mut egui::Ui, root: &Aabb) {
        ui.checkbox(&mut self.on, "Cut").on_hover_text(tip(
            "Cut objects and leaf boxes open: hide what lies on one side of a plane.",
            "view3d.cut",
        ));
        if !self.on {
            return;
        }
        for axis in Axis::ALL {
            ui.selectable_value(&mut self.axis, axis, format!("across {axis}"))
                .on_hover_text(tip("The axis that the plane cuts.", "view3d.cut-axis"));
        }
        let k = self.axis.index();
        let (lo, hi) = (root.lo[k], root.hi[k]);
        let mut at = self.at(root);
        ui.spacing_mut().slider_width = 120.0;
        let slider = egui::Slider::new(&mut at, lo..=hi).max_decimals(4);
        let about = format!(
            "Where the plane cuts the axis, in units of length.\nShortcuts: {} and {}",
            shortcut("view3d.cut-less"),
            shortcut("view3d.cut-more"),
        );
        let slider = ui.add(slider).on_hover_text(about);
        name_widget(ui, &slider, "Place of the cut");
        if slider.changed() && hi > lo {
            self.places[k] = ((at - lo) / (hi - lo)).clamp(0.0, 1.0);
        }
        ui.checkbox(&mut self.hides_less, "Other side")
            .on_hover_text(tip("Hide the other side of the plane.", "view3d.cut-side"));
    }

    /// What is cut, for the legend; `None` while nothing is.
    pub fn text(&self, root: &Aabb) -> Option<String> {
        let side = if self.hides_less { "less" } else { "greater" };
        let (axis, at) = (self.axis, self.at(root));
        self.on
            .then(|| format!("cut at {axis} = {at:.4} units of length: {side} {axis} is hidden"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shader_hides_what_the_cut_hides() {
        let root = Aabb::new(Vec3::new(-1.0, 2.0, 0.0), Vec3::new(3.0, 4.0, 8.0));
        let center = Vec3::new(0.5, 3.0, 1.0);
        let mut cut = Cut::default();
        assert_eq!(cut.for_shader(&root, center), [0.0; 4]);
        cut.toggle();
        for _ in 0..3 {
            for _ in 0..2 {
                let plane = cut.for_shader(&root, center);
                let k = cut.axis.index();
                for place in [0.1, 0.45, 0.55, 0.9] {
                    let mut point = root.center();
                    point[k] = root.lo[k] + place * (root.hi[k] - root.lo[k]);
                    let from = (point - center).as_vec3().to_array();
                    let product: f32 = (0..3).map(|i| from[i] * plane[i]).sum();
                    assert_eq!(product > plane[3], (place > 0.5) != cut.hides_less);
                    assert_eq!(
                        product > plane[3],
                        cut.hides(&Aabb::new(point, point), &root)
                    );
                }
                cut.flip();
            }
            cut.turn();
        }
        for _ in 0..100 {
            cut.shift(1.0);
        }
        assert_eq!(cut.at(&root), root.hi[cut.axis.index()]);
    }
}
