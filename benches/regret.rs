//! How much slower the tree that `bspscope tune` recommends is than the best one of an exhaustive sweep:
//! `cargo bench --bench regret -- [SCENE…]`. By default the paper's six scenes, two scenes of other kinds, and all models
//! in the folder `scenes`; give it your own, too. Less than 25 minutes on one core; `--budget` and `--rounds` make it
//! shorter. Times depend on the machine; run it on one that rests.
//!
//! The sweep times every structure once, and those within 25 % of the best more often, in turn. The best of them and
//! the recommended one are then timed again, in turn: among many structures, the one with the least times was lucky,
//! too, and would be compared with itself at its luckiest.

use bspscope::measure::paper::SCENES;
use bspscope::measure::study::median;
use bspscope::measure::tune::{Goal, Search, Tuning};
use bspscope::measure::{MeasureError, processor, structures};
use bspscope::progress::Progress;
use bspscope::scene::{Scene, SceneRequest, load};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, Method, Tree, build};
use bspscope::trace::{KernelChoice, RenderSettings, render_timed, thread_pool};
use clap::Parser;
use rayon::ThreadPool;
use std::error::Error;
use std::time::{Duration, Instant};

/// The greatest regret that is aimed at.
const GOAL: f64 = 0.05;

/// Generators beside the paper's scenes: a model of a landscape, and one of a truss.
const OTHERS: [&str; 2] = ["terrain:128", "lattice:12"];

/// The extensions of files that are models.
const MODELS: [&str; 5] = ["obj", "ply", "stl", "gltf", "glb"];

/// Structures that are at most this many times as slow as the best are timed again.
const CLOSE: f64 = 1.25;

/// The regret of the search for the best tree.
#[derive(Parser)]
struct Options {
    /// Scene files or generators [default: the six scenes of the paper, two others, and models in scenes/]
    scenes: Vec<String>,
    /// Time for each search in seconds
    #[arg(long, default_value_t = 60.0)]
    budget: f64,
    /// Width and height of the pictures in pixels
    #[arg(long, default_value_t = 128)]
    size: u32,
    /// The kernel that is timed
    #[arg(long, default_value = "auto", value_parser = kernel)]
    kernel: KernelChoice,
    /// How often each of the close structures is timed, and once more the two that are compared; the median counts
    #[arg(long, default_value_t = 9)]
    rounds: usize,
    /// Given by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

fn kernel(name: &str) -> Result<KernelChoice, String> {
    let mut all = KernelChoice::ALL.into_iter();
    all.find(|kernel| kernel.name() == name)
        .ok_or_else(|| format!("no kernel is called '{name}'"))
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let scenes = match options.scenes.is_empty() {
        true => default_scenes()?,
        false => options.scenes.clone(),
    };
    println!(
        "{}, kernel {}, {} x {} pixels, budget {} s, goal at most {:.0} %",
        processor().unwrap_or("processor unknown"),
        options.kernel.name(),
        options.size,
        options.size,
        options.budget,
        GOAL * 100.0
    );
    println!(
        "scene           regret  recommended                                 best of the sweep                           trees  close  seconds"
    );
    for name in scenes {
        row(&name, &options)?;
    }
    Ok(())
}

fn default_scenes() -> Result<Vec<String>, Box<dyn Error>> {
    let mut models = Vec::new();
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes"))? {
        let path = entry?.path();
        let extension = path.extension().and_then(|extension| extension.to_str());
        if extension.is_some_and(|extension| MODELS.contains(&extension)) {
            models.push(path.display().to_string());
        }
    }
    models.sort();
    let generators = SCENES.iter().map(|scene| scene.name).chain(OTHERS);
    Ok(generators.map(str::to_owned).chain(models).collect())
}

/// Searches, sweeps, and prints the line of a scene.
fn row(name: &str, options: &Options) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let progress = Progress::new();
    let mut setup = Setup::new(SceneRequest::parse(name));
    let render = &mut setup.render;
    (render.width, render.height) = (options.size, options.size);
    (render.threads, render.kernel) = (1, options.kernel);
    let scene = load(&setup.scene, &progress)?;
    let recommended = search(&scene, &setup, options.budget, &progress)?;
    let timer = Timer {
        scene: &scene,
        render: setup.render,
        pool: thread_pool(1)?,
        progress,
    };
    let mut all = structures(&scene);
    if !all.contains(&recommended) {
        all.push(recommended.clone());
    }
    let (best, close) = sweep(&timer, &all, options.rounds)?;
    let regret = timer.compare([&recommended, &best], options.rounds)?;
    println!(
        "{:<14} {:>5.1} %  {:<43} {:<43} {:>5}  {close:>5}  {:>7.0}  {}",
        scene.name(),
        regret * 100.0,
        recommended.in_words(),
        best.in_words(),
        all.len(),
        start.elapsed().as_secs_f64(),
        if regret <= GOAL { "within" } else { "BEYOND" }
    );
    Ok(())
}

/// Returns what the search recommends.
fn search(
    scene: &Scene,
    setup: &Setup,
    budget: f64,
    progress: &Progress,
) -> Result<BuildSettings, Box<dyn Error>> {
    let search = Search {
        setup: setup.clone(),
        goal: Goal::Time,
        rays: None,
        most_bytes: None,
        methods: Method::all().collect(),
        budget: Duration::try_from_secs_f64(budget)?,
    };
    let mut tuning = Tuning::new(scene, search)?;
    while tuning.turn(progress)?.is_some() {}
    let tuned = tuning.into_result();
    Ok(tuned.recommended().1.setup.build.clone())
}

/// Renders small pictures of a scene.
struct Timer<'a> {
    scene: &'a Scene,
    render: RenderSettings,
    pool: ThreadPool,
    progress: Progress,
}

impl Timer<'_> {
    fn build(&self, settings: &BuildSettings) -> Result<Tree, MeasureError> {
        Ok(build(self.scene, settings, &self.progress)?)
    }

    /// Returns the CPU time of a picture in seconds, after an untimed one.
    fn time(&self, tree: &Tree) -> Result<f64, MeasureError> {
        let picture = || {
            let (scene, render) = (self.scene, &self.render);
            render_timed(
                scene,
                tree,
                render,
                0,
                &self.pool,
                &self.progress,
                |_, _| (),
            )
        };
        picture()?;
        Ok(picture()?.cpu.as_secs_f64())
    }

    /// Returns by how much the first of two structures is slower than the second, as a share: 0 for the same ones.
    fn compare(&self, both: [&BuildSettings; 2], rounds: usize) -> Result<f64, MeasureError> {
        if both[0] == both[1] {
            return Ok(0.0);
        }
        let trees = [self.build(both[0])?, self.build(both[1])?];
        let mut seconds = [Vec::new(), Vec::new()];
        for _ in 0..rounds.max(1) {
            for (tree, seconds) in trees.iter().zip(&mut seconds) {
                seconds.push(self.time(tree)?);
            }
        }
        let [found, best] = seconds.map(|seconds| median(&seconds).expect("at least one round"));
        Ok(found / best - 1.0)
    }
}

/// Returns the fastest structure, and how many were timed more than once.
fn sweep(
    timer: &Timer<'_>,
    all: &[BuildSettings],
    rounds: usize,
) -> Result<(BuildSettings, usize), Box<dyn Error>> {
    let mut timed: Vec<(&BuildSettings, Tree, Vec<f64>)> = Vec::new();
    let mut least = f64::INFINITY;
    for settings in all {
        let tree = match timer.build(settings) {
            Err(error) if error.is_too_large() => continue,
            built => built?,
        };
        let seconds = timer.time(&tree)?;
        least = least.min(seconds);
        timed.push((settings, tree, vec![seconds]));
        timed.retain(|(_, _, seconds)| seconds[0] <= CLOSE * least);
    }
    for _ in 1..rounds.max(1) {
        for (_, tree, seconds) in &mut timed {
            seconds.push(timer.time(tree)?);
        }
    }
    let close = timed.len();
    let medians = timed.into_iter().map(|(settings, _, seconds)| {
        let median = median(&seconds).expect("at least one round");
        (settings.clone(), median)
    });
    let best = medians.min_by(|a, b| a.1.total_cmp(&b.1));
    let (best, _) = best.ok_or("no tree could be built")?;
    Ok((best, close))
}
