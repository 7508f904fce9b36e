//! Numbers with a chosen number of significant digits, and their units.

/// Shown in place of a missing value, and of one that is not finite.
pub const NO_VALUE: &str = "–";

/// Shown in place of the change of a value that has another unit.
pub const OTHER_UNIT: &str = "other unit";

/// A space at which no line breaks. egui breaks lines at the narrow no-break space, U+202F.
pub(super) const SPACE: char = '\u{a0}';

/// How many significant digits a number has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// Three, for cards.
    Three,
    /// Four, for tables.
    Four,
    /// As many as there are, for tooltips.
    All,
}

/// Significant digits that a product of the value with a power of ten still has.
const SCALED_DIGITS: usize = 12;

impl Digits {
    /// Formats a number. Large numbers end in k, M, G or T, very large and small ones in a power of
    /// ten; with all digits, only the latter.
    pub fn number(self, value: f64) -> String {
        let (most, compact_from) = match self {
            Digits::Three => (3, 4),
            Digits::Four => (4, 6),
            Digits::All => return all(value),
        };
        signed(value, |size| {
            let exponent = exponent(size, most);
            match exponent {
                ..-4 | 15.. => format!("{size:.*e}", most - 1),
                _ if exponent >= compact_from => {
                    let group = exponent / 3;
                    let mantissa = size / 10f64.powi(3 * group);
                    let suffix = ["", "k", "M", "G", "T"][group as usize];
                    let decimals = decimals(most, exponent % 3);
                    format!("{mantissa:.decimals$}{SPACE}{suffix}")
                }
                _ => fixed(size, decimals(most, exponent)),
            }
        })
    }

    /// Formats an integer in full, and any other number with these digits.
    pub fn exact_or(self, value: f64) -> String {
        if value.fract() == 0.0 {
            grouped(value)
        } else {
            self.number(value)
        }
    }

    /// Formats a count. Only cards shorten counts, from 10 000: tables compare them to the last digit.
    pub fn count(self, value: f64) -> String {
        match self {
            Digits::Three if value.abs() >= 9999.5 => self.number(value),
            _ => grouped(value),
        }
    }

    /// Formats a share, given as a fraction, in percent.
    pub fn percent(self, fraction: f64) -> String {
        let percent = fraction * 100.0;
        let number = match self {
            Digits::All => scaled(percent),
            _ => self.number(percent),
        };
        with_unit(number, "%")
    }

    /// Formats the difference between a value and another, given as a fraction of that, in percent
    /// and with its sign.
    pub fn signed_percent(self, fraction: f64) -> String {
        let plus = if fraction > 0.0 && fraction.is_finite() {
            "+"
        } else {
            ""
        };
        format!("{plus}{}", self.percent(fraction))
    }

    /// Formats a time in s, ms, µs or ns.
    pub fn seconds(self, value: f64) -> String {
        if value == 0.0 {
            return with_unit("0".into(), "s");
        }
        signed(value, |size| {
            let most = match self {
                Digits::Three => 3,
                Digits::Four => 4,
                Digits::All => SCALED_DIGITS,
            };
            let exponent = exponent(size, most);
            let (unit, below_one) = match exponent {
                0.. => ("s", 0),
                -3.. => ("ms", 3),
                -6.. => ("µs", 6),
                _ => ("ns", 9),
            };
            let in_unit = size * 10f64.powi(below_one);
            let number = match self {
                Digits::All => scaled(in_unit),
                _ => fixed(in_unit, decimals(most, exponent + below_one)),
            };
            with_unit(number, unit)
        })
    }

    /// Formats a size of memory in B, KiB, MiB or GiB; with all digits, in B.
    pub fn bytes(self, value: f64) -> String {
        const UNITS: [&str; 3] = ["KiB", "MiB", "GiB"];
        let most = match self {
            Digits::Three => 3,
            Digits::Four => 4,
            Digits::All => return with_unit(grouped(value), "B"),
        };
        if value.abs() < 1023.5 {
            return with_unit(grouped(value), "B");
        }
        signed(value, |size| {
            let mut in_unit = size;
            for (i, unit) in UNITS.into_iter().enumerate() {
                in_unit /= 1024.0;
                let decimals = decimals(most, exponent(in_unit, most));
                // A number that rounds to 1024 is 1 of the next unit.
                if in_unit < 1023.5 || i + 1 == UNITS.len() {
                    return with_unit(fixed(in_unit, decimals), unit);
                }
            }
            unreachable!("the last unit is always used")
        })
    }
}

/// Formats an integer in groups of three digits. Rounds other numbers.
pub fn grouped(value: f64) -> String {
    signed(value, |size| fixed(size, 0))
}

/// Returns a count with its noun, such as `1 sample`, `4 samples` or `2 leaves`.
pub fn counted(count: usize, noun: &str) -> String {
    let number = grouped(count as f64);
    let plural = match noun {
        _ if count == 1 => return format!("{number} {noun}"),
        _ if noun.ends_with("leaf") => format!("{}ves", noun.trim_end_matches('f')),
        _ if noun.ends_with(['x', 's']) => format!("{noun}es"),
        _ => format!("{noun}s"),
    };
    format!("{number} {plural}")
}

/// Appends a unit, unless the number is missing.
pub(super) fn with_unit(number: String, unit: &str) -> String {
    if number == NO_VALUE {
        number
    } else {
        format!("{number}{SPACE}{unit}")
    }
}

/// Formats a number by its size, with a real minus sign if it is negative.
fn signed(value: f64, text: impl FnOnce(f64) -> String) -> String {
    if !value.is_finite() {
        return NO_VALUE.into();
    }
    // Negative zero is zero.
    if value == 0.0 {
        return "0".into();
    }
    let text = text(value.abs()).replace('-', "−");
    if value < 0.0 && text != "0" {
        format!("−{text}")
    } else {
        text
    }
}

/// Returns the power of ten of the first digit after rounding to `most` significant digits.
fn exponent(size: f64, most: usize) -> i32 {
    let text = format!("{size:.*e}", most - 1);
    let exponent = text.split_once('e').and_then(|(_, e)| e.parse().ok());
    exponent.expect("a finite number above 0 has an exponent")
}

/// Returns how many decimals show `most` significant digits.
fn decimals(most: usize, exponent: i32) -> usize {
    (most as i32 - 1 - exponent).max(0) as usize
}

/// Formats a number that is not negative, with digits before the decimal point in groups.
fn fixed(size: f64, decimals: usize) -> String {
    in_groups(&format!("{size:.decimals$}"))
}

fn in_groups(text: &str) -> String {
    let (whole, fraction) = text.split_at(text.find('.').unwrap_or(text.len()));
    let mut out = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            out.push(SPACE);
        }
        out.push(digit);
    }
    out + fraction
}

/// Formats all digits of a number.
fn all(value: f64) -> String {
    signed(value, |size| {
        if (1e-5..1e15).contains(&size) {
            in_groups(&size.to_string())
        } else {
            format!("{size:e}")
        }
    })
}

/// Formats all digits of a product with a power of ten, without those that are noise of the
/// multiplication.
fn scaled(value: f64) -> String {
    let text = format!("{value:.*e}", SCALED_DIGITS - 1);
    text.parse().map_or_else(|_| NO_VALUE.into(), all)
}

#[cfg(test)]
mod tests {
    use super::Digits::{All, Four, Three};
    use super::*;

    /// Makes no-break spaces visible in expected texts.
    fn visible(text: String) -> String {
        assert!(!text.contains(' '), "{text}");
        text.replace(SPACE, "_")
    }

    #[test]
    fn numbers_have_the_digits_of_their_place() {
        for (value, three, four, all) in [
            (0.0, "0", "0", "0"),
            (-0.0, "0", "0", "0"),
            (0.5, "0.500", "0.5000", "0.5"),
            (-34.567, "−34.6", "−34.57", "−34.567"),
            (1234.5, "1_234", "1_234", "1_234.5"),
            (12345.6, "12.3_k", "12_346", "12_345.6"),
            (2127616.4, "2.13_M", "2.128_M", "2_127_616.4"),
            (5e11, "500_G", "500.0_G", "500_000_000_000"),
            (2.5e20, "2.50e20", "2.500e20", "2.5e20"),
            (0.00123, "0.00123", "0.001230", "0.00123"),
            (0.00001, "1.00e−5", "1.000e−5", "0.00001"),
            (1e-300, "1.00e−300", "1.000e−300", "1e−300"),
            (f64::NAN, "–", "–", "–"),
            (f64::INFINITY, "–", "–", "–"),
            (f64::NEG_INFINITY, "–", "–", "–"),
        ] {
            assert_eq!(visible(Three.number(value)), three);
            assert_eq!(visible(Four.number(value)), four);
            assert_eq!(visible(All.number(value)), all);
        }
    }

    #[test]
    fn a_number_that_rounds_up_to_the_next_digit_has_no_digit_too_many() {
        assert_eq!(Three.number(9.996), "10.0");
        assert_eq!(Three.number(0.99951), "1.00");
        assert_eq!(visible(Three.number(9_999.6)), "10.0_k");
        assert_eq!(visible(Three.number(999_960.0)), "1.00_M");
        assert_eq!(visible(Four.number(999_999.7)), "1.000_M");
        assert_eq!(Three.number(0.000_099_99), "0.000100");
        assert_eq!(visible(Three.seconds(0.000_999_6)), "1.00_ms");
        assert_eq!(visible(Three.seconds(0.9999)), "1.00_s");
        assert_eq!(visible(Four.seconds(0.9999)), "999.9_ms");
        assert_eq!(visible(Three.bytes(1_048_300.0)), "1.00_MiB");
        assert_eq!(visible(Three.bytes(1023.7)), "1.00_KiB");
    }

    #[test]
    fn only_cards_shorten_counts() {
        assert_eq!(visible(Three.count(2_127_616.0)), "2.13_M");
        assert_eq!(visible(Three.count(153_456.0)), "153_k");
        assert_eq!(visible(Three.count(9_999.0)), "9_999");
        assert_eq!(visible(Three.count(12.0)), "12");
        assert_eq!(visible(Four.count(2_127_616.0)), "2_127_616");
        assert_eq!(visible(All.count(2_127_616.0)), "2_127_616");
        assert_eq!(visible(grouped(-1234.0)), "−1_234");
        assert_eq!(grouped(-0.4), "0");
        assert_eq!(grouped(f64::NAN), "–");
    }

    #[test]
    fn times_choose_their_unit() {
        for (seconds, three, four, all) in [
            (0.0, "0_s", "0_s", "0_s"),
            (0.0052, "5.20_ms", "5.200_ms", "5.2_ms"),
            (83.25, "83.2_s", "83.25_s", "83.25_s"),
            (12345.6, "12_346_s", "12_346_s", "12_345.6_s"),
            (12.3456e-6, "12.3_µs", "12.35_µs", "12.3456_µs"),
            (8.3e-9, "8.30_ns", "8.300_ns", "8.3_ns"),
            (-0.25, "−250_ms", "−250.0_ms", "−250_ms"),
            (1e-12, "0.00100_ns", "0.001000_ns", "0.001_ns"),
            (f64::NAN, "–", "–", "–"),
        ] {
            assert_eq!(visible(Three.seconds(seconds)), three);
            assert_eq!(visible(Four.seconds(seconds)), four);
            assert_eq!(visible(All.seconds(seconds)), all);
        }
    }

    #[test]
    fn shares_and_memory_have_units() {
        assert_eq!(visible(Three.percent(0.2507)), "25.1_%");
        assert_eq!(visible(Four.percent(0.2507)), "25.07_%");
        assert_eq!(visible(All.percent(0.07)), "7_%");
        assert_eq!(visible(Three.percent(-0.5)), "−50.0_%");
        assert_eq!(Three.percent(f64::INFINITY), "–");
        assert_eq!(visible(Three.signed_percent(0.0123)), "+1.23_%");
        assert_eq!(visible(Three.signed_percent(-0.0123)), "−1.23_%");
        assert_eq!(visible(Three.signed_percent(0.0)), "0_%");
        assert_eq!(Three.signed_percent(f64::INFINITY), "–");
        assert_eq!(visible(Three.exact_or(12_345.0)), "12_345");
        assert_eq!(Three.exact_or(1.25), "1.25");
        assert_eq!(Three.exact_or(f64::NAN), "–");
        assert_eq!(visible(Three.bytes(0.0)), "0_B");
        assert_eq!(visible(Three.bytes(1000.0)), "1_000_B");
        assert_eq!(visible(Three.bytes(1_293_942.0)), "1.23_MiB");
        assert_eq!(visible(Four.bytes(1_293_942.0)), "1.234_MiB");
        assert_eq!(visible(All.bytes(1_293_942.0)), "1_293_942_B");
        assert_eq!(visible(Three.bytes(5e12)), "4_657_GiB");
        assert_eq!(Four.bytes(f64::NAN), "–");
    }

    #[test]
    fn nouns_agree_with_their_count() {
        assert_eq!(counted(0, "sample"), "0 samples");
        assert_eq!(counted(1, "leaf"), "1 leaf");
        assert_eq!(counted(2, "empty leaf"), "2 empty leaves");
        assert_eq!(counted(3, "box"), "3 boxes");
        assert_eq!(counted(1200, "ray"), "1\u{a0}200 rays");
    }
}
