//! The numbers that can express the error of an outcome. A measure is one entry of
//! [`ERROR_MEASURES`].

use super::outcome::Outcome;

/// An error as one number: 0 is no error, smaller is better.
pub struct ErrorMeasure {
    pub name: &'static str,
    /// Its definition and range, in one sentence.
    pub about: &'static str,
    pub value: fn(&Outcome) -> f64,
}

/// All measures; the first is the default. PSNR is not included because it ranks outcomes as RMSE
/// does.
pub static ERROR_MEASURES: &[ErrorMeasure] = &[
    ErrorMeasure {
        name: "RMSE",
        about: "Square root of the mean squared difference over all pixels and colors, on linear \
                light, 0 to 1.",
        value: |outcome| outcome.error.rmse,
    },
    ErrorMeasure {
        name: "max",
        about: "Largest difference of any pixel and color, on linear light, 0 to 1.",
        value: |outcome| outcome.error.max,
    },
    ErrorMeasure {
        name: "1 − SSIM",
        about: "One less the mean structural similarity of the luminance (Wang et al. 2004), 0 to 2.",
        value: |outcome| 1.0 - outcome.error.ssim,
    },
    ErrorMeasure {
        name: "FLIP",
        about: "How different the pictures look when one flips between them, 0.7 m from a display 0.7 m \
                wide with 3840 pixels (Andersson et al. 2020), 0 to 1.",
        value: |outcome| outcome.error.flip,
    },
    ErrorMeasure {
        name: "wrong hits",
        about: "Share of the pixels whose primary ray hits a different object than it should, 0 to 1.",
        value: |outcome| outcome.wrong_hits,
    },
];
