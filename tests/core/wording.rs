//! Every text that the registries show to users is in plain English.

use crate::support::wording::{assert_plain, rejected};
use bspscope::lesson::{Answer, LESSONS};
use bspscope::measure::accuracy::ERROR_MEASURES;
use bspscope::measure::heat::heatmaps;
use bspscope::measure::{COUNTERS, Table, parameters, ray_figures};
use bspscope::present::overlay::{COLORINGS, COLORMAPS, HISTOGRAMS};
use bspscope::present::report::WRITERS;
use bspscope::scene::builtin::BUILTINS;
use bspscope::setup::{Kind, SETTINGS};
use bspscope::structure::{Method, StopReason};

#[test]
fn replaced_words_are_rejected_as_whole_words() {
    for text in [
        "Nodes a ray",
        "a walk",
        "Ready",
        "Forms: .png",
        "D_MAX",
        "the  CENTRE",
    ] {
        assert!(rejected(text).is_some(), "{text}");
    }
    for text in [
        "Nodes per ray",
        "sidewalk",
        "ready to use",
        "Depth  D_MAX",
        "formsheet",
    ] {
        assert_eq!(rejected(text), None, "{text}");
    }
}

#[test]
fn settings_and_methods() {
    let mut texts = Vec::new();
    for setting in SETTINGS {
        texts.extend(
            [setting.label, setting.about, setting.group.title()]
                .map(|t| (setting.name, t.to_owned())),
        );
        if let Kind::Choice(choices) = setting.kind {
            texts.extend(choices().iter().map(|c| (setting.name, c.about.to_owned())));
        }
    }
    for method in Method::all() {
        let own = [method.name, method.summary, method.about];
        texts.extend(own.map(|t| (method.name, t.to_owned())));
        for constant in method.constants {
            let own = [constant.about, constant.unit, constant.source];
            texts.extend(own.map(|t| (method.name, t.to_owned())));
        }
    }
    texts.extend(StopReason::ALL.map(|reason| ("reason", reason.text().to_owned())));
    assert_plain(texts);
}

#[test]
fn counters_and_their_views() {
    let mut texts = Vec::new();
    for counter in COUNTERS {
        texts.extend([counter.name, counter.meaning].map(|t| (counter.symbol, t.to_owned())));
    }
    for parameter in parameters() {
        texts.extend([parameter.name, parameter.meaning].map(|t| (parameter.symbol, t.to_owned())));
    }
    for heatmap in heatmaps() {
        texts.extend(
            [heatmap.name, heatmap.unit, heatmap.meaning].map(|t| (heatmap.symbol, t.to_owned())),
        );
    }
    for figure in ray_figures() {
        texts.extend([&figure.name, &figure.meaning].map(|t| ("figure", t.clone())));
    }
    for table in [Table::Scene, Table::Static, Table::Dynamic, Table::Ours] {
        texts.push(("table", table.title().to_owned()));
    }
    for measure in ERROR_MEASURES {
        texts.extend([measure.name, measure.about].map(|t| ("measure", t.to_owned())));
    }
    assert_plain(texts);
}

#[test]
fn overlays_formats_and_generators() {
    let mut texts = Vec::new();
    for coloring in COLORINGS {
        texts.extend([coloring.title, coloring.unit].map(|t| (coloring.name, t)));
    }
    for histogram in &HISTOGRAMS {
        let axis = &histogram.axis;
        texts.extend([axis.title, axis.unit, axis.counted].map(|t| (histogram.name, t)));
    }
    texts.extend(COLORMAPS.iter().map(|c| (c.name, c.about)));
    texts.extend(WRITERS.iter().map(|w| (w.name, w.about)));
    texts.extend(BUILTINS.iter().map(|b| (b.name, b.about)));
    assert_plain(texts);
}

#[test]
fn lessons() {
    let mut texts = Vec::new();
    for known in LESSONS {
        let lesson = known.read();
        texts.extend([&lesson.title, &lesson.about].map(|t| (known.name, t.clone())));
        for step in &lesson.steps {
            texts.push((known.name, step.title.clone()));
            texts.extend([&step.before, &step.after].map(|p| (known.name, p.fill(None))));
            if let Some(question) = &step.question {
                texts.push((known.name, question.ask.clone()));
                if let Answer::Choice(choices) = &question.answer {
                    texts.extend(choices.iter().map(|c| (known.name, c.text.clone())));
                }
            }
        }
    }
    assert_plain(texts);
}

/// A setting and the parameter with its symbol have one name.
#[test]
fn settings_and_parameters_share_their_names() {
    let mut shared = 0;
    for setting in SETTINGS {
        let Some(symbol) = setting.symbol else {
            continue;
        };
        let parameter = parameters().iter().find(|p| p.symbol == symbol);
        assert_eq!(parameter.expect(symbol).name, setting.label.to_lowercase());
        shared += 1;
    }
    assert_eq!(shared, 3);
}
