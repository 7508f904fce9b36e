//! Colorings of leaves by their properties. A coloring is one entry of [`COLORINGS`].

use crate::present::number::{Digits, grouped};
use crate::structure::{CellOfNode, NodeKind, Tree};
use crate::trace::Visits;

/// A leaf in the form that colorings, filters and histograms use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    pub depth: u32,
    /// Number of objects in the leaf.
    pub objects: u32,
    /// Volume of the cell, in cubed scene units.
    pub volume: f64,
    /// Number of rays of the picture that visited the leaf; `None` if not counted.
    pub visits: Option<u64>,
}

impl Leaf {
    /// Returns the leaf in a cell; `None` for the cell of an inner node.
    pub fn of(tree: &Tree, cell: &CellOfNode, visits: Option<&Visits>) -> Option<Leaf> {
        match tree.kind(cell.node) {
            NodeKind::Leaf { count, .. } => Some(Leaf {
                depth: cell.depth,
                objects: count,
                volume: cell.bounds.volume(),
                visits: visits.map(|visits| visits.by_node[cell.node as usize]),
            }),
            NodeKind::Inner => None,
        }
    }
}

/// How values map to colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// Linear, from 0.
    Linear,
    /// Logarithmic, by log(1 + value), because most leaves hold few objects and some very many.
    Log,
    /// Logarithmic, from the least value.
    Powers,
    /// Two values: only the first and the last color.
    TwoValues([&'static str; 2]),
}

/// A way to color leaves.
pub struct Coloring {
    /// Name in settings.
    pub name: &'static str,
    /// Display name.
    pub title: &'static str,
    /// Unit of the numbers in the legend; empty if there are none.
    pub unit: &'static str,
    value: fn(&Leaf) -> Option<f64>,
    scale: Scale,
    gradient: colorous::Gradient,
}

/// A label of the legend at a place from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    pub place: f64,
    pub text: String,
}

/// All colorings.
pub static COLORINGS: &[Coloring] = &[
    Coloring {
        name: "depth",
        title: "Depth",
        unit: "levels below the root",
        value: |leaf| Some(f64::from(leaf.depth)),
        scale: Scale::Linear,
        gradient: colorous::VIRIDIS,
    },
    Coloring {
        name: "objects",
        title: "Objects",
        unit: "objects in a leaf",
        value: |leaf| Some(f64::from(leaf.objects)),
        scale: Scale::Log,
        gradient: colorous::PLASMA,
    },
    Coloring {
        name: "emptiness",
        title: "Emptiness",
        unit: "",
        value: |leaf| Some(f64::from(leaf.objects.min(1))),
        scale: Scale::TwoValues(["empty", "full"]),
        gradient: colorous::COOL,
    },
    Coloring {
        name: "volume",
        title: "Volume",
        unit: "cubed units of length",
        value: |leaf| Some(leaf.volume.max(f64::MIN_POSITIVE)),
        scale: Scale::Powers,
        gradient: colorous::CIVIDIS,
    },
    Coloring {
        name: "visits",
        title: "Visits",
        unit: "rays of the picture that visited it",
        value: |leaf| Some(leaf.visits? as f64),
        scale: Scale::Log,
        gradient: colorous::INFERNO,
    },
];

/// Returns the coloring with this name.
pub fn coloring(name: &str) -> Option<&'static Coloring> {
    COLORINGS.iter().find(|c| c.name == name)
}

impl Coloring {
    /// Returns the value of a leaf that determines its color; `None` if visits were not counted.
    pub fn value(&self, leaf: &Leaf) -> Option<f64> {
        (self.value)(leaf)
    }

    /// Returns whether the coloring needs the visits of leaves to be counted.
    pub fn needs_visits(&self) -> bool {
        let unvisited = Leaf {
            depth: 0,
            objects: 0,
            volume: 0.0,
            visits: None,
        };
        self.value(&unvisited).is_none()
    }

    /// Returns the least and the greatest value of the legend for these values; [0, 0] without
    /// values.
    pub fn range(&self, values: impl Iterator<Item = f64>) -> [f64; 2] {
        let from = match self.scale {
            Scale::Powers => f64::INFINITY,
            Scale::Linear | Scale::Log | Scale::TwoValues(_) => 0.0,
        };
        let [lo, hi] = values.fold([from, 0.0], |[lo, hi], value| {
            [lo.min(value), f64::max(hi, value)]
        });
        [lo.min(hi), hi]
    }

    /// Returns the sRGB color of a value in this range.
    pub fn color(&self, value: f64, range: [f64; 2]) -> [u8; 3] {
        self.color_at(self.place(value, range))
    }

    /// Returns the sRGB color at a place of the legend, 0 to 1.
    pub fn color_at(&self, place: f64) -> [u8; 3] {
        // Skip the darkest fifth, which cannot be distinguished from the dark background.
        let color = self.gradient.eval_continuous(0.2 + 0.8 * place);
        [color.r, color.g, color.b]
    }

    /// Returns whether the legend is a continuous gradient.
    pub fn is_continuous(&self) -> bool {
        !matches!(self.scale, Scale::TwoValues(_))
    }

    fn place(&self, value: f64, [lowest, highest]: [f64; 2]) -> f64 {
        let place = match self.scale {
            Scale::Linear => value / highest,
            Scale::Log => value.ln_1p() / highest.ln_1p(),
            Scale::Powers => (value.ln() - lowest.ln()) / (highest.ln() - lowest.ln()),
            Scale::TwoValues(_) => value,
        };
        // NaN if all values are equal. Then every leaf has the lowest color.
        if place.is_nan() {
            0.0
        } else {
            place.clamp(0.0, 1.0)
        }
    }

    /// Returns the labels of the legend, from the lowest to the highest place.
    pub fn marks(&self, range: [f64; 2]) -> Vec<Mark> {
        let [lowest, highest] = range;
        let mark = |value: f64| Mark {
            place: self.place(value, range),
            text: match self.scale {
                Scale::Powers => Digits::Three.number(value),
                _ => grouped(value),
            },
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
            _ if highest <= lowest => vec![mark(lowest)],
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
                // Few enough that their labels do not overlap.
                let factor = if highest > 300.0 {
                    libm::exp10((highest.log10() / 4.0).ceil())
                } else {
                    4.0
                };
                let mut value = 1.0_f64;
                while value.ln_1p() < highest.ln_1p() * 0.88 {
                    marks.push(mark(value));
                    value *= factor;
                }
                marks.push(mark(highest));
                marks
            }
            Scale::Powers => {
                let middle = ((lowest.ln() + highest.ln()) * 0.5).exp();
                [lowest, middle, highest].map(mark).to_vec()
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
                let marks = coloring.marks(coloring.range([0.5, highest].into_iter()));
                assert_eq!(marks.first().map(|m| m.place), Some(0.0));
                assert_eq!(marks.last().map(|m| m.place), Some(1.0));
                assert!(marks.is_sorted_by(|a, b| a.place < b.place), "{marks:?}");
            }
            assert!(!coloring.marks([0.0, 0.0]).is_empty());
        }
    }
}
