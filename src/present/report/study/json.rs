//! The study as JSON.

use super::content::StudyReport;
use crate::measure::parameter;
use crate::measure::study::{Errors, Estimate, Judged, Outcome, Predictor, Score};
use crate::present::report::exact::exact_value;
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

/// Writes scores and structures as one JSON document. Times are in seconds, shares are fractions.
pub fn write(report: &StudyReport, out: &mut dyn Write) -> Result<()> {
    let document = json!({
        "processor": report.machine.processor,
        "version": report.machine.version,
        "date": report.date,
        "command": report.command,
        "scenes": report.outcomes.iter().map(scene).collect::<Vec<_>>(),
    });
    serde_json::to_writer_pretty(&mut *out, &document)?;
    writeln!(out)
}

fn scene(outcome: &Outcome) -> Value {
    json!({
        "scene": outcome.scene,
        "objects": outcome.objects,
        "precision": outcome.precision.name(),
        "rounds": outcome.rounds,
        "left_out": { "same": outcome.left_out.same, "refused": outcome.left_out.refused },
        "scores": outcome.judged.iter().map(judged).collect::<Vec<_>>(),
        "structures": structures(outcome),
    })
}

fn judged(judged: &Judged) -> Value {
    let misfit = judged.misfit.as_ref().map(|misfit| {
        let families = misfit.families.iter();
        let families: Map<_, _> = families
            .map(|(name, of_family)| ((*name).to_owned(), errors(of_family)))
            .collect();
        let (build, error) = &misfit.worst;
        let worst = json!({"method": build.method.name, "constants": build.constants, "error": error});
        json!({
            "worst": worst,
            "families": families,
            "missing": misfit.missing.map(|(symbol, rank)| json!({"symbol": symbol, "rank_correlation": rank})),
        })
    });
    json!({
        "kernel": judged.kernel.name(),
        "rays": judged.origin.name(),
        "count": judged.rays,
        "spread": judged.spread,
        "measures": judged.scores.iter().map(score).collect::<Vec<_>>(),
        "misfit": misfit,
    })
}

fn score(score: &Score) -> Value {
    json!({
        "measure": score.predictor.name(),
        "structures": score.count,
        "r_squared": estimate(&score.r_squared),
        "rank_correlation": estimate(&score.rank),
        "left_out": errors(&score.left_out),
        "alpha": score.alpha,
    })
}

fn estimate(estimate: &Estimate) -> Value {
    json!({"value": estimate.value, "low": estimate.low, "high": estimate.high})
}

fn errors(errors: &Errors) -> Value {
    json!({
        "structures": errors.count,
        "median": errors.median,
        "worst": errors.worst,
        "bias": errors.bias,
    })
}

/// Returns every structure with the measures of every set of rays and the times by kernel and round.
fn structures(outcome: &Outcome) -> Vec<Value> {
    let symbols = Predictor::ALL
        .iter()
        .filter_map(|predictor| match predictor {
            Predictor::Parameter(symbol) => Some(*symbol),
            _ => None,
        });
    let symbols: Vec<_> = symbols.chain(["EPO"]).collect();
    let per_set = outcome.judged.chunks(outcome.kernels.len());
    let origins: Vec<_> = per_set.map(|of_set| of_set[0].origin).collect();
    (outcome.observations.iter())
        .map(|observation| {
            let sets = origins.iter().zip(&observation.sets).map(|(origin, set)| {
                let measures: Map<_, _> = (symbols.iter())
                    .map(|s| ((*s).to_owned(), exact_value(parameter(s), &set.measurement)))
                    .collect();
                let kernels = outcome.kernels.iter().zip(&set.seconds);
                let seconds: Map<_, _> = kernels
                    .map(|(kernel, times)| (kernel.name().to_owned(), json!(times)))
                    .collect();
                json!({"rays": origin.name(), "measures": measures, "seconds": seconds})
            });
            let build = &observation.build;
            let applies = build.method.has_limits;
            json!({
                "method": build.method.name,
                "d_max": applies.then_some(build.d_max),
                "n_oilf": applies.then_some(build.n_oilf),
                "constants": build.constants,
                "sets": sets.collect::<Vec<_>>(),
            })
        })
        .collect()
}
