//! Color maps, all suitable for color-blind readers. A map is one entry of [`COLORMAPS`].

/// A gradient of colors over the range 0 to 1.
pub struct Colormap {
    /// Name in settings.
    pub name: &'static str,
    /// A short description for display.
    pub about: &'static str,
    /// Whether the map is diverging: two colors with a light middle, for differences. In the other
    /// maps, lightness increases from one end to the other.
    pub diverging: bool,
    gradient: colorous::Gradient,
    /// Whether the gradient is reversed, so that larger values are warmer.
    reversed: bool,
}

/// All color maps. The first is the default. The first diverging one is the default for
/// differences.
pub static COLORMAPS: &[Colormap] = &[
    Colormap {
        name: "viridis",
        about: "purple, green, yellow",
        diverging: false,
        gradient: colorous::VIRIDIS,
        reversed: false,
    },
    Colormap {
        name: "cividis",
        about: "blue, gray, yellow: nearly the same for all kinds of color vision",
        diverging: false,
        gradient: colorous::CIVIDIS,
        reversed: false,
    },
    Colormap {
        name: "magma",
        about: "black, purple, cream",
        diverging: false,
        gradient: colorous::MAGMA,
        reversed: false,
    },
    Colormap {
        name: "inferno",
        about: "black, red, yellow",
        diverging: false,
        gradient: colorous::INFERNO,
        reversed: false,
    },
    Colormap {
        name: "plasma",
        about: "blue, pink, yellow",
        diverging: false,
        gradient: colorous::PLASMA,
        reversed: false,
    },
    Colormap {
        name: "blue-red",
        about: "blue below the middle, red above, for differences",
        diverging: true,
        gradient: colorous::RED_BLUE,
        reversed: true,
    },
    Colormap {
        name: "purple-orange",
        about: "purple below the middle, orange above, for differences",
        diverging: true,
        gradient: colorous::PURPLE_ORANGE,
        reversed: false,
    },
];

/// Returns the color map with this name.
pub fn colormap(name: &str) -> Option<&'static Colormap> {
    COLORMAPS.iter().find(|map| map.name == name)
}

impl Colormap {
    /// Returns the sRGB color at a place from 0 to 1. Places outside are clamped.
    pub fn color(&self, place: f64) -> [u8; 3] {
        let place = place.clamp(0.0, 1.0);
        let place = if self.reversed { 1.0 - place } else { place };
        let color = self.gradient.eval_continuous(place);
        [color.r, color.g, color.b]
    }

    /// Returns the color for missing values, which is not in the map.
    pub const fn no_value(&self) -> [u8; 3] {
        if self.diverging { [128; 3] } else { [255; 3] }
    }
}
