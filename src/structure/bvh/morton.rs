//! Objects in Morton order: along a curve that fills the scene and keeps most neighbors near each other.

use super::builder::Input;
use crate::geometry::{Aabb, Vec3};
use crate::progress::Cancelled;
use rayon::prelude::*;

/// Bits per axis.
const BITS: u32 = 21;

/// Returns the objects in the order of the Morton codes of the centers of their boxes, with the codes: the bits
/// of the three coordinates in turn, those of x first. Equal codes are ordered by object number.
///
/// Coordinates are relative to a cube, so the curve advances by the same lengths along all axes.
pub fn in_order(input: &Input<'_>) -> Result<Vec<(u64, u32)>, Cancelled> {
    // Half of everything, so that no difference overflows.
    let half = |object: u32| input.center(object) * 0.5;
    let point = |at: Vec3| Aabb::new(at, at);
    let all = (0..input.count()).into_par_iter().map(|o| point(half(o)));
    let all = all.reduce(|| Aabb::EMPTY, |a, b| a.union(&b));
    input.progress.check()?;
    let size = all.size().max_element();
    let code = |object: u32| {
        let at = (half(object) - all.lo) / size * f64::from(1 << BITS);
        // Regular scenes have many centers between two cells. They belong to the upper one, whatever rounding does.
        let at = at + 1.0 / 1024.0;
        // Where there is no size, NaN becomes 0.
        let coordinates = at.to_array().into_iter();
        coordinates.fold(0, |code, at| code << 1 | spread(at as u64))
    };
    let mut codes: Vec<(u64, u32)> = (0..input.count())
        .into_par_iter()
        .map(|object| (code(object), object))
        .collect();
    input.progress.check()?;
    codes.par_sort_unstable();
    input.progress.check()?;
    Ok(codes)
}

/// Puts two zeros between the bits of a coordinate; one that is too large is the largest.
fn spread(coordinate: u64) -> u64 {
    let mut bits = coordinate.min((1 << BITS) - 1);
    bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread_to_every_third_place() {
        for k in 0..BITS {
            assert_eq!(spread(1 << k), 1 << (3 * k));
        }
        assert_eq!(spread(u64::MAX), spread((1 << BITS) - 1));
        assert_eq!(spread(0b101), 0b100_0001);
    }
}
