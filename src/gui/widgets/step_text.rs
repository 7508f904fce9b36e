//! Rays and the steps of their traversal in words.

use crate::primitive::Primitive;
use crate::scene::Scene;
use crate::trace::{
    BoxTest, BoxesStep, Children, CulledStep, Fate, InnerStep, LeafOutcome, LeafStep, RayKind,
    RayPath, Step, TestStep,
};

use super::symbol::grouped;

/// A distance in few characters.
pub fn short(t: f64) -> String {
    if t.abs() >= 1e5 || (t != 0.0 && t.abs() < 1e-3) {
        format!("{t:.2e}")
    } else {
        format!("{t:.4}")
    }
}

/// A stretch of a ray.
pub fn interval(t_enter: f64, t_exit: f64) -> String {
    format!("{} – {}", short(t_enter), short(t_exit))
}

/// A kind of primitive in the singular, and the object's number.
pub fn object(scene: &Scene, number: u32) -> String {
    let kind = match &scene.objects()[number as usize] {
        Primitive::Sphere(_) => "sphere",
        Primitive::Triangle(_) => "triangle",
        Primitive::Polygon(_) => "polygon",
        Primitive::Cone(c) if c.is_cylinder() => "cylinder",
        Primitive::Cone(_) => "cone",
    };
    format!("{kind} {number}")
}

/// How a ray ends.
pub fn outcome(scene: &Scene, path: &RayPath) -> String {
    match (path.kind, path.hit.is_hit()) {
        (RayKind::Shadow, true) => format!("blocked by {}", object(scene, path.hit.object)),
        (RayKind::Shadow, false) => "reaches the light".to_owned(),
        (_, true) => object(scene, path.hit.object),
        (_, false) => "background".to_owned(),
    }
}

/// Which children, in a word.
pub fn way(way: Children) -> &'static str {
    match way {
        Children::Near => "near",
        Children::Far => "far",
        Children::Both => "both",
    }
}

/// How many of something.
pub fn count(n: u32, one: &str, many: &str) -> String {
    format!(
        "{} {}",
        grouped(n as usize),
        if n == 1 { one } else { many }
    )
}

/// Why the traversal visits the children that it visits at an inner node.
pub fn why(step: &InnerStep) -> String {
    let (axis, plane) = (step.axis.name(), short(step.plane));
    let (near, far) = (grouped(step.near as usize), grouped(step.far as usize));
    let between = format!("{} to {} units", short(step.t_enter), short(step.t_exit));
    match (step.children, step.t_plane) {
        (Children::Near, Some(t)) => format!(
            "the plane {axis} = {plane} lies at t = {} units, beyond the interval's end {}: only \
             the near child, node {near}",
            short(t),
            short(step.t_exit)
        ),
        (Children::Near, None) => format!(
            "the ray runs along the plane {axis} = {plane}, on its near side: only node {near}"
        ),
        (Children::Far, Some(t)) => format!(
            "the plane {axis} = {plane} lies at t = {} units, before the interval's start {}: only \
             the far child, node {far}",
            short(t),
            short(step.t_enter)
        ),
        (Children::Far, None) => format!(
            "the ray runs along the plane {axis} = {plane}, on its far side: only node {far}"
        ),
        (Children::Both, Some(t)) => format!(
            "the plane {axis} = {plane} lies at t = {} units, inside the interval {between}: the \
             near child, node {near}, first; the far child, node {far}, is pending",
            short(t)
        ),
        (Children::Both, None) => format!(
            "the ray runs inside the plane {axis} = {plane}: both children, node {near} first; \
             node {far} is pending"
        ),
    }
}

/// The kind of node that a step visits.
pub fn kind(step: &Step) -> &'static str {
    match step {
        Step::Inner(_) | Step::Boxes(_) => "inner node",
        Step::Culled(_) => "culled node",
        Step::Leaf(_) => "leaf",
    }
}

/// How many children of a hierarchy's node are visited or become pending.
pub fn entered(step: &BoxesStep) -> String {
    let entered = step.entered();
    let all = count(step.tests.len() as u32, "box test", "box tests");
    match entered.first() {
        None => format!("{all}, no child entered"),
        Some(first) => format!(
            "{all}, {} entered, node {} first",
            entered.len(),
            grouped(first.node as usize)
        ),
    }
}

/// The same in a few characters.
pub fn entered_briefly(step: &BoxesStep) -> String {
    let (entered, all) = (step.entered(), step.tests.len());
    match entered.first() {
        None => format!("0 of {all} entered"),
        Some(first) => format!(
            "{} of {all} entered, {} first",
            entered.len(),
            grouped(first.node as usize)
        ),
    }
}

/// What becomes of a child, in a word or two.
pub fn fate(step: &BoxesStep, test: &BoxTest) -> String {
    if test.fate != Fate::Entered {
        return test.fate.text().to_owned();
    }
    let order = step.entered();
    match order.iter().position(|other| other.node == test.node) {
        Some(0) => "visited first".to_owned(),
        place => format!("pending, number {}", place.map_or(0, |place| place + 1)),
    }
}

/// The test of a child's box.
pub fn box_test(step: &BoxesStep, test: &BoxTest) -> String {
    let (node, fate) = (grouped(test.node as usize), fate(step, test));
    let [enter, exit] = test.within;
    match test.fate {
        Fate::Missed => format!("Node {node}: the ray misses its box"),
        Fate::BeyondHit => format!(
            "Node {node}: {} units, {fate} so far: not visited",
            interval(enter, exit)
        ),
        Fate::Entered => format!("Node {node}: {} units, {fate}", interval(enter, exit)),
    }
}

/// Why a traversal continues after a leaf although the closest hit so far lies in it; `None` after other steps.
pub fn overlap(path: &RayPath, step: usize) -> Option<String> {
    let Step::Leaf(leaf) = path.steps.get(step)? else {
        return None;
    };
    if leaf.outcome != LeafOutcome::OverlapAhead {
        return None;
    }
    let rest = path.steps[step + 1..].iter();
    let next = rest
        .into_iter()
        .find(|next| !matches!(next, Step::Culled(_)))?;
    let hit = closest_until(path, step)?;
    Some(format!(
        "Boxes overlap: node {} is pending and begins at {} units, before the closest hit so far at {}. It may \
         hold a closer one",
        grouped(next.node() as usize),
        short(next.interval()[0]),
        short(hit)
    ))
}

/// The closest hit up to a step.
fn closest_until(path: &RayPath, step: usize) -> Option<f64> {
    let leaves = path
        .steps
        .iter()
        .take(step + 1)
        .filter_map(|step| match step {
            Step::Leaf(leaf) => Some(leaf),
            _ => None,
        });
    let hits = leaves
        .flat_map(|leaf| &leaf.tests)
        .filter_map(|test| test.hit);
    hits.reduce(f64::min)
}

/// Whether the first hit was the closest, and what it took to know; `None` of rays in trees of planes, of
/// shadow rays and of rays without a hit.
pub fn first_hit(path: &RayPath) -> Option<String> {
    let has_boxes = path.steps.iter().any(|step| matches!(step, Step::Boxes(_)));
    if !has_boxes || path.kind == RayKind::Shadow {
        return None;
    }
    let hit_in = |step: &Step| match step {
        Step::Leaf(leaf) => leaf
            .tests
            .iter()
            .filter_map(|test| test.hit)
            .reduce(f64::min),
        _ => None,
    };
    let mut hits = path.steps.iter().enumerate();
    let (first, t) = hits.find_map(|(i, step)| Some((i, hit_in(step)?)))?;
    let closest = path.hit.t;
    let number = first + 1;
    if closest < t {
        let steps = path.steps.iter();
        let found = steps.rev().position(|step| hit_in(step) == Some(closest))?;
        return Some(format!(
            "The first hit, at {} units in step {number}, is not the closest: boxes overlap, and step {} \
             finds one at {}.",
            short(t),
            path.steps.len() - found,
            short(closest)
        ));
    }
    let after = path.steps[first + 1..].iter();
    let visited = after.filter(|step| !matches!(step, Step::Culled(_)));
    Some(match visited.count() {
        0 => format!(
            "The first hit, in step {number}, ends the search: no pending box begins before it."
        ),
        more => format!(
            "The first hit, in step {number}, is the closest. To know that takes {}, because boxes overlap.",
            count(more as u32, "more node", "more nodes")
        ),
    })
}

/// Why a pending node is skipped.
pub fn why_culled(step: &CulledStep) -> String {
    format!(
        "its box begins at {} units, beyond the closest hit at {}",
        short(step.t_enter),
        short(step.limit)
    )
}

/// What happened in a leaf.
pub fn in_leaf(scene: &Scene, leaf: &LeafStep) -> String {
    if leaf.objects == 0 {
        return format!("empty ({}); {}", leaf.stop.text(), leaf.outcome.text());
    }
    let hits: Vec<String> = leaf
        .tests
        .iter()
        .filter_map(|test| {
            let t = test.hit?;
            Some(format!(
                "{} at {} units",
                object(scene, test.object),
                short(t)
            ))
        })
        .collect();
    let hits = if hits.is_empty() {
        "no closer hit".to_owned()
    } else {
        format!("hit {}", hits.join(", then closer "))
    };
    format!(
        "{}, {}: {hits}; {}",
        count(leaf.objects, "object", "objects"),
        count(
            leaf.tests.len() as u32,
            "intersection test",
            "intersection tests"
        ),
        leaf.outcome.text()
    )
}

/// An intersection test.
pub fn test(scene: &Scene, kind: RayKind, test: &TestStep) -> String {
    let object = object(scene, test.object);
    match test.hit {
        Some(t) if kind == RayKind::Shadow => {
            format!("{object}: hit at t = {} units, before the light", short(t))
        }
        Some(t) => format!("{object}: hit at t = {} units, closest so far", short(t)),
        None => format!("{object}: miss"),
    }
}

/// A step in one sentence, with its number.
pub fn step(scene: &Scene, number: usize, step: &Step) -> String {
    match step {
        Step::Inner(inner) => format!(
            "Step {number}: inner node {}, depth {}: {}.",
            grouped(inner.node as usize),
            inner.depth,
            why(inner)
        ),
        Step::Boxes(boxes) => format!(
            "Step {number}: inner node {}, depth {}: {}.",
            grouped(boxes.node as usize),
            boxes.depth,
            entered(boxes)
        ),
        Step::Culled(culled) => format!(
            "Step {number}: node {}, depth {}, is culled: {}.",
            grouped(culled.node as usize),
            culled.depth,
            why_culled(culled)
        ),
        Step::Leaf(leaf) => format!(
            "Step {number}: leaf {}, depth {}, from {} to {} units: {}.",
            grouped(leaf.node as usize),
            leaf.depth,
            short(leaf.t_enter),
            short(leaf.t_exit),
            in_leaf(scene, leaf)
        ),
    }
}

/// A step in a sentence that fits into a line, without the reasons.
pub fn short_step(scene: &Scene, number: usize, taken: &Step) -> String {
    match taken {
        Step::Inner(inner) => {
            let (near, far) = (grouped(inner.near as usize), grouped(inner.far as usize));
            let next = match inner.children {
                Children::Near => format!("only the near child, node {near}"),
                Children::Far => format!("only the far child, node {far}"),
                Children::Both => {
                    format!("the near child, node {near}, first; node {far} is pending")
                }
            };
            format!(
                "Step {number}: inner node {}, depth {}: {next}.",
                grouped(inner.node as usize),
                inner.depth
            )
        }
        Step::Boxes(_) | Step::Culled(_) => step(scene, number, taken),
        Step::Leaf(leaf) => {
            let hit = leaf.tests.iter().rev().find_map(|test| {
                let t = test.hit?;
                Some(format!(
                    "hit {} at {} units",
                    object(scene, test.object),
                    short(t)
                ))
            });
            let tests = count(leaf.tests.len() as u32, "test", "tests");
            let found = match (leaf.objects, hit) {
                (0, _) => "empty".to_owned(),
                (_, Some(hit)) => format!("{tests}, {hit}"),
                (_, None) => format!("{tests}, no hit"),
            };
            format!(
                "Step {number}: leaf {}, depth {}: {found}; {}.",
                grouped(leaf.node as usize),
                leaf.depth,
                leaf.outcome.text()
            )
        }
    }
}
