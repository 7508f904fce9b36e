//! Cases with very different sizes and distances in one scene.

use super::case::Case;
use super::scenes::{aims, aims_from, polygon, scene_of, sphere, spread, torus, triangle, unit};
use super::trial::{Outcome, Trial};
use crate::geometry::{Ray, Vec3};
use crate::primitive::{Cone, Precision, Primitive};
use crate::scene::Scene;
use crate::trace::{PrecisionChoice, RenderSettings};

pub const CASES: &[Case] = &[
    Case::of_its_own_scenes(
        "small over large",
        "objects of one size on the ground of another, all pairs of 10^-15, 10^-12 to 10^15: right \
         hits of rays between them, and from far away",
        small_over_large,
    ),
    Case::of_its_own_scenes(
        "small inside large",
        "objects of one size inside a sphere and a cylinder of another, all pairs of 10^-15, 10^-12 \
         to 10^15: right hits of rays between them, and from far away",
        small_inside_large,
    ),
    Case::of_its_own_scenes(
        "edge-on slivers",
        "triangles and quadrilaterals of aspect 1 to 10^12, seen in their plane and at angles of \
         10^-17 to 0.1: right hits",
        edge_on_slivers,
    ),
    Case::of_its_own_scenes(
        "duplicates far from the origin",
        "every object of a mesh three times, 10^7 from the origin: right hits, the lowest number of \
         equal distances",
        far_duplicates,
    ),
    Case::of_its_own_scenes(
        "earth-sized ground",
        "objects of size 1 on a sphere of the earth's radius: right hits and shadows; if f32 is \
         chosen, a warning that it cannot represent them",
        earth_sized_ground,
    ),
];

/// Returns one object of each kind, of this size, on the plane z = `ground`.
fn group(size: f64, ground: f64) -> Vec<Primitive> {
    let at = |x: f64, y: f64, z: f64| Vec3::new(x * size, y * size, ground + z * size);
    let corners = [
        at(-3.0, -1.0, 0.5),
        at(-1.0, -1.0, 0.5),
        at(-1.0, 1.0, 1.0),
        at(-3.0, 1.0, 1.0),
    ];
    let cone = Cone::new(at(0.0, -3.0, 0.0), size, at(0.0, -3.0, 2.0), 0.5 * size);
    vec![
        sphere(at(3.0, 0.0, 1.0), size),
        triangle(at(0.0, 2.0, 0.0), at(1.0, 2.0, 0.5), at(0.0, 3.0, 1.0)),
        polygon(&corners.map(|v| v.to_array())),
        Primitive::Cone(cone.expect("it has an axis")),
    ]
}

/// Returns all pairs of sizes, the smaller one first.
fn pairs(quick: bool) -> Vec<[f64; 2]> {
    // The ratio 10^3 is the only one that f32 can represent.
    let exponents: Vec<i32> = if quick {
        vec![-15, -12, 0, 15]
    } else {
        (-5..=5).map(|k| 3 * k).collect()
    };
    let sizes: Vec<f64> = exponents.into_iter().map(|k| 10f64.powi(k)).collect();
    let larger_than = |i: usize| sizes[i + 1..].iter().map(move |&large| (i, large));
    (0..sizes.len())
        .flat_map(larger_than)
        .map(|(i, large)| [sizes[i], large])
        .collect()
}

/// Checks a scene of small and large objects for every pair of sizes.
fn check_pairs(trial: &Trial<'_>, around: fn(f64) -> Vec<Primitive>) -> Outcome {
    let count = if trial.quick { 10 } else { 40 };
    Outcome::all_representable(pairs(trial.quick).into_iter().map(|[size, large]| {
        let few = group(size, 0.0);
        let small = scene_of(few.clone());
        let scene = scene_of([few, around(large)].concat());
        let rays = rays_between(&small, &scene, count);
        trial
            .check(&scene, &trial.settings(), &rays)
            .of(&format!("sizes {size:e} and {large:e}"))
    }))
}

/// Returns rays at and from the small objects of a scene, and from far away.
fn rays_between(small: &Scene, all: &Scene, count: usize) -> Vec<Ray> {
    let (near, wide) = (aims(small, count), aims(all, count));
    let (far_at_small, far_at_all) = (aims_from(small, count, 1e8), aims_from(all, count, 1e8));
    let outward = near.iter().zip(&wide);
    let outward = outward.map(|(near, wide)| Ray::new(near.origin, -wide.direction));
    let from_large = wide.iter().zip(&near).map(|(wide, near)| {
        let target = near.at(near.origin.length());
        Ray::new(wide.origin, (target - wide.origin).normalize())
    });
    let mut rays: Vec<Ray> = outward.chain(from_large).collect();
    rays.extend([near, wide, far_at_small, far_at_all].concat());
    rays
}

fn small_over_large(trial: &Trial<'_>) -> Outcome {
    check_pairs(trial, |size| {
        let ground = [
            [-size, -size, 0.0],
            [size, -size, 0.0],
            [size, size, 0.0],
            [-size, size, 0.0],
        ];
        let mut objects = group(size, size);
        objects.extend([polygon(&ground), sphere(Vec3::Z * -size, size)]);
        objects
    })
}

fn small_inside_large(trial: &Trial<'_>) -> Outcome {
    check_pairs(trial, |size| {
        let cylinder = Cone::new(Vec3::Z * -size, size, Vec3::Z * size, size);
        vec![
            sphere(Vec3::ZERO, 2.0 * size),
            Primitive::Cone(cylinder.expect("it has an axis")),
        ]
    })
}

fn edge_on_slivers(trial: &Trial<'_>) -> Outcome {
    let step = if trial.quick { 4 } else { 1 };
    Outcome::all_representable((0..=12).step_by(step).map(|ratio| {
        let width = 10f64.powi(-ratio);
        let (mut objects, mut rays) = (Vec::new(), Vec::new());
        for i in 0..8 {
            let [u, v, w, x, y, z] = spread(i + 8 * ratio as usize);
            let along = unit(u, v);
            let across = along.any_orthonormal_vector() * width;
            let at = 3.0 * Vec3::new(x, y, z);
            if i % 2 == 0 {
                objects.push(triangle(at, at + along, at + w * along + across));
            } else {
                let corners = [at, at + along, at + along + across, at + across];
                objects.push(polygon(&corners.map(|p| p.to_array())));
            }
            let normal = along.cross(across).normalize();
            for tilt in (0..=17).step_by(step) {
                let angle = if tilt == 0 { 0.0 } else { 10f64.powi(-tilt) };
                let [a, b, c, ..] = spread(tilt as usize);
                // Within the plane along the sliver, across it, and between.
                for side in [along, across / width, a * along + b * across / width] {
                    let target = at + 0.5 * (along + c * across);
                    let direction = side + angle * normal;
                    rays.push(Ray::new(target - 4.0 * direction, direction));
                }
            }
        }
        trial
            .check(&scene_of(objects), &trial.settings(), &rays)
            .of(&format!("aspect 10^{ratio}"))
    }))
}

fn far_duplicates(trial: &Trial<'_>) -> Outcome {
    let offset = Vec3::new(1e7, -1e7, 1e7);
    let mut objects = torus(12, 6, offset, 2.0, 0.7);
    objects.push(sphere(offset, 1.5));
    let objects = [objects.clone(), objects.clone(), objects].concat();
    let scene = scene_of(objects);
    let count = trial.rays(&scene) / 4;
    let mut rays = aims(&scene, count);
    let targets = super::scenes::features(&scene, count);
    for (ray, target) in rays.clone().iter().zip(targets) {
        rays.push(Ray::new(ray.origin, target - ray.origin));
    }
    trial.check(&scene, &trial.settings(), &rays)
}

fn earth_sized_ground(trial: &Trial<'_>) -> Outcome {
    const RADIUS: f64 = 6.371e6;
    let mut objects = group(1.0, 0.0);
    objects.push(sphere(Vec3::Z * -RADIUS, RADIUS));
    let scene = scene_of(objects);
    if trial.kernel.precision == Precision::F32 {
        let settings = RenderSettings {
            precision: PrecisionChoice::F32,
            ..RenderSettings::default()
        };
        if settings.precision_for(&scene).warning().is_none() {
            return Outcome::fail("nothing warns that f32 cannot represent the objects");
        }
    }
    let small = scene_of(group(1.0, 0.0));
    let count = trial.rays(&scene) / 4;
    let rays = rays_between(&small, &scene, count);
    // Shadow rays from the objects to a light above.
    let shadows = aims(&small, count).into_iter().enumerate().map(|(i, ray)| {
        let [x, y, ..] = spread(i);
        let from = Vec3::new(8.0 * x - 4.0, 8.0 * y - 4.0, 0.0);
        Ray::new(from, ray.origin + 100.0 * Vec3::Z - from)
    });
    let rays = rays.into_iter().chain(shadows).collect::<Vec<_>>();
    trial.check(&scene, &trial.settings(), &rays)
}
