//! The record of a pixel for programs. Lengths are in scene units. A value is null if a ray has no
//! end, no hit or no parent, or if it runs along a plane.

use super::report::PixelReport;
use crate::trace::{PixelRecord, RayKind, RecordedRay, Tally, srgb8};
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

/// Writes the whole record.
///
/// # Errors
/// Those of `out`.
pub fn write(report: &PixelReport<'_>, out: &mut dyn Write) -> Result<()> {
    let methods: Vec<_> = report
        .records
        .iter()
        .map(|(method, record)| of_method(method.name, record))
        .collect();
    let value = json!({
        "scene": report.scene.name(),
        "resolution": [report.render.width, report.render.height],
        "d_arec": report.render.d_arec,
        "min_contribution": report.render.min_contribution,
        "precision": report.render.precision_for(report.scene).precision,
        "pixel": report.records.first().map(|(_, record)| record.pixel),
        "methods": methods,
    });
    serde_json::to_writer_pretty(&mut *out, &value)?;
    writeln!(out)
}

fn of_method(method: &str, record: &PixelRecord) -> Value {
    let tallies = record.tallies();
    let kinds: Map<_, _> = RayKind::ALL
        .into_iter()
        .map(|kind| (kind.name().to_owned(), json!(tallies[kind as usize])))
        .collect();
    let total: Tally = tallies.into_iter().sum();
    json!({
        "method": method,
        "color": record.color,
        "srgb": record.color.as_vec3().to_array().map(srgb8),
        "total": total,
        "kinds": kinds,
        "rays": record.rays.iter().map(ray).collect::<Vec<_>>(),
    })
}

fn ray(ray: &RecordedRay) -> Value {
    let path = &ray.path;
    let hit = path.hit.is_hit().then(|| {
        json!({
            "object": path.hit.object,
            "t": path.hit.t,
            "point": path.ray.at(path.hit.t),
        })
    });
    json!({
        "kind": path.kind,
        "parent": ray.parent,
        "depth": ray.depth,
        "weight": ray.weight,
        "origin": path.ray.origin,
        "direction": path.ray.direction,
        // Infinite for a ray without an end. JSON has no number for that.
        "t_max": path.ray.t_max,
        "hit": hit,
        "counts": path.counts(),
        "steps": path.steps,
    })
}
