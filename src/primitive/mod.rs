//! The primitives a scene can hold. A kind is one file and one variant of [`Primitive`].
//!
//! All of them are surfaces without thickness that are seen from both sides. For the overlap with
//! a cell, spheres, cylinders and cones count as solid bodies, as in the paper's method 1.

mod clip;
mod cone;
mod gjk;
mod numeric;
mod packed;
mod packed_ray;
mod polygon;
mod precision;
mod shapes;
mod sphere;
mod triangle;
mod unit_frame;

pub use cone::Cone;
pub use packed::Form;
pub(crate) use packed::{PackedSphere, PackedTriangle};
pub(crate) use packed_ray::FramedRay;
pub use packed_ray::PackedRay;
pub use polygon::Polygon;
pub use precision::Precision;
pub(crate) use shapes::with_array;
pub use shapes::{Arrays, Shapes, ThinnestObject};
pub use sphere::Sphere;
pub use triangle::Triangle;
pub use unit_frame::UnitFrame;

use crate::geometry::{Aabb, Ray, Vec3};

/// What a tree and a tracer ask of a primitive.
pub trait Shape: Send + Sync {
    /// The box around the object: every point that [`Shape::intersect`] can report lies inside,
    /// rounding included.
    fn bounds(&self) -> Aabb;

    /// Whether the object shares a point with a closed cell. Where rounding leaves it open: `true`.
    fn overlaps(&self, cell: &Aabb) -> bool;

    /// Bounds of the object's part within a closed cell, as near as arithmetic tells; `None` if there
    /// is none. Kinds that do not say better: the bounds cut off at the cell.
    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let part = self.bounds().intersection(cell);
        (!part.is_empty()).then_some(part)
    }

    /// The smallest `t` in `[ray.t_min, t_max]` at which the ray meets the surface; `None` if none.
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64>;

    /// The surface where the ray meets it at `t`, which [`Shape::intersect`] returned.
    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint;

    /// The surface's least width, a length: numbers must tell it from 0 to tell the object from a
    /// line or a point. 0 for a point.
    fn min_width(&self) -> f64;

    /// Bytes that the object takes, with what it points to.
    fn bytes(&self) -> usize
    where
        Self: Sized,
    {
        size_of::<Self>()
    }
}

/// A point of a surface, as shading needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    pub point: Vec3,
    /// Unit normal of the surface itself; its side is the primitive's own (outwards for solids).
    pub normal: Vec3,
    /// Unit normal for shading; equals `normal` but for interpolated vertex normals.
    pub shading_normal: Vec3,
    /// Bound on the distance between `point` and the true surface, a length.
    pub error: f64,
}

/// Why a primitive cannot be made from the numbers given.
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

/// One object of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    Sphere(Sphere),
    Triangle(Triangle),
    Polygon(Polygon),
    Cone(Cone),
}

/// The kinds of primitive, in the order in which reports list them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PrimitiveKind {
    Sphere,
    Triangle,
    Polygon,
    Cone,
}

impl PrimitiveKind {
    pub const ALL: [PrimitiveKind; 4] = [
        PrimitiveKind::Sphere,
        PrimitiveKind::Triangle,
        PrimitiveKind::Polygon,
        PrimitiveKind::Cone,
    ];

    /// Singular, in a word.
    pub const fn name(self) -> &'static str {
        match self {
            PrimitiveKind::Sphere => "sphere",
            PrimitiveKind::Triangle => "triangle",
            PrimitiveKind::Polygon => "polygon",
            PrimitiveKind::Cone => "cone",
        }
    }

    /// Plural, as in a list of what a scene holds.
    pub const fn plural(self) -> &'static str {
        match self {
            PrimitiveKind::Sphere => "spheres",
            PrimitiveKind::Triangle => "triangles",
            PrimitiveKind::Polygon => "polygons",
            PrimitiveKind::Cone => "cylinders and cones",
        }
    }
}

impl Primitive {
    pub const fn kind(&self) -> PrimitiveKind {
        match self {
            Primitive::Sphere(_) => PrimitiveKind::Sphere,
            Primitive::Triangle(_) => PrimitiveKind::Triangle,
            Primitive::Polygon(_) => PrimitiveKind::Polygon,
            Primitive::Cone(_) => PrimitiveKind::Cone,
        }
    }
}

macro_rules! each_kind {
    ($self:ident, $shape:ident => $answer:expr) => {
        match $self {
            Primitive::Sphere($shape) => $answer,
            Primitive::Triangle($shape) => $answer,
            Primitive::Polygon($shape) => $answer,
            Primitive::Cone($shape) => $answer,
        }
    };
}

impl Shape for Primitive {
    fn bounds(&self) -> Aabb {
        each_kind!(self, shape => shape.bounds())
    }

    fn overlaps(&self, cell: &Aabb) -> bool {
        each_kind!(self, shape => shape.overlaps(cell))
    }

    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        each_kind!(self, shape => shape.bounds_within(cell))
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        each_kind!(self, shape => Shape::intersect(shape, ray, t_max))
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        each_kind!(self, shape => shape.surface(ray, t))
    }

    fn min_width(&self) -> f64 {
        each_kind!(self, shape => shape.min_width())
    }

    fn bytes(&self) -> usize {
        let inside = each_kind!(self, shape => Shape::bytes(shape) - size_of_val(shape));
        size_of::<Self>() + inside
    }
}
