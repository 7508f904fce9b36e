//! Rays as lanes walk and test them: in `f32`, number by number, with bounds on what that rounds.

use crate::geometry::Ray;
use crate::primitive::{FramedRay, UnitFrame};

/// Rays that are made ready at once: what is known of them stays in the cache.
pub(super) const CHUNK: usize = 1024;

type Numbers = [f32; CHUNK];

/// Rays in the coordinates of the unit frame, up to [`CHUNK`].
pub(super) struct LaneRays {
    /// Those that meet the scene.
    pub(super) order: Vec<u32>,
    /// Those that the unit frame cannot hold.
    pub(super) others: Vec<u32>,

    /// Half the thickness of planes.
    pub(super) thick: f32,
    pub(super) origin: [Numbers; 3],
    /// Its largest component is from ½ to 2.
    pub(super) direction: [Numbers; 3],
    pub(super) t_min: Numbers,
    pub(super) t_max: Numbers,
    /// Where on the ray in the world this one's origin lies, and distances here per distance there.
    pub(super) start: [f64; CHUNK],
    pub(super) scale: [f64; CHUNK],

    /// The origin, moved by half the thickness of planes along each axis the way the ray goes: planes
    /// are met where they begin.
    pub(super) shifted: [Numbers; 3],
    /// 1 over the direction, finite.
    pub(super) inverse: [Numbers; 3],
    /// Where the ray is within the scene.
    pub(super) t_enter: Numbers,
    pub(super) t_exit: Numbers,
    /// The axis of the direction's largest component.
    pub(super) axis: [u32; CHUNK],
    /// Bound on how far any coordinate of the scene is from that of the origin.
    pub(super) reach: Numbers,
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

impl LaneRays {
    pub(super) fn new() -> Box<LaneRays> {
        const NONE: Numbers = [0.0; CHUNK];
        Box::new(LaneRays {
            order: Vec::with_capacity(CHUNK),
            others: Vec::new(),
            thick: 0.0,
            origin: [NONE; 3],
            direction: [NONE; 3],
            t_min: NONE,
            t_max: NONE,
            start: [0.0; CHUNK],
            scale: [1.0; CHUNK],
            shifted: [NONE; 3],
            inverse: [NONE; 3],
            t_enter: NONE,
            t_exit: NONE,
            axis: [0; CHUNK],
            reach: NONE,
        })
    }

    /// Makes rays ready, at most [`CHUNK`].
    #[inline(always)]
    pub(super) fn fill(&mut self, root: Root<'_>, rays: &[Ray]) {
        self.order.clear();
        self.others.clear();
        self.thick = root.thick;
        self.frame(root, rays);
        for i in 0..rays.len() {
            self.derive(root, i);
        }
        let mut others = self.others.iter().peekable();
        for i in 0..rays.len() as u32 {
            if others.next_if(|&&other| other == i).is_some() {
                continue;
            }
            if self.t_enter[i as usize] <= self.t_exit[i as usize] {
                self.order.push(i);
            }
        }
    }

    /// The numbers of [`FramedRay`].
    #[inline(always)]
    fn frame(&mut self, root: Root<'_>, rays: &[Ray]) {
        for (i, ray) in rays.iter().enumerate() {
            match FramedRay::new(root.frame, ray) {
                Some(framed) if !(root.forward_only && ray.t_min < 0.0) => {
                    for k in 0..3 {
                        self.origin[k][i] = framed.origin[k];
                        self.direction[k][i] = framed.direction[k];
                    }
                    self.t_min[i] = framed.t_min;
                    self.t_max[i] = framed.t_max;
                    self.start[i] = framed.start;
                    self.scale[i] = framed.scale;
                }
                _ => self.others.push(i as u32),
            }
        }
    }

    /// What follows from them, without a branch, so that it is done for many rays at once.
    #[inline(always)]
    fn derive(&mut self, root: Root<'_>, i: usize) {
        const LEAST: f32 = 1e-20;
        const EPSILON: f32 = f32::EPSILON;
        let least = |a: f32, b: f32| if a < b { a } else { b };
        let most = |a: f32, b: f32| if a > b { a } else { b };
        let mut t_enter = self.t_min[i] * (1.0 - 2.0 * EPSILON);
        let mut t_exit = self.t_max[i] * (1.0 + 2.0 * EPSILON);
        for k in 0..3 {
            let (origin, direction) = (self.origin[k][i], self.direction[k][i]);
            let inverse = 1.0 / most(direction.abs(), LEAST).copysign(direction);
            let [a, b] = [root.corners[0][k], root.corners[1][k]].map(|c| (c - origin) * inverse);
            t_enter = most(least(a, b), t_enter);
            t_exit = least(most(a, b), t_exit);
            self.inverse[k][i] = inverse;
            self.shifted[k][i] = origin + root.thick.copysign(direction);
        }
        self.t_enter[i] = t_enter;
        self.t_exit[i] = t_exit;
        let [x, y, z] = [0, 1, 2].map(|k: usize| self.direction[k][i].abs());
        let y_or_z = if y > z { 1 } else { 2 };
        self.axis[i] = if x > y && x > z { 0 } else { y_or_z };
        let [x, y, z] = [0, 1, 2].map(|k: usize| self.origin[k][i].abs());
        self.reach[i] = 0.5 + most(x, most(y, z));
    }

    /// A ray with all its numbers.
    #[inline(always)]
    pub(super) fn framed(&self, ray: usize) -> FramedRay {
        FramedRay {
            origin: self.origin.each_ref().map(|x| x[ray]).into(),
            direction: self.direction.each_ref().map(|x| x[ray]).into(),
            t_min: self.t_min[ray],
            t_max: self.t_max[ray],
            start: self.start[ray],
            scale: self.scale[ray],
        }
    }
}
