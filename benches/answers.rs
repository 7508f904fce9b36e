//! Embree's answers about *terrain*, checked by exact arithmetic as `bspscope check` does it: `cargo bench --bench
//! answers`. `-- --rays 10000 --side 100` is a short run.

#[path = "peers/embree.rs"]
#[allow(dead_code)] // The bench peers uses all of it.
mod embree;
#[path = "peers/kernels.rs"]
#[allow(dead_code)] // As above.
mod kernels;

use bspscope::geometry::Ray;
use bspscope::measure::answers::{AnswerClass, check_answers};
use bspscope::measure::judge::Answer;
use bspscope::measure::sample_rays;
use bspscope::primitive::Precision;
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::scene::builtin::generate;
use bspscope::structure::{BuildSettings, Method, build};
use bspscope::trace::{Hit, RenderSettings, thread_pool};
use clap::Parser;
use kernels::{Kernel, NarrowRay, Rays};
use std::sync::Arc;
use std::time::Instant;

/// Checks Embree's answers about terrain
#[derive(Parser)]
struct Options {
    /// Number of rays
    #[arg(long, default_value_t = 1_000_000)]
    rays: usize,
    /// Squares along a side of the terrain, each of two triangles
    #[arg(long, default_value_t = 707)]
    side: u32,
    /// What cargo passes to every bench
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse();
    let (pool, progress) = (thread_pool(0)?, Progress::new());
    let scene = Scene::new(generate("terrain", Some(options.side))?);
    let settings = BuildSettings::for_method(Method::named("bvh-binned")?);
    let tree = build(&scene, &settings, &progress)?;
    let render = RenderSettings::for_camera(*scene.camera());
    let sample = sample_rays(&scene, &tree, &render, options.rays, &pool, &progress)?;
    let round = |ray: &Ray| Ray {
        origin: ray.origin.as_vec3().as_dvec3(),
        direction: ray.direction.as_vec3().as_dvec3(),
        ..*ray
    };
    let rays: Vec<Ray> = sample.rays[0].iter().map(round).collect();
    let Some(embree) = embree::Embree::new(&scene, 1).map(Arc::new) else {
        println!("Embree is not installed");
        return Ok(());
    };
    let narrow: Vec<NarrowRay> = rays.iter().map(NarrowRay::from).collect();
    let (mut found, mut blocked) = (Vec::new(), Vec::new());
    let both = Rays {
        wide: &rays,
        narrow: &narrow,
    };
    embree.closest(both, &mut found);
    embree.any(both, &mut blocked);
    let hit = |found: &Option<(f64, u32)>| found.map_or(Hit::MISS, |(t, object)| Hit { t, object });
    let closest = found.iter().map(|found| Answer::Nearest(hit(found)));
    let any = blocked.iter().map(|&blocked| Answer::Blocked(blocked));
    let questions: [(&str, Vec<Answer>); 2] = [
        ("closest hits", closest.collect()),
        ("any hits", any.collect()),
    ];
    for (question, answers) in questions {
        let start = Instant::now();
        let asked = (rays.as_slice(), answers.as_slice());
        let check = check_answers(&scene, &tree, asked, Precision::F32, &pool, &progress)?;
        let (triangles, time) = (scene.objects().len(), start.elapsed().as_secs_f64());
        let count = rays.len();
        println!("{triangles} triangles, {count} {question} of Embree, checked in {time:.1} s");
        for class in AnswerClass::ALL {
            println!("{:>10} {:>10}", class.name(), check.counts[class as usize]);
        }
        for fault in check.faults.iter().take(5) {
            println!("{fault:?}");
        }
    }
    Ok(())
}
