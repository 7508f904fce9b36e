//! Conversion of materials: base color, metal and glass.

use super::extensions::{INDEX_OF_REFRACTION, SPECULAR_GLOSSINESS, TRANSMISSION};
use super::json::Fields;
use crate::geometry::Vec3;
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::place::Place;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use serde_json::Value;

/// A material of a file, converted.
#[derive(Clone, Copy)]
pub(super) struct Converted {
    pub material: Material,
    /// Whether its alpha mask hides every surface of this material.
    pub is_hidden: bool,
}

/// The color and reflection of a surface.
struct Look {
    color: [f64; 4],
    specular: f64,
    roughness: f64,
}

/// Converts all materials, with notes on what has no equivalent here.
pub(super) fn all(materials: &[Value], builder: &mut SceneBuilder) -> Vec<Converted> {
    let convert = |(number, material)| of(material, Place::Element("material", number), builder);
    materials.iter().enumerate().map(convert).collect()
}

/// Converts a glTF material to the nearest NFF material: the color is the base color, `Ks` is
/// metalness times smoothness, and `T` is the transmission or, for a blended surface, 1 − alpha.
/// Fields that cannot be read have their default value.
fn of(material: &Value, place: Place, builder: &mut SceneBuilder) -> Converted {
    let mut fields = Fields::of(Some(material));
    let extensions = fields.inner("extensions");
    let mut unreadable = std::mem::take(&mut fields.unreadable);
    let mut textures = 0;
    let (look, base_texture) = if extensions.has(SPECULAR_GLOSSINESS) {
        let mut inner = extensions.inner(SPECULAR_GLOSSINESS);
        let look = specular_glossiness(&mut inner);
        textures += usize::from(inner.has("specularGlossinessTexture"));
        unreadable.append(&mut inner.unreadable);
        (look, inner.has("diffuseTexture"))
    } else {
        let mut inner = fields.inner("pbrMetallicRoughness");
        let look = metallic_roughness(&mut inner);
        textures += usize::from(inner.has("metallicRoughnessTexture"));
        unreadable.append(&mut inner.unreadable);
        (look, inner.has("baseColorTexture"))
    };
    let others = ["normalTexture", "occlusionTexture", "emissiveTexture"];
    textures += usize::from(base_texture);
    textures += others.into_iter().filter(|name| fields.has(name)).count();
    builder.note_times(NoteKind::Skipped, "texture", textures, place);

    let emission = fields.numbers("emissiveFactor", [0.0; 3]);
    if emission.iter().any(|part| *part > 0.0) {
        let text = "emissive color (surfaces do not emit light here)";
        builder.note(NoteKind::Skipped, text, place);
    }
    let [r, g, b, alpha] = look.color;
    let mode = fields.text("alphaMode");
    let cutoff = fields.number("alphaCutoff", 0.5);
    let is_masked = mode == Some("MASK");
    if is_masked && base_texture {
        let text = "alpha mask of a texture; using the whole surface";
        builder.note(NoteKind::Skipped, text, place);
    }
    let mut inner = extensions.inner(TRANSMISSION);
    let transmitted = inner.number("transmissionFactor", 0.0).clamp(0.0, 1.0);
    unreadable.append(&mut inner.unreadable);
    let seen_through = match mode {
        Some("BLEND") => 1.0 - alpha.clamp(0.0, 1.0),
        _ => 0.0,
    };
    let transmittance = seen_through.max(transmitted);
    let mut inner = extensions.inner(INDEX_OF_REFRACTION);
    // Alpha blending does not refract.
    let index = inner.number("ior", if transmitted > 0.0 { 1.5 } else { 1.0 });
    unreadable.append(&mut inner.unreadable);
    unreadable.append(&mut fields.unreadable);
    for name in unreadable {
        let text = format!("{name} of a material, which cannot be read; using the default");
        builder.note(NoteKind::Changed, &text, place);
    }
    Converted {
        material: Material {
            color: Vec3::new(r, g, b),
            diffuse: (1.0 - transmittance) * (1.0 - look.specular),
            specular: look.specular,
            // The usual Blinn exponent for squared roughness.
            shine: (2.0 / look.roughness.max(0.05).powi(4) - 2.0).max(0.0),
            transmittance,
            index_of_refraction: if index >= 1.0 { index } else { 1.0 },
        },
        is_hidden: is_masked && !base_texture && alpha < cutoff,
    }
}

fn metallic_roughness(fields: &mut Fields<'_>) -> Look {
    let color = fields.numbers("baseColorFactor", [1.0; 4]);
    let roughness = fields.number("roughnessFactor", 1.0).clamp(0.0, 1.0);
    let metalness = fields.number("metallicFactor", 1.0).clamp(0.0, 1.0);
    Look {
        color,
        specular: metalness * (1.0 - roughness),
        roughness,
    }
}

/// Reads `KHR_materials_pbrSpecularGlossiness`. A file that leaves out the specular color gets a
/// matte surface: with the default of the extension, white, it would be a perfect mirror without a
/// color of its own.
fn specular_glossiness(fields: &mut Fields<'_>) -> Look {
    let color = fields.numbers("diffuseFactor", [1.0; 4]);
    let glossiness = fields.number("glossinessFactor", 1.0).clamp(0.0, 1.0);
    let specular: f64 = match fields.has("specularFactor") {
        true => fields.numbers("specularFactor", [0.0; 3]).iter().sum(),
        false => 0.0,
    };
    Look {
        color,
        specular: (specular / 3.0).clamp(0.0, 1.0) * glossiness,
        roughness: 1.0 - glossiness,
    }
}
