//! Embree's builder, `rtcBuildBVH`, called for boxes.

use libloading::{Library, Symbol};
use std::ffi::{c_char, c_void};
use std::ptr::null_mut;

type Handle = *mut c_void;

/// Lower and upper corner of a box.
type Corners = [[f32; 3]; 2];

/// A node as the callbacks make it: a leaf with objects, or an inner node with children and their boxes.
#[derive(Default)]
pub struct Node {
    pub objects: Vec<u32>,
    pub children: Vec<Node>,
    pub boxes: Vec<Corners>,
}

/// `RTCBounds`.
#[repr(C, align(16))]
struct Bounds {
    lower: [f32; 4],
    upper: [f32; 4],
}

/// `RTCBuildPrimitive`.
#[repr(C, align(32))]
struct Primitive {
    lower: [f32; 3],
    geometry: u32,
    upper: [f32; 3],
    primitive: u32,
}

/// `RTCBuildArguments`.
#[repr(C)]
struct Arguments {
    bytes: usize,
    quality: u32,
    flags: u32,
    max_branching_factor: u32,
    max_depth: u32,
    sah_block_size: u32,
    min_leaf_size: u32,
    max_leaf_size: u32,
    traversal_cost: f32,
    intersection_cost: f32,
    bvh: Handle,
    primitives: *mut Primitive,
    primitive_count: usize,
    primitive_capacity: usize,
    create_node: extern "C" fn(Handle, u32, Handle) -> *mut Node,
    set_node_children: extern "C" fn(*mut Node, *const *mut Node, u32, Handle),
    set_node_bounds: extern "C" fn(*mut Node, *const *const Bounds, u32, Handle),
    create_leaf: extern "C" fn(Handle, *const Primitive, usize, Handle) -> *mut Node,
    split_primitive: usize,
    build_progress: usize,
    user: Handle,
}

extern "C" fn create_node(_: Handle, _: u32, _: Handle) -> *mut Node {
    Box::into_raw(Box::default())
}

extern "C" fn set_node_children(
    node: *mut Node,
    children: *const *mut Node,
    count: u32,
    _: Handle,
) {
    // SAFETY: Embree passes nodes that the callbacks made, each to one parent.
    unsafe {
        let children = std::slice::from_raw_parts(children, count as usize);
        (*node).children = children
            .iter()
            .map(|&child| *Box::from_raw(child))
            .collect();
    }
}

extern "C" fn set_node_bounds(node: *mut Node, boxes: *const *const Bounds, count: u32, _: Handle) {
    // SAFETY: Embree passes one box per child.
    unsafe {
        let boxes = std::slice::from_raw_parts(boxes, count as usize);
        let corner = |[x, y, z, _]: [f32; 4]| [x, y, z];
        let corners = |b: &*const Bounds| [corner((**b).lower), corner((**b).upper)];
        (*node).boxes = boxes.iter().map(corners).collect();
    }
}

extern "C" fn create_leaf(_: Handle, held: *const Primitive, count: usize, _: Handle) -> *mut Node {
    // SAFETY: Embree passes the primitives of the leaf.
    let held = unsafe { std::slice::from_raw_parts(held, count) };
    Box::into_raw(Box::new(Node {
        objects: held.iter().map(|p| p.primitive).collect(),
        ..Node::default()
    }))
}

/// Builds a hierarchy of at least one box and returns its root.
///
/// # Errors
/// Embree is not installed, or it fails.
pub fn build(boxes: &[Corners], width: u32) -> Result<Box<Node>, Box<dyn std::error::Error>> {
    let primitives = boxes
        .iter()
        .zip(0..)
        .map(|(&[lower, upper], primitive)| Primitive {
            lower,
            geometry: 0,
            upper,
            primitive,
        });
    let mut primitives: Vec<Primitive> = primitives.collect();
    let names = [
        "libembree4.so.4",
        "libembree3.so.3",
        "embree4.dll",
        "libembree4.dylib",
    ];
    // SAFETY: the types are those of Embree's headers, the same in versions 3 and 4.
    unsafe {
        let library = names.iter().find_map(|name| Library::new(name).ok());
        // Never unloaded: Embree's threads may still run in it.
        let library: &Library = Box::leak(Box::new(library.ok_or("Embree is not installed")?));
        let new_device: Symbol<extern "C" fn(*const c_char) -> Handle> =
            library.get(b"rtcNewDevice")?;
        let new_bvh: Symbol<extern "C" fn(Handle) -> Handle> = library.get(b"rtcNewBVH")?;
        let build: Symbol<extern "C" fn(*const Arguments) -> *mut Node> =
            library.get(b"rtcBuildBVH")?;
        let root = build(&Arguments {
            bytes: size_of::<Arguments>(),
            quality: 1,
            flags: 0,
            max_branching_factor: width,
            max_depth: 64,
            sah_block_size: 1,
            min_leaf_size: 1,
            max_leaf_size: 8,
            traversal_cost: 1.0,
            intersection_cost: 1.0,
            bvh: new_bvh(new_device(c"threads=1".as_ptr())),
            primitives: primitives.as_mut_ptr(),
            primitive_count: boxes.len(),
            primitive_capacity: boxes.len(),
            create_node,
            set_node_children,
            set_node_bounds,
            create_leaf,
            split_primitive: 0,
            build_progress: 0,
            user: null_mut(),
        });
        if root.is_null() {
            return Err("Embree failed".into());
        }
        Ok(Box::from_raw(root))
    }
}
