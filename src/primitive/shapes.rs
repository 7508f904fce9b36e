//! The objects of a scene for intersection kernels: in one precision, and as an array of one kind if the
//! scene has only one.

use super::packed::{
    Form, PackedCone, PackedPolygon, PackedPrimitive, PackedSphere, PackedTriangle,
};
use super::{
    Cone, Polygon, Precision, Primitive, PrimitiveKind, Shape, Sphere, Triangle, UnitFrame,
};
use crate::geometry::Aabb;

/// The objects of a scene by index, in one of two precisions.
pub enum Shapes {
    F64(Arrays<Sphere, Triangle, Polygon, Cone, Primitive>),
    F32 {
        frame: UnitFrame,
        arrays: Arrays<PackedSphere, PackedTriangle, PackedPolygon, PackedCone, PackedPrimitive>,
        /// `None` if no object has a width.
        thinnest: Option<ThinnestObject>,
    },
}

/// The object with the smallest width relative to its rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinnestObject {
    pub object: u32,
    /// Its width ([`super::Shape::min_width`]) divided by its rounding ([`Shapes::rounding`]).
    pub min_width: f64,
}

/// The array of all objects. A scene of one kind needs no branch on the kind per test.
pub enum Arrays<S, T, P, C, M> {
    Spheres(Vec<S>),
    Triangles(Vec<T>),
    Polygons(Vec<P>),
    Cones(Vec<C>),
    Mixed(Vec<M>),
}

/// Evaluates `$body` with `$objects` bound to the array, monomorphized for each kind.
macro_rules! with_array {
    ($arrays:expr, $objects:ident => $body:expr) => {
        match $arrays {
            $crate::primitive::Arrays::Spheres(v) => {
                let $objects = v.as_slice();
                $body
            }
            $crate::primitive::Arrays::Triangles(v) => {
                let $objects = v.as_slice();
                $body
            }
            $crate::primitive::Arrays::Polygons(v) => {
                let $objects = v.as_slice();
                $body
            }
            $crate::primitive::Arrays::Cones(v) => {
                let $objects = v.as_slice();
                $body
            }
            $crate::primitive::Arrays::Mixed(v) => {
                let $objects = v.as_slice();
                $body
            }
        }
    };
}
pub(crate) use with_array;

impl<S, T, P, C, M> Arrays<S, T, P, C, M>
where
    S: Form<Of = Sphere>,
    T: Form<Of = Triangle>,
    P: Form<Of = Polygon>,
    C: Form<Of = Cone>,
    M: Form<Of = Primitive>,
{
    fn of(objects: &[Primitive], frame: &UnitFrame) -> Self {
        macro_rules! only {
            ($variant:ident) => {
                objects
                    .iter()
                    .filter_map(|object| match object {
                        Primitive::$variant(shape) => Some(Form::of(shape, frame)),
                        _ => None,
                    })
                    .collect()
            };
        }
        let kind = objects.first().map(Primitive::kind);
        match kind.filter(|kind| objects.iter().all(|o| o.kind() == *kind)) {
            Some(PrimitiveKind::Sphere) => Arrays::Spheres(only!(Sphere)),
            Some(PrimitiveKind::Triangle) => Arrays::Triangles(only!(Triangle)),
            Some(PrimitiveKind::Polygon) => Arrays::Polygons(only!(Polygon)),
            Some(PrimitiveKind::Cone) => Arrays::Cones(only!(Cone)),
            None => Arrays::Mixed(objects.iter().map(|o| Form::of(o, frame)).collect()),
        }
    }
}

impl Shapes {
    /// Converts objects within `bounds` to a precision.
    pub fn of(objects: &[Primitive], bounds: &Aabb, precision: Precision) -> Self {
        let frame = UnitFrame::around(bounds);
        match precision {
            Precision::F64 => Shapes::F64(Arrays::of(objects, &frame)),
            Precision::F32 => {
                let arrays = Arrays::of(objects, &frame);
                let roundings = with_array!(&arrays, forms => {
                    forms.iter().map(Form::rounding).map(|r| r / frame.scale()).collect()
                });
                Shapes::F32 {
                    frame,
                    arrays,
                    thinnest: thinnest(objects, roundings),
                }
            }
        }
    }

    pub fn precision(&self) -> Precision {
        match self {
            Shapes::F64(_) => Precision::F64,
            Shapes::F32 { .. } => Precision::F32,
        }
    }

    /// Returns a bound on the distance, a length in the world, by which rounding to `f32` may move the surface
    /// of an object, and a point on it from the surface.
    pub fn rounding(&self, object: u32) -> f64 {
        match self {
            Shapes::F64(_) => 0.0,
            Shapes::F32 { frame, arrays, .. } => {
                with_array!(arrays, objects => objects[object as usize].rounding()) / frame.scale()
            }
        }
    }

    /// Returns the memory of the objects in bytes.
    pub fn bytes(&self) -> usize {
        macro_rules! sum {
            ($arrays:expr) => {
                with_array!($arrays, objects => objects.iter().map(Form::bytes).sum())
            };
        }
        match self {
            Shapes::F64(arrays) => sum!(arrays),
            Shapes::F32 { arrays, .. } => sum!(arrays),
        }
    }
}

/// Returns the object with the smallest width relative to its rounding. Ignores objects without width, such
/// as a sphere of radius 0: rounding does not change their shape.
fn thinnest(objects: &[Primitive], roundings: Vec<f64>) -> Option<ThinnestObject> {
    let widths = objects.iter().zip(roundings).zip(0..);
    let thin = widths.filter_map(|((shape, rounding), object)| {
        let min_width = shape.min_width() / rounding;
        (min_width > 0.0).then_some(ThinnestObject { object, min_width })
    });
    thin.min_by(|a, b| a.min_width.total_cmp(&b.min_width))
}
