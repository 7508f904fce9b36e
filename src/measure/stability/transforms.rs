//! Cases that scale and move the whole scene.

use super::case::Case;
use super::scenes::{aims, ball, base, features, polygon, scene_of, sphere, triangle};
use super::trial::{Outcome, Trial};
use crate::geometry::{Ray, Vec3};
use crate::measure::judge::{Answer, Tolerance, Verdict, scale_of, settle};
use crate::measure::{DELTA, Measured, measure, parameter, unsplit};
use crate::primitive::Precision;
use crate::primitive::{Cone, Polygon, Primitive, ShapeError, Sphere, Triangle};
use crate::scene::{Camera, Light, Scene, SceneParts};
use crate::trace::{Hit, PrecisionChoice, RayKind, RenderSettings};

pub const CASES: &[Case] = &[
    Case {
        name: "scaled",
        rule: "scene and rays times 10^k, k from -30 to 30 in f64: the hits of the unscaled scene, or \
               the judge says tie or rounding",
        any_scene: true,
        run: scaled,
    },
    Case {
        name: "tree of a scaled scene",
        rule: "scene, lights and camera times 2^k, k from -100 to 100 in f64: the same Δ and the same \
               picture; times 10^k, k from -5 to 5: Δ within 1 %",
        any_scene: true,
        run: scaled_tree,
    },
    Case {
        name: "moved",
        rule: "scene and rays moved by 10^k times its size along each axis, k from 0 to 10: the hits \
               of the scene in its place, or the judge says tie or rounding",
        any_scene: true,
        run: moved,
    },
    Case {
        name: "mixed sizes",
        rule: "objects of size 1e-10 and 1e10 in one scene: right hits from and to both",
        any_scene: false,
        run: mixed,
    },
];

/// Maps every coordinate to `factor` times itself plus `offset`.
#[derive(Clone, Copy)]
struct Map {
    factor: f64,
    offset: Vec3,
}

impl Map {
    fn point(&self, point: Vec3) -> Vec3 {
        point * self.factor + self.offset
    }

    fn object(&self, object: &Primitive) -> Result<Primitive, ShapeError> {
        let length = |x: f64| x * self.factor;
        Ok(match object {
            Primitive::Sphere(s) => {
                Primitive::Sphere(Sphere::new(self.point(s.center), length(s.radius))?)
            }
            Primitive::Triangle(t) => {
                let vertices = t.vertices.map(|v| self.point(v));
                Primitive::Triangle(Triangle::new(vertices, t.normals.as_deref().copied())?)
            }
            Primitive::Polygon(p) => {
                let vertices = p.vertices().iter().map(|&v| self.point(v)).collect();
                let normals = p.vertex_normals().map(<[_]>::to_vec);
                Primitive::Polygon(Polygon::new(vertices, normals)?)
            }
            Primitive::Cone(c) => Primitive::Cone(Cone::new(
                self.point(c.base()),
                length(c.base_radius()),
                self.point(c.apex()),
                length(c.apex_radius()),
            )?),
        })
    }

    /// Maps a scene with its lights and its camera. Its notes, and so a published margin, apply only to
    /// the original.
    fn scene(&self, scene: &Scene) -> Result<Scene, Outcome> {
        let objects = scene.objects().iter().enumerate().map(|(i, object)| {
            self.object(object)
                .map_err(|error| Outcome::NotRepresentable {
                    reason: format!("object {i} ({}): {error}", object.kind().name()),
                })
        });
        Ok(Scene::new(SceneParts {
            objects: objects.collect::<Result<_, _>>()?,
            lights: (scene.lights().iter())
                .map(|light| Light {
                    position: self.point(light.position),
                    ..*light
                })
                .collect(),
            camera: Camera {
                from: self.point(scene.camera().from),
                at: self.point(scene.camera().at),
                near: scene.camera().near * self.factor,
                ..*scene.camera()
            },
            notes: Vec::new(),
            ..scene.parts().clone()
        }))
    }

    fn ray(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point(ray.origin),
            t_max: ray.t_max * self.factor,
            ..*ray
        }
    }

    /// Maps an answer for the mapped scene back to the original scene.
    fn back(&self, answer: Answer) -> Answer {
        match answer {
            Answer::Nearest(hit) if hit.is_hit() => Answer::Nearest(Hit {
                t: hit.t / self.factor,
                ..hit
            }),
            other => other,
        }
    }
}

fn scaled(trial: &Trial<'_>) -> Outcome {
    let most = match trial.kernel.precision {
        Precision::F64 => 30,
        Precision::F32 => 12,
    };
    let step = if trial.quick { 10 } else { 1 };
    let maps = (-most..=most).step_by(step).map(|k| {
        let map = Map {
            factor: 10f64.powi(k),
            offset: Vec3::ZERO,
        };
        (format!("times 10^{k}"), map)
    });
    compare(trial, maps)
}

fn moved(trial: &Trial<'_>) -> Outcome {
    let size = 2.0 * ball(&base(trial)).1;
    let step = if trial.quick { 5 } else { 1 };
    let maps = (0..=10).step_by(step).map(|k| {
        let map = Map {
            factor: 1.0,
            offset: Vec3::new(1.0, -1.0, 1.0) * size * 10f64.powi(k),
        };
        (format!("moved by 10^{k} sizes"), map)
    });
    compare(trial, maps)
}

/// Compares the hits in mapped scenes with those in the original scene.
fn compare(trial: &Trial<'_>, maps: impl Iterator<Item = (String, Map)>) -> Outcome {
    let scene = base(trial);
    let few = if trial.quick { 2 } else { 10 };
    let count = trial.rays(&scene) / few;
    let mut rays = aims(&scene, count);
    let targets = features(&scene, count);
    for (ray, target) in rays.clone().iter().zip(targets) {
        rays.push(Ray::new(ray.origin, (target - ray.origin).normalize()));
    }
    let everything = match unsplit(&scene, trial.progress) {
        Ok(tree) => tree,
        Err(error) => return Outcome::fail(error.to_string()),
    };
    let expected = trial.ask(&scene, &everything, RayKind::Primary, &rays);
    Outcome::all(maps.map(|(name, map)| {
        let mapped = match map.scene(&scene) {
            Ok(mapped) => mapped,
            Err(outcome) => return outcome.of(&name),
        };
        let tree = match trial.tree(&mapped, &trial.settings()) {
            Ok(tree) => tree,
            Err(outcome) => return outcome.of(&name),
        };
        let mapped_rays: Vec<Ray> = rays.iter().map(|ray| map.ray(ray)).collect();
        let right = trial.check_tree(&mapped, &tree, &mapped_rays);
        let found = trial.ask(&mapped, &tree, RayKind::Primary, &mapped_rays);
        for (i, ray) in rays.iter().enumerate() {
            let (expected, found) = (expected[i], map.back(found[i]));
            let shift = map.offset.abs().max_element() / map.factor;
            let tolerance = Tolerance::of(trial.kernel.precision, scale_of(&scene, ray) + shift);
            if expected == found {
                continue;
            }
            let verdict = settle(&scene, ray, [expected, found], Some(tolerance));
            if matches!(verdict, Verdict::Fault { .. }) {
                return Outcome::fail(format!(
                    "{name}: {found:?}, in its own place {expected:?}, of {ray:?}"
                ));
            }
        }
        right.of(&name)
    }))
}

/// Measures scaled scenes. A power of two rounds nothing, so nothing may change.
fn scaled_tree(trial: &Trial<'_>) -> Outcome {
    let (exponents_of_2, exponents_of_10): (&[i32], &[i32]) =
        match (trial.kernel.precision, trial.quick) {
            (Precision::F64, true) => (&[-100, -40, -7, 7, 40, 100], &[-5, 2, 5]),
            (Precision::F64, false) => (
                &[-100, -40, -7, -1, 1, 7, 40, 100],
                &[-5, -4, -3, -2, -1, 1, 2, 3, 4, 5],
            ),
            (Precision::F32, true) => (&[-40, 40], &[]),
            (Precision::F32, false) => (&[-40, -7, 7, 40], &[-5, 5]),
        };
    let original = match measured(trial, 1.0) {
        Ok(original) => original,
        Err(outcome) => return outcome,
    };
    let exactly = exponents_of_2.iter().map(|&k| (2.0, k, 0.0));
    let nearly = exponents_of_10.iter().map(|&k| (10.0, k, 0.01));
    Outcome::all(exactly.chain(nearly).map(|(base, k, tolerance)| {
        let name = format!("times {base}^{k}");
        let scaled = match measured(trial, f64::powi(base, k)) {
            Ok(scaled) => scaled,
            Err(outcome) => return outcome.of(&name),
        };
        for symbol in DELTA {
            let [expected, found] =
                [&original, &scaled].map(|m| parameter(symbol).value(&m.measurement));
            let is_close = match (expected, found) {
                (Some(expected), Some(found)) => {
                    (found - expected).abs() <= tolerance * expected.abs()
                }
                (expected, found) => expected == found,
            };
            if !is_close {
                return Outcome::fail(format!("{name}: {symbol} is {found:?}, not {expected:?}"));
            }
        }
        if tolerance == 0.0 && scaled.picture != original.picture {
            return Outcome::fail(format!("{name}: the picture differs"));
        }
        let counted = scaled.measurement.all_rays();
        Outcome::Pass {
            rays: counted.map_or(0, |all| all.rays),
        }
    }))
}

/// Measures the scene times a factor, without a published margin, in a small picture.
fn measured(trial: &Trial<'_>, factor: f64) -> Result<Measured, Outcome> {
    let map = Map {
        factor,
        offset: Vec3::ZERO,
    };
    let scene = map.scene(&base(trial))?;
    let render = RenderSettings {
        width: 16,
        height: 16,
        threads: 1,
        precision: match trial.kernel.precision {
            Precision::F64 => PrecisionChoice::F64,
            Precision::F32 => PrecisionChoice::F32,
        },
        ..RenderSettings::for_camera(*scene.camera())
    };
    measure(&scene, &trial.settings(), &render, trial.progress)
        .map_err(|error| Outcome::fail(error.to_string()))
}

fn mixed(trial: &Trial<'_>) -> Outcome {
    let mut objects = Vec::new();
    for size in [1e-10, 1e10] {
        let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z) * size;
        objects.extend([
            sphere(at(3.0, 0.0, 0.0), size),
            triangle(at(0.0, 2.0, 0.0), at(1.0, 2.0, 0.5), at(0.0, 3.0, 1.0)),
            polygon(
                &[
                    at(-3.0, -1.0, -2.0),
                    at(-1.0, -1.0, -2.0),
                    at(-1.0, 1.0, -2.0),
                    at(-3.0, 1.0, -2.0),
                ]
                .map(|v| v.to_array()),
            ),
            Primitive::Cone(
                Cone::new(at(0.0, -3.0, -1.0), size, at(0.0, -3.0, 1.0), 0.5 * size)
                    .expect("it has an axis"),
            ),
        ]);
    }
    let small = scene_of(objects[..4].to_vec());
    let scene = scene_of(objects);
    let count = trial.rays(&scene);
    let mut rays = aims(&scene, count);
    // Rays from near the small objects, at the small objects and at the large ones.
    rays.extend(aims(&small, count));
    let origins = aims(&small, count);
    for (i, ray) in aims(&scene, count).iter().enumerate() {
        rays.push(Ray::new(origins[i].origin, -ray.direction));
    }
    trial.check(&scene, &trial.settings(), &rays)
}
