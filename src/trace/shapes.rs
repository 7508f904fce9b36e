//! The objects as intersection kernels want them: one kind in one array where a scene has one kind.

use crate::geometry::Ray;
use crate::primitive::{Cone, Polygon, Primitive, PrimitiveKind, Shape, Sphere, Triangle};
use crate::scene::Scene;

/// The objects of a scene by number. A scene of one kind runs without a choice of kind per test.
pub enum Shapes<'a> {
    Spheres(Vec<Sphere>),
    Triangles(Vec<Triangle>),
    Polygons(Vec<Polygon>),
    Cones(Vec<Cone>),
    Mixed(&'a [Primitive]),
}

impl<'a> Shapes<'a> {
    /// The objects of a scene.
    pub fn of(scene: &'a Scene) -> Self {
        macro_rules! only {
            ($variant:ident) => {
                scene
                    .objects()
                    .iter()
                    .filter_map(|object| match object {
                        Primitive::$variant(shape) => Some(shape.clone()),
                        _ => None,
                    })
                    .collect()
            };
        }
        match scene.requirements().primitives[..] {
            [(PrimitiveKind::Sphere, _)] => Shapes::Spheres(only!(Sphere)),
            [(PrimitiveKind::Triangle, _)] => Shapes::Triangles(only!(Triangle)),
            [(PrimitiveKind::Polygon, _)] => Shapes::Polygons(only!(Polygon)),
            [(PrimitiveKind::Cone, _)] => Shapes::Cones(only!(Cone)),
            _ => Shapes::Mixed(scene.objects()),
        }
    }
}

/// Intersection by object number; what kernels are compiled for.
pub(super) trait Objects: Sync {
    fn intersect(&self, object: u32, ray: &Ray, t_max: f64) -> Option<f64>;
}

impl<S: Shape> Objects for [S] {
    #[inline(always)]
    fn intersect(&self, object: u32, ray: &Ray, t_max: f64) -> Option<f64> {
        self[object as usize].intersect(ray, t_max)
    }
}

/// Runs `$body` with `$objects` bound to the one array there is, compiled once for every kind.
macro_rules! with_objects {
    ($shapes:expr, $objects:ident => $body:expr) => {
        match $shapes {
            Shapes::Spheres(v) => {
                let $objects = v.as_slice();
                $body
            }
            Shapes::Triangles(v) => {
                let $objects = v.as_slice();
                $body
            }
            Shapes::Polygons(v) => {
                let $objects = v.as_slice();
                $body
            }
            Shapes::Cones(v) => {
                let $objects = v.as_slice();
                $body
            }
            Shapes::Mixed(v) => {
                let $objects = *v;
                $body
            }
        }
    };
}
pub(super) use with_objects;
