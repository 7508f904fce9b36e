//! The two best-known trees for ray casting on crates.io: obvhs and parry3d.

use super::kernels::{Found, Kernel, NarrowRay, Rays};
use bspscope::primitive::Primitive;
use bspscope::scene::Scene;
use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::{build_cwbvh, build_cwbvh_from_tris};
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use parry3d::math::Vector;
use parry3d::query::RayCast;
use parry3d::shape::TriMesh;
use std::time::Duration;

/// Returns the vertices of all triangles; `None` if there are other objects.
pub fn triangles(scene: &Scene) -> Option<Vec<[[f32; 3]; 3]>> {
    let vertices = |object: &Primitive| match object {
        Primitive::Triangle(t) => Some(t.vertices.map(|v| v.as_vec3().to_array())),
        _ => None,
    };
    scene.objects().iter().map(vertices).collect()
}

fn spheres(scene: &Scene) -> Option<Vec<(Vec3A, f32)>> {
    let sphere = |object: &Primitive| match object {
        Primitive::Sphere(s) => Some((s.center.as_vec3a(), s.radius as f32)),
        _ => None,
    };
    scene.objects().iter().map(sphere).collect()
}

/// The eight-wide compressed tree of obvhs, built at its highest quality.
pub struct Obvhs {
    tree: CwBvh,
    objects: ObvhsObjects,
}

enum ObvhsObjects {
    Triangles(Vec<Triangle>),
    Spheres(Vec<(Vec3A, f32)>),
}

impl Obvhs {
    pub fn new(scene: &Scene) -> Option<Obvhs> {
        let params = BvhBuildParams::very_slow_build();
        let mut time = Duration::ZERO;
        if let Some(spheres) = spheres(scene) {
            let boxes: Vec<Aabb> = spheres
                .iter()
                .map(|&(center, radius)| Aabb {
                    min: center - radius,
                    max: center + radius,
                })
                .collect();
            let tree = build_cwbvh(&boxes, params, &mut time);
            let objects = tree.primitive_indices.iter();
            let objects = objects.map(|&i| spheres[i as usize]).collect();
            return Some(Obvhs {
                tree,
                objects: ObvhsObjects::Spheres(objects),
            });
        }
        let triangles: Vec<Triangle> = triangles(scene)?
            .into_iter()
            .map(|[v0, v1, v2]| Triangle {
                v0: v0.into(),
                v1: v1.into(),
                v2: v2.into(),
            })
            .collect();
        let tree = build_cwbvh_from_tris(&triangles, params, &mut time);
        let objects = tree.primitive_indices.iter();
        let objects = objects.map(|&i| triangles[i as usize]).collect();
        Some(Obvhs {
            tree,
            objects: ObvhsObjects::Triangles(objects),
        })
    }

    fn ask(&self, rays: &[NarrowRay], mut ask: impl FnMut(Ray, &dyn Fn(&Ray, usize) -> f32)) {
        for ray in rays {
            let ray = Ray::new(
                ray.origin.into(),
                ray.direction.into(),
                ray.t_min,
                ray.t_max.min(f32::MAX),
            );
            match &self.objects {
                ObvhsObjects::Triangles(t) => ask(ray, &|ray, i| t[i].intersect(ray)),
                ObvhsObjects::Spheres(s) => ask(ray, &|ray, i| sphere_hit(s[i], ray)),
            }
        }
    }
}

/// Returns the distance to a sphere along a ray of unit direction; infinite for a miss.
fn sphere_hit((center, radius): (Vec3A, f32), ray: &Ray) -> f32 {
    let to_center = center - ray.origin;
    let along = to_center.dot(ray.direction);
    let offset = to_center - along * ray.direction;
    let square = radius * radius - offset.length_squared();
    if square < 0.0 {
        return f32::INFINITY;
    }
    let half = square.sqrt();
    let reached = [along - half, along + half]
        .into_iter()
        .find(|t| ray.tmin <= *t && *t <= ray.tmax);
    reached.unwrap_or(f32::INFINITY)
}

impl Kernel for Obvhs {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>) {
        self.ask(rays.narrow, |ray, test| {
            let mut hit = RayHit::none();
            let is_hit = self.tree.ray_traverse(ray, &mut hit, test);
            let object = || self.tree.primitive_indices[hit.primitive_id as usize];
            found.push(is_hit.then(|| (f64::from(hit.t), object())));
        });
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        self.ask(rays.narrow, |ray, test| {
            blocked.push(!self.tree.ray_traverse_miss(ray, test));
        });
    }
}

/// parry3d's mesh of triangles. It has no query for any hit, so this queries the closest.
pub struct Parry(TriMesh);

impl Parry {
    pub fn new(scene: &Scene) -> Option<Parry> {
        let triangles = triangles(scene)?;
        let vertices: Vec<Vector> = triangles.iter().flatten().map(|&v| v.into()).collect();
        let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        TriMesh::new(vertices, indices.collect()).ok().map(Parry)
    }
}

impl Kernel for Parry {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>) {
        for ray in rays.narrow {
            let parry = parry3d::query::Ray::new(ray.origin.into(), ray.direction.into());
            let mesh = parry3d::shape::CompositeShapeRef(&self.0);
            let hit = mesh.cast_local_ray(&parry, ray.t_max.min(f32::MAX), false);
            found.push(hit.map(|(object, t)| (f64::from(t), object)));
        }
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        for ray in rays.narrow {
            let parry = parry3d::query::Ray::new(ray.origin.into(), ray.direction.into());
            let hit = self
                .0
                .cast_local_ray(&parry, ray.t_max.min(f32::MAX), false);
            blocked.push(hit.is_some());
        }
    }
}
