//! How well the time model of the paper's equation (1) predicts T_TR of trees it was not fitted to,
//! on each of the paper's six scenes. Times depend on the machine; run it on one that rests.

use bspscope::measure::model::{Equation, Term, fit, observe, parted, trees};
use bspscope::measure::paper::SCENES;
use bspscope::progress::Progress;
use bspscope::scene::{Cylinders, SceneRequest, load};
use bspscope::trace::RenderSettings;

/// Width and height of the pictures in pixels.
const SIZE: u32 = 192;
/// How often each tree is timed.
const ROUNDS: u32 = 7;
/// The greatest relative error that is aimed at.
const GOAL: f64 = 0.15;

fn main() {
    let progress = Progress::new();
    println!(
        "scene      R²       worst    trees left out   (goal: within {:.0} %)",
        GOAL * 100.0
    );
    for scene in &SCENES {
        let request = SceneRequest {
            cylinders: Cylinders::Polygons(10),
            ..SceneRequest::parse(scene.name)
        };
        let loaded = load(&request, &progress).expect("a generator's scene loads");
        let render = RenderSettings {
            width: SIZE,
            height: SIZE,
            threads: 1,
            ..RenderSettings::for_camera(*loaded.camera())
        };
        let observations: Vec<_> = trees(&loaded)
            .iter()
            .map(|build| observe(&loaded, build, &render, ROUNDS, &progress))
            .collect::<Result<_, _>>()
            .expect("the trees can be built and traced");
        let [fitted, left_out] = parted(&observations);
        let model =
            fit(&fitted, &Term::of(&loaded), Equation::Corrected).expect("there are enough trees");
        let errors = model.errors(&left_out);
        let worst = errors
            .iter()
            .fold(0.0f64, |worst, error| error.abs().max(worst));
        println!(
            "{:<10} {:.4}   {:>5.1} %   {:>2}   {}",
            scene.name,
            model.r_squared,
            worst * 100.0,
            errors.len(),
            if worst <= GOAL { "within" } else { "BEYOND" }
        );
    }
}
