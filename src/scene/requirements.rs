//! What a scene requires of a renderer, worked out once when it is made.

use super::parts::SceneParts;
use crate::primitive::PrimitiveKind;

/// What rendering the scene takes. Whatever is absent here is not done at all.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Requirements {
    /// The kinds of primitive present and how many of each.
    pub primitives: Vec<(PrimitiveKind, usize)>,
    /// Some object in use spawns reflected rays (`Ks` > 0 or `T` > 0).
    pub reflects: bool,
    /// Some object in use spawns refracted rays (`T` > 0).
    pub refracts: bool,
    /// There is a light, and a surface that it can brighten (`Kd` > 0 or `Ks` > 0).
    pub casts_shadows: bool,
    /// Some surface is shaded with interpolated normals.
    pub interpolates_normals: bool,
}

impl Requirements {
    pub(super) fn of(parts: &SceneParts) -> Self {
        use crate::primitive::Primitive;
        let mut counts = [0usize; PrimitiveKind::ALL.len()];
        let mut used = vec![false; parts.materials.len()];
        let mut interpolates_normals = false;
        for (object, &material) in parts.objects.iter().zip(&parts.material_of) {
            counts[object.kind() as usize] += 1;
            used[material as usize] = true;
            interpolates_normals |= match object {
                Primitive::Triangle(t) => t.normals.is_some(),
                Primitive::Polygon(p) => p.vertex_normals().is_some(),
                Primitive::Sphere(_) | Primitive::Cone(_) => false,
            };
        }
        let in_use = || {
            parts
                .materials
                .iter()
                .zip(&used)
                .filter(|(_, used)| **used)
                .map(|(m, _)| m)
        };
        Requirements {
            primitives: PrimitiveKind::ALL
                .into_iter()
                .zip(counts)
                .filter(|&(_, count)| count > 0)
                .collect(),
            reflects: in_use().any(|m| m.specular > 0.0 || m.transmittance > 0.0),
            refracts: in_use().any(|m| m.transmittance > 0.0),
            casts_shadows: !parts.lights.is_empty()
                && in_use().any(|m| m.diffuse > 0.0 || m.specular > 0.0),
            interpolates_normals,
        }
    }

    /// How deep secondary rays can matter when `d_arec` levels are allowed: 0 where none arise.
    pub fn secondary_depth(&self, d_arec: u32) -> u32 {
        if self.reflects || self.refracts {
            d_arec
        } else {
            0
        }
    }

    /// What is left out because the scene does not need it; one short phrase each.
    pub fn left_out(&self) -> Vec<String> {
        let mut out = Vec::new();
        let absent: Vec<_> = PrimitiveKind::ALL
            .into_iter()
            .filter(|kind| self.primitives.iter().all(|(k, _)| k != kind))
            .map(PrimitiveKind::plural)
            .collect();
        if !absent.is_empty() {
            out.push(format!("no code for {}", absent.join(", ")));
        }
        if self.primitives.len() == 1 {
            out.push("no choice of primitive per intersection test".into());
        }
        if !self.reflects {
            out.push("no reflected rays (nothing mirrors)".into());
        }
        if !self.refracts {
            out.push("no refracted rays (nothing is transparent)".into());
        }
        if !self.casts_shadows {
            out.push("no shadow rays (no light, or nothing it could brighten)".into());
        }
        if !self.interpolates_normals {
            out.push("no interpolated normals".into());
        }
        out
    }
}
