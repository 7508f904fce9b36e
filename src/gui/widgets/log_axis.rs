//! The numbers of an axis of logarithms.

use super::common::nice_step;
use egui_plot::{GridInput, GridMark};

/// Marks of an axis of logarithms: powers of ten with their 2- and 5-folds, or powers alone, as have
/// room; within less than a decade, round numbers.
pub fn marks(input: GridInput) -> Vec<GridMark> {
    let (lo, hi) = input.bounds;
    let span = hi - lo;
    if span < 1.0 {
        let (least, most) = (libm::exp10(lo), libm::exp10(hi));
        let step = nice_step((most - least) / 6.0);
        let first = (least / step).ceil();
        return (0..20)
            .map(|i| (first + f64::from(i)) * step)
            .take_while(|&value| value <= most)
            .filter(|&value| value > 0.0)
            .map(|value| GridMark {
                value: value.log10(),
                step_size: (1.0 + step / value).log10(),
            })
            .collect();
    }
    let every = (span / 12.0).ceil().max(1.0) as i64;
    let folds: &[f64] = if span < 3.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    (lo.floor() as i64..=hi.ceil() as i64)
        .filter(|power| power.rem_euclid(every) == 0)
        .flat_map(|power| folds.iter().map(move |fold| (power, fold)))
        .map(|(power, fold)| GridMark {
            value: power as f64 + fold.log10(),
            step_size: if *fold == 1.0 { every as f64 } else { 0.3 },
        })
        .filter(|mark| (lo..=hi).contains(&mark.value))
        .collect()
}

/// The number of which this is the logarithm, in two digits or three.
pub fn number(log: f64) -> String {
    let value = libm::exp10(log);
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if (1e-3..1e4).contains(&rounded) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(lo: f64, hi: f64) -> Vec<String> {
        let input = GridInput {
            bounds: (lo.log10(), hi.log10()),
            base_step_size: 0.01,
        };
        marks(input).iter().map(|mark| number(mark.value)).collect()
    }

    #[test]
    fn axes_have_round_numbers_as_far_as_they_reach() {
        assert_eq!(values(0.04, 1.1), ["0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(values(0.9, 1.1), ["0.9", "0.95", "1", "1.05", "1.1"]);
        let wide = values(1e-9, 1.0);
        assert_eq!((wide.len(), &*wide[0], &*wide[9]), (10, "1e-9", "1"));
        assert!(values(1e-30, 1.0).len() < 14);
    }
}
