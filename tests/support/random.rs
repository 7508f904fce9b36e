//! Random numbers that are the same in every run.

use bspscope::geometry::{Aabb, Vec3};

/// SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, 2014), by its seed.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a whole number less than `n`, or 0 where `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// Returns a number from `lo` up to but not including `hi`.
    pub fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number between −1 and 1.
    pub fn signed(&mut self) -> f64 {
        self.within(-1.0, 1.0)
    }

    pub fn point(&mut self, b: &Aabb) -> Vec3 {
        Vec3::new(
            self.within(b.lo.x, b.hi.x),
            self.within(b.lo.y, b.hi.y),
            self.within(b.lo.z, b.hi.z),
        )
    }

    /// Returns a vector whose components lie between −1 and 1.
    pub fn vector(&mut self) -> Vec3 {
        self.point(&Aabb::new(Vec3::NEG_ONE, Vec3::ONE))
    }

    /// Returns a vector of unit length; all directions are equally likely.
    pub fn unit(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if (1e-3..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}
