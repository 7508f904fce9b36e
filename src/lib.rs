//! bspscope: shows, measures and compares the acceleration structures that make ray tracing fast.
//!
//! The method is that of V. Havran and J. Žára, "Evaluation of BSP properties for ray-tracing": a
//! tree is judged by a septet Δ of counts, which are the same on every machine, and a triplet Λ of
//! times, under equal conditions and for the same image.
//!
//! # Overview
//!
//! Read the modules in this order: each imports only from those above it.
//!
//! | module | what it owns | to add an entry |
//! |---|---|---|
//! | [`geometry`] | vectors, boxes, axes, rays | |
//! | [`progress`] | progress and cancellation of long tasks | |
//! | [`files`] | atomic file writes, checksums | |
//! | [`primitive`] | sphere, triangle, polygon, cylinder and cone: bounds, overlap with a cell, intersection in `f64` and in packed `f32` | a variant of [`primitive::Primitive`] |
//! | [`scene`] | objects, materials, lights, camera; the features that a scene requires | |
//! | [`scene::format`] | readers and writers: NFF, OBJ, PLY, glTF, STL; the load report | a line in [`scene::format::FORMATS`] |
//! | [`scene::builtin`] | scene generators | a line in [`scene::builtin::BUILTINS`] |
//! | [`structure`] | nodes with planes or boxes, the build driver, voxels of grids, moments of the build, validation | |
//! | [`structure::split`] | build methods: where a cell is split | a line in [`structure::split::SPLIT_RULES`] |
//! | [`structure::tree_file`] | trees as files: reader, writer, what is wrong with a tree | |
//! | [`structure::bvh`] | build methods of bounding volume hierarchies | a line in [`structure::bvh::BVH_BUILDERS`] |
//! | [`trace`] | traversal of trees, hierarchies and grids in two precisions; timed and counting kernels, scalar and SIMD; shading, rendering, recorded rays | |
//! | [`setup`] | the whole experiment: scene, structure, render settings, camera; the command that measures it | a field and an entry of [`setup::SETTINGS`] |
//! | [`measure`] | counters, which serve as the parameters of the paper's Tables 1 to 3, as heatmaps and as counts per kind of ray; Δ and Λ; verification against testing every object | an entry of [`measure::COUNTERS`] |
//! | [`measure::model`] | the time model of equation (1), by regression and in place; where the rendering time goes | |
//! | [`measure::sweep`] | the parameters for every combination of settings: points, rows, shards | |
//! | [`measure::tune`] | the best tree for a scene: candidates, rounds, ranking with ties | |
//! | [`measure::study`] | which measure predicts time, over a hundred structures of a scene | an entry of [`measure::study::Predictor::ALL`] |
//! | [`measure::paper`] | the paper's printed tables, and its experiment repeated | |
//! | [`measure::judge`] | exact arithmetic: why two hits differ | |
//! | [`measure::answers`] | answers of other programs: right, tie, rounding or fault | |
//! | [`measure::exact`] | every structure and kernel against exact arithmetic, with rays at the limits of rounding | a variant of [`measure::exact::RaySource`] |
//! | [`measure::stability`] | tests with extreme inputs | an entry of [`measure::stability::CASES`] |
//! | [`measure::accuracy`] | accuracy vs. time: error and rendering time of each setting | a line in [`measure::accuracy::KNOBS`] |
//! | [`measure::heat`] | heatmaps: the cost of each pixel | |
//! | [`jobs`] | background jobs and their scheduler: progress, pause, cancel, partial results | a file with one [`jobs::Job`] |
//! | [`present::number`] [`present::words`] | numbers and results as text | |
//! | [`present::chart`] | charts of a sweep | |
//! | [`present::overlay`] | leaf cells, selection, ray paths and heatmaps as plain colors and lines; histograms | a line in [`present::overlay::COLORINGS`], [`present::overlay::COLORMAPS`] or [`present::overlay::HISTOGRAMS`] |
//! | [`present::report`] | reports as text, JSON, CSV, Markdown, LaTeX and HTML | a line in [`present::report::WRITERS`] |
//! | [`present::export`] | pictures, heatmaps with legends, leaf boxes, the whole report | a line in [`present::export::LEAF_WRITERS`] |
//! | [`lesson`] | guided tours in plain text, and whether what they state is true | a line in [`lesson::LESSONS`] |
//! | [`workspace`] | the state of a session as a file | a field with a default |
//! | [`cli`], `gui` | the two user interfaces; neither imports the other, except to open the window | |
//!
//! # Data flow
//!
//! ```text
//! file or generator ─▶ Scene ─▶ Tree ─▶ timed rendering   ─▶ picture, T_TR
//!                                    └▶ counted rendering ─▶ tallies, T_TT
//!                  facts on scene and tree, times, tallies ─▶ Measurement
//!                  Measurement ─▶ COUNTERS ─▶ Δ, Λ ─▶ reports and panels
//! ```
//!
//! # From another program
//!
//! ```
//! use bspscope::measure::{measure, parameter};
//! use bspscope::progress::Progress;
//! use bspscope::scene::{SceneRequest, load};
//! use bspscope::trace::RenderSettings;
//! use bspscope::structure::{BuildSettings, Method};
//!
//! let progress = Progress::new();
//! let scene = load(&SceneRequest::parse("tetra:3"), &progress)?;
//! let build = BuildSettings::for_method(Method::named("midpoint")?);
//! let render = RenderSettings {
//!     width: 64,
//!     height: 64,
//!     ..RenderSettings::default()
//! };
//! let measured = measure(&scene, &build, &render, &progress)?;
//! let leaves = parameter("N_LS").value(&measured.measurement);
//! assert!(leaves > Some(1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Module docs also link to private modules.
#![allow(rustdoc::private_intra_doc_links)]

pub mod cli;
pub mod files;
pub mod geometry;
#[cfg(feature = "gui")]
pub mod gui;
pub mod jobs;
pub mod lesson;
pub mod measure;
pub mod present;
pub mod primitive;
pub mod progress;
pub mod scene;
pub mod setup;
pub mod structure;
pub mod trace;
pub mod workspace;
