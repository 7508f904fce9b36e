//! The search as CSV: one line per candidate, in the order of the ranking.

use super::content::TuneReport;
use std::io::{Result, Write};

/// Writes one line per candidate. `T_BUILD_AND_RAYS` is the time of building once and
/// tracing the rays that were asked for, else empty. `rounds` tells how often each was timed. `constants` are the
/// settings of the method that are not at their defaults, as `--set` takes them, separated by spaces.
pub fn write(report: &TuneReport, out: &mut dyn Write) -> Result<()> {
    let tuned = &report.tuned;
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "scene",
        "rank",
        "tied",
        "recommended",
        "method",
        "d_max",
        "depth_limit",
        "n_oilf",
        "rounds",
        "T_TR",
        "T_TR_least",
        "T_TR_most",
        "tests_per_ray",
        "nodes",
        "T_CB",
        "M_TREE",
        "T_BUILD_AND_RAYS",
        "constants",
    ])?;
    let (recommended, _) = tuned.recommended();
    for rank in tuned.ranking() {
        let row = &tuned.rows[rank.place];
        let (build, spread) = (&row.setup.build, row.spread());
        let limit = |text: String| {
            if build.method.has_limits {
                text
            } else {
                String::new()
            }
        };
        csv.write_record([
            report.scene.clone(),
            rank.rank.to_string(),
            rank.is_tied.to_string(),
            (rank.place == recommended).to_string(),
            build.method.name.into(),
            limit(build.d_max.to_string()),
            limit(row.measurement.depth_limit.to_string()),
            limit(build.n_oilf.to_string()),
            row.rounds().to_string(),
            spread.median.to_string(),
            spread.least.to_string(),
            spread.most.to_string(),
            row.tests_per_ray().map_or(String::new(), |t| t.to_string()),
            row.nodes().to_string(),
            row.measurement.building.cpu.as_secs_f64().to_string(),
            row.bytes().to_string(),
            (tuned.search.rays).map_or(String::new(), |rays| {
                row.spread_with_build(rays).median.to_string()
            }),
            (build.constants.iter())
                .map(|(name, value)| format!("{name}={value}"))
                .collect::<Vec<_>>()
                .join(" "),
        ])?;
    }
    csv.flush()
}
