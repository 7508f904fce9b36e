//! Settings and camera as a line for the command line.

use super::TreeSettings;
use crate::scene::{CameraOverride, Cylinders, Sampling, SceneSource};
use crate::structure::BuildSettings;
use std::fmt::Display;
use std::path::absolute;

/// The command that measures this tree of this scene: `bspscope measure SCENE …`, quoted for a
/// POSIX shell. Options at their defaults are left out; files go by their absolute paths.
pub fn measure_command(
    source: &SceneSource,
    camera: &CameraOverride,
    settings: &TreeSettings,
) -> String {
    let TreeSettings {
        cylinders,
        build,
        picture,
    } = settings;
    let scene = match source {
        SceneSource::File(path) => {
            let path = absolute(path).unwrap_or_else(|_| path.clone());
            path.display().to_string()
        }
        generator => generator.to_string(),
    };
    let mut line = Line(vec!["bspscope".into(), "measure".into(), scene]);
    line.unless(*cylinders == Cylinders::Exact, "cylinders", cylinders);
    line.option("method", build.method.name);
    let plain = BuildSettings::for_method(build.method);
    line.unless(build.d_max == plain.d_max, "d-max", build.d_max);
    line.unless(build.n_oilf == plain.n_oilf, "n-oilf", build.n_oilf);
    let overlap = build.overlap;
    line.unless(overlap == plain.overlap, "overlap", overlap.name());
    let margin = build.root_margin;
    line.unless(margin == plain.root_margin, "root-margin", margin);
    let axis = build.first_axis;
    line.unless(axis == plain.first_axis, "first-axis", axis);
    for (name, value) in &build.constants {
        line.option("set", format!("{name}={value}"));
    }
    let memory = build.memory_limit;
    line.unless(memory == plain.memory_limit, "memory-limit", memory >> 20);
    let [width, height] = picture.resolution;
    line.option("resolution", format!("{width}x{height}"));
    line.option("d-arec", picture.d_arec);
    line.unless(picture.cut_off == 0.0, "cut-off", picture.cut_off);
    let (precision, kernel) = (picture.precision, picture.kernel);
    line.unless(precision.name() == "f64", "precision", precision.name());
    line.unless(kernel.name() == "scalar", "kernel", kernel.name());
    let center = picture.sampling == Sampling::Center;
    line.unless(center, "sampling", "corner");
    line.unless(picture.threads == 0, "threads", picture.threads);
    for (name, point) in [("from", camera.from), ("at", camera.at), ("up", camera.up)] {
        if let Some(point) = point {
            line.option(name, format!("{},{},{}", point.x, point.y, point.z));
        }
    }
    if let Some(angle) = camera.angle {
        line.option("angle", angle);
    }
    shell_words::join(line.0)
}

/// The words of a command.
struct Line(Vec<String>);

impl Line {
    fn option(&mut self, name: &str, value: impl Display) {
        self.0.push(format!("--{name}"));
        self.0.push(value.to_string());
    }

    fn unless(&mut self, default: bool, name: &str, value: impl Display) {
        if !default {
            self.option(name, value);
        }
    }
}
