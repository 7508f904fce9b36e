//! Cases about settings at the ends of their ranges.

use super::case::Case;
use super::scenes::{aims, base, polygon, scene_of, sphere};
use super::trial::{Outcome, Trial};
use crate::geometry::Vec3;
use crate::measure::unsplit;
use crate::scene::{Camera, CameraError, Material, Scene, SceneParts};
use crate::structure::{BuildSettings, MaxDepth, Tree, build};
use crate::trace::{
    Picture, RenderError, RenderSettings, TimedRender, render_counted, render_timed, thread_pool,
};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

pub const CASES: &[Case] = &[
    Case {
        name: "D_MAX 0, 1 and 100",
        rule: "right hits, or the error that names the memory limit",
        any_scene: true,
        run: depths,
    },
    Case {
        name: "N_OILF 0 and above N_O",
        rule: "right hits; above N_O one leaf",
        any_scene: true,
        run: leaf_sizes,
    },
    Case {
        name: "D_AREC 0 and 64",
        rule: "inside a box of mirrors: no secondary ray, and 64 for every pixel; the picture of \
               testing every object, bit by bit",
        any_scene: false,
        run: mirrors,
    },
    Case {
        name: "no lights",
        rule: "no shadow ray; the picture of testing every object, bit by bit",
        any_scene: true,
        run: no_lights,
    },
    Case {
        name: "camera inside an object",
        rule: "the picture of testing every object, bit by bit; no pixel sees the background",
        any_scene: false,
        run: inside,
    },
    Case {
        name: "cameras without a view",
        rule: "from = at, an angle of 0 and of 180: refused with the reason",
        any_scene: true,
        run: no_view,
    },
    Case {
        name: "1 x 1 pixel",
        rule: "the picture of testing every object, bit by bit",
        any_scene: true,
        run: one_pixel,
    },
    Case {
        name: "8192 x 8192 pixels",
        rule: "every pixel traced once, while physical memory grows by less than 1 GiB; 16385 pixels \
               a side are refused (a quick run traces 512 x 512)",
        any_scene: false,
        run: large_picture,
    },
];

fn depths(trial: &Trial<'_>) -> Outcome {
    let scene = base(trial);
    let rays = aims(&scene, trial.rays(&scene));
    Outcome::all([0, 1, MaxDepth::LIMIT].map(|depth| {
        let settings = BuildSettings {
            d_max: MaxDepth::Fixed(depth),
            memory_limit: if trial.quick { 16 << 20 } else { 256 << 20 },
            ..trial.settings()
        };
        match build(&scene, &settings, trial.progress) {
            Ok(tree) if tree.depth_reached() <= depth || !trial.method.has_limits => {
                trial.check_tree(&scene, &tree, &rays)
            }
            Ok(tree) => Outcome::fail(format!("a leaf at depth {}", tree.depth_reached())),
            Err(error) if error.is_too_large() => Outcome::Pass { rays: 0 },
            Err(error) => Outcome::fail(error.to_string()),
        }
        .of(&format!("D_MAX {depth}"))
    }))
}

fn leaf_sizes(trial: &Trial<'_>) -> Outcome {
    let scene = base(trial);
    let rays = aims(&scene, trial.rays(&scene));
    let above = scene.objects().len() as u32 + 1;
    Outcome::all([0, above, u32::MAX].map(|n_oilf| {
        let settings = BuildSettings {
            n_oilf,
            d_max: MaxDepth::Fixed(12),
            ..trial.settings()
        };
        let outcome = match trial.tree(&scene, &settings) {
            Ok(tree) if n_oilf >= above && tree.nodes().len() != 1 && tree.voxels().is_none() => {
                Outcome::fail("more than one leaf")
            }
            Ok(tree) => trial.check_tree(&scene, &tree, &rays),
            Err(outcome) => outcome,
        };
        outcome.of(&format!("N_OILF {n_oilf}"))
    }))
}

/// Returns the settings of a small picture.
fn small(scene: &Scene, side: u32) -> RenderSettings {
    RenderSettings {
        width: side,
        height: side,
        threads: 1,
        ..RenderSettings::for_camera(*scene.camera())
    }
}

fn render_picture(
    trial: &Trial<'_>,
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
) -> Result<Picture, RenderError> {
    let pool = thread_pool(settings.threads)?;
    let picture = Mutex::new(Picture::new(settings.width, settings.height));
    render_timed(
        scene,
        tree,
        settings,
        0,
        &pool,
        trial.progress,
        |tile, colors| {
            let mut picture = picture.lock().unwrap_or_else(PoisonError::into_inner);
            picture.add_tile(tile, 0, colors);
        },
    )?;
    Ok(picture.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Checks that the method's tree yields the same picture as testing every object, and that `right`
/// accepts the picture.
fn same_picture(
    trial: &Trial<'_>,
    scene: &Scene,
    settings: &RenderSettings,
    right: impl Fn(&Picture) -> Result<(), String>,
) -> Outcome {
    let tree = match trial.tree(scene, &trial.settings()) {
        Ok(tree) => tree,
        Err(outcome) => return outcome,
    };
    let everything = match unsplit(scene, trial.progress) {
        Ok(tree) => tree,
        Err(error) => return Outcome::fail(error.to_string()),
    };
    let pictures = (
        render_picture(trial, scene, &tree, settings),
        render_picture(trial, scene, &everything, settings),
    );
    match pictures {
        (Ok(found), Ok(expected)) if found == expected => match right(&found) {
            Ok(()) => Outcome::Pass {
                rays: found.pixels().len() as u64,
            },
            Err(reason) => Outcome::fail(reason),
        },
        (Ok(_), Ok(_)) => Outcome::fail("another picture than by testing every object"),
        (Err(error), _) | (_, Err(error)) => Outcome::fail(error.to_string()),
    }
}

fn all_finite(picture: &Picture) -> Result<(), String> {
    let finite = picture.pixels().iter().flatten().all(|x| x.is_finite());
    finite
        .then_some(())
        .ok_or_else(|| "a color is not a number".to_owned())
}

/// Returns a camera inside a box of mirrors around the origin.
fn mirrored_box() -> Scene {
    let mut sides = Vec::new();
    for axis in 0..3 {
        for end in [-1.0, 1.0] {
            let corner = |x: f64, y: f64| {
                let mut v = [0.0; 3];
                v[axis] = end;
                v[(axis + 1) % 3] = x;
                v[(axis + 2) % 3] = y;
                v
            };
            let corners = [
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ];
            sides.push(polygon(&corners));
        }
    }
    let scene = scene_of(sides);
    Scene::new(SceneParts {
        materials: vec![Material {
            specular: 1.0,
            ..Material::default()
        }],
        camera: Camera {
            from: Vec3::new(0.1, 0.2, 0.3),
            at: Vec3::new(0.9, 0.4, 0.2),
            ..*scene.camera()
        },
        ..scene.parts().clone()
    })
}

fn mirrors(trial: &Trial<'_>) -> Outcome {
    let scene = mirrored_box();
    let side = if trial.quick { 16 } else { 64 };
    Outcome::all([0, 64].map(|d_arec| {
        let settings = RenderSettings {
            d_arec,
            ..small(&scene, side)
        };
        let counted = (|| {
            let tree = trial.tree(&scene, &trial.settings())?;
            let failed = |error: RenderError| Outcome::fail(error.to_string());
            let pool = thread_pool(1).map_err(failed)?;
            let pass = render_counted(&scene, &tree, &settings, &pool, trial.progress, |_| ());
            let reflected = pass.map_err(failed)?.tallies[2].rays;
            let expected = u64::from(side * side * d_arec);
            Ok(Outcome::check(reflected == expected, || {
                format!("{reflected} reflected rays, expected {expected}")
            }))
        })();
        let counted = counted.unwrap_or_else(|outcome: Outcome| outcome);
        Outcome::all([counted, same_picture(trial, &scene, &settings, all_finite)])
            .of(&format!("D_AREC {d_arec}"))
    }))
}

fn no_lights(trial: &Trial<'_>) -> Outcome {
    let scene = base(trial);
    let dark = Scene::new(SceneParts {
        lights: Vec::new(),
        ..scene.parts().clone()
    });
    let settings = small(&dark, if trial.quick { 12 } else { 48 });
    Outcome::all([
        Outcome::check(!dark.requirements().casts_shadows, || {
            "shadow rays without a light".to_owned()
        }),
        same_picture(trial, &dark, &settings, all_finite),
    ])
}

fn inside(trial: &Trial<'_>) -> Outcome {
    let scene = scene_of(vec![sphere(Vec3::ZERO, 1.0), sphere(Vec3::splat(0.2), 0.1)]);
    let scene = Scene::new(SceneParts {
        background: Vec3::splat(1e6),
        camera: Camera {
            from: Vec3::new(-0.5, 0.0, 0.1),
            at: Vec3::ZERO,
            angle: 120.0,
            ..*scene.camera()
        },
        ..scene.parts().clone()
    });
    let settings = small(&scene, if trial.quick { 24 } else { 128 });
    same_picture(trial, &scene, &settings, |picture| {
        all_finite(picture)?;
        let leaks = picture.pixels().iter().flatten().any(|&x| x > 1e5);
        (!leaks)
            .then_some(())
            .ok_or_else(|| "the background shows through the sphere".to_owned())
    })
}

fn no_view(trial: &Trial<'_>) -> Outcome {
    let scene = base(trial);
    let camera = *scene.camera();
    let at_itself = Camera {
        at: camera.from,
        ..camera
    };
    let angle = |angle: f64| Camera { angle, ..camera };
    let cases = [
        (at_itself, CameraError::NoDirection),
        (angle(0.0), CameraError::Angle(0.0)),
        (angle(180.0), CameraError::Angle(180.0)),
    ];
    Outcome::all(cases.map(|(camera, expected)| {
        let settings = RenderSettings {
            camera: camera.into(),
            ..small(&scene, 4)
        };
        let found = settings.view(&scene).err();
        Outcome::check(found == Some(RenderError::Camera(expected)), || {
            format!("expected '{expected}', found {found:?}")
        })
    }))
}

fn one_pixel(trial: &Trial<'_>) -> Outcome {
    let scene = base(trial);
    same_picture(trial, &scene, &small(&scene, 1), all_finite)
}

fn large_picture(trial: &Trial<'_>) -> Outcome {
    const MOST_GROWTH: usize = 1 << 30;
    let scene = scene_of(vec![sphere(Vec3::ZERO, 1.0)]);
    let side = if trial.quick { 512 } else { 8192 };
    let refused = small(&scene, 16_385).view(&scene).err();
    let tree = match trial.tree(&scene, &trial.settings()) {
        Ok(tree) => tree,
        Err(outcome) => return outcome,
    };
    let memory = || memory_stats::memory_stats().map_or(0, |m| m.physical_mem);
    let (before, most) = (memory(), AtomicUsize::new(0));
    let (pixels, tiles) = (AtomicU64::new(0), AtomicU64::new(0));
    let pass: Result<TimedRender, RenderError> = thread_pool(1).and_then(|pool| {
        render_timed(
            &scene,
            &tree,
            &small(&scene, side),
            0,
            &pool,
            trial.progress,
            |_, colors| {
                pixels.fetch_add(colors.len() as u64, Ordering::Relaxed);
                if tiles.fetch_add(1, Ordering::Relaxed) % 256 == 0 {
                    most.fetch_max(memory(), Ordering::Relaxed);
                }
            },
        )
    });
    if let Err(error) = pass {
        return Outcome::fail(error.to_string());
    }
    let (pixels, growth) = (
        pixels.into_inner(),
        most.into_inner().saturating_sub(before),
    );
    Outcome::all([
        Outcome::check(
            matches!(refused, Some(RenderError::Resolution { .. })),
            || "16385 pixels a side are accepted".to_owned(),
        ),
        Outcome::check(pixels == u64::from(side) * u64::from(side), || {
            format!("{pixels} pixels came")
        }),
        Outcome::check(growth < MOST_GROWTH, || {
            format!("memory grew by {} MiB", growth >> 20)
        }),
        Outcome::Pass { rays: pixels },
    ])
}
