//! The three coordinate axes, in the cyclic order in which the paper's method 1 splits.

use serde::{Deserialize, Serialize};

/// A coordinate axis, or the orientation of a split plane perpendicular to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    #[default]
    X = 0,
    Y = 1,
    Z = 2,
}

impl Axis {
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    /// Returns the index of the coordinate, 0 to 2.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns the axis with this index modulo 3.
    pub const fn from_index(index: usize) -> Axis {
        Self::ALL[index % 3]
    }

    /// Returns the axis of the largest of three sizes; of equal ones the last.
    #[inline(always)]
    pub fn of_largest<T: PartialOrd>([x, y, z]: [T; 3]) -> Axis {
        if x > y && x > z {
            Axis::X
        } else if y > z {
            Axis::Y
        } else {
            Axis::Z
        }
    }

    /// Returns the next axis in the order x → y → z → x.
    pub const fn next(self) -> Axis {
        Self::from_index(self as usize + 1)
    }

    /// Returns `x`, `y` or `z`.
    pub const fn name(self) -> &'static str {
        ["x", "y", "z"][self as usize]
    }
}

impl std::fmt::Display for Axis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Axis::ALL
            .into_iter()
            .find(|axis| axis.name() == text)
            .ok_or_else(|| format!("expected an axis x, y or z, found '{text}'"))
    }
}
