//! Tracing in f32: what it loses against f64, what it must not lose, and when `auto` takes it.

use crate::support::scenes::{scene, tree_by};
use bspscope::geometry::{Ray, Vec3};
use bspscope::primitive::{Precision, Primitive, Sphere, Triangle};
use bspscope::scene::{Camera, Light, Material, Scene, SceneParts};
use bspscope::structure::Tree;
use bspscope::trace::{
    Hit, PrecisionChoice, RayKind, RenderSettings, Scratch, closest_hit, closest_hit_brute_force,
    fits_f32, record_pixel,
};

fn camera() -> Camera {
    Camera {
        from: Vec3::new(0.0, 0.0, 5.0),
        at: Vec3::ZERO,
        up: Vec3::Y,
        angle: 45.0,
        near: 0.1,
        resolution: [64, 64],
    }
}

fn scene_of(objects: Vec<Primitive>, camera: Camera) -> Scene {
    Scene::new(SceneParts {
        name: "test".into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: vec![Light {
            position: Vec3::new(3.0, 4.0, 5.0),
            color: None,
        }],
        background: Vec3::ZERO,
        camera,
        notes: Vec::new(),
    })
}

fn sphere(center: Vec3, radius: f64) -> Primitive {
    Primitive::Sphere(Sphere::new(center, radius).unwrap())
}

/// A closed ball of triangles, `center` + `size` · unit vectors.
fn ball(center: Vec3, size: f64) -> Vec<Primitive> {
    const RINGS: u32 = 12;
    let at = |i: u32, j: u32| {
        let (a, b) = (
            std::f64::consts::PI * f64::from(i) / f64::from(RINGS),
            std::f64::consts::TAU * f64::from(j % RINGS) / f64::from(RINGS),
        );
        center + size * Vec3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos())
    };
    let mut triangles = Vec::new();
    for i in 0..RINGS {
        for j in 0..RINGS {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for corners in [[a, b, c], [a, c, d]] {
                triangles.extend(Triangle::new(corners, None).map(Primitive::Triangle));
            }
        }
    }
    triangles
}

fn hit(scene: &Scene, tree: &Tree, precision: Precision, ray: &Ray) -> Hit {
    let shapes = scene.shapes(precision);
    let found = closest_hit(tree, shapes, ray, &mut Scratch::default(), &mut ());
    assert_eq!(
        found,
        closest_hit_brute_force(shapes, ray),
        "{precision:?} {ray:?}"
    );
    found
}

#[test]
fn f32_sees_the_same_objects_but_at_few_edges() {
    for name in ["balls:2", "rings:2", "tetra:3", "teaching"] {
        let scene = scene(name);
        let tree = tree_by(&scene, "sah-cut");
        let render = RenderSettings::for_camera(*scene.camera());
        let view = render.view(&scene).unwrap();
        let (mut wrong, mut farthest, mut hits) = (0, 0.0_f64, 0);
        for i in 0..20_000u32 {
            let ray = view.primary_ray(i * 37 % 512, i * 101 % 512, 0);
            let [narrow, wide] = Precision::ALL.map(|p| hit(&scene, &tree, p, &ray));
            if narrow.object != wide.object {
                wrong += 1;
            } else if wide.is_hit() {
                hits += 1;
                farthest = farthest.max((narrow.t - wide.t).abs() / wide.t);
            }
        }
        assert!(hits > 1000, "{name}");
        assert!(
            wrong <= 5,
            "{name}: {wrong} of 20000 rays see another object"
        );
        assert!(farthest > 0.0, "{name}: f32 rounds");
        assert!(
            farthest < 1e-3,
            "{name}: a hit is off by {farthest:e} of its distance"
        );
    }
}

#[test]
fn a_mesh_is_closed_in_f32_wherever_it_is_and_whatever_its_size() {
    for (center, size) in [
        (Vec3::ZERO, 1.0),
        (Vec3::new(1e6, -3e6, 2e6), 1.0),
        (Vec3::ZERO, 1e-30),
        (Vec3::ZERO, 1e30),
    ] {
        let scene = scene_of(ball(center, size), camera());
        let tree = tree_by(&scene, "sah-cut");
        for (i, object) in scene.objects().iter().enumerate() {
            let Primitive::Triangle(triangle) = object else {
                panic!("a ball of triangles");
            };
            let [a, b, c] = triangle.vertices;
            // From inside, at a vertex, the middle of an edge, and the middle of the triangle.
            for target in [a, 0.5 * (a + b), (a + b + c) / 3.0] {
                let origin = center + size * 0.1 * Vec3::new(0.3, -0.2, 0.1);
                let ray = Ray::new(origin, (target - origin).normalize());
                let found = hit(&scene, &tree, Precision::F32, &ray);
                assert!(found.is_hit(), "{i} of {size:e}: leaked at {target}");
                let off = (ray.at(found.t) - target).length() / size;
                assert!(off < 1e-5, "off by {off:e}");
            }
        }
    }
}

#[test]
fn a_far_eye_costs_no_accuracy() {
    let scene = scene_of(
        vec![sphere(Vec3::ZERO, 1.0), sphere(Vec3::X * 3.0, 0.5)],
        camera(),
    );
    let tree = tree_by(&scene, "sah-cut");
    for away in [1e2, 1e5, 1e8] {
        let origin = Vec3::new(0.3, 0.4, away);
        let ray = Ray::new(origin, -Vec3::Z);
        let found = hit(&scene, &tree, Precision::F32, &ray);
        assert_eq!(found.object, 0);
        let expected = away - (1.0f64 - 0.25).sqrt();
        assert!((found.t - expected).abs() < 1e-6, "{away:e}: {}", found.t);
    }
}

#[test]
fn no_surface_shades_itself_in_f32() {
    for name in ["balls:2", "rings:2", "tetra:3", "teaching"] {
        let scene = scene(name);
        let tree = tree_by(&scene, "sah-cut");
        let of = |precision| RenderSettings {
            width: 96,
            height: 96,
            precision,
            ..RenderSettings::for_camera(*scene.camera())
        };
        let (mut compared, mut other) = (0, 0);
        for i in 0..96 * 96 / 4 {
            let pixel = [i * 4 % 96, i * 4 / 96];
            let [narrow, wide] = [PrecisionChoice::F32, PrecisionChoice::F64]
                .map(|p| record_pixel(&scene, &tree, &of(p), pixel).unwrap());
            if narrow.rays[0].path.hit.object != wide.rays[0].path.hit.object {
                continue;
            }
            let shadows = |record: &bspscope::trace::PixelRecord| -> Vec<bool> {
                let first = record.rays.iter().filter(|r| r.parent == Some(0));
                first
                    .filter(|r| r.path.kind == RayKind::Shadow)
                    .map(|r| r.path.hit.is_hit())
                    .collect()
            };
            compared += 1;
            other += usize::from(shadows(&narrow) != shadows(&wide));
        }
        assert!(compared > 2000, "{name}");
        assert!(
            other <= 2,
            "{name}: {other} of {compared} pixels are lit differently"
        );
    }
}

#[test]
fn auto_takes_f32_where_it_can_hold_the_scene_and_says_why_not() {
    let auto = |scene: &Scene, camera: Camera| {
        let settings = RenderSettings {
            precision: PrecisionChoice::Auto,
            ..RenderSettings::for_camera(camera)
        };
        settings.precision_for(scene)
    };
    for name in ["balls", "rings", "tetra", "teaching"] {
        let scene = scene(name);
        let chosen = auto(&scene, *scene.camera());
        assert_eq!(chosen.precision, Precision::F32, "{name}: {chosen}");
    }
    // A sphere so small in so large a scene that its coordinates round to more than itself.
    let mixed = |radius| {
        vec![
            sphere(Vec3::ZERO, 1.0),
            sphere(Vec3::new(3.0, 2.0, 1.0), radius),
        ]
    };
    assert!(fits_f32(&scene_of(mixed(1e-3), camera()), &camera(), 512).is_ok());
    let scene = scene_of(mixed(1e-6), camera());
    let chosen = auto(&scene, camera());
    assert_eq!(chosen.precision, Precision::F64);
    assert!(chosen.why.contains("object 1"), "{chosen}");

    // An eye so near a surface that a pixel is narrower than rounding.
    let scene = scene_of(mixed(0.5), camera());
    for (height, precision) in [(1e-1, Precision::F32), (1e-5, Precision::F64)] {
        let near = Camera {
            from: Vec3::new(0.0, 0.0, 1.0 + height),
            ..camera()
        };
        let chosen = auto(&scene, near);
        assert_eq!(chosen.precision, precision, "{chosen}");
        assert_eq!(chosen.why.contains("so near"), precision == Precision::F64);
    }

    // Nothing at all, and a point, lose nothing.
    for objects in [vec![], vec![sphere(Vec3::ONE, 0.0)]] {
        let chosen = auto(&scene_of(objects, camera()), camera());
        assert_eq!(chosen.precision, Precision::F32, "{chosen}");
    }
}

#[test]
fn packed_objects_take_less_memory() {
    for name in ["balls", "rings", "tetra", "teaching"] {
        let scene = scene(name);
        let [narrow, wide] = Precision::ALL.map(|p| scene.shapes(p).bytes());
        assert!(narrow * 2 <= wide, "{name}: {narrow} of {wide} bytes");
    }
}
