//! The primitives that a scene can hold. A kind is one file and one variant of [`Primitive`].
//!
//! All of them are surfaces without thickness that are visible from both sides. For the overlap with
//! a cell, spheres, cylinders and cones are solid bodies, as in the paper's method 1.

mod clip;
mod cone;
mod estimate;
pub(crate) mod exact;
mod gjk;
mod kind;
mod numeric;
mod object;
mod packed;
mod packed_ray;
mod polygon;
mod precision;

mod shape;
mod shapes;
mod sphere;
mod triangle;
mod unit_frame;

pub(crate) use clip::cut_off;
pub use cone::Cone;
pub(crate) use estimate::Estimate;
pub use exact::Stage;
pub(crate) use exact::nearest_in_plane;
pub use kind::PrimitiveKind;
pub(crate) use numeric::rotated;
pub use object::Primitive;
pub use packed::Form;
pub(crate) use packed::{PackedSphere, PackedTriangle};
pub(crate) use packed_ray::FramedRay;
pub use packed_ray::PackedRay;
pub use polygon::Polygon;
pub use precision::Precision;
pub use shape::{Shape, ShapeError, SurfacePoint};
pub(crate) use shapes::with_array;
pub use shapes::{Arrays, Shapes, ThinnestObject};
pub use sphere::Sphere;
pub use triangle::Triangle;
pub use unit_frame::UnitFrame;
