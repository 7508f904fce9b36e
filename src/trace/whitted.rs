//! Whitted ray tracing with the shading of NFF, in wavefronts: all rays of one kind and depth of a set
//! of pixels are one batch.
//!
//! T. Whitted, An improved illumination model for shaded display, 1980. Shading takes place on the side
//! of the surface that the ray comes from. Every light on this side gets a shadow ray. The reflected ray
//! has the weight `Ks`. A transparent surface also reflects the part of `T` given by Schlick's
//! approximation of Fresnel's law (1994), and refracts the rest by Snell's law. On total internal
//! reflection it reflects all of `T`.

use super::{Batch, Hit, RayKind, RayTracer, RenderError, RenderSettings};
use crate::geometry::{Ray, Vec3};
use crate::primitive::{Shape, Shapes, SurfacePoint};
use crate::scene::{Material, Scene, View};

/// Rays of one kind, with the pixel that each contributes to and its weight.
#[derive(Default)]
struct Wave {
    rays: Vec<Ray>,
    pixels: Vec<u32>,
    weights: Vec<Vec3>,
}

impl Wave {
    fn push(&mut self, ray: Ray, pixel: u32, weight: Vec3) {
        self.rays.push(ray);
        self.pixels.push(pixel);
        self.weights.push(weight);
    }

    fn batch(&self, kind: RayKind) -> Batch<'_> {
        Batch {
            kind,
            rays: &self.rays,
            pixels: &self.pixels,
        }
    }

    fn clear(&mut self) {
        self.rays.clear();
        self.pixels.clear();
        self.weights.clear();
    }
}

/// Everything that determines the color of a sample.
#[derive(Clone, Copy)]
pub struct Shading<'a> {
    pub scene: &'a Scene,
    pub shapes: &'a Shapes,
    pub view: View,
    /// Maximum depth of secondary rays.
    secondary_depth: u32,
    min_contribution: f64,
}

impl<'a> Shading<'a> {
    /// # Errors
    /// A camera without a view or a resolution out of range.
    pub fn new(scene: &'a Scene, settings: &RenderSettings) -> Result<Self, RenderError> {
        let view = settings.view(scene)?;
        Ok(Shading {
            scene,
            shapes: scene.shapes(settings.precision_for(scene).precision),
            view,
            secondary_depth: scene.requirements().secondary_depth(settings.d_arec),
            min_contribution: settings.min_contribution,
        })
    }
}

/// Traces sample number `sample` of the given pixels. Overwrites `colors` with their linear colors.
pub fn trace_samples<T: RayTracer>(
    shading: &Shading<'_>,
    pixels: &[(u32, u32)],
    sample: u32,
    tracer: &mut T,
    colors: &mut Vec<Vec3>,
) {
    colors.clear();
    colors.resize(pixels.len(), Vec3::ZERO);
    let mut now = [RayKind::Primary, RayKind::Reflected, RayKind::Refracted]
        .map(|kind| (kind, Wave::default()));
    let mut next_reflected = Wave::default();
    let mut next_refracted = Wave::default();
    let mut shadow = Wave::default();
    let (mut hits, mut blocked) = (Vec::new(), Vec::new());

    for (i, &(x, y)) in pixels.iter().enumerate() {
        now[0]
            .1
            .push(shading.view.primary_ray(x, y, sample), i as u32, Vec3::ONE);
    }
    for depth in 0..=shading.secondary_depth {
        for (kind, wave) in &mut now {
            if wave.rays.is_empty() {
                continue;
            }
            tracer.closest_hits(wave.batch(*kind), &mut hits);
            for (i, hit) in hits.iter().enumerate() {
                let (ray, pixel, weight) = (&wave.rays[i], wave.pixels[i], wave.weights[i]);
                if !hit.is_hit() {
                    colors[pixel as usize] += weight * shading.scene.background();
                    continue;
                }
                spawn(shading, ray, hit, weight, depth, |kind, ray, weight| {
                    let wave = match kind {
                        RayKind::Shadow => &mut shadow,
                        RayKind::Reflected => &mut next_reflected,
                        RayKind::Refracted | RayKind::Primary => &mut next_refracted,
                    };
                    wave.push(ray, pixel, weight);
                });
            }
            if !shadow.rays.is_empty() {
                tracer.any_hits(shadow.batch(RayKind::Shadow), &mut blocked);
                for (i, _) in blocked.iter().enumerate().filter(|(_, blocked)| !**blocked) {
                    colors[shadow.pixels[i] as usize] += shadow.weights[i];
                }
                shadow.clear();
            }
            wave.clear();
        }
        std::mem::swap(&mut now[1].1, &mut next_reflected);
        std::mem::swap(&mut now[2].1, &mut next_refracted);
    }
}

/// Calls `child` for every ray that a hit after `depth` bounces spawns, with its kind and its weight in the
/// pixel (for a shadow ray: that of the light if it is not blocked). Spawns no ray of weight 0, and no
/// secondary ray that is too deep or below the minimum contribution.
pub(super) fn spawn(
    shading: &Shading<'_>,
    ray: &Ray,
    hit: &Hit,
    weight: Vec3,
    depth: u32,
    mut child: impl FnMut(RayKind, Ray, Vec3),
) {
    let scene = shading.scene;
    let mut emit = |kind, ray, weight: Vec3| {
        let minimum = if kind == RayKind::Shadow {
            0.0
        } else {
            shading.min_contribution
        };
        let largest = weight.max_element();
        if largest > 0.0 && largest >= minimum {
            child(kind, ray, weight);
        }
    };
    let material = scene.material(hit.object);
    let surface = scene.objects()[hit.object as usize].surface(ray, hit.t);
    let rounding = shading.shapes.rounding(hit.object);
    let surface = Facing::new(surface, rounding, ray.direction);
    if scene.requirements().casts_shadows {
        let white = Vec3::splat(1.0 / (scene.lights().len() as f64).sqrt());
        for light in scene.lights() {
            let lit = surface.lit_by(light.position, material, ray.direction);
            if let Some((ray, reflected)) = lit {
                let light = light.color.unwrap_or(white);
                emit(RayKind::Shadow, ray, weight * light * reflected);
            }
        }
    }
    if depth < shading.secondary_depth {
        let [reflected, refracted] = surface.secondary(material, ray.direction);
        if let Some((ray, share)) = reflected {
            emit(RayKind::Reflected, ray, weight * share);
        }
        if let Some((ray, share)) = refracted {
            emit(RayKind::Refracted, ray, weight * share);
        }
    }
}

/// A point of a surface, oriented to the side that a ray comes from.
struct Facing {
    point: Vec3,
    /// Geometric unit normal on the side of the ray.
    side: Vec3,
    /// Unit normal for shading on the side of the ray.
    normal: Vec3,
    /// Whether the ray comes from the side of the primitive's own normal.
    entering: bool,
    /// Distance from the point at which a ray must start to be clear of the surface.
    clear: f64,
}

impl Facing {
    /// `rounding` is that of the object ([`Shapes::rounding`]).
    fn new(surface: SurfacePoint, rounding: f64, direction: Vec3) -> Self {
        let entering = surface.normal.dot(direction) < 0.0;
        let turn = if entering { 1.0 } else { -1.0 };
        let side = surface.normal * turn;
        let normal = surface.shading_normal * turn;
        // Twice the error of the point, the rounding of adding the offset, and twice the rounding of the
        // packed object. These depend on the point, not on the size of the scene.
        let clear = 2.0 * surface.error
            + 8.0 * f64::EPSILON * surface.point.abs().max_element()
            + 2.0 * rounding;
        Facing {
            point: surface.point,
            side,
            // An interpolated normal may face away from the ray; then the geometric one is used.
            normal: if normal.dot(direction) < 0.0 {
                normal
            } else {
                side
            },
            entering,
            clear,
        }
    }

    /// Returns the shadow ray to a light on this side, and the share of its light that is reflected
    /// towards the origin of the ray.
    fn lit_by(&self, light: Vec3, material: &Material, direction: Vec3) -> Option<(Ray, Vec3)> {
        let origin = self.point + self.side * self.clear;
        let to_light = light - origin;
        let distance = to_light.length();
        let to_light = to_light / distance;
        let cosine = self.normal.dot(to_light);
        if !(cosine > 0.0 && self.side.dot(to_light) > 0.0) {
            return None;
        }
        let mut reflected = material.color * (material.diffuse * cosine);
        if material.specular > 0.0 {
            let mirrored = direction - 2.0 * direction.dot(self.normal) * self.normal;
            let highlight = mirrored.dot(to_light).max(0.0);
            reflected += material.specular * libm::pow(highlight, material.shine);
        }
        let end = distance * (1.0 - 8.0 * f64::EPSILON);
        Some((Ray::to(origin, to_light, end), reflected))
    }

    /// Returns the reflected and the refracted ray, each with the weight of its radiance.
    fn secondary(&self, material: &Material, direction: Vec3) -> [Option<(Ray, f64)>; 2] {
        if !(material.specular > 0.0 || material.transmittance > 0.0) {
            return [None, None];
        }
        let cosine = -direction.dot(self.normal);
        let mut mirrored = direction + 2.0 * cosine * self.normal;
        if mirrored.dot(self.side) <= 0.0 {
            mirrored = direction - 2.0 * direction.dot(self.side) * self.side;
        }
        let start = |towards: f64| self.point + self.side * (towards * self.clear);
        let (mut reflects, mut refracted) = (material.specular, None);
        if material.transmittance > 0.0 {
            let index = material.index_of_refraction;
            let ratio = if self.entering { 1.0 / index } else { index };
            let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
            if squared > 0.0 {
                let inner_cosine = squared.sqrt();
                let transmitted = ratio * direction + (ratio * cosine - inner_cosine) * self.normal;
                let mirrors = schlick(index, cosine.min(inner_cosine));
                reflects += material.transmittance * mirrors;
                refracted = Some((
                    Ray::new(start(-1.0), transmitted.normalize()),
                    material.transmittance * (1.0 - mirrors),
                ));
            } else {
                reflects += material.transmittance;
            }
        }
        let reflected = Ray::new(start(1.0), mirrored.normalize());
        [Some((reflected, reflects)), refracted]
    }
}

/// Returns the share of light that a boundary between media reflects, given the cosine on the side of the
/// optically thinner medium.
fn schlick(index: f64, cosine: f64) -> f64 {
    let normal = ((index - 1.0) / (index + 1.0)).powi(2);
    normal + (1.0 - normal) * (1.0 - cosine).max(0.0).powi(5)
}
