//! Lights of `KHR_lights_punctual` as lights without fall-off.

use super::nodes::PlacedLight;
use crate::geometry::{Aabb, Vec3};
use crate::scene::format::gather::Gatherer;
use crate::scene::material::Light;
use crate::scene::note::NoteKind;
use gltf_json::extensions::scene::khr_lights_punctual::Type;

/// How far away, in diagonals of the scene, a directional light stands.
const FAR: f64 = 1000.0;

/// Adds the lights. Their brightness relative to each other is that at the middle of the scene; the
/// brightest one gets what NFF gives lights without a colour, 1/√`N_L`.
pub(super) fn add(lights: &[PlacedLight], bounds: &Aabb, found: &mut Gatherer) {
    if bounds.is_empty() {
        return;
    }
    let (center, size) = (bounds.center(), bounds.size().length());
    let mut shining = Vec::new();
    for light in lights {
        let (position, squared) = match light.kind {
            Type::Directional => (center - FAR * size * light.direction, 1.0),
            Type::Point | Type::Spot => (light.position, light.position.distance_squared(center)),
        };
        // At the middle itself no distance counts.
        let color = light.color * light.intensity / squared.max(1e-6 * size * size);
        if !(position.is_finite() && color.is_finite() && color.max_element() > 0.0) {
            found.note(NoteKind::Skipped, "light that does not shine", light.place);
            continue;
        }
        const FAR_AWAY: &str = "directional light put far away";
        match light.kind {
            Type::Directional => found.note(NoteKind::Changed, FAR_AWAY, light.place),
            Type::Spot => found.note(
                NoteKind::Changed,
                "spot light that shines everywhere",
                light.place,
            ),
            Type::Point => {}
        }
        shining.push((position, color, light.place));
    }
    let brightest = shining.iter().map(|(_, color, _)| color.max_element());
    let brightest = brightest.fold(0.0, f64::max);
    let scale = 1.0 / (brightest * (shining.len() as f64).sqrt());
    for (position, color, place) in shining {
        const TEXT: &str = "light as bright everywhere as amid the scene";
        found.note(NoteKind::Changed, TEXT, place);
        found.lights.push(Light {
            position,
            color: Some((color * scale).max(Vec3::ZERO)),
        });
    }
}
