//! Embree 3 or 4, loaded if it is installed: its kernels for single rays and for packets.

use super::kernels::{Found, Kernel, NarrowRay, Rays};
use bspscope::primitive::Primitive;
use bspscope::scene::Scene;
use libloading::Library;
use std::ffi::{c_int, c_void};
use std::mem::ManuallyDrop;
use std::sync::Arc;

type Handle = *mut c_void;

/// `RTCRayHit`, with the alignment that Embree requires and room for the instance identifiers of any build.
#[repr(C, align(16))]
struct RayHit {
    origin: [f32; 3],
    near: f32,
    direction: [f32; 3],
    time: f32,
    far: f32,
    mask: u32,
    id: u32,
    flags: u32,
    normal: [f32; 3],
    u: f32,
    v: f32,
    primitive: u32,
    geometry: u32,
    instances: [u32; 9],
}

/// `RTCIntersectContext` of Embree 3: no flags (incoherent), no filter, no instance.
#[repr(C, align(64))]
struct Context {
    flags: u32,
    filter: usize,
    instances: [u32; 12],
}

pub struct Embree {
    /// Never unloaded: Embree's threads may still run in it.
    library: ManuallyDrop<Library>,
    version: u32,
    device: Handle,
    scene: Handle,
}

// SAFETY: committed scenes of Embree may be used and released from any thread.
unsafe impl Send for Embree {}
// SAFETY: as above.
unsafe impl Sync for Embree {}

/// Names under which the dynamic linker may know Embree, with the version.
const NAMES: [(&str, u32); 4] = [
    ("libembree4.so.4", 4),
    ("libembree4.so", 4),
    ("libembree3.so.3", 3),
    ("libembree3.so", 3),
];

impl Embree {
    /// Builds Embree's tree of a scene of triangles or spheres, with default settings; `None` if Embree is
    /// not installed.
    pub fn new(scene: &Scene, threads: usize) -> Option<Embree> {
        let (library, version) = NAMES.into_iter().find_map(|(name, version)| {
            // SAFETY: Embree's initializers have no preconditions.
            let library = unsafe { Library::new(name) }.ok()?;
            Some((library, version))
        })?;
        // SAFETY: the types below are those of Embree's headers, the same in versions 3 and 4.
        unsafe {
            macro_rules! call {
                ($name:literal($($argument:expr),*) as $type:ty) => {
                    library.get::<$type>($name).ok()?($($argument),*)
                };
            }
            let config = format!("threads={threads}\0");
            let device =
                call!(b"rtcNewDevice"(config.as_ptr()) as extern "C" fn(*const u8) -> Handle);
            let handle = call!(b"rtcNewScene"(device) as extern "C" fn(Handle) -> Handle);
            type NewGeometry = extern "C" fn(Handle, c_int) -> Handle;
            type NewBuffer = extern "C" fn(Handle, c_int, u32, c_int, usize, usize) -> *mut c_void;
            const INDEX: c_int = 0;
            const VERTEX: c_int = 1;
            const UINT3: c_int = 0x5003;
            const FLOAT3: c_int = 0x9003;
            const FLOAT4: c_int = 0x9004;
            let count = scene.objects().len();
            let spheres = matches!(scene.objects().first(), Some(Primitive::Sphere(_)));
            let kind = if spheres { 50 } else { 0 };
            let geometry = call!(b"rtcNewGeometry"(device, kind) as NewGeometry);
            if spheres {
                let vertices = call!(b"rtcSetNewGeometryBuffer"(
                    geometry, VERTEX, 0, FLOAT4, 16, count
                ) as NewBuffer);
                let vertices = std::slice::from_raw_parts_mut(vertices.cast::<[f32; 4]>(), count);
                for (vertex, object) in vertices.iter_mut().zip(scene.objects()) {
                    let Primitive::Sphere(s) = object else {
                        return None;
                    };
                    *vertex = s.center.extend(s.radius).as_vec4().to_array();
                }
            } else {
                let vertices =
                    call!(
                        b"rtcSetNewGeometryBuffer"(geometry, VERTEX, 0, FLOAT3, 12, 3 * count)
                            as NewBuffer
                    );
                let vertices =
                    std::slice::from_raw_parts_mut(vertices.cast::<[[f32; 3]; 3]>(), count);
                for (vertices, object) in vertices.iter_mut().zip(scene.objects()) {
                    let Primitive::Triangle(t) = object else {
                        return None;
                    };
                    *vertices = t.vertices.map(|v| v.as_vec3().to_array());
                }
                let indices = call!(
                    b"rtcSetNewGeometryBuffer"(geometry, INDEX, 0, UINT3, 12, count) as NewBuffer
                );
                let indices = std::slice::from_raw_parts_mut(indices.cast::<u32>(), 3 * count);
                for (place, index) in (0..).zip(indices) {
                    *index = place;
                }
            }
            call!(b"rtcCommitGeometry"(geometry) as extern "C" fn(Handle));
            call!(b"rtcAttachGeometry"(handle, geometry) as extern "C" fn(Handle, Handle) -> u32);
            call!(b"rtcReleaseGeometry"(geometry) as extern "C" fn(Handle));
            call!(b"rtcCommitScene"(handle) as extern "C" fn(Handle));
            Some(Embree {
                library: ManuallyDrop::new(library),
                version,
                device,
                scene: handle,
            })
        }
    }

    fn ask(&self, name: &[u8], rays: &[NarrowRay], mut found: impl FnMut(&RayHit)) {
        let mut context = Context {
            flags: 0,
            filter: 0,
            instances: [u32::MAX; 12],
        };
        // SAFETY: the types are those of Embree's headers for each version.
        unsafe {
            type Ask3 = extern "C" fn(Handle, *mut Context, *mut RayHit);
            type Ask4 = extern "C" fn(Handle, *mut RayHit, *const c_void);
            let ask3 = self.library.get::<Ask3>(name);
            let ask4 = self.library.get::<Ask4>(name);
            for ray in rays {
                let mut hit = RayHit {
                    origin: ray.origin,
                    near: ray.t_min,
                    direction: ray.direction,
                    time: 0.0,
                    far: ray.t_max,
                    mask: u32::MAX,
                    id: 0,
                    flags: 0,
                    normal: [0.0; 3],
                    u: 0.0,
                    v: 0.0,
                    primitive: u32::MAX,
                    geometry: u32::MAX,
                    instances: [u32::MAX; 9],
                };
                match (self.version, &ask3, &ask4) {
                    (3, Ok(ask), _) => ask(self.scene, &mut context, &mut hit),
                    (_, _, Ok(ask)) => ask(self.scene, &mut hit, std::ptr::null()),
                    _ => panic!("Embree lacks a function"),
                }
                found(&hit);
            }
        }
    }
}

impl Kernel for Arc<Embree> {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>) {
        self.ask(b"rtcIntersect1", rays.narrow, |hit| {
            let is_hit = hit.geometry != u32::MAX;
            found.push(is_hit.then_some((f64::from(hit.far), hit.primitive)));
        });
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        // Embree sets the end of a blocked ray to −∞.
        self.ask(b"rtcOccluded1", rays.narrow, |hit| {
            blocked.push(hit.far < 0.0)
        });
    }
}

/// `RTCRayHit8` or `RTCRayHit16`, with room for the instance identifiers of any build.
#[repr(C, align(64))]
struct PacketHit<const N: usize> {
    origin: [[f32; N]; 3],
    near: [f32; N],
    direction: [[f32; N]; 3],
    time: [f32; N],
    far: [f32; N],
    mask: [u32; N],
    id: [u32; N],
    flags: [u32; N],
    normal: [[f32; N]; 3],
    u: [f32; N],
    v: [f32; N],
    primitive: [u32; N],
    geometry: [u32; N],
    instances: [[u32; N]; 9],
}

/// Which rays of a packet there are, with the alignment that Embree requires.
#[repr(C, align(64))]
struct Valid<const N: usize>([c_int; N]);

/// Embree's kernels for packets of 8 or 16 rays: rays of a set in their order.
pub struct Packets<const N: usize>(pub Arc<Embree>);

impl<const N: usize> Packets<N> {
    fn ask(&self, name: &str, rays: &[NarrowRay], mut found: impl FnMut(&PacketHit<N>, usize)) {
        let embree = &*self.0;
        let name = format!("{name}{N}");
        let mut context = Context {
            // Version 3: the rays are coherent, or the packet is traced ray by ray.
            flags: 1,
            filter: 0,
            instances: [u32::MAX; 12],
        };
        // SAFETY: the types are those of Embree's headers for each version.
        unsafe {
            type Ask3<const N: usize> =
                extern "C" fn(*const Valid<N>, Handle, *mut Context, *mut PacketHit<N>);
            type Ask4<const N: usize> =
                extern "C" fn(*const Valid<N>, Handle, *mut PacketHit<N>, *const c_void);
            let ask3 = embree.library.get::<Ask3<N>>(name.as_bytes());
            let ask4 = embree.library.get::<Ask4<N>>(name.as_bytes());
            for rays in rays.chunks(N) {
                let mut valid = Valid([0; N]);
                let mut hit = PacketHit::<N> {
                    origin: [[0.0; N]; 3],
                    near: [0.0; N],
                    direction: [[1.0; N]; 3],
                    time: [0.0; N],
                    far: [-1.0; N],
                    mask: [u32::MAX; N],
                    id: [0; N],
                    flags: [0; N],
                    normal: [[0.0; N]; 3],
                    u: [0.0; N],
                    v: [0.0; N],
                    primitive: [u32::MAX; N],
                    geometry: [u32::MAX; N],
                    instances: [[u32::MAX; N]; 9],
                };
                for (k, ray) in rays.iter().enumerate() {
                    valid.0[k] = -1;
                    for axis in 0..3 {
                        hit.origin[axis][k] = ray.origin[axis];
                        hit.direction[axis][k] = ray.direction[axis];
                    }
                    hit.near[k] = ray.t_min;
                    hit.far[k] = ray.t_max;
                }
                match (embree.version, &ask3, &ask4) {
                    (3, Ok(ask), _) => ask(&valid, embree.scene, &mut context, &mut hit),
                    (_, _, Ok(ask)) => ask(&valid, embree.scene, &mut hit, std::ptr::null()),
                    _ => panic!("Embree lacks a function"),
                }
                for k in 0..rays.len() {
                    found(&hit, k);
                }
            }
        }
    }
}

impl<const N: usize> Kernel for Packets<N> {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>) {
        self.ask("rtcIntersect", rays.narrow, |hit, k| {
            let is_hit = hit.geometry[k] != u32::MAX;
            found.push(is_hit.then_some((f64::from(hit.far[k]), hit.primitive[k])));
        });
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        self.ask("rtcOccluded", rays.narrow, |hit, k| {
            blocked.push(hit.far[k] < 0.0)
        });
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: both handles are released once, here.
        unsafe {
            for (name, handle) in [
                (&b"rtcReleaseScene"[..], self.scene),
                (&b"rtcReleaseDevice"[..], self.device),
            ] {
                if let Ok(release) = self.library.get::<extern "C" fn(Handle)>(name) {
                    release(handle);
                }
            }
        }
    }
}
