//! What a report says in sentences: the scene, the settings, the times.

use super::content::Report;
use crate::geometry::Vec3;
use crate::measure::Measurement;
use crate::scene::Sampling;
use crate::structure::split::Structure;

/// The scene and what rendering it leaves out, a sentence a line.
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

/// What trees were built with and pictures traced with, a sentence a line.
pub fn settings(report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(run) = report.runs.first() {
        let (render, camera) = (&run.render, &run.camera);
        lines.push(format!(
            "Picture: {} × {} pixels, D_AREC {}, samples at the {}; eye {}, looking at {}, angle {}°",
            render.width,
            render.height,
            render.d_arec,
            match render.sampling {
                Sampling::Center => "pixels' centres",
                Sampling::Corner => "corners of the lattice",
            },
            point(camera.from),
            point(camera.at),
            camera.angle
        ));
        lines.push(format!("Precision: {}", run.precision));
        lines.push(format!("Timed kernel: {}", render.kernel.description()));
    }
    lines.extend(report.runs.iter().map(tree));
    lines
}

/// Times of every run with the threads they were taken on, a sentence a line.
pub fn times(report: &Report) -> Vec<String> {
    report
        .runs
        .iter()
        .map(|run| {
            let mut line = format!(
                "{}: tree built in {:.1?} ({:.1?} CPU) on {}",
                run.build.method.name,
                run.building.wall,
                run.building.cpu,
                threads(run.building.threads)
            );
            if let Some(rendering) = run.rendering {
                line += &format!(
                    "; picture traced in {:.1?} ({:.1?} CPU) on {}",
                    rendering.wall,
                    rendering.cpu,
                    threads(rendering.threads)
                );
            }
            line
        })
        .collect()
}

/// What a tree was built with.
fn tree(run: &Measurement) -> String {
    let build = &run.build;
    let ends = match build.method.structure {
        Structure::Bintree | Structure::Octree => {
            format!("D_MAX {}, N_OILF {}", run.depth_in_words(), build.n_oilf)
        }
        Structure::Grid => "D_MAX and N_OILF do not apply".into(),
    };
    let mut line = format!(
        "{}: {ends}, root margin {}, overlap {} ({}), first axis {}",
        build.method.name,
        build.root_margin,
        build.overlap.name(),
        build.method.overlap_text(build.overlap),
        build.first_axis
    );
    for constant in build.method.constants {
        line += &format!(", {} {}", constant.name, build.constant(constant.name));
    }
    line
}

fn threads(count: usize) -> String {
    match count {
        1 => "1 thread".into(),
        n => format!("{n} threads"),
    }
}

/// The point to about six digits of a length, without the noise of rounding behind them.
fn rounded(p: Vec3, size: f64) -> Vec3 {
    if !(1e-100..1e100).contains(&size) {
        return p;
    }
    let decimals = 5 - size.log10().floor() as i32;
    let scale = 10f64.powi(decimals.abs());
    // Adding zero makes -0 a 0.
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
