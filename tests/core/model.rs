//! Where the time of a picture goes: counts of every pixel against those of the counted pass, and the
//! parts of a picture against what the fit predicts of it.

use crate::support::scenes::{render_sized, scene, settings, tree_with};
use bspscope::measure::model::{
    Equation, PictureTerms, Region, Term, TermTimes, fit, observe, parted, trees,
};
use bspscope::measure::{measure, parameter};
use bspscope::primitive::PrimitiveKind;
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::BuildSettings;
use bspscope::trace::RenderSettings;

fn render(scene: &Scene) -> RenderSettings {
    RenderSettings {
        threads: 1,
        ..render_sized(scene, [40, 30])
    }
}

fn terms_of(scene: &Scene, settings: &BuildSettings) -> PictureTerms {
    let tree = tree_with(scene, settings);
    PictureTerms::count(scene, &tree, &render(scene), &Progress::new()).unwrap()
}

#[test]
fn the_counts_of_all_pixels_sum_to_the_papers() {
    for name in ["balls:2", "teaching"] {
        let scene = scene(name);
        let settings = settings("sah-cut");
        let sum = terms_of(&scene, &settings).sum(None);
        let measured = measure(&scene, &settings, &render(&scene), &Progress::new()).unwrap();
        let of = |symbol| parameter(symbol).value(&measured.measurement).unwrap();
        assert_eq!(sum.nodes as f64, of("N_NODES"), "{name}");
        assert_eq!(sum.rays as f64, of("N_PR") + of("N_SR") + of("N_SECR"));
        let tests: u64 = sum.hits.iter().chain(&sum.misses).sum();
        assert_eq!(tests as f64, of("N_PRIT") + of("N_SRIT") + of("N_SECRIT"));
        // Every ray that hits has a test that hits, and many a test is in vain.
        let hits: u64 = sum.hits.iter().sum();
        assert!(hits as f64 >= of("N_HPR") + of("N_HSR") + of("N_HSECR"));
        assert!(sum.misses.iter().sum::<u64>() > 0);
    }
}

#[test]
fn regions_that_part_a_picture_sum_to_it() {
    let scene = scene("balls:2");
    let terms = terms_of(&scene, &BuildSettings::default());
    let region = |x, y, width, height| {
        terms.sum(Some(Region {
            x,
            y,
            width,
            height,
        }))
    };
    let parts = [
        region(0, 0, 17, 11),
        region(17, 0, 23, 11),
        region(0, 11, 40, 19),
    ];
    let whole = terms.sum(None);
    assert_eq!(parts.iter().map(|p| p.nodes).sum::<u64>(), whole.nodes);
    assert_eq!(parts.iter().map(|p| p.rays).sum::<u64>(), whole.rays);
    let sphere = PrimitiveKind::Sphere as usize;
    let misses = parts.iter().map(|p| p.misses[sphere]).sum::<u64>();
    assert_eq!(misses, whole.misses[sphere]);
    // What lies outside of the picture does not count.
    assert_eq!(region(0, 11, 400, 190), parts[2]);
    assert_eq!(region(40, 0, 1, 1).rays, 0);
    let pixel = terms.pixels[12 * 40 + 7];
    assert_eq!(region(7, 12, 1, 1).nodes, u64::from(pixel.nodes));
}

#[test]
fn the_parts_of_a_picture_are_what_the_fit_predicts_of_it() {
    let scene = scene("balls:2");
    let (render, progress) = (render(&scene), Progress::new());
    let observations: Vec<_> = trees(&scene)
        .iter()
        .map(|settings| observe(&scene, settings, &render, 1, &progress).unwrap())
        .collect();
    let [fitted, _] = parted(&observations);
    let fit = fit(&fitted, &Term::of(&scene), Equation::Corrected).unwrap();
    let first = &observations[0];
    let times = TermTimes::of_fit(&fit, first.terms.rays);
    let counts = terms_of(&scene, &first.build).sum(None);
    let parts = times.parts(&counts);
    assert_eq!(parts.len(), fit.coefficients.len());
    let sum: f64 = parts.iter().map(|part| part.seconds()).sum();
    let predicted = fit.predict(&first.terms);
    assert!((sum / predicted - 1.0).abs() < 1e-9, "{sum} {predicted}");
    assert_eq!(counts.count(Term::Node), first.terms.nodes);
}
