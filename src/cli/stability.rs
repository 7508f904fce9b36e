//! `bspscope stability`: tests trees with extreme inputs.

use super::args::{ListFormat, StabilityArgs};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::stability::{self, Cell};
use crate::present::number::counted;
use crate::present::report::plain_table;
use crate::trace::thread_pool;
use anyhow::Result;
use std::io::{self, Write};

pub fn run(args: &StabilityArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let setup = args
        .settings
        .setup(args.scene.as_deref().unwrap_or_default())?;
    let scene = match &args.scene {
        Some(_) => Some(resolve::scene(&setup.scene)?),
        None => None,
    };
    let methods = args.settings.methods();
    let pool = thread_pool(setup.render.threads)?;
    let cells = bar::with_bar("running extreme cases", |progress| {
        stability::run(scene.as_ref(), &methods, args.quick, &pool, progress)
    })?;
    output::write_to(args.output.as_deref(), |out| match args.format {
        ListFormat::Text => text(&cells, out),
        ListFormat::Json => {
            serde_json::to_writer_pretty(&mut *out, &cells)?;
            writeln!(out)
        }
    })?;
    Ok(if failures(&cells) == 0 {
        Outcome::Done
    } else {
        Outcome::CheckFailed
    })
}

fn failures(cells: &[Cell]) -> usize {
    let failed = |cell: &&Cell| matches!(cell.outcome, stability::Outcome::Fail { .. });
    cells.iter().filter(failed).count()
}

/// Writes one row per case and one column per method and precision, then the reasons for failures.
fn text(cells: &[Cell], out: &mut dyn Write) -> io::Result<()> {
    let column = |cell: &Cell| format!("{} {}", cell.method, cell.precision.name());
    let mut columns: Vec<String> = Vec::new();
    for cell in cells {
        let name = column(cell);
        if !columns.contains(&name) {
            columns.push(name);
        }
    }
    let titles = ["theme", "case"].map(String::from).into_iter();
    let mut table = plain_table(titles.chain(columns.iter().cloned()).collect(), 2);
    for row in cells.chunk_by(|a, b| (a.theme, a.case) == (b.theme, b.case)) {
        let mut texts = vec![row[0].theme.to_owned(), row[0].case.to_owned()];
        texts.extend(row.iter().map(|cell| match &cell.outcome {
            stability::Outcome::Pass { rays: 0 } => "pass".to_owned(),
            stability::Outcome::Pass { rays } => {
                format!("pass, {}", counted(*rays as usize, "ray"))
            }
            stability::Outcome::Fail { .. } => "FAIL".to_owned(),
            stability::Outcome::NotRepresentable { .. } => "not representable".to_owned(),
        }));
        table.add_row(texts);
    }
    writeln!(out, "{}", table.trim_fmt())?;
    for cell in cells {
        let (stability::Outcome::Fail { reason } | stability::Outcome::NotRepresentable { reason }) =
            &cell.outcome
        else {
            continue;
        };
        writeln!(out, "{}, {}: {reason}", cell.case, column(cell))?;
        writeln!(out, "    rule: {}", cell.rule)?;
    }
    match failures(cells) {
        0 => writeln!(out, "All {} cases passed.", cells.len()),
        n => writeln!(out, "{n} of {} cases failed.", cells.len()),
    }
}
