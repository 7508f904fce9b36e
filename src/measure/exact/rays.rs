//! Rays at the limits of rounding.

use super::oracle::Oracle;
use crate::geometry::{Aabb, Ray, Vec3};
use crate::measure::judge::Surface;
use crate::measure::random::Random;
use crate::measure::verify::RaySample;
use crate::primitive::exact::ConeEnds;
use crate::primitive::{Precision, Primitive, Shape};
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::trace::Hit;

/// Where rays come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RaySource {
    /// Between random points around the scene.
    Random,
    /// Rays of all kinds of the picture.
    Picture,
    /// At vertices, tips and rims.
    Vertices,
    /// At points of edges.
    Edges,
    /// Along edges.
    AlongEdges,
    /// In the planes of faces, or within a few units of rounding of them.
    Planes,
    /// Tangent to spheres, cylinders and cones, as nearly as `f64` allows.
    Tangents,
    /// At points where two objects intersect, so that their distances nearly agree.
    Intersections,
    /// Starting on a surface: at a hit, or with its distance or a neighboring number as `t_min`.
    Starts,
    /// Ending on a surface: with the distance of a hit or a neighboring number as `t_max`.
    Ends,
}

impl RaySource {
    pub const ALL: [RaySource; 10] = [
        RaySource::Random,
        RaySource::Picture,
        RaySource::Vertices,
        RaySource::Edges,
        RaySource::AlongEdges,
        RaySource::Planes,
        RaySource::Tangents,
        RaySource::Intersections,
        RaySource::Starts,
        RaySource::Ends,
    ];

    /// Returns the name in reports.
    pub const fn name(self) -> &'static str {
        [
            "random",
            "picture",
            "at vertices",
            "at edges",
            "along edges",
            "in planes",
            "tangent",
            "at intersections",
            "starting on surfaces",
            "ending on surfaces",
        ][self as usize]
    }
}

/// Rays of all sources.
#[derive(Clone, Debug)]
pub struct ExactRays {
    rays: Vec<Ray>,
    sources: Vec<RaySource>,
}

impl ExactRays {
    /// Returns `count` rays of a scene, evenly distributed over the sources. Where a source has no ray, as
    /// tangents of triangles, one of another source takes its place. Those on surfaces are on the surfaces in the
    /// oracle's precision.
    ///
    /// # Errors
    /// Cancellation.
    pub fn new(
        scene: &Scene,
        sample: &RaySample,
        count: usize,
        oracle: &Oracle,
        pool: &rayon::ThreadPool,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let mut places = Places::new(scene);
        let of_picture = sample.rays.concat();
        let (mut rays, mut sources) = (Vec::new(), Vec::new());
        let derived = count / 5;
        for i in 0..count - derived {
            let source = RaySource::ALL[i % 8];
            let ray = match source {
                RaySource::Random => Some(places.random()),
                RaySource::Picture if of_picture.is_empty() => None,
                RaySource::Picture => Some(of_picture[i / 8 % of_picture.len()]),
                _ => places.ray(source),
            };
            let (source, ray) = match ray {
                Some(ray) => (source, ray),
                None => places.instead(),
            };
            rays.push(ray);
            sources.push(source);
        }
        // Derived rays need hits, which about half of the rays have.
        let tried = &rays[..rays.len().min(3 * derived)];
        let hits = oracle.closest_of_all(tried, pool, progress)?;
        let hit_rays: Vec<(Ray, Hit)> = std::iter::zip(tried.iter().copied(), hits)
            .filter(|(_, hit)| hit.is_hit())
            .collect();
        for i in 0..derived {
            let source = [RaySource::Starts, RaySource::Ends][i % 2];
            let (source, ray) = match hit_rays.get(i / 2 % hit_rays.len().max(1)) {
                Some(&(ray, hit)) => (source, on_surface(source, ray, hit.t, i / 2, oracle)),
                None => (RaySource::Random, places.random()),
            };
            rays.push(ray);
            sources.push(source);
        }
        Ok(ExactRays { rays, sources })
    }

    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// Returns where ray `i` comes from.
    ///
    /// # Panics
    /// If there is no such ray.
    pub fn source(&self, i: usize) -> RaySource {
        self.sources[i]
    }

    /// Returns the number of rays of each source.
    pub fn counts(&self) -> Vec<(RaySource, u64)> {
        let count = |source| self.sources.iter().filter(|s| **s == source).count() as u64;
        RaySource::ALL.map(|source| (source, count(source))).into()
    }
}

/// Returns a ray that starts or ends on the surface that another ray hits.
fn on_surface(source: RaySource, ray: Ray, t: f64, i: usize, oracle: &Oracle) -> Ray {
    let ends = match oracle.precision() {
        Precision::F64 => [t, t.next_up(), t.next_down()],
        // The frame's scale is a power of two, so neighbors there are neighbors here.
        Precision::F32 => {
            let near = t as f32;
            [t, f64::from(near.next_up()), f64::from(near.next_down())]
        }
    };
    let end = ends[i % ends.len()];
    match source {
        RaySource::Ends => Ray { t_max: end, ..ray },
        _ if i % 4 == 3 => Ray {
            origin: ray.at(t),
            ..ray
        },
        _ => Ray {
            t_min: end.max(0.0),
            ..ray
        },
    }
}

/// The objects of a scene as places to aim at.
struct Places<'a> {
    objects: &'a [Primitive],
    bounds: Aabb,
    random: Random,
}

impl<'a> Places<'a> {
    fn new(scene: &'a Scene) -> Self {
        let bounds = scene.bounds();
        let bounds = if bounds.is_empty() {
            Aabb::new(Vec3::ZERO, Vec3::ONE)
        } else {
            bounds
        };
        let margin = 0.25 * bounds.size().max_element() + f64::MIN_POSITIVE;
        Places {
            objects: scene.objects(),
            bounds: bounds.enlarged(margin),
            random: Random::new(1),
        }
    }

    /// Returns a point around the scene.
    fn point(&mut self) -> Vec3 {
        self.bounds.lo + self.bounds.size() * self.random.point()
    }

    fn random(&mut self) -> Ray {
        let from = self.point();
        let to = self.point();
        self.ray_through(from, to)
    }

    /// Returns a ray through a point, with a direction of any length or of length 1.
    fn ray_through(&mut self, from: Vec3, to: Vec3) -> Ray {
        let direction = if from == to { Vec3::X } else { to - from };
        let direction = match self.random.below(2) {
            0 => direction,
            _ => direction.normalize_or(Vec3::X),
        };
        Ray::new(from, direction)
    }

    /// Returns a ray from somewhere at a point. Some origins have as few bits as the point, so that the ray
    /// passes exactly through it.
    fn ray_at(&mut self, target: Vec3) -> Ray {
        const FEW_BITS: [f64; 7] = [-1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 1.0];
        let step = Vec3::from_array(std::array::from_fn(|_| self.random.pick(&FEW_BITS)));
        if self.random.below(3) == 0 && step != Vec3::ZERO {
            let size = self.bounds.size().max_element();
            let scale = libm::scalbn(1.0, libm::ilogb(size));
            return Ray::new(target - scale * step, step);
        }
        let from = self.point();
        self.ray_through(from, target)
    }

    /// Returns a ray of a source; `None` if a few random objects have none.
    fn ray(&mut self, source: RaySource) -> Option<Ray> {
        const TRIES: usize = 64;
        if self.objects.is_empty() {
            return None;
        }
        (0..TRIES).find_map(|_| {
            let i = self.random.below(self.objects.len());
            let surface = Surface::of(&self.objects[i]);
            match source {
                RaySource::Vertices => self.at_vertex(&surface),
                RaySource::Edges => {
                    let [a, b] = self.edge(&surface)?;
                    let share = [0.5, 0.25, self.random.number()];
                    let share = self.random.pick(&share);
                    Some(self.ray_at(a + share * (b - a)))
                }
                RaySource::AlongEdges => {
                    let [a, b] = self.edge(&surface)?;
                    let back = self.random.below(3) as f64;
                    (a != b).then(|| self.ray_through(a - back * (b - a), b))
                }
                RaySource::Planes => self.in_plane(&surface),
                RaySource::Tangents => self.tangent(&surface),
                RaySource::Intersections => self.at_intersection(i),
                _ => None,
            }
        })
    }

    /// Returns a ray in place of one that a source does not have.
    fn instead(&mut self) -> (RaySource, Ray) {
        let others = [RaySource::Tangents, RaySource::Vertices];
        let ray_of = |source| Some((source, self.ray(source)?));
        let other = others.into_iter().find_map(ray_of);
        other.unwrap_or_else(|| (RaySource::Random, self.random()))
    }

    fn at_vertex(&mut self, surface: &Surface) -> Option<Ray> {
        let target = match surface {
            Surface::Sphere { .. } => return None,
            Surface::Triangle(vertices) => self.random.pick(vertices),
            Surface::Polygon(vertices) => self.random.pick(vertices),
            Surface::Cone(cone) => self.on_rim(cone),
        };
        Some(self.ray_at(target))
    }

    /// Returns a point of the circle around an end of a cone.
    fn on_rim(&mut self, cone: &ConeEnds) -> Vec3 {
        let across = (cone.apex - cone.base).any_orthonormal_pair();
        let turn = std::f64::consts::TAU * self.random.number();
        let outward = libm::cos(turn) * across.0 + libm::sin(turn) * across.1;
        let ends = [(cone.base, cone.base_radius), (cone.apex, cone.apex_radius)];
        let (center, radius) = self.random.pick(&ends);
        center + radius * outward
    }

    fn edge(&mut self, surface: &Surface) -> Option<[Vec3; 2]> {
        let vertices: &[Vec3] = match surface {
            Surface::Triangle(vertices) => vertices,
            Surface::Polygon(vertices) => vertices,
            Surface::Sphere { .. } | Surface::Cone(_) => return None,
        };
        let i = self.random.below(vertices.len());
        Some([vertices[i], vertices[(i + 1) % vertices.len()]])
    }

    fn in_plane(&mut self, surface: &Surface) -> Option<Ray> {
        let [a, b] = self.edge(surface)?;
        let [c, d] = self.edge(surface)?;
        let numbers = [0.0, 1.0, -1.0, 2.0 * self.random.number() - 1.0];
        let weights = [self.random.pick(&numbers), self.random.pick(&numbers)];
        let mut direction = weights[0] * (b - a) + weights[1] * (d - c);
        if direction == Vec3::ZERO {
            direction = b - a;
        }
        let through = a + self.random.number() * (d - a);
        let origin = through - 2.0 * direction;
        // Off the plane by a few units of rounding.
        let k = self.random.below(3);
        for _ in 0..self.random.below(3) {
            direction[k] = direction[k].next_up();
        }
        (direction != Vec3::ZERO).then(|| Ray::new(origin, direction))
    }

    fn tangent(&mut self, surface: &Surface) -> Option<Ray> {
        let (mut point, normal) = match surface {
            Surface::Sphere { center, radius } => {
                let axes = [Vec3::X, -Vec3::Y, Vec3::Z, self.random.unit()];
                let normal = self.random.pick(&axes);
                (*center + *radius * normal, normal)
            }
            Surface::Cone(cone) => self.on_side(cone)?,
            Surface::Triangle(_) | Surface::Polygon(_) => return None,
        };
        let (e, f) = normal.any_orthonormal_pair();
        let turn = std::f64::consts::TAU * self.random.number();
        let directions = [e, f, libm::cos(turn) * e + libm::sin(turn) * f];
        let direction = self.random.pick(&directions);
        // To either side of the tangent by a few units of rounding.
        let size = normal.abs();
        let k = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j]))?;
        for _ in 0..self.random.below(3) {
            point[k] = point[k].next_up();
        }
        for _ in 0..self.random.below(3) {
            point[k] = point[k].next_down();
        }
        let back = self.bounds.size().max_element();
        Some(Ray::new(point - back * direction, direction))
    }

    /// Returns a point of the side of a cone, and the normal there.
    fn on_side(&mut self, cone: &ConeEnds) -> Option<(Vec3, Vec3)> {
        let axis = cone.apex - cone.base;
        let (e, f) = axis.try_normalize()?.any_orthonormal_pair();
        let turns = [0.0, 0.25, 0.5, self.random.number()];
        let turn = std::f64::consts::TAU * self.random.pick(&turns);
        let outward = libm::cos(turn) * e + libm::sin(turn) * f;
        let growth = cone.apex_radius - cone.base_radius;
        let share = self.random.number();
        let normal = outward - growth / axis.length_squared() * axis;
        let radius = cone.base_radius + share * growth;
        Some((
            cone.base + share * axis + radius * outward,
            normal.try_normalize()?,
        ))
    }

    /// Returns a ray at a point where an object and one of its neighbors in the list intersect.
    fn at_intersection(&mut self, i: usize) -> Option<Ray> {
        let near = (i + 1 + self.random.below(4)) % self.objects.len();
        let anywhere = self.random.below(self.objects.len());
        let other = self.random.pick(&[near, anywhere]);
        let (a, b) = (self.point_of(i)?, self.point_of(i)?);
        // Where the segment between two points of the object meets the other.
        let segment = Ray::new(a, b - a);
        let t = (i != other && a != b)
            .then(|| self.objects[other].intersect(&segment, 1.0))
            .flatten()?;
        Some(self.ray_at(segment.at(t)))
    }

    /// Returns a point of a surface, or of the plane of one.
    fn point_of(&mut self, i: usize) -> Option<Vec3> {
        match Surface::of(&self.objects[i]) {
            Surface::Sphere { center, radius } => Some(center + radius * self.random.unit()),
            Surface::Cone(cone) => Some(self.on_side(&cone)?.0),
            surface => {
                let [a, b] = self.edge(&surface)?;
                let [c, _] = self.edge(&surface)?;
                let on_edge = a + self.random.number() * (b - a);
                Some(on_edge + self.random.number() * (c - on_edge))
            }
        }
    }
}
