//! Cases about geometry: degenerate objects, duplicate objects, and the rules for outlines.

use super::case::Case;
use super::scenes::{aims, features, polygon, scene_of, sphere, spread, triangle, unit};
use super::trial::{Outcome, Trial};
use crate::geometry::{Ray, Vec3};
use crate::measure::judge::Answer;
use crate::primitive::{Cone, Polygon, Primitive, ShapeError, Triangle};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::format::nff;
use crate::trace::{Hit, RayKind};

pub const CASES: &[Case] = &[
    Case::of_its_own_scenes(
        "slivers",
        "triangles and quadrilaterals of aspect 10 to 10^8, at them and at their edges: right hits",
        slivers,
    ),
    Case::of_its_own_scenes(
        "no area",
        "triangles and polygons with equal vertices or all on a line are refused with the reason; \
         a file's are skipped with a note",
        no_area,
    ),
    Case::of_its_own_scenes(
        "coplanar overlaps",
        "triangles and polygons over each other in one plane: right hits, the lowest number of equal \
         distances",
        coplanar,
    ),
    Case::of_its_own_scenes(
        "identical objects",
        "10,000 times the same sphere and triangle: right hits; where a tree would pass 256 MiB, the \
         error that says so, and right hits with D_MAX 8 or the coarsest grid",
        identical,
    ),
    Case::of_its_own_scenes(
        "flat scenes",
        "objects in one plane, and points on one line: right hits",
        flat,
    ),
    Case::of_its_own_scenes(
        "one object, none",
        "a scene of one object of each kind, and one of nothing: right hits",
        few,
    ),
    Case::of_its_own_scenes(
        "polygons",
        "concave outlines, vertices on a line, equal neighbors and outlines that cross themselves \
         (inside by the even-odd rule): right hits",
        polygons,
    ),
    Case::of_its_own_scenes(
        "cylinders and cones",
        "without length refused with the reason; thin, flat, and with a tip: right hits, also at the \
         tip",
        cones,
    ),
    Case::of_its_own_scenes(
        "nested and touching spheres",
        "one in the other a thousandfold, and touching in points: right hits; memory as for identical \
         objects",
        spheres,
    ),
];

fn check(trial: &Trial<'_>, objects: Vec<Primitive>) -> Outcome {
    let scene = scene_of(objects);
    let count = trial.rays(&scene);
    let mut rays = aims(&scene, count);
    for (ray, target) in rays.clone().iter().zip(features(&scene, count)) {
        rays.push(Ray::new(ray.origin, target - ray.origin));
    }
    trial.check(&scene, &trial.settings(), &rays)
}

fn slivers(trial: &Trial<'_>) -> Outcome {
    let mut objects = Vec::new();
    for i in 0..64 {
        let [u, v, w, x, y, z] = spread(i);
        let width = 10f64.powi(-1 - (i as i32 / 2) % 8);
        let along = unit(u, v);
        let across = along.any_orthonormal_vector() * width;
        let at = 3.0 * Vec3::new(x, y, z);
        if i % 2 == 0 {
            objects.push(triangle(at, at + along, at + w * along + across));
        } else {
            let corners = [at, at + along, at + along + across, at + across];
            objects.push(polygon(&corners.map(|p| p.to_array())));
        }
    }
    check(trial, objects)
}

fn no_area(_: &Trial<'_>) -> Outcome {
    let (a, b) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.3, 0.7, 0.2));
    let outlines: [&[Vec3]; 4] = [
        &[a, a, a],
        &[a, b, a],
        &[a, b, 0.5 * a + 0.5 * b],
        &[a, b, b, a],
    ];
    Outcome::all(outlines.map(|outline| {
        let triangle = match *outline {
            [a, b, c] => Triangle::new([a, b, c], None).err(),
            _ => Some(ShapeError::ZeroArea),
        };
        let polygon = Polygon::new(outline.to_vec(), None).err();
        let zero_area = Some(ShapeError::ZeroArea);
        let mut file = format!(
            "v from 0 0 -5 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 8 8 p {}",
            outline.len()
        );
        for v in outline {
            file += &format!(" {} {} {}", v.x, v.y, v.z);
        }
        let skipped = nff::read(file.as_bytes(), &Progress::new())
            .is_ok_and(|scene| scene.objects.is_empty() && !scene.notes.is_empty());
        Outcome::check(
            triangle == zero_area && polygon == zero_area && skipped,
            || format!("{outline:?} counts as a surface"),
        )
    }))
}

fn coplanar(trial: &Trial<'_>) -> Outcome {
    let mut objects = Vec::new();
    for i in 0..24 {
        let shift = f64::from(i % 6) * 0.25;
        let at = |x: f64, y: f64| [x + shift, y + 0.5 * shift, 1.0];
        if i % 2 == 0 {
            let corners = [at(0.0, 0.0), at(2.0, 0.0), at(0.0, 2.0)];
            let [a, b, c] = corners.map(Vec3::from_array);
            objects.push(triangle(a, b, c));
        } else {
            objects.push(polygon(&[
                at(0.0, 0.0),
                at(2.0, 0.0),
                at(2.0, 2.0),
                at(0.0, 2.0),
            ]));
        }
    }
    check(trial, objects)
}

fn identical(trial: &Trial<'_>) -> Outcome {
    let count = if trial.quick { 1000 } else { 10_000 };
    let (a, b, c) = (
        Vec3::ZERO,
        Vec3::new(1.0, 0.2, 0.1),
        Vec3::new(0.3, 1.0, 0.4),
    );
    Outcome::all([sphere(a, 1.0), triangle(a, b, c)].map(|object| {
        let scene = scene_of(vec![object; count]);
        trial.check_bounded(&scene, &aims(&scene, trial.rays(&scene) / 5))
    }))
}

fn flat(trial: &Trial<'_>) -> Outcome {
    let in_plane = |axis: usize, height: f64| {
        let mut objects = Vec::new();
        for i in 0..40 {
            let [x, y, ..] = spread(i);
            let corner = |dx: f64, dy: f64| {
                let mut v = [0.0; 3];
                v[axis] = height;
                v[(axis + 1) % 3] = 4.0 * x + dx;
                v[(axis + 2) % 3] = 4.0 * y + dy;
                v
            };
            objects.push(polygon(&[
                corner(0.0, 0.0),
                corner(0.5, 0.0),
                corner(0.5, 0.5),
                corner(0.0, 0.5),
            ]));
        }
        objects
    };
    let mut scenes: Vec<_> = (0..3)
        .flat_map(|axis| [0.0, 0.1].map(|height| in_plane(axis, height)))
        .collect();
    // Spheres of radius 0 on a line. Rays exactly through their centers hit them.
    scenes.push(
        (0..40)
            .map(|i| sphere(Vec3::X * f64::from(i), 0.0))
            .collect(),
    );
    Outcome::all(scenes.into_iter().map(|objects| check(trial, objects)))
}

fn few(trial: &Trial<'_>) -> Outcome {
    let cone = Cone::new(Vec3::ZERO, 1.0, Vec3::Z, 0.5).expect("it has an axis");
    let scenes = [
        vec![],
        vec![sphere(Vec3::splat(0.3), 1.5)],
        vec![triangle(Vec3::ZERO, Vec3::X, Vec3::Y)],
        vec![polygon(&[
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.5],
            [1.0, 1.0, 1.5],
            [0.0, 1.0, 1.0],
        ])],
        vec![Primitive::Cone(cone)],
    ];
    Outcome::all(scenes.map(|objects| check(trial, objects)))
}

fn polygons(trial: &Trial<'_>) -> Outcome {
    let star: Vec<[f64; 3]> = (0..5)
        .map(|i| {
            let turn = std::f64::consts::TAU * f64::from(2 * i) / 5.0;
            [libm::cos(turn), libm::sin(turn), 3.0]
        })
        .collect();
    let outlines: [&[[f64; 3]]; 5] = [
        // Concave: an L and a comb.
        &[
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
        ],
        &[
            [0.0, 0.0, 1.0],
            [3.0, 0.0, 1.0],
            [3.0, 2.0, 1.0],
            [2.0, 0.5, 1.0],
            [1.5, 2.0, 1.0],
            [1.0, 0.5, 1.0],
            [0.0, 2.0, 1.0],
        ],
        // Collinear vertices and duplicate vertices.
        &[
            [0.0, 0.0, 2.0],
            [0.5, 0.0, 2.0],
            [1.0, 0.0, 2.0],
            [1.0, 0.0, 2.0],
            [1.0, 1.0, 2.0],
            [0.0, 1.0, 2.0],
            [0.0, 1.0, 2.0],
            [0.0, 0.5, 2.0],
        ],
        &star,
        // Self-intersecting, like a bow tie, in the plane x + y + z = 4.
        &[
            [4.0, 0.0, 0.0],
            [0.0, 3.0, 1.0],
            [0.0, 4.0, 0.0],
            [3.0, 0.5, 0.5],
        ],
    ];
    let objects: Vec<_> = outlines.iter().map(|outline| polygon(outline)).collect();
    // By the even–odd rule the middle of the star is outside, so a ray there must miss.
    let scene = scene_of(vec![objects[3].clone()]);
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let middle = match trial.tree(&scene, &trial.settings()) {
        Ok(tree) => Outcome::check(
            trial.ask(&scene, &tree, RayKind::Primary, &[ray]) == [Answer::Nearest(Hit::MISS)],
            || "the middle of a five-pointed star is hit".to_owned(),
        ),
        Err(outcome) => outcome,
    };
    Outcome::all([middle, check(trial, objects)])
}

fn cones(trial: &Trial<'_>) -> Outcome {
    let no_length = Cone::new(Vec3::ONE, 1.0, Vec3::ONE, 0.5) == Err(ShapeError::NoLength);
    let refused = Outcome::check(no_length, || {
        "a cylinder without length is accepted".to_owned()
    });
    let cone = |base: Vec3, r: f64, apex: Vec3, s: f64| {
        Primitive::Cone(Cone::new(base, r, apex, s).expect("it has a length"))
    };
    let objects = vec![
        cone(Vec3::ZERO, 1.0, Vec3::Z * 2.0, 0.0),
        cone(Vec3::Z * 4.0, 0.0, Vec3::new(1.0, 1.0, 2.0), 0.7),
        // One very thin cylinder, one very flat cylinder, and one very flat cone.
        cone(Vec3::X * 3.0, 1e-6, Vec3::new(3.0, 1.0, 2.0), 1e-6),
        cone(Vec3::Y * 3.0, 1.0, Vec3::new(0.0, 3.0, 1e-6), 1.0),
        cone(Vec3::Y * 5.0, 1.0, Vec3::new(0.0, 5.0, 1e-3), 0.1),
    ];
    let scene = scene_of(objects.clone());
    let tips = [Vec3::Z * 2.0, Vec3::Z * 4.0];
    let at_tips: Vec<Ray> = aims(&scene, trial.rays(&scene))
        .iter()
        .enumerate()
        .map(|(i, ray)| Ray::new(ray.origin, tips[i % 2] - ray.origin))
        .collect();
    Outcome::all([
        refused,
        check(trial, objects),
        trial.check(&scene, &trial.settings(), &at_tips),
    ])
}

fn spheres(trial: &Trial<'_>) -> Outcome {
    let nested = (1..=1000).map(|i| sphere(Vec3::splat(0.1), f64::from(i) * 0.001));
    let touching = (0..64).map(|i| {
        let at = |k: i32| f64::from(i / k % 4);
        sphere(Vec3::new(at(1), at(4), at(16)), 0.5)
    });
    Outcome::all(
        [nested.collect::<Vec<_>>(), touching.collect()].map(|objects| {
            let scene: Scene = scene_of(objects);
            let mut rays = aims(&scene, trial.rays(&scene));
            // Aim at the points where the touching spheres meet, and start at the center of the
            // nested ones.
            for (i, ray) in rays.clone().iter().enumerate() {
                let half = |k: usize| f64::from((i / k % 8) as u32) * 0.5;
                let target = Vec3::new(half(1), half(8), half(64));
                rays.push(Ray::new(ray.origin, target - ray.origin));
                rays.push(Ray::new(Vec3::splat(0.1), ray.direction));
            }
            trial.check_bounded(&scene, &rays)
        }),
    )
}
