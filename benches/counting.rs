//! The cost of counting: counted against timed rendering, both by the scalar kernel on one thread.
//! The counted pass does more than to count: it walks every ray once more without tests, for T_TT, the
//! time of which is told and left out of the ratio; and it finds every object along each pixel's ray
//! (the depth complexity), which is in the ratio. `cargo bench --bench counting`.

use bspscope::measure::paper::SCENES;
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::structure::{BuildSettings, Method, build};
use bspscope::trace::{RenderSettings, render_counted, render_timed, thread_pool};
use std::time::Instant;

/// How often each pass runs, in turns.
const ROUNDS: usize = 9;

fn main() {
    let progress = Progress::new();
    let pool = thread_pool(1).expect("a thread starts");
    println!("512 × 512 pixels, D_AREC 4, one thread; medians of {ROUNDS} rounds");
    println!("scene       timed, s   counted, s   of it T_TT, s   ratio without T_TT");
    for scene in &SCENES {
        let scene = load(&SceneRequest::parse(scene.name), &progress).expect("a generator's scene");
        let settings = BuildSettings::for_method(Method::of_the_paper()[1]);
        let tree = build(&scene, &settings, &progress).expect("the tree fits");
        let render = RenderSettings::for_camera(*scene.camera());
        let mut times = [const { Vec::new() }; 3];
        for _ in 0..ROUNDS {
            let start = Instant::now();
            let pass = render_timed(&scene, &tree, &render, 0, &pool, &progress, |_, _| ());
            pass.expect("it runs to its end");
            times[0].push(start.elapsed().as_secs_f64());
            let start = Instant::now();
            let pass = render_counted(&scene, &tree, &render, &pool, &progress, |_| ());
            times[1].push(start.elapsed().as_secs_f64());
            times[2].push(pass.expect("it runs to its end").traversal.as_secs_f64());
        }
        let ratio = |k: usize| (times[1][k] - times[2][k]) / times[0][k];
        let ratio = median((0..ROUNDS).map(ratio).collect());
        let [timed, counted, traversal] = times.map(median);
        let name = scene.name();
        println!("{name:<10} {timed:9.3} {counted:12.3} {traversal:15.3} {ratio:20.2}");
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
