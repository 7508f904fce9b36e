//! Conversion of `KHR_lights_punctual` to lights without falloff.

use super::nodes::{LightKind, PlacedLight};
use crate::geometry::{Aabb, Vec3};
use crate::scene::format::builder::SceneBuilder;
use crate::scene::material::Light;
use crate::scene::note::NoteKind;

/// Distance of directional lights, in diagonals of the scene.
const FAR: f64 = 1000.0;

/// Adds the lights. Their relative intensities are those at the center of the scene. The brightest
/// light gets intensity 1/√`N_L`, which is that of NFF lights without a color.
pub(super) fn add(lights: &[PlacedLight], bounds: &Aabb, builder: &mut SceneBuilder) {
    if bounds.is_empty() {
        return;
    }
    let (center, size) = (bounds.center(), bounds.size().length());
    let mut shining = Vec::new();
    for light in lights {
        let (position, squared) = match light.kind {
            LightKind::Directional => (center - FAR * size * light.direction, 1.0),
            LightKind::Point | LightKind::Spot => {
                (light.position, light.position.distance_squared(center))
            }
        };
        // Avoids dividing by zero for a light at the center itself.
        let color = light.color * light.intensity / squared.max(1e-6 * size * size);
        if !(position.is_finite() && color.is_finite() && color.max_element() > 0.0) {
            builder.note(NoteKind::Skipped, "light without intensity", light.place);
            continue;
        }
        const FAR_AWAY: &str = "directional light replaced by a distant point light";
        match light.kind {
            LightKind::Directional => builder.note(NoteKind::Changed, FAR_AWAY, light.place),
            LightKind::Spot => builder.note(
                NoteKind::Changed,
                "spot light replaced by a point light",
                light.place,
            ),
            LightKind::Point => {}
        }
        shining.push((position, color, light.place));
    }
    let brightest = shining.iter().map(|(_, color, _)| color.max_element());
    let brightest = brightest.fold(0.0, f64::max);
    let scale = 1.0 / (brightest * (shining.len() as f64).sqrt());
    for (position, color, place) in shining {
        const TEXT: &str = "light without falloff, as bright as at the center of the scene";
        builder.note(NoteKind::Changed, TEXT, place);
        builder.lights.push(Light {
            position,
            color: Some((color * scale).max(Vec3::ZERO)),
        });
    }
}
