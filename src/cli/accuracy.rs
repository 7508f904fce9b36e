//! `bspscope accuracy`: measures accuracy vs. time.

use super::args::{AccuracyArgs, AccuracyFormat};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::accuracy::{choices, reference, trade};
use crate::present::report::accuracy::{TradeReport, write_csv, write_json, write_text};
use anyhow::Result;

pub fn run(args: &AccuracyArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = resolve::scene(&setup.scene)?;
    // Report an invalid size before a tree is built for it.
    setup.render.view(&scene)?;
    let mut choices = choices(&reference(&setup), &scene);
    if !args.only.is_empty() {
        let asked = |name: &str| args.only.iter().any(|knob| knob.name() == name);
        choices.retain(|choice| match &choice.turned[..] {
            [] => true,
            [(knob, _)] => asked(knob),
            _ => false,
        });
    }
    let stage = format!("{}: measuring {} choices", scene.name(), choices.len());
    let found = bar::with_bar(&stage, |progress| {
        trade(&scene, choices, args.rounds, progress, |_, _| ())
    })?;
    let report = TradeReport {
        scene: scene.name(),
        trade: &found,
    };
    output::write_to(args.output.as_deref(), |out| match args.format {
        AccuracyFormat::Text => write_text(&report, out),
        AccuracyFormat::Json => write_json(&report, out),
        AccuracyFormat::Csv => write_csv(&report, out),
    })?;
    Ok(Outcome::Done)
}
