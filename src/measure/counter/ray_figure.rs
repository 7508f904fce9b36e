//! The counters that have a value for each kind of ray: totals, means and maxima of single rays.

use super::class::Unit;
use super::declaration::{Count, Counter, Quantity, RayFigureEntry, Value};
use super::list::COUNTERS;
use crate::measure::measurement::Measurement;
use crate::trace::{RayKind, RayMaxima, Tally};
use std::sync::LazyLock;

/// A figure of the rays of one kind.
pub struct RayFigure {
    /// The key in JSON and CSV.
    pub key: String,
    /// Name in words, with the symbol of the parameter that it is for all rays together, if any.
    pub name: String,
    pub unit: Unit,
    /// What it means.
    pub meaning: String,
    /// Whether a smaller value means less work.
    pub less_is_better: bool,
    counts_nodes: bool,
    statistic: Statistic,
}

/// The statistic of a figure.
#[derive(Clone, Copy)]
enum Statistic {
    Of(Quantity),
    /// Per ray.
    Mean(Count),
    /// Of any ray.
    Maximum(fn(&RayMaxima) -> u32),
    /// The standard deviation of leaves per ray.
    LeafDeviation,
}

impl RayFigure {
    /// Returns its value for rays of a kind. `None` before they are counted, for a ratio whose
    /// denominator is 0, and for means and maxima without rays.
    pub fn of(&self, measurement: &Measurement, kind: RayKind) -> Option<f64> {
        let counted = measurement.counted.as_ref()?;
        let tally: &Tally = &counted.tallies[kind as usize];
        match self.statistic {
            Statistic::Of(quantity) => quantity.of(tally),
            _ if tally.rays == 0 => None,
            Statistic::Mean(count) => Some(count(tally) as f64 / tally.rays as f64),
            Statistic::Maximum(maximum) => Some(f64::from(maximum(&counted.maxima[kind as usize]))),
            Statistic::LeafDeviation => counted.leaf_deviation(&[kind]),
        }
    }

    /// Returns whether its values have the same unit in both measurements, as
    /// [`Parameter::has_same_unit`](super::Parameter::has_same_unit).
    pub fn has_same_unit(&self, a: &Measurement, b: &Measurement) -> bool {
        !self.counts_nodes || a.kind_of_node() == b.kind_of_node()
    }
}

/// Returns every figure, in the order of reports.
pub fn ray_figures() -> &'static [RayFigure] {
    static RAY_FIGURES: LazyLock<Vec<RayFigure>> = LazyLock::new(|| {
        let mut placed: Vec<_> = COUNTERS.iter().flat_map(figures).collect();
        placed.sort_by_key(|(place, _)| *place);
        placed.into_iter().map(|(_, figure)| figure).collect()
    });
    &RAY_FIGURES
}

/// Returns the figures of a counter with their places: the total before ratios, mean and maximum.
fn figures(counter: &Counter) -> Vec<([u32; 2], RayFigure)> {
    let Some(entry) = counter.ray_figures else {
        return Vec::new();
    };
    let RayFigureEntry {
        place,
        key,
        noun,
        maximum,
        mean_symbol,
    } = entry;
    let (statistic, order) = match counter.value {
        Value::Rays(_, quantity @ Quantity::Count(_)) => (Statistic::Of(quantity), 0),
        Value::Rays(_, quantity @ Quantity::Ratio(..)) => (Statistic::Of(quantity), 1),
        Value::LeafDeviation(_) => (Statistic::LeafDeviation, 4),
        Value::Measured(_) | Value::PixelTime => return Vec::new(),
    };
    let counts_nodes = counter.counts_nodes;
    let named = |name: String, symbol: &str| match symbol {
        "" => name,
        symbol => format!("{name} ({symbol})"),
    };
    let (meaning, less_is_better) = (counter.meaning, counter.less_is_better);
    let symbol = counter.parameter.map_or("", |_| counter.symbol);
    let total = RayFigure {
        key: key.to_owned(),
        name: named(noun.to_owned(), symbol),
        unit: counter.unit,
        meaning: meaning.to_owned(),
        less_is_better,
        counts_nodes,
        statistic,
    };
    let mut figures = vec![([place, order], total)];
    if let (Some(maximum), Statistic::Of(Quantity::Count(count))) = (maximum, statistic) {
        let mean = RayFigure {
            key: format!("{key}_mean"),
            name: named(format!("{noun} per ray, mean"), mean_symbol),
            unit: Unit::Ratio,
            meaning: format!("{meaning} Mean per ray."),
            less_is_better,
            counts_nodes,
            statistic: Statistic::Mean(count),
        };
        let most = RayFigure {
            key: format!("{key}_most"),
            name: format!("{noun} per ray, maximum"),
            unit: Unit::Count,
            meaning: format!("{meaning} Maximum of any ray."),
            less_is_better,
            counts_nodes,
            statistic: Statistic::Maximum(maximum),
        };
        figures.extend([([place, 2], mean), ([place, 3], most)]);
    }
    figures
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_names_are_there_once() {
        assert!(!ray_figures().is_empty());
        for (i, figure) in ray_figures().iter().enumerate() {
            let mut before = ray_figures()[..i].iter();
            assert!(before.all(|f| f.key != figure.key && f.name != figure.name));
        }
    }
}
