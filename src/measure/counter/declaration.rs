//! What a counter declares.

use super::class::{Class, Table, Unit};
use crate::measure::heat::RayFilter;
use crate::measure::measurement::Measurement;
use crate::structure::split::MethodInfo;
use crate::trace::{RayMaxima, Tally};

/// Something that is specified, counted or timed. It is declared once, in
/// [`COUNTERS`](super::COUNTERS), and serves as a parameter, as a heatmap and as figures for each kind
/// of ray, wherever it declares so.
pub struct Counter {
    /// The paper's symbol, such as `N_LS`, or one in its style.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    pub unit: Unit,
    /// What it means, in a sentence, including our reading of the paper if that is not obvious.
    pub meaning: &'static str,
    /// Its formula in terms of other counters; empty if it is counted, measured or given.
    pub formula: &'static str,
    pub value: Value,
    /// Whether a smaller value means less work. Only then can one tree be better in it than another:
    /// nobody knows the best number of leaves.
    pub less_is_better: bool,
    /// Whether it applies to the trees of a method.
    pub(super) applies: fn(&MethodInfo) -> bool,
    /// Whether its unit is the node of the structure, so that it means something else in another one.
    pub(super) counts_nodes: bool,
    pub(super) parameter: Option<(Table, Class)>,
    pub(in crate::measure) heatmap: Option<HeatmapEntry>,
    pub(super) ray_figures: Option<RayFigureEntry>,
}

/// Counts something in a [`Tally`].
pub type Count = fn(&Tally) -> u64;

/// Something that rays did.
#[derive(Clone, Copy)]
pub enum Quantity {
    Count(Count),
    /// The first count per unit of the second; no value if the second is 0.
    Ratio(Count, Count),
}

/// How the value of a counter is obtained.
#[derive(Clone, Copy)]
pub enum Value {
    /// `None` before it is measured, and for a ratio whose denominator is 0.
    Measured(fn(&Measurement) -> Option<f64>),
    /// The sum over rays of these kinds.
    Rays(RayFilter, Quantity),
    /// The standard deviation over rays of these kinds of the leaves that each visits.
    LeafDeviation(RayFilter),
    /// Only pixels have a value.
    PixelTime,
}

/// How a counter serves as a heatmap.
#[derive(Clone, Copy)]
pub struct HeatmapEntry {
    /// Its place in the list of heatmaps, from 1.
    pub place: u32,
    /// Unit of a pixel's value.
    pub unit: &'static str,
    /// The smallest difference that matters, in this unit.
    pub grain: f64,
    /// Whether a pixel's value is the depth complexity of its primary ray.
    pub is_depth_complexity: bool,
    /// Parameters that add up to the total of all pixels, each for one kind of ray. Empty if the
    /// counter is a parameter itself, or if there are none.
    pub parts: &'static [(RayFilter, &'static str)],
}

/// How a counter serves as figures for each kind of ray.
#[derive(Clone, Copy)]
pub struct RayFigureEntry {
    /// Its place among these counters, from 1. A ratio shares the place of the count that it belongs
    /// to.
    pub place: u32,
    /// The key in JSON and CSV.
    pub key: &'static str,
    /// What is counted, in the plural.
    pub noun: &'static str,
    /// The maximum of any ray. If there is one, there are figures for mean and maximum.
    pub maximum: Option<fn(&RayMaxima) -> u32>,
    /// Symbol of the parameter that the mean of all rays is, or empty.
    pub mean_symbol: &'static str,
}

impl Quantity {
    /// Returns its value for some rays.
    pub fn of(self, tally: &Tally) -> Option<f64> {
        match self {
            Quantity::Count(count) => Some(count(tally) as f64),
            Quantity::Ratio(over, under) => match under(tally) {
                0 => None,
                under => Some(over(tally) as f64 / under as f64),
            },
        }
    }
}

impl Counter {
    /// Returns whether it has a value for a whole measurement.
    pub fn is_parameter(&self) -> bool {
        self.parameter.is_some()
    }

    pub(super) const fn new(
        symbol: &'static str,
        name: &'static str,
        unit: Unit,
        meaning: &'static str,
        value: Value,
    ) -> Self {
        Counter {
            symbol,
            name,
            unit,
            meaning,
            formula: "",
            value,
            less_is_better: false,
            applies: |_| true,
            counts_nodes: false,
            parameter: None,
            heatmap: None,
            ray_figures: None,
        }
    }

    /// Makes it a parameter, listed in this table.
    pub(super) const fn parameter(mut self, table: Table, class: Class) -> Self {
        self.parameter = Some((table, class));
        self
    }

    pub(super) const fn formula(mut self, formula: &'static str) -> Self {
        self.formula = formula;
        self
    }

    pub(super) const fn less_is_better(mut self) -> Self {
        self.less_is_better = true;
        self
    }

    /// Restricts it to the trees of some methods.
    pub(super) const fn applies(mut self, applies: fn(&MethodInfo) -> bool) -> Self {
        self.applies = applies;
        self
    }

    /// Makes the node of the structure its unit.
    pub(super) const fn counts_nodes(mut self) -> Self {
        self.counts_nodes = true;
        self
    }

    /// Makes it a heatmap.
    pub(super) const fn heatmap(mut self, place: u32, unit: &'static str, grain: f64) -> Self {
        self.heatmap = Some(HeatmapEntry {
            place,
            unit,
            grain,
            is_depth_complexity: false,
            parts: &[],
        });
        self
    }

    /// Makes the depth complexity the values of its heatmap.
    pub(super) const fn of_depth_complexity(mut self) -> Self {
        if let Some(entry) = &mut self.heatmap {
            entry.is_depth_complexity = true;
        }
        self
    }

    /// Adds the parameters that its heatmap adds up to.
    pub(super) const fn parts(mut self, parts: &'static [(RayFilter, &'static str)]) -> Self {
        if let Some(entry) = &mut self.heatmap {
            entry.parts = parts;
        }
        self
    }

    /// Makes it a figure for each kind of ray.
    pub(super) const fn per_kind(
        mut self,
        place: u32,
        key: &'static str,
        noun: &'static str,
    ) -> Self {
        self.ray_figures = Some(RayFigureEntry {
            place,
            key,
            noun,
            maximum: None,
            mean_symbol: "",
        });
        self
    }

    /// Adds the mean and the maximum of single rays to its figures.
    pub(super) const fn of_single_rays(mut self, maximum: fn(&RayMaxima) -> u32) -> Self {
        if let Some(entry) = &mut self.ray_figures {
            entry.maximum = Some(maximum);
        }
        self
    }

    /// Names the parameter that the mean of all rays is.
    pub(super) const fn mean_is(mut self, symbol: &'static str) -> Self {
        if let Some(entry) = &mut self.ray_figures {
            entry.mean_symbol = symbol;
        }
        self
    }
}
