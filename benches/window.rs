//! How long a person waits: from a change to the first coarse picture and to the full pass, how soon
//! work that is not wanted any more stops, and what an idle window costs. `cargo bench --bench window`.

use bspscope::jobs::{Cache, End, Handle, RenderPicture, Scheduler, Stage, Update};
use bspscope::progress::Progress;
use bspscope::scene::{CameraOverride, Cylinders, SceneRequest, load};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, MaxDepth, Method, RootMargin};
use bspscope::trace::RenderSettings;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{ConnectionExt, ImageFormat};

/// How often each thing is measured.
const ROUNDS: usize = 5;

fn main() {
    changes();
    println!("rings with 46,201 objects, 512 × 512 pixels, D_AREC 4; {ROUNDS} rounds each");
    stops();
    startup();
    idle();
}

/// The scenes of [`changes`], with the goal for the first coarse picture.
const SCENES: [(&str, Duration); 2] = [
    ("balls", Duration::from_millis(100)),
    ("rings", Duration::from_millis(150)),
];

fn first_request(scene: &str) -> Setup {
    let scene = SceneRequest {
        cylinders: Cylinders::Polygons(10),
        ..SceneRequest::parse(scene)
    };
    let loaded = load(&scene, &Progress::new()).expect("the generator works");
    Setup {
        scene,
        build: BuildSettings::for_method(Method::of_the_paper()[0]),
        render: RenderSettings::for_camera(*loaded.camera()),
    }
}

/// A scheduler with the cache that its pictures share.
struct Pictures {
    scheduler: Scheduler,
    cache: Cache,
    woken: Receiver<()>,
}

impl Pictures {
    fn new() -> Pictures {
        let (wake, woken) = channel();
        Pictures {
            scheduler: Scheduler::new(move || {
                // The end of the benchmark may come first.
                let _ = wake.send(());
            }),
            cache: Cache::default(),
            woken,
        }
    }

    fn request(&self, setup: Setup) -> Handle<RenderPicture> {
        self.scheduler.start(RenderPicture {
            setup,
            reload: 0,
            cache: self.cache.clone(),
        })
    }

    /// Waits until an update of this request is `wanted`, or until it is done if none is. Returns the
    /// time when it arrived.
    fn until(
        &self,
        job: &Handle<RenderPicture>,
        mut wanted: impl FnMut(&Update) -> bool,
    ) -> Instant {
        loop {
            let _ = self.woken.recv_timeout(Duration::from_millis(50));
            let now = Instant::now();
            let news = job.receive();
            if news.partials.iter().any(&mut wanted) {
                return now;
            }
            match news.end {
                Some(End::Done(())) => return now,
                Some(end) => panic!("{end:?}"),
                None => {}
            }
        }
    }

    fn until_done(&self, job: &Handle<RenderPicture>) -> Instant {
        self.until(job, |_| false)
    }
}

/// From each change to the first picture and to complete figures, as a table. The first picture of a
/// change of method, D_MAX or N_OILF waits for the whole tree; until then, the window keeps the old
/// picture, which has the same pixels.
fn changes() {
    println!(
        "{:5}  {:11}  {:6}  {:>9} {:>9} {:>9} {:>9}  {:>9}",
        "scene", "pixels", "change", "tree", "first", "worst", "goal", "complete"
    );
    for (scene, goal) in SCENES {
        for size in [[512, 512], [1600, 1000]] {
            changes_of(scene, size, goal);
        }
    }
}

fn changes_of(scene: &str, [width, height]: [u32; 2], goal: Duration) {
    let pictures = Pictures::new();
    let mut wanted = first_request(scene);
    (wanted.render.width, wanted.render.height) = (width, height);
    pictures.until_done(&pictures.request(wanted.clone()));
    type Change = fn(&mut Setup, usize);
    let kinds: [(&str, Change); 4] = [
        ("method", |request, round| {
            let methods = Method::of_the_paper();
            request.build = BuildSettings::for_method(methods[(round + 1) % 2]);
            // Not a tree that is at hand.
            request.build.root_margin = RootMargin::Length(0.001 + round as f64 * 1e-6);
        }),
        ("D_MAX", |request, round| {
            request.build.d_max = MaxDepth::Fixed(12 + round as u32 % 8);
        }),
        ("N_OILF", |request, round| {
            request.build.n_oilf = 2 + round as u32
        }),
        ("camera", |request, round| {
            let from = request.render.camera.from.get_or_insert_default();
            from.x += 0.01 * (round + 1) as f64;
        }),
    ];
    for (name, change) in kinds {
        let is_small = wanted.render.width * wanted.render.height < 1 << 20;
        let (mut tree, mut first, mut full) = (Vec::new(), Vec::new(), Vec::new());
        for round in 0..ROUNDS {
            change(&mut wanted, round);
            let begun = Instant::now();
            let job = pictures.request(wanted.clone());
            let previews = |u: &Update| matches!(u, Update::Stage(Stage::Previewing));
            let is_shown = |u: &Update| matches!(u, Update::Shown(_));
            // Both can arrive at once.
            let mut built = None;
            let shown = pictures.until(&job, |update| {
                if previews(update) {
                    built = Some(Instant::now());
                }
                is_shown(update)
            });
            tree.push(built.unwrap_or(shown) - begun);
            first.push(shown - begun);
            // A large picture takes too long to wait for; the next request cancels it.
            let done = is_small.then(|| pictures.until_done(&job));
            full.push(done.unwrap_or(begun) - begun);
        }
        for times in [&mut tree, &mut first, &mut full] {
            times.sort_unstable();
        }
        let ms = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
        let [tree, of_first, full] = [&tree, &first, &full].map(|times| ms(times[ROUNDS / 2]));
        let full = if is_small { full } else { "–".to_owned() };
        let (worst, goal) = (ms(first[ROUNDS - 1]), ms(goal));
        let size = format!("{width} × {height}");
        println!(
            "{scene:5}  {size:11}  {name:6}  {tree:>9} {of_first:>9} {worst:>9} {goal:>9}  {full:>9}"
        );
    }
}

/// From a new request to the moment when the old one has stopped and the new one's small scene is
/// loaded.
fn stops() {
    let pictures = Pictures::new();
    let first = first_request("rings");
    for (name, stage) in [
        ("building", Stage::Building),
        ("rendering", Stage::Rendering),
        ("counting", Stage::Counting),
    ] {
        let mut times = Vec::new();
        for _ in 0..ROUNDS {
            let stale = first.clone();
            let job = pictures.request(stale);
            pictures.until(&job, |u| matches!(u, Update::Stage(s) if *s == stage));
            std::thread::sleep(Duration::from_millis(5));
            let asked = Instant::now();
            let mut next = first.clone();
            next.scene = SceneRequest::parse("teaching");
            next.render.camera = CameraOverride::default();
            let job = pictures.request(next);
            // Its first unit waits for the end of the old one.
            let builds = |u: &Update| matches!(u, Update::Stage(Stage::Building));
            times.push(pictures.until(&job, builds) - asked);
            pictures.until_done(&job);
        }
        report(&format!("while {name}: until that has stopped"), times);
    }
}

/// Ends a process with the benchmark.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A virtual display of this number; `None` where there is no Xvfb.
fn display(number: u32) -> Option<Running> {
    let server = Command::new("Xvfb")
        .arg(format!(":{number}"))
        .args(["-screen", "0", "1400x900x24", "-nolisten", "tcp"])
        .stderr(Stdio::null())
        .spawn();
    let server = Running(server.ok()?);
    std::thread::sleep(Duration::from_secs(1));
    Some(server)
}

/// From starting the program to the first frame of its window, and to the first picture of balls in it,
/// as they are seen on the screen; every time with an empty settings folder.
fn startup() {
    /// A part of the picture that the card of the first start leaves free, in pixels of the screen: corner and
    /// size.
    const PICTURE: [i16; 4] = [180, 430, 60, 60];
    /// A piece of the bar at the top.
    const BAR: [i16; 4] = [0, 0, 300, 20];
    let Some(_server) = display(88) else {
        println!("start: not measured, there is no Xvfb");
        return;
    };
    let (screen, number) = x11rb::connect(Some(":88")).expect("the display is there");
    let root = screen.setup().roots[number].root;
    // How many different pixels there are in a part of the screen.
    let colors = |[x, y, width, height]: [i16; 4]| {
        let size = [width, height].map(|side| side as u16);
        let image = screen
            .get_image(ImageFormat::Z_PIXMAP, root, x, y, size[0], size[1], !0)
            .expect("a request")
            .reply()
            .expect("a part of the screen");
        let mut pixels: Vec<_> = image.data.chunks_exact(4).collect();
        pixels.sort_unstable();
        pixels.dedup();
        pixels.len()
    };
    let (mut frames, mut pictures) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let settings = tempfile::tempdir().expect("a folder");
        let begun = Instant::now();
        let window = Command::new(env!("CARGO_BIN_EXE_bspscope"))
            .env("DISPLAY", ":88")
            .env_remove("WAYLAND_DISPLAY")
            .env("XDG_CONFIG_HOME", settings.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let _window = Running(window);
        for (part, least, times) in [(BAR, 3, &mut frames), (PICTURE, 20, &mut pictures)] {
            while colors(part) < least {
                assert!(begun.elapsed() < Duration::from_secs(60), "nothing to see");
                std::thread::sleep(Duration::from_millis(5));
            }
            times.push(begun.elapsed());
        }
    }
    println!("start of the program with balls");
    report("to the first frame", frames);
    report("to the first picture", pictures);
}

/// CPU time of the real window while nothing happens, on a virtual display.
fn idle() {
    let Some(_server) = display(87) else {
        println!("idle window: not measured, there is no Xvfb");
        return;
    };
    let window = Command::new(env!("CARGO_BIN_EXE_bspscope"))
        .env("DISPLAY", ":87")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let window = Running(window);
    std::thread::sleep(Duration::from_secs(30));
    let before = cpu_ticks(window.0.id());
    std::thread::sleep(Duration::from_secs(5));
    match (before, cpu_ticks(window.0.id())) {
        // A tick is a hundredth of a second on Linux.
        (Some(before), Some(after)) => println!(
            "idle window: {:.1} % of one core over 5 s",
            (after - before) as f64 / 5.0
        ),
        _ => println!("idle window: not measured, it did not run or there is no /proc"),
    }
}

/// User and system time of a process.
fn cpu_ticks(process: u32) -> Option<u64> {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name, in brackets, may hold spaces.
    let mut fields = stat[stat.rfind(')')? + 2..].split(' ');
    let user: u64 = fields.nth(11)?.parse().ok()?;
    let system: u64 = fields.next()?.parse().ok()?;
    Some(user + system)
}

fn report(what: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "  {what}: median {:.1} ms, worst {:.1} ms",
        ms(times[times.len() / 2]),
        ms(times[times.len() - 1])
    );
}
