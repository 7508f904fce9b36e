//! A camera that sees a ray from the side, with as little in front of it as possible.

use super::camera::ViewCamera;
use crate::geometry::{Aabb, Ray, Vec3};
use crate::primitive::Precision;
use crate::scene::{Camera, Scene};
use crate::structure::Tree;
use crate::trace::{RayPath, Scratch, Step, any_hit};

/// The share of the pane's width or height that the ray spans.
const SPAN: f64 = 0.7;

/// The shares that are good enough to leave the camera where it is.
const WELL_SPANNED: std::ops::RangeInclusive<f64> = 0.6..=0.8;

/// How far a view may lean from the perpendicular of the ray, in radians: 65° of 90° are left.
const LEAN: f64 = 25.0 * std::f64::consts::PI / 180.0;

/// Directions around the ray that are tried.
const DIRECTIONS: u32 = 16;

/// Points of the ray that should be seen.
const SAMPLES: u32 = 12;

/// The cosine to the up direction above which a view is too steep to tell what is up.
const STEEP: f64 = 0.95;

/// The cosine to the up direction of the view that is tried first, from a little above.
const FIRST_TRIED: f64 = 0.3;

/// Returns the part of a ray inside the tree's root cell up to its hit; of a ray that misses the tree, the
/// part up to the point closest to the tree's center.
pub fn shown_part(path: &RayPath, root: &Aabb) -> [Vec3; 2] {
    let ray = &path.ray;
    let first = path.steps.first().map(Step::interval);
    let begin = first.map_or(0.0, |[enter, _]| enter.max(0.0));
    let end = if path.steps.is_empty() {
        let squared = ray.direction.length_squared();
        (root.center() - ray.origin).dot(ray.direction) / squared
    } else {
        path.end()
    };
    let least = 1e-3 * root.size().length() / ray.direction.length();
    [ray.at(begin), ray.at(end.max(begin + least))]
}

/// Returns a camera at least 60° off the ray, with the field of view and up direction of `from`. Of
/// several directions around the ray it takes the one from which most of the ray is seen.
pub fn side_view(from: &ViewCamera, scene: &Scene, tree: &Tree, path: &RayPath) -> Camera {
    let ends = shown_part(path, &tree.root_cell());
    let up = from.camera.up.normalize_or(Vec3::Z);
    let mut directions = around((ends[1] - ends[0]).normalize_or(Vec3::X), up);
    directions.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut best: Option<(u32, Camera)> = None;
    for (toward_eye, _) in directions {
        let camera = at_distance(from, ends, toward_eye);
        let hidden = hidden_points(scene, tree, ends, camera.from);
        if best.as_ref().is_none_or(|(least, _)| hidden < *least) {
            best = Some((hidden, camera));
        }
        if hidden == 0 {
            break;
        }
    }
    best.map_or(from.camera, |(_, camera)| camera)
}

/// Returns whether a camera sees a ray well already: from the side, in full and large enough.
pub fn is_beside(view: &ViewCamera, scene: &Scene, tree: &Tree, path: &RayPath) -> bool {
    let ends = shown_part(path, &tree.root_cell());
    let [forward, ..] = view.frame();
    let along = forward.dot((ends[1] - ends[0]).normalize_or(forward)).abs();
    along <= 0.5 && is_framed(view, ends) && hidden_points(scene, tree, ends, view.camera.from) == 0
}

/// Returns a camera that looks in the same direction and sees a ray in full and large enough, as after a
/// change of the pane's shape.
pub fn framed(view: &ViewCamera, tree: &Tree, path: &RayPath) -> Camera {
    let ends = shown_part(path, &tree.root_cell());
    if is_framed(view, ends) {
        return view.camera;
    }
    let [forward, ..] = view.frame();
    at_distance(view, ends, -forward)
}

/// Returns whether the ray is seen in full and large enough.
fn is_framed(view: &ViewCamera, ends: [Vec3; 2]) -> bool {
    let in_pane = |[x, y]: [f64; 2]| x.abs() <= view.aspect && y.abs() <= 1.0;
    WELL_SPANNED.contains(&span(view, ends))
        && ends.iter().all(|end| view.place(*end).is_some_and(in_pane))
}

/// Directions from the ray to an eye, each with how late it is tried.
fn around(ray: Vec3, up: Vec3) -> Vec<(Vec3, f64)> {
    let (side, other) = ray.any_orthonormal_pair();
    let mut found = Vec::new();
    for lean in [0.0, LEAN, -LEAN] {
        for k in 0..DIRECTIONS {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS);
            let (sin, cos) = libm::sincos(turn);
            let across = cos * side + sin * other;
            let direction = libm::cos(lean) * across + libm::sin(lean) * ray;
            let rise = direction.dot(up);
            if rise.abs() < STEEP {
                let leans = if lean == 0.0 { 0.0 } else { 2.0 };
                found.push((direction, leans + (rise - FIRST_TRIED).abs()));
            }
        }
    }
    found
}

/// The camera in a direction from the ray's middle, so far away that the ray spans [`SPAN`] of the pane.
fn at_distance(from: &ViewCamera, ends: [Vec3; 2], toward_eye: Vec3) -> Camera {
    let middle = (ends[0] + ends[1]) * 0.5;
    let length = ends[0].distance(ends[1]);
    let camera = |distance: f64| Camera {
        from: middle + distance * toward_eye,
        at: middle,
        ..from.camera
    };
    let spans = |distance: f64| {
        let view = ViewCamera {
            camera: camera(distance),
            ..*from
        };
        span(&view, ends)
    };
    // Nearer than this, an end may lie behind the eye; the span shrinks with the distance.
    let (mut near, mut far) = (0.3 * length, 0.3 * length);
    while spans(far) > SPAN {
        far *= 2.0;
    }
    for _ in 0..50 {
        let middle = 0.5 * (near + far);
        if spans(middle) > SPAN {
            near = middle;
        } else {
            far = middle;
        }
    }
    camera(far)
}

/// Returns the share of the pane's width or height that the ray spans, whichever is greater.
pub fn span(view: &ViewCamera, ends: [Vec3; 2]) -> f64 {
    let [Some(a), Some(b)] = ends.map(|end| view.place(end)) else {
        return f64::INFINITY;
    };
    let [across, upward] = [0, 1].map(|k| (a[k] - b[k]).abs() * 0.5);
    (across / view.aspect).max(upward)
}

/// Returns how many points of the ray something hides from an eye.
fn hidden_points(scene: &Scene, tree: &Tree, ends: [Vec3; 2], eye: Vec3) -> u32 {
    let shapes = scene.shapes(Precision::F64);
    let mut scratch = Scratch::default();
    let hidden = (0..SAMPLES).filter(|i| {
        let place = (f64::from(*i) + 0.5) / f64::from(SAMPLES);
        let offset = ends[0].lerp(ends[1], place) - eye;
        let distance = offset.length();
        let sight = Ray::to(eye, offset / distance, distance * (1.0 - 1e-6));
        any_hit(tree, shapes, &sight, &mut scratch, &mut ())
    });
    hidden.count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::{BuildSettings, build};
    use crate::trace::{RenderSettings, record_pixel};

    #[test]
    fn every_ray_is_seen_from_the_side() {
        let (mut hits, mut free, mut rays) = (0, 0, 0);
        for name in ["balls:2", "tetra:3"] {
            let progress = Progress::new();
            let scene = load(&SceneRequest::parse(name), &progress).unwrap();
            let tree = build(&scene, &BuildSettings::default(), &progress).unwrap();
            let render = RenderSettings {
                width: 32,
                height: 32,
                ..RenderSettings::default()
            };
            let from = ViewCamera {
                camera: *scene.camera(),
                aspect: 1.8,
                ..ViewCamera::default()
            };
            for pixel in [[16, 16], [12, 18], [20, 11], [16, 24], [5, 27], [0, 0]] {
                let record = record_pixel(&scene, &tree, &render, pixel).unwrap();
                for ray in &record.rays {
                    let path = &ray.path;
                    let view = ViewCamera {
                        camera: side_view(&from, &scene, &tree, path),
                        ..from
                    };
                    let [forward, ..] = view.frame();
                    let angle = forward.angle_between(path.ray.direction).to_degrees();
                    assert!((60.0..=120.0).contains(&angle), "{name} {pixel:?}: {angle}");
                    let ends = shown_part(path, &tree.root_cell());
                    let spanned = span(&view, ends);
                    assert!(
                        (0.6..=0.8).contains(&spanned),
                        "{name} {pixel:?}: {spanned}"
                    );
                    for end in ends {
                        let [x, y] = view.place(end).unwrap();
                        assert!(x.abs() <= view.aspect && y.abs() <= 1.0, "{x} {y}");
                    }
                    rays += 1;
                    if hidden_points(&scene, &tree, ends, view.camera.from) == 0 {
                        assert!(is_beside(&view, &scene, &tree, path), "{name} {pixel:?}");
                    }
                    let along = ViewCamera {
                        camera: Camera {
                            from: path.ray.origin,
                            at: path.ray.at(1.0),
                            ..view.camera
                        },
                        ..view
                    };
                    assert!(!is_beside(&along, &scene, &tree, path));
                    for aspect in [0.4, 1.0, 3.2] {
                        let shaped = ViewCamera { aspect, ..view };
                        let camera = framed(&shaped, &tree, path);
                        let view = ViewCamera { camera, ..shaped };
                        let spanned = span(&view, ends);
                        assert!(
                            (0.6..=0.8).contains(&spanned),
                            "{name} {pixel:?}: {spanned}"
                        );
                        let angle = view.frame()[0].angle_between(forward);
                        assert!(angle < 1e-6, "the direction stays");
                    }
                    hits += u32::from(path.hit.is_hit());
                    let eye = view.camera.from;
                    free += u32::from(hidden_points(&scene, &tree, ends, eye) == 0);
                }
            }
        }
        assert!(hits > 10 && hits < rays, "{hits} of {rays}");
        assert!(2 * free > rays, "only {free} of {rays} are seen whole");
    }

    /// A wall beside the ray: the view comes from its other side.
    #[test]
    fn nothing_stands_in_front_where_that_is_possible() {
        let nff = "v\nfrom 0 -9 0.5\nat 0 0 0.5\nup 0 0 1\nangle 40\nhither 1\nresolution 8 8\n\
                   b 0 0 0\nl 0 -9 9\nf 1 0 0 1 0 0 0 1\ns 0 4 0.5 1\n\
                   p 4\n0.5 -4 -9\n0.5 3 -9\n0.5 3 9\n0.5 -4 9\n";
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("wall.nff");
        std::fs::write(&file, nff).unwrap();
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse(file.to_str().unwrap()), &progress).unwrap();
        let tree = build(&scene, &BuildSettings::default(), &progress).unwrap();
        let render = RenderSettings {
            width: 9,
            height: 9,
            ..RenderSettings::default()
        };
        let record = record_pixel(&scene, &tree, &render, [4, 4]).unwrap();
        let path = &record.rays[0].path;
        assert!(path.hit.is_hit());
        let from = ViewCamera {
            camera: *scene.camera(),
            ..ViewCamera::default()
        };
        let camera = side_view(&from, &scene, &tree, path);
        assert!(camera.from.x < 0.5, "{:?}", camera.from);
        let ends = shown_part(path, &tree.root_cell());
        assert_eq!(hidden_points(&scene, &tree, ends, camera.from), 0);
    }
}
