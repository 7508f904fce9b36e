//! The sentences of a report: the scene, the settings, the times.

use super::content::Report;
use crate::geometry::Vec3;
use crate::measure::{BreakEven, Measurement, Unit};
use crate::present::number::{Digits, counted};
use crate::setup::{Group, Kind, Setting, Setup, Value};
use crate::structure::{MaxDepth, RootMargin};
use std::time::Duration;

/// Describes the scene and which features it does not need, one sentence per line.
pub fn scene(report: &Report) -> Vec<String> {
    let scene = &report.scene;
    let kinds: Vec<_> = scene
        .requirements
        .primitives
        .iter()
        .map(|(kind, count)| format!("{}: {count}", kind.plural()))
        .collect();
    let mut lines = vec![
        format!(
            "Scene {} from {}, cylinders {}",
            scene.name, scene.request.source, scene.request.cylinders
        ),
        format!(
            "Objects: {}{}; lights: {}",
            scene.objects,
            if kinds.is_empty() {
                String::new()
            } else {
                format!(" ({})", kinds.join(", "))
            },
            scene.lights
        ),
    ];
    if !scene.bounds.is_empty() {
        let size = scene.bounds.size().max_element();
        lines.push(format!(
            "Bounds: {} to {}",
            point(rounded(scene.bounds.lo, size)),
            point(rounded(scene.bounds.hi, size))
        ));
    }
    let unneeded = scene.requirements.unneeded();
    if !unneeded.is_empty() {
        lines.push(format!("Not needed by this scene: {}", unneeded.join("; ")));
    }
    lines.extend(scene.notes.iter().map(ToString::to_string));
    lines
}

/// Describes the settings of picture and camera, the values that were used, and the settings of
/// every tree, one sentence per line.
pub fn settings(report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    for (i, run) in report.runs.iter().enumerate() {
        if i > 0 && run.render == report.runs[0].render {
            continue;
        }
        let setup = setup(report, run);
        let of = |group| {
            let settings = setup.settings().filter(move |s| s.group == group);
            settings
                .map(|s| with_value(&s, &setup))
                .collect::<Vec<_>>()
                .join(", ")
        };
        lines.push(format!("Picture: {}", of(Group::Picture)));
        let camera = &run.camera;
        let overridden = setup.settings().filter(|s| s.group == Group::Camera);
        let overridden = overridden.filter(|s| !s.is_default(&setup));
        let words: Vec<_> = overridden.map(|s| with_value(&s, &setup)).collect();
        lines.push(format!(
            "Camera: {}; eye {}, looking at {}, angle {}°",
            match words.as_slice() {
                [] => "the scene's own".to_owned(),
                words => words.join(", "),
            },
            point(camera.from),
            point(camera.at),
            camera.angle
        ));
        lines.push(format!("Precision: {}", run.precision));
        let mut kernels: Vec<String> = Vec::new();
        for run in &report.runs {
            let structure = run.build.method.structure;
            let kernel = run.render.kernel.description_for(structure);
            if !kernels.contains(&kernel) {
                kernels.push(kernel);
            }
        }
        lines.push(format!("Timed kernel: {}", kernels.join("; ")));
    }
    lines.extend(report.runs.iter().map(|run| tree(report, run)));
    lines
}

/// Returns the setup of a run.
fn setup(report: &Report, run: &Measurement) -> Setup {
    Setup {
        scene: report.scene.request.clone(),
        build: run.build.clone(),
        render: run.render,
    }
}

/// Returns a setting with its value, such as `D_AREC 4` or `512 × 512 pixels`.
fn with_value(setting: &Setting, setup: &Setup) -> String {
    match setting.value(setup) {
        Value::Size([width, height]) => {
            format!("{} {width} × {height} pixels", setting.word())
        }
        Value::Number(0.0) if setting.name == "threads" => "threads 0 (all cores)".into(),
        value => {
            let unit = match setting.kind {
                Kind::Number(range) | Kind::Automatic(range) if !range.unit.is_empty() => {
                    format!(" {}", range.unit)
                }
                _ => String::new(),
            };
            format!("{} {value}{unit}", setting.word())
        }
    }
}

/// Describes the times of each run and its threads, and the methods that could not be measured, one
/// sentence per line.
pub fn times(report: &Report) -> Vec<String> {
    let runs = report.runs.iter();
    let failures = report.failures.iter().map(ToString::to_string);
    runs.map(|run| {
        let mut line = format!(
            "{}: tree built in {} ({} CPU) on {}",
            run.build.method.name,
            time(run.building.wall),
            time(run.building.cpu),
            counted(run.building.threads, "thread")
        );
        if let Some(rendering) = run.rendering {
            line += &format!(
                "; picture rendered in {} ({} CPU) on {}",
                time(rendering.wall),
                time(rendering.cpu),
                counted(rendering.threads, "thread")
            );
        }
        line
    })
    .chain(break_even(report))
    .chain(union_error(report))
    .chain(failures)
    .collect()
}

/// Says when the second of two trees pays off, `N_BE`.
fn break_even(report: &Report) -> Option<String> {
    let [first, second] = &report.runs[..] else {
        return None;
    };
    Some(match BreakEven::of(first, second)? {
        BreakEven::Rays(0.0) => {
            "Break-even N_BE: 0 rays; the second tree takes no longer to build, and rays are faster"
                .into()
        }
        BreakEven::Rays(rays) => format!(
            "Break-even N_BE: {} rays; from then on, the second tree has made up for its longer build",
            Digits::Three.count(rays.ceil())
        ),
        BreakEven::Never => "Break-even N_BE: –; rays are not faster with the second tree".into(),
    })
}

/// Says for each run how far V_EMPTY may be off, if it was estimated.
fn union_error(report: &Report) -> impl Iterator<Item = String> + '_ {
    let estimated = report
        .runs
        .iter()
        .filter(|run| run.tree.empty_volume_error > 0.0);
    estimated.map(|run| {
        format!(
            "{}: V_EMPTY is estimated from points; its standard error is at most {}",
            run.build.method.name,
            Unit::Volume.text(run.tree.empty_volume_error, Digits::Three)
        )
    })
}

/// Returns the settings that a tree was built with.
fn tree(report: &Report, run: &Measurement) -> String {
    let setup = setup(report, run);
    let build = &run.build;
    let mut words = Vec::new();
    for setting in setup.settings().filter(|s| s.group == Group::Structure) {
        match setting.name {
            "method" => {}
            _ if !setup.applies(&setting) => {
                words.push(format!("{} (does not apply)", with_value(&setting, &setup)));
            }
            "d-max" if build.d_max == MaxDepth::Automatic => {
                words.push(format!("D_MAX auto ({})", run.depth_limit));
            }
            "root-margin" if build.root_margin == RootMargin::Automatic => {
                words.push(format!(
                    "{} auto ({} units)",
                    setting.word(),
                    Digits::Four.number(run.root_margin)
                ));
            }
            "overlap" => words.push(format!(
                "{} ({})",
                with_value(&setting, &setup),
                build.method.overlap_text(build.overlap)
            )),
            _ => words.push(with_value(&setting, &setup)),
        }
    }
    format!("method {}: {}", build.method.name, words.join(", "))
}

fn time(time: Duration) -> String {
    Digits::Three.seconds(time.as_secs_f64())
}

/// Formats a point to about six digits relative to `size`, which hides the noise of rounding.
fn rounded(p: Vec3, size: f64) -> Vec3 {
    if !(1e-100..1e100).contains(&size) {
        return p;
    }
    let decimals = 5 - size.log10().floor() as i32;
    let scale = 10f64.powi(decimals.abs());
    // Adding zero turns −0 into 0.
    if decimals >= 0 {
        (p * scale).round() / scale + 0.0
    } else {
        (p / scale).round() * scale + 0.0
    }
}

fn point(p: Vec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_to_their_size() {
        let noisy = Vec3::new(-12.00000000000001, -2.7e-15, 0.78507160000000);
        assert_eq!(point(rounded(noisy, 24.0)), "(-12, 0, 0.7851)");
        assert_eq!(
            point(rounded(Vec3::splat(123_456_789.0), 2e8)),
            "(123457000, 123457000, 123457000)"
        );
        assert_eq!(rounded(noisy, 0.0), noisy);
    }
}
