//! `bspscope model`: the times of the paper's equation (1), by regression and in place.

use super::args::{ListFormat, ModelArgs};
use super::{Outcome, bar, output, resolve};
use crate::measure::model::{
    Equation, Fit, InPlace, Term, fit, observe, parted, time_in_place, trees,
};
use crate::report::grid::Grid;
use crate::scene::Scene;
use crate::trace::RenderSettings;
use anyhow::{Result, ensure};
use serde_json::{Value, json};

/// What is found of a scene.
struct Found {
    scene: String,
    fit: Fit,
    in_place: InPlace,
    trees: usize,
    /// Relative errors on the trees that were left out of the fit.
    errors: Vec<f64>,
}

pub fn run(args: &ModelArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let mut all = Vec::new();
    for source in &args.scenes {
        let (_, scene) = resolve::scene(source, &args.cylinders)?;
        let [width, height] = args.resolution;
        // One thread: others would compete for caches and memory.
        let render = RenderSettings {
            width,
            height,
            threads: 1,
            ..RenderSettings::for_camera(*scene.camera())
        };
        render.view()?;
        all.push(found(&scene, &render, args.rounds, args.equation)?);
    }
    output::write_to(args.output.as_deref(), |out| match args.format {
        ListFormat::Text => all.iter().try_for_each(|found| {
            grid(found).write_text(out)?;
            writeln!(out, "\n{}", accuracy(found))?;
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

fn found(scene: &Scene, render: &RenderSettings, rounds: u32, equation: Equation) -> Result<Found> {
    ensure!(!scene.objects().is_empty(), "{}: no objects", scene.name());
    let mut observations = Vec::new();
    let trees = trees(scene);
    for (i, build) in trees.iter().enumerate() {
        let stage = format!("{}: tree {} of {}", scene.name(), i + 1, trees.len());
        observations.push(bar::with_bar(&stage, |progress| {
            observe(scene, build, render, rounds, progress)
        })?);
    }
    let [fitted, left_out] = parted(&observations);
    let fit = fit(&fitted, &Term::of(scene), equation)?;
    let fastest = observations
        .iter()
        .min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let fastest = fastest.map_or(&trees[0], |observation| &observation.build);
    let stage = format!("{}: timing in place", scene.name());
    let in_place = bar::with_bar(&stage, |progress| {
        time_in_place(scene, fastest, render, progress)
    })?;
    Ok(Found {
        scene: scene.name().to_owned(),
        errors: fit.errors(&left_out),
        fit,
        in_place,
        trees: fitted.len(),
    })
}

fn measured(in_place: &InPlace, term: Term) -> Option<f64> {
    match term {
        Term::Node => in_place.node,
        Term::Hit(kind) => in_place.hit[kind as usize],
        Term::Miss(kind) => in_place.miss[kind as usize],
        Term::Constant => None,
    }
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
    let nanoseconds = |seconds: Option<f64>| match seconds {
        Some(seconds) => format!("{:.1}", seconds * 1e9),
        None => "–".to_owned(),
    };
    let node = found.in_place.node;
    let rows = terms(found).into_iter().map(|term| {
        let coefficient = found.fit.coefficients.iter().find(|c| c.term == term);
        let in_place = measured(&found.in_place, term);
        let to_node = in_place.zip(node).filter(|_| term != Term::Node);
        vec![
            term.name(),
            nanoseconds(coefficient.map(|c| c.seconds)),
            nanoseconds(coefficient.and_then(|c| c.half_width)),
            nanoseconds(in_place),
            to_node.map_or(String::new(), |(time, node)| format!("{:.2}", time / node)),
        ]
    });
    Grid {
        title: format!(
            "{}: equation (1) as {}, {} trees; times in ns",
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

fn worst(found: &Found) -> f64 {
    found
        .errors
        .iter()
        .fold(0.0, |worst, error| error.abs().max(worst))
}

fn accuracy(found: &Found) -> String {
    format!(
        "R² {:.4}; T_TR of {} trees left out of the fit is predicted within {:.1} %. The paper: T_I \
         about T_T for spheres, three times T_T for triangles.",
        found.fit.r_squared,
        found.errors.len(),
        worst(found) * 100.0
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
                "in_place": measured(&found.in_place, term),
            })
        })
        .collect();
    json!({
        "scene": found.scene,
        "equation": found.fit.equation.name(),
        "trees": found.trees,
        "seconds": times,
        "r_squared": found.fit.r_squared,
        "left_out": { "trees": found.errors.len(), "errors": found.errors, "worst": worst(found) },
        "notes": found.fit.notes,
    })
}
