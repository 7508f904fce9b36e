//! What leaves can be coloured by. A colouring is one entry of [`COLORINGS`].

/// A leaf as colourings and filters see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    pub depth: u32,
    /// Number of objects that it refers to.
    pub objects: u32,
    /// Volume of its cell, in cubed units of length.
    pub volume: f64,
}

/// How values spread over the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Linear,
    /// By log(1 + value): most leaves hold few objects, some very many.
    Log,
    /// Nothing between the two ends.
    TwoValues([&'static str; 2]),
}

/// A way to colour leaves.
pub struct Coloring {
    /// Name in settings.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// What the numbers of the legend count; empty where there are none.
    pub unit: &'static str,
    value: fn(Leaf) -> f64,
    scale: Scale,
    gradient: colorous::Gradient,
}

/// A place in a legend, 0 to 1, and what stands there.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    pub place: f64,
    pub text: String,
}

/// All colourings.
pub static COLORINGS: &[Coloring] = &[
    Coloring {
        name: "depth",
        title: "Depth",
        unit: "levels below the root",
        value: |leaf| f64::from(leaf.depth),
        scale: Scale::Linear,
        gradient: colorous::VIRIDIS,
    },
    Coloring {
        name: "objects",
        title: "Objects",
        unit: "objects in a leaf",
        value: |leaf| f64::from(leaf.objects),
        scale: Scale::Log,
        gradient: colorous::PLASMA,
    },
    Coloring {
        name: "emptiness",
        title: "Emptiness",
        unit: "",
        value: |leaf| f64::from(leaf.objects.min(1)),
        scale: Scale::TwoValues(["empty", "full"]),
        gradient: colorous::COOL,
    },
];

/// The colouring of this name.
pub fn coloring(name: &str) -> Option<&'static Coloring> {
    COLORINGS.iter().find(|c| c.name == name)
}

impl Coloring {
    /// The value of a leaf, of which the legend tells the colours.
    pub fn value(&self, leaf: Leaf) -> f64 {
        (self.value)(leaf)
    }

    /// sRGB colour of a value when the greatest is `highest`.
    pub fn color(&self, value: f64, highest: f64) -> [u8; 3] {
        self.color_at(self.place(value, highest))
    }

    /// sRGB colour at a place of the legend, 0 to 1.
    pub fn color_at(&self, place: f64) -> [u8; 3] {
        // The darkest fifth could not be told from the dark ground.
        let color = self.gradient.eval_continuous(0.2 + 0.8 * place);
        [color.r, color.g, color.b]
    }

    /// Whether colours run from one end of the legend to the other.
    pub fn is_continuous(&self) -> bool {
        !matches!(self.scale, Scale::TwoValues(_))
    }

    fn place(&self, value: f64, highest: f64) -> f64 {
        let place = match self.scale {
            Scale::Linear => value / highest,
            Scale::Log => value.ln_1p() / highest.ln_1p(),
            Scale::TwoValues(_) => value,
        };
        // Where the greatest value is 0, all colours are the lowest.
        if place.is_nan() {
            0.0
        } else {
            place.clamp(0.0, 1.0)
        }
    }

    /// The numbers of the legend from the lowest to the highest place.
    pub fn marks(&self, highest: f64) -> Vec<Mark> {
        let mark = |value: f64| Mark {
            place: self.place(value, highest),
            text: format!("{value:.0}"),
        };
        match self.scale {
            Scale::TwoValues(names) => names
                .into_iter()
                .zip([0.0, 1.0])
                .map(|(text, place)| Mark {
                    place,
                    text: text.to_owned(),
                })
                .collect(),
            _ if highest <= 0.0 => vec![mark(0.0)],
            Scale::Linear => {
                let step = (highest / 4.0).ceil().max(1.0);
                let mut marks: Vec<Mark> = (0..)
                    .map(|i| f64::from(i) * step)
                    .take_while(|&value| value <= highest - step * 0.5)
                    .map(mark)
                    .collect();
                marks.push(mark(highest));
                marks
            }
            Scale::Log => {
                let mut marks = vec![mark(0.0)];
                let mut value = 1.0_f64;
                while value.ln_1p() < highest.ln_1p() * 0.88 {
                    marks.push(mark(value));
                    value *= if highest > 300.0 { 10.0 } else { 4.0 };
                }
                marks.push(mark(highest));
                marks
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legends_run_from_end_to_end_in_order() {
        assert!(!COLORINGS.is_empty());
        for coloring in COLORINGS {
            for highest in [1.0, 3.0, 20.0, 5000.0] {
                let marks = coloring.marks(highest);
                assert_eq!(marks.first().map(|m| m.place), Some(0.0));
                assert_eq!(marks.last().map(|m| m.place), Some(1.0));
                assert!(marks.is_sorted_by(|a, b| a.place < b.place), "{marks:?}");
            }
            assert!(!coloring.marks(0.0).is_empty());
        }
    }
}
