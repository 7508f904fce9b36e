//! How build time and memory grow with the scene: `cargo bench --bench growth`.
//!
//! Builds terrain of 10 thousand to 10 million triangles by the given methods on each number of threads,
//! and by Embree where it is installed. They take turns, so that other load affects all of them. Figures
//! are medians. Memory is that of the tree, the references and the objects of the scalar kernel in `f32`.
//! `benches/README.md` lists results.

#[allow(dead_code, reason = "Embree only builds here")]
#[path = "peers/embree.rs"]
mod embree;
#[allow(dead_code, reason = "Embree only builds here")]
#[path = "peers/kernels.rs"]
mod kernels;

use bspscope::primitive::Precision;
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::scene::builtin::generate;
use bspscope::structure::split::Structure;
use bspscope::structure::{BuildSettings, MaxDepth, Method, Tree, build};
use clap::Parser;
use cpu_time::ProcessTime;
use std::time::Instant;

/// Build time and memory of terrain of growing size.
#[derive(Parser)]
struct Options {
    /// Numbers of triangles, about
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "10000,100000,1000000,10000000"
    )]
    sizes: Vec<usize>,
    /// Build methods
    #[arg(long, value_delimiter = ',', default_value = "sah,bvh-binned")]
    methods: Vec<String>,
    /// Numbers of threads to build with
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    threads: Vec<usize>,
    /// Rounds over all
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// What cargo passes to every bench
    #[arg(long, hide = true)]
    bench: bool,
}

/// Seconds on the clock on the wall and of all threads' work, of each round.
#[derive(Default)]
struct Spent {
    wall: Vec<f64>,
    cpu: Vec<f64>,
}

impl Spent {
    fn on<R>(&mut self, task: impl FnOnce() -> R) -> R {
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        let result = task();
        self.wall.push(wall.elapsed().as_secs_f64());
        self.cpu.push(cpu.elapsed().as_secs_f64());
        result
    }

    fn medians(&self) -> [f64; 2] {
        [&self.wall, &self.cpu].map(|seconds| {
            let mut seconds = seconds.clone();
            seconds.sort_by(f64::total_cmp);
            seconds[seconds.len() / 2]
        })
    }
}

fn main() {
    let options = Options::parse();
    assert!(options.rounds > 0, "there must be a round");
    println!(
        "{:>9} {:14} {:>7} {:>9} {:>9} {:>8} {:>10} {:>10} {:>11} {:>11}",
        "triangles",
        "method",
        "threads",
        "wall, ms",
        "CPU, ms",
        "/ Embree",
        "nodes",
        "references",
        "tree, B/tri",
        "all, B/tri"
    );
    for &size in &options.sizes {
        // Two triangles a quadrangle.
        let side = (size as f64 / 2.0).sqrt() as u32;
        let scene = Scene::new(generate("terrain", Some(side)).expect("a size in range"));
        measure(&scene, &options);
    }
}

/// Builds a scene with everything in turns and prints a line for each.
fn measure(scene: &Scene, options: &Options) {
    let settings: Vec<BuildSettings> = options
        .methods
        .iter()
        .map(|name| {
            let method = Method::named(name).expect("a method");
            // The paper's methods end by depth, others by cost.
            let d_max = match method.paper {
                Some(_) => MaxDepth::Automatic,
                None => MaxDepth::Fixed(MaxDepth::LIMIT),
            };
            let mut settings = BuildSettings {
                d_max,
                memory_limit: 16 << 30,
                ..BuildSettings::for_method(method)
            };
            // As the SIMD kernel for hierarchies is measured.
            if method.structure == Structure::Bvh {
                let eight = ["width", "block"].map(|name| (name.to_owned(), 8.0));
                settings.constants.extend(eight);
            }
            settings
        })
        .collect();
    for &threads in &options.threads {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        let mut embree = Spent::default();
        let mut ours: Vec<Spent> = settings.iter().map(|_| Spent::default()).collect();
        let mut trees: Vec<Option<Tree>> = settings.iter().map(|_| None).collect();
        for _ in 0..options.rounds {
            let peer = embree.on(|| embree::Embree::new(scene, threads));
            if peer.is_none() {
                embree = Spent::default();
            }
            drop(peer);
            for ((settings, spent), tree) in settings.iter().zip(&mut ours).zip(&mut trees) {
                *tree = None;
                let task = || pool.install(|| build(scene, settings, &Progress::new()));
                *tree = Some(spent.on(task).expect("a tree"));
            }
        }
        let objects = scene.objects().len();
        let peer = (!embree.cpu.is_empty()).then(|| embree.medians());
        if let Some([wall, cpu]) = peer {
            println!(
                "{objects:9} {:14} {threads:7} {:9.1} {:9.1}",
                "Embree",
                1e3 * wall,
                1e3 * cpu
            );
        }
        for ((settings, spent), tree) in settings.iter().zip(&ours).zip(&trees) {
            let tree = tree.as_ref().expect("a round built it");
            let [wall, cpu] = spent.medians();
            // Of the work on one thread, as then other programs do not count; else of the time.
            let ratio = peer.map_or("–".into(), |[peer_wall, peer_cpu]| {
                let ratio = if threads == 1 {
                    cpu / peer_cpu
                } else {
                    wall / peer_wall
                };
                format!("{ratio:.2}")
            });
            let held = scene.shapes(Precision::F32).bytes();
            println!(
                "{objects:9} {:14} {threads:7} {:9.1} {:9.1} {ratio:>8} {:10} {:10} {:11.1} {:11.1}",
                settings.method.name,
                1e3 * wall,
                1e3 * cpu,
                tree.nodes().len(),
                tree.references().len(),
                tree.bytes() as f64 / objects as f64,
                (tree.bytes() + held) as f64 / objects as f64,
            );
        }
    }
}
