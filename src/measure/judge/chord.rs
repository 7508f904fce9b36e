//! The exact intersection of a ray with the area within an outline.

use super::span::rational;
use crate::geometry::{Ray, Vec3};
use crate::primitive::exact::Root;
use dashu_ratio::Relaxed as Rational;

/// A vertex in coordinates in which the ray is the third axis. The first two are multiplied by the absolute
/// value of the direction's largest component, the third is the ray parameter.
struct Seen {
    x: Rational,
    y: Rational,
    t: Rational,
}

/// An edge that crosses the first axis, at `x`.
struct End<'a> {
    x: Rational,
    from: &'a Seen,
    to: &'a Seen,
}

/// An intersection with the area within an outline.
pub struct Pierced {
    pub t: Root,
    pub on_outline: bool,
}

/// Returns where the ray's line crosses the area within an outline, outline included, by the even–odd rule.
/// A line that sees no area has no intersection.
///
/// The chord of the outline along the first axis through the ray ends on two edges. The distance is
/// interpolated between its ends, and there between the vertices of the edges. If the vertices lie in a
/// plane, the line crosses the plane there. Otherwise the hit still lies between the vertices.
pub fn pierced(vertices: &[Vec3], ray: &Ray) -> Option<Pierced> {
    let zero = Rational::ZERO;
    let seen: Vec<Seen> = vertices.iter().map(|&v| seen_by(ray, v)).collect();
    let (mut left, mut right): (Option<End<'_>>, Option<End<'_>>) = (None, None);
    let (mut inside, mut on_edge, mut area) = (false, None, Rational::ZERO);
    let mut a = seen.last()?;
    for b in &seen {
        let cross = &(&a.x * &b.y) - &(&a.y * &b.x);
        area += &cross;
        if cross == zero && contains_zero(&a.x, &b.x) && contains_zero(&a.y, &b.y) {
            on_edge = on_edge.or_else(|| Some(t_of_zero(a, b)));
        } else if (a.y > zero) != (b.y > zero) {
            let end = End {
                x: cross / (&b.y - &a.y),
                from: a,
                to: b,
            };
            if end.x > zero {
                inside = !inside;
                if right.as_ref().is_none_or(|right| end.x < right.x) {
                    right = Some(end);
                }
            } else if left.as_ref().is_none_or(|left| end.x > left.x) {
                left = Some(end);
            }
        }
        a = b;
    }
    if area == zero {
        return None;
    }
    if let Some(t) = on_edge {
        return Some(Pierced {
            t: Root::from(t),
            on_outline: true,
        });
    }
    let (left, right) = (left.filter(|_| inside)?, right?);
    let t = (right.t() * -&left.x + left.t() * &right.x) / (&right.x - &left.x);
    Some(Pierced {
        t: Root::from(t),
        on_outline: false,
    })
}

/// Returns a vertex as the ray sees it. Of equal components of the direction, the last is the largest.
fn seen_by(ray: &Ray, vertex: Vec3) -> Seen {
    let size = ray.direction.abs();
    let k = if size.x > size.y && size.x > size.z {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let p: [Rational; 3] = std::array::from_fn(|i| rational(vertex[i]) - rational(ray.origin[i]));
    let d: [Rational; 3] = std::array::from_fn(|i| rational(ray.direction[i]));
    let across = |i: usize| {
        let x = &(&d[k] * &p[i]) - &(&d[i] * &p[k]);
        if d[k] < Rational::ZERO { -x } else { x }
    };
    Seen {
        x: across((k + 1) % 3),
        y: across((k + 2) % 3),
        t: &p[k] / &d[k],
    }
}

impl End<'_> {
    /// Returns the ray parameter at the end of the chord.
    fn t(&self) -> Rational {
        let (a, b) = (self.from, self.to);
        (&a.t * &b.y - &a.y * &b.t) / (&b.y - &a.y)
    }
}

fn contains_zero(a: &Rational, b: &Rational) -> bool {
    *a.min(b) <= Rational::ZERO && *a.max(b) >= Rational::ZERO
}

/// Returns the ray parameter of a segment where its first two coordinates are 0; that of its start if they
/// are 0 everywhere.
fn t_of_zero(a: &Seen, b: &Seen) -> Rational {
    let (x, y) = (&b.x - &a.x, &b.y - &a.y);
    if y != Rational::ZERO {
        (&a.t * &b.y - &a.y * &b.t) / y
    } else if x != Rational::ZERO {
        (&a.t * &b.x - &a.x * &b.t) / x
    } else {
        a.t.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Vec3; 4] = [
        Vec3::new(-1.0, -1.0, 2.0),
        Vec3::new(1.0, -1.0, 2.0),
        Vec3::new(1.0, 1.0, 2.0),
        Vec3::new(-1.0, 1.0, 2.0),
    ];

    fn t(vertices: &[Vec3], origin: Vec3, direction: Vec3) -> Option<(f64, bool)> {
        let ray = Ray::new(origin, direction);
        pierced(vertices, &ray).map(|p| (p.t.approximate(), p.on_outline))
    }

    #[test]
    fn the_outline_is_inside_and_the_least_beyond_is_not() {
        let at = |x: f64, y: f64| t(&SQUARE, Vec3::new(x, y, 0.0), Vec3::Z);
        assert_eq!(at(0.25, 0.5), Some((2.0, false)));
        for (x, y) in [(1.0, 0.0), (-1.0, 0.3), (0.3, 1.0), (0.3, -1.0), (1.0, 1.0)] {
            assert_eq!(at(x, y), Some((2.0, true)), "{x} {y}");
        }
        assert_eq!(at(1.0f64.next_up(), 0.0), None);
        assert_eq!(at(0.0, (-1.0f64).next_down()), None);
        assert_eq!(at(1.0f64.next_down(), 0.0), Some((2.0, false)));
    }

    #[test]
    fn a_ray_in_the_plane_has_no_hit_and_one_beside_it_has() {
        let in_plane = Vec3::new(-3.0, 0.0, 2.0);
        assert_eq!(t(&SQUARE, in_plane, Vec3::X), None);
        // Along an edge.
        assert_eq!(t(&SQUARE, Vec3::new(-3.0, 1.0, 2.0), Vec3::X), None);
        // At the least angle it crosses the plane, at the origin's distance.
        let beside = Vec3::new(1.0, 0.0, 5e-324);
        assert_eq!(
            t(&SQUARE, Vec3::new(0.0, 0.0, 2.0), beside),
            Some((0.0, false))
        );
    }

    #[test]
    fn crossed_outlines_are_inside_by_the_even_odd_rule() {
        let bow = [SQUARE[0], SQUARE[1], SQUARE[3], SQUARE[2]];
        assert_eq!(
            t(&bow, Vec3::new(0.0, 0.5, 0.0), Vec3::Z),
            None,
            "no area in all"
        );
        let twice = [SQUARE, SQUARE].concat();
        assert_eq!(t(&twice, Vec3::ZERO, Vec3::Z), None);
        assert_eq!(t(&twice, Vec3::X, Vec3::Z), Some((2.0, true)));
    }

    #[test]
    fn off_a_plane_the_chord_through_the_ray_decides() {
        // Two vertices are higher: along x the surface rises where a chord ends on their edge.
        let mut bent = SQUARE;
        bent[2].z = 4.0;
        // A chord along x at y = ½: on the left edge z is 2, on the right edge 3.5.
        let seen = t(&bent, Vec3::new(0.0, 0.5, 0.0), Vec3::Z);
        assert_eq!(seen, Some((2.75, false)));
        // The direction's sign and length do not change the chord.
        let from_above = t(&bent, Vec3::new(0.0, 0.5, 9.0), Vec3::Z * -2.0);
        assert_eq!(from_above, Some(((9.0 - 2.75) / 2.0, false)));
    }
}
