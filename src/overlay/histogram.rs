//! Histograms of a tree's leaves, and ranges of them that select leaves. A histogram is one entry
//! of [`HISTOGRAMS`].

use super::Leaf;
use crate::tree::{NodeKind, Tree};

/// How many histograms there are.
pub const HISTOGRAM_COUNT: usize = 3;

/// All histograms.
pub static HISTOGRAMS: [Histogram; HISTOGRAM_COUNT] = [
    Histogram {
        name: "depth",
        title: "Leaf depth",
        unit: "levels below the root",
        spread: Spread::Whole,
        value: |leaf| f64::from(leaf.depth),
    },
    Histogram {
        name: "objects",
        title: "Objects a leaf",
        unit: "objects",
        spread: Spread::Whole,
        value: |leaf| f64::from(leaf.objects),
    },
    Histogram {
        name: "volume",
        title: "Leaf volume",
        unit: "cubed units of length, powers of 10",
        spread: Spread::Powers,
        value: |leaf| leaf.volume.max(f64::MIN_POSITIVE).log10(),
    },
];

/// A number that every leaf has.
pub struct Histogram {
    /// Name in settings.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// What the numbers along the axis count.
    pub unit: &'static str,
    pub spread: Spread,
    value: fn(&Leaf) -> f64,
}

/// How values spread over the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Whole numbers: bars are a whole number of values wide.
    Whole,
    /// Values are exponents of ten.
    Powers,
}

/// The bars of a histogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Where the first bar begins.
    pub start: f64,
    /// Width of a bar, above 0.
    pub width: f64,
    /// Full and empty leaves in every bar.
    pub counts: Vec<[u32; 2]>,
}

/// A selection of leaves: for every histogram the values that are in, if not all are. Both ends
/// count.
pub type Ranges = [Option<[f64; 2]>; HISTOGRAM_COUNT];

/// Whether a leaf lies in all ranges.
pub fn in_ranges(leaf: &Leaf, ranges: &Ranges) -> bool {
    HISTOGRAMS.iter().zip(ranges).all(|(histogram, range)| {
        range.is_none_or(|[lo, hi]| (lo..=hi).contains(&histogram.value(leaf)))
    })
}

/// All leaves of a tree as colourings, filters and histograms see them.
pub fn leaves(tree: &Tree) -> Vec<Leaf> {
    tree.cells()
        .filter_map(|cell| match tree.kind(cell.node) {
            NodeKind::Leaf { count, .. } => Some(Leaf {
                depth: cell.depth,
                objects: count,
                volume: cell.bounds.volume(),
            }),
            NodeKind::Inner { .. } => None,
        })
        .collect()
}

impl Histogram {
    /// The value of a leaf on the axis.
    pub fn value(&self, leaf: &Leaf) -> f64 {
        (self.value)(leaf)
    }

    /// At most `most` bars over all leaves; none without leaves.
    pub fn bars(&self, leaves: &[Leaf], most: usize) -> Bars {
        let most = most.max(1);
        let [lo, hi] = leaves
            .iter()
            .map(|leaf| self.value(leaf))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], v| {
                [lo.min(v), hi.max(v)]
            });
        if leaves.is_empty() {
            return Bars {
                start: 0.0,
                width: 1.0,
                counts: Vec::new(),
            };
        }
        let (start, width) = match self.spread {
            // Bars lie around their whole numbers.
            Spread::Whole => (lo - 0.5, ((hi - lo + 1.0) / most as f64).ceil()),
            Spread::Powers => (lo, (hi - lo) / most as f64),
        };
        // Where all values are equal there is one bar around them.
        let width = if width > 0.0 { width } else { 1.0 };
        let place = |value: f64| (((value - start) / width) as usize).min(most - 1);
        let mut counts = vec![[0; 2]; place(hi) + 1];
        for leaf in leaves {
            counts[place(self.value(leaf))][usize::from(leaf.objects == 0)] += 1;
        }
        Bars {
            start,
            width,
            counts,
        }
    }

    /// A value of the axis for people.
    pub fn format(&self, value: f64) -> String {
        match self.spread {
            Spread::Whole => format!("{value:.0}"),
            Spread::Powers => {
                let value = libm::exp10(value);
                if (0.01..1e4).contains(&value) {
                    format!("{value:.3}")
                } else {
                    format!("{value:.1e}")
                }
            }
        }
    }
}

impl Bars {
    /// Where the last bar ends.
    pub fn end(&self) -> f64 {
        self.start + self.width * self.counts.len() as f64
    }

    /// Leaves in the highest bar.
    pub fn highest(&self) -> u32 {
        self.counts.iter().map(|[a, b]| a + b).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leaf(depth: u32, objects: u32, volume: f64) -> Leaf {
        Leaf {
            depth,
            objects,
            volume,
        }
    }

    #[test]
    fn every_leaf_is_in_one_bar_whatever_their_number() {
        let leaves = [
            leaf(0, 3, 0.0),
            leaf(20, 0, 1e-9),
            leaf(7, 1, 8.0),
            leaf(7, 1000, 8.0),
        ];
        for histogram in &HISTOGRAMS {
            for most in [1, 2, 7, 40] {
                let bars = histogram.bars(&leaves, most);
                assert!(bars.counts.len() <= most);
                let total: u32 = bars.counts.iter().map(|[full, empty]| full + empty).sum();
                assert_eq!(total, 4);
                let empty: u32 = bars.counts.iter().map(|[_, empty]| empty).sum();
                assert_eq!(empty, 1);
            }
            assert_eq!(histogram.bars(&leaves[2..3], 10).highest(), 1);
            assert!(histogram.bars(&[], 10).counts.is_empty());
        }
    }

    #[test]
    fn ranges_hold_their_ends_and_all_must_agree() {
        let mut ranges = Ranges::default();
        let deep = leaf(9, 2, 10.0);
        assert!(in_ranges(&deep, &ranges));
        ranges[0] = Some([3.0, 9.0]);
        assert!(in_ranges(&deep, &ranges));
        ranges[2] = Some([1.5, 2.0]);
        assert!(!in_ranges(&deep, &ranges));
        ranges[2] = Some([0.5, 1.0]);
        assert!(in_ranges(&deep, &ranges));
    }
}
