//! What accuracy costs: the reference costs nothing, and every choice its due.

use crate::support::scenes::{scene, settings};
use bspscope::measure::accuracy::{Choice, KNOBS, Outcome, Trade, choices, reference, trade};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::setup::Setup;
use bspscope::trace::RenderSettings;

fn choices_of(scene: &Scene) -> Vec<Choice> {
    let render = RenderSettings {
        width: 64,
        height: 64,
        samples: 8,
        ..RenderSettings::default()
    };
    let setup = Setup {
        build: settings("sah-cut"),
        render,
        ..Setup::default()
    };
    choices(&reference(&setup), scene)
}

fn taken(name: &str) -> Trade {
    let scene = scene(name);
    trade(&scene, choices_of(&scene), 1, &Progress::new(), |_, _| ()).unwrap()
}

fn one<'a>(trade: &'a Trade, words: &str) -> &'a Outcome {
    let mut found = trade.outcomes.iter().filter(|o| o.choice.words() == words);
    found.next().unwrap_or_else(|| panic!("no choice {words}"))
}

#[test]
fn the_reference_has_no_error_and_choices_of_time_alone_neither() {
    let trade = taken("rings:2");
    let first = &trade.outcomes[0];
    assert_eq!(first.choice.words(), "reference");
    assert_eq!(trade.ratios(first)[1], 1.0);
    one(&trade, "kernel stream");
    let of_time = || trade.outcomes.iter().filter(|o| !o.choice.moves_image);
    assert!(of_time().count() > 5);
    for outcome in of_time() {
        let words = outcome.choice.words();
        assert_eq!(
            (outcome.wrong_hits, outcome.error.max),
            (0.0, 0.0),
            "{words}"
        );
    }
    let front = trade.front();
    for (outcome, front) in trade.outcomes.iter().zip(&front).skip(1) {
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
    let trade = taken("rings:2");
    let mut last = 0.0;
    for sides in [64, 20, 10, 6] {
        let outcome = one(&trade, &format!("cylinders polygons:{sides}"));
        assert!(outcome.wrong_hits >= last, "{sides}");
        last = outcome.wrong_hits;
    }
    let paper = one(&trade, "cylinders polygons:10");
    assert!(paper.wrong_hits > 0.0 && paper.error.rmse > 1e-3);
    let narrow = one(&trade, "precision f32");
    assert!(narrow.wrong_hits < 1e-3, "{}", narrow.wrong_hits);
    assert!(narrow.error.rmse > 0.0 && narrow.error.rmse < 0.1 * paper.error.rmse);
    let half = one(&trade, "resolution 32x32");
    assert!(half.wrong_hits > 0.01 && half.error.ssim < 1.0);
}

#[test]
fn fewer_secondary_rays_move_the_picture_where_there_are_any() {
    let mirrors = taken("balls:1");
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
fn a_trade_tells_as_it_goes_and_can_be_cancelled() {
    let scene = scene("tetra:2");
    let choices = choices_of(&scene);
    let count = choices.len();
    let mut told = Vec::new();
    let found = trade(
        &scene,
        choices.clone(),
        2,
        &Progress::new(),
        |place, outcome| {
            told.push((place, outcome.seconds.len()));
        },
    );
    let expected: Vec<_> = (1..=2)
        .flat_map(|n| (0..count).map(move |i| (i, n)))
        .collect();
    assert_eq!(told, expected);
    assert!(
        found
            .unwrap()
            .outcomes
            .iter()
            .all(|o| o.seconds.is_sorted())
    );

    let progress = Progress::new();
    let stopped = trade(&scene, choices, 2, &progress, |place, _| {
        if place == 3 {
            progress.cancel();
        }
    });
    assert!(stopped.unwrap_err().is_cancelled());
}
