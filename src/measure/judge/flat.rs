//! Triangles and polygons: intersections of a ray with the area inside an outline.

use super::chord;
use super::crossing::{Crossing, Line};
use super::span::{Span, SpanVec};
use crate::geometry::Vec3;
use crate::primitive::exact::Root;
use dashu_ratio::Relaxed as Rational;
use std::cmp::Ordering;

/// Returns the intersection with a triangle whose vertices move by at most `reach`.
pub fn triangle(vertices: &[Vec3; 3], line: &Line<'_>, reach: &Rational) -> Option<Crossing> {
    outline(&vertices.map(|v| SpanVec::around(v, reach)), line)
}

/// Returns the intersection with a polygon whose vertices move by at most `reach`.
///
/// Without a tolerance, it is the exact one with the area within the outline ([`chord::pierced`]). With a
/// tolerance, the vertices lie in a common plane up to `reach`.
pub fn polygon(vertices: &[Vec3], line: &Line<'_>, reach: &Rational) -> Option<Crossing> {
    if *reach == Rational::ZERO && line.is_exact() {
        let pierced = chord::pierced(vertices, line.ray)?;
        return Some(Crossing {
            earliest: pierced.t.clone(),
            latest: pierced.t,
            certain: !pierced.on_outline,
        });
    }
    let around: Vec<_> = vertices
        .iter()
        .map(|&v| SpanVec::around(v, reach))
        .collect();
    outline(&around, line)
}

/// Returns the sum of the cross products of a triangle fan. It points along the normal, and its
/// length is twice the area.
fn newell_normal(vertices: &[SpanVec]) -> SpanVec {
    let first = &vertices[0];
    let fan = vertices.windows(2).skip(1);
    fan.map(|pair| (&pair[0] - first).cross(&(&pair[1] - first)))
        .reduce(|sum, cross| &sum + &cross)
        .expect("an outline has three vertices or more")
}

/// Returns the intersection of the line with the area inside a planar outline. A line within the
/// plane has none.
fn outline(vertices: &[SpanVec], line: &Line<'_>) -> Option<Crossing> {
    let inside = is_inside(vertices, line);
    if inside == Some(false) {
        return None;
    }
    let normal = newell_normal(vertices);
    let speed = normal.dot(&line.direction);
    if speed.sign() == Some(Ordering::Equal) {
        return None;
    }
    let distance = normal.dot(&(&vertices[0] - &line.origin));
    let t = match distance.divided_by(&speed) {
        Some(t) if t.is_exact() => t,
        // The ray is nearly parallel to the plane, so its distance is not bounded by the plane. It
        // is still bounded by the vertices.
        at_plane => {
            let along = between(vertices, line)?;
            at_plane.map_or(along.clone(), |t| Span {
                lo: t.lo.max(along.lo),
                hi: t.hi.min(along.hi),
            })
        }
    };
    (t.lo <= t.hi).then(|| Crossing {
        earliest: Root::from(t.lo),
        latest: Root::from(t.hi),
        certain: inside.is_some() && speed.sign().is_some(),
    })
}

/// Returns the interval of ray parameters at which the ray passes the vertices.
fn between(vertices: &[SpanVec], line: &Line<'_>) -> Option<Span> {
    let squared_length = line.direction.squared_length();
    let mut all: Option<Span> = None;
    for vertex in vertices {
        let along = (vertex - &line.origin).dot(&line.direction);
        let t = along.divided_by(&squared_length)?;
        all = Some(match all {
            None => t,
            Some(all) => Span {
                lo: all.lo.min(t.lo),
                hi: all.hi.max(t.hi),
            },
        });
    }
    all
}

/// Returns whether the line passes through the inside of the outline, projected along the ray, by
/// the even–odd rule. Returns `None` on an edge, and if the answer depends on the rounding within
/// the tolerance.
fn is_inside(vertices: &[SpanVec], line: &Line<'_>) -> Option<bool> {
    let d = &line.direction.0;
    let size = line.ray.direction.abs();
    let m = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j]))?;
    let (i, j) = ((m + 1) % 3, (m + 2) % 3);
    let seen: Vec<[Span; 2]> = vertices
        .iter()
        .map(|v| {
            let p = (v - &line.origin).0;
            [i, j].map(|k| &(&d[m] * &p[k]) - &(&d[k] * &p[m]))
        })
        .collect();
    // The side of the half-line on which a vertex lies may be uncertain. Either choice is right if
    // both edges of the vertex use the same one. Only edges that may contain the line itself
    // matter.
    let is_above = |p: &[Span; 2]| p[1].lo > Rational::ZERO;
    let may_straddle = |a: &Span, b: &Span| {
        let (lo, hi) = ((&a.lo).min(&b.lo), (&a.hi).max(&b.hi));
        *lo <= Rational::ZERO && *hi >= Rational::ZERO
    };
    let mut inside = false;
    for (n, a) in seen.iter().enumerate() {
        let b = &seen[(n + 1) % seen.len()];
        if !may_straddle(&a[1], &b[1]) {
            continue;
        }
        let cross = &(&a[0] * &b[1]) - &(&a[1] * &b[0]);
        match cross.sign() {
            None | Some(Ordering::Equal) => {
                if may_straddle(&a[0], &b[0]) {
                    return None;
                }
                if is_above(a) != is_above(b) {
                    // The edge lies entirely on one side of the line. It crosses the half-line only
                    // if it is on the right.
                    inside ^= a[0].lo > Rational::ZERO;
                }
            }
            Some(side) => {
                if is_above(a) != is_above(b) {
                    inside ^= (side == Ordering::Greater) == is_above(b);
                }
            }
        }
    }
    Some(inside)
}
