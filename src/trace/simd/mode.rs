//! The two ways in which SIMD kernels traverse a tree, and the choice between them.

use crate::structure::split::Structure;

/// How the rays of a call traverse the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdMode {
    /// Every ray traverses the tree on its own, in a lane that takes the next ray when it is done.
    Stream,
    /// Neighboring rays, one per lane, traverse the tree together.
    Packets,
    /// Packets as long as the rays of a call are coherent, then a stream.
    Auto,
}

impl SimdMode {
    pub const ALL: [SimdMode; 3] = [SimdMode::Stream, SimdMode::Packets, SimdMode::Auto];

    /// Returns the name in reports.
    pub const fn name(self) -> &'static str {
        ["stream", "packets", "stream and packets"][self as usize]
    }

    /// Returns how rays traverse a structure where this is chosen: packets need planes.
    pub(in crate::trace) fn of(self, structure: Structure) -> SimdMode {
        match structure {
            Structure::Bvh => SimdMode::Stream,
            _ => self,
        }
    }

    /// Returns whether rays are traced in packets; `None` where the coherence of the rays decides.
    pub(super) fn uses_packets(self) -> Option<bool> {
        match self {
            SimdMode::Stream => Some(false),
            SimdMode::Packets => Some(true),
            SimdMode::Auto => None,
        }
    }
}
