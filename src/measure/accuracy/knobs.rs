//! What can be turned to trade accuracy for speed. A knob is one function and one line in [`KNOBS`].

use crate::scene::{Cylinders, Scene, SceneRequest};
use crate::setup::Setup;
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
    pub values: fn(&Setup, &Scene) -> Vec<(String, Setup)>,
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
        values: min_contribution,
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

fn with_render(at: &Setup, words: String, render: RenderSettings) -> (String, Setup) {
    (
        words,
        Setup {
            render,
            ..at.clone()
        },
    )
}

fn with_build(at: &Setup, words: String, build: BuildSettings) -> (String, Setup) {
    (
        words,
        Setup {
            build,
            ..at.clone()
        },
    )
}

fn precision(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn samples(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn d_arec(at: &Setup, scene: &Scene) -> Vec<(String, Setup)> {
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

fn min_contribution(at: &Setup, scene: &Scene) -> Vec<(String, Setup)> {
    if scene.requirements().secondary_depth(at.render.d_arec) == 0 {
        return Vec::new();
    }
    [0.01, 0.05, 0.2]
        .into_iter()
        .map(|min_contribution| {
            let render = RenderSettings {
                min_contribution,
                ..at.render
            };
            with_render(at, min_contribution.to_string(), render)
        })
        .collect()
}

fn cylinders(at: &Setup, scene: &Scene) -> Vec<(String, Setup)> {
    use crate::primitive::PrimitiveKind::Cone;
    let primitives = &scene.requirements().primitives;
    if primitives.iter().all(|&(kind, _)| kind != Cone) {
        return Vec::new();
    }
    [64, 20, 10, 6]
        .into_iter()
        .map(|sides| {
            let setup = Setup {
                scene: SceneRequest {
                    cylinders: Cylinders::Polygons(sides),
                    ..at.scene.clone()
                },
                ..at.clone()
            };
            (format!("{sides} polygons"), setup)
        })
        .collect()
}

fn resolution(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn kernel(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn method(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn d_max(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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

fn n_oilf(at: &Setup, _: &Scene) -> Vec<(String, Setup)> {
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
