//! The window thread's time per frame, without the graphics driver's, with all leaves shown: of the paper's
//! largest tree, and of a hierarchy with 200,978 boxes that overlap. `cargo bench --bench frame`.

use bspscope::gui::{App, StartOptions};
use bspscope::scene::{Cylinders, SceneRequest};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use cpu_time::ThreadTime;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::time::{Duration, Instant};

const FRAMES: usize = 300;

fn main() {
    measure("rings", |_| (), "153\u{a0}456");
    let of_one_object = |setup: &mut Setup| {
        setup.build = BuildSettings::for_method(Method::named("bvh-sweep").expect("a method"));
        setup.build.d_max = MaxDepth::Fixed(64);
        let constants = &mut setup.build.constants;
        constants.insert("max-leaf".to_owned(), 1.0);
    };
    measure("terrain:317", of_one_object, "200\u{a0}978");
}

/// Measures the window with a tree of so many leaves.
fn measure(scene: &str, choose: impl Fn(&mut Setup), leaves: &str) {
    let mut start = StartOptions {
        setup: Setup::new(SceneRequest {
            cylinders: Cylinders::Polygons(10),
            ..SceneRequest::parse(scene)
        }),
        remember: false,
        ..StartOptions::default()
    };
    choose(&mut start.setup);
    start.setup.render.width = 256;
    start.setup.render.height = 256;
    let mut window = Harness::builder()
        .with_size([1400.0, 900.0])
        .with_max_steps(40)
        .wgpu()
        .build_eframe(|cc| App::new(cc, start));
    let is_counting = |window: &Harness<'_, App>| {
        let mut notes = window.query_all_by_label_contains("visits");
        notes.any(|note| {
            let text = note.accesskit_node().label().unwrap_or_default();
            text.starts_with("counting") || text.starts_with("visits:")
        })
    };
    while !window.state().is_finished() || is_counting(&window) {
        window.run_steps(2);
        std::thread::sleep(Duration::from_millis(5));
    }
    // Not only the cells to a depth.
    window.get_by_label("Cells").click();
    window.run_steps(4);
    window.get_by_label("All leaves").click();
    let all = format!("{leaves} of {leaves} leaves");
    let start = Instant::now();
    while window.query_all_by_label_contains(&all).next().is_none() {
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "all leaves are shown"
        );
        window.run_steps(2);
        std::thread::sleep(Duration::from_millis(5));
    }
    println!("{scene}, {leaves} leaves, all shown; {FRAMES} frames each; goal 8 ms");

    report("nothing changes", &frames(&mut window, |_, _| ()));
    report("the camera moves", &camera(&mut window));
    report("the build is scrubbed", &scrubbing(&mut window));

    println!("in the task Ray: the leaves that the ray visits");
    // A click leads there; the picture has another place.
    window.get_by_label("Traced picture").click();
    window.run_steps(60);
    let picture = window.get_by_label("Traced picture").rect().center();
    window.hover_at(picture);
    report(
        "the picked pixel moves",
        &frames(&mut window, |window, i| {
            let key = [egui::Key::ArrowLeft, egui::Key::ArrowUp][i % 2];
            let events = &mut window.input_mut().events;
            events.extend([true, false].map(|pressed| egui::Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: egui::Modifiers::NONE,
            }));
        }),
    );

    report("the camera moves", &camera(&mut window));
}

/// Orbits in the 3D view.
fn camera(window: &mut Harness<'_, App>) -> Vec<Spent> {
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.drag_at(view.center());
    window.run_steps(2);
    let spent = frames(window, |window, i| {
        let angle = i as f32 * 0.1;
        let at = view.center() + 80.0 * egui::vec2(angle.cos(), angle.sin());
        let events = &mut window.input_mut().events;
        events.push(egui::Event::PointerMoved(at));
    });
    window.drop_at(view.center());
    window.run_steps(2);
    spent
}

/// Drags the moment of the build, near the finished tree, where there is most to make.
fn scrubbing(window: &mut Harness<'_, App>) -> Vec<Spent> {
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::G);
    window.run_steps(6);
    let moments = window
        .get_by_role_and_label(egui::accesskit::Role::Slider, "Moment of the build")
        .rect();
    window.drag_at(moments.right_center());
    window.run_steps(2);
    let spent = frames(window, |window, i| {
        let back = (i % 50) as f32;
        window.hover_at(moments.right_center() - egui::vec2(back, 0.0));
    });
    window.drop_at(moments.right_center());
    window.run_steps(2);
    // Back to the finished tree.
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::G);
    window.run_steps(6);
    spent
}

/// The window thread's time of a frame.
#[derive(Clone, Copy)]
struct Spent {
    /// On the wall, with what other programs and threads took.
    wall: Duration,
    /// Of the processor, for the window thread alone.
    cpu: Duration,
}

/// The time of every frame; `act` comes before each and is not timed.
fn frames<'a>(
    window: &mut Harness<'a, App>,
    mut act: impl FnMut(&mut Harness<'a, App>, usize),
) -> Vec<Spent> {
    (0..FRAMES)
        .map(|i| {
            act(window, i);
            let (wall, cpu) = (Instant::now(), ThreadTime::now());
            window.step();
            Spent {
                wall: wall.elapsed(),
                cpu: cpu.elapsed(),
            }
        })
        .collect()
}

fn report(what: &str, frames: &[Spent]) {
    println!("{what}");
    for (clock, time) in [
        ("wall", frames.iter().map(|f| f.wall).collect::<Vec<_>>()),
        ("CPU", frames.iter().map(|f| f.cpu).collect()),
    ] {
        let mut time = time;
        time.sort_unstable();
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        println!(
            "    {clock:4}  median {:6.2} ms   95 % {:6.2} ms   worst {:6.2} ms",
            ms(time[time.len() / 2]),
            ms(time[time.len() * 95 / 100]),
            ms(time[time.len() - 1])
        );
    }
}
