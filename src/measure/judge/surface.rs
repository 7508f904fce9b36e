//! Surfaces as the numbers that define them, and the intersections of a ray with one.

use super::crossing::{Crossing, Line};
use super::span::rational;
use super::tolerance::Tolerance;
use super::{flat, quadric};
use crate::geometry::{Aabb, Vec3};
use crate::primitive::exact::ConeEnds;
use crate::primitive::{Primitive, UnitFrame};

/// The numbers that define the surface of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    Sphere {
        center: Vec3,
        radius: f64,
    },
    Triangle([Vec3; 3]),
    /// The vertices of the outline, which may be off a common plane by rounding.
    Polygon(Vec<Vec3>),
    Cone(ConeEnds),
}

impl Surface {
    /// Returns the surface of an object in the world.
    pub fn of(object: &Primitive) -> Surface {
        match object {
            Primitive::Sphere(sphere) => Surface::Sphere {
                center: sphere.center,
                radius: sphere.radius,
            },
            Primitive::Triangle(triangle) => Surface::Triangle(triangle.vertices),
            Primitive::Polygon(polygon) => Surface::Polygon(polygon.vertices_in_plane().to_vec()),
            Primitive::Cone(cone) => Surface::Cone(*cone.ends()),
        }
    }

    /// Returns the surface in the coordinates of a frame, with all numbers rounded to `f32`.
    pub fn rounded(&self, frame: &UnitFrame) -> Surface {
        let point = |p: Vec3| frame.point(p).as_vec3().as_dvec3();
        let length = |x: f64| f64::from((x * frame.scale()) as f32);
        match self {
            Surface::Sphere { center, radius } => Surface::Sphere {
                center: point(*center),
                radius: length(*radius),
            },
            Surface::Triangle(vertices) => Surface::Triangle(vertices.map(point)),
            Surface::Polygon(vertices) => {
                Surface::Polygon(vertices.iter().copied().map(point).collect())
            }
            Surface::Cone(cone) => Surface::Cone(ConeEnds {
                base: point(cone.base),
                base_radius: length(cone.base_radius),
                apex: point(cone.apex),
                apex_radius: length(cone.apex_radius),
            }),
        }
    }

    /// Returns a box around the surface, up to the rounding of its own numbers.
    pub fn bounds(&self) -> Aabb {
        match self {
            Surface::Sphere { center, radius } => Aabb::new(*center - *radius, *center + *radius),
            Surface::Triangle(vertices) => Aabb::around(*vertices),
            Surface::Polygon(vertices) => Aabb::around(vertices.iter().copied()),
            Surface::Cone(cone) => quadric::bounds(cone),
        }
    }

    /// Returns all possible intersections of the ray and the surface, at most two.
    pub fn crossings(&self, line: &Line<'_>, tolerance: &Tolerance) -> Vec<Crossing> {
        let reach = rational(tolerance.length);
        let found = match self {
            Surface::Sphere { center, radius } => quadric::sphere(*center, *radius, line, &reach),
            Surface::Cone(cone) => quadric::cone(cone, line, &reach),
            Surface::Triangle(vertices) => {
                flat::triangle(vertices, line, &reach).into_iter().collect()
            }
            Surface::Polygon(vertices) => {
                flat::polygon(vertices, line, &reach).into_iter().collect()
            }
        };
        found
            .into_iter()
            .filter_map(|crossing| crossing.within(line.ray))
            .collect()
    }
}
