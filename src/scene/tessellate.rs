//! Exact cylinders and cones, or prisms of polygons in their place, as in the paper.

use super::parts::SceneParts;
use crate::primitive::Primitive;
use serde::{Deserialize, Serialize};

/// How cylinders and cones are represented.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cylinders {
    /// As exact surfaces.
    #[default]
    Exact,
    /// As an open regular inscribed prism of this many polygons, at least 3.
    Polygons(u32),
}

impl Cylinders {
    /// For [`Cylinders::Polygons`], replaces each cylinder and cone by polygons, at its place in
    /// the list and with its material. Otherwise, and if there are none, returns the parts
    /// unchanged without copying.
    pub fn apply(self, mut parts: SceneParts) -> SceneParts {
        let Cylinders::Polygons(sides) = self else {
            return parts;
        };
        let is_cone = |object: &Primitive| matches!(object, Primitive::Cone(_));
        let cones = parts.objects.iter().filter(|o| is_cone(o)).count();
        if cones == 0 {
            return parts;
        }
        let others = parts.objects.len() - cones;
        let mut objects = Vec::with_capacity(others + cones * sides as usize);
        let mut material_of = Vec::with_capacity(objects.capacity());
        for (object, material) in parts.objects.into_iter().zip(parts.material_of) {
            match object {
                Primitive::Cone(cone) => {
                    objects.extend(cone.prism(sides).into_iter().map(Primitive::Polygon));
                }
                other => objects.push(other),
            }
            material_of.resize(objects.len(), material);
        }
        parts.objects = objects;
        parts.material_of = material_of;
        parts
    }
}

impl std::str::FromStr for Cylinders {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let sides = text.strip_prefix("polygons:").map(str::parse::<u32>);
        match (text, sides) {
            ("exact", _) => Ok(Cylinders::Exact),
            (_, Some(Ok(n))) if (3..=100_000).contains(&n) => Ok(Cylinders::Polygons(n)),
            _ => Err(format!(
                "expected 'exact' or 'polygons:N' with N from 3 to 100000, found '{text}'"
            )),
        }
    }
}

impl std::fmt::Display for Cylinders {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Cylinders::Exact => f.write_str("exact"),
            Cylinders::Polygons(n) => write!(f, "polygons:{n}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn prisms_replace_their_cylinders_in_place_with_their_materials() {
        let exact = builtin::generate("rings", Some(1)).unwrap();
        let prisms = Cylinders::Polygons(6).apply(exact.clone());
        let mut rest = prisms.objects.iter().zip(&prisms.material_of);
        for (object, material) in exact.objects.iter().zip(&exact.material_of) {
            if let Primitive::Cone(_) = object {
                for _ in 0..6 {
                    let (polygon, of_polygon) = rest.next().unwrap();
                    assert!(matches!(polygon, Primitive::Polygon(_)));
                    assert_eq!(of_polygon, material);
                }
            } else {
                assert_eq!(rest.next().unwrap(), (object, material));
            }
        }
        assert!(rest.next().is_none());
        assert_eq!(prisms.name, exact.name);
    }

    #[test]
    fn exact_cylinders_and_scenes_without_any_stay_as_they_are() {
        let rings = builtin::generate("rings", Some(1)).unwrap();
        assert_eq!(Cylinders::Exact.apply(rings.clone()), rings);
        let tetra = builtin::generate("tetra", Some(2)).unwrap();
        assert_eq!(Cylinders::Polygons(10).apply(tetra.clone()), tetra);
    }
}
