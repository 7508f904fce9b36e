//! Histograms of a tree's leaves, with ranges that select leaves, and a histogram of the rays of a
//! picture. A histogram of leaves is one entry of [`HISTOGRAMS`].

use super::Leaf;
use crate::present::number::{Digits, grouped};
use crate::structure::Tree;
use crate::trace::Visits;

/// Number of histograms of leaves.
pub const HISTOGRAM_COUNT: usize = 4;

/// All histograms of leaves.
pub static HISTOGRAMS: [Histogram; HISTOGRAM_COUNT] = [
    Histogram {
        name: "depth",
        axis: HistogramAxis {
            title: "Leaf depth",
            unit: "levels below the root",
            counted: "leaves",
            spread: Spread::Whole,
        },
        value: |leaf| Some(f64::from(leaf.depth)),
    },
    Histogram {
        name: "objects",
        axis: HistogramAxis {
            title: "Objects per leaf",
            unit: "objects",
            counted: "leaves",
            spread: Spread::Whole,
        },
        value: |leaf| Some(f64::from(leaf.objects)),
    },
    Histogram {
        name: "volume",
        axis: HistogramAxis {
            title: "Leaf volume",
            unit: "cubed units of length, powers of 10",
            counted: "leaves",
            spread: Spread::Powers,
        },
        value: |leaf| Some(leaf.volume.max(f64::MIN_POSITIVE).log10()),
    },
    Histogram {
        name: "visits",
        axis: HistogramAxis {
            title: "Visits per leaf",
            unit: "rays, logarithmic",
            counted: "leaves",
            spread: Spread::Counts,
        },
        value: |leaf| Some((leaf.visits? as f64 + 1.0).log10()),
    },
];

/// The axis of the histogram of rays: nodes visited per ray.
pub static NODES_PER_RAY: HistogramAxis = HistogramAxis {
    title: "Nodes per ray",
    unit: "nodes visited, inner ones and leaves",
    counted: "rays",
    spread: Spread::Whole,
};

/// A histogram of a number that every leaf has.
pub struct Histogram {
    /// Name in settings.
    pub name: &'static str,
    pub axis: HistogramAxis,
    value: fn(&Leaf) -> Option<f64>,
}

/// The axis of a histogram.
pub struct HistogramAxis {
    /// Display name.
    pub title: &'static str,
    /// What the numbers along the axis count.
    pub unit: &'static str,
    /// What the bars count.
    pub counted: &'static str,
    pub spread: Spread,
}

/// How values are distributed over the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Integers. Every bar covers an integer number of values.
    Whole,
    /// Logarithmic: values are powers of ten, given by their exponents.
    Powers,
    /// Integers that may be 0, most of them small: values are log₁₀(number + 1).
    Counts,
}

/// The bars of a histogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Value at the start of the first bar.
    pub start: f64,
    /// Width of a bar, above 0.
    pub width: f64,
    /// Full and empty leaves in every bar. For rays, all are in the first count.
    pub counts: Vec<[u64; 2]>,
}

/// A selection of leaves: a range of values for every histogram, inclusive at both ends. `None`
/// selects all values.
pub type Ranges = [Option<[f64; 2]>; HISTOGRAM_COUNT];

/// Returns whether a leaf lies in all ranges. A leaf without a value lies in no range of that
/// histogram.
pub fn in_ranges(leaf: &Leaf, ranges: &Ranges) -> bool {
    HISTOGRAMS.iter().zip(ranges).all(|(histogram, range)| {
        range.is_none_or(|[lo, hi]| {
            let value = histogram.value(leaf);
            value.is_some_and(|value| (lo..=hi).contains(&value))
        })
    })
}

/// Returns whether these ranges need the visits of leaves to be counted.
pub fn ranges_need_visits(ranges: &Ranges) -> bool {
    let mut pairs = HISTOGRAMS.iter().zip(ranges);
    pairs.any(|(histogram, range)| range.is_some() && histogram.needs_visits())
}

/// Returns all leaves of a tree in the form that colorings, filters and histograms use.
pub fn leaves(tree: &Tree, visits: Option<&Visits>) -> Vec<Leaf> {
    tree.cells()
        .filter_map(|cell| Leaf::of(tree, &cell, visits))
        .collect()
}

impl Histogram {
    /// Returns the value of a leaf on the axis; `None` if visits were not counted.
    pub fn value(&self, leaf: &Leaf) -> Option<f64> {
        (self.value)(leaf)
    }

    /// Returns whether the histogram needs the visits of leaves to be counted.
    pub fn needs_visits(&self) -> bool {
        self.value(&Leaf {
            depth: 0,
            objects: 0,
            volume: 0.0,
            visits: None,
        })
        .is_none()
    }

    /// Returns at most `most` bars over all leaves that have a value; no bars if there are none.
    pub fn bars(&self, leaves: &[Leaf], most: usize) -> Bars {
        let with_value = leaves.iter().filter_map(|leaf| {
            let class = usize::from(leaf.objects == 0);
            Some((self.value(leaf)?, class, 1))
        });
        self.axis.bars(with_value, most)
    }
}

/// Returns at most `most` bars over all rays, on the axis [`NODES_PER_RAY`]; no bars without rays.
pub fn ray_bars(visits: &Visits, most: usize) -> Bars {
    let bins = visits.rays_by_nodes.iter().enumerate();
    let visited = bins.filter(|(_, rays)| **rays > 0);
    NODES_PER_RAY.bars(visited.map(|(nodes, rays)| (nodes as f64, 0, *rays)), most)
}

impl HistogramAxis {
    /// Returns bars over values. Each item is a value, its class (0 or 1), and its count.
    fn bars(&self, items: impl Iterator<Item = (f64, usize, u64)> + Clone, most: usize) -> Bars {
        let most = most.max(1);
        let [lo, hi] = items
            .clone()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], (v, ..)| {
                [lo.min(v), hi.max(v)]
            });
        if lo > hi {
            return Bars {
                start: 0.0,
                width: 1.0,
                counts: Vec::new(),
            };
        }
        let (start, width) = match self.spread {
            // Bars are centered on integers.
            Spread::Whole => (lo - 0.5, ((hi - lo + 1.0) / most as f64).ceil()),
            Spread::Powers | Spread::Counts => (lo, (hi - lo) / most as f64),
        };
        // If all values are equal, use one bar of width 1.
        let width = if width > 0.0 { width } else { 1.0 };
        let place = |value: f64| (((value - start) / width) as usize).min(most - 1);
        let mut counts = vec![[0; 2]; place(hi) + 1];
        for (value, class, count) in items {
            counts[place(value)][class] += count;
        }
        Bars {
            start,
            width,
            counts,
        }
    }

    /// Formats a value of the axis for display.
    pub fn format(&self, value: f64) -> String {
        match self.spread {
            Spread::Whole => grouped(value),
            Spread::Powers => Digits::Three.number(libm::exp10(value)),
            Spread::Counts => grouped(libm::exp10(value) - 1.0),
        }
    }

    /// Formats the values between two edges of bars for display.
    pub fn format_range(&self, [lo, hi]: [f64; 2]) -> String {
        let (lo, hi) = match self.spread {
            // Bars are centered on integers.
            Spread::Whole => (lo + 0.5, hi - 0.5),
            Spread::Powers => (lo, hi),
            Spread::Counts => {
                // The first and the last integer inside. The margin allows for rounding of the
                // edges.
                let [lo, hi] = [lo, hi].map(|edge| libm::exp10(edge) - 1.0);
                let (lo, hi) = ((lo - 1e-9 * lo).ceil(), (hi + 1e-9 * hi).floor());
                ((lo + 1.0).log10(), (hi.max(lo) + 1.0).log10())
            }
        };
        let [lo, hi] = [lo, hi].map(|value| self.format(value));
        if lo == hi {
            lo
        } else {
            format!("{lo} to {hi}")
        }
    }
}

impl Bars {
    /// Returns the value at the end of the last bar.
    pub fn end(&self) -> f64 {
        self.start + self.width * self.counts.len() as f64
    }

    /// Returns the number of leaves or rays in the highest bar.
    pub fn highest(&self) -> u64 {
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
            visits: Some(u64::from(objects) * 1000),
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
                let total: u64 = bars.counts.iter().map(|[full, empty]| full + empty).sum();
                assert_eq!(total, 4);
                let empty: u64 = bars.counts.iter().map(|[_, empty]| empty).sum();
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

    #[test]
    fn visits_count_only_where_they_are_known() {
        let visited = leaf(3, 2, 1.0);
        let unknown = Leaf {
            visits: None,
            ..visited
        };
        let by_visits = &HISTOGRAMS[3];
        assert!(by_visits.needs_visits() && !HISTOGRAMS[0].needs_visits());
        let bars = by_visits.bars(&[visited, unknown, leaf(1, 0, 1.0)], 30);
        assert_eq!(bars.highest(), 1);
        assert_eq!(bars.start, 0.0);
        let mut ranges = Ranges::default();
        assert!(in_ranges(&unknown, &ranges) && !ranges_need_visits(&ranges));
        ranges[3] = Some([1.0, 5.0]);
        assert!(in_ranges(&visited, &ranges) && ranges_need_visits(&ranges));
        assert!(!in_ranges(&unknown, &ranges));
    }

    #[test]
    fn ranges_of_counts_name_the_whole_numbers_inside() {
        let axis = &HISTOGRAMS[3].axis;
        let edge = |number: f64| (number + 1.0).log10();
        assert_eq!(axis.format_range([edge(0.0), edge(0.4)]), "0");
        assert_eq!(axis.format_range([edge(0.4), edge(99.5)]), "1 to 99");
        assert_eq!(
            axis.format_range([edge(7.0), edge(1000.0)]),
            "7 to 1\u{a0}000"
        );
    }

    #[test]
    fn every_ray_is_in_one_bar() {
        let visits = Visits {
            rays_by_nodes: vec![4, 0, 7, 1],
            ..Visits::default()
        };
        let bars = ray_bars(&visits, 36);
        assert_eq!(bars.counts, [[4, 0], [0, 0], [7, 0], [1, 0]]);
        assert_eq!(NODES_PER_RAY.format_range([1.5, 2.5]), "2");
        let few = ray_bars(&visits, 2).counts;
        assert_eq!(few, [[4, 0], [8, 0]]);
        assert!(ray_bars(&Visits::default(), 36).counts.is_empty());
    }
}
