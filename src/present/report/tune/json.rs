//! The search as JSON: the paper's symbols as keys, times in seconds.

use super::content::TuneReport;
use super::words::{command, left_out, recommendation};
use crate::measure::parameter;
use crate::measure::tune::{Rank, Row};
use crate::present::report::exact::exact_value;
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

/// The parameters of every candidate.
const PARAMETERS: [&str; 9] = [
    "N_RPRT",
    "N_AT",
    "N_LS",
    "N_RO",
    "D_REACH",
    "T_TR",
    "T_CB",
    "T_CB_WALL",
    "M_TREE",
];

/// Writes the search as one JSON document. Candidates are in the order of the ranking.
pub fn write(report: &TuneReport, out: &mut dyn Write) -> Result<()> {
    let tuned = &report.tuned;
    let (place, recommended) = tuned.recommended();
    let applies = recommended.setup.build.method.has_limits;
    let ranking = tuned.ranking();
    let candidates: Vec<_> = ranking
        .iter()
        .map(|rank| {
            let is_recommended = rank.place == place;
            candidate(
                rank,
                &tuned.rows[rank.place],
                is_recommended,
                tuned.search.rays,
            )
        })
        .collect();
    let render = &tuned.render;
    let document = json!({
        "scene": report.scene,
        "for": tuned.search.goal.name(),
        "resolution": [render.width, render.height],
        "d_arec": render.d_arec,
        "precision": tuned.rows[0].measurement.precision.precision.name(),
        "kernel": render.kernel.description(),
        "threads": tuned.rows[0].measurement.building.threads,
        "rays": tuned.search.rays,
        "most_bytes": tuned.search.most_bytes,
        "budget": tuned.search.budget.as_secs_f64(),
        "spent": tuned.spent.as_secs_f64(),
        "candidates": candidates,
        "recommended": {
            "method": recommended.setup.build.method.name,
            "d_max": applies.then_some(recommended.setup.build.d_max),
            "n_oilf": applies.then_some(recommended.setup.build.n_oilf),
            "constants": recommended.setup.build.constants,
            "reason": recommendation(tuned),
            "command": command(recommended),
        },
        "left_out": left_out(tuned),
    });
    serde_json::to_writer_pretty(&mut *out, &document)?;
    writeln!(out)
}

fn candidate(rank: &Rank, row: &Row, is_recommended: bool, rays: Option<u64>) -> Value {
    let (build, spread) = (&row.setup.build, row.spread());
    let parameters: Map<_, _> = PARAMETERS
        .into_iter()
        .map(|symbol| {
            let value = exact_value(parameter(symbol), &row.measurement);
            (symbol.into(), value)
        })
        .collect();
    let applies = build.method.has_limits;
    json!({
        "rank": rank.rank,
        "tied": rank.is_tied,
        "recommended": is_recommended,
        "rung": row.rung,
        "method": build.method.name,
        "d_max": applies.then_some(build.d_max),
        "depth_limit": applies.then_some(row.measurement.depth_limit),
        "n_oilf": applies.then_some(build.n_oilf),
        "constants": build.constants,
        "seconds": row.seconds(),
        "time": {"least": spread.least, "median": spread.median, "most": spread.most},
        "build_and_rays": rays.map(|rays| {
            let total = row.spread_with_build(rays);
            json!({"least": total.least, "median": total.median, "most": total.most})
        }),
        "tests_per_ray": row.tests_per_ray(),
        "nodes": row.nodes(),
        "parameters": parameters,
        "command": command(row),
    })
}
