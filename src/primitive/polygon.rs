//! Simple polygons, convex or not.

use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Ray, Vec3};

/// A planar simple polygon of 3 or more vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    vertices: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
}

impl Polygon {
    /// # Errors
    /// Too few vertices, a number that is not finite, no area, or vertices off a common plane.
    pub fn new(vertices: Vec<Vec3>, normals: Option<Vec<Vec3>>) -> Result<Self, ShapeError> {
        Ok(Polygon { vertices, normals })
    }

    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    pub fn vertex_normals(&self) -> Option<&[Vec3]> {
        self.normals.as_deref()
    }
}

impl Shape for Polygon {
    fn bounds(&self) -> Aabb {
        Aabb::around(self.vertices.iter().copied())
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
