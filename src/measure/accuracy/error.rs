//! Image error metrics. They work on linear light, clipped to the range 0 to 1 of a display.

use super::filter::{filtered, gaussian};
use super::flip::flip;
use serde::Serialize;

/// The error of a picture p relative to a reference r of the same size.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ImageError {
    /// Root mean square of p − r over all pixels and color channels; 0 if equal.
    pub rmse: f64,
    /// Largest |p − r| of any pixel and color channel.
    pub max: f64,
    /// Peak signal-to-noise ratio, −20 log₁₀ RMSE, in decibels; `None` (infinite) if equal.
    pub psnr: Option<f64>,
    /// Mean structural similarity of the luminance, at most 1; 1 if equal.
    pub ssim: f64,
    /// Mean FLIP, the difference that a viewer sees when alternating between the pictures: 0 (the
    /// same) to 1.
    pub flip: f64,
}

impl ImageError {
    /// Computes all metrics of a picture with `width` pixels per row.
    ///
    /// # Panics
    /// If the pictures differ in size, or `width` does not divide the number of pixels.
    pub fn between(picture: &[[f32; 3]], reference: &[[f32; 3]], width: usize) -> Self {
        assert_eq!(picture.len(), reference.len());
        assert!(width > 0 && picture.len().is_multiple_of(width));
        let (mut squares, mut max) = (0.0, 0.0_f64);
        for (p, r) in picture.iter().zip(reference) {
            for off in off(p, r) {
                squares += off * off;
                max = max.max(off.abs());
            }
        }
        let rmse = (squares / (3 * picture.len()).max(1) as f64).sqrt();
        ImageError {
            rmse,
            max,
            psnr: (rmse > 0.0).then(|| -20.0 * rmse.log10()),
            ssim: ssim(&luminance(picture), &luminance(reference), width),
            flip: flip(picture, reference, width),
        }
    }
}

/// Returns the error of every pixel of a picture p relative to a reference r: the root mean square
/// of p − r over its color channels, 0 to 1. The root mean square of all pixel errors is the RMSE.
///
/// # Panics
/// If the pictures differ in size.
pub fn pixel_errors(picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Vec<f32> {
    assert_eq!(picture.len(), reference.len());
    let pixels = picture.iter().zip(reference);
    pixels
        .map(|(p, r)| {
            let squares: f64 = off(p, r).map(|off| off * off).iter().sum();
            (squares / 3.0).sqrt() as f32
        })
        .collect()
}

/// Returns p − r for each color channel, after clipping.
fn off(p: &[f32; 3], r: &[f32; 3]) -> [f64; 3] {
    std::array::from_fn(|i| f64::from(p[i].clamp(0.0, 1.0)) - f64::from(r[i].clamp(0.0, 1.0)))
}

/// Returns the relative luminance of each pixel (Rec. ITU-R BT.709).
fn luminance(pixels: &[[f32; 3]]) -> Vec<f64> {
    pixels
        .iter()
        .map(|p| {
            let [r, g, b] = p.map(|v| f64::from(v.clamp(0.0, 1.0)));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        })
        .collect()
}

/// Returns the mean structural similarity over all pixels:
/// (2 μp μr + C₁)(2 σpr + C₂) / ((μp² + μr² + C₁)(σp² + σr² + C₂)), C₁ = 0.01², C₂ = 0.03².
/// Means and variances are weighted by a Gaussian with σ = 1.5 pixels over 11 × 11 pixels. Beyond
/// the border, the outermost pixels repeat.
///
/// Source: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment", IEEE Transactions on
/// Image Processing 13(4), 2004.
fn ssim(picture: &[f64], reference: &[f64], width: usize) -> f64 {
    const C1: f64 = 0.01 * 0.01;
    const C2: f64 = 0.03 * 0.03;
    let product =
        |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
    let kernel = gaussian(5, 1.5);
    let blurred = |values: &[f64]| filtered(values, width, &kernel, &kernel);
    let [p, r] = [picture, reference].map(blurred);
    let pp = blurred(&product(picture, picture));
    let rr = blurred(&product(reference, reference));
    let pr = blurred(&product(picture, reference));
    let sum: f64 = (0..picture.len())
        .map(|i| {
            let (p, r) = (p[i], r[i]);
            let (vp, vr, c) = (pp[i] - p * p, rr[i] - r * r, pr[i] - p * r);
            (2.0 * p * r + C1) * (2.0 * c + C2) / ((p * p + r * r + C1) * (vp + vr + C2))
        })
        .sum();
    sum / picture.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_no_error() {
        let picture: Vec<_> = (0..200).map(|i| [i as f32 / 200.0, 0.5, 3.0]).collect();
        let error = ImageError::between(&picture, &picture, 20);
        assert_eq!((error.rmse, error.max, error.psnr), (0.0, 0.0, None));
        assert!((error.ssim - 1.0).abs() < 1e-12);
        assert_eq!(error.flip, 0.0);
    }

    #[test]
    fn known_errors_come_out() {
        // 0.1 brighter everywhere: PSNR is 20 dB, and only the luminance term of SSIM changes.
        let picture = |v: f32| vec![[v; 3]; 400];
        let error = ImageError::between(&picture(0.5), &picture(0.4), 20);
        assert!((error.rmse - 0.1).abs() < 1e-7 && (error.max - 0.1).abs() < 1e-7);
        assert!((error.psnr.unwrap() - 20.0).abs() < 1e-5);
        let expected = (2.0 * 0.5 * 0.4 + 1e-4) / (0.25 + 0.16 + 1e-4);
        assert!((error.ssim - expected).abs() < 1e-6, "{}", error.ssim);
    }

    #[test]
    fn the_errors_of_the_pixels_make_the_rmse() {
        let picture: Vec<_> = (0..200).map(|i| [i as f32 / 150.0, 0.5, 0.1]).collect();
        let reference: Vec<_> = (0..200).map(|i| [0.3, i as f32 / 90.0, 0.1]).collect();
        let errors = pixel_errors(&picture, &reference);
        let squares: f64 = errors.iter().map(|&e| f64::from(e).powi(2)).sum();
        let whole = ImageError::between(&picture, &reference, 20);
        assert!(((squares / 200.0).sqrt() - whole.rmse).abs() < 1e-7);
        let clipped = pixel_errors(&[[0.0, 0.6, 5.0]], &[[0.0, 0.0, 1.0]])[0];
        assert!((clipped - 0.12_f32.sqrt()).abs() < 1e-6, "{clipped}");
    }

    #[test]
    fn lost_structure_lowers_ssim_more_than_an_even_shift() {
        let stripes: Vec<_> = (0..400).map(|i| [(i % 2) as f32 * 0.4 + 0.3; 3]).collect();
        let shifted: Vec<_> = stripes.iter().map(|p| p.map(|v| v + 0.2)).collect();
        let flat = vec![[0.5; 3]; 400];
        let [shifted, flat] = [shifted, flat].map(|p| ImageError::between(&p, &stripes, 20));
        assert!((shifted.rmse - flat.rmse).abs() < 1e-6);
        assert!(flat.ssim < 0.2 && shifted.ssim > 0.8);
    }
}
