//! The window thread's time a frame, without the graphics driver's, on the paper's largest tree:
//! rings with 153,456 leaves, all shown. `cargo bench --bench frame`.

use bspscope::gui::{App, StartOptions};
use bspscope::scene::{Cylinders, SceneRequest};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use std::time::{Duration, Instant};

const FRAMES: usize = 300;

fn main() {
    let mut start = StartOptions {
        scene: SceneRequest {
            cylinders: Cylinders::Polygons(10),
            ..SceneRequest::parse("rings")
        },
        remember: false,
        ..StartOptions::default()
    };
    start.render.width = 256;
    start.render.height = 256;
    let mut window = Harness::builder()
        .with_size([1400.0, 900.0])
        .with_max_steps(40)
        .wgpu()
        .build_eframe(|cc| App::new(cc, start));
    while window.query_by_label("finished").is_none() {
        window.run_steps(2);
        std::thread::sleep(Duration::from_millis(5));
    }
    let shown = window
        .query_all_by_label_contains("153 456 of 153 456 leaves")
        .count();
    assert!(shown > 0, "all leaves are shown");
    println!("rings, 153,456 leaves, all shown; {FRAMES} frames each; goal 8 ms");

    report("nothing changes", frames(&mut window, |_, _| ()));

    let picture = window.get_by_label("Traced picture").rect().center();
    window.get_by_label("Traced picture").click();
    window.run_steps(2);
    window.hover_at(picture);
    report(
        "the picked pixel moves",
        frames(&mut window, |window, i| {
            let key = [egui::Key::ArrowLeft, egui::Key::ArrowUp][i % 2];
            window.key_press(key);
        }),
    );

    let view = window.get_by_label("3D view of scene and tree").rect();
    window.drag_at(view.center());
    window.run_steps(2);
    report(
        "the camera moves",
        frames(&mut window, |window, i| {
            let angle = i as f32 * 0.1;
            window.hover_at(view.center() + 80.0 * egui::vec2(angle.cos(), angle.sin()));
        }),
    );
}

/// The time of every frame; `act` comes before each and is not timed.
fn frames<'a>(
    window: &mut Harness<'a, App>,
    mut act: impl FnMut(&mut Harness<'a, App>, usize),
) -> Vec<Duration> {
    (0..FRAMES)
        .map(|i| {
            act(window, i);
            let start = Instant::now();
            window.step();
            start.elapsed()
        })
        .collect()
}

fn report(what: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "{what:24} median {:6.2} ms   95 % {:6.2} ms   worst {:6.2} ms",
        ms(times[times.len() / 2]),
        ms(times[times.len() * 95 / 100]),
        ms(times[times.len() - 1])
    );
}
