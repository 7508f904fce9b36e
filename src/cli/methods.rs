//! `bspscope methods`: the build methods and their settings.

use super::args::{ListFormat, MethodsArgs};
use super::outcome::Outcome;
use super::output;
use crate::structure::Method;
use crate::structure::split::Constant;
use anyhow::Result;
use serde_json::{Value, json};
use std::io::{self, Write};

pub fn run(args: &MethodsArgs) -> Result<Outcome> {
    output::write_to(None, |out| match args.format {
        ListFormat::Text => text(out),
        ListFormat::Json => {
            let list: Vec<_> = Method::all().map(json).collect();
            serde_json::to_writer_pretty(&mut *out, &list)?;
            writeln!(out)
        }
    })?;
    Ok(Outcome::Done)
}

fn text(out: &mut dyn Write) -> io::Result<()> {
    for (i, method) in Method::all().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        writeln!(out, "{}: {}", method.name, method.summary)?;
        writeln!(out, "  {}", method.about)?;
        writeln!(out, "  Source: {}", method.source)?;
        for constant in method.constants {
            writeln!(
                out,
                "  --set {}={}  {}, default {}{}",
                constant.name,
                constant.default,
                range(constant),
                constant.default,
                if constant.unit.is_empty() {
                    String::new()
                } else {
                    format!(" ({})", constant.unit)
                }
            )?;
            writeln!(out, "      {}", constant.about)?;
            writeln!(out, "      Source: {}", constant.source)?;
        }
    }
    Ok(())
}

fn range(constant: &Constant) -> String {
    let numbers = if constant.step == 1.0 {
        "integers"
    } else {
        "numbers"
    };
    format!("{numbers} {} to {}", constant.lowest, constant.highest)
}

fn json(method: Method) -> Value {
    let constants: Vec<_> = method
        .constants
        .iter()
        .map(|constant| {
            json!({
                "name": constant.name,
                "default": constant.default,
                "lowest": constant.lowest,
                "highest": constant.highest,
                "step": constant.step,
                "unit": constant.unit,
                "about": constant.about,
                "source": constant.source,
            })
        })
        .collect();
    json!({
        "name": method.name,
        "title": method.summary,
        "about": method.about,
        "source": method.source,
        "paper": method.paper,
        "constants": constants,
    })
}
