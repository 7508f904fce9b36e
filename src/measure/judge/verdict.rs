//! Verdicts on answers about rays.

use super::crossing::{Crossing, Line};
use super::meeting::{Meeting, enlarged};
use super::surface::Surface;
use super::tolerance::Tolerance;
use crate::geometry::{Aabb, Ray};
use crate::primitive::Shape;
use crate::primitive::exact::Root;
use crate::scene::Scene;
use crate::structure::{Nodes, Tree};
use crate::trace::Hit;
use serde::Serialize;

/// The answer about a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The nearest hit.
    Nearest(Hit),
    /// Whether an object blocks the ray before its end.
    Blocked(bool),
}

impl Answer {
    /// Returns the answer to the same question where this is the closest hit.
    pub fn of_kind(self, hit: Hit) -> Answer {
        match self {
            Answer::Nearest(_) => Answer::Nearest(hit),
            Answer::Blocked(_) => Answer::Blocked(hit.is_hit()),
        }
    }

    /// Returns whether there is a hit.
    pub fn is_hit(self) -> bool {
        match self {
            Answer::Nearest(hit) => hit.is_hit(),
            Answer::Blocked(blocked) => blocked,
        }
    }
}

/// Why two answers differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Both are exactly right. Their distances are exactly equal, or the ray hits an edge, is
    /// tangent to a curved surface, or starts or ends on a surface.
    Tie,
    /// Both are right within rounding: each is exact for some coordinates within the tolerance.
    Rounding,
    /// At least one is wrong.
    Fault {
        /// The first answer.
        a_is_wrong: bool,
        /// The second.
        b_is_wrong: bool,
    },
}

/// Number of disagreements per [`Verdict`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    pub ties: u64,
    pub roundings: u64,
    pub faults: u64,
}

impl Tally {
    pub fn add(&mut self, verdict: Verdict) {
        *match verdict {
            Verdict::Tie => &mut self.ties,
            Verdict::Rounding => &mut self.roundings,
            Verdict::Fault { .. } => &mut self.faults,
        } += 1;
    }
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Tally) {
        self.ties += other.ties;
        self.roundings += other.roundings;
        self.faults += other.faults;
    }
}

/// All possible intersections of a ray with the objects of a scene, and the object's index for
/// each.
struct Evidence(Vec<(u32, Crossing)>);

impl Evidence {
    /// Gathers them. A tree, which must be one of the scene, saves time in large scenes.
    fn gather(scene: &Scene, tree: Option<&Tree>, ray: &Ray, tolerance: &Tolerance) -> Self {
        let is_usable = ray.direction.abs().max_element() > 0.0
            && ray.origin.is_finite()
            && ray.direction.is_finite();
        if !is_usable {
            return Evidence(Vec::new());
        }
        let line = Line::new(ray, tolerance);
        let meeting = Meeting::of(ray);
        let may_meet = |bounds: Aabb| {
            let far = bounds.magnitude() + ray.origin.abs().max_element();
            let bounds = bounds.enlarged(tolerance.length + tolerance.relative * far);
            meeting.may_meet(&enlarged(&bounds))
        };
        let objects = match tree {
            Some(tree) => candidates(tree, may_meet),
            None => (0..scene.objects().len() as u32).collect(),
        };
        let objects = objects
            .into_iter()
            .map(|number| (number, &scene.objects()[number as usize]));
        let near = objects.filter(|(_, object)| may_meet(object.bounds()));
        let all = near.flat_map(|(number, object)| {
            Surface::of(object)
                .crossings(&line, tolerance)
                .into_iter()
                .map(move |crossing| (number, crossing))
        });
        Evidence(all.collect())
    }

    /// Returns the shortest distance by which the ray has certainly hit something; `None` if no hit
    /// is certain.
    fn limit(&self) -> Option<&Root> {
        let certain = self.0.iter().filter(|(_, c)| c.certain);
        certain.map(|(_, c)| &c.latest).min()
    }

    /// Returns the crossing that a hit refers to: of its object's crossings, the one nearest to the
    /// hit's distance.
    fn crossing_of(&self, hit: &Hit) -> Option<&Crossing> {
        let off = |c: &Crossing| {
            let (lo, hi) = (c.earliest.approximate(), c.latest.approximate());
            (lo - hit.t).max(hit.t - hi).max(0.0)
        };
        let own = self.0.iter().filter(|(object, _)| *object == hit.object);
        own.map(|(_, crossing)| crossing)
            .min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    /// Returns whether the answer can be right. `slack` is the relative error allowed in the
    /// distance of a hit.
    fn allows(&self, answer: Answer, slack: Option<f64>) -> bool {
        match answer {
            Answer::Blocked(true) => !self.0.is_empty(),
            Answer::Blocked(false) => self.limit().is_none(),
            Answer::Nearest(hit) if !hit.is_hit() => self.limit().is_none(),
            Answer::Nearest(hit) => self.crossing_of(&hit).is_some_and(|crossing| {
                let in_front = self.limit().is_none_or(|limit| crossing.earliest <= *limit);
                let distance = slack.is_none_or(|slack| {
                    let slack = slack * hit.t.abs();
                    let (lo, hi) = (
                        crossing.earliest.approximate(),
                        crossing.latest.approximate(),
                    );
                    lo - slack <= hit.t && hit.t <= hi + slack
                });
                in_front && distance
            }),
        }
    }
}

/// Returns the objects of all leaves whose cells a ray may meet, in ascending order.
fn candidates(tree: &Tree, may_meet: impl Fn(Aabb) -> bool) -> Vec<u32> {
    let (mut objects, mut stack) = (Vec::new(), vec![tree.root()]);
    while let Some(cell) = stack.pop() {
        if may_meet(cell.bounds) {
            objects.extend(tree.leaf_objects(cell.node));
            stack.extend(tree.children(&cell));
        }
    }
    objects.sort_unstable();
    objects.dedup();
    objects
}

/// Returns the largest absolute coordinate of a scene and of a ray's origin, a length.
pub fn scale_of(scene: &Scene, ray: &Ray) -> f64 {
    let bounds = scene.bounds();
    let of_scene = if bounds.is_empty() {
        0.0
    } else {
        bounds.magnitude()
    };
    of_scene.max(ray.origin.abs().max_element())
}

/// Decides why two answers about a ray differ.
///
/// If both answers come from the same coordinates and the same intersection tests, `rounding` is
/// `None`. Then only an exact tie excuses a difference. Otherwise `rounding` bounds how far the
/// coordinates behind either answer may have been rounded.
pub fn settle(
    scene: &Scene,
    ray: &Ray,
    [a, b]: [Answer; 2],
    rounding: Option<Tolerance>,
) -> Verdict {
    let exact = Evidence::gather(scene, None, ray, &Tolerance::NONE);
    let mut right = [a, b].map(|answer| exact.allows(answer, None));
    let is_tie = right == [true; 2] && !same_hit(&exact, a, b);
    if is_tie {
        return Verdict::Tie;
    }
    if let Some(tolerance) = rounding {
        let rounded = Evidence::gather(scene, None, ray, &tolerance);
        let within = [a, b].map(|answer| rounded.allows(answer, Some(tolerance.relative)));
        if within == [true; 2] {
            return Verdict::Rounding;
        }
        right = within;
    }
    // Both report the same hit at different distances. Which of them is wrong cannot be determined.
    let neither = right == [true; 2];
    Verdict::Fault {
        a_is_wrong: neither || !right[0],
        b_is_wrong: neither || !right[1],
    }
}

/// Returns whether two answers mean the same crossing, at any distance.
fn same_hit(exact: &Evidence, a: Answer, b: Answer) -> bool {
    match (a, b) {
        (Answer::Nearest(a), Answer::Nearest(b)) => {
            let place = |hit| exact.crossing_of(hit).map(std::ptr::from_ref);
            a.object == b.object && place(&a) == place(&b)
        }
        _ => false,
    }
}

/// How correct one answer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It agrees with exact arithmetic, or is one of several exact ties.
    Right,
    /// It is right within rounding.
    Rounded,
    Wrong,
}

/// Checks one answer against exact arithmetic.
pub fn examine(scene: &Scene, ray: &Ray, answer: Answer, tolerance: Tolerance) -> Standing {
    examine_by(None, scene, ray, answer, tolerance)
}

/// Checks one answer as [`examine`] does, in less time with a hierarchy of the scene.
pub fn examine_with(
    tree: &Tree,
    scene: &Scene,
    ray: &Ray,
    answer: Answer,
    tolerance: Tolerance,
) -> Standing {
    // The cells of planes need not contain objects by a margin, as boxes do.
    let tree = Some(tree).filter(|tree| matches!(tree.nodes(), Nodes::Boxes(_)));
    examine_by(tree, scene, ray, answer, tolerance)
}

fn examine_by(
    tree: Option<&Tree>,
    scene: &Scene,
    ray: &Ray,
    answer: Answer,
    tolerance: Tolerance,
) -> Standing {
    // The distance of a hit is always rounded.
    let allowed = |within: &Tolerance| {
        Evidence::gather(scene, tree, ray, within).allows(answer, Some(tolerance.relative))
    };
    if allowed(&Tolerance::NONE) {
        Standing::Right
    } else if allowed(&tolerance) {
        Standing::Rounded
    } else {
        Standing::Wrong
    }
}
