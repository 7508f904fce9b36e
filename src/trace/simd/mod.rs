//! SIMD kernels: batches of rays in the lanes of vectors, one ray per lane.
//!
//! Rays traverse the tree each on its own ([`stream`]) or in packets ([`packet`]). The tree is that of
//! the scalar kernel, built by any method, in a form that is prepared once per tree ([`SimdTree`](crate::structure::SimdTree)). The
//! hits are those of the scalar kernel, ray for ray and bit for bit. For that, only the exact tests must
//! be the scalar kernel's ([`exact`]). Everything before them is done in `f32` and only rules out what is
//! certainly missed: planes are as thick as rounding may move rays and objects, and objects are tested
//! in blocks of 16 against a ray, or one by one against a packet ([`block`]). One or two objects per ray
//! remain for the exact test.
//!
//! Calls should have many rays: below about 500 some lanes idle, and thousands are better still.
//!
//! Each layer imports only from those above it:
//!
//! | layer | modules |
//! |---|---|
//! | vectors | [`arithmetic`], [`array`](mod@array), [`prefetch`], [`instruction_set`] |
//! | rays | [`ray`], [`ray_packet`], [`candidate`], [`queue`] |
//! | blocks | [`block`] |
//! | exact tests | [`crossings`], [`exact`] |
//! | traversal | [`packet`], [`stream`], [`pool`] |
//! | kernel | [`mode`], [`compiled`], [`kernel`] |

mod arithmetic;
mod array;
mod block;
mod candidate;
mod compiled;
mod crossings;
mod exact;
mod instruction_set;
mod kernel;
mod leaf_pass;
mod leaves;
mod mode;
mod packet;
mod pool;
mod prefetch;
mod queue;
mod ray;
mod ray_packet;
mod stream;

pub use instruction_set::InstructionSet;
pub use kernel::SimdKernel;
pub use mode::SimdMode;
