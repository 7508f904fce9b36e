//! All objects that a ray hits, for the depth complexity `D_COMPX`.

use super::space::{Space, SpaceRay, with_shapes};
use super::{LeafVisitor, Probe, Scratch};
use crate::geometry::Ray;
use crate::primitive::{Form, Shapes};
use crate::structure::Tree;

struct All<'a, F: Form> {
    ray: &'a F::Ray,
    t_max: f64,
    objects: &'a [F],
    found: &'a mut Vec<u32>,
}

impl<F: Form> LeafVisitor for All<'_, F> {
    fn visit<P: Probe>(&mut self, objects: &[u32], _: &mut P) -> f64 {
        for &object in objects {
            let shape = &self.objects[object as usize];
            if shape.intersect(self.ray, self.t_max).is_some() {
                self.found.push(object);
            }
        }
        self.t_max
    }
}

/// Finds the objects that a ray hits, each once and in ascending order. Overwrites `found`.
pub fn objects_on_ray(
    tree: &Tree,
    shapes: &Shapes,
    ray: &Ray,
    scratch: &mut Scratch,
    found: &mut Vec<u32>,
) {
    found.clear();
    with_shapes!(shapes, space, objects => {
        if let Some(ray) = space.transform(ray) {
            let [_, t_max] = ray.interval();
            let mut all = All { objects, ray: &ray, t_max, found };
            ray.traverse(tree, scratch, &mut all, &mut ());
        }
    });
    found.sort_unstable();
    found.dedup();
}
