//! bspscope: see, measure and compare the BSP trees that make ray tracing fast.
//!
//! The method is that of V. Havran and J. Žára, "Evaluation of BSP properties for ray-tracing": a
//! tree is judged by a septet Δ of counts, which no machine changes, and a triplet Λ of times,
//! under equal conditions, on the same image.
//!
//! # The way through
//!
//! Read the folders in this order; each imports only from those before it.
//!
//! | module | what it owns | one new entry is |
//! |---|---|---|
//! | [`geometry`] | vectors, boxes, axes, rays | |
//! | [`progress`] | how long tasks tell how far they are and are told to stop | |
//! | [`files`] | files written whole or not at all, and their fingerprints | |
//! | [`primitive`] | sphere, triangle, polygon, cylinder and cone: bounds, overlap with a cell, intersection in `f64` or on objects packed in `f32` | a variant of [`primitive::Primitive`] |
//! | [`scene`] | objects, materials, lights, camera; what the scene requires | |
//! | [`scene::format`] | readers and writers of files: NFF, OBJ, PLY, glTF, STL; the load report | a line in [`scene::format::FORMATS`] |
//! | [`scene::builtin`] | generated scenes | a line in [`scene::builtin::BUILTINS`] |
//! | [`structure`] | 8-byte nodes, the one build driver, voxels of grids, moments of the build, validation | |
//! | [`structure::split`] | where a method splits a cell | a line in [`structure::split::SPLIT_RULES`] |
//! | [`trace`] | traversal of trees and grids in two precisions, timed and counting kernels, plain or in lanes of vectors, shading, passes over a picture, visits of nodes | |
//! | [`setup`] | the whole experiment: scene, structure, render settings, camera | |
//! | [`measure`] | counters, which serve as the parameters of the paper's Tables 1 to 3, as heatmaps and as figures of each kind of ray; trees against testing every object | an entry of [`measure::COUNTERS`] |
//! | [`measure::model`] | the time model of equation (1): by regression and in place; where the time of a picture goes | |
//! | [`measure::sweep`] | the parameters over a grid of settings: points, rows, shards | |
//! | [`measure::paper`] | the paper's printed tables, and its experiment repeated | |
//! | [`measure::judge`] | exact arithmetic: why two answers about a ray differ | |
//! | [`measure::stability`] | trees at the extremes | an entry of [`measure::stability::CASES`] |
//! | [`measure::accuracy`] | what accuracy costs: time and error of every choice | a line in [`measure::accuracy::KNOBS`] |
//! | [`measure::heat`] | heatmaps: what each pixel costs | |
//! | [`jobs`] | work in the background and the one scheduler: progress, pause, cancel, partial results | a file with one [`jobs::Job`] |
//! | [`present::number`] [`present::words`] | numbers and results as text | |
//! | [`present::chart`] | charts of a sweep | |
//! | [`present::overlay`] | leaf cells, the selection, ray paths and heatmaps as plain colours and lines; histograms of leaves and rays | a line in [`present::overlay::COLORINGS`], [`present::overlay::COLORMAPS`] or [`present::overlay::HISTOGRAMS`] |
//! | [`present::report`] | text, JSON, CSV, Markdown, LaTeX; the page of HTML | a line in [`present::report::WRITERS`] |
//! | [`present::export`] | pictures, heatmaps with legends, leaf boxes, the report put together | a line in [`present::export::LEAF_WRITERS`] |
//! | [`lesson`] | guided tours in plain text: what they look at, ask and tell; whether it holds | a line in [`lesson::LESSONS`] |
//! | [`workspace`] | what was looked at and how, as a file; settings as a command | a field with a default |
//! | [`cli`], `gui` | the two faces; they never import each other but to start the window | |
//!
//! # The one data flow
//!
//! ```text
//! file or generator ─▶ Scene ─▶ Tree ─▶ timed pass    ─▶ picture, T_TR
//!                                    └▶ counted pass  ─▶ tallies, T_TT
//!                       facts of scene and tree, times, tallies ─▶ Measurement
//!                       Measurement ─▶ parameters() ─▶ Δ, Λ ─▶ reports and panels
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

// Module comments lead developers into private modules too.
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
