//! Which objects of a cell belong to its parts.

use crate::geometry::{Aabb, Axis};
use crate::primitive::{Primitive, PrimitiveKind, Shape};
use crate::tree::{BuildSettings, Frame, ObjectPlanes, OverlapRule};

/// Decides whether an object belongs to a cell into whose parent it came.
pub(super) struct Overlap<'a> {
    objects: &'a [Primitive],
    bounds: &'a [Aabb],
    planes: &'a [ObjectPlanes],
    /// The kinds held against the cell exactly; all others by their bounds.
    exact: [bool; PrimitiveKind::ALL.len()],
    slack: f64,
}

/// Which part of a cell: the one below a plane or the one above it.
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
    /// Objects that end beyond this plane, away from the part, are certainly not in it.
    certain: f32,
    pub(super) bounds: Aabb,
}

impl HalfCell {
    /// `bounds` are those of the part.
    pub(super) fn new(frame: &Frame, bounds: Aabb, side: Side, axis: Axis, plane: f32) -> Self {
        // Twice what the slack and the rounding of both coordinates can amount to.
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

    /// Adds those of a cell's objects that belong to a part of it.
    pub(super) fn select(&self, part: &HalfCell, objects: &[u32], selected: &mut Vec<u32>) {
        let from = selected.len();
        selected.resize(from + objects.len(), 0);
        let mut end = from;
        for &object in objects {
            // Always put there and kept by a count: a branch would often be foretold wrong.
            selected[end] = object;
            end += usize::from(self.reaches(part, object));
        }
        selected.truncate(end);
        if self.exact.contains(&true) {
            let cell = part.bounds.enlarged(self.slack);
            let mut kept = from;
            for place in from..end {
                let object = selected[place];
                let primitive = &self.objects[object as usize];
                if !self.exact[primitive.kind() as usize] || primitive.overlaps(&cell) {
                    selected[kept] = object;
                    kept += 1;
                }
            }
            selected.truncate(kept);
        }
    }

    /// Whether an object's bounds come within the slack of the part. The stored planes tell almost
    /// always; only next to the plane do the bounds themselves.
    #[inline]
    fn reaches(&self, part: &HalfCell, object: u32) -> bool {
        let k = part.axis.index();
        let [lo, hi] = self.planes[object as usize][k];
        let bounds = || &self.bounds[object as usize];
        match part.side {
            Side::Below if (lo >= part.plane) & (lo <= part.certain) => {
                bounds().lo[k] <= part.bounds.hi[k] + self.slack
            }
            Side::Below => lo < part.plane,
            Side::Above if (hi <= part.plane) & (hi >= part.certain) => {
                bounds().hi[k] >= part.bounds.lo[k] - self.slack
            }
            Side::Above => hi > part.plane,
        }
    }
}
