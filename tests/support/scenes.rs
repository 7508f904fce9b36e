//! Scenes, trees and render settings.

use bspscope::geometry::Vec3;
use bspscope::primitive::Primitive;
use bspscope::progress::Progress;
use bspscope::scene::{Camera, Material, Scene, SceneParts, SceneRequest, load};
use bspscope::structure::{BuildSettings, Method, Tree, build};
use bspscope::trace::RenderSettings;
use std::path::{Path, PathBuf};

/// Returns the scene of a generator, such as `tetra:3`, or of a file.
pub fn scene(source: &str) -> Scene {
    load(&SceneRequest::parse(source), &Progress::new()).unwrap()
}

/// Returns the path of a file in `scenes`, by its name without extension.
pub fn scene_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.nff"))
}

/// Returns the scene of a file in `scenes`, by its name without extension.
pub fn scene_file(name: &str) -> Scene {
    scene(scene_path(name).to_str().unwrap())
}

/// Returns the names of all scene files, without extension.
pub fn scene_names() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "nff"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert!(names.len() >= 4, "scenes are missing: {names:?}");
    names
}

/// Returns the path of a file in `tests/assets`.
pub fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/assets")
        .join(name)
}

/// Returns a scene of these objects without lights.
pub fn scene_of(objects: Vec<Primitive>) -> Scene {
    Scene::new(SceneParts {
        name: "objects".into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera: Camera {
            from: Vec3::new(9.0, 8.0, 7.0),
            at: Vec3::ZERO,
            up: Vec3::Z,
            angle: 45.0,
            near: 1.0,
            resolution: [8, 8],
        },
        notes: Vec::new(),
    })
}

/// Returns the default settings of a method.
pub fn settings(method: &str) -> BuildSettings {
    BuildSettings::for_method(Method::named(method).unwrap())
}

pub fn tree_with(scene: &Scene, settings: &BuildSettings) -> Tree {
    build(scene, settings, &Progress::new()).unwrap()
}

/// Builds a tree with a method's default settings.
pub fn tree_by(scene: &Scene, method: &str) -> Tree {
    tree_with(scene, &settings(method))
}

/// Returns settings for pictures of this size from the scene's camera.
pub fn render_sized(scene: &Scene, [width, height]: [u32; 2]) -> RenderSettings {
    RenderSettings {
        width,
        height,
        ..RenderSettings::for_camera(*scene.camera())
    }
}
