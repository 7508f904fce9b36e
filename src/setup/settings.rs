//! The list of all settings.

use super::choices::{axes, kernels, overlaps, precisions, samplings};
use super::setting::{Affects, Group, Kind, Range, Setting, Value};
use crate::geometry::{Axis, Vec3};
use crate::scene::Sampling;
use crate::structure::{Method, OverlapRule, RootMargin};
use crate::trace::{KernelChoice, PrecisionChoice};

/// All settings but the constants of build methods, in the order in which people see them. The
/// structure comes after the method, whose constants follow it ([`crate::setup::Setup::settings`]).
pub static SETTINGS: &[Setting] = &[
    Setting {
        name: "cylinders",
        aliases: &[],
        symbol: None,
        label: "Cylinders",
        group: Group::Scene,
        about: "How cylinders and cones are represented: exact, or polygons:N for open prisms of N \
                polygons, as in the paper",
        kind: Kind::Cylinders,
        affects: Affects::Scene,
        get: |_, setup| Value::Cylinders(setup.scene.cylinders),
        set: |_, setup, value| {
            if let Value::Cylinders(cylinders) = value {
                setup.scene.cylinders = cylinders;
            }
        },
    },
    Setting {
        name: "method",
        aliases: &["tree"],
        symbol: None,
        label: "Method",
        group: Group::Structure,
        about: "The method that builds the tree, or a tree file (.bstree)",
        kind: Kind::Method,
        affects: Affects::Structure,
        get: |_, setup| Value::Choice(setup.build.method.name),
        set: |_, setup, value| {
            if let Ok(method) = Method::named(value.choice()) {
                setup.build.set_method(method);
            }
        },
    },
    Setting {
        name: "d-max",
        aliases: &[],
        symbol: Some("D_MAX"),
        label: "Depth",
        group: Group::Structure,
        about: "Maximum depth of a leaf, or 'auto' for 1.2 log2 N_O + 2; the root has depth 0",
        kind: Kind::Depth,
        affects: Affects::Structure,
        get: |_, setup| Value::Depth(setup.build.d_max),
        set: |_, setup, value| {
            if let Value::Depth(depth) = value {
                setup.build.d_max = depth;
            }
        },
    },
    Setting {
        name: "n-oilf",
        aliases: &[],
        symbol: Some("N_OILF"),
        label: "Leaf size",
        group: Group::Structure,
        about: "A cell with at most this many objects becomes a leaf",
        kind: whole(0.0, 1e6, ""),
        affects: Affects::Structure,
        get: |_, setup| Value::Number(f64::from(setup.build.n_oilf)),
        set: |_, setup, value| setup.build.n_oilf = value.number() as u32,
    },
    Setting {
        name: "root-margin",
        aliases: &[],
        symbol: None,
        label: "Root margin",
        group: Group::Structure,
        about: "How far the root cell extends beyond the scene's bounds on every side, in the \
                scene's units of length; 'auto' for 0.001 of half the longest edge of the bounds, \
                or the scene's published margin: 0.001 units for balls, rings and tetra",
        kind: Kind::Automatic(Range {
            lowest: 0.0,
            highest: f64::MAX,
            whole: false,
            unit: "units",
        }),
        affects: Affects::Structure,
        get: |_, setup| match setup.build.root_margin {
            RootMargin::Length(length) => Value::Number(length),
            RootMargin::Automatic => Value::Automatic,
        },
        set: |_, setup, value| {
            setup.build.root_margin = match value {
                Value::Automatic => RootMargin::Automatic,
                value => RootMargin::Length(value.number()),
            };
        },
    },
    Setting {
        name: "overlap",
        aliases: &[],
        symbol: None,
        label: "Overlap",
        group: Group::Structure,
        about: "When an object belongs to a cell",
        kind: Kind::Choice(overlaps),
        affects: Affects::Structure,
        get: |_, setup| Value::Choice(setup.build.overlap.name()),
        set: |_, setup, value| {
            setup.build.overlap = named(OverlapRule::ALL, |rule| rule.name(), value);
        },
    },
    Setting {
        name: "first-axis",
        aliases: &[],
        symbol: None,
        label: "First axis",
        group: Group::Structure,
        about: "The axis that methods in cyclic order split first",
        kind: Kind::Choice(axes),
        affects: Affects::Structure,
        get: |_, setup| Value::Choice(setup.build.first_axis.name()),
        set: |_, setup, value| {
            setup.build.first_axis = named(Axis::ALL, |axis| axis.name(), value);
        },
    },
    Setting {
        name: "memory-limit",
        aliases: &[],
        symbol: None,
        label: "Memory limit",
        group: Group::Structure,
        about: "The build stops with an error before it uses more memory than this",
        kind: whole(1.0, 1e9, "MiB"),
        affects: Affects::Structure,
        get: |_, setup| Value::Number((setup.build.memory_limit >> 20) as f64),
        set: |_, setup, value| setup.build.memory_limit = (value.number() as u64) << 20,
    },
    Setting {
        name: "resolution",
        aliases: &[],
        symbol: None,
        label: "Resolution",
        group: Group::Picture,
        about: "Width and height of the picture in pixels, N_X and N_Y",
        kind: Kind::Size,
        affects: Affects::Image,
        get: |_, setup| Value::Size([setup.render.width, setup.render.height]),
        set: |_, setup, value| {
            if let Value::Size(size) = value {
                [setup.render.width, setup.render.height] = size;
            }
        },
    },
    Setting {
        name: "d-arec",
        aliases: &[],
        symbol: Some("D_AREC"),
        label: "Bounces",
        group: Group::Picture,
        about: "How many reflections and refractions a ray may go through; 0 traces none",
        kind: whole(0.0, 4e9, ""),
        affects: Affects::Image,
        get: |_, setup| Value::Number(f64::from(setup.render.d_arec)),
        set: |_, setup, value| setup.render.d_arec = value.number() as u32,
    },
    Setting {
        name: "min-contribution",
        aliases: &["cut-off"],
        symbol: None,
        label: "Minimum contribution",
        group: Group::Picture,
        about: "A secondary ray that contributes less than this to every color of its pixel is not \
                traced, from 0 to 1",
        kind: real(0.0, 1.0, ""),
        affects: Affects::Image,
        get: |_, setup| Value::Number(setup.render.min_contribution),
        set: |_, setup, value| setup.render.min_contribution = value.number(),
    },
    Setting {
        name: "samples-per-pixel",
        aliases: &["samples"],
        symbol: None,
        label: "Samples",
        group: Group::Picture,
        about: "Samples per pixel in the finished picture; measurements always take one",
        kind: whole(1.0, 4e9, "per pixel"),
        affects: Affects::Image,
        get: |_, setup| Value::Number(f64::from(setup.render.samples)),
        set: |_, setup, value| setup.render.samples = value.number() as u32,
    },
    Setting {
        name: "sampling",
        aliases: &[],
        symbol: None,
        label: "Sampling",
        group: Group::Picture,
        about: "Where the first sample of a pixel lies",
        kind: Kind::Choice(samplings),
        affects: Affects::Image,
        get: |_, setup| Value::Choice(setup.render.sampling.name()),
        set: |_, setup, value| {
            setup.render.sampling = named(Sampling::ALL, |s| s.name(), value);
        },
    },
    Setting {
        name: "precision",
        aliases: &[],
        symbol: None,
        label: "Precision",
        group: Group::Picture,
        about: "The floating-point numbers that rays are traced in",
        kind: Kind::Choice(precisions),
        affects: Affects::Image,
        get: |_, setup| Value::Choice(setup.render.precision.name()),
        set: |_, setup, value| {
            setup.render.precision = named(PrecisionChoice::ALL, |p| p.name(), value);
        },
    },
    Setting {
        name: "kernel",
        aliases: &[],
        symbol: None,
        label: "Kernel",
        group: Group::Picture,
        about: "The kernel that rendering is timed with; every kernel finds the same hits",
        kind: Kind::Choice(kernels),
        affects: Affects::Time,
        get: |_, setup| Value::Choice(setup.render.kernel.name()),
        set: |_, setup, value| {
            setup.render.kernel = named(KernelChoice::ALL, |k| k.name(), value);
        },
    },
    Setting {
        name: "threads",
        aliases: &[],
        symbol: None,
        label: "Threads",
        group: Group::Picture,
        about: "Threads to build and render with; 0 uses all cores of the machine",
        kind: whole(0.0, 65_535.0, ""),
        affects: Affects::Time,
        get: |_, setup| Value::Number(setup.render.threads as f64),
        set: |_, setup, value| setup.render.threads = value.number() as usize,
    },
    Setting {
        name: "from",
        aliases: &[],
        symbol: None,
        label: "Eye",
        group: Group::Camera,
        about: "Position of the eye, instead of the scene's",
        kind: Kind::Point,
        affects: Affects::Image,
        get: |_, setup| of_point(setup.render.camera.from),
        set: |_, setup, value| setup.render.camera.from = to_point(value),
    },
    Setting {
        name: "at",
        aliases: &[],
        symbol: None,
        label: "Looking at",
        group: Group::Camera,
        about: "The point that the camera looks at, instead of the scene's",
        kind: Kind::Point,
        affects: Affects::Image,
        get: |_, setup| of_point(setup.render.camera.at),
        set: |_, setup, value| setup.render.camera.at = to_point(value),
    },
    Setting {
        name: "up",
        aliases: &[],
        symbol: None,
        label: "Up",
        group: Group::Camera,
        about: "The up direction, instead of the scene's",
        kind: Kind::Point,
        affects: Affects::Image,
        get: |_, setup| of_point(setup.render.camera.up),
        set: |_, setup, value| setup.render.camera.up = to_point(value),
    },
    Setting {
        name: "angle",
        aliases: &[],
        symbol: None,
        label: "Angle of view",
        group: Group::Camera,
        about: "The full vertical angle of view in degrees, instead of the scene's",
        kind: Kind::Angle(Range {
            lowest: 1e-6,
            highest: 179.999_999,
            whole: false,
            unit: "degrees",
        }),
        affects: Affects::Image,
        get: |_, setup| setup.render.camera.angle.map_or(Value::Own, Value::Number),
        set: |_, setup, value| {
            setup.render.camera.angle = match value {
                Value::Own => None,
                value => Some(value.number()),
            };
        },
    },
];

const fn whole(lowest: f64, highest: f64, unit: &'static str) -> Kind {
    Kind::Number(Range {
        lowest,
        highest,
        whole: true,
        unit,
    })
}

const fn real(lowest: f64, highest: f64, unit: &'static str) -> Kind {
    Kind::Number(Range {
        lowest,
        highest,
        whole: false,
        unit,
    })
}

/// The one of some values that a choice names.
fn named<T>(
    all: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> &'static str,
    value: Value,
) -> T {
    all.into_iter()
        .find(|one| name(one) == value.choice())
        .expect("a choice is one of those that there are")
}

fn of_point(point: Option<Vec3>) -> Value {
    point.map_or(Value::Own, Value::Point)
}

fn to_point(value: Value) -> Option<Vec3> {
    match value {
        Value::Point(point) => Some(point),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Setup, setting};
    use super::*;
    use crate::structure::MaxDepth;

    #[test]
    fn names_are_unique_among_settings_and_constants() {
        let mut names: Vec<&str> = SETTINGS.iter().map(|s| s.name).collect();
        assert!(names.len() > 15);
        names.extend(SETTINGS.iter().flat_map(|s| s.aliases));
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
        for constant in Method::all().flat_map(|m| m.info().constants) {
            let taken = SETTINGS.iter().any(|s| s.name == constant.name);
            assert!(!taken, "{}", constant.name);
        }
    }

    #[test]
    fn values_are_read_as_they_are_written_and_wrong_ones_are_refused() {
        for method in Method::all() {
            let mut setup = Setup::default();
            setup.build.method = method;
            for setting in setup.settings() {
                let text = setting.text(&setup);
                let value = setting.parse(&text);
                assert_eq!(value, Ok(setting.value(&setup)), "{}", setting.name);
                assert!(setting.is_default(&setup), "{}", setting.name);
                for wrong in ["", "?", "nan"] {
                    assert!(setting.parse(wrong).is_err(), "{} {wrong}", setting.name);
                }
            }
        }
    }

    #[test]
    fn lists_of_values_are_read() {
        let list = |name: &str, text: &str| setting(name).unwrap().parse_list(text);
        let depths = [3, 4, 5, 9].map(|d| Value::Depth(MaxDepth::Fixed(d)));
        assert_eq!(list("d-max", "3..5, 9"), Ok(depths.to_vec()));
        let auto = Value::Depth(MaxDepth::Automatic);
        assert_eq!(list("d-max", "auto"), Ok(vec![auto]));
        let both = ["f32", "f64"].map(Value::Choice).to_vec();
        assert_eq!(list("precision", "f32,f64"), Ok(both));
        let numbers = [0.0, 0.001].map(Value::Number).to_vec();
        assert_eq!(list("root-margin", "0,0.001"), Ok(numbers));
        let auto_and_number = [Value::Automatic, Value::Number(0.5)].to_vec();
        assert_eq!(list("root-margin", "auto,0.5"), Ok(auto_and_number));
        assert_eq!(list("from", "0,1,2;3,4,5").unwrap().len(), 2);
        for wrong in ["", "5..3", "1,,2", "x", "2,1..3", "101"] {
            assert!(list("d-max", wrong).is_err(), "{wrong}");
        }
    }
}
