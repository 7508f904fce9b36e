//! Conversion of materials: base color, metal and glass.

use crate::geometry::Vec3;
use crate::scene::material::Material;
use gltf_json::material::AlphaMode;
use gltf_json::validation::Checked;

/// Converts a glTF material to the nearest NFF material: the color is the base color, `Ks` is
/// metalness times smoothness, and `T` is the transmission or, for a blended surface, 1 − alpha.
pub(super) fn of(material: &gltf_json::Material) -> Material {
    let pbr = &material.pbr_metallic_roughness;
    let [r, g, b, alpha] = pbr.base_color_factor.0.map(f64::from);
    let share = |factor: f32| f64::from(factor).clamp(0.0, 1.0);
    let roughness = share(pbr.roughness_factor.0);
    let specular = share(pbr.metallic_factor.0) * (1.0 - roughness);
    let extensions = material.extensions.as_ref();
    let transmission = extensions.and_then(|e| e.transmission.as_ref());
    let transmitted = transmission.map_or(0.0, |t| share(t.transmission_factor.0));
    let blended = material.alpha_mode == Checked::Valid(AlphaMode::Blend);
    let seen_through = if blended {
        1.0 - alpha.clamp(0.0, 1.0)
    } else {
        0.0
    };
    let transmittance = seen_through.max(transmitted);
    // Alpha blending does not refract.
    let index = match extensions.and_then(|e| e.ior.as_ref()) {
        Some(ior) => f64::from(ior.ior.0),
        None if transmitted > 0.0 => 1.5,
        None => 1.0,
    };
    Material {
        color: Vec3::new(r, g, b),
        diffuse: (1.0 - transmittance) * (1.0 - specular),
        specular,
        // The usual Blinn exponent for squared roughness.
        shine: (2.0 / roughness.max(0.05).powi(4) - 2.0).max(0.0),
        transmittance,
        index_of_refraction: if index >= 1.0 { index } else { 1.0 },
    }
}

/// Returns the number of textures that the material refers to.
pub(super) fn textures(material: &gltf_json::Material) -> usize {
    let pbr = &material.pbr_metallic_roughness;
    [
        pbr.base_color_texture.is_some(),
        pbr.metallic_roughness_texture.is_some(),
        material.normal_texture.is_some(),
        material.occlusion_texture.is_some(),
        material.emissive_texture.is_some(),
    ]
    .into_iter()
    .filter(|there| *there)
    .count()
}
