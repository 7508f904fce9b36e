//! The record of a pixel for people: an outline with one line per node that a ray visits.

use super::report::PixelReport;
use crate::geometry::Vec3;
use crate::present::report::table::plain_table;
use crate::scene::Scene;
use crate::trace::{
    BoxesStep, Children, Fate, InnerStep, LeafStep, PixelRecord, RayKind, RecordedRay, Step, Tally,
    srgb8,
};
use std::io::{Result, Write};

/// Writes the whole record.
///
/// # Errors
/// Those of `out`.
pub fn write(report: &PixelReport<'_>, out: &mut dyn Write) -> Result<()> {
    let render = &report.render;
    if let Some((_, record)) = report.records.first() {
        let [x, y] = record.pixel;
        writeln!(
            out,
            "Pixel {x},{y} of {} × {}, scene {}, D_AREC {}, precision {}",
            render.width,
            render.height,
            report.scene.name(),
            render.d_arec,
            render.precision_for(report.scene)
        )?;
    }
    writeln!(
        out,
        "Positions are in scene units. t is the distance from where a ray starts. Weights and \
         colors\nare linear RGB. Rays are numbered in the order of the outline; a ray stands below \
         the one whose\nhit it starts from. Nodes are numbered by their place in the tree, 0 is the \
         root."
    )?;
    for (method, record) in &report.records {
        writeln!(out, "\n{}: {}\n", method.name, method.summary)?;
        write_record(report.scene, record, out)?;
    }
    Ok(())
}

fn write_record(scene: &Scene, record: &PixelRecord, out: &mut dyn Write) -> Result<()> {
    let [r, g, b] = record.color.as_vec3().to_array().map(srgb8);
    writeln!(
        out,
        "Color {}, in sRGB #{r:02x}{g:02x}{b:02x}\n",
        vector(record.color)
    )?;
    write_totals(record, out)?;
    for (number, ray) in record.rays.iter().enumerate() {
        writeln!(out)?;
        write_ray(scene, number, ray, out)?;
    }
    Ok(())
}

/// Writes the totals of the rays of each kind, and of all rays.
fn write_totals(record: &PixelRecord, out: &mut dyn Write) -> Result<()> {
    let titles = [
        "rays",
        "number",
        "hits",
        "tests",
        "inner nodes",
        "leaves",
        "empty leaves",
    ];
    let mut table = plain_table(titles.map(String::from).to_vec(), 1);
    let mut row = |name: &str, tally: &Tally| {
        let counts = [
            tally.rays,
            tally.hits,
            tally.tests,
            tally.inner_nodes,
            tally.leaves,
            tally.empty_leaves,
        ];
        let mut cells = vec![name.to_owned()];
        cells.extend(counts.map(|n| n.to_string()));
        table.add_row(cells);
    };
    let tallies = record.tallies();
    for kind in RayKind::ALL {
        let tally: Tally = [tallies[kind as usize]].into_iter().sum();
        row(kind.name(), &tally);
    }
    row("all", &tallies.into_iter().sum());
    writeln!(out, "{}", table.trim_fmt())
}

fn write_ray(scene: &Scene, number: usize, ray: &RecordedRay, out: &mut dyn Write) -> Result<()> {
    let path = &ray.path;
    // A shadow ray has the same depth as its parent but is indented below it.
    let depth = ray.depth as usize + usize::from(path.kind == RayKind::Shadow);
    let indent = "    ".repeat(depth);
    let parent = ray.parent.map_or(String::new(), |parent| {
        format!(" from the hit of ray {parent}")
    });
    writeln!(
        out,
        "{indent}Ray {number}, {}{parent}: from {} along {}, weight {}",
        path.kind.name(),
        vector(path.ray.origin),
        vector(path.ray.direction),
        vector(ray.weight)
    )?;
    let counts = path.counts();
    let outcome = match (path.hit.is_hit(), path.kind) {
        (true, RayKind::Shadow) => format!(
            "blocked by {} at t {}, before the light at t {}",
            object(scene, path.hit.object),
            number_of(path.hit.t),
            number_of(path.ray.t_max)
        ),
        (false, RayKind::Shadow) => {
            format!("reaches the light at t {}", number_of(path.ray.t_max))
        }
        (true, _) => format!(
            "hits {} at t {}",
            object(scene, path.hit.object),
            number_of(path.hit.t)
        ),
        (false, _) => "hits nothing".to_owned(),
    };
    writeln!(
        out,
        "{indent}  {outcome}; {} inner nodes, {} leaves ({} empty), {} tests",
        counts.inner_nodes, counts.leaves, counts.empty_leaves, counts.tests
    )?;
    if path.steps.is_empty() {
        writeln!(out, "{indent}  misses the root cell")?;
    }
    for step in &path.steps {
        match step {
            Step::Inner(step) => writeln!(out, "{indent}  {}", inner(step))?,
            Step::Boxes(step) => write_boxes(&indent, step, out)?,
            Step::Culled(step) => writeln!(
                out,
                "{indent}  node {}, depth {}: begins at t {}, beyond the hit at t {}: skipped",
                step.node,
                step.depth,
                number_of(step.t_enter),
                number_of(step.limit)
            )?,
            Step::Leaf(step) => write_leaf(scene, &indent, path.kind, step, out)?,
        }
    }
    Ok(())
}

fn inner(step: &InnerStep) -> String {
    let meets = match step.t_plane {
        Some(t) => format!("meets it at t {}", number_of(t)),
        None => "runs along it".to_owned(),
    };
    let goes = match step.children {
        Children::Near => format!("near child {} only", step.near),
        Children::Far => format!("far child {} only", step.far),
        Children::Both => format!("near child {}, then far child {}", step.near, step.far),
    };
    format!(
        "node {}, depth {}: plane {} = {}, t {} to {}, {meets}: {goes}",
        step.node,
        step.depth,
        step.axis,
        number_of(step.plane),
        number_of(step.t_enter),
        number_of(step.t_exit),
    )
}

fn write_boxes(indent: &str, step: &BoxesStep, out: &mut dyn Write) -> Result<()> {
    writeln!(
        out,
        "{indent}  node {}, depth {}: t {} to {}; {} box tests",
        step.node,
        step.depth,
        number_of(step.t_enter),
        number_of(step.t_exit),
        step.tests.len()
    )?;
    let order: Vec<u32> = step.entered().iter().map(|test| test.node).collect();
    for test in &step.tests {
        let [enter, exit] = test.within.map(number_of);
        let found = match test.fate {
            Fate::Missed => test.fate.text().to_owned(),
            Fate::BeyondHit => format!("t {enter} to {exit}, {}", test.fate.text()),
            Fate::Entered => {
                let place = order.iter().position(|&node| node == test.node);
                let place = place.map_or(0, |place| place + 1);
                format!("t {enter} to {exit}, number {place} in order")
            }
        };
        writeln!(out, "{indent}      child {}: {found}", test.node)?;
    }
    Ok(())
}

fn write_leaf(
    scene: &Scene,
    indent: &str,
    kind: RayKind,
    leaf: &LeafStep,
    out: &mut dyn Write,
) -> Result<()> {
    writeln!(
        out,
        "{indent}  leaf {}, depth {}: {} to {}, t {} to {}; objects: {} ({})",
        leaf.node,
        leaf.depth,
        vector(leaf.bounds.lo),
        vector(leaf.bounds.hi),
        number_of(leaf.t_enter),
        number_of(leaf.t_exit),
        leaf.objects,
        leaf.stop.text()
    )?;
    let missed = match kind {
        RayKind::Shadow => "not before the light",
        _ => "no closer hit",
    };
    for test in &leaf.tests {
        let found = test
            .hit
            .map_or(missed.to_owned(), |t| format!("hit at t {}", number_of(t)));
        writeln!(
            out,
            "{indent}      test {}: {found}",
            object(scene, test.object)
        )?;
    }
    writeln!(out, "{indent}      {}", leaf.outcome.text())
}

fn object(scene: &Scene, object: u32) -> String {
    format!(
        "object {object} ({})",
        scene.objects()[object as usize].kind().name()
    )
}

fn vector(v: Vec3) -> String {
    format!(
        "({}, {}, {})",
        number_of(v.x),
        number_of(v.y),
        number_of(v.z)
    )
}

/// Formats a number with six significant digits, without trailing zeros.
fn number_of(value: f64) -> String {
    let size = value.abs();
    // Adding zero turns −0 into 0.
    if value == 0.0 || !value.is_finite() {
        return format!("{}", value + 0.0);
    }
    if !(1e-5..1e9).contains(&size) {
        return format!("{value:.5e}");
    }
    let decimals = (5 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if decimals == 0 {
        text
    } else {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits_and_no_idle_zeros() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (100.0, "100"),
            (1234567.8, "1234568"),
            (1.0 / 3.0, "0.333333"),
            (-12.34567891, "-12.3457"),
            (2e-9, "2.00000e-9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number_of(value), text);
        }
    }
}
