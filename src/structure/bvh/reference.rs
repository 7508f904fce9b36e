//! References of a node, with their boxes: what binning reads and divides.

use super::builder::{Input, center};
use crate::geometry::{Aabb, Vec3};
use std::cmp::Ordering;

/// An object, or a part of it, with its bounds.
#[derive(Clone, Copy)]
pub struct Reference {
    pub bounds: Aabb,
    pub object: u32,
}

impl Reference {
    /// Returns the references to all objects.
    pub fn to_all(input: &Input<'_>) -> Vec<Reference> {
        let bounds = input.bounds.iter().zip(0..);
        bounds
            .map(|(&bounds, object)| Reference { bounds, object })
            .collect()
    }

    pub fn center(&self) -> Vec3 {
        center(&self.bounds)
    }
}

/// Returns the bounds of references; empty without any.
pub fn bounds_of(list: &[Reference]) -> Aabb {
    let bounds = list.iter().map(|held| &held.bounds);
    bounds.fold(Aabb::EMPTY, |all, bounds| all.union(bounds))
}

/// Returns the bounds of the centers of references; empty without any.
pub fn centers_of(list: &[Reference]) -> Aabb {
    Aabb::around(list.iter().map(Reference::center))
}

/// Reorders references so that the smaller half along the longest axis of their centers comes first, and returns
/// its length. Equal centers are ordered by object, then by place.
pub fn halve(list: &mut [Reference]) -> usize {
    let axis = centers_of(list).longest_axis().index();
    let middle = list.len() / 2;
    let corner = |held: &Reference| held.bounds.lo.to_array();
    list.select_nth_unstable_by(middle, |a, b| {
        let order = a.center()[axis].total_cmp(&b.center()[axis]);
        let order = order.then_with(|| a.object.cmp(&b.object));
        order.then_with(|| {
            let places = corner(a).partial_cmp(&corner(b));
            places.unwrap_or(Ordering::Equal)
        })
    });
    middle
}
