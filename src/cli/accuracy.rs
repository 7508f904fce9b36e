//! `bspscope trade`: what accuracy costs, by time and error.

use super::args::{TradeArgs, TradeFormat};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::accuracy::{choices, reference, trade};
use crate::present::report::accuracy::{TradeReport, write_csv, write_json, write_text};
use crate::scene::Cylinders;
use crate::setup::Setup;
use crate::trace::RenderSettings;
use anyhow::Result;

pub fn run(args: &TradeArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let build = resolve::builds(&[args.method], &args.build)?.remove(0);
    let exact = super::args::CylinderArgs {
        cylinders: Cylinders::Exact,
    };
    let (request, scene) = resolve::scene(&args.scene, &exact)?;
    let render = RenderSettings {
        samples: args.samples,
        ..resolve::render(&args.trace, &args.picture)
    };
    // A wrong size is told before a tree is built for it.
    render.view(&scene)?;
    let setup = Setup {
        scene: request,
        build,
        render,
    };
    let mut choices = choices(&reference(&setup), &scene);
    if !args.only.is_empty() {
        let asked = |knob: &str| args.only.iter().any(|only| only == knob);
        choices.retain(|choice| match &choice.turned[..] {
            [] => true,
            [(knob, _)] => asked(knob),
            _ => false,
        });
    }
    let stage = format!("{}: {} choices", scene.name(), choices.len());
    let found = bar::with_bar(&stage, |progress| {
        trade(&scene, choices, args.rounds, progress, |_, _| ())
    })?;
    let report = TradeReport {
        scene: scene.name(),
        trade: &found,
    };
    output::write_to(args.output.as_deref(), |out| match args.format {
        TradeFormat::Text => write_text(&report, out),
        TradeFormat::Json => write_json(&report, out),
        TradeFormat::Csv => write_csv(&report, out),
    })?;
    Ok(Outcome::Done)
}
