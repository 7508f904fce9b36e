//! The interface of all primitives.

use super::exact::Root;
use crate::geometry::{Aabb, Ray, Vec3};

/// What tree builders and ray tracers need from a primitive.
pub trait Shape: Send + Sync {
    /// Returns the object's bounds. Every point that [`Shape::intersect`] can report lies inside,
    /// including rounding.
    fn bounds(&self) -> Aabb;

    /// Returns whether the object shares a point with a closed cell; `true` where rounding leaves it open.
    fn overlaps(&self, cell: &Aabb) -> bool;

    /// Returns the bounds of the object's part within a closed cell, up to rounding; `None` if there is no
    /// such part. By default these are the bounds clipped to the cell.
    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let part = self.bounds().intersection(cell);
        (!part.is_empty()).then_some(part)
    }

    /// Returns a box within a closed cell that certainly contains every point of the object there that
    /// [`Shape::intersect`] can report; `None` only if there certainly is none. By default these are the bounds
    /// clipped to the cell.
    ///
    /// In contrast to [`Shape::bounds_within`], the box is wide enough in spite of rounding, so the boxes of the
    /// parts between planes cover the object.
    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let part = self.bounds().intersection(cell);
        (!part.is_empty()).then_some(part)
    }

    /// Returns a lower bound on the surface area of all boxes around the object's parts, however small the
    /// parts are (T. Karras and T. Aila, Fast parallel construction of high-quality bounding volume hierarchies,
    /// 2013). By default it is the area of the bounds: division does not help.
    fn least_box_area(&self) -> f64 {
        self.bounds().surface_area()
    }

    /// Returns the smallest `t` of the ray's interval at which it hits the surface, rounded to the nearest
    /// number, if any and if that is at most `t_max`. Exact ([`super::exact`]): nothing else is rounded.
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64>;

    /// Returns whether [`Shape::intersect`] finds a hit up to the ray's end. Needs no distance, so it is faster.
    fn is_hit(&self, ray: &Ray) -> bool;

    /// Returns the `t` of [`Shape::intersect`] as a number that is not rounded. The ray must hit the object.
    fn exact_distance(&self, ray: &Ray) -> Option<Root>;

    /// Returns the surface at a `t` that [`Shape::intersect`] returned.
    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint;

    /// Returns the smallest width of the surface, a length; 0 for a point. A precision that cannot
    /// distinguish it from 0 cannot distinguish the object from a line or a point.
    fn min_width(&self) -> f64;

    /// Returns the object's memory in bytes, including what it points to.
    fn bytes(&self) -> usize
    where
        Self: Sized,
    {
        size_of::<Self>()
    }
}

/// A point of a surface, for shading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    pub point: Vec3,
    /// Unit normal of the surface. The primitive determines its side: outwards for solids.
    pub normal: Vec3,
    /// Unit normal for shading: interpolated from vertex normals, or equal to `normal`.
    pub shading_normal: Vec3,
    /// Bound on the distance between `point` and the true surface, a length.
    pub error: f64,
}

/// Why numbers do not define a primitive.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    #[error("a coordinate or radius is not a finite number")]
    NotFinite,
    #[error("the radius {0} is negative")]
    NegativeRadius(f64),
    #[error("a polygon needs at least 3 vertices, found {0}")]
    TooFewVertices(usize),
    #[error("the polygon has no area")]
    ZeroArea,
    #[error("the vertices lie up to {0:e} off a common plane")]
    NotPlanar(f64),
    #[error("the axis has no length")]
    NoLength,
    #[error("{normals} vertex normals for {vertices} vertices")]
    NormalCount { vertices: usize, normals: usize },
}
