//! glTF 2.0 and its binary form GLB (Khronos Group, glTF 2.0 Specification, 2021).
//!
//! Reads the meshes of the file's scene with the transformations of its nodes, the first
//! perspective camera and base colors. Buffers can be in the file, in data URIs, or in files in its
//! folder or below. These extensions are read:
//!
//! | extension | meaning |
//! |---|---|
//! | `EXT_mesh_gpu_instancing` | copies of a mesh |
//! | `KHR_node_visibility` | hidden nodes |
//! | `KHR_mesh_quantization` | coordinates in small integers |
//! | `KHR_lights_punctual` | lights |
//! | `KHR_materials_pbrSpecularGlossiness` | diffuse and specular color |
//! | `KHR_materials_transmission`, `KHR_materials_ior` | glass |
//!
//! Textures, vertex colors, emission, lines, points, orthographic cameras, animations, skins and
//! all other extensions are skipped and named in the load report. A file that requires an extension
//! which changes the geometry, such as mesh compression, is refused.
//!
//! Every index and range in the JSON is checked where it is used.

mod accessor;
mod buffers;
mod container;
mod extensions;
mod json;
mod lights;
mod material;
mod meshes;
mod nodes;

use super::builder::SceneBuilder;
use super::complete;
use super::entry::Format;
use super::error::ReadError;
use super::input::Input;
use super::place::Place;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::camera::Camera;
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;
use json::{Head, Root};

pub(super) const FORMAT: Format = Format {
    name: "gltf",
    about: "glTF 2.0, as JSON or binary (GLB)",
    extensions: &["gltf", "glb"],
    recognizes: |bytes| container::is_binary(bytes) || container::is_json(bytes),
    read,
    write: None,
};

/// Maximum number of objects in the JSON: each can take a hundred times its text in memory.
const MAX_JSON_OBJECTS: usize = 1 << 21;

fn read(input: &Input<'_>, progress: &Progress) -> Result<SceneParts, ReadError> {
    let (json, binary) = container::split(input.bytes)?;
    progress.check()?;
    let root = parse(json)?;
    extensions::refuse_required(&root)?;
    let buffers = buffers::load(&root, binary, input, &progress.part(0.0, 0.1))?;
    let mut builder = SceneBuilder::default();
    if root.asset.version().is_none() {
        let text = "no version in the file; reading it as glTF 2.0";
        builder.notes.push(Note::new(NoteKind::Defaulted, text));
    }
    extensions::note_ignored(&root, &mut builder);
    note_skipped(&root, &mut builder);
    let placed = nodes::collect(&root, &mut builder, progress)?;
    meshes::read(
        &root,
        &buffers,
        &placed.meshes,
        &mut builder,
        &progress.part(0.1, 1.0),
    )?;
    let bounds = builder.bounds();
    let center = if bounds.is_empty() {
        Vec3::ZERO
    } else {
        bounds.center()
    };
    if let Some(placed) = &placed.camera {
        builder.camera = camera(placed, center);
    }
    lights::add(&placed.lights, &bounds, &mut builder);
    Ok(builder.finish_mesh(Vec3::Y))
}

fn parse(json: &[u8]) -> Result<Root, ReadError> {
    let start = Place::Line(1);
    let objects = json.iter().filter(|b| **b == b'{').count();
    if objects > MAX_JSON_OBJECTS {
        let most = format_args!("at most {MAX_JSON_OBJECTS} JSON objects");
        return Err(ReadError::at(start, most, objects));
    }
    super::lines::refuse_wide_text(json)?;
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let other_version = |asset: &json::Asset| {
        let version = asset
            .version()
            .filter(|version| !version.starts_with('2'))?;
        let version = super::lines::quoted(version.as_bytes());
        let found = format!("glTF {}", version.trim_matches('\''));
        Some(ReadError::at(start, container::VERSION_2, found))
    };
    let root: Root = serde_json::from_slice(json).map_err(|error| {
        // Other versions have another structure.
        let head: Result<Head, _> = serde_json::from_slice(json);
        let other = head.ok().and_then(|head| other_version(&head.asset));
        let line = Place::Line(error.line().max(1));
        other.unwrap_or_else(|| ReadError::at(line, "the JSON of a glTF file", error))
    })?;
    match other_version(&root.asset) {
        Some(error) => Err(error),
        None => Ok(root),
    }
}

fn note_skipped(root: &Root, builder: &mut SceneBuilder) {
    for (what, count) in [
        ("animation", root.animations.len()),
        ("skin", root.skins.len()),
    ] {
        let text = format!("{what}; using the mesh in its rest pose");
        for number in 0..count {
            builder.note(NoteKind::Skipped, &text, Place::Element(what, number));
        }
    }
}

/// Converts a camera; it looks at the point on its line of sight that is nearest to the center of
/// the scene.
fn camera(placed: &nodes::PlacedCamera, center: Vec3) -> Option<Camera> {
    let near = placed.near.max(f64::MIN_POSITIVE);
    let distance = (center - placed.from).dot(placed.forward).max(near);
    let width = f64::from(complete::RESOLUTION) * placed.aspect.clamp(0.1, 10.0);
    let camera = Camera {
        from: placed.from,
        at: placed.from + distance * placed.forward,
        up: placed.up,
        angle: placed.angle,
        near,
        resolution: [width.round() as u32, complete::RESOLUTION],
    };
    camera.frame().is_ok().then_some(camera)
}
