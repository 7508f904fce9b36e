//! Rays that are hard for floating-point arithmetic.

use super::case::Case;
use super::scenes::{aims, aims_from, ball, base, features, spread, torus, unit};
use super::trial::{Outcome, Trial};
use crate::geometry::{Axis, Ray, Vec3};
use crate::measure::judge::Answer;
use crate::primitive::{Primitive, Shape};
use crate::scene::Scene;
use crate::structure::{Nodes, Tree};
use crate::trace::RayKind;

pub const CASES: &[Case] = &[
    Case::of_any_scene(
        "axis-parallel",
        "along each axis through vertices and edges, the other components 0 and -0: right hits",
        axis_parallel,
    ),
    Case::of_any_scene(
        "denormal components",
        "components of 5e-324 and 1e-300 beside others of 1: right hits",
        denormal,
    ),
    Case::of_any_scene(
        "short and long directions",
        "directions of length 1e-300, 1e-150 and 1e150: right hits",
        lengths,
    ),
    Case::of_any_scene(
        "inside planes of the tree",
        "within split planes, or faces of boxes, in every direction there: right hits",
        inside_planes,
    ),
    Case::of_any_scene(
        "from planes of the tree",
        "starting on split planes, or on faces of boxes: right hits",
        from_planes,
    ),
    Case::of_any_scene(
        "from faces",
        "starting on vertices, edges and surfaces: right hits; what is met at the start may count \
         or not",
        from_faces,
    ),
    Case::of_any_scene(
        "from inside objects",
        "starting in the middle of objects: right hits",
        from_inside,
    ),
    Case::of_any_scene(
        "at vertices and edges",
        "aimed at vertices and points of edges from outside: right hits; both objects at an edge \
         may be hit",
        at_features,
    ),
    Case::of_any_scene(
        "tangent",
        "touching spheres, cylinders and cones: right hits; the touched one may be hit or not",
        tangent,
    ),
    Case::of_any_scene(
        "from far away",
        "from 10^8 radii of the scene: right hits within the rounding of so long a way",
        from_afar,
    ),
    Case {
        name: "closed mesh",
        rule: "from inside a closed mesh at its vertices and edges: every ray hits",
        any_scene: false,
        run: closed_mesh,
    },
];

/// Checks the tree of the trial's scene with rays made from the scene and its tree.
fn ask_about(trial: &Trial<'_>, rays: impl Fn(&Scene, &Tree, usize) -> Vec<Ray>) -> Outcome {
    let scene = base(trial);
    let settings = trial.settings();
    match trial.tree(&scene, &settings) {
        Ok(tree) => {
            let rays = rays(&scene, &tree, trial.rays(&scene));
            trial.check_tree(&scene, &tree, &rays)
        }
        Err(outcome) => outcome,
    }
}

/// Returns rays from outside the scene through its features. Directions are used in turn.
fn through_features(scene: &Scene, count: usize, directions: &[Vec3]) -> Vec<Ray> {
    let radius = ball(scene).1;
    let points = features(scene, count);
    let pick = |i: usize| directions[i % directions.len()];
    let rays = points.iter().enumerate().map(|(i, &point)| {
        let direction = pick(i);
        let back = 3.0 * radius / direction.abs().max_element();
        Ray::new(point - direction * back, direction)
    });
    rays.collect()
}

fn axis_parallel(trial: &Trial<'_>) -> Outcome {
    let mut directions = Vec::new();
    for axis in 0..3 {
        for zero in [0.0, -0.0] {
            for one in [1.0, -1.0] {
                let mut direction = Vec3::splat(zero);
                direction[axis] = one;
                directions.push(direction);
            }
        }
    }
    ask_about(trial, |scene, _, n| through_features(scene, n, &directions))
}

fn denormal(trial: &Trial<'_>) -> Outcome {
    let mut directions = Vec::new();
    for axis in 0..3 {
        for (i, tiny) in [5e-324, -5e-324, 1e-300, -1e-300].into_iter().enumerate() {
            let mut direction = Vec3::splat(tiny);
            direction[axis] = if i % 2 == 0 { 1.0 } else { -1.0 };
            direction[(axis + 1) % 3] = [0.0, -0.0, 0.6, -0.6][i];
            directions.push(direction);
        }
    }
    ask_about(trial, |scene, _, n| through_features(scene, n, &directions))
}

fn lengths(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let rays = aims(scene, n).into_iter().enumerate();
        let length = |i: usize| [1e-300, 1e-150, 1e150][i % 3];
        rays.map(|(i, ray)| Ray::new(ray.origin, ray.direction * length(i)))
            .collect()
    })
}

/// Returns points on the planes that a tree tests rays with, each with its axis: on split planes inside the
/// node's cell, and on the faces of a hierarchy's boxes. They are evenly distributed over the tree.
fn on_planes(tree: &Tree, count: usize) -> Vec<(usize, Vec3)> {
    // Each face of all boxes after the other, so that every one of the six is taken equally often.
    let is_hierarchy = matches!(tree.nodes(), Nodes::Boxes(_));
    let faces = if is_hierarchy { 6 } else { 1 };
    let mut points = Vec::new();
    for face in 0..faces {
        for cell in tree.cells() {
            let plane = if is_hierarchy {
                let axis = Axis::from_index(face % 3);
                let corner = [cell.bounds.lo, cell.bounds.hi][face / 3];
                Some((axis, corner[axis.index()]))
            } else {
                tree.plane(cell.node)
            };
            if let Some((axis, plane)) = plane {
                let [x, y, z, ..] = spread(points.len());
                let mut point = cell.bounds.lo + cell.bounds.size() * Vec3::new(x, y, z);
                point[axis.index()] = plane;
                points.push((axis.index(), point));
            }
        }
    }
    let every = points.len().div_ceil(count.max(1)).max(1);
    points.into_iter().step_by(every).collect()
}

fn inside_planes(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, tree, n| {
        let radius = ball(scene).1;
        let points = on_planes(tree, n).into_iter().enumerate();
        points
            .map(|(i, (axis, point))| {
                let [u, v, ..] = spread(i);
                let mut direction = unit(u, v);
                // Every third ray is parallel to an axis.
                if i % 3 == 0 {
                    direction[(axis + 1) % 3] = 0.0;
                }
                direction[axis] = if i % 2 == 0 { 0.0 } else { -0.0 };
                Ray::new(point - 3.0 * radius * direction, direction)
            })
            .filter(|ray| ray.direction.abs().max_element() > 0.0)
            .collect()
    })
}

fn from_planes(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |_, tree, n| {
        let points = on_planes(tree, n).into_iter().enumerate();
        points
            .map(|(i, (_, point))| Ray::new(point, direction(i)))
            .collect()
    })
}

fn direction(i: usize) -> Vec3 {
    let [u, v, ..] = spread(i);
    unit(u, v)
}

fn from_faces(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let points = features(scene, n);
        let count = points.len();
        let rays = points.iter().enumerate().map(|(i, &point)| {
            // Every other ray points at another feature.
            let other = points[(i * 7 + 3) % count] - point;
            let direction = if i % 2 == 0 && other.abs().max_element() > 0.0 {
                other
            } else {
                direction(i)
            };
            Ray::new(point, direction)
        });
        rays.collect()
    })
}

fn from_inside(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let objects = scene.objects();
        (0..n)
            .filter_map(|i| {
                let object =
                    objects.get(i * objects.len().max(1) / n.max(1) % objects.len().max(1))?;
                Some(Ray::new(object.bounds().center(), direction(i)))
            })
            .collect()
    })
}

fn at_features(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let origins = aims(scene, n);
        let targets = features(scene, n);
        let rays = origins.iter().zip(targets);
        rays.map(|(ray, target)| Ray::new(ray.origin, target - ray.origin))
            .collect()
    })
}

fn tangent(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let radius = ball(scene).1;
        let mut rays = Vec::new();
        let curved: Vec<_> = scene
            .objects()
            .iter()
            .filter(|o| matches!(o, Primitive::Sphere(_) | Primitive::Cone(_)))
            .collect();
        for i in 0..n {
            let Some(object) = curved.get(i % curved.len().max(1)) else {
                break;
            };
            let [u, v, w, x, ..] = spread(i);
            let (point, normal) = match object {
                Primitive::Sphere(s) => {
                    // Every third point lies exactly on an axis, where nothing is rounded.
                    let normal = match i % 3 {
                        0 => [Vec3::X, Vec3::Y, Vec3::Z][i / 3 % 3],
                        _ => unit(u, v),
                    };
                    (s.center + s.radius * normal, normal)
                }
                Primitive::Cone(c) => {
                    let axis = c.apex() - c.base();
                    let (e, f) = axis.normalize().any_orthonormal_pair();
                    let turn = std::f64::consts::TAU * u;
                    let outward = libm::cos(turn) * e + libm::sin(turn) * f;
                    let r = c.base_radius() + (c.apex_radius() - c.base_radius()) * w;
                    let slope = (c.apex_radius() - c.base_radius()) / c.length();
                    let normal = outward - slope * axis.normalize();
                    (c.base() + axis * w + r * outward, normal.normalize())
                }
                Primitive::Triangle(_) | Primitive::Polygon(_) => continue,
            };
            let (e, f) = normal.any_orthonormal_pair();
            let turn = std::f64::consts::TAU * x;
            let direction = if i % 3 == 0 {
                e
            } else {
                libm::cos(turn) * e + libm::sin(turn) * f
            };
            rays.push(Ray::new(point - 2.0 * radius * direction, direction));
        }
        rays
    })
}

fn from_afar(trial: &Trial<'_>) -> Outcome {
    ask_about(trial, |scene, _, n| {
        let mut rays = aims_from(scene, n, 1e8);
        for (ray, target) in rays.clone().iter().zip(features(scene, n)) {
            rays.push(Ray::new(ray.origin, target - ray.origin));
        }
        rays
    })
}

fn closed_mesh(trial: &Trial<'_>) -> Outcome {
    let scene = super::scenes::scene_of(torus(24, 12, Vec3::new(0.1, 0.2, 0.3), 2.0, 0.7));
    let tree = match trial.tree(&scene, &trial.settings()) {
        Ok(tree) => tree,
        Err(outcome) => return outcome,
    };
    let targets = features(&scene, 8 * trial.rays(&scene));
    let rays: Vec<Ray> = targets
        .iter()
        .enumerate()
        .map(|(i, target)| {
            let [turn, ..] = spread(i);
            let turn = std::f64::consts::TAU * turn;
            let around = Vec3::new(libm::cos(turn), libm::sin(turn), 0.0);
            let origin = Vec3::new(0.1, 0.2, 0.3) + 2.0 * around;
            Ray::new(origin, *target - origin)
        })
        .collect();
    let found = trial.ask(&scene, &tree, RayKind::Primary, &rays);
    for (answer, ray) in found.iter().zip(&rays) {
        if matches!(answer, Answer::Nearest(hit) if !hit.is_hit()) {
            return Outcome::fail(format!("{ray:?} leaves the mesh"));
        }
    }
    trial.check_tree(&scene, &tree, &rays)
}
