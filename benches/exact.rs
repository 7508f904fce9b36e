//! What exact tests of objects cost: how often each arithmetic decides, and the time beside that of tests
//! in plain `f64` without a bound on the error.
//!
//! `cargo bench --bench exact [-- SCENE…]`; by default the six scenes. The tests are those of a picture's
//! rays in a sah-cut tree, with the limits that the traversal gives them, on one thread.

#[path = "exact/plain.rs"]
mod plain;

use bspscope::geometry::Ray;
use bspscope::measure::paper::SCENES;
use bspscope::measure::sample_rays;
use bspscope::primitive::{Precision, Primitive, Shape, Stage};
use bspscope::progress::Progress;
use bspscope::scene::{Scene, SceneRequest, load};
use bspscope::structure::{BuildSettings, Method, Tree, build};
use bspscope::trace::{
    BoxTest, Children, Probe, RayKind, RenderSettings, Scratch, any_hit, closest_hit,
};
use std::hint::black_box;
use std::time::Instant;

const RAYS_PER_KIND: usize = 20_000;
const ROUNDS: usize = 7;

/// A test of an object: its index and that of the ray; the limit, or none for any hit.
struct Test {
    object: u32,
    ray: u32,
    limit: Option<f64>,
}

/// Records the tests of one ray.
struct Recorder<'a> {
    tests: &'a mut Vec<Test>,
    ray: u32,
    limit: Option<f64>,
}

impl Probe for Recorder<'_> {
    fn inner(&mut self, _: u32, _: [f64; 2], _: f64, _: f64, _: Children) {}

    fn boxes(&mut self, _: u32, _: [f64; 2], _: &[BoxTest]) {}
    fn culled(&mut self, _: u32, _: f64, _: f64) {}
    fn leaf(&mut self, _: u32, _: &[u32], _: [f64; 2]) {}

    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>) {
        self.tests.push(Test {
            object,
            ray: self.ray,
            limit: self.limit,
        });
        self.limit = self.limit.map(|limit| hit().unwrap_or(limit).min(limit));
    }
}

/// Returns the tests of rays of one kind.
fn tests_of(scene: &Scene, tree: &Tree, kind: RayKind, rays: &[Ray]) -> Vec<Test> {
    let shapes = scene.shapes(Precision::F64);
    let (mut tests, mut scratch) = (Vec::new(), Scratch::default());
    for (index, ray) in rays.iter().enumerate() {
        let limit = (kind != RayKind::Shadow).then_some(ray.t_max);
        let mut recorder = Recorder {
            tests: &mut tests,
            ray: index as u32,
            limit,
        };
        if kind == RayKind::Shadow {
            any_hit(tree, shapes, ray, &mut scratch, &mut recorder);
        } else {
            closest_hit(tree, shapes, ray, &mut scratch, &mut recorder);
        }
    }
    tests
}

/// A way to test an object, up to a limit or for any hit.
type Way = fn(&Primitive, &Ray, Option<f64>) -> bool;

/// Returns the median time per test of two ways to test, in nanoseconds, run in turn.
fn times(objects: &[Primitive], rays: &[Ray], tests: &[Test], ways: [Way; 2]) -> [f64; 2] {
    let mut all = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        for (way, times) in ways.iter().zip(&mut all) {
            let start = Instant::now();
            for test in tests {
                let object = &objects[test.object as usize];
                black_box(way(object, &rays[test.ray as usize], test.limit));
            }
            times.push(start.elapsed().as_secs_f64() * 1e9 / tests.len() as f64);
        }
    }
    all.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let chosen: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let scenes: Vec<&str> = if chosen.is_empty() {
        SCENES.iter().map(|scene| scene.name).collect()
    } else {
        chosen.iter().map(String::as_str).collect()
    };
    let progress = Progress::new();
    println!(
        "{} rays per kind, sah-cut, f64, one thread, median of {ROUNDS}",
        RAYS_PER_KIND
    );
    println!(
        "open: share of tests that an estimate in f64 leaves open; of these, integers decide the next column"
    );
    println!(
        "| scene | rays | tests | open | integers | plain, ns/test | exact, ns/test | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for name in scenes {
        let scene = load(&SceneRequest::parse(name), &progress)?;
        let tree = build(
            &scene,
            &BuildSettings::for_method(Method::named("sah-cut")?),
            &progress,
        )?;
        let pool = rayon::ThreadPoolBuilder::new().build()?;
        let settings = RenderSettings::default();
        let sample = sample_rays(&scene, &tree, &settings, RAYS_PER_KIND, &pool, &progress)?;
        for kind in RayKind::ALL {
            let rays = &sample.rays[kind as usize];
            let tests = tests_of(&scene, &tree, kind, rays);
            if tests.is_empty() {
                continue;
            }
            let objects = scene.objects();
            let mut decided = [0_u64; 3];
            for test in &tests {
                let ray = &rays[test.ray as usize];
                let stage = objects[test.object as usize].deciding_stage(ray, test.limit);
                decided[stage as usize] += 1;
            }
            let [plain, exact] = times(
                objects,
                rays,
                &tests,
                [
                    |object, ray, limit| {
                        plain::intersect(object, ray, limit.unwrap_or(ray.t_max)).is_some()
                    },
                    |object, ray, limit| match limit {
                        Some(limit) => object.intersect(ray, limit).is_some(),
                        None => object.is_hit(ray),
                    },
                ],
            );
            let open = decided[Stage::DoubleWords as usize] + decided[Stage::Integers as usize];
            println!(
                "| {name} | {} | {} | {:.2} % | {} | {plain:.1} | {exact:.1} | {:.2} |",
                kind.name(),
                tests.len(),
                100.0 * open as f64 / tests.len() as f64,
                decided[Stage::Integers as usize],
                exact / plain
            );
        }
    }
    Ok(())
}
