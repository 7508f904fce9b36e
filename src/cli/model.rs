//! `bspscope model`: the times of the paper's equation (1), by regression and in place.

use super::args::{ListFormat, ModelArgs};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::jobs::{FitTimeModel, Timed};
use crate::measure::model::{Fit, InPlace, Observation, Term, fastest, parted, trees};
use crate::present::number::{Digits, NO_VALUE, grouped};
use crate::present::report::grid::Grid;
use crate::scene::Scene;
use crate::trace::RenderSettings;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::sync::Arc;

/// What is found of a scene.
struct Found {
    scene: String,
    fit: Fit,
    in_place: InPlace,
    /// The tree with the least `T_TR`.
    fastest: Observation,
    trees: usize,
    /// Relative errors on the trees that were left out of the fit.
    errors: Vec<f64>,
}

pub fn run(args: &ModelArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let mut all = Vec::new();
    for source in &args.scenes {
        let setup = args.settings.setup(source)?;
        let scene = Arc::new(resolve::scene_in_view(&setup)?);
        // One thread: others would compete for caches and memory.
        let render = RenderSettings {
            threads: 1,
            ..setup.render
        };
        all.push(found(&scene, render, args)?);
    }
    output::write_to(args.output.as_deref(), |out| match args.format {
        ListFormat::Text => all.iter().try_for_each(|found| {
            grid(found).write_text(out)?;
            writeln!(out, "\n{}", accuracy(found))?;
            parts_grid(found).write_text(out)?;
            writeln!(out)?;
            found
                .fit
                .notes
                .iter()
                .try_for_each(|note| writeln!(out, "{note}"))
        }),
        ListFormat::Json => {
            let values: Vec<_> = all.iter().map(value).collect();
            serde_json::to_writer_pretty(&mut *out, &values)?;
            writeln!(out)
        }
    })?;
    Ok(Outcome::Done)
}

fn found(scene: &Arc<Scene>, render: RenderSettings, args: &ModelArgs) -> Result<Found> {
    ensure!(!scene.objects().is_empty(), "{}: no objects", scene.name());
    let job = FitTimeModel {
        scene: Arc::clone(scene),
        render,
        builds: trees(scene),
        rounds: args.rounds,
        equation: args.equation,
        in_place: None,
    };
    let (mut observations, mut in_place) = (Vec::new(), None);
    let fit = bar::follow(job, |timed| {
        match timed {
            Timed::InPlace(times) => in_place = Some(times),
            Timed::Tree(observation) => observations.push(observation),
        }
        Ok(())
    })?;
    let [fitted, left_out] = parted(&observations);
    Ok(Found {
        scene: scene.name().to_owned(),
        errors: fit.errors(&left_out),
        fit,
        in_place: in_place.context("nothing was timed in place")?,
        fastest: fastest(&observations).context("no tree was timed")?.clone(),
        trees: fitted.len(),
    })
}

/// All terms, those that the fit gave up, too.
fn terms(found: &Found) -> Vec<Term> {
    use crate::primitive::PrimitiveKind;
    let kinds = || {
        let is_there = |kind: &PrimitiveKind| {
            found.fit.seconds(Term::Miss(*kind)).is_some()
                || found.in_place.miss[*kind as usize].is_some()
        };
        PrimitiveKind::ALL.into_iter().filter(is_there)
    };
    [Term::Constant, Term::Node]
        .into_iter()
        .chain(kinds().map(Term::Miss))
        .chain(kinds().map(Term::Hit))
        .collect()
}

fn grid(found: &Found) -> Grid {
    let time = |seconds: Option<f64>| {
        seconds.map_or_else(|| NO_VALUE.to_owned(), |s| Digits::Three.seconds(s))
    };
    let node = found.in_place.node;
    let rows = terms(found).into_iter().map(|term| {
        let coefficient = found.fit.coefficients.iter().find(|c| c.term == term);
        let in_place = found.in_place.seconds(term);
        let to_node = in_place.zip(node).filter(|_| term != Term::Node);
        vec![
            term.name(),
            time(coefficient.map(|c| c.seconds)),
            time(coefficient.and_then(|c| c.half_width)),
            time(in_place),
            to_node.map_or(String::new(), |(time, node)| {
                Digits::Three.number(time / node)
            }),
        ]
    });
    Grid {
        title: format!(
            "{}: equation (1) as {}, {} trees",
            found.scene,
            found.fit.equation.name(),
            found.trees
        ),
        header: ["", "regression", "± 95 %", "in place", "to a node's"]
            .map(String::from)
            .to_vec(),
        rows: rows.collect(),
        first_number: 1,
    }
}

/// A term's part of the time of the fastest tree: how often it is spent, and seconds of all
/// together.
fn parts(found: &Found) -> Vec<(Term, f64, f64)> {
    let counts = &found.fastest.terms;
    let coefficients = found.fit.coefficients.iter();
    coefficients
        .map(|c| {
            let count = counts.count(c.term, found.fit.equation);
            (c.term, count, count * c.seconds)
        })
        .collect()
}

/// Where the time of the picture goes with the fastest tree.
fn parts_grid(found: &Found) -> Grid {
    let (build, measured) = (&found.fastest.build, found.fastest.seconds);
    let predicted = found.fit.predict(&found.fastest.terms);
    let rows = parts(found).into_iter().map(|(term, count, seconds)| {
        vec![
            term.name(),
            grouped(count),
            Digits::Four.seconds(seconds),
            Digits::Three.percent(seconds / predicted),
        ]
    });
    Grid {
        title: format!(
            "Where the time goes with {}, D_MAX {}, N_OILF {}: {} predicted, {} measured (T_TR), \
             {}",
            build.method.name,
            build.d_max,
            build.n_oilf,
            Digits::Four.seconds(predicted),
            Digits::Four.seconds(measured),
            Digits::Three.signed_percent(predicted / measured - 1.0)
        ),
        header: ["", "count", "time", "share"].map(String::from).to_vec(),
        rows: rows.collect(),
        first_number: 1,
    }
}

fn worst(found: &Found) -> f64 {
    found
        .errors
        .iter()
        .fold(0.0, |worst, error| error.abs().max(worst))
}

fn accuracy(found: &Found) -> String {
    format!(
        "R² {:.4}; T_TR of {} trees left out of the fit is predicted within {}. The paper: T_I \
         about T_T for spheres, three times T_T for triangles.",
        found.fit.r_squared,
        found.errors.len(),
        Digits::Three.percent(worst(found))
    )
}

fn value(found: &Found) -> Value {
    let times: Vec<_> = terms(found)
        .into_iter()
        .map(|term| {
            let coefficient = found.fit.coefficients.iter().find(|c| c.term == term);
            json!({
                "term": term.name(),
                "regression": coefficient.map(|c| c.seconds),
                "half_width_95": coefficient.and_then(|c| c.half_width),
                "in_place": found.in_place.seconds(term),
            })
        })
        .collect();
    let parts: Vec<_> = parts(found)
        .into_iter()
        .map(|(term, count, seconds)| {
            json!({"term": term.name(), "count": count as u64, "seconds": seconds})
        })
        .collect();
    json!({
        "scene": found.scene,
        "equation": found.fit.equation.name(),
        "trees": found.trees,
        "seconds": times,
        "r_squared": found.fit.r_squared,
        "fastest": {
            "method": found.fastest.build.method.name,
            "d_max": found.fastest.build.d_max.to_string(),
            "n_oilf": found.fastest.build.n_oilf,
            "seconds": found.fastest.seconds,
            "predicted": found.fit.predict(&found.fastest.terms),
            "parts": parts,
        },
        "left_out": { "trees": found.errors.len(), "errors": found.errors, "worst": worst(found) },
        "notes": found.fit.notes,
    })
}
