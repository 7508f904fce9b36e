//! What accuracy costs: the reference costs nothing, and every choice its due.

use crate::support::scenes::{scene, settings};
use bspscope::jobs::{End, Handle, Measured, News, Scheduler, StudyAccuracy};
use bspscope::measure::accuracy::{
    AccuracyStudy, Choice, KNOBS, Knob, Outcome, choices, reference,
};
use bspscope::scene::Scene;
use bspscope::setup::Setup;
use bspscope::trace::RenderSettings;
use std::sync::Arc;
use std::time::Duration;

fn setup() -> Setup {
    let render = RenderSettings {
        width: 64,
        height: 64,
        samples: 8,
        ..RenderSettings::default()
    };
    Setup {
        build: settings("sah-cut"),
        render,
        ..Setup::default()
    }
}

fn choices_of(scene: &Scene) -> Vec<Choice> {
    choices(&reference(&setup()), scene)
}

fn job(name: &str, rounds: u32, only: Vec<&'static Knob>) -> StudyAccuracy {
    StudyAccuracy {
        scene: Arc::new(scene(name)),
        setup: setup(),
        rounds,
        only,
    }
}

/// What a study sends until its end.
fn until_end(study: &Handle<StudyAccuracy>) -> (Vec<Measured>, End<AccuracyStudy>) {
    while !study.wait(Duration::from_secs(1)) {}
    let News { partials, end } = study.receive();
    (partials, end.expect("it has ended"))
}

fn study(name: &str) -> AccuracyStudy {
    let scheduler = Scheduler::new(|| ());
    match until_end(&scheduler.start(job(name, 1, Vec::new()))).1 {
        End::Done(study) => study,
        end => panic!("{end:?}"),
    }
}

fn one<'a>(study: &'a AccuracyStudy, words: &str) -> &'a Outcome {
    let mut found = study.outcomes.iter().filter(|o| o.choice.words() == words);
    found.next().unwrap_or_else(|| panic!("no choice {words}"))
}

#[test]
fn the_reference_has_no_error_and_choices_of_time_alone_neither() {
    let found = study("rings:2");
    let first = &found.outcomes[0];
    assert_eq!(first.choice.words(), "reference");
    assert_eq!(found.ratios(first)[1], 1.0);
    one(&found, "kernel stream");
    let of_time = || found.outcomes.iter().filter(|o| !o.choice.moves_image);
    assert!(of_time().count() > 5);
    for outcome in of_time() {
        let words = outcome.choice.words();
        assert_eq!(
            (outcome.wrong_hits, outcome.error.max),
            (0.0, 0.0),
            "{words}"
        );
    }
    let front = found.front();
    for (outcome, front) in found.outcomes.iter().zip(&front).skip(1) {
        assert!(
            outcome.choice.moves_image || !front,
            "{}",
            outcome.choice.words()
        );
    }
    assert!(front.iter().any(|&front| front));
}

#[test]
fn polygons_for_cylinders_are_wrong_and_f32_hardly_ever_is() {
    let found = study("rings:2");
    let mut last = 0.0;
    for sides in [64, 20, 10, 6] {
        let outcome = one(&found, &format!("cylinders polygons:{sides}"));
        assert!(outcome.wrong_hits >= last, "{sides}");
        last = outcome.wrong_hits;
    }
    let paper = one(&found, "cylinders polygons:10");
    assert!(paper.wrong_hits > 0.0 && paper.error.rmse > 1e-3);
    let narrow = one(&found, "precision f32");
    assert!(narrow.wrong_hits < 1e-3, "{}", narrow.wrong_hits);
    assert!(narrow.error.rmse > 0.0 && narrow.error.rmse < 0.1 * paper.error.rmse);
    let half = one(&found, "resolution 32x32");
    assert!(half.wrong_hits > 0.01 && half.error.ssim < 1.0);
}

#[test]
fn fewer_secondary_rays_move_the_picture_where_there_are_any() {
    let mirrors = study("balls:1");
    let errors = [4, 2, 1, 0].map(|depth| one(&mirrors, &format!("D_AREC {depth}")).error.rmse);
    assert!(errors.is_sorted() && errors[3] > 0.0, "{errors:?}");
    let errors = ["0.01", "0.05", "0.2"].map(|w| {
        one(&mirrors, &format!("minimum contribution {w}"))
            .error
            .rmse
    });
    assert!(errors.is_sorted() && errors[2] > 0.0, "{errors:?}");
    let dull = scene("tetra:2");
    for choice in choices_of(&dull) {
        for (knob, _) in choice.turned {
            assert!(
                !["D_AREC", "minimum contribution", "cylinders"].contains(&knob.as_str()),
                "{knob}"
            );
        }
    }
}

#[test]
fn every_knob_is_turned_alone_and_those_of_the_picture_together() {
    let choices = choices_of(&scene("rings:1"));
    for knob in KNOBS {
        let alone = choices.iter().filter(|c| c.turned.len() == 1);
        assert!(
            alone.into_iter().any(|c| c.turned[0].0 == knob.name()),
            "{}",
            knob.name()
        );
    }
    let last = choices.last().unwrap();
    let turned: Vec<_> = last.turned.iter().map(|(knob, _)| knob.clone()).collect();
    // Without secondary rays there is nothing left to cut off.
    let expected: Vec<_> = KNOBS
        .iter()
        .filter(|k| k.moves_image() && k.name() != "minimum contribution")
        .map(|k| k.name())
        .collect();
    assert_eq!(turned, expected);
    let changed = |c: &Choice| c.turned.is_empty() || c.setup != choices[0].setup;
    assert!(choices.iter().all(changed));
}

#[test]
fn a_study_sends_every_turn_and_can_be_cancelled() {
    let scheduler = Scheduler::new(|| ());
    let count = choices_of(&scene("tetra:2")).len();
    let (sent, end) = until_end(&scheduler.start(job("tetra:2", 2, Vec::new())));
    let expected: Vec<_> = (1..=2)
        .flat_map(|n| (0..count).map(move |i| (i, n)))
        .collect();
    let turns = sent.iter().map(|m| (m.place, m.outcome.seconds.len()));
    assert_eq!(turns.collect::<Vec<_>>(), expected);
    assert!(sent.iter().all(|m| m.steps == 2 * count));
    let End::Done(found) = end else {
        panic!("{end:?}")
    };
    assert_eq!(found.outcomes.len(), count);
    assert!(found.outcomes.iter().all(|o| o.seconds.is_sorted()));

    let stopped = scheduler.start(job("tetra:2", 1_000_000, Vec::new()));
    while stopped.receive().partials.is_empty() {
        std::thread::yield_now();
    }
    stopped.cancel();
    assert_eq!(until_end(&stopped).1, End::Cancelled);
    assert!(scheduler.wait());
}

#[test]
fn a_study_of_some_knobs_varies_only_these_alone() {
    let scheduler = Scheduler::new(|| ());
    let only = KNOBS.iter().filter(|k| k.name() == "precision").collect();
    let (_, end) = until_end(&scheduler.start(job("tetra:2", 1, only)));
    let End::Done(found) = end else {
        panic!("{end:?}")
    };
    let words: Vec<_> = found.outcomes.iter().map(|o| o.choice.words()).collect();
    assert_eq!(words, ["reference", "precision f32"]);
}
