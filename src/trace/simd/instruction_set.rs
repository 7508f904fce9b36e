//! The instruction sets that SIMD kernels are compiled for.

/// An instruction set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// Sixteen lanes.
    Avx512,
    /// Eight lanes.
    Avx2,
    /// Eight lanes in portable Rust.
    Portable,
}

impl InstructionSet {
    pub const ALL: [InstructionSet; 3] = [
        InstructionSet::Avx512,
        InstructionSet::Avx2,
        InstructionSet::Portable,
    ];

    /// Returns the name in reports.
    pub const fn name(self) -> &'static str {
        ["AVX-512", "AVX2", "portable"][self as usize]
    }

    /// Returns the number of rays per vector.
    pub(super) fn lanes(self) -> usize {
        [16, 8, 8][self as usize]
    }

    /// Returns whether this processor has it.
    pub fn is_available(self) -> bool {
        match self {
            InstructionSet::Portable => true,
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("bmi1")
                    && is_x86_feature_detected!("popcnt")
                    && is_x86_feature_detected!("fma")
            }
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => {
                is_x86_feature_detected!("avx2")
                    && is_x86_feature_detected!("bmi1")
                    && is_x86_feature_detected!("popcnt")
                    && is_x86_feature_detected!("fma")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// Returns the widest that this processor has.
    pub fn best() -> InstructionSet {
        let available = InstructionSet::ALL
            .into_iter()
            .find(|set| set.is_available());
        available.unwrap_or(InstructionSet::Portable)
    }
}
