//! Spheres, cylinders and cones: roots of quadratic equations.

use super::crossing::{Crossing, Line};
use super::span::{Span, SpanVec, rational};
use crate::geometry::{Aabb, Vec3};
use crate::primitive::exact::{ConeEnds, Root};
use dashu_ratio::Relaxed as Rational;
use std::cmp::Ordering;

/// Returns the intersections with a sphere whose center and radius vary by at most `reach`.
pub fn sphere(center: Vec3, radius: f64, line: &Line<'_>, reach: &Rational) -> Vec<Crossing> {
    let start = nearest(center, line);
    let center = SpanVec::around(center, reach);
    let radius = Span::around(rational(radius), reach);
    let from_center = line.offset_at(&start, &center);
    let a = line.direction.squared_length();
    let b = from_center.dot(&line.direction);
    let c = &from_center.squared_length() - &radius.square();
    roots(&a, &b, &c)
        .unwrap_or_default()
        .into_iter()
        .map(|crossing| later(crossing, &start))
        .collect()
}

/// Returns the intersections with a cone or cylinder whose coordinates vary by at most `reach`.
///
/// The axis `w` from base to apex is not normalized, which keeps every coefficient rational. For a
/// point `p` relative to the base, the scaled height is `h = p·w`, from 0 to `w·w`. Its distance
/// from the axis is `|w × p| / |w|`. The surface at that height has the radius `r₀ + (r₁ − r₀) h /
/// w·w`. A cone whose ends are equal has no surface.
pub fn cone(cone: &ConeEnds, line: &Line<'_>, reach: &Rational) -> Vec<Crossing> {
    let start = nearest(0.5 * cone.base + 0.5 * cone.apex, line);
    let base = SpanVec::around(cone.base, reach);
    let axis = &SpanVec::around(cone.apex, reach) - &base;
    let squared_axis = axis.squared_length();
    if squared_axis.sign() == Some(Ordering::Equal) {
        return Vec::new();
    }
    let base_radius = Span::around(rational(cone.base_radius), reach);
    let growth = &Span::around(rational(cone.apex_radius), reach) - &base_radius;

    let from_base = line.offset_at(&start, &base);
    let (height, rise) = (from_base.dot(&axis), line.direction.dot(&axis));
    let (across, drift) = (axis.cross(&from_base), axis.cross(&line.direction));
    // Radius and its growth along the ray, both scaled by w·w.
    let radius = &(&base_radius * &squared_axis) + &(&growth * &height);
    let widening = &growth * &rise;
    let over_axis = |x: Span| x.divided_by(&squared_axis);
    let (Some(a), Some(b), Some(c)) = (
        over_axis(widening.square()).map(|x| &drift.squared_length() - &x),
        over_axis(&widening * &radius).map(|x| &across.dot(&drift) - &x),
        over_axis(radius.square()).map(|x| &across.squared_length() - &x),
    ) else {
        return vec![anywhere(cone, line)];
    };
    match roots(&a, &b, &c) {
        Some(roots) => roots
            .into_iter()
            .filter_map(|root| between_ends(root, &height, &rise, &squared_axis))
            .map(|crossing| later(crossing, &start))
            .collect(),
        None => vec![anywhere(cone, line)],
    }
}

/// Returns roughly the ray parameter nearest to a point. It is the origin of the equation's
/// variable, which keeps the coefficients and their intervals small. Any value is correct.
fn nearest(point: Vec3, line: &Line<'_>) -> Span {
    let unit = line.ray.direction / line.ray.direction.abs().max_element();
    let along = (point - line.ray.origin).dot(unit) / unit.length_squared();
    let t = along / line.ray.direction.abs().max_element();
    Span::exactly(rational(if t.is_finite() { t } else { 0.0 }))
}

/// Moves a crossing along the ray by a number of ray parameters.
fn later(crossing: Crossing, by: &Span) -> Crossing {
    Crossing {
        earliest: crossing.earliest.plus(&by.lo),
        latest: crossing.latest.plus(&by.hi),
        ..crossing
    }
}

/// Returns the roots of `a s² + 2 b s + c`. Returns `None` if `a` may or may not be 0 within the
/// tolerance. If the equation holds everywhere, the line lies in the surface and has no hit.
fn roots(a: &Span, b: &Span, c: &Span) -> Option<Vec<Crossing>> {
    let discriminant = &b.square() - &(a * c);
    match a.sign()? {
        Ordering::Less => roots(&-a, &-b, &-c),
        Ordering::Equal => {
            let twice = b + b;
            if twice.sign() == Some(Ordering::Equal) {
                return Some(Vec::new());
            }
            let root = (-c).divided_by(&twice)?;
            Some(vec![Crossing {
                earliest: Root::from(root.lo),
                latest: Root::from(root.hi),
                certain: true,
            }])
        }
        Ordering::Greater if discriminant.hi < Rational::ZERO => Some(Vec::new()),
        Ordering::Greater => {
            let certain = discriminant.lo > Rational::ZERO;
            let (least, most) = (-&b.hi, -&b.lo);
            // The least and the greatest value of (−b ± √discriminant) / a.
            let over = |root: Root, by_less: &Rational, by_more: &Rational| {
                let by = if root.sign() == Ordering::Less {
                    by_less
                } else {
                    by_more
                };
                root.times(&(&Rational::ONE / by))
            };
            let lowest = |root| over(root, &a.lo, &a.hi);
            let highest = |root| over(root, &a.hi, &a.lo);
            let (d, e) = (&discriminant.lo, &discriminant.hi);
            Some(vec![
                Crossing {
                    earliest: lowest(Root::new(least.clone(), true, e)),
                    latest: highest(Root::new(most.clone(), true, d)),
                    certain,
                },
                Crossing {
                    earliest: lowest(Root::new(least, false, d)),
                    latest: highest(Root::new(most, false, e)),
                    certain,
                },
            ])
        }
    }
}

/// Returns the root if it may lie between the ends of the cone.
fn between_ends(
    mut root: Crossing,
    height: &Span,
    rise: &Span,
    squared_axis: &Span,
) -> Option<Crossing> {
    let rises = [&rise.lo, &rise.hi];
    let ends = [&root.earliest, &root.latest];
    let mut climbs: Vec<Root> = ends
        .iter()
        .flat_map(|end| rises.iter().map(|rise| end.times(rise)))
        .collect();
    climbs.sort();
    let lowest = climbs[0].plus(&height.lo);
    let highest = climbs[3].plus(&height.hi);
    let (base, apex) = (
        Root::from(Rational::ZERO),
        Root::from(squared_axis.lo.clone()),
    );
    let farthest = Root::from(squared_axis.hi.clone());
    root.certain &= lowest > base && highest < apex;
    (highest >= base && lowest <= farthest).then_some(root)
}

/// Returns an uncertain crossing that covers the whole box of the cone.
fn anywhere(cone: &ConeEnds, line: &Line<'_>) -> Crossing {
    let bounds = bounds(cone);
    let speed = line.ray.direction.length();
    let middle = nearest(bounds.center(), line);
    let reach = bounds.size().length() / speed;
    let reach = rational(if reach.is_finite() { reach } else { f64::MAX });
    Crossing {
        earliest: Root::from(&middle.lo - &reach),
        latest: Root::from(middle.hi + &reach),
        certain: false,
    }
}

/// Returns a box around both ends of a cone, with their radii in all directions.
pub fn bounds(cone: &ConeEnds) -> Aabb {
    let end = |center: Vec3, radius: f64| Aabb::new(center - radius, center + radius);
    end(cone.base, cone.base_radius).union(&end(cone.apex, cone.apex_radius))
}
