//! Distributes the objects of a cell to its parts.

use super::cell_objects::CellObjects;
use crate::geometry::{Aabb, Axis, Vec3};
use crate::primitive::{Primitive, PrimitiveKind, Shape};
use crate::structure::frame::{Frame, ObjectPlanes};
use crate::structure::settings::{BuildSettings, OverlapRule};

/// Decides whether an object of a cell belongs to one of its parts.
pub(super) struct Overlap<'a> {
    objects: &'a [Primitive],
    bounds: &'a [Aabb],
    planes: &'a [ObjectPlanes],
    /// The kinds that are tested exactly; all others are tested by their bounds.
    exact: [bool; PrimitiveKind::ALL.len()],
    slack: f64,
}

/// The side of a plane.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Below,
    Above,
}

/// The part of a cell on one side of a plane.
pub(super) struct HalfCell {
    side: Side,
    axis: Axis,
    plane: f32,
    /// Objects that end beyond this plane, on the other side, are certainly not in the part.
    certain: f32,
    pub(super) bounds: Aabb,
}

impl HalfCell {
    /// `bounds` are those of the part.
    pub(super) fn new(frame: &Frame, bounds: Aabb, side: Side, axis: Axis, plane: f32) -> Self {
        // Twice the largest possible sum of the slack and the rounding of both coordinates.
        let (_, half) = frame.center_and_half();
        let unsure = 4.0 * frame.slack() / half[axis.index()];
        let certain = match side {
            Side::Below => ((f64::from(plane) + unsure) as f32).next_up(),
            Side::Above => ((f64::from(plane) - unsure) as f32).next_down(),
        };
        HalfCell {
            side,
            axis,
            plane,
            certain,
            bounds,
        }
    }
}

impl<'a> Overlap<'a> {
    pub(super) fn new(
        settings: &BuildSettings,
        objects: &'a [Primitive],
        bounds: &'a [Aabb],
        planes: &'a [ObjectPlanes],
        slack: f64,
    ) -> Self {
        let exact = PrimitiveKind::ALL.map(|kind| match settings.overlap {
            OverlapRule::Paper => {
                kind == PrimitiveKind::Sphere && settings.method.paper_spheres_exactly
            }
            OverlapRule::Bounds => false,
            OverlapRule::Exact => true,
        });
        Overlap {
            objects,
            bounds,
            planes,
            exact,
            slack,
        }
    }

    /// Returns a box, given by its planes, of which every part of the cell that overlaps it certainly
    /// contains the object; `None` if no such box is known.
    pub(super) fn core(&self, frame: &Frame, object: u32) -> Option<ObjectPlanes> {
        let primitive = &self.objects[object as usize];
        if !self.exact[primitive.kind() as usize] {
            return Some(self.planes[object as usize]);
        }
        match primitive {
            Primitive::Sphere(sphere) => {
                // Slightly less than 1 / sqrt(3): the cube inside the sphere.
                let half = Vec3::splat(0.577 * sphere.radius);
                let cube = Aabb::new(sphere.center - half, sphere.center + half);
                Some(frame.planes_around(&cube))
            }
            _ => None,
        }
    }

    /// Adds those of `objects` that belong to a part of the cell to the objects of the part. Either
    /// all of `objects` are inside the cell, or all only touch it.
    pub(super) fn select(
        &self,
        part: &HalfCell,
        objects: &[u32],
        inside: bool,
        to: &mut CellObjects,
    ) {
        let from = [to.inside.len(), to.touching.len()];
        if inside {
            self.select_inside(part, objects, to);
        } else {
            let reaches = |&object: &u32| {
                let [certain, near] = self.reach(part, object);
                certain || near && self.bounds_reach(part, object)
            };
            to.touching.extend(objects.iter().copied().filter(reaches));
        }
        if self.exact.contains(&true) {
            let cell = part.bounds.enlarged(self.slack);
            for (list, from) in [&mut to.inside, &mut to.touching].into_iter().zip(from) {
                self.keep_overlapping(&cell, list, from);
            }
        }
    }

    /// Selects among objects inside the cell: each is inside the part, only touches it, or neither.
    fn select_inside(&self, part: &HalfCell, objects: &[u32], to: &mut CellObjects) {
        let CellObjects { inside, touching } = to;
        let [from, near] = [inside.len(), touching.len()];
        inside.resize(from + objects.len(), 0);
        touching.resize(near + objects.len(), 0);
        let [mut end, mut near_end] = [0; 2];
        let (certain, unsure) = (&mut inside[from..], &mut touching[near..]);
        for &object in objects {
            // Branchless, because this branch mispredicts often: always write, then advance or not.
            let [is_certain, is_near] = self.reach(part, object);
            certain[end] = object;
            unsure[near_end] = object;
            end += usize::from(is_certain);
            near_end += usize::from(is_near);
        }
        inside.truncate(from + end);
        let mut kept = near;
        for place in near..near + near_end {
            let object = touching[place];
            if self.bounds_reach(part, object) {
                let k = part.axis.index();
                let flat = self.planes[object as usize][k] == [part.plane; 2];
                if flat {
                    inside.push(object);
                } else {
                    touching[kept] = object;
                    kept += 1;
                }
            }
        }
        touching.truncate(kept);
    }

    /// Removes the objects from index `from` on that do not overlap the cell.
    fn keep_overlapping(&self, cell: &Aabb, list: &mut Vec<u32>, from: usize) {
        let mut kept = from;
        for place in from..list.len() {
            let object = list[place];
            let primitive = &self.objects[object as usize];
            if !self.exact[primitive.kind() as usize] || primitive.overlaps(cell) {
                list[kept] = object;
                kept += 1;
            }
        }
        list.truncate(kept);
    }

    /// Returns, from the stored planes, whether an object certainly reaches into the part, and
    /// otherwise whether it is so close that its exact bounds must decide.
    #[inline]
    fn reach(&self, part: &HalfCell, object: u32) -> [bool; 2] {
        let [lo, hi] = self.planes[object as usize][part.axis.index()];
        let (certain, near) = match part.side {
            Side::Below => (lo < part.plane, lo <= part.certain),
            Side::Above => (hi > part.plane, hi >= part.certain),
        };
        [certain, near & !certain]
    }

    /// Returns whether the bounds of an object are within the slack of the part.
    fn bounds_reach(&self, part: &HalfCell, object: u32) -> bool {
        let (bounds, k) = (&self.bounds[object as usize], part.axis.index());
        match part.side {
            Side::Below => bounds.lo[k] <= part.bounds.hi[k] + self.slack,
            Side::Above => bounds.hi[k] >= part.bounds.lo[k] - self.slack,
        }
    }
}
