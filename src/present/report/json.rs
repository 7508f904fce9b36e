//! JSON for programs: the paper's symbols as keys, shares as fractions, times in seconds.

use super::content::{Report, SceneSummary};
use super::exact::exact_value;
use super::per_kind;
use super::writer::Writer;
use crate::measure::{BreakEven, DELTA, LAMBDA, Measurement, parameter, parameters};
use crate::setup::{Kind, SETTINGS, Setting, Setup};
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
        "runs": report.runs.iter().map(|one| run(report, one)).collect::<Vec<_>>(),
        "failures": report.failures,
    });
    if let [first, second] = &report.runs[..] {
        value["comparison"] = comparison(first, second);
    }
    if let Some(per_kind) = per_kind::json(report) {
        value["per_kind"] = per_kind;
    }
    serde_json::to_writer_pretty(&mut *out, &value)?;
    writeln!(out)
}

/// Returns every parameter of the second run relative to the first, and when the second tree pays off.
fn comparison(first: &Measurement, second: &Measurement) -> Value {
    let parameters = parameters().iter().map(|parameter| {
        let mut value = json!({});
        per_kind::add_comparison(&mut value, Some(parameter.compare(first, second)));
        (parameter.symbol.to_owned(), value)
    });
    let break_even = BreakEven::of(first, second);
    let mut rays = json!({ "rays": break_even.and_then(BreakEven::rays) });
    if break_even == Some(BreakEven::Never) {
        rays["reason"] = json!("rays are not faster with the second tree");
    }
    json!({
        "parameters": Value::Object(parameters.collect()),
        "N_BE": rays,
    })
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
        // These have separate entries, by name.
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

fn run(report: &Report, run: &Measurement) -> Value {
    let of = |symbols: &[&'static str]| -> Map<String, Value> {
        symbols
            .iter()
            .map(|&symbol| (symbol.into(), exact_value(parameter(symbol), run)))
            .collect()
    };
    let all: Vec<_> = parameters().iter().map(|p| p.symbol).collect();
    json!({
        "method": run.build.method.name,
        "settings": settings(report, run),
        "parameters": of(&all),
        "delta": of(&DELTA),
        "lambda": of(&LAMBDA),
    })
}

/// Returns all settings and the values that were used. The names are those of the command-line
/// options, with underscores.
fn settings(report: &Report, run: &Measurement) -> Value {
    let setup = Setup {
        scene: report.scene.request.clone(),
        build: run.build.clone(),
        render: run.render,
    };
    let mut settings = Map::new();
    let mut constants = Map::new();
    for setting in setup.settings() {
        let value = value(&setting, &setup);
        if SETTINGS.iter().any(|known| known.name == setting.name) {
            settings.insert(setting.name.replace('-', "_"), value);
        } else {
            constants.insert(setting.name.to_owned(), value);
        }
    }
    settings.insert("depth_limit".into(), json!(run.depth_limit));
    settings.insert("root_margin_length".into(), json!(run.root_margin));
    let overlap = run.build.method.overlap_text(run.build.overlap);
    settings.insert("overlap_in_words".into(), json!(overlap));
    settings.insert("constants".into(), Value::Object(constants));
    let precision = json!({
        "asked": settings["precision"],
        "used": run.precision.precision.name(),
        "why": run.precision.why,
    });
    let kernel = json!({
        "asked": settings["kernel"],
        "used": run.render.kernel.description_for(run.build.method.structure),
    });
    settings["precision"] = precision;
    settings["kernel"] = kernel;
    settings["threads"] = json!(run.building.threads);
    settings.insert("camera".into(), json!(run.camera));
    Value::Object(settings)
}

/// Returns the value of a setting; null if it is the scene's own.
fn value(setting: &Setting, setup: &Setup) -> Value {
    use crate::setup::Value as Of;
    match setting.value(setup) {
        Of::Own => Value::Null,
        Of::Switch(on) => json!(f64::from(u8::from(on))),
        Of::Number(number) => match setting.kind {
            Kind::Number(range)
                if range.whole && SETTINGS.iter().any(|s| s.name == setting.name) =>
            {
                json!(number as u64)
            }
            _ => json!(number),
        },
        Of::Size(size) => json!(size),
        Of::Point(point) => json!(point.to_array()),
        Of::Depth(depth) => json!(depth),
        value @ (Of::Choice(_) | Of::Cylinders(_) | Of::Automatic) => json!(value.to_string()),
    }
}

/// Returns the name under which a plain enum is serialized.
fn name(value: &impl serde::Serialize) -> Result<String> {
    Ok(match serde_json::to_value(value)? {
        Value::String(name) => name,
        other => other.to_string(),
    })
}
