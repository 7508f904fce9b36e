//! Our kernels beside those of others, on the same rays: `cargo bench --bench peers`.
//!
//! Every round runs every kernel on a set of rays before the next round begins, so that other load affects
//! all of them. A figure is the median over the rounds of the ratio to Embree's kernel for single rays. A
//! short run: `cargo bench --bench peers -- --scene tetra --rounds 3`. `benches/README.md` lists results.

#[path = "peers/crates.rs"]
mod crates;
#[path = "peers/embree.rs"]
mod embree;
#[path = "peers/kernels.rs"]
mod kernels;
#[path = "peers/ours.rs"]
mod ours;
#[path = "peers/rays.rs"]
mod rays;
#[path = "peers/scenes.rs"]
mod scenes;
#[path = "peers/tinybvh.rs"]
mod tinybvh;

use bspscope::measure::processor;
use bspscope::structure::SimdTree;
use bspscope::trace::{Hit, InstructionSet};
use clap::Parser;
use kernels::{Found, Kernel, NarrowRay, Rays};
use rays::{RaySet, ray_sets};
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Compares our kernels with Embree, obvhs, parry3d and tinybvh: rays per second on five sets of rays
#[derive(Parser)]
struct Options {
    /// Scenes to run: tetra, terrain, balls, balls-tessellated, room [default: all]
    #[arg(long, value_name = "NAME")]
    scene: Vec<String>,
    /// Sets of rays to run, by letter: P, D, C, S, A
    #[arg(long, default_value = "PDCSA")]
    sets: String,
    /// Run only kernels whose name contains this, and Embree
    #[arg(long, value_name = "TEXT", default_value = "")]
    kernel: String,
    /// Rounds over all kernels
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// Size of a set in rays: those of an image of SIZE × SIZE pixels; a multiple of 4
    #[arg(long, value_name = "SIZE", default_value_t = 512)]
    size: u32,
    /// Numbers of threads to run with
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    threads: Vec<usize>,
    /// Write all figures to this file as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<std::path::PathBuf>,
    /// What cargo passes to every bench
    #[arg(long, hide = true)]
    bench: bool,
}

/// A kernel, with the time of building its tree.
struct Entrant<'a> {
    name: String,
    kernel: Box<dyn Kernel + 'a>,
    build: Duration,
}

/// The answers of a kernel for a set of rays.
#[derive(Default)]
struct Answers {
    found: Vec<Found>,
    blocked: Vec<bool>,
}

fn main() {
    let options = Options::parse();
    assert!(options.size.is_multiple_of(4) && options.size > 0 && options.rounds > 0);
    let wanted = |name: &str| options.scene.is_empty() || options.scene.iter().any(|s| s == name);
    let mut report = Vec::new();
    let mut wrong = 0;
    for (name, make) in scenes::SCENES {
        if wanted(name) {
            wrong += run(&make(), &options, &mut report);
        }
    }
    if let Some(path) = &options.json {
        let report = json!({
            "processor": processor(),
            "instruction_sets": InstructionSet::ALL
                .into_iter()
                .filter(|set| set.is_available())
                .map(InstructionSet::name)
                .collect::<Vec<_>>(),
            "figures": report,
        });
        let text = serde_json::to_string_pretty(&report).expect("numbers and text");
        std::fs::write(path, text).expect("the file can be written");
    }
    if wrong > 0 {
        println!("{wrong} answers of our kernels differ from those of the scalar one");
        std::process::exit(1);
    }
}

/// Runs all kernels on a scene. Returns the number of wrong answers of ours.
fn run(subject: &scenes::Subject, options: &Options, report: &mut Vec<Value>) -> usize {
    let scene = &subject.scene;
    println!("\n{}: {} objects", subject.name, scene.objects().len());
    let wanted = |name: &str| name.contains(&options.kernel);
    let timed = |name: &str, make: &dyn Fn() -> Option<Box<dyn Kernel>>| {
        let start = Instant::now();
        let kernel = make()?;
        let build = start.elapsed();
        let name = name.to_owned();
        Some(Entrant {
            name,
            kernel,
            build,
        })
    };
    let trees = ours::CHOICES.map(|choice| {
        let start = Instant::now();
        let tree = ours::build(scene, &choice);
        let bytes = if choice.is_simd {
            SimdTree::of(scene, &tree).bytes()
        } else {
            tree.bytes()
        };
        let build = start.elapsed();
        println!(
            "{}: {} nodes, {} references, depth {}, {:.1} bytes per object",
            choice.describe(),
            tree.nodes().len(),
            tree.references().len(),
            tree.depth_reached(),
            bytes as f64 / scene.objects().len() as f64
        );
        (choice, tree, build)
    });
    let mut entrants = Vec::new();
    let start = Instant::now();
    match embree::Embree::new(scene, 1) {
        Some(embree) => {
            let (embree, build) = (Arc::new(embree), start.elapsed());
            let packets = |name: &str, kernel: Box<dyn Kernel>| Entrant {
                name: name.to_owned(),
                kernel,
                build,
            };
            entrants.push(packets("embree i1", Box::new(embree.clone())));
            let kernel = Box::new(embree::Packets::<8>(embree.clone()));
            entrants.push(packets("embree i8", kernel));
            let kernel = Box::new(embree::Packets::<16>(embree));
            entrants.push(packets("embree i16", kernel));
        }
        None => println!(
            "Embree is not installed (Debian: libembree3-3); ratios are to the first kernel"
        ),
    }
    if wanted("obvhs") {
        entrants.extend(timed("obvhs", &|| {
            Some(Box::new(crates::Obvhs::new(scene)?) as _)
        }));
    }
    if wanted("parry3d") {
        entrants.extend(timed("parry3d", &|| {
            Some(Box::new(crates::Parry::new(scene)?) as _)
        }));
    }
    if wanted("tinybvh") {
        entrants.extend(timed("tinybvh", &|| {
            Some(Box::new(tinybvh::TinyBvh::new(scene)?) as _)
        }));
    }
    let reference = entrants.len();
    for (choice, tree, build) in &trees {
        for (name, kernel) in ours::kernels(choice, scene, tree) {
            entrants.push(Entrant {
                name,
                kernel,
                build: *build,
            });
        }
    }
    let sets = ray_sets(subject, options.size, |rays| {
        let mut found = Vec::new();
        let narrow: Vec<NarrowRay> = rays.iter().map(NarrowRay::from).collect();
        let rays = Rays {
            wide: rays,
            narrow: &narrow,
        };
        entrants[reference].kernel.closest(rays, &mut found);
        found
            .iter()
            .map(|f| f.map_or(Hit::MISS, |(t, object)| Hit { t, object }))
            .collect()
    });
    let first = entrants[0].name.clone();
    let scalar = entrants[reference].name.clone();
    let (entrants, ours): (Vec<Entrant<'_>>, Vec<bool>) = entrants
        .into_iter()
        .enumerate()
        .map(|(i, entrant)| (entrant, i >= reference))
        .filter(|(e, _)| wanted(&e.name) || e.name == first || e.name == scalar)
        .unzip();

    let mut wrong = 0;
    for &threads in &options.threads {
        println!(
            "{threads} thread(s); Mrays/s of {first}, then ratios to it; differing hits in brackets"
        );
        let mut rows: Vec<String> = entrants
            .iter()
            .map(|e| format!("{:22} build {:6.2} s", e.name, e.build.as_secs_f64()))
            .collect();
        for set in sets.iter().filter(|set| options.sets.contains(set.letter)) {
            let narrow: Vec<NarrowRay> = set.rays.iter().map(NarrowRay::from).collect();
            let rays = Rays {
                wide: &set.rays,
                narrow: &narrow,
            };
            let mut times = vec![Vec::new(); entrants.len()];
            let mut answers: Vec<Answers> = entrants.iter().map(|_| Answers::default()).collect();
            for _ in 0..options.rounds {
                for (k, entrant) in entrants.iter().enumerate() {
                    let time = ask(entrant.kernel.as_ref(), set, rays, threads, &mut answers[k]);
                    times[k].push(time);
                }
            }
            let reference = entrants
                .iter()
                .position(|e| e.name == scalar)
                .expect("kept");
            for (k, entrant) in entrants.iter().enumerate() {
                let mut ratios: Vec<f64> =
                    times[0].iter().zip(&times[k]).map(|(a, b)| a / b).collect();
                let ratio = median(&mut ratios);
                let mut seconds = times[k].clone();
                let rate = set.rays.len() as f64 / median(&mut seconds) / 1e6;
                let differing = differing(set, &answers[reference], &answers[k]);
                // Ours must answer as the scalar kernel does, up to rounding to f32.
                let allowed = set.rays.len() / if ours[k] { 2000 } else { 100 };
                if ours[k] && differing > allowed {
                    wrong += differing;
                }
                let figure = if k == 0 { rate } else { ratio };
                rows[k] += &format!("  {} {figure:5.2} ({differing})", set.letter);
                report.push(json!({
                    "scene": subject.name, "objects": scene.objects().len(), "threads": threads,
                    "set": set.name, "rays": set.rays.len(), "kernel": entrant.name,
                    "mrays_per_s": rate, "ratio_to": first, "ratio": ratio,
                    "differing_hits": differing, "build_s": entrant.build.as_secs_f64(),
                }));
            }
        }
        rows.iter().for_each(|row| println!("{row}"));
    }
    wrong
}

/// Rays per work item of a thread.
const CHUNK: usize = 1 << 14;

/// Runs a kernel, replaces the answers of the last round, and returns the time in seconds: CPU time for
/// one thread, wall-clock time for several.
fn ask(
    kernel: &dyn Kernel,
    set: &RaySet,
    rays: Rays<'_>,
    threads: usize,
    answers: &mut Answers,
) -> f64 {
    let ask = |rays: Rays<'_>, answers: &mut Answers| {
        if set.any {
            kernel.any(rays, &mut answers.blocked);
        } else {
            kernel.closest(rays, &mut answers.found);
        }
    };
    // Written once before, so that page faults are not timed.
    let room = rays.wide.len();
    answers.found.resize(room, None);
    answers.found.clear();
    answers.blocked.resize(room, false);
    answers.blocked.clear();
    if threads == 1 {
        let start = cpu_time::ThreadTime::now();
        ask(rays, answers);
        return start.elapsed().as_secs_f64();
    }
    let chunks: Vec<Rays<'_>> = rays
        .wide
        .chunks(CHUNK)
        .zip(rays.narrow.chunks(CHUNK))
        .map(|(wide, narrow)| Rays { wide, narrow })
        .collect();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let parts = std::sync::Mutex::new(Vec::new());
    let start = Instant::now();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(&rays) = chunks.get(k) else { return };
                    let mut answers = Answers {
                        found: Vec::with_capacity(rays.wide.len()),
                        blocked: Vec::with_capacity(rays.wide.len()),
                    };
                    ask(rays, &mut answers);
                    parts.lock().expect("no thread panics").push((k, answers));
                }
            });
        }
    });
    let time = start.elapsed().as_secs_f64();
    let mut parts = parts.into_inner().expect("no thread panics");
    parts.sort_by_key(|(k, _)| *k);
    for (_, part) in parts {
        answers.found.extend(part.found);
        answers.blocked.extend(part.blocked);
    }
    time
}

/// Returns the number of answers that differ by more than the rounding of `f32`.
fn differing(set: &RaySet, a: &Answers, b: &Answers) -> usize {
    if set.any {
        return a
            .blocked
            .iter()
            .zip(&b.blocked)
            .filter(|(a, b)| a != b)
            .count();
    }
    let differ = |(a, b): &(&Found, &Found)| match (a, b) {
        (Some((a, _)), Some((b, _))) => (a - b).abs() > 1e-4 * a.abs().max(1e-2),
        (a, b) => a.is_some() != b.is_some(),
    };
    a.found.iter().zip(&b.found).filter(differ).count()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
