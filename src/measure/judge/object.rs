//! Intersections of a ray with an object of any kind.

use super::crossing::{Crossing, Line};
use super::span::rational;
use super::tolerance::Tolerance;
use super::{flat, quadric};
use crate::primitive::Primitive;

/// Returns all possible intersections of the ray and the object, at most two.
pub fn crossings(object: &Primitive, line: &Line<'_>, tolerance: &Tolerance) -> Vec<Crossing> {
    let reach = rational(tolerance.length);
    let found = match object {
        Primitive::Sphere(sphere) => quadric::sphere(sphere, line, &reach),
        Primitive::Cone(cone) => quadric::cone(cone, line, &reach),
        Primitive::Triangle(triangle) => {
            flat::triangle(triangle, line, &reach).into_iter().collect()
        }
        Primitive::Polygon(polygon) => flat::polygon(polygon, line, &reach).into_iter().collect(),
    };
    found
        .into_iter()
        .filter_map(|crossing| crossing.within(line.ray))
        .collect()
}
