//! Places on the screen, as files keep them.

/// To four digits: a place on the screen is no more exact.
pub fn rounded(place: f32) -> f64 {
    (f64::from(place) * 1e4).round() / 1e4
}
