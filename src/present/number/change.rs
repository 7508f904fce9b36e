//! The change of a value, as a person says it.

use super::digits::{Digits, OTHER_UNIT, SPACE, grouped};
use crate::measure::{Comparison, Measurement, Parameter, RayFigure, Unit};
use crate::trace::RayKind;

/// The change of a value in words, such as `−35 %`, `4.3× fewer` or `+11.5 points`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangeText {
    pub text: String,
    /// The value before; `None` if `text` says it, and if there is no change.
    pub before: Option<String>,
    pub direction: Direction,
}

/// Whether a change is for the better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Better,
    Worse,
    /// No change, or neither way is better.
    Neutral,
}

/// The smallest change that is written as a number, in percent or percentage points.
const LEAST: f64 = 0.01;

/// Above this, a ratio is not written as a number.
const MOST_TIMES: f64 = 1e6;

impl Parameter {
    /// Describes the change from one value to another; `None` if there is none or one is not finite.
    pub fn change_text(&self, before: Option<f64>, now: Option<f64>) -> Option<ChangeText> {
        // Symbols of numbers begin with N. A depth, a weight or a cost is not "fewer".
        let words = match self.unit {
            Unit::Count | Unit::Ratio if !self.symbol.starts_with('N') => ["lower", "higher"],
            unit => words(unit),
        };
        change(self.unit, words, self.less_is_better, before, now)
    }
}

impl Parameter {
    /// Describes the change from one measurement to another, or says that the unit is another one; `None` if a
    /// value is missing.
    pub fn comparison_text(&self, before: &Measurement, now: &Measurement) -> Option<ChangeText> {
        match self.compare(before, now) {
            Comparison::OtherUnit => Some(other_unit()),
            _ => self.change_text(self.value(before), self.value(now)),
        }
    }
}

impl RayFigure {
    /// Describes the change from one measurement to another, as [`Parameter::comparison_text`].
    pub fn comparison_text(
        &self,
        before: &Measurement,
        now: &Measurement,
        kind: RayKind,
    ) -> Option<ChangeText> {
        match self.compare(before, now, kind) {
            Comparison::OtherUnit => Some(other_unit()),
            _ => self.change_text(self.of(before, kind), self.of(now, kind)),
        }
    }

    /// Describes the change from one value to another; `None` if there is none or one is not finite.
    pub fn change_text(&self, before: Option<f64>, now: Option<f64>) -> Option<ChangeText> {
        let words = words(self.unit);
        change(self.unit, words, self.less_is_better, before, now)
    }
}

impl ChangeText {
    /// Returns the change with the value before, such as `4.3× fewer, was 78.2`.
    pub fn with_before(&self) -> String {
        match &self.before {
            Some(before) => format!("{}, was {before}", self.text),
            None => self.text.clone(),
        }
    }
}

fn other_unit() -> ChangeText {
    ChangeText {
        text: OTHER_UNIT.into(),
        before: None,
        direction: Direction::Neutral,
    }
}

/// Returns the words for less and more of a unit. Times become faster, not fewer.
const fn words(unit: Unit) -> [&'static str; 2] {
    match unit {
        Unit::Count | Unit::Ratio => ["fewer", "more"],
        Unit::Seconds => ["faster", "slower"],
        Unit::Volume => ["smaller", "larger"],
        Unit::Rate => ["slower", "faster"],
        Unit::Percent | Unit::Bytes => ["less", "more"],
    }
}

fn change(
    unit: Unit,
    words: [&'static str; 2],
    less_is_better: bool,
    before: Option<f64>,
    now: Option<f64>,
) -> Option<ChangeText> {
    let finite = |value: &f64| value.is_finite();
    let (before, now) = (before.filter(finite)?, now.filter(finite)?);
    let was = unit.text(before, Digits::Three);
    let (text, was) = match unit {
        _ if before == now => ("no change".into(), None),
        Unit::Percent => (points((now - before) * 100.0, words), Some(was)),
        // Nothing is a multiple of zero, or of a value of the other sign.
        _ if before == 0.0 || before * now < 0.0 => (format!("was {was}"), None),
        _ if now == 0.0 => (format!("now {}", unit.text(0.0, Digits::Three)), Some(was)),
        _ => (ratio(now / before, words), Some(was)),
    };
    let direction = match now < before {
        _ if !less_is_better || before == now => Direction::Neutral,
        true => Direction::Better,
        false => Direction::Worse,
    };
    Some(ChangeText {
        text,
        before: was,
        direction,
    })
}

/// Describes a ratio: up to a factor of 2 in percent, above that as a factor.
fn ratio(ratio: f64, [less, more]: [&str; 2]) -> String {
    if (0.5..=2.0).contains(&ratio) {
        let percent = (ratio - 1.0) * 100.0;
        return signed(
            percent,
            [less, more],
            "%",
            usize::from(percent.abs() < 9.95),
        );
    }
    let (factor, word) = if ratio < 1.0 {
        (1.0 / ratio, less)
    } else {
        (ratio, more)
    };
    let factor = match factor {
        ..9.95 => format!("{factor:.1}"),
        ..=MOST_TIMES => grouped(factor),
        _ => format!("over {}", grouped(MOST_TIMES)),
    };
    format!("{factor}× {word}")
}

/// Describes a difference in percentage points.
fn points(points: f64, words: [&str; 2]) -> String {
    signed(points, words, "points", usize::from(points.abs() < 999.5))
}

/// Formats a number with its sign and unit. One that has no digit but 0 gets another decimal.
fn signed(value: f64, [less, more]: [&str; 2], unit: &str, decimals: usize) -> String {
    let (sign, word) = if value < 0.0 {
        ("−", less)
    } else {
        ("+", more)
    };
    let size = value.abs();
    if size < LEAST {
        return format!("<{SPACE}{LEAST}{SPACE}{unit} {word}");
    }
    let number = match size {
        ..0.095 => format!("{size:.2}"),
        _ if decimals > 0 => format!("{size:.decimals$}"),
        _ => grouped(size),
    };
    format!("{sign}{number}{SPACE}{unit}")
}

#[cfg(test)]
mod tests {
    use super::Direction::{Better, Neutral, Worse};
    use super::*;
    use crate::measure::{COUNTERS, parameter, ray_figures};

    fn change(symbol: &str, before: f64, now: f64) -> (String, Direction) {
        let found = parameter(symbol).change_text(Some(before), Some(now));
        let found = found.expect("a change");
        (found.text.replace(SPACE, "_"), found.direction)
    }

    #[test]
    fn changes_up_to_a_factor_of_two_are_in_percent() {
        for (before, now, text, direction) in [
            (100.0, 65.0, "−35_%", Better),
            (100.0, 120.0, "+20_%", Worse),
            (100.0, 200.0, "+100_%", Worse),
            (100.0, 50.0, "−50_%", Better),
            (100.0, 103.5, "+3.5_%", Worse),
            (100.0, 109.96, "+10_%", Worse),
            (100.0, 100.03, "+0.03_%", Worse),
            (100.0, 100.001, "<_0.01_% more", Worse),
            (100.0, 99.999, "<_0.01_% fewer", Better),
            (100.0, 100.0, "no change", Neutral),
        ] {
            assert_eq!(change("N_RPRT", before, now), (text.into(), direction));
        }
    }

    #[test]
    fn larger_changes_are_factors() {
        for (symbol, before, now, text, direction) in [
            ("N_RPRT", 100.0, 201.0, "2.0× more", Worse),
            ("N_RPRT", 310.0, 10.0, "31× fewer", Better),
            ("N_AT", 78.2, 18.2, "4.3× fewer", Better),
            ("N_AT", 10.0, 99.6, "10× more", Worse),
            ("N_IN", 1.0, 12_345.0, "12_345× more", Neutral),
            ("N_IN", 1.0, 1e9, "over 1_000_000× more", Neutral),
            ("T_TR", 0.052, 0.012, "4.3× faster", Better),
            ("T_CB", 0.012, 0.052, "4.3× slower", Worse),
            ("T_TR", 0.052, 0.050, "−3.8_%", Better),
            ("V_EMPTY", 1.0, 4.0, "4.0× larger", Neutral),
            ("M_TREE", 1e6, 1e3, "1_000× less", Neutral),
            ("D_REACH", 5.0, 20.0, "4.0× higher", Neutral),
            ("C_SAH", 5.0, 20.0, "4.0× higher", Worse),
            ("N_BT", 20.0, 5.0, "4.0× fewer", Better),
            ("rays/s", 5.0, 20.0, "4.0× faster", Neutral),
        ] {
            assert_eq!(change(symbol, before, now), (text.into(), direction));
        }
    }

    #[test]
    fn shares_change_by_points() {
        for (before, now, text) in [
            (0.25, 0.365, "+11.5_points"),
            (0.323, 0.254, "−6.9_points"),
            (45.05, 13.37, "−3_168_points"),
            (0.5, 0.5004, "+0.04_points"),
            (0.5, 0.500001, "<_0.01_points more"),
            (0.0, 0.5, "+50.0_points"),
            (0.5, 0.5, "no change"),
        ] {
            assert_eq!(change("R_ETNLS", before, now), (text.into(), Neutral));
        }
    }

    #[test]
    fn nothing_is_a_multiple_of_zero() {
        assert_eq!(change("N_ELS", 0.0, 12.0), ("was 0".into(), Neutral));
        assert_eq!(change("N_ELS", -0.0, 0.0), ("no change".into(), Neutral));
        assert_eq!(change("N_SRIT", 0.0, 12.0), ("was 0".into(), Worse));
        assert_eq!(change("N_SRIT", 12.0, 0.0), ("now 0".into(), Better));
        assert_eq!(change("T_TR", 0.01, 0.0), ("now 0_s".into(), Better));
        assert_eq!(change("N_ELS", -3.0, 5.0), ("was −3".into(), Neutral));
        let tests = parameter("N_RPRT");
        for value in [None, Some(f64::NAN), Some(f64::INFINITY)] {
            assert_eq!(tests.change_text(value, Some(1.0)), None);
            assert_eq!(tests.change_text(Some(1.0), value), None);
        }
    }

    #[test]
    fn the_value_before_is_added_where_it_is_news() {
        let chip = |before, now| {
            let change = parameter("N_RPRT").change_text(Some(before), Some(now));
            change.expect("a change").with_before()
        };
        assert_eq!(chip(78.2, 18.2), "4.3× fewer, was 78.2");
        assert_eq!(chip(0.0, 18.2), "was 0");
        assert_eq!(chip(18.2, 18.2), "no change");
        assert_eq!(chip(18.2, 0.0), "now 0, was 18.2");
    }

    #[test]
    fn no_change_exceeds_a_hundred_percent() {
        for symbol in ["N_RPRT", "T_TR", "M_TREE", "V_EMPTY", "D_REACH"] {
            for exponent in -80..=80 {
                let (text, _) = change(symbol, 1.0, 1.1f64.powi(exponent));
                if let Some(percent) = text.strip_suffix("_%") {
                    let percent: f64 = percent.replace('−', "-").parse().expect("a number");
                    assert!((-50.0..=100.0).contains(&percent), "{text}");
                }
            }
        }
    }

    #[test]
    fn less_is_better_of_tests_nodes_and_times_only() {
        let better: Vec<_> = COUNTERS.iter().filter(|c| c.less_is_better).collect();
        let symbols: Vec<_> = better.iter().map(|c| c.symbol).collect();
        let expected = "T_CB N_PRIT N_SRIT N_SECRIT N_RPRT N_VLS N_VFLS N_INODES N_NODES N_AT T_TR \
                        T_TT T_CB_WALL T_TR_WALL C_SAH EPO N_BT N_BT/ray N_PT B_RAY N_IT T_PIXEL";
        assert_eq!(symbols.join(" "), expected);
        let of = |key: &str| {
            let figure = ray_figures().iter().find(|f| f.key == key);
            let change = figure.expect(key).change_text(Some(9.0), Some(3.0));
            change.expect("a change")
        };
        assert_eq!(of("tests_mean").direction, Better);
        assert_eq!(of("tests_mean").text, "3.0× fewer");
        assert_eq!(of("rays").direction, Neutral);
    }
}
