//! Colors for numbers, all readable by color-blind people. A map is one entry of [`COLORMAPS`].

/// A way from 0 to 1 through colors.
pub struct Colormap {
    /// Name in settings.
    pub name: &'static str,
    /// One phrase for people.
    pub about: &'static str,
    /// Two colors that part at a light middle, for differences; the others get lighter from end
    /// to end.
    pub diverging: bool,
    gradient: colorous::Gradient,
    /// Whether the gradient is run from its end, so that the greater is the warmer.
    reversed: bool,
}

/// All color maps: the first is the default, the first diverging one that for differences.
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

/// The color map of this name.
pub fn colormap(name: &str) -> Option<&'static Colormap> {
    COLORMAPS.iter().find(|map| map.name == name)
}

impl Colormap {
    /// sRGB color at a place, 0 to 1; beyond, that of the nearer end.
    pub fn color(&self, place: f64) -> [u8; 3] {
        let place = place.clamp(0.0, 1.0);
        let place = if self.reversed { 1.0 - place } else { place };
        let color = self.gradient.eval_continuous(place);
        [color.r, color.g, color.b]
    }

    /// What has no value: a color that the map does not have.
    pub const fn no_value(&self) -> [u8; 3] {
        if self.diverging { [128; 3] } else { [255; 3] }
    }
}
