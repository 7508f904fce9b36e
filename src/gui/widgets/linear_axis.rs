//! The numbers of a linear axis.

use super::common::nice_step;
use egui_plot::GridMark;

/// The round numbers of an axis.
#[derive(Clone, Copy)]
pub struct Marks {
    range: [f64; 2],
    step: f64,
}

impl Marks {
    /// Creates the marks of a range, about this many at most.
    pub fn new(range: [f64; 2], most: f32) -> Self {
        let [lo, hi] = range;
        let step = nice_step((hi - lo) / f64::from(most.max(2.0)));
        Marks { range, step }
    }

    /// Returns all marks.
    pub fn all(self) -> Vec<GridMark> {
        let Marks {
            range: [lo, hi],
            step,
        } = self;
        let first = (lo / step).ceil();
        (0..)
            .map(|i| (first + f64::from(i)) * step)
            .take_while(|&value| value <= hi)
            .map(|value| GridMark {
                value,
                step_size: step,
            })
            .collect()
    }

    /// Returns the number of a mark, with as many decimals as all of them need.
    pub fn text(self, value: f64) -> String {
        let digits = (-self.step.log10().floor()).clamp(0.0, 12.0) as usize;
        format!("{value:.digits$}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(range: [f64; 2], most: f32) -> Vec<String> {
        let marks = Marks::new(range, most);
        let all = marks.all();
        all.iter().map(|mark| marks.text(mark.value)).collect()
    }

    #[test]
    fn axes_have_round_numbers() {
        assert_eq!(
            texts([0.0, 1050.0], 6.0),
            ["0", "200", "400", "600", "800", "1000"]
        );
        assert_eq!(texts([0.0223, 0.0379], 5.0), ["0.025", "0.030", "0.035"]);
        assert_eq!(texts([-0.5, 0.82], 3.0), ["-0.5", "0.0", "0.5"]);
    }
}
