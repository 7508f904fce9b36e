//! The SIMD kernels return the scalar kernel's hits, ray for ray and bit for bit: for every kind of
//! primitive, both precisions and every instruction set of this processor, difficult rays above all.

use crate::support::random::Random;
use crate::support::scenes::{self, tree_with};
use bspscope::geometry::{Ray, Vec3};
use bspscope::primitive::{Cone, Polygon, Precision, Primitive, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::{Camera, Material, Scene, SceneParts};
use bspscope::structure::{BuildSettings, MaxDepth, Method, OverlapRule, SimdTree, Tree};
use bspscope::trace::{
    Hit, InstructionSet, KernelChoice, Picture, RenderSettings, Scratch, SimdKernel, SimdMode,
    any_hit, closest_hit, render_timed, thread_pool,
};
use std::io::Write;
use std::sync::{Mutex, Once};

fn scene(name: &str, objects: Vec<Primitive>) -> Scene {
    Scene::new(SceneParts {
        name: name.into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera: Camera {
            from: Vec3::new(3.0, 2.0, 1.0),
            at: Vec3::ZERO,
            up: Vec3::Z,
            angle: 45.0,
            near: 0.0,
            resolution: [64, 64],
        },
        notes: Vec::new(),
    })
}

/// A mesh whose vertices lie on a lattice, so that many of them lie in split planes, and loose ones.
fn triangles() -> Vec<Primitive> {
    let mut numbers = Random(1);
    let height: Vec<f64> = (0..81).map(|_| 0.25 * numbers.signed()).collect();
    let at = |i: usize, j: usize| {
        let place = |k: usize| k as f64 / 4.0 - 1.0;
        Vec3::new(place(i), place(j), height[9 * j + i])
    };
    let mut triangles: Vec<[Vec3; 3]> = (0..64)
        .map(|k| (k % 8, k / 8))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    for _ in 0..200 {
        let center = numbers.vector();
        triangles.push([(); 3].map(|()| center + 0.2 * numbers.vector()));
    }
    // Twice the same, for ties.
    triangles.extend_from_within(..20);
    triangles
        .into_iter()
        .filter_map(|t| Some(Primitive::Triangle(Triangle::new(t, None).ok()?)))
        .collect()
}

fn spheres() -> Vec<Primitive> {
    let mut numbers = Random(2);
    (0..300)
        .map(|i| {
            let radius = if i % 50 == 0 {
                0.0
            } else {
                0.15 * numbers.signed().abs()
            };
            Primitive::Sphere(Sphere::new(numbers.vector(), radius).unwrap())
        })
        .collect()
}

fn polygons() -> Vec<Primitive> {
    let mut numbers = Random(3);
    (0..200)
        .filter_map(|_| {
            let (center, u, v) = (numbers.vector(), numbers.vector(), numbers.vector());
            let corners = [u, v, -u, -v].map(|c| center + 0.2 * c).to_vec();
            Some(Primitive::Polygon(Polygon::new(corners, None).ok()?))
        })
        .collect()
}

fn cones() -> Vec<Primitive> {
    let mut numbers = Random(4);
    (0..200)
        .filter_map(|_| {
            let (base, along) = (numbers.vector(), 0.3 * numbers.vector());
            let [r, s] = [(); 2].map(|()| 0.1 * numbers.signed().abs());
            Some(Primitive::Cone(Cone::new(base, r, base + along, s).ok()?))
        })
        .collect()
}

fn scenes() -> Vec<Scene> {
    let mixed = [triangles(), spheres(), polygons(), cones()].concat();
    let mut scenes = vec![
        scene("triangles", triangles()),
        scene("spheres", spheres()),
        scene("polygons", polygons()),
        scene("cones", cones()),
        scene("mixed", mixed),
        scene("nothing", Vec::new()),
        scene("one", triangles()[..1].to_vec()),
        // Far from the origin of the world, flat along an axis.
        scene(
            "far and flat",
            spheres()
                .into_iter()
                .filter_map(|object| match object {
                    Primitive::Sphere(s) => {
                        let center = s.center * Vec3::new(1e3, 1e3, 1e-3) + 1e6;
                        Some(Primitive::Sphere(
                            Sphere::new(center, 10.0 * s.radius).ok()?,
                        ))
                    }
                    _ => None,
                })
                .collect(),
        ),
    ];
    for builtin in ["teaching", "tetra:3", "balls:2"] {
        scenes.push(scenes::scene(builtin));
    }
    scenes
}

/// Returns points that matter: corners, centers, and points on planes of the tree.
fn places(scene: &Scene, tree: &Tree) -> Vec<Vec3> {
    let mut places = Vec::new();
    for object in scene.objects() {
        match object {
            Primitive::Triangle(t) => places.extend(t.vertices),
            Primitive::Sphere(s) => places.extend([s.center, s.center + s.radius * Vec3::X]),
            Primitive::Polygon(p) => places.extend(p.vertices().iter().copied()),
            Primitive::Cone(_) => {}
        }
    }
    for cell in tree.cells().step_by(3) {
        places.extend(cell.bounds.corners());
    }
    places
}

/// Returns difficult rays and common ones.
fn rays(scene: &Scene, tree: &Tree) -> Vec<Ray> {
    let mut numbers = Random(5);
    let places = places(scene, tree);
    let (center, size) = (tree.root_cell().center(), tree.root_cell().size().length());
    let mut rays = Vec::new();
    for i in 0..2000 {
        let target = places[numbers.below(places.len())];
        let origin = match i % 4 {
            0 => center + size * numbers.vector(),
            1 => places[numbers.below(places.len())],
            2 => center + 1e5 * size * numbers.vector(),
            _ => center + 0.2 * size * numbers.vector(),
        };
        let to = target - origin;
        let mut direction = to.normalize_or(Vec3::X);
        match i % 9 {
            // Along an axis through the place, with zeros of either sign and denormals.
            0..4 => {
                let k = numbers.below(3);
                let zeros = [0.0, -0.0, 1e-310, -1e-310, 1e-30, -1e-12];
                for other in 0..3 {
                    direction[other] = zeros[numbers.below(zeros.len())];
                }
                direction[k] = if numbers.signed() < 0.0 { -1.0 } else { 1.0 };
            }
            // In a plane across an axis.
            4 => direction[numbers.below(3)] = 0.0,
            // Lengths that are far from 1.
            5 => direction *= 1e100,
            6 => direction *= 1e-100,
            _ => {}
        }
        let origin = match i % 9 {
            0..3 => target - direction * numbers.signed() * size,
            3 => target,
            _ => origin,
        };
        let mut ray = Ray::new(origin, direction);
        match i % 5 {
            0 => ray.t_max = to.length() * numbers.signed().abs(),
            1 => ray.t_max = to.length(),
            2 => ray.t_min = 0.5 * to.length() * numbers.signed().abs(),
            _ => {}
        }
        if i % 97 == 0 {
            ray.t_min = -to.length();
        }
        if i % 101 == 0 {
            ray.direction = Vec3::ZERO;
        }
        rays.push(ray);
    }
    rays
}

/// Returns all SIMD kernels that this processor can run. Prints the instruction sets that it lacks, so
/// that an untested one does not pass for tested.
fn simd_kernels() -> Vec<(InstructionSet, SimdMode)> {
    static PRINT: Once = Once::new();
    let (available, missing): (Vec<_>, Vec<_>) = InstructionSet::ALL
        .into_iter()
        .partition(|set| set.is_available());
    PRINT.call_once(|| {
        for set in missing {
            // Not `eprintln`, whose output the test harness hides.
            let line = format!("SKIPPED: this processor has no {}\n", set.name());
            std::io::stderr().write_all(line.as_bytes()).unwrap();
        }
    });
    assert!(available.contains(&InstructionSet::Portable));
    let kernels: Vec<_> = available
        .into_iter()
        .flat_map(|set| SimdMode::ALL.map(|mode| (set, mode)))
        .collect();
    assert!(kernels.len() >= SimdMode::ALL.len());
    kernels
}

fn exactly(hit: &Hit) -> (u64, u32) {
    (hit.t.to_bits(), hit.object)
}

/// Asserts that all SIMD kernels answer as the scalar kernel does. Returns the number of hits.
fn assert_same(scene: &Scene, tree: &Tree, rays: &[Ray], what: &str) -> usize {
    let simd_tree = SimdTree::of(scene, tree);
    let mut hit_count = 0;
    for precision in Precision::ALL {
        let shapes = scene.shapes(precision);
        let mut scratch = Scratch::default();
        let expected: Vec<Hit> = rays
            .iter()
            .map(|ray| closest_hit(tree, shapes, ray, &mut scratch, &mut ()))
            .collect();
        let blocked: Vec<bool> = rays
            .iter()
            .map(|ray| any_hit(tree, shapes, ray, &mut scratch, &mut ()))
            .collect();
        hit_count += expected.iter().filter(|hit| hit.is_hit()).count();
        for (instructions, mode) in simd_kernels() {
            let mut kernel = SimdKernel::new(tree, simd_tree, shapes, instructions, mode);
            let [precision, mode] = [precision.name(), mode.name()];
            let name = format!("{what}, {precision}, {mode}, {}", instructions.name());
            // Not misses, so that the kernel must overwrite them.
            let mut hits = vec![Hit { t: 0.0, object: 0 }; rays.len()];
            kernel.closest_hits(rays, &mut hits);
            for ((ray, hit), expected) in rays.iter().zip(&hits).zip(&expected) {
                assert_eq!(exactly(hit), exactly(expected), "{name}: {ray:?}");
            }
            let mut found = vec![true; rays.len()];
            kernel.any_hits(rays, &mut found);
            for ((ray, found), expected) in rays.iter().zip(&found).zip(&blocked) {
                assert_eq!(found, expected, "{name}, any hit: {ray:?}");
            }
        }
    }
    hit_count
}

#[test]
fn hits_are_those_of_the_scalar_kernel_bit_for_bit() {
    for scene in scenes() {
        let mut hits = 0;
        for method in Method::all() {
            for overlap in OverlapRule::ALL {
                let settings = BuildSettings {
                    overlap,
                    d_max: MaxDepth::Automatic,
                    ..BuildSettings::for_method(method)
                };
                let tree = tree_with(&scene, &settings);
                let what = format!("{}, {method:?}, {}", scene.name(), overlap.name());
                hits += assert_same(&scene, &tree, &rays(&scene, &tree), &what);
            }
        }
        assert!(
            hits > 500 || scene.objects().len() < 2,
            "{} {hits}",
            scene.name()
        );
    }
}

/// Triangles in a plane, of any size, or each alone and very small.
fn flat_or_small(numbers: &mut Random, small: bool) -> Vec<[Vec3; 3]> {
    let [u, v] = [Vec3::new(0.6, 0.64, 0.48), Vec3::new(-0.8, 0.48, 0.36)];
    let mut corners = Vec::new();
    while corners.len() < 64 {
        let mut triangle = [(); 3].map(|()| numbers.signed() * u + numbers.signed() * v);
        if small {
            let center = numbers.vector();
            triangle = triangle.map(|corner| center + 1e-6 * corner);
        }
        if Triangle::new(triangle, None).is_ok() {
            corners.push(triangle);
        }
    }
    corners
}

/// Rays whose hits `f32` can hardly decide because the angle is flat or the triangle small, and that begin
/// or end at the hit or next to it.
#[test]
fn hits_that_are_hard_to_decide_are_those_of_the_scalar_kernel() {
    for small in [false, true] {
        let mut numbers = Random(7);
        let corners = flat_or_small(&mut numbers, small);
        let objects = corners
            .iter()
            .map(|&triangle| Primitive::Triangle(Triangle::new(triangle, None).unwrap()));
        let scene = scene(if small { "small" } else { "flat" }, objects.collect());
        let settings = scenes::settings("sah");
        let tree = tree_with(&scene, &settings);
        let shapes = scene.shapes(Precision::F32);
        let mut scratch = Scratch::default();
        let mut rays = Vec::new();
        for _ in 0..10_000 {
            let [a, b, c] = corners[numbers.below(corners.len())];
            let (s, t) = (0.5 + 0.5 * numbers.signed(), 0.5 + 0.5 * numbers.signed());
            let target = a + s * (b - a) + s * t * (c - b);
            let slope = 10_f64.powf(-6.0 + 3.0 * numbers.signed());
            let along = numbers.signed() * (b - a) + numbers.signed() * (c - a);
            let normal = (b - a).cross(c - a).normalize();
            let direction = if small {
                numbers.vector().normalize()
            } else {
                (along.normalize() + slope * normal).normalize()
            };
            let distance = 1.0 + 0.9 * numbers.signed();
            let ray = Ray::new(target - distance * direction, direction);
            rays.push(ray);
            let hit = closest_hit(&tree, shapes, &ray, &mut scratch, &mut ());
            if hit.is_hit() {
                let next_to = hit.t * (1.0 + 1e-7 * numbers.signed());
                for t in [hit.t, next_to] {
                    rays.push(Ray { t_max: t, ..ray });
                    rays.push(Ray { t_min: t, ..ray });
                }
            }
        }
        let hits = assert_same(&scene, &tree, &rays, scene.name());
        assert!(hits > 10_000, "{hits}");
    }
}

#[test]
fn any_number_of_rays_is_answered() {
    let scene = scene("triangles", triangles());
    let settings = scenes::settings("sah");
    let tree = tree_with(&scene, &settings);
    let rays = rays(&scene, &tree);
    let shapes = scene.shapes(Precision::F32);
    for (instructions, mode) in simd_kernels() {
        let simd_tree = SimdTree::of(&scene, &tree);
        let mut kernel = SimdKernel::new(&tree, simd_tree, shapes, instructions, mode);
        let mut all = vec![Hit::MISS; rays.len()];
        kernel.closest_hits(&rays, &mut all);
        for n in [
            0, 1, 15, 16, 17, 79, 80, 81, 255, 256, 257, 1023, 1024, 1025,
        ] {
            let mut hits = vec![Hit::MISS; n];
            kernel.closest_hits(&rays[..n], &mut hits);
            assert!(
                hits.iter().map(exactly).eq(all[..n].iter().map(exactly)),
                "{n}"
            );
        }
    }
}

/// A leaf where every ray of a packet may hit every object of the first block, and all but the last
/// certainly hit those of the second: the maximum number of pending candidates.
#[test]
fn however_many_candidates_wait_there_is_room() {
    let triangle = |corners: [[f64; 2]; 3], z: f64| {
        let corners = corners.map(|[x, y]| Vec3::new(x, y, z));
        Primitive::Triangle(Triangle::new(corners, None).unwrap())
    };
    let on_an_edge = (0..16).map(|k| triangle([[-1., 0.], [17., 0.], [8., 9.]], f64::from(k)));
    let on_a_tip = (0..16).map(|k| triangle([[-9., -5.], [-9., 5.], [14., 0.]], f64::from(-k)));
    let scene = scene("a leaf", on_an_edge.chain(on_a_tip).collect());
    let settings = BuildSettings {
        d_max: MaxDepth::Fixed(0),
        ..scenes::settings("midpoint")
    };
    let tree = tree_with(&scene, &settings);
    let down = -Vec3::Z;
    let rays: Vec<Ray> = (0..15)
        .map(|x| Ray::new(Vec3::new(f64::from(x), 0.0, 20.0), down))
        .collect();
    let simd_tree = SimdTree::of(&scene, &tree);
    let shapes = scene.shapes(Precision::F32);
    let mut scratch = Scratch::default();
    let expected: Vec<bool> = rays
        .iter()
        .map(|ray| any_hit(&tree, shapes, ray, &mut scratch, &mut ()))
        .collect();
    for (instructions, mode) in simd_kernels() {
        let mut kernel = SimdKernel::new(&tree, simd_tree, shapes, instructions, mode);
        let mut blocked = vec![false; rays.len()];
        kernel.any_hits(&rays, &mut blocked);
        assert_eq!(blocked, expected, "{instructions:?}, {mode:?}");
    }
}

#[test]
fn every_kernel_gives_the_same_picture() {
    for name in ["balls:2", "teaching"] {
        let scene = scenes::scene(name);
        let settings = scenes::settings("sah");
        let tree = tree_with(&scene, &settings);
        let pool = thread_pool(2).unwrap();
        let pictures = KernelChoice::ALL.map(|kernel| {
            let render = RenderSettings {
                width: 100,
                height: 80,
                kernel,
                ..RenderSettings::for_camera(*scene.camera())
            };
            let picture = Mutex::new(Picture::new(render.width, render.height));
            render_timed(
                &scene,
                &tree,
                &render,
                0,
                &pool,
                &Progress::new(),
                |tile, colors| {
                    picture.lock().unwrap().add_tile(tile, 0, colors);
                },
            )
            .unwrap();
            picture.into_inner().unwrap()
        });
        assert!(pictures.iter().all(|p| *p == pictures[0]), "{name}");
    }
}

#[test]
fn kernels_are_found_by_their_names_and_old_names() {
    for choice in KernelChoice::ALL {
        assert_eq!(KernelChoice::named(choice.name()), Some(choice));
        if let Some(name) = choice.old_name() {
            assert_eq!(KernelChoice::named(name), Some(choice));
        }
    }
    assert_eq!(KernelChoice::Scalar.description(), "scalar");
    assert!(
        KernelChoice::Stream
            .description()
            .contains(InstructionSet::best().name())
    );
}
