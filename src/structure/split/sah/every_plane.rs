//! All planes at which an object begins or ends as candidates, for cells with few objects.
//!
//! The planes are sorted into bins. A bin is searched only if the counts at its limits allow one of
//! its planes to be the cheapest. The result is the same as for trying every plane.

use super::cost::{Areas, Best, Costs, Extent, Plane};
use super::extents::{Along, Scratch};
use super::grid::{BINS, Grid, count_bins};
use crate::geometry::Axis;

/// Average number of objects per bin.
const OBJECTS_PER_BIN: usize = 8;

/// The search along one axis of a cell.
pub(super) struct Search<'a> {
    costs: &'a Costs,
    areas: &'a Areas,
    axis: Axis,
    /// Ends of the cell.
    ends: Extent,
    best: &'a mut Best,
}

/// The object ends in a bin, and the counts before it.
struct Bin<'a> {
    begins: &'a mut [f32],
    ends: &'a mut [f32],
    /// Numbers of objects that begin and end in earlier bins.
    begun: usize,
    ended: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        costs: &'a Costs,
        areas: &'a Areas,
        axis: Axis,
        ends: Extent,
        best: &'a mut Best,
    ) -> Self {
        Search {
            costs,
            areas,
            axis,
            ends,
            best,
        }
    }

    /// Offers every plane that might be the cheapest.
    pub(super) fn run(mut self, extents: Along<'_>, scratch: &mut Scratch) {
        let Along { begins, ends } = extents;
        let objects = begins.len();
        let pairs = || begins.iter().zip(ends);
        scratch.flat.clear();
        // This check is fast, and most cells have no flat objects.
        if pairs().fold(false, |any, (begin, end)| any | (begin == end)) {
            let flat = pairs().filter(|(begin, end)| begin == end);
            scratch.flat.extend(flat.map(|(&begin, _)| begin));
            scratch.flat.sort_unstable_by(f32::total_cmp);
        }
        self.outermost(extents, &scratch.flat);

        let grid = Grid::new(self.ends, (objects / OBJECTS_PER_BIN).clamp(1, BINS));
        let bins = grid.bins();
        if bins == 1 && self.lower_bound(self.ends, 0, 0) > self.best.cost {
            return;
        }
        grid.bins_of(begins, &mut scratch.begin_bins);
        grid.bins_of(ends, &mut scratch.end_bins);
        let (mut begin_of, mut end_of) = ([0; BINS + 1], [0; BINS + 1]);
        find_starts(&scratch.begin_bins, bins, &mut begin_of);
        find_starts(&scratch.end_bins, bins, &mut end_of);
        let mut costs = [f32::INFINITY; BINS];
        for (bin, cost) in costs[..bins].iter_mut().enumerate() {
            if begin_of[bin] < begin_of[bin + 1] || end_of[bin] < end_of[bin + 1] {
                let [lo, hi] = self.ends;
                let limits = [
                    if bin == 0 { lo } else { grid.limit(bin) },
                    if bin + 1 == bins {
                        hi
                    } else {
                        grid.limit(bin + 1)
                    },
                ];
                let ended = end_of[bin + 1] as usize;
                *cost = self.lower_bound(limits, begin_of[bin] as usize, objects - ended);
            }
        }
        // The most promising bin comes first, because its result rules out most of the others.
        let by_cost = |a: &usize, b: &usize| costs[*a].total_cmp(&costs[*b]);
        let first = (0..bins).min_by(by_cost);
        if first.is_none_or(|first| costs[first] > self.best.cost) {
            return;
        }
        distribute(begins, &scratch.begin_bins, &begin_of, &mut scratch.begins);
        distribute(ends, &scratch.end_bins, &end_of, &mut scratch.ends);
        let within = |starts: &Starts, bin| starts[bin] as usize..starts[bin + 1] as usize;
        let others = (0..bins).filter(|&bin| Some(bin) != first);
        for bin in first.into_iter().chain(others) {
            if costs[bin] <= self.best.cost {
                let held = Bin {
                    begins: &mut scratch.begins[within(&begin_of, bin)],
                    ends: &mut scratch.ends[within(&end_of, bin)],
                    begun: begin_of[bin] as usize,
                    ended: end_of[bin] as usize,
                };
                self.search_bin(held, &scratch.flat, objects);
            }
        }
    }

    fn offer(&mut self, plane: Plane) {
        let [lo, hi] = self.ends;
        if lo < plane.at && plane.at < hi {
            let cost = self.costs.cost(&plane, self.areas);
            self.best.offer(self.axis, plane.at, cost);
        }
    }

    /// Offers the planes at the first start and the last end of an object: the only ones that can
    /// have an empty side.
    fn outermost(&mut self, extents: Along<'_>, flat: &[f32]) {
        let objects = extents.begins.len();
        let [first, last] = extents.hull();
        self.offer(Plane {
            at: first,
            below: count(flat, first),
            above: objects,
        });
        self.offer(Plane {
            at: last,
            below: objects,
            above: count(flat, last),
        });
    }

    /// Returns a lower bound for the cost of all planes between two limits, except the outermost
    /// ones, given the minimum number of objects on each side. The cost with fixed counts is linear
    /// in between.
    fn lower_bound(&self, limits: Extent, below: usize, above: usize) -> f32 {
        /// An upper bound for the relative rounding error of a cost.
        const ROUNDING: f32 = 32.0 * f32::EPSILON;
        let [a, b] = limits.map(|at| {
            let plane = Plane {
                at,
                below: below.max(1),
                above: above.max(1),
            };
            self.costs.cost_of_parts(&plane, self.areas)
        });
        a.min(b) * (1.0 - ROUNDING)
    }

    fn search_bin(&mut self, bin: Bin<'_>, flat: &[f32], objects: usize) {
        let Bin {
            begins,
            ends,
            begun,
            ended,
        } = bin;
        begins.sort_unstable_by(f32::total_cmp);
        ends.sort_unstable_by(f32::total_cmp);
        // The numbers of starts and ends before the plane.
        let (mut i, mut k) = (0, 0);
        loop {
            let at = match (begins.get(i), ends.get(k)) {
                (Some(&begin), Some(&end)) => begin.min(end),
                (Some(&at), None) | (None, Some(&at)) => at,
                (None, None) => return,
            };
            let before = begun + i;
            let equal = |list: &[f32]| list.iter().take_while(|&&other| other == at).count();
            i += equal(&begins[i..]);
            k += equal(&ends[k..]);
            let in_plane = count(flat, at);
            self.offer(Plane {
                at,
                below: before + in_plane,
                above: objects - ended - k + in_plane,
            });
        }
    }
}

/// Returns how many elements of a sorted list are equal to `at`.
fn count(sorted: &[f32], at: f32) -> usize {
    let from = sorted.partition_point(|&other| other < at);
    sorted[from..].partition_point(|&other| other == at)
}

/// The start of each bin in a list that is ordered by bins, and the end of the list.
type Starts = [u32; BINS + 1];

#[inline]
fn find_starts(planes: &[u8], bins: usize, starts: &mut Starts) {
    let mut counts = [0; BINS];
    count_bins(planes, &mut counts);
    for bin in 0..bins {
        starts[bin + 1] = starts[bin] + counts[bin];
    }
}

/// Orders planes by their bins (counting sort).
fn distribute(planes: &[f32], bins: &[u8], starts: &Starts, sorted: &mut Vec<f32>) {
    let mut next = *starts;
    sorted.resize(planes.len(), 0.0);
    let sorted = &mut sorted[..];
    for (&at, &bin) in planes.iter().zip(bins) {
        let place = &mut next[usize::from(bin) % BINS];
        sorted[*place as usize] = at;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::super::METHOD;
    use super::*;
    use crate::structure::{BuildSettings, Method};

    /// Counts the objects on both sides of a plane, by definition.
    fn counted(extents: &[Extent], at: f32) -> Plane {
        let in_plane = extents.iter().filter(|e| **e == [at, at]).count();
        Plane {
            at,
            below: extents.iter().filter(|e| e[0] < at).count() + in_plane,
            above: extents.iter().filter(|e| e[1] > at).count() + in_plane,
        }
    }

    #[test]
    fn searching_few_bins_finds_what_trying_every_plane_finds() {
        let settings = BuildSettings::for_method(Method::named(METHOD.name).unwrap());
        let costs = Costs::new(&settings);
        let ends = [-0.75, 0.5];
        let (mut found, mut random) = (0, 1_u32);
        let mut next = |most: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) % most
        };
        for case in 0..2000 {
            let objects = 1 + next(if case % 10 == 0 { 700 } else { 90 });
            // Few positions make many ends equal; width 0 makes an object flat.
            let (places, widest) = (4 + next(400), 1 + next(40));
            let place = |i: u32| (ends[0] + 1.25 * i as f32 / places as f32).min(ends[1]);
            let extents: Vec<Extent> = (0..objects)
                .map(|_| {
                    let (begin, width) = (next(places + 1), next(widest));
                    [place(begin), place(begin + width)]
                })
                .collect();
            let areas = Areas {
                ends,
                faces: next(1000) as f32 / 1000.0,
                rim: 1.0 / 1.25,
            };
            let leaf = || Best {
                cost: costs.blocks(objects as usize),
                plane: None,
            };
            let mut expected = leaf();
            for at in extents.as_flattened() {
                if ends[0] < *at && *at < ends[1] {
                    let plane = counted(&extents, *at);
                    expected.offer(Axis::Y, *at, costs.cost(&plane, &areas));
                }
            }
            let [begins, closes] = [0, 1].map(|i| extents.iter().map(|e| e[i]).collect::<Vec<_>>());
            let along = Along {
                begins: &begins,
                ends: &closes,
            };
            let mut best = leaf();
            Search::new(&costs, &areas, Axis::Y, ends, &mut best)
                .run(along, &mut Scratch::default());
            assert_eq!((best.cost, best.plane), (expected.cost, expected.plane));
            found += usize::from(best.plane.is_some());
        }
        assert!(found > 100, "{found}");
    }
}
