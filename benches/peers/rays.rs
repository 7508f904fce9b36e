//! The five sets of rays. All coordinates are representable as `f32`.

use super::scenes::Subject;
use bspscope::geometry::{Ray, Vec3};
use bspscope::primitive::Shape;
use bspscope::trace::Hit;

/// Rays of one kind.
pub struct RaySet {
    /// One letter, for tables.
    pub letter: char,
    pub name: &'static str,
    pub rays: Vec<Ray>,
    /// Whether the query is for any hit instead of the closest.
    pub any: bool,
}

/// Letters and names of all sets.
const SETS: [(char, &str); 5] = [
    ('P', "primary"),
    ('D', "diffuse"),
    ('C', "chord"),
    ('S', "shadow"),
    ('A', "ambient"),
];

/// Pseudo-random numbers: xorshift64* (S. Vigna, 2016).
struct Random(u64);

impl Random {
    /// Returns a number from 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a uniformly distributed direction.
    fn direction(&mut self) -> Vec3 {
        let z = 1.0 - 2.0 * self.next();
        let angle = std::f64::consts::TAU * self.next();
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * angle.cos(), r * angle.sin(), z)
    }
}

fn ray(origin: Vec3, direction: Vec3, end: f64) -> Ray {
    let [origin, direction] = [origin, direction.normalize()].map(|v| v.as_vec3().as_dvec3());
    Ray::to(origin, direction, f64::from(end as f32))
}

/// Returns the sets for images of `size` × `size` pixels. `closest` computes closest hits.
pub fn ray_sets(subject: &Subject, size: u32, closest: impl Fn(&[Ray]) -> Vec<Hit>) -> Vec<RaySet> {
    let scene = &subject.scene;
    let bounds = scene.bounds();
    let (center, radius) = (bounds.center(), bounds.size().length() * 0.5);
    let mut random = Random(0x0123_4567);
    let chord = |random: &mut Random| {
        let [a, b] = [(); 2].map(|()| center + radius * random.direction());
        ray(a, b - a, f64::INFINITY)
    };
    let view = scene
        .camera()
        .view(size, size, bspscope::scene::Sampling::Center)
        .expect("the camera has a view");
    // In tiles of 4 × 4 pixels, for packet kernels.
    let primary: Vec<Ray> = (0..size * size)
        .map(|i| {
            let (tile, k) = (i / 16, i % 16);
            let (x, y) = (tile % (size / 4) * 4 + k % 4, tile / (size / 4) * 4 + k / 4);
            let r = view.primary_ray(x, y, 0);
            ray(r.origin, r.direction, f64::INFINITY)
        })
        .collect();
    let (mut diffuse, mut shadow, mut ambient) = (Vec::new(), Vec::new(), Vec::new());
    for (r, hit) in primary.iter().zip(closest(&primary)) {
        if !hit.is_hit() {
            diffuse.push(chord(&mut random));
            continue;
        }
        let surface = scene.objects()[hit.object as usize].surface(r, hit.t);
        let away = surface.normal.dot(r.direction) > 0.0;
        let normal = if away {
            -surface.normal
        } else {
            surface.normal
        };
        let point = surface.point + 2e-5 * radius * normal;
        let mut around_normal = || normal + 0.999 * random.direction();
        diffuse.push(ray(point, around_normal(), f64::INFINITY));
        ambient.push(ray(point, around_normal(), radius * 0.2));
        let to_light = subject.light + 0.02 * radius * random.direction() - point;
        shadow.push(ray(point, to_light, to_light.length()));
    }
    let chords = primary.iter().map(|_| chord(&mut random)).collect();
    let rays = [primary, diffuse, chords, shadow, ambient];
    SETS.into_iter()
        .zip(rays)
        .map(|((letter, name), rays)| RaySet {
            letter,
            name,
            rays,
            any: matches!(letter, 'S' | 'A'),
        })
        .collect()
}
