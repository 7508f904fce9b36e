//! Triangles and polygons: where a line crosses the area within an outline.

use super::distance::Distance;
use super::double_word::DoubleWord;
use super::number::{Number, Unsure};
use super::vector::{Vector, minor};
use crate::geometry::{Axis, Ray, Vec3};
use std::cmp::Ordering;

/// A point in coordinates in which the ray is the third axis. Where `m` is the largest component of the
/// direction, the first two are multiplied by |`m`|, and the third is `m`² times the ray parameter.
#[derive(Clone)]
struct Seen<N> {
    x: N,
    y: N,
    z: N,
}

/// Returns the three axes in cyclic order with that of the direction's largest component last.
#[inline(always)]
fn axes(direction: Vec3) -> [usize; 3] {
    let k = Axis::of_largest(direction.abs().to_array()).index();
    [(k + 1) % 3, (k + 2) % 3, k]
}

/// Returns the coordinate `i` of a point in [`Seen`], where `along` is that along the axis `k` from the origin.
#[inline(always)]
fn across<N: Number>(point: Vec3, ray: &Ray, i: usize, k: usize, along: &N) -> N {
    let major = ray.direction[k];
    let rise = N::of(ray.direction[i] * major.signum());
    let from_origin = N::difference(point[i], ray.origin[i]);
    minor(&from_origin, along, &rise, &N::of(major.abs()))
}

impl<N: Number> Seen<N> {
    #[inline(always)]
    fn of(point: Vec3, ray: &Ray) -> Self {
        let [i, j, k] = axes(ray.direction);
        let along = N::difference(point[k], ray.origin[k]);
        Seen {
            x: across(point, ray, i, k, &along),
            y: across(point, ray, j, k, &along),
            z: along * N::of(ray.direction[k]),
        }
    }

    /// Returns twice the signed area of the triangle from the ray to two points.
    #[inline(always)]
    fn cross(&self, other: &Self) -> N {
        minor(&self.x, &self.y, &other.x, &other.y)
    }
}

/// Returns the square of the direction's largest component.
#[inline(always)]
fn squared_largest<N: Number>(ray: &Ray) -> N {
    let largest = ray.direction.abs().max_element();
    N::of(largest) * N::of(largest)
}

/// Returns where a line crosses a triangle, edges included. A line within its plane does not.
#[inline(always)]
pub(super) fn triangle<N: Number>(
    vertices: &[Vec3; 3],
    ray: &Ray,
) -> Result<Option<Distance<N>>, Unsure> {
    let [a, b, c] = *vertices;
    let (a, b, c) = (Seen::<N>::of(a, ray), Seen::of(b, ray), Seen::of(c, ray));
    let weights = [c.cross(&b), a.cross(&c), b.cross(&a)];
    let mut sides = [false; 2];
    for weight in &weights {
        match weight.sign()? {
            Ordering::Less => sides[0] = true,
            Ordering::Equal => {}
            Ordering::Greater => sides[1] = true,
        }
    }
    if sides[0] == sides[1] {
        return Ok(None);
    }
    let [u, v, w] = weights;
    let determinant = u.clone() + v.clone() + w.clone();
    let along = N::sum_of_products([(u, a.z), (v, b.z), (w, c.z)]);
    Distance::fraction(along, determinant * squared_largest(ray))
}

/// Returns the normal of a triangle, of twice the length of its area.
#[inline(always)]
fn normal<N: Number>([a, b, c]: [&Vec3; 3]) -> Vector<N> {
    Vector::difference(*b, *a).cross(&Vector::difference(*c, *a))
}

/// Returns where a line that certainly crosses a triangle does so: where it crosses the plane. This needs
/// fewer operations than [`triangle`].
#[inline(always)]
pub(super) fn plane<N: Number>(
    [a, b, c]: &[Vec3; 3],
    ray: &Ray,
) -> Result<Option<Distance<N>>, Unsure> {
    let normal = normal::<N>([a, b, c]);
    let distance = normal.dot(&Vector::difference(*a, ray.origin));
    Distance::fraction(distance, normal.dot(&Vector::from(ray.direction)))
}

/// Returns where a line from `origin` crosses the plane of a triangle, as [`plane`], rounded to the nearest
/// number; NaN if twice the precision does not determine that. Branchless, so that a loop over many triangles
/// becomes vectors.
#[inline(always)]
pub(crate) fn nearest_in_plane<const FMA: bool>(
    [a, b, c]: [Vec3; 3],
    origin: Vec3,
    direction: Vec3,
) -> f64 {
    let normal = normal::<DoubleWord<FMA>>([&a, &b, &c]);
    let over = normal.dot(&Vector::difference(a, origin));
    let under = normal.dot(&Vector::from(direction));
    let [lo, hi] = over.over(under).around();
    if lo == hi { lo } else { f64::NAN }
}

/// Returns the height of a point above the plane of a triangle, times twice its area.
pub(super) fn height<N: Number>([a, b, c]: &[Vec3; 3], point: Vec3) -> N {
    normal::<N>([a, b, c]).dot(&Vector::difference(point, *a))
}

/// An edge that crosses the first axis at `over / under`.
struct Edge<N> {
    from: Seen<N>,
    to: Seen<N>,
    over: N,
    /// Positive.
    under: N,
}

impl<N: Number> Edge<N> {
    #[inline(always)]
    fn is_left_of(&self, other: &Self) -> Result<bool, Unsure> {
        let difference = minor(&self.over, &self.under, &other.over, &other.under);
        Ok(difference.sign()? == Ordering::Less)
    }

    /// Returns the third coordinate where it crosses the axis, times `under`.
    #[inline(always)]
    fn along(&self) -> N {
        let (from, to) = (&self.from, &self.to);
        minor(&from.z, &from.y, &to.z, &to.y)
    }
}

/// Returns where a line crosses the area within an outline, outline included, by the even–odd rule. A line
/// that sees no area does not.
///
/// The chord of the outline along the first axis through the ray ends on two edges. The distance is
/// interpolated between its ends, and there between the vertices of the edges. So a hit is between the
/// vertices however small the angle, and adjacent polygons decide an edge from the same numbers. If the
/// vertices lie in a plane, the line crosses the plane there.
#[inline(always)]
pub(super) fn outline<N: Number>(
    vertices: &[Vec3],
    ray: &Ray,
) -> Result<Option<Distance<N>>, Unsure> {
    let Some(&last) = vertices.last() else {
        return Ok(None);
    };
    let mut next = Seen::<N>::of(last, ray);
    let (mut left, mut right): (Option<Edge<N>>, Option<Edge<N>>) = (None, None);
    let (mut inside, mut on_edge, mut area) = (false, None, N::of(0.0));
    for &vertex in vertices {
        let a = &std::mem::replace(&mut next, Seen::of(vertex, ray));
        let b = &next;
        let cross = a.cross(b);
        area = area + cross.clone();
        let sides = [a.y.sign()?, b.y.sign()?];
        if cross.sign()? == Ordering::Equal {
            on_edge = on_edge.or(on_edge_at(a, b)?);
        }
        if (sides[0] == Ordering::Greater) == (sides[1] == Ordering::Greater) {
            continue;
        }
        let rise = b.y.clone() - a.y.clone();
        let (over, under) = match rise.sign()? {
            Ordering::Less => (-cross, -rise),
            _ => (cross, rise),
        };
        let is_right = over.sign()? == Ordering::Greater;
        let edge = Edge {
            from: if sides[1] == Ordering::Greater { a } else { b }.clone(),
            to: if sides[1] == Ordering::Greater { b } else { a }.clone(),
            over,
            under,
        };
        if is_right {
            inside = !inside;
            let is_nearer = match &right {
                Some(right) => edge.is_left_of(right)?,
                None => true,
            };
            if is_nearer {
                right = Some(edge);
            }
        } else {
            let is_nearer = match &left {
                Some(left) => left.is_left_of(&edge)?,
                None => true,
            };
            if is_nearer {
                left = Some(edge);
            }
        }
    }
    if area.sign()? == Ordering::Equal {
        return Ok(None);
    }
    let scale = squared_largest::<N>(ray);
    if let Some((over, under)) = on_edge {
        return Distance::fraction(over, under * scale);
    }
    match (inside, left, right) {
        (true, Some(left), Some(right)) => {
            let over = minor(&left.along(), &left.over, &right.along(), &right.over);
            let under = minor(&right.over, &right.under, &left.over, &left.under);
            Distance::fraction(over, under * scale)
        }
        _ => Ok(None),
    }
}

/// Returns the third coordinate, as a fraction, of a segment where its first two are 0; `None` beyond its
/// ends. The origin must lie on the line of the segment in the first two coordinates.
#[inline(always)]
fn on_edge_at<N: Number>(a: &Seen<N>, b: &Seen<N>) -> Result<Option<(N, N)>, Unsure> {
    let [ax, bx, ay, by] = [a.x.sign()?, b.x.sign()?, a.y.sign()?, b.y.sign()?];
    let is_beyond = |a: Ordering, b: Ordering| a == b && a != Ordering::Equal;
    if is_beyond(ax, bx) || is_beyond(ay, by) {
        return Ok(None);
    }
    let (x, y) = (b.x.clone() - a.x.clone(), b.y.clone() - a.y.clone());
    Ok(Some(if y.sign()? != Ordering::Equal {
        (minor(&a.z, &a.y, &b.z, &b.y), y)
    } else if x.sign()? != Ordering::Equal {
        (minor(&a.z, &a.x, &b.z, &b.x), x)
    } else {
        (a.z.clone(), N::of(1.0))
    }))
}
