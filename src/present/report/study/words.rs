//! The study in sentences.

use super::content::StudyReport;
use crate::measure::study::{
    Errors, Estimate, Judged, Misfit, Outcome, Predictor, RayOrigin, over_scenes,
};
use crate::present::number::{Digits, counted, grouped};
use crate::trace::KernelChoice;

/// The largest error of equation (1) that needs no explanation.
const GOAL: f64 = 0.10;

/// Rounds that differ by more than this are those of a machine that does other work.
const QUIET: f64 = 0.05;

/// Formats a figure with its interval, such as `0.92 (0.88 to 0.95)`.
pub fn estimate(estimate: &Estimate) -> String {
    let [value, low, high] = [estimate.value, estimate.low, estimate.high].map(two_digits);
    format!("{value} ({low} to {high})")
}

/// Formats a correlation with two decimals and a real minus sign.
fn two_digits(value: f64) -> String {
    format!("{value:.2}").replace('-', "−")
}

fn percent(share: f64) -> String {
    Digits::Three.percent(share)
}

/// Returns how the times were measured, and how far they can be trusted.
pub fn conditions(report: &StudyReport) -> String {
    let judged = || report.outcomes.iter().flat_map(|o| &o.judged);
    let rays = judged().map(|j| j.rays).max().unwrap_or(0);
    let rounds = report.outcomes.iter().map(|o| o.rounds).max().unwrap_or(0);
    let mut spreads: Vec<f64> = judged().map(|j| j.spread).collect();
    spreads.sort_by(f64::total_cmp);
    let spread = spreads.get(spreads.len() / 2).copied().unwrap_or(0.0);
    let mut text = format!(
        "Measured on {} ({}), on one thread, with up to {} rays per set. A time is the CPU time of tracing a set, \
         without making and shading rays: the median of {} in which all structures take turns.",
        report.machine.processor,
        report.machine.version,
        grouped(rays as f64),
        counted(rounds, "round")
    );
    if rounds > 1 {
        text += &format!(
            " The times of a structure typically differ by {} from round to round.",
            percent(spread)
        );
    }
    if spread > QUIET {
        text += " So the machine was busy with other work, and this noise is part of all errors and lowers all R²: repeat the \
                 study on a machine that does nothing else.";
    }
    text
}

/// Returns what is found of a scene, as one paragraph: in full for the first kernel, and in short for the others.
pub fn paragraph(outcome: &Outcome) -> String {
    let mut text = format!(
        "{} has {}. {} were measured in {}",
        outcome.scene,
        counted(outcome.objects, "object"),
        counted(outcome.observations.len(), "structure"),
        outcome.precision.name()
    );
    if outcome.left_out.same > 0 {
        text += &format!(
            "; {} are the same trees as others",
            grouped(outcome.left_out.same as f64)
        );
    }
    if !outcome.left_out.refused.is_empty() {
        text += &format!("; {} could not be built", outcome.left_out.refused.len());
    }
    text += ".";
    for (place, &kernel) in outcome.kernels.iter().enumerate() {
        let judged = outcome.judged.iter().filter(|j| j.kernel == kernel);
        let judged: Vec<_> = judged.collect();
        let sentences = match place {
            0 => [
                statics(kernel, &judged),
                dynamics(&judged),
                equation(&judged),
            ],
            _ => [in_short(kernel, &judged), None, None],
        };
        for sentence in sentences.into_iter().flatten() {
            text += " ";
            text += &sentence;
        }
    }
    text
}

/// Returns what is found with a kernel over all scenes, as one sentence.
pub fn answer(outcomes: &[Outcome], kernel: KernelChoice) -> Option<String> {
    let mean = |predictor: Predictor| {
        let origins = RayOrigin::ALL.into_iter();
        let values = origins.filter_map(|o| over_scenes(outcomes, o, kernel, predictor));
        let values: Vec<f64> = values.map(|found| found.value).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    let best = |is_among: fn(Predictor) -> bool| {
        let among = Predictor::ALL.into_iter().filter(|p| is_among(*p));
        let found = among.filter_map(|p| Some((p.name(), mean(p)?)));
        found.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let statics = best(|p| p.is_static())?;
    let counts = best(is_count)?;
    let judged = || {
        let all = outcomes.iter().flat_map(|o| &o.judged);
        let all = all.filter(|j| j.kernel == kernel);
        all.filter_map(|j| Some(j.score(Predictor::Equation)?.left_out))
    };
    Some(format!(
        "With the {} kernel, the mean R² over scenes and kinds of rays is {} for the best of what is known before rays are \
         traced, {}; {} for the best count of rays, {}; and {} for equation (1), on structures left out of its fit. The \
         equation is typically off by at most 10 % for {} of {} combinations of scene and rays, and at worst by at most \
         10 % for {} of them.",
        kernel.name(),
        two_digits(statics.1),
        statics.0,
        two_digits(counts.1),
        counts.0,
        two_digits(mean(Predictor::Equation)?),
        judged().filter(|errors| errors.median <= GOAL).count(),
        judged().count(),
        judged().filter(|errors| errors.worst <= GOAL).count()
    ))
}

/// Returns whether a predictor is a count of rays in a structure.
fn is_count(predictor: Predictor) -> bool {
    !predictor.is_static() && predictor != Predictor::Equation
}

/// Returns a list such as `0.42 for primary, 0.30 for shadow and 0.80 for random rays`; `None` without entries.
fn per_set(values: &[(RayOrigin, String)]) -> Option<String> {
    let each: Vec<_> = (values.iter())
        .map(|(origin, value)| format!("{value} for {}", origin.name()))
        .collect();
    let (last, others) = each.split_last()?;
    Some(match others {
        [] => format!("{last} rays"),
        _ => format!("{} and {last} rays", others.join(", ")),
    })
}

fn of_each(judged: &[&Judged], value: impl Fn(&Judged) -> Option<String>) -> Option<String> {
    let values = judged.iter().filter_map(|j| Some((j.origin, value(j)?)));
    per_set(&values.collect::<Vec<_>>())
}

/// Returns what the structure alone tells.
fn statics(kernel: KernelChoice, judged: &[&Judged]) -> Option<String> {
    let r_squared = |predictor| {
        of_each(judged, |j| {
            Some(two_digits(j.score(predictor)?.r_squared.value))
        })
    };
    let sah = r_squared(Predictor::Parameter("C_SAH"))?;
    let with_epo = r_squared(Predictor::SahAndEpo)?;
    Some(format!(
        "With the {} kernel, R² of C_SAH is {sah}; with EPO, it is {with_epo}.",
        kernel.name()
    ))
}

/// Returns which count of rays explains most.
fn dynamics(judged: &[&Judged]) -> Option<String> {
    let best = of_each(judged, |j| {
        let best = j.best(is_count)?;
        let value = two_digits(best.r_squared.value);
        Some(format!("{} ({value})", best.predictor.name()))
    })?;
    Some(format!("Of the counts of rays, the best is {best}."))
}

fn errors(judged: &Judged) -> Option<Errors> {
    Some(judged.score(Predictor::Equation)?.left_out)
}

/// Returns how far equation (1) is off, and what it lacks.
fn equation(judged: &[&Judged]) -> Option<String> {
    let each = of_each(judged, |j| {
        let Errors { median, worst, .. } = errors(j)?;
        Some(format!("{} (at worst {})", percent(median), percent(worst)))
    })?;
    let mut text =
        format!("For structures left out of its fit, equation (1) is typically off by {each}.");
    let off = |j: &Judged| errors(j).map_or(0.0, |errors| errors.worst);
    let worst = judged.iter().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    if off(worst) <= GOAL {
        text += " So it predicts all of them within 10 %.";
    } else if let Some(misfit) = &worst.misfit {
        text += &explanation(worst, misfit);
    }
    Some(text)
}

/// Returns where the equation is off most, and which term is missing.
fn explanation(judged: &Judged, misfit: &Misfit) -> String {
    let (build, error) = &misfit.worst;
    let how = if *error > 0.0 { "high" } else { "low" };
    let mut text = format!(
        " It is off most for {} with {} rays, {} too {how}.",
        build.in_words(),
        judged.origin.name(),
        percent(error.abs())
    );
    if let Some((symbol, rank)) = misfit.missing {
        text += &format!(
            " What is missing goes most with {symbol} (rank correlation with measured / predicted: {}): a term for {}.",
            two_digits(rank),
            meaning(symbol)
        );
    }
    text
}

/// Returns the same for a further kernel in one sentence.
fn in_short(kernel: KernelChoice, judged: &[&Judged]) -> Option<String> {
    let with_epo = of_each(judged, |j| {
        Some(two_digits(j.score(Predictor::SahAndEpo)?.r_squared.value))
    })?;
    let all = || judged.iter().filter_map(|j| errors(j));
    let typical = all().map(|errors| errors.median).fold(0.0, f64::max);
    let worst = all().map(|errors| errors.worst).fold(0.0, f64::max);
    Some(format!(
        "With the {} kernel, R² of C_SAH with EPO is {with_epo}, and equation (1) is typically off by at most {} for a kind \
         of rays, at worst by {}.",
        kernel.name(),
        percent(typical),
        percent(worst)
    ))
}

/// Returns what a missing term would stand for.
fn meaning(symbol: &str) -> &'static str {
    match symbol {
        "N_VLS" => "what a visited leaf costs beside its tests",
        "N_AOIFL" => {
            "the length of leaves, as a test in a long leaf does not take as long as one in a short leaf"
        }
        "N_CULL" => "pending nodes that are skipped",
        "B_RAY" => "memory that is read",
        "LCV" => "divergence of rays: mispredicted branches and idle lanes",
        _ => "trees that are too large for the caches",
    }
}
