//! Rays as lanes walk and test them: in `f32`, with bounds on what that rounds.

use super::three;
use crate::geometry::Ray;
use crate::primitive::{FramedRay, UnitFrame};

/// Rays that are made ready at once: what is known of them stays in the cache.
pub(super) const CHUNK: usize = 1024;

/// What tests want of a ray, in one line of the cache; in the coordinates of the unit frame.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct LaneRay {
    pub(super) origin: [f32; 3],
    /// Its largest component is from ½ to 2.
    pub(super) direction: [f32; 3],
    /// 1 over the direction, finite.
    pub(super) inverse: [f32; 3],
    pub(super) t_min: f32,
    pub(super) t_max: f32,
    /// Bound on how far any coordinate of the scene is from that of the origin.
    pub(super) reach: f32,
    /// The axis of the direction's largest component.
    pub(super) axis: u32,
}

impl LaneRay {
    const NONE: LaneRay = LaneRay {
        origin: [0.0; 3],
        direction: [1.0; 3],
        inverse: [1.0; 3],
        t_min: 0.0,
        t_max: -1.0,
        reach: 0.0,
        axis: 0,
    };

    /// The axes in cyclic order, that of the largest component last.
    #[inline(always)]
    pub(super) fn turned_axes(&self) -> [usize; 3] {
        let last = self.axis as usize;
        let next = |k| if k == 2 { 0 } else { k + 1 };
        [next(last), next(next(last)), last]
    }

    /// The origin, moved by half the thickness of planes along each axis the way the ray goes: planes
    /// are met where they begin.
    #[inline(always)]
    pub(super) fn shifted(&self, thick: f32) -> [f32; 3] {
        three(|k| self.origin[k] + thick.copysign(self.direction[k]))
    }
}

/// A ray that meets the scene, and where it is within.
#[derive(Clone, Copy)]
pub(super) struct Start {
    pub(super) ray: u32,
    pub(super) t_enter: f32,
    pub(super) t_exit: f32,
}

/// Rays made ready, up to [`CHUNK`].
pub(super) struct LaneRays {
    /// Half the thickness of planes.
    pub(super) thick: f32,
    pub(super) rays: [LaneRay; CHUNK],
    /// Where on the ray in the world this one's origin lies, and distances here per distance there.
    start: [f64; CHUNK],
    scale: [f64; CHUNK],
    /// Those that the unit frame cannot hold.
    pub(super) others: Vec<u32>,
    /// Those that meet the scene come first, and then one place to write to.
    starts: [Start; CHUNK + 1],
    meeting: usize,
}

/// What all rays through a tree have in common.
#[derive(Clone, Copy)]
pub(super) struct Root<'a> {
    pub(super) frame: &'a UnitFrame,
    /// Half the thickness of planes.
    pub(super) thick: f32,
    /// The corners of the scene.
    pub(super) corners: &'a [[f32; 3]; 2],
    /// Whether rays that begin before their origin are beyond lanes.
    pub(super) forward_only: bool,
}

/// Rays whose numbers are computed at once.
const BATCH: usize = 16;

type Numbers = [f32; BATCH];

/// Rays number by number.
struct Columns {
    origin: [Numbers; 3],
    direction: [Numbers; 3],
    inverse: [Numbers; 3],
    t_min: Numbers,
    t_max: Numbers,
    t_enter: Numbers,
    t_exit: Numbers,
    reach: Numbers,
    axis: [u32; BATCH],
}

impl LaneRays {
    pub(super) fn new() -> Box<LaneRays> {
        let none = Start {
            ray: 0,
            t_enter: 0.0,
            t_exit: 0.0,
        };
        Box::new(LaneRays {
            thick: 0.0,
            rays: [LaneRay::NONE; CHUNK],
            start: [0.0; CHUNK],
            scale: [1.0; CHUNK],
            others: Vec::new(),
            starts: [none; CHUNK + 1],
            meeting: 0,
        })
    }

    /// The rays that meet the scene.
    pub(super) fn starts(&self) -> &[Start] {
        &self.starts[..self.meeting]
    }

    /// Makes rays ready, at most [`CHUNK`].
    #[inline(always)]
    pub(super) fn fill(&mut self, root: Root<'_>, rays: &[Ray]) {
        assert!(rays.len() <= CHUNK);
        self.thick = root.thick;
        self.others.clear();
        self.meeting = 0;
        for (number, rays) in rays.chunks(BATCH).enumerate() {
            self.fill_batch(root, number * BATCH, rays);
        }
    }

    #[inline(always)]
    fn fill_batch(&mut self, root: Root<'_>, first: usize, rays: &[Ray]) {
        let mut columns = Columns::new();
        for (lane, ray) in rays.iter().enumerate() {
            let i = first + lane;
            match FramedRay::new(root.frame, ray) {
                Some(framed) if !(root.forward_only && ray.t_min < 0.0) => {
                    columns.set(lane, &framed);
                    self.start[i] = framed.start;
                    self.scale[i] = framed.scale;
                }
                _ => self.others.push(i as u32),
            }
        }
        for lane in 0..BATCH {
            columns.derive(&root, lane);
        }
        for lane in 0..rays.len() {
            let i = first + lane;
            self.rays[i] = columns.ray(lane);
            let (t_enter, t_exit) = (columns.t_enter[lane], columns.t_exit[lane]);
            // Written over by the next if it does not count.
            self.starts[self.meeting] = Start {
                ray: i as u32,
                t_enter,
                t_exit,
            };
            self.meeting += usize::from(t_enter <= t_exit);
        }
    }

    /// A distance on a ray as one on the ray in the world.
    #[inline(always)]
    pub(super) fn to_world(&self, ray: usize, t: f64) -> f64 {
        self.start[ray] + t / self.scale[ray]
    }

    /// A distance on the ray in the world as one on this ray.
    #[inline(always)]
    pub(super) fn in_frame(&self, ray: usize, t: f64) -> f64 {
        (t - self.start[ray]) * self.scale[ray]
    }
}

impl Columns {
    /// Rays that end before they begin.
    #[inline(always)]
    fn new() -> Columns {
        const ZERO: Numbers = [0.0; BATCH];
        const ONE: Numbers = [1.0; BATCH];
        Columns {
            origin: [ZERO; 3],
            direction: [ONE; 3],
            inverse: [ONE; 3],
            t_min: ZERO,
            t_max: [-1.0; BATCH],
            t_enter: ZERO,
            t_exit: ZERO,
            reach: ZERO,
            axis: [0; BATCH],
        }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, ray: &FramedRay) {
        for k in 0..3 {
            self.origin[k][lane] = ray.origin[k];
            self.direction[k][lane] = ray.direction[k];
        }
        self.t_min[lane] = ray.t_min;
        self.t_max[lane] = ray.t_max;
    }

    /// What follows from that, without a branch, so that it is done for many lanes at once.
    #[inline(always)]
    fn derive(&mut self, root: &Root<'_>, lane: usize) {
        const LEAST: f32 = 1e-20;
        const EPSILON: f32 = f32::EPSILON;
        let least = |a: f32, b: f32| if a < b { a } else { b };
        let most = |a: f32, b: f32| if a > b { a } else { b };
        let mut t_enter = self.t_min[lane] * (1.0 - 2.0 * EPSILON);
        let mut t_exit = self.t_max[lane] * (1.0 + 2.0 * EPSILON);
        for k in 0..3 {
            let (origin, direction) = (self.origin[k][lane], self.direction[k][lane]);
            let inverse = 1.0 / most(direction.abs(), LEAST).copysign(direction);
            let a = (root.corners[0][k] - origin) * inverse;
            let b = (root.corners[1][k] - origin) * inverse;
            t_enter = most(least(a, b), t_enter);
            t_exit = least(most(a, b), t_exit);
            self.inverse[k][lane] = inverse;
        }
        self.t_enter[lane] = t_enter;
        self.t_exit[lane] = t_exit;
        let [x, y, z] = three(|k| self.direction[k][lane].abs());
        let y_or_z = if y > z { 1 } else { 2 };
        self.axis[lane] = if (x > y) & (x > z) { 0 } else { y_or_z };
        let [x, y, z] = three(|k| self.origin[k][lane].abs());
        self.reach[lane] = 0.5 + most(x, most(y, z));
    }

    #[inline(always)]
    fn ray(&self, lane: usize) -> LaneRay {
        LaneRay {
            origin: three(|k| self.origin[k][lane]),
            direction: three(|k| self.direction[k][lane]),
            inverse: three(|k| self.inverse[k][lane]),
            t_min: self.t_min[lane],
            t_max: self.t_max[lane],
            reach: self.reach[lane],
            axis: self.axis[lane],
        }
    }
}
