//! A pixel whose rays are worth following, for those who have not picked one yet.

use super::{Current, Document};
use crate::measure::heat::PixelCounts;
use crate::trace::RayKind;
use std::cmp::Reverse;

/// As many leaves make a walk interesting; more make it long.
const LEAVES: u32 = 8;

impl Document {
    /// Picks such a pixel as soon as the rays of the picture are counted; once a frame.
    pub fn pick_interesting(&mut self) {
        let is_previous = self.is_previous();
        let Some(current) = self
            .current
            .as_mut()
            .filter(|_| self.wants_ray && !is_previous)
        else {
            return;
        };
        let pixel = match &current.pixel_counts {
            Some(counts) => interesting(counts),
            // A picture this large is not counted pixel by pixel.
            None if current.done => middle(current),
            None => return,
        };
        current.pick(pixel);
        self.wants_ray = false;
    }
}

fn middle(current: &Current) -> [u32; 2] {
    let picture = &current.shown.picture;
    [picture.width / 2, picture.height / 2]
}

/// The pixel whose primary ray hits something, visits some leaves on its way, and has rays that start at
/// the hit; of equal ones the nearest to the middle.
fn interesting(counts: &PixelCounts) -> [u32; 2] {
    let at = |i: usize| [i as u32 % counts.width, i as u32 / counts.width];
    let off = |i: usize| {
        let [x, y] = at(i);
        x.abs_diff(counts.width / 2).pow(2) + y.abs_diff(counts.height / 2).pow(2)
    };
    let best = (0..counts.tallies.len()).max_by_key(|&i| {
        let tallies = &counts.tallies[i];
        let primary = &tallies[RayKind::Primary as usize];
        let secondary = [RayKind::Reflected, RayKind::Refracted]
            .iter()
            .any(|&kind| tallies[kind as usize].rays > 0);
        (
            primary.hits > 0,
            secondary,
            primary.leaves.min(LEAVES),
            Reverse(off(i)),
        )
    });
    best.map_or([0, 0], at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_with_company_that_hits_after_some_leaves_is_interesting() {
        let mut counts = PixelCounts::new(5, 5);
        // Of equal pixels, the one in the middle.
        assert_eq!(interesting(&counts), [2, 2]);
        let primary = |counts: &mut PixelCounts, i: usize, leaves, hits| {
            let tally = &mut counts.tallies[i][RayKind::Primary as usize];
            (tally.leaves, tally.hits) = (leaves, hits);
        };
        primary(&mut counts, 3, 40, 0);
        primary(&mut counts, 7, 5, 1);
        assert_eq!(interesting(&counts), [2, 1]);
        primary(&mut counts, 9, 7, 1);
        assert_eq!(interesting(&counts), [4, 1]);
        primary(&mut counts, 20, 2, 1);
        counts.tallies[20][RayKind::Reflected as usize].rays = 1;
        assert_eq!(interesting(&counts), [0, 4]);
    }
}
