//! Kinds of primitives.

/// The kinds of primitives, in the order of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PrimitiveKind {
    Sphere,
    Triangle,
    Polygon,
    Cone,
}

impl PrimitiveKind {
    pub const ALL: [PrimitiveKind; 4] = [
        PrimitiveKind::Sphere,
        PrimitiveKind::Triangle,
        PrimitiveKind::Polygon,
        PrimitiveKind::Cone,
    ];

    /// Returns the singular, one word.
    pub const fn name(self) -> &'static str {
        match self {
            PrimitiveKind::Sphere => "sphere",
            PrimitiveKind::Triangle => "triangle",
            PrimitiveKind::Polygon => "polygon",
            PrimitiveKind::Cone => "cone",
        }
    }

    /// Returns the plural, for lists of a scene's objects.
    pub const fn plural(self) -> &'static str {
        match self {
            PrimitiveKind::Sphere => "spheres",
            PrimitiveKind::Triangle => "triangles",
            PrimitiveKind::Polygon => "polygons",
            PrimitiveKind::Cone => "cylinders and cones",
        }
    }
}
