//! glTF 2.0 and its binary form GLB (Khronos Group, glTF 2.0 Specification, 2021).
//!
//! Read are the meshes of the file's scene as its nodes place them, perspective cameras, base
//! colours and the lights of `KHR_lights_punctual`. Buffers are in the file, in data URIs, or in
//! files in its folder or below. Not read, and counted: textures, lines and points, orthographic
//! cameras, animations, skins and sparse accessors.
//!
//! `gltf-json` turns the JSON into structures; every index and range in it is checked here where
//! it is used.

mod accessor;
mod buffers;
mod container;
mod lights;
mod material;
mod meshes;
mod nodes;

use super::complete;
use super::entry::Format;
use super::error::ReadError;
use super::gather::Gatherer;
use super::input::Input;
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::camera::Camera;
use crate::scene::note::NoteKind;
use crate::scene::parts::SceneParts;
use gltf_json::Root;

pub(super) const FORMAT: Format = Format {
    name: "gltf",
    about: "glTF 2.0, as JSON or binary (GLB)",
    extensions: &["gltf", "glb"],
    recognizes: |bytes| container::is_binary(bytes) || container::is_json(bytes),
    read,
    write: None,
};

/// The most objects that the JSON may hold: each may take a hundred times its text in memory.
const MOST_JSON_OBJECTS: usize = 1 << 21;

fn read(input: &Input<'_>, progress: &Progress) -> Result<SceneParts, ReadError> {
    let (json, binary) = container::split(input.bytes)?;
    progress.check()?;
    let root = parse(json)?;
    refuse_unreadable(&root)?;
    let buffers = buffers::load(&root, binary, input, &progress.part(0.0, 0.1))?;
    let mut found = Gatherer::default();
    note_left_out(&root, &mut found);
    let placed = nodes::collect(&root, &mut found, progress)?;
    meshes::read(
        &root,
        &buffers,
        &placed.meshes,
        &mut found,
        &progress.part(0.1, 1.0),
    )?;
    let bounds = found.bounds();
    let center = if bounds.is_empty() {
        Vec3::ZERO
    } else {
        bounds.center()
    };
    if let Some(seen) = &placed.camera {
        found.camera = camera(seen, center);
    }
    lights::add(&placed.lights, &bounds, &mut found);
    Ok(found.finish_mesh(Vec3::Y))
}

fn parse(json: &[u8]) -> Result<Root, ReadError> {
    let start = Place::Line(1);
    let objects = json.iter().filter(|b| **b == b'{').count();
    if objects > MOST_JSON_OBJECTS {
        let most = format_args!("at most {MOST_JSON_OBJECTS} JSON objects");
        return Err(ReadError::at(start, most, objects));
    }
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let root: Root = gltf_json::deserialize::from_slice(json).map_err(|error| {
        let line = Place::Line(error.line().max(1));
        ReadError::at(line, "the JSON of a glTF file", error)
    })?;
    let version = &root.asset.version;
    if !version.starts_with("2.") {
        return Err(ReadError::at(
            start,
            "glTF version 2",
            format!("{version:?}"),
        ));
    }
    Ok(root)
}

/// Extensions that a file requires, and that change where its surfaces are or how they are stored,
/// cannot be passed over.
fn refuse_unreadable(root: &Root) -> Result<(), ReadError> {
    const HARMLESS: [&str; 5] = [
        "KHR_lights_punctual",
        "KHR_mesh_quantization",
        "KHR_materials_",
        "KHR_texture_",
        "EXT_texture_",
    ];
    let harmful = |name: &&String| !HARMLESS.iter().any(|known| name.starts_with(known));
    match root.extensions_required.iter().find(harmful) {
        None => Ok(()),
        Some(name) => {
            let expected = "no required extension that is not known here";
            let name = super::lines::quoted(name.as_bytes());
            Err(ReadError::at(Place::Line(1), expected, name))
        }
    }
}

fn note_left_out(root: &Root, found: &mut Gatherer) {
    for (what, count) in [
        ("animation", root.animations.len()),
        ("skin", root.skins.len()),
    ] {
        let text = format!("{what}, the mesh taken as it stands");
        for number in 0..count {
            found.note(NoteKind::Skipped, &text, Place::Element(what, number));
        }
    }
}

/// A camera that looks at the point of its axis beside the middle of the scene.
fn camera(seen: &nodes::Seen, center: Vec3) -> Option<Camera> {
    let near = seen.near.max(f64::MIN_POSITIVE);
    let distance = (center - seen.from).dot(seen.forward).max(near);
    let width = f64::from(complete::RESOLUTION) * seen.aspect.clamp(0.1, 10.0);
    let camera = Camera {
        from: seen.from,
        at: seen.from + distance * seen.forward,
        up: seen.up,
        angle: seen.angle,
        hither: near,
        resolution: [width.round() as u32, complete::RESOLUTION],
    };
    camera.frame().is_ok().then_some(camera)
}
