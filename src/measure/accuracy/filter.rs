//! Separable image filters: one kernel along rows, one along columns.

/// Weights of the offsets from −radius to radius.
pub type Kernel = Vec<f64>;

/// Returns the values of `weight` at the offsets from −`radius` to `radius` pixels.
pub fn kernel(radius: i32, weight: impl Fn(f64) -> f64) -> Kernel {
    (-radius..=radius).map(|x| weight(f64::from(x))).collect()
}

/// Returns the Gaussian exp(−x² / (2 σ²)), normalized to sum 1.
pub fn gaussian(radius: i32, sigma: f64) -> Kernel {
    let mut kernel = kernel(radius, |x| (-x * x / (2.0 * sigma * sigma)).exp());
    let sum: f64 = kernel.iter().sum();
    kernel.iter_mut().for_each(|weight| *weight /= sum);
    kernel
}

/// Convolves an image of `width` pixels per row with `rows` along its rows, then with `columns`
/// along its columns. Beyond the border, the outermost pixels repeat.
pub fn filtered(values: &[f64], width: usize, rows: &[f64], columns: &[f64]) -> Vec<f64> {
    let height = values.len() / width;
    let across = along(values, rows, [width, 1], [height, width]);
    along(&across, columns, [height, width], [width, 1])
}

/// Filters every line of `count` values. Values of a line are `step` apart in memory; lines start
/// `stride` apart.
fn along(
    values: &[f64],
    kernel: &[f64],
    [count, step]: [usize; 2],
    [lines, stride]: [usize; 2],
) -> Vec<f64> {
    let radius = (kernel.len() / 2) as i64;
    let mut out = vec![0.0; values.len()];
    for line in 0..lines {
        for i in 0..count {
            let sum = kernel.iter().zip(-radius..).map(|(weight, offset)| {
                let at = (i as i64 + offset).clamp(0, count as i64 - 1) as usize;
                weight * values[line * stride + at * step]
            });
            out[line * stride + i * step] = sum.sum();
        }
    }
    out
}
