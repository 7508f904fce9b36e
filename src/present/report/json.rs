//! JSON for programs: the paper's symbols as keys, shares as fractions, times in seconds.

use super::content::{Report, SceneSummary};
use super::exact::exact_value;
use super::per_kind;
use super::writer::Writer;
use crate::measure::{DELTA, LAMBDA, Measurement, parameter, parameters};
use crate::structure::MaxDepth;
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

pub(super) const WRITER: Writer = Writer {
    name: "json",
    about: "for programs; symbols as keys, shares as fractions, null without a value",
    extension: "json",
    write,
};

fn write(report: &Report, out: &mut dyn Write) -> Result<()> {
    let mut value = json!({
        "scene": scene(&report.scene)?,
        "runs": report.runs.iter().map(run).collect::<Result<Vec<_>>>()?,
    });
    if let Some(per_kind) = per_kind::json(report) {
        value["per_kind"] = per_kind;
    }
    serde_json::to_writer_pretty(&mut *out, &value)?;
    writeln!(out)
}

fn scene(scene: &SceneSummary) -> Result<Value> {
    let primitives = scene
        .requirements
        .primitives
        .iter()
        .map(|(kind, count)| Ok((name(kind)?, json!(count))))
        .collect::<Result<Map<_, _>>>()?;
    let mut requirements = serde_json::to_value(&scene.requirements)?;
    if let Some(fields) = requirements.as_object_mut() {
        // They have a place of their own, by name.
        fields.shift_remove("primitives");
    }
    Ok(json!({
        "name": scene.name,
        "source": scene.request.source.to_string(),
        "cylinders": scene.request.cylinders.to_string(),
        "bounds": (!scene.bounds.is_empty()).then_some(scene.bounds),
        "objects": scene.objects,
        "lights": scene.lights,
        "primitives": primitives,
        "requirements": requirements,
        "left_out": scene.requirements.unneeded(),
        "notes": scene.notes,
        "camera": scene.camera,
    }))
}

fn run(run: &Measurement) -> Result<Value> {
    let of = |symbols: &[&'static str]| -> Map<String, Value> {
        symbols
            .iter()
            .map(|&symbol| (symbol.into(), exact_value(parameter(symbol), run)))
            .collect()
    };
    let all: Vec<_> = parameters().iter().map(|p| p.symbol).collect();
    Ok(json!({
        "method": run.build.method.name,
        "settings": settings(run)?,
        "parameters": of(&all),
        "delta": of(&DELTA),
        "lambda": of(&LAMBDA),
    }))
}

/// Everything that was set, under the names of the command line's options.
fn settings(run: &Measurement) -> Result<Value> {
    let (build, render) = (&run.build, &run.render);
    let constants: Map<_, _> = build
        .method
        .constants
        .iter()
        .map(|c| (c.name.into(), json!(build.constant(c.name))))
        .collect();
    Ok(json!({
        "d_max": match build.d_max {
            MaxDepth::Fixed(depth) => json!(depth),
            MaxDepth::Automatic => json!(build.d_max.to_string()),
        },
        "depth_limit": run.depth_limit,
        "n_oilf": build.n_oilf,
        "root_margin": build.root_margin,
        "overlap": name(&build.overlap)?,
        "overlap_text": build.method.overlap_text(build.overlap),
        "first_axis": name(&build.first_axis)?,
        "constants": constants,
        "memory_limit": build.memory_limit >> 20,
        "resolution": [render.width, render.height],
        "d_arec": render.d_arec,
        "min_contribution": render.min_contribution,
        "precision": {
            "asked": name(&render.precision)?,
            "used": run.precision.precision.name(),
            "why": run.precision.why,
        },
        "kernel": {
            "asked": name(&render.kernel)?,
            "used": render.kernel.description(),
        },
        "sampling": name(&render.sampling)?,
        "threads": run.building.threads,
        "camera": run.camera,
    }))
}

/// The name under which a plain enum is serialised.
fn name(value: &impl serde::Serialize) -> Result<String> {
    Ok(match serde_json::to_value(value)? {
        Value::String(name) => name,
        other => other.to_string(),
    })
}
