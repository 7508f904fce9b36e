//! How far off a prediction may be.

/// How far off a prediction may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    Absolute(f64),
    /// A fraction of the true value.
    Relative(f64),
}

impl Tolerance {
    /// Parses `20 %` or a number.
    ///
    /// # Errors
    /// What was expected.
    pub fn parse(text: &str) -> Result<Tolerance, String> {
        let (number, share) = match text.trim().strip_suffix('%') {
            Some(number) => (number.trim(), true),
            None => (text.trim(), false),
        };
        let number = number.parse::<f64>().ok();
        let number = number.filter(|n| *n >= 0.0 && n.is_finite());
        match (number, share) {
            (Some(percent), true) => Ok(Tolerance::Relative(percent / 100.0)),
            (Some(number), false) => Ok(Tolerance::Absolute(number)),
            (None, _) => Err(format!("expected a number or '20 %', found '{text}'")),
        }
    }

    /// Returns how far a prediction may be from the truth.
    pub(super) fn largest_error(self, truth: f64) -> f64 {
        match self {
            Tolerance::Absolute(most) => most,
            Tolerance::Relative(share) => share * truth.abs(),
        }
    }
}

impl std::fmt::Display for Tolerance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Tolerance::Absolute(most) => write!(f, "{most}"),
            Tolerance::Relative(share) => write!(f, "{} %", share * 100.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_are_shares_or_numbers() {
        assert_eq!(Tolerance::parse("20 %"), Ok(Tolerance::Relative(0.2)));
        assert_eq!(Tolerance::parse("3"), Ok(Tolerance::Absolute(3.0)));
        for wrong in ["", "x", "-1", "5 %%", "inf"] {
            assert!(Tolerance::parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(Tolerance::Relative(0.2).largest_error(-10.0), 2.0);
        assert_eq!(Tolerance::Absolute(1.0).largest_error(-10.0), 1.0);
    }
}
