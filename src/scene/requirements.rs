//! The features that rendering a scene requires, computed once when the scene is created.

use super::parts::SceneParts;
use crate::primitive::PrimitiveKind;

/// The features that rendering the scene requires. The renderer skips all others.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Requirements {
    /// The kinds of primitives in the scene, with the number of each.
    pub primitives: Vec<(PrimitiveKind, usize)>,
    /// Some object spawns reflected rays (`Ks` > 0 or `T` > 0).
    pub reflects: bool,
    /// Some object spawns refracted rays (`T` > 0).
    pub refracts: bool,
    /// There is a light, and a surface that it can illuminate (`Kd` > 0 or `Ks` > 0).
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

    /// Returns the depth of secondary rays for a limit of `d_arec`; 0 if the scene spawns none.
    pub fn secondary_depth(&self, d_arec: u32) -> u32 {
        if self.reflects || self.refracts {
            d_arec
        } else {
            0
        }
    }

    /// Returns the features that this scene does not need, one short phrase each.
    pub fn unneeded(&self) -> Vec<String> {
        let mut out = Vec::new();
        let absent: Vec<_> = PrimitiveKind::ALL
            .into_iter()
            .filter(|kind| self.primitives.iter().all(|(k, _)| k != kind))
            .map(PrimitiveKind::plural)
            .collect();
        if !absent.is_empty() {
            out.push(absent.join(", "));
        }
        if self.primitives.len() == 1 {
            out.push("choosing the kind of primitive per test (all are of one kind)".into());
        }
        if !self.reflects {
            out.push("reflected rays (no mirroring surface)".into());
        }
        if !self.refracts {
            out.push("refracted rays (no transparent surface)".into());
        }
        if !self.casts_shadows {
            out.push("shadow rays (no light, or no surface that reflects it)".into());
        }
        if !self.interpolates_normals {
            out.push("interpolated normals".into());
        }
        out
    }
}
