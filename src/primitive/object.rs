//! An object of any kind.

use super::exact::{Root, Stage, Surface};
use super::{Cone, Polygon, PrimitiveKind, Shape, Sphere, SurfacePoint, Triangle};
use crate::geometry::{Aabb, Ray};

/// One object of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    Sphere(Sphere),
    Triangle(Triangle),
    Polygon(Polygon),
    Cone(Cone),
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

/// Evaluates `$answer` with `$shape` bound to the object of whichever kind.
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

impl Primitive {
    /// Returns the arithmetic that decides [`Shape::intersect`] with this limit, or [`Shape::is_hit`] without
    /// one.
    pub fn deciding_stage(&self, ray: &Ray, limit: Option<f64>) -> Stage {
        match self {
            Primitive::Sphere(sphere) => {
                let crossings = sphere.estimates(ray);
                sphere.exact().deciding_stage(crossings, ray, limit)
            }
            Primitive::Triangle(triangle) => {
                let surface = Surface::Triangle(&triangle.vertices);
                surface.deciding_stage([triangle.estimate(ray)], ray, limit)
            }
            Primitive::Polygon(polygon) => polygon.with_surface(ray, |surface, estimate| {
                surface.deciding_stage([estimate], ray, limit)
            }),
            Primitive::Cone(cone) => {
                let surface = Surface::Cone(*cone.ends());
                surface.deciding_stage(cone.estimates(ray), ray, limit)
            }
        }
    }
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

    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        each_kind!(self, shape => shape.certain_bounds_within(cell))
    }

    fn least_box_area(&self) -> f64 {
        each_kind!(self, shape => shape.least_box_area())
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        each_kind!(self, shape => Shape::intersect(shape, ray, t_max))
    }

    #[inline]
    fn is_hit(&self, ray: &Ray) -> bool {
        each_kind!(self, shape => shape.is_hit(ray))
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        each_kind!(self, shape => shape.exact_distance(ray))
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
