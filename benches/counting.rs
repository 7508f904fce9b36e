//! What counting costs: a counted pass against a timed one, both by the plain kernel on one thread.
//! The counted pass also finds every object along each pixel's ray (the depth complexity), so that it
//! does more than to count. `cargo bench --bench counting`.

use bspscope::measure::paper::SCENES;
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::trace::{RenderSettings, counted_pass, thread_pool, timed_pass};
use bspscope::tree::{BuildSettings, Method, build};
use std::time::{Duration, Instant};

/// How often each pass runs, in turns.
const ROUNDS: usize = 9;

fn main() {
    let progress = Progress::new();
    let pool = thread_pool(1).expect("a thread starts");
    println!("512 × 512 pixels, D_AREC 4, one thread; medians of {ROUNDS} rounds");
    println!("scene       timed, s   counted, s   ratio");
    for scene in &SCENES {
        let scene = load(&SceneRequest::parse(scene.name), &progress).expect("a generator's scene");
        let settings = BuildSettings::for_method(Method::of_the_paper()[1]);
        let tree = build(&scene, &settings, &progress).expect("the tree fits");
        let render = RenderSettings::for_camera(*scene.camera());
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..ROUNDS {
            let timed = || timed_pass(&scene, &tree, &render, 0, &pool, &progress, |_, _| ());
            times[0].push(of(|| timed().is_ok()));
            let counted = || counted_pass(&scene, &tree, &render, &pool, &progress, |_| ());
            times[1].push(of(|| counted().is_ok()));
        }
        let ratios = std::iter::zip(&times[0], &times[1]).map(|(a, b)| b / a);
        let ratio = median(ratios.collect());
        let [timed, counted] = times.map(median);
        println!(
            "{:<10} {timed:9.3} {counted:12.3} {ratio:7.2}",
            scene.name()
        );
    }
}

/// The time that a pass takes, in seconds.
fn of(pass: impl Fn() -> bool) -> f64 {
    let start = Instant::now();
    assert!(pass(), "the pass runs to its end");
    start.elapsed().max(Duration::from_nanos(1)).as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
