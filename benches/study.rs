//! Which measure predicts time, over all scenes: `cargo bench --bench study`. The command
//! `bspscope study measures -o docs/which-measure.md --figures docs/which-measure` does the same and writes the
//! document. Times depend on the machine; run it on one that rests.

use bspscope::measure::structures;
use bspscope::measure::study::{KERNELS, Observing, Outcome, Plan, SCENES};
use bspscope::present::report::study::{STUDY_WRITERS, StudyReport};
use bspscope::present::report::{Machine, now};
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::trace::{PrecisionChoice, RenderSettings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let progress = Progress::new();
    let mut outcomes = Vec::new();
    for name in SCENES {
        let scene = load(&SceneRequest::parse(name), &progress)?;
        let plan = Plan {
            render: RenderSettings {
                precision: PrecisionChoice::Auto,
                ..RenderSettings::default()
            },
            builds: structures(&scene),
            kernels: KERNELS.to_vec(),
            rays: 4096,
            rounds: 5,
        };
        let mut observing = Observing::new(&scene, plan.clone(), &progress)?;
        while observing.upcoming().is_some() {
            observing.turn(&progress)?;
        }
        outcomes.push(Outcome::of(&scene, &plan, observing));
    }
    let report = StudyReport {
        outcomes,
        machine: Machine::here(),
        date: now(),
        command: "cargo bench --bench study".into(),
        figures: None,
    };
    (STUDY_WRITERS[0].write)(&report, &mut std::io::stdout())?;
    Ok(())
}
