//! Linear bounding volume hierarchies (LBVH): a radix tree over Morton codes.

use super::binary::Binary;
use super::builder::{BvhBuilder, Input};
use super::collapse::collapse;
use super::constants::{BLOCK, COST_TEST, COST_TRAVERSAL, MAX_LEAF, WIDTH};
use super::costs::Costs;
use super::morton;
use crate::progress::Cancelled;
use crate::structure::method::Structure;
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "bvh-lbvh",
    summary: "bounding volume hierarchy, a radix tree over Morton codes (fast to build)",
    about: "Sorts the objects along a Morton curve through the centers of their boxes. A node is divided where \
            the highest bit of the codes changes, which is the middle of a cell of a grid. Objects with equal \
            codes are divided by their position in the order. At the end, subtrees become leaves where that is \
            not more expensive by the surface-area heuristic. D_MAX does not apply.",
    source: "C. Lauterbach et al., Fast BVH construction on GPUs, 2009; T. Karras, Maximizing parallelism in \
             the construction of BVHs, octrees, and k-d trees, 2012",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bvh,
    has_limits: false,
    constants: &[WIDTH, MAX_LEAF, BLOCK, COST_TRAVERSAL, COST_TEST],
    builder: Builder::Boxes(|settings| Box::new(Lbvh::new(settings))),
};

struct Lbvh {
    costs: Costs,
}

impl Lbvh {
    fn new(settings: &BuildSettings) -> Self {
        Lbvh {
            costs: Costs::of(settings),
        }
    }
}

impl BvhBuilder for Lbvh {
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled> {
        collapse(&radix_tree(input)?, self.costs, input.progress)
    }
}

/// Builds the hierarchy with one leaf per object.
///
/// # Errors
/// Cancellation.
pub fn radix_tree(input: &Input<'_>) -> Result<Binary, Cancelled> {
    let codes = morton::in_order(input)?;
    input.progress.set(0.5);
    let mut built = Binary::default();
    subtree(input, &codes, 0, &mut built)?;
    input.progress.set(0.9);
    Ok(built)
}

/// Builds the subtree of some consecutive objects, of which the first is at `position` of all. It is at most as
/// deep as codes and positions have bits.
fn subtree(
    input: &Input<'_>,
    codes: &[(u64, u32)],
    position: usize,
    built: &mut Binary,
) -> Result<u32, Cancelled> {
    /// Nodes with more objects are built in tasks of their own.
    const TASK: usize = 1 << 12;
    if let [(_, object)] = *codes {
        let bounds = input.bounds[object as usize];
        return Ok(built.leaf(bounds, [object], StopReason::FewObjects));
    }
    let first_right = split(codes, position);
    let (left, right) = codes.split_at(first_right);
    let middle = position + first_right;
    let children = if codes.len() > TASK && rayon::current_num_threads() > 1 {
        input.progress.check()?;
        let separately = |codes, position| {
            let mut part = Binary::default();
            subtree(input, codes, position, &mut part).map(|_| part)
        };
        let (left, right) =
            rayon::join(|| separately(left, position), || separately(right, middle));
        [built.append(left?), built.append(right?)]
    } else {
        if codes.len() > TASK {
            input.progress.check()?;
        }
        [
            subtree(input, left, position, built)?,
            subtree(input, right, middle, built)?,
        ]
    };
    Ok(built.inner(children))
}

/// Returns the number of objects, at least 2 of which there are, before the highest bit changes: of the codes,
/// or of the positions if all codes are equal.
fn split(codes: &[(u64, u32)], position: usize) -> usize {
    let (first, last) = (codes[0].0, codes[codes.len() - 1].0);
    if first == last {
        let end = position + codes.len() - 1;
        let highest = (position ^ end).ilog2();
        return (end >> highest << highest) - position;
    }
    let highest = (first ^ last).ilog2();
    let prefix = last >> highest;
    codes.partition_point(|(code, _)| code >> highest < prefix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_are_where_the_highest_bit_changes() {
        let codes = [0, 1, 4, 5, 7].map(|code| (code, 0));
        assert_eq!(split(&codes, 9), 2);
        assert_eq!(split(&codes[2..], 9), 2);
        let equal = [(5, 0); 5];
        assert_eq!(split(&equal, 0), 4);
        assert_eq!(split(&equal, 6), 2);
        assert_eq!(split(&equal[..2], 7), 1);
    }
}
