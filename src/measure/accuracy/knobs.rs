//! What can be turned to trade accuracy for speed. A knob is one function and one line in [`KNOBS`].

use super::Setting;
use crate::scene::{Cylinders, Scene};
use crate::structure::{BuildSettings, MaxDepth, Method};
use crate::trace::{KernelChoice, PrecisionChoice, RenderSettings};

/// One choice that costs or saves time.
pub struct Knob {
    /// One word or two, such as `samples`.
    pub name: &'static str,
    pub about: &'static str,
    /// Whether it changes the picture, or its time only.
    pub moves_image: bool,
    /// Its other values at a reference for a scene with exact cylinders, from dear to cheap, each in
    /// words; empty where the scene has nothing to turn.
    pub values: fn(&Setting, &Scene) -> Vec<(String, Setting)>,
}

/// All knobs, in the order of reports.
pub static KNOBS: &[Knob] = &[
    Knob {
        name: "precision",
        about: "numbers that rays are traced in",
        moves_image: true,
        values: precision,
    },
    Knob {
        name: "samples",
        about: "samples a pixel",
        moves_image: true,
        values: samples,
    },
    Knob {
        name: "D_AREC",
        about: "how deep secondary rays go",
        moves_image: true,
        values: d_arec,
    },
    Knob {
        name: "cut-off",
        about: "least weight of a secondary ray",
        moves_image: true,
        values: cut_off,
    },
    Knob {
        name: "cylinders",
        about: "polygons a cylinder",
        moves_image: true,
        values: cylinders,
    },
    Knob {
        name: "resolution",
        about: "pixels of the picture, each shown as a square of the reference's",
        moves_image: true,
        values: resolution,
    },
    Knob {
        name: "kernel",
        about: "how rays traverse the tree: one by one, as a SIMD stream, or in SIMD packets",
        moves_image: false,
        values: kernel,
    },
    Knob {
        name: "method",
        about: "how the tree is built",
        moves_image: false,
        values: method,
    },
    Knob {
        name: "D_MAX",
        about: "greatest depth of the tree",
        moves_image: false,
        values: d_max,
    },
    Knob {
        name: "N_OILF",
        about: "objects that make a cell a leaf",
        moves_image: false,
        values: n_oilf,
    },
];

fn with_render(at: &Setting, words: String, render: RenderSettings) -> (String, Setting) {
    (
        words,
        Setting {
            render,
            ..at.clone()
        },
    )
}

fn with_build(at: &Setting, words: String, build: BuildSettings) -> (String, Setting) {
    (
        words,
        Setting {
            build,
            ..at.clone()
        },
    )
}

fn precision(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    let precision = PrecisionChoice::F32;
    vec![with_render(
        at,
        precision.name().into(),
        RenderSettings {
            precision,
            ..at.render
        },
    )]
}

fn samples(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    let fewer = [at.render.samples / 4, 1];
    let fewer = fewer.into_iter().enumerate();
    fewer
        .filter(|&(i, samples)| samples < at.render.samples && samples > u32::from(i == 0))
        .map(|(_, samples)| {
            let render = RenderSettings {
                samples,
                ..at.render
            };
            with_render(at, samples.to_string(), render)
        })
        .collect()
}

fn d_arec(at: &Setting, scene: &Scene) -> Vec<(String, Setting)> {
    let deepest = scene.requirements().secondary_depth(at.render.d_arec);
    [4, 2, 1, 0]
        .into_iter()
        .filter(|&depth| depth < deepest)
        .map(|d_arec| {
            let render = RenderSettings {
                d_arec,
                ..at.render
            };
            with_render(at, d_arec.to_string(), render)
        })
        .collect()
}

fn cut_off(at: &Setting, scene: &Scene) -> Vec<(String, Setting)> {
    if scene.requirements().secondary_depth(at.render.d_arec) == 0 {
        return Vec::new();
    }
    [0.01, 0.05, 0.2]
        .into_iter()
        .map(|cut_off| {
            let render = RenderSettings {
                cut_off,
                ..at.render
            };
            with_render(at, cut_off.to_string(), render)
        })
        .collect()
}

fn cylinders(at: &Setting, scene: &Scene) -> Vec<(String, Setting)> {
    use crate::primitive::PrimitiveKind::Cone;
    let primitives = &scene.requirements().primitives;
    if primitives.iter().all(|&(kind, _)| kind != Cone) {
        return Vec::new();
    }
    [64, 20, 10, 6]
        .into_iter()
        .map(|sides| {
            let setting = Setting {
                cylinders: Cylinders::Polygons(sides),
                ..at.clone()
            };
            (format!("{sides} polygons"), setting)
        })
        .collect()
}

fn resolution(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    [2, 4]
        .into_iter()
        .map(|by| {
            let render = RenderSettings {
                width: at.render.width.div_ceil(by),
                height: at.render.height.div_ceil(by),
                ..at.render
            };
            let words = format!("{} × {}", render.width, render.height);
            with_render(at, words, render)
        })
        .collect()
}

fn kernel(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    [
        KernelChoice::Scalar,
        KernelChoice::Stream,
        KernelChoice::Packets,
    ]
    .into_iter()
    .filter(|kernel| kernel.simd() != at.render.kernel.simd())
    .map(|kernel| {
        let render = RenderSettings {
            kernel,
            ..at.render
        };
        with_render(at, kernel.name().into(), render)
    })
    .collect()
}

fn method(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    Method::all()
        .filter(|m| m.name != at.build.method.name && m.name != "none")
        .map(|method| {
            let build = BuildSettings {
                constants: Default::default(),
                method,
                ..at.build.clone()
            };
            with_build(at, method.name.into(), build)
        })
        .collect()
}

fn d_max(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    [12, 16, 24]
        .map(MaxDepth::Fixed)
        .into_iter()
        .filter(|&depth| depth != at.build.d_max)
        .map(|d_max| {
            let build = BuildSettings {
                d_max,
                ..at.build.clone()
            };
            with_build(at, d_max.to_string(), build)
        })
        .collect()
}

fn n_oilf(at: &Setting, _: &Scene) -> Vec<(String, Setting)> {
    [1, 4, 8]
        .into_iter()
        .filter(|&n| n != at.build.n_oilf)
        .map(|n_oilf| {
            let build = BuildSettings {
                n_oilf,
                ..at.build.clone()
            };
            with_build(at, n_oilf.to_string(), build)
        })
        .collect()
}
