//! Tests of the library.

#[path = "../support/mod.rs"]
mod support;

mod accuracy;
mod answers;
mod build;
mod bvh;
mod compare;
mod conformance;
mod exact;
mod export;
mod foreign;
mod formats;
mod gltf;
mod heat;
mod html;
mod jobs;
mod judge;
mod leaks;
mod lessons;
mod malformed;
mod malformed_meshes;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod masked_stores;
mod measures;
mod methods;
mod model;
mod paper;
mod precision;
mod primitives;
mod properties;
mod reconstructions;
mod record;
mod scheduler;
mod settings;
mod simd;
mod stability;
mod study;
mod tolerant;
mod tree_file;
mod tune;
mod visits;
mod wording;
mod workspace;
