//! Random objects on a coarse lattice, and rays made to meet their vertices, edges and faces exactly.

use bspscope::geometry::{Ray, Vec3};
use bspscope::primitive::{Cone, Polygon, Primitive, Sphere, Triangle};
use proptest::prelude::*;

/// Lattice points: many coordinates coincide with each other and with midpoint planes.
pub fn lattice() -> impl Strategy<Value = Vec3> {
    (-4i32..=4, -4i32..=4, -4i32..=4).prop_map(|(x, y, z)| Vec3::new(x.into(), y.into(), z.into()))
}

pub fn primitive() -> impl Strategy<Value = Primitive> {
    prop_oneof![
        (lattice(), 1u32..=4).prop_filter_map("sphere", |(center, r)| {
            Some(Primitive::Sphere(
                Sphere::new(center, f64::from(r) * 0.5).ok()?,
            ))
        }),
        (lattice(), lattice(), lattice()).prop_filter_map("no area", |(a, b, c)| {
            Some(Primitive::Triangle(Triangle::new([a, b, c], None).ok()?))
        }),
        // Axis-aligned squares: they lie in split planes.
        (lattice(), 0usize..3, 1u32..=3).prop_filter_map("square", |(corner, axis, side)| {
            let mut u = Vec3::ZERO;
            let mut v = Vec3::ZERO;
            u[(axis + 1) % 3] = f64::from(side);
            v[(axis + 2) % 3] = f64::from(side);
            let loop_ = vec![corner, corner + u, corner + u + v, corner + v];
            Some(Primitive::Polygon(Polygon::new(loop_, None).ok()?))
        }),
        (lattice(), lattice(), 0u32..=2, 0u32..=2).prop_filter_map("cone", |(a, b, r, s)| {
            let (r, s) = (f64::from(r) * 0.5, f64::from(s) * 0.5);
            Some(Primitive::Cone(Cone::new(a, r, b, s).ok()?))
        }),
    ]
}

/// Along axes and diagonals with exact zeros of both signs, from lattice points and from far away;
/// at vertices; along split planes; and at random.
pub fn ray() -> impl Strategy<Value = Ray> {
    let component = prop_oneof![
        4 => Just(0.0),
        2 => Just(-0.0),
        3 => Just(1.0),
        3 => Just(-1.0),
        1 => Just(5e-324),
        1 => Just(-1e-300),
    ];
    let stiff =
        (component.clone(), component.clone(), component).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    let aimed = (lattice(), lattice(), 0.0f64..3.0).prop_map(|(from, to, away)| {
        let d = to - from;
        (from - d * 10f64.powf(away * 2.0), d)
    });
    let free = (
        prop::array::uniform3(-6.0f64..6.0),
        prop::array::uniform3(-1.0f64..1.0),
    )
        .prop_map(|(o, d)| (Vec3::from_array(o), Vec3::from_array(d)));
    prop_oneof![
        3 => (lattice(), stiff).prop_map(|(o, d)| (o, d)),
        3 => aimed,
        2 => free,
    ]
    .prop_filter("a direction", |(_, d)| d.abs().max_element() > 1e-200)
    .prop_map(|(o, d)| Ray::new(o, d))
}
