//! Extensions: which are read, which refuse the file, and the note on each of the rest.

use super::json::{Extensions, Root};
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::lines::quoted;
use crate::scene::format::place::Place;
use crate::scene::note::{Note, NoteKind};
use std::collections::BTreeMap;

pub(super) const LIGHTS: &str = "KHR_lights_punctual";
pub(super) const INSTANCING: &str = "EXT_mesh_gpu_instancing";
pub(super) const VISIBILITY: &str = "KHR_node_visibility";
pub(super) const SPECULAR_GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";
pub(super) const TRANSMISSION: &str = "KHR_materials_transmission";
pub(super) const INDEX_OF_REFRACTION: &str = "KHR_materials_ior";
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Extensions that are read.
const READ: [&str; 7] = [
    LIGHTS,
    INSTANCING,
    VISIBILITY,
    SPECULAR_GLOSSINESS,
    TRANSMISSION,
    INDEX_OF_REFRACTION,
    QUANTIZATION,
];

/// Prefixes of extensions that change neither the geometry nor how it is stored.
const HARMLESS: [&str; 10] = [
    "KHR_materials_",
    "EXT_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "EXT_lights_",
    "KHR_xmp",
    "KHR_node_",
    "KHR_animation_",
    "KHR_audio",
];

/// Maximum number of notes on extensions that a file declares but does not use.
const MAX_DECLARED: usize = 32;

/// Returns what compresses meshes, and how to undo it, for an extension that does so.
fn compression(name: &str) -> Option<&'static str> {
    Some(match name {
        "KHR_draco_mesh_compression" => "meshes compressed with Draco",
        "EXT_meshopt_compression" | "KHR_meshopt_compression" | "MESHOPT_compression" => {
            "meshes compressed with meshoptimizer"
        }
        _ => return None,
    })
}

/// Returns the error that meshes are compressed, if one of the extensions says so.
pub(super) fn compressed<'a>(
    names: impl IntoIterator<Item = &'a String>,
    place: Place,
) -> Option<ReadError> {
    let mut names = names.into_iter();
    let (name, what) = names.find_map(|name| Some((name, compression(name)?)))?;
    let expected = "meshes that are not compressed (export the model without compression, or \
                    decompress it, for example with 'gltf-transform copy')";
    let found = format_args!("{what} ({name})");
    Some(ReadError::at(place, expected, found))
}

/// Refuses files that require an extension which changes the geometry or how it is stored.
pub(super) fn refuse_required(root: &Root) -> Result<(), ReadError> {
    let place = Place::Line(1);
    if let Some(error) = compressed(&root.extensions_required, place) {
        return Err(error);
    }
    let is_known = |name: &&String| {
        READ.contains(&name.as_str()) || HARMLESS.iter().any(|known| name.starts_with(known))
    };
    match root.extensions_required.iter().find(|name| !is_known(name)) {
        None => Ok(()),
        Some(name) => {
            let expected = "a file that requires only supported extensions";
            let found = format_args!("the required extension {}", quoted(name.as_bytes()));
            Err(ReadError::at(place, expected, found))
        }
    }
}

/// Notes every extension that the file uses and that is not read, by name.
pub(super) fn note_ignored(root: &Root, builder: &mut SceneBuilder) {
    let mut used: BTreeMap<&str, (usize, Option<Place>)> = BTreeMap::new();
    for name in root.extensions_used.iter().chain(&root.extensions_required) {
        used.entry(name).or_default();
    }
    let mut add = |extensions: &'_ Extensions, kind: &'static str, number: usize| {
        for name in extensions.keys() {
            // The names live as long as the file.
            if let Some((count, first)) = used.get_mut(name.as_str()) {
                *count += 1;
                first.get_or_insert(Place::Element(kind, number));
            } else if !READ.contains(&name.as_str()) {
                builder.note(
                    NoteKind::Skipped,
                    &ignored(name),
                    Place::Element(kind, number),
                );
            }
        }
    };
    for (number, node) in root.nodes.iter().enumerate() {
        add(&node.extensions, "node", number);
    }
    for (number, mesh) in root.meshes.iter().enumerate() {
        for primitive in &mesh.primitives {
            add(&primitive.extensions, "mesh", number);
        }
    }
    for (number, material) in root.materials.iter().enumerate() {
        if let Some(extensions) = material.get("extensions").and_then(|e| e.as_object()) {
            add(extensions, "material", number);
        }
    }
    for (number, view) in root.buffer_views.iter().enumerate() {
        add(&view.extensions, "buffer view", number);
    }
    let mut declared = 0;
    for (name, (count, first)) in used {
        if READ.contains(&name) {
            continue;
        }
        if let Some(first) = first {
            builder.note_times(NoteKind::Skipped, &ignored(name), count, first);
        } else if declared < MAX_DECLARED {
            declared += 1;
            let note = Note::new(NoteKind::Skipped, ignored(name));
            builder.notes.push(note);
        }
    }
}

fn ignored(name: &str) -> String {
    format!(
        "extension {}, which is not supported",
        quoted(name.as_bytes())
    )
}
