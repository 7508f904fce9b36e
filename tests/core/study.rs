//! Which measure predicts time: the study at reduced size. Counts are checked, times are not.

use crate::support::scenes::scene;
use bspscope::measure::study::{
    KERNELS, Observation, Observing, Plan, Predictor, RayOrigin, RaySet, SCENES, judge,
};
use bspscope::measure::{Measurement, parameter, structures};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::Method;
use bspscope::structure::split::Structure;
use bspscope::trace::{KernelChoice, RayKind, RenderSettings};
use std::collections::BTreeSet;

/// One scene with reflected rays, and one without.
const SMALL: [&str; 2] = ["balls:2", "tetra:6"];

fn plan(scene: &Scene, threads: usize) -> Plan {
    Plan {
        render: RenderSettings {
            threads,
            ..RenderSettings::default()
        },
        builds: structures(scene),
        kernels: vec![KernelChoice::Scalar],
        rays: 64,
        rounds: 1,
    }
}

fn observe(scene: &Scene, threads: usize) -> (Vec<RaySet>, Vec<Observation>) {
    let progress = Progress::new();
    let mut observing = Observing::new(scene, plan(scene, threads), &progress).unwrap();
    while observing.upcoming().is_some() {
        observing.turn(&progress).unwrap();
    }
    let (sets, observations, left_out) = observing.into_result();
    assert_eq!(left_out.refused, [""; 0]);
    assert_eq!(observations.len() + left_out.same, structures(scene).len());
    (sets, observations)
}

#[test]
fn over_a_hundred_structures_of_all_kinds_are_compared() {
    for name in SMALL {
        let (_, observations) = observe(&scene(name), 1);
        assert!(observations.len() >= 100, "{name}: {}", observations.len());
        let all: BTreeSet<_> = observations.iter().map(|o| o.build.method.name).collect();
        let families: BTreeSet<_> = Method::all().map(|m| m.structure.family()).collect();
        let found: BTreeSet<_> = all
            .iter()
            .map(|m| Method::named(m).unwrap().structure.family())
            .collect();
        assert_eq!(found, families);
        let builds = observations.iter().map(|o| &o.build);
        let bvhs = builds.filter(|b| b.method.structure == Structure::Bvh);
        let widths: BTreeSet<_> = bvhs.map(|b| b.constant("width") as u32).collect();
        assert_eq!(widths, BTreeSet::from([2, 4, 8]));
    }
    let scene = scene("tetra:2");
    let all: BTreeSet<_> = structures(&scene).iter().map(|b| b.method.name).collect();
    assert_eq!(all.len(), Method::all().count() - 1);
    assert!(!all.contains("none"));
    assert!(SCENES.len() >= 8 && KERNELS.len() == 3);
}

#[test]
fn counts_are_the_same_in_every_run_and_hits_in_every_structure() {
    for name in SMALL {
        let scene = scene(name);
        let [(sets, observed), (other_sets, others)] =
            [1, 3].map(|threads| observe(&scene, threads));
        let origins: Vec<_> = sets.iter().map(|set| set.origin.name()).collect();
        let expected: &[_] = match name {
            "tetra:6" => &["primary", "shadow", "random"],
            _ => &["primary", "shadow", "reflected", "random"],
        };
        assert_eq!(origins, expected);
        for (set, other) in sets.iter().zip(&other_sets) {
            assert!((1..=64).contains(&set.rays.len()), "{}", set.rays.len());
            assert_eq!(set.rays, other.rays);
        }
        assert_eq!(observed.len(), others.len());
        for (a, b) in observed.iter().zip(&others) {
            assert_eq!(a.build, b.build);
            for (place, set) in sets.iter().enumerate() {
                let (a, b) = (&a.sets[place], &b.sets[place]);
                assert_eq!(a.terms, b.terms);
                assert_eq!(a.measurement.tree, b.measurement.tree);
                let kind = set.origin.kind();
                let of = |m: &Measurement| m.tally(kind).unwrap();
                let tally = of(&a.measurement);
                assert_eq!(tally, of(&b.measurement));
                // Both ways of counting agree.
                assert_eq!(a.terms.rays, tally.rays);
                assert_eq!(a.terms.nodes, tally.inner_nodes + tally.leaves);
                assert_eq!(a.terms.boxes, tally.box_tests);
                assert_eq!(a.terms.tests.iter().sum::<u64>(), tally.tests);
                let answers = match kind {
                    RayKind::Shadow => a.terms.blocked,
                    _ => a.terms.nearest,
                };
                assert_eq!(answers.iter().sum::<u64>(), tally.hits);
                assert_eq!(tally.hits, of(&observed[0].sets[place].measurement).hits);
                assert_eq!((a.seconds.len(), a.seconds[0].len()), (1, 1));
            }
        }
    }
}

/// Judges times that are made up from the counts.
fn judged_of(
    scene: &Scene,
    seconds: impl Fn(&Measurement, &bspscope::measure::model::Terms) -> f64,
) -> Vec<bspscope::measure::study::Judged> {
    let (sets, mut observations) = observe(scene, 1);
    for observation in &mut observations {
        for set in &mut observation.sets {
            set.seconds = vec![vec![seconds(&set.measurement, &set.terms)]];
        }
    }
    let judged = judge(scene, &sets, &observations, &[KernelChoice::Scalar]);
    assert_eq!(judged.len(), sets.len());
    judged
}

#[test]
fn a_measure_that_times_are_made_of_explains_them() {
    let scene = scene("balls:2");
    let bytes = |m: &Measurement| parameter("B_RAY").value(m).unwrap();
    for judged in judged_of(&scene, |m, _| 1e-9 * bytes(m).powf(0.7)) {
        let score = judged.score(Predictor::Parameter("B_RAY")).unwrap();
        assert!(
            score.r_squared.low > 1.0 - 1e-9 && score.rank.value > 1.0 - 1e-9,
            "{score:?}"
        );
        assert!(score.left_out.worst < 1e-9, "{score:?}");
        let best = judged.best(|p| p != Predictor::Equation).unwrap();
        assert_eq!(best.predictor, Predictor::Parameter("B_RAY"));
        let others = judged.score(Predictor::Parameter("C_SAH")).unwrap();
        assert!(others.r_squared.value < 0.99, "{others:?}");
        let interval = others.r_squared;
        assert!(interval.low < interval.value && interval.value < interval.high);
        assert!(
            judged
                .scores
                .iter()
                .all(|s| (0.0..=1.0).contains(&s.r_squared.value))
        );
    }
}

#[test]
fn equation_1_predicts_times_of_its_form_and_tells_what_is_missing() {
    let scene = scene("balls:2");
    let equation = |terms: &bspscope::measure::model::Terms| {
        let misses = terms.tests.iter().sum::<u64>() - terms.hits.iter().sum::<u64>();
        1e-6 + 1e-8 * terms.nodes as f64 + 3e-9 * terms.boxes as f64 + 2e-8 * misses as f64
    };
    for judged in judged_of(&scene, |_, terms| equation(terms)) {
        let score = judged.score(Predictor::Equation).unwrap();
        assert!(
            score.left_out.worst < 1e-3,
            "{:?}: {score:?}",
            judged.origin
        );
        assert!(score.r_squared.value > 0.999, "{score:?}");
    }
    let bytes = |m: &Measurement| parameter("M_TREE").value(m).unwrap();
    let judged = judged_of(&scene, |m, terms| equation(terms) * bytes(m).powf(0.2));
    let random = judged
        .iter()
        .find(|j| j.origin == RayOrigin::Random)
        .unwrap();
    let misfit = random.misfit.as_ref().unwrap();
    assert!(misfit.worst.1.abs() > 0.01, "{misfit:?}");
    assert!(!misfit.families.is_empty());
    let (symbol, rank) = misfit.missing.unwrap();
    assert!(symbol == "M_TREE" && rank > 0.5, "{misfit:?}");
}
