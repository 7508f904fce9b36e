//! FLIP: the difference that a viewer sees when alternating between two pictures.
//!
//! Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference
//! Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive
//! Techniques 3(2), 2020. The constants are those of the article.
//!
//! The one existing library needs a C++ compiler and 8-bit images. This implementation works on
//! linear light directly.

use super::filter::{Kernel, filtered, gaussian, kernel};
use std::f64::consts::{PI, SQRT_2};

/// Pixels per degree of visual angle, for a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * (PI / 180.0);

/// Matrix from linear light (Rec. ITU-R BT.709) to CIE XYZ.
const TO_XYZ: [[f64; 3]; 3] = [
    [
        10135552.0 / 24577794.0,
        8788810.0 / 24577794.0,
        4435075.0 / 24577794.0,
    ],
    [
        2613072.0 / 12288897.0,
        8788810.0 / 12288897.0,
        887015.0 / 12288897.0,
    ],
    [
        1425312.0 / 73733382.0,
        8788810.0 / 73733382.0,
        70074185.0 / 73733382.0,
    ],
];

/// Returns the mean FLIP difference over all pixels, 0 (they look the same) to 1.
///
/// Both pictures are linear light of the same size with `width` pixels per row. Colors are clipped
/// to 0 to 1. Returns 0 for pictures without pixels.
pub fn flip(picture: &[[f32; 3]], reference: &[[f32; 3]], width: usize) -> f64 {
    let seen = [picture, reference].map(|pixels| Seen::new(pixels, width));
    let [p, r] = &seen;
    let limit = largest_color_difference();
    let sum: f64 = (0..picture.len())
        .map(|i| {
            let color = redistributed(difference(p.lab[i], r.lab[i]).powf(0.7), limit);
            let off = |a: f64, b: f64| (a - b).abs();
            let feature = off(p.edges[i], r.edges[i]).max(off(p.points[i], r.points[i]));
            color.powf(1.0 - (feature / SQRT_2).sqrt())
        })
        .sum();
    sum / picture.len().max(1) as f64
}

/// A picture as the human eye perceives it.
struct Seen {
    /// CIELAB color of each pixel, blurred by the eye's contrast sensitivity.
    lab: Vec<[f64; 3]>,
    /// Edge strength at each pixel.
    edges: Vec<f64>,
    /// Point strength at each pixel.
    points: Vec<f64>,
}

impl Seen {
    fn new(pixels: &[[f32; 3]], width: usize) -> Self {
        let opponent: Vec<[f64; 3]> = pixels
            .iter()
            .map(|p| opponent(p.map(|v| f64::from(v.clamp(0.0, 1.0)))))
            .collect();
        let channel = |c: usize| -> Vec<f64> { opponent.iter().map(|v| v[c]).collect() };
        let blurred = [
            resolved(&channel(0), width, &[(1.0, 0.0047)]),
            resolved(&channel(1), width, &[(1.0, 0.0053)]),
            resolved(&channel(2), width, &[(34.1, 0.04), (13.5, 0.025)]),
        ];
        let lab = (0..pixels.len()).map(|i| lab([blurred[0][i], blurred[1][i], blurred[2][i]]));
        let gray: Vec<f64> = opponent.iter().map(|v| (v[0] + 16.0) / 116.0).collect();
        let [across, slope, bend] = features();
        let size = |kernel: &Kernel| -> Vec<f64> {
            let x = filtered(&gray, width, kernel, &across);
            let y = filtered(&gray, width, &across, kernel);
            x.iter().zip(y).map(|(x, y)| x.hypot(y)).collect()
        };
        Seen {
            lab: lab.collect(),
            edges: size(&slope),
            points: size(&bend),
        }
    }
}

/// Converts linear light to the opponent color space YCxCz.
fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = of_white(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts linear light to XYZ relative to the white point.
fn of_white(rgb: [f64; 3]) -> [f64; 3] {
    TO_XYZ.map(|row| {
        let dot: f64 = row.iter().zip(rgb).map(|(m, v)| m * v).sum();
        dot / row.iter().sum::<f64>()
    })
}

/// Converts YCxCz to CIELAB with the Hunt effect: chroma fades with darkness. Colors outside the
/// visible gamut are clipped first.
fn lab([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let xyz = [y + cx / 500.0, y, y - cz / 200.0];
    lab_of(to_rgb(xyz).map(|v| v.clamp(0.0, 1.0)))
}

/// Converts linear light to CIELAB with the Hunt effect.
fn lab_of(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = of_white(rgb).map(|v| {
        if v > DELTA.powi(3) {
            v.cbrt()
        } else {
            v / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, 500.0 * (x - y) * hunt, 200.0 * (y - z) * hunt]
}

/// Converts XYZ relative to the white point to linear light, the inverse of [`of_white`].
fn to_rgb(xyz: [f64; 3]) -> [f64; 3] {
    let rows = TO_XYZ.map(|row| glam::DVec3::from(row) / row.iter().sum::<f64>());
    let matrix = glam::DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
    (matrix.inverse() * glam::DVec3::from(xyz)).into()
}

/// Blurs a channel with the eye's contrast sensitivity, a sum of Gaussians a √(π/b) exp(−π² x² /
/// b), with x in degrees.
fn resolved(values: &[f64], width: usize, gaussians: &[(f64, f64)]) -> Vec<f64> {
    // Three standard deviations of the widest Gaussian of any channel.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let mut total = 0.0;
    let mut sum = vec![0.0; values.len()];
    for &(a, b) in gaussians {
        let kernel = kernel(radius, |x| {
            (-(PI * x / PIXELS_PER_DEGREE).powi(2) / b).exp()
        });
        let scale = a * (PI / b).sqrt();
        total += scale * kernel.iter().sum::<f64>().powi(2);
        let part = filtered(values, width, &kernel, &kernel);
        sum.iter_mut()
            .zip(part)
            .for_each(|(sum, v)| *sum += scale * v);
    }
    sum.iter_mut().for_each(|v| *v /= total);
    sum
}

/// Returns a Gaussian and its first and second derivatives. In the derivatives, positive weights
/// sum to 1 and negative weights to −1.
fn features() -> [Kernel; 3] {
    let sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as i32;
    let fall = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
    let balanced = |kernel: Kernel| -> Kernel {
        let of = |sign: f64| kernel.iter().map(|w| (sign * w).max(0.0)).sum::<f64>();
        let (up, down) = (of(1.0), of(-1.0));
        kernel
            .iter()
            .map(|w| w / if *w > 0.0 { up } else { down })
            .collect()
    };
    [
        gaussian(radius, sigma),
        balanced(kernel(radius, |x| -x * fall(x))),
        balanced(kernel(radius, |x| {
            (x * x / (sigma * sigma) - 1.0) * fall(x)
        })),
    ]
}

/// Returns the distance between two colors (HyAB).
fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Returns the largest possible color difference, that of green and blue, to the power of 0.7.
fn largest_color_difference() -> f64 {
    difference(lab_of([0.0, 1.0, 0.0]), lab_of([0.0, 0.0, 1.0])).powf(0.7)
}

/// Maps differences up to 0.4 of the largest to 0 to 0.95, and larger ones to the rest up to 1.
fn redistributed(difference: f64, largest: f64) -> f64 {
    const KNEE: [f64; 2] = [0.4, 0.95];
    let at = difference / largest;
    if at < KNEE[0] {
        at * KNEE[1] / KNEE[0]
    } else {
        KNEE[1] + (at - KNEE[0]) / (1.0 - KNEE[0]) * (1.0 - KNEE[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear(byte: u32) -> f32 {
        let v = f64::from(byte) / 255.0;
        let light = if v <= 0.04045 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        };
        light as f32
    }

    /// Returns a test picture with gradients and edges in all color channels.
    fn picture(seed: u32, width: u32, height: u32) -> Vec<[f32; 3]> {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let edge = if (x / 7 + y / 5 + seed).is_multiple_of(2) {
                    60
                } else {
                    0
                };
                [1, 2, 3].map(|c| linear((x * c * 3 + y * 2 + seed * 40) % 256 * 3 / 4 + edge))
            })
            .collect()
    }

    /// The expected values come from the authors' own code (as in the crate nv-flip 0.1.2). It
    /// works in `f32` and rounds the pixels per degree to 67.
    #[test]
    fn agrees_with_the_authors_own_code() {
        for (a, b, width, height, expected) in [
            (0, 1, 64, 48, 0.6887248),
            (0, 3, 64, 48, 0.9187489),
            (2, 0, 64, 48, 0.8505366),
            (0, 1, 20, 20, 0.5084379),
            (2, 0, 20, 20, 0.6744978),
        ] {
            let [a, b] = [a, b].map(|seed| picture(seed, width, height));
            let flip = flip(&a, &b, width as usize);
            assert!((flip - expected).abs() < 5e-4, "{flip} and {expected}");
        }
        for (a, b, expected) in [
            ([255, 255, 255], [0, 0, 0], 0.9673919),
            ([0, 255, 0], [0, 0, 255], 1.0),
            ([128, 128, 128], [120, 120, 120], 0.1285912),
            ([200, 30, 30], [30, 200, 30], 0.9702024),
        ] {
            let [a, b] = [a, b].map(|color| vec![color.map(linear); 64]);
            let flip = flip(&a, &b, 8);
            assert!((flip - expected).abs() < 1e-4, "{flip} and {expected}");
        }
    }
}
