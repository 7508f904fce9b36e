//! Materials: base colours, and what of metals and glass the shading knows.

use crate::geometry::Vec3;
use crate::scene::material::Material;
use gltf_json::material::AlphaMode;
use gltf_json::validation::Checked;

/// The material nearest to a glTF material: the base colour, `Ks` metalness times smoothness, and
/// `T` what is transmitted or, of a blended surface, what its alpha leaves.
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
    // What is only blended bends no ray.
    let index = match extensions.and_then(|e| e.ior.as_ref()) {
        Some(ior) => f64::from(ior.ior.0),
        None if transmitted > 0.0 => 1.5,
        None => 1.0,
    };
    Material {
        color: Vec3::new(r, g, b),
        diffuse: (1.0 - transmittance) * (1.0 - specular),
        specular,
        // Blinn's exponent for the roughness squared, as is usual.
        shine: (2.0 / roughness.max(0.05).powi(4) - 2.0).max(0.0),
        transmittance,
        index_of_refraction: if index >= 1.0 { index } else { 1.0 },
    }
}

/// How many textures the material names.
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
