//! The study as a document in Markdown.

use super::content::StudyReport;
use super::words::{answer, conditions, estimate, paragraph};
use crate::measure::study::{Outcome, Predictor, RayOrigin, over_scenes};
use crate::present::number::NO_VALUE;
use crate::present::report::escape;
use crate::trace::KernelChoice;
use std::io::{Result, Write};

/// What is known from others, beside the results.
const LITERATURE: &str = "\
## What the literature found

T. Aila, T. Karras and S. Laine, *On quality metrics of bounding volume hierarchies* (High-Performance Graphics
2013), asked the same question for hierarchies on a graphics processor. They found that the relationship between SAH
cost and time is far from perfect, and that two more measures together with it explain the times almost completely:
the overlap at the ends of rays (EPO), and the deviation of the leaves that a ray visits (LCV), which stands for
the divergence of rays that are traced in SIMD. Hierarchies that are built from the root are faster than their SAH cost
indicates. Their weight α of EPO differs from scene to scene; a weight that is fitted to one scene need not suit
another.

Here, α is fitted per scene, kernel and set of rays; the tables that `--format text` prints have it. The structures
include trees with planes, whose EPO is 0, octrees and grids, so R² of C_SAH is that over all structures that have
inner nodes, and not comparable with theirs. Long random rays are what C_SAH was derived for: compare its R² for these
rays with those of the picture.

V. Havran and J. Žára, *Evaluation of BSP properties for ray-tracing*, give equation (1), the time as the sum of
counts, each multiplied by the time of one. They recommend the counts, because these are the same on every machine.
Here, the equation has a term for box tests, which their trees do not have, and its times are fitted to two thirds of
the structures at a time, to predict the others.
";

/// Writes the answer over all scenes, a paragraph and a figure per scene, and what the literature found.
pub fn write(report: &StudyReport, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "# Which measure predicts time?\n")?;
    writeln!(
        out,
        "This page is generated; see [the command](#the-command) at its end.\n"
    )?;
    writeln!(
        out,
        "Structures of {} are traced with sets of primary, shadow, reflected and random rays: kd-trees, octrees and \
         grids of all build methods with several depths and leaf sizes, and hierarchies of widths 2, 4 and 8. How well \
         does each measure predict the time? **R²** is the share of the differences between the logarithms of times that \
         the logarithm of the measure explains, from 0 to 1. Intervals hold 95 % of bootstrap samples. **Equation (1)** \
         predicts structures left out of its fit.\n",
        scenes(report)
    )?;
    writeln!(out, "{}", escape::markdown(&conditions(report)))?;
    if report.outcomes.len() > 1 {
        writeln!(out, "\n## The answer\n")?;
        for &kernel in &report.outcomes[0].kernels {
            if let Some(answer) = answer(&report.outcomes, kernel) {
                writeln!(out, "- {}", escape::markdown(&answer))?;
            }
        }
        for &kernel in &report.outcomes[0].kernels {
            over_all(report, kernel, out)?;
        }
    }
    for outcome in &report.outcomes {
        writeln!(out, "\n## {}\n", outcome.scene)?;
        writeln!(out, "{}", escape::markdown(&paragraph(outcome)))?;
        if let Some(folder) = &report.figures {
            let file = StudyReport::figure(outcome);
            writeln!(
                out,
                "\n![R² of each measure in {}]({folder}/{file})",
                outcome.scene
            )?;
        }
    }
    writeln!(out, "\n{LITERATURE}")?;
    writeln!(
        out,
        "## The command\n\n```sh\n{}\n```\n\n{}.",
        report.command, report.date
    )
}

fn scenes(report: &StudyReport) -> String {
    let names: Vec<_> = report
        .outcomes
        .iter()
        .map(|o| format!("*{}*", o.scene))
        .collect();
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

/// Writes the mean R² of every measure over the scenes.
fn over_all(report: &StudyReport, kernel: KernelChoice, out: &mut dyn Write) -> Result<()> {
    let has = |origin: &RayOrigin| {
        let is_there = |o: &Outcome| o.judged(*origin, kernel).is_some();
        report.outcomes.iter().any(is_there)
    };
    let origins: Vec<_> = RayOrigin::ALL.into_iter().filter(has).collect();
    let titles = origins.iter().map(|origin| format!(" {} |", origin.name()));
    writeln!(
        out,
        "\nMean R² over the scenes, kernel {}:\n\n| measure | |{}",
        kernel.name(),
        titles.collect::<String>()
    )?;
    writeln!(out, "|---|---|{}", "--:|".repeat(origins.len()))?;
    for predictor in Predictor::ALL {
        let cells = origins.iter().map(|&origin| {
            let found = over_scenes(&report.outcomes, origin, kernel, predictor);
            format!(
                " {} |",
                found.map_or(NO_VALUE.into(), |found| estimate(&found))
            )
        });
        writeln!(
            out,
            "| {} | {} |{}",
            escape::markdown(predictor.name()),
            predictor.about(),
            cells.collect::<String>()
        )?;
    }
    Ok(())
}
