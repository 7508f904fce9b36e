//! Every object along a ray, for the depth complexity `D_COMPX`.

use super::shapes::{Objects, with_objects};
use super::{LeafVisitor, Probe, Scratch, Shapes, traverse};
use crate::geometry::Ray;
use crate::tree::Tree;

struct All<'a, O: ?Sized> {
    objects: &'a O,
    found: &'a mut Vec<u32>,
}

impl<O: Objects + ?Sized> LeafVisitor for All<'_, O> {
    fn visit<P: Probe>(&mut self, ray: &Ray, objects: &[u32], _: &mut P) -> f64 {
        for &object in objects {
            if self.objects.intersect(object, ray, ray.t_max).is_some() {
                self.found.push(object);
            }
        }
        ray.t_max
    }
}

/// The objects that a ray meets, each once and in ascending order; `found` is overwritten.
pub fn objects_along(
    tree: &Tree,
    shapes: &Shapes<'_>,
    ray: &Ray,
    scratch: &mut Scratch,
    found: &mut Vec<u32>,
) {
    found.clear();
    with_objects!(shapes, objects => {
        traverse(tree, ray, scratch, &mut All { objects, found }, &mut ());
    });
    found.sort_unstable();
    found.dedup();
}
