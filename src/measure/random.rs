//! Random numbers, the same on every machine.

use crate::geometry::Vec3;

/// The generator SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.0;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a number from 0 to 1, less than 1.
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns an integer less than `count`; 0 for a count of 0.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.number() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Returns one of the entries.
    ///
    /// # Panics
    /// If there is none.
    pub fn pick<T: Copy>(&mut self, entries: &[T]) -> T {
        entries[self.below(entries.len())]
    }

    /// Returns a point of the unit cube.
    pub fn point(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    /// Returns a unit vector, uniformly distributed.
    pub fn unit(&mut self) -> Vec3 {
        loop {
            let v = 2.0 * self.point() - 1.0;
            let squared = v.length_squared();
            if squared > 0.01 && squared <= 1.0 {
                return v / squared.sqrt();
            }
        }
    }
}
