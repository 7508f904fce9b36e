//! The areas of an object's parts in boxes.

use crate::geometry::{Aabb, Axis, Vec3};
use crate::primitive::{Cone, Primitive, cut_off};
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

/// Points of a curved surface, each of which stands for the same area.
const POINTS: u32 = 1024;

/// The form in which parts of a surface are measured.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// Corners of a planar outline, which is clipped exactly.
    Outline,
    /// Points, each of which stands for this area.
    Points(f64),
}

/// A part of a surface: points of the pool.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    from: usize,
    to: usize,
    bounds: Aabb,
}

/// The surface of one object and parts of it. Memory is reused for the next object.
#[derive(Default)]
pub struct Pieces {
    /// Points that were compared with boxes, over all objects.
    pub work: u64,
    form: Option<Form>,
    /// The points of all pieces.
    pool: Vec<Vec3>,
    /// Two outlines in the course of clipping.
    outlines: [Vec<Vec3>; 2],
}

impl Pieces {
    /// Returns the whole surface of an object, which replaces that of another one.
    pub fn whole(&mut self, object: &Primitive) -> Piece {
        self.pool.clear();
        let form = match object {
            Primitive::Triangle(triangle) => {
                self.pool.extend(triangle.vertices);
                Form::Outline
            }
            Primitive::Polygon(polygon) => {
                self.pool.extend(polygon.vertices_in_plane());
                Form::Outline
            }
            Primitive::Sphere(sphere) => {
                let points = PLACES.iter().map(|place| {
                    let height = 2.0 * place.below - 1.0;
                    let ring = (1.0 - height * height).sqrt();
                    let [x, y] = place.direction.map(|along| ring * along);
                    sphere.center + sphere.radius * Vec3::new(x, y, height)
                });
                self.pool.extend(points);
                Form::Points(4.0 * PI * sphere.radius * sphere.radius / f64::from(POINTS))
            }
            Primitive::Cone(cone) => {
                let along = cone.apex() - cone.base();
                let sides = along.normalize().any_orthonormal_pair();
                let point = |place| point_of(cone, along, sides, place);
                self.pool.extend(PLACES.iter().map(point));
                Form::Points(area_of(cone) / f64::from(POINTS))
            }
        };
        self.form = Some(form);
        self.piece(0)
    }

    /// Returns the area of a part.
    pub fn area(&self, piece: &Piece) -> f64 {
        let points = &self.pool[piece.from..piece.to];
        match self.form {
            None => 0.0,
            Some(Form::Points(each)) => points.len() as f64 * each,
            Some(Form::Outline) => {
                let pairs = points.windows(2).skip(1);
                let sum: Vec3 = pairs
                    .map(|pair| (pair[0] - points[0]).cross(pair[1] - points[0]))
                    .sum();
                0.5 * sum.length()
            }
        }
    }

    /// Returns the part of a part within a closed box, if any. All pieces that were made after `piece` become
    /// invalid.
    pub fn within(&mut self, piece: &Piece, cell: &Aabb) -> Option<Piece> {
        if !piece.bounds.touches(cell) {
            return None;
        }
        if cell.contains(piece.bounds.lo) && cell.contains(piece.bounds.hi) {
            return Some(*piece);
        }
        self.pool.truncate(piece.to);
        self.work += (piece.to - piece.from) as u64;
        match self.form? {
            Form::Outline => {
                let [outline, cut] = &mut self.outlines;
                outline.clear();
                outline.extend_from_slice(&self.pool[piece.from..piece.to]);
                clip(outline, cut, &piece.bounds, cell);
                self.pool.extend_from_slice(outline);
            }
            Form::Points(_) => {
                for i in piece.from..piece.to {
                    let point = self.pool[i];
                    if cell.contains(point) {
                        self.pool.push(point);
                    }
                }
            }
        }
        (self.pool.len() > piece.to).then(|| self.piece(piece.to))
    }

    /// Returns the piece that consists of the last points of the pool.
    fn piece(&self, from: usize) -> Piece {
        Piece {
            from,
            to: self.pool.len(),
            bounds: Aabb::around(self.pool[from..].iter().copied()),
        }
    }
}

/// Clips an outline with these bounds to a box.
fn clip(outline: &mut Vec<Vec3>, cut: &mut Vec<Vec3>, bounds: &Aabb, cell: &Aabb) {
    for axis in Axis::ALL {
        let k = axis.index();
        for (limit, side, is_cut) in [
            (cell.lo[k], 1.0, bounds.lo[k] < cell.lo[k]),
            (cell.hi[k], -1.0, bounds.hi[k] > cell.hi[k]),
        ] {
            if is_cut {
                cut_off(outline, cut, axis, limit, side);
            }
        }
    }
}

/// The place of a point on a surface around an axis.
struct Place {
    /// The share of the area that lies below the point.
    below: f64,
    /// The cosine and sine of the angle around the axis.
    direction: [f64; 2],
}

/// The places of all points, a Fibonacci lattice.
static PLACES: LazyLock<Vec<Place>> = LazyLock::new(|| {
    /// The golden angle as a share of a turn.
    const GOLDEN: f64 = 0.381_966_011_250_105_2;
    let place = |i| {
        let (sin, cos) = libm::sincos(TAU * (f64::from(i) * GOLDEN).fract());
        Place {
            below: (f64::from(i) + 0.5) / f64::from(POINTS),
            direction: [cos, sin],
        }
    };
    (0..POINTS).map(place).collect()
});

/// Returns a point of a cylinder or cone, given its axis and two directions perpendicular to it.
fn point_of(cone: &Cone, along: Vec3, (u, v): (Vec3, Vec3), place: &Place) -> Vec3 {
    let (base, apex) = (cone.base_radius(), cone.apex_radius());
    // The area below a height grows with the square of the radius there.
    let radius = (base * base + (apex * apex - base * base) * place.below).sqrt();
    let height = if base == apex {
        place.below
    } else {
        (radius - base) / (apex - base)
    };
    let [cos, sin] = place.direction;
    cone.base() + along * height + (u * cos + v * sin) * radius
}

/// Returns the area of a cylinder or cone, without end caps.
fn area_of(cone: &Cone) -> f64 {
    let (base, apex) = (cone.base_radius(), cone.apex_radius());
    let slant = cone.length().hypot(apex - base);
    PI * (base + apex) * slant
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::{Polygon, Sphere, Triangle};

    fn share(object: &Primitive, cell: Aabb) -> (f64, f64) {
        let mut pieces = Pieces::default();
        let whole = pieces.whole(object);
        let area = pieces.area(&whole);
        let part = pieces.within(&whole, &cell);
        (area, part.map_or(0.0, |part| pieces.area(&part)))
    }

    #[test]
    fn outlines_are_clipped_exactly() {
        let corners = [Vec3::ZERO, Vec3::X * 4.0, Vec3::Y * 4.0];
        let triangle = Primitive::Triangle(Triangle::new(corners, None).unwrap());
        let unit = Aabb::new(Vec3::splat(-1.0), Vec3::ONE);
        assert_eq!(share(&triangle, unit), (8.0, 1.0));
        let beyond = Aabb::new(Vec3::new(3.0, 0.0, -1.0), Vec3::new(5.0, 2.0, 1.0));
        assert_eq!(share(&triangle, beyond), (8.0, 0.5));
        // An L of three unit squares.
        let corners = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
        let corners = corners.map(|[x, y]| Vec3::new(f64::from(x), f64::from(y), 0.0));
        let polygon = Primitive::Polygon(Polygon::new(corners.to_vec(), None).unwrap());
        let right = Aabb::new(Vec3::new(1.0, 0.0, -1.0), Vec3::new(9.0, 9.0, 1.0));
        let (whole, part) = share(&polygon, right);
        assert!((whole - 3.0).abs() < 1e-12 && (part - 1.0).abs() < 1e-12);
    }

    #[test]
    fn points_of_curved_surfaces_stand_for_equal_areas() {
        let upper = Aabb::new(Vec3::new(-9.0, -9.0, 0.5), Vec3::splat(9.0));
        let sphere = Primitive::Sphere(Sphere::new(Vec3::ZERO, 1.0).unwrap());
        let (whole, part) = share(&sphere, upper);
        assert!((whole - 4.0 * PI).abs() < 1e-12);
        assert!((part / whole - 0.25).abs() < 2e-3);
        // The upper half of a cone's height has a quarter of its area.
        let cone = Cone::new(Vec3::ZERO, 1.0, Vec3::Z, 0.0).unwrap();
        let (whole, part) = share(&Primitive::Cone(cone), upper);
        assert!((whole - PI * 2f64.sqrt()).abs() < 1e-12);
        assert!((part / whole - 0.25).abs() < 2e-3);
        let cylinder = Cone::new(Vec3::ZERO, 2.0, Vec3::Z, 2.0).unwrap();
        let (whole, part) = share(&Primitive::Cone(cylinder), upper);
        assert!((whole - 4.0 * PI).abs() < 1e-12);
        assert!((part / whole - 0.5).abs() < 2e-3);
    }
}
