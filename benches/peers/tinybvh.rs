//! tinybvh, if the environment variable `TINYBVH` names the library that `tinybvh.cpp` makes.

use super::crates::triangles;
use super::kernels::{Found, Kernel, NarrowRay, Rays};
use bspscope::scene::Scene;
use libloading::Library;
use std::ffi::c_void;

/// Its tree for processors with eight lanes, built with spatial splits.
pub struct TinyBvh {
    library: Library,
    tree: *const c_void,
    /// The tree refers to them.
    _vertices: Vec<[f32; 4]>,
}

// SAFETY: the functions for tracing do not change the tree.
unsafe impl Sync for TinyBvh {}

impl TinyBvh {
    /// Returns `None` if there is no library, or for a scene of other objects than triangles.
    pub fn new(scene: &Scene) -> Option<TinyBvh> {
        let path = std::env::var_os("TINYBVH")?;
        let corners = triangles(scene)?.into_iter().flatten();
        let vertices: Vec<[f32; 4]> = corners.map(|[x, y, z]| [x, y, z, 0.0]).collect();
        // SAFETY: the functions are those of tinybvh.cpp.
        unsafe {
            type Build = extern "C" fn(*const [f32; 4], u32) -> *const c_void;
            let library = Library::new(path).expect("TINYBVH is a library");
            let build = library.get::<Build>(b"tinybvh_build").expect("a function");
            let tree = build(vertices.as_ptr(), (vertices.len() / 3) as u32);
            Some(TinyBvh {
                tree,
                _vertices: vertices,
                library,
            })
        }
    }
}

impl Kernel for TinyBvh {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>) {
        let rays = rays.narrow;
        let (mut t, mut triangle) = (vec![0.0_f32; rays.len()], vec![0_u32; rays.len()]);
        // SAFETY: as above; both vectors have room for the answers.
        unsafe {
            type Closest =
                extern "C" fn(*const c_void, *const NarrowRay, usize, *mut f32, *mut u32);
            let closest = self.library.get::<Closest>(b"tinybvh_closest");
            closest.expect("a function")(
                self.tree,
                rays.as_ptr(),
                rays.len(),
                t.as_mut_ptr(),
                triangle.as_mut_ptr(),
            );
        }
        let hits = t.into_iter().zip(triangle);
        found.extend(hits.map(|(t, k)| (k != u32::MAX).then_some((f64::from(t), k))));
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        let rays = rays.narrow;
        let first = blocked.len();
        blocked.resize(first + rays.len(), false);
        // SAFETY: as above.
        unsafe {
            type Any = extern "C" fn(*const c_void, *const NarrowRay, usize, *mut bool);
            let any = self.library.get::<Any>(b"tinybvh_any");
            let answers = blocked[first..].as_mut_ptr();
            any.expect("a function")(self.tree, rays.as_ptr(), rays.len(), answers);
        }
    }
}
