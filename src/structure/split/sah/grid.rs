//! Equally wide bins along an axis.

use super::cost::Extent;

/// Maximum number of bins.
pub(super) const BINS: usize = 64;

/// Bins from one end of a cell to the other.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    lo: f32,
    /// Width of a bin in local coordinates, and its reciprocal.
    width: f32,
    scale: f32,
    last: f32,
}

impl Grid {
    /// Creates `bins` bins, from 1 to [`BINS`]; only one if the cell is so thin that the limits of
    /// several might coincide.
    pub(super) fn new([lo, hi]: Extent, bins: usize) -> Self {
        let width = (hi - lo) / bins as f32;
        let thick = width > 16.0 * f32::EPSILON * lo.abs().max(hi.abs());
        let (width, bins) = if thick { (width, bins) } else { (hi - lo, 1) };
        Grid {
            lo,
            width,
            scale: 1.0 / width,
            last: (bins - 1) as f32,
        }
    }

    /// Returns the lower limit of a bin.
    #[inline]
    pub(super) fn limit(&self, bin: usize) -> f32 {
        self.lo + self.width * bin as f32
    }

    pub(super) fn bins(&self) -> usize {
        self.last as usize + 1
    }

    /// Computes the bin of each plane. A plane is at or above the rounded lower limit of its bin
    /// and below the upper one, except at the ends of the cell.
    pub(super) fn bins_of(&self, planes: &[f32], bins: &mut Vec<u8>) {
        bins.resize(planes.len(), 0);
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: AVX2 is available, as checked above.
            return unsafe { self.bins_of_avx2(planes, bins) };
        }
        self.bins_of_here(planes, bins);
    }

    /// # Safety
    /// AVX2 must be available.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn bins_of_avx2(&self, planes: &[f32], bins: &mut [u8]) {
        self.bins_of_here(planes, bins);
    }

    /// Contains no branches and no conversions, so that it compiles to SIMD instructions. The
    /// result is the same on every instruction set, because each operation is rounded separately.
    #[inline(always)]
    fn bins_of_here(&self, planes: &[f32], bins: &mut [u8]) {
        /// From here on an `f32` has no fraction: adding it rounds and leaves the integer in the
        /// low bits.
        const INTEGERS: f32 = (1 << 23) as f32;
        for (bin, &at) in bins.iter_mut().zip(planes) {
            let guess = (at - self.lo) * self.scale - 0.5;
            let guess = if guess > 0.0 { guess } else { 0.0 };
            let guess = if guess < self.last { guess } else { self.last };
            let bits = guess + INTEGERS;
            let guess = bits - INTEGERS;
            let too_high = (at < self.lo + self.width * guess) & (guess > 0.0);
            let too_low = (at >= self.lo + self.width * (guess + 1.0)) & (guess < self.last);
            let guessed = (bits.to_bits() & (BINS as u32 - 1)) as i32;
            *bin = (guessed + i32::from(too_low) - i32::from(too_high)) as u8;
        }
    }
}

/// Counts the elements of each bin.
#[inline]
pub(super) fn count_bins(bins: &[u8], counts: &mut [u32; BINS]) {
    // Two tables, because neighbors are often equal and increments of one counter depend on each
    // other.
    let mut others = [0; BINS];
    let (pairs, rest) = bins.as_chunks::<2>();
    for &[one, other] in pairs {
        counts[usize::from(one) % BINS] += 1;
        others[usize::from(other) % BINS] += 1;
    }
    for &bin in rest {
        counts[usize::from(bin) % BINS] += 1;
    }
    for (count, other) in counts.iter_mut().zip(others) {
        *count += other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_hold_planes_between_them_however_thin_the_cell() {
        let thin = [0.5_f32, 0.5_f32.next_up().next_up()];
        for ends in [[-1.0, 1.0], [0.1, 0.30001], thin] {
            for bins in [1, 7, BINS] {
                let grid = Grid::new(ends, bins);
                let planes: Vec<f32> = (0..=1000)
                    .map(|step| ends[0] + (ends[1] - ends[0]) * (step as f32 / 1000.0))
                    .chain((1..bins).map(|bin| grid.limit(bin).min(ends[1])))
                    .collect();
                let mut found = Vec::new();
                grid.bins_of(&planes, &mut found);
                for (&at, &bin) in planes.iter().zip(&found) {
                    let bin = usize::from(bin);
                    let last = bin + 1 == grid.bins();
                    assert!(bin < grid.bins());
                    assert!(bin == 0 || grid.limit(bin) <= at);
                    assert!(last || at < grid.limit(bin + 1));
                }
            }
        }
    }
}
