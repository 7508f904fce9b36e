//! Which axis is split by methods that do not compare axes.

use super::{Cell, Constant};
use crate::geometry::Axis;
use crate::tree::BuildSettings;

/// The constant of methods that split along an [`AxisOrder`].
pub(super) const LONGEST_AXIS: Constant = Constant {
    name: "longest-axis",
    default: 0.0,
    lowest: 0.0,
    highest: 1.0,
    step: 1.0,
    unit: "",
    about: "1 splits the cell's longest axis, 0 takes the axes in cyclic order as method 1.",
    source: "ours: 0 leaves the plane as the only difference between methods",
};

/// The cell's longest axis, or the axes in cyclic order, a level each.
pub(super) struct AxisOrder {
    first: Axis,
    longest: bool,
}

impl AxisOrder {
    pub(super) fn new(settings: &BuildSettings) -> Self {
        AxisOrder {
            first: settings.first_axis,
            longest: settings.constant(LONGEST_AXIS.name) > 0.5,
        }
    }

    /// Of equally long axes the first.
    pub(super) fn axis(&self, cell: &Cell<'_>) -> Axis {
        if self.longest {
            cell.bounds.longest_axis()
        } else {
            Axis::from_index(self.first.index() + cell.depth as usize)
        }
    }
}
