//! How much slower the tree that `bspscope tune` recommends is than the best one of an exhaustive sweep:
//! `cargo bench --bench regret -- [SCENE…]`, by default the paper's six scenes; give it your models, too. Times depend on
//! the machine; run it on one that rests.

use bspscope::measure::model::observe;
use bspscope::measure::paper::SCENES;
use bspscope::measure::structures;
use bspscope::measure::tune::{Goal, Search, Tuning};
use bspscope::progress::Progress;
use bspscope::scene::{Scene, SceneRequest, load};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, Method};
use clap::Parser;
use std::error::Error;
use std::time::Duration;

/// The greatest regret that is aimed at.
const GOAL: f64 = 0.05;

/// The regret of the search for the best tree.
#[derive(Parser)]
struct Options {
    /// Scene files or generators [default: the six scenes of the paper]
    scenes: Vec<String>,
    /// Time for each search in seconds
    #[arg(long, default_value_t = 60.0)]
    budget: f64,
    /// Width and height of the pictures in pixels
    #[arg(long, default_value_t = 128)]
    size: u32,
    /// How often each tree of the sweep is timed; the shortest time counts
    #[arg(long, default_value_t = 5)]
    rounds: u32,
    /// Given by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let papers = || SCENES.iter().map(|scene| scene.name.to_owned()).collect();
    let scenes = match options.scenes.is_empty() {
        true => papers(),
        false => options.scenes.clone(),
    };
    println!(
        "scene        regret   recommended                 best of the sweep           trees   (goal: at most {:.0} %)",
        GOAL * 100.0
    );
    for name in scenes {
        row(&name, &options)?;
    }
    Ok(())
}

/// Searches, sweeps, and prints the line of a scene.
fn row(name: &str, options: &Options) -> Result<(), Box<dyn Error>> {
    let progress = Progress::new();
    let mut setup = Setup::new(SceneRequest::parse(name));
    (setup.render.width, setup.render.height) = (options.size, options.size);
    setup.render.threads = 1;
    let scene = load(&setup.scene, &progress)?;
    let recommended = search(&scene, &setup, options.budget, &progress)?;
    let time = |build: &BuildSettings| {
        let observed = observe(&scene, build, &setup.render, options.rounds, &progress);
        observed.map(|observed| observed.seconds)
    };
    let all = structures(&scene);
    let mut best: Option<(&BuildSettings, f64)> = None;
    for build in &all {
        match time(build) {
            Ok(seconds) if best.is_none_or(|(_, least)| seconds < least) => {
                best = Some((build, seconds));
            }
            Err(error) if !error.is_too_large() => return Err(error.into()),
            _ => {}
        }
    }
    let (best, least) = best.ok_or("no tree could be built")?;
    // The first of many times is not the luckiest: the best is timed once more, together with the other.
    let [found, least] = [time(&recommended)?, time(best)?.max(least)];
    let regret = found / least - 1.0;
    println!(
        "{:<12} {:>5.1} %   {:<27} {:<27} {:>5}   {}",
        scene.name(),
        regret * 100.0,
        recommended.in_words(),
        best.in_words(),
        all.len(),
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
