//! Blocks of spheres, by center and radius.

use super::block::{BlockData, NONE};
use crate::primitive::{PackedSphere, Primitive, UnitFrame};

/// A block of spheres.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Spheres<const N: usize> {
    pub(crate) center: [[f32; N]; 3],
    pub(crate) radius: [f32; N],
    pub(crate) objects: [u32; N],
}

impl<const N: usize> Default for Spheres<N> {
    fn default() -> Self {
        Spheres {
            center: [[f32::NAN; N]; 3],
            radius: [f32::NAN; N],
            objects: [NONE; N],
        }
    }
}

impl<const N: usize> Spheres<N> {
    /// Returns the sphere in a place.
    #[inline(always)]
    pub(crate) fn sphere(&self, place: usize) -> PackedSphere {
        let [x, y, z] = &self.center;
        let center = [x[place], y[place], z[place]].into();
        PackedSphere::from_center(center, self.radius[place])
    }
}

impl<const N: usize> BlockData for Spheres<N> {
    const PLACES: usize = N;

    fn set(&mut self, place: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let Primitive::Sphere(sphere) = primitive else {
            unreachable!("all objects are spheres");
        };
        let center = frame.point(sphere.center).as_vec3();
        for k in 0..3 {
            self.center[k][place] = center[k];
        }
        self.radius[place] = (sphere.radius * frame.scale()) as f32;
        self.objects[place] = object;
    }

    fn objects(&self) -> &[u32] {
        &self.objects
    }
}
