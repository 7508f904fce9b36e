//! Numbers as in the published scene files: printed by C's `%g` and read back.

use crate::geometry::Vec3;

/// Returns the value of `printf("%g", x)` read back: `x` rounded to 6 significant digits. Keeps the
/// sign of zero. `x` must be finite.
pub fn round_g(x: f64) -> f64 {
    format!("{x:.5e}")
        .parse()
        .expect("a formatted number reads back")
}

/// Applies [`round_g`] to every coordinate.
pub fn round_point(p: Vec3) -> Vec3 {
    Vec3::from_array(p.to_array().map(round_g))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_that_c_prints() {
        // Left: x. Right: what printf("%g", x) of glibc writes.
        for (x, printed) in [
            (0.0, "0"),
            (0.1234565, "0.123456"),
            (0.12345649999, "0.123456"),
            (1e-5, "1e-05"),
            (123456.7, "123457"),
            (1234567.0, "1.23457e+06"),
            (999999.5, "1e+06"),
            (0.99999949, "0.999999"),
            (-2.0 / 3.0, "-0.666667"),
            (1.2246467991473532e-16, "1.22465e-16"),
            // Exact ties are rounded to the even digit.
            (123456.5, "123456"),
            (123457.5, "123458"),
            (1.000005e7, "1e+07"),
            (1.000015e7, "1.00002e+07"),
        ] {
            assert_eq!(round_g(x), printed.parse::<f64>().unwrap(), "{x}");
        }
    }

    #[test]
    fn negative_zero_stays_negative() {
        assert!(round_g(-0.0).is_sign_negative());
        assert_eq!(round_g(-0.0), 0.0);
    }

    #[test]
    fn rounding_again_changes_nothing() {
        for i in 1..2000 {
            let x = round_g(libm::sin(f64::from(i)) * libm::exp(f64::from(i % 37) - 18.0));
            assert_eq!(round_g(x), x);
        }
    }
}
