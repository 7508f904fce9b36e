//! Building the tree of a scene with any method.

use super::build::{BuildError, Scope, divide};
use super::bvh::{Binary, BvhBuilder, Input, Laid, lay_out};
use super::frame::Frame;
use super::method::Structure;
use super::node::{Node, NodeKind, StopReason};
use super::nodes::Nodes;
use super::settings::{BuildSettings, Builder, MaxDepth};
use super::tree::Tree;
use super::tree_file::{self, Faults, FileTree, TreeFileError};
use super::voxels::Voxels;
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::progress::Progress;
use crate::scene::Scene;
use rayon::prelude::*;
use std::path::Path;
use std::sync::OnceLock;

/// Builds the tree of a scene on the threads of the current `rayon` pool, or of the global pool.
/// The same scene and settings always give the same tree.
///
/// The tree of a scene without objects is one empty leaf.
///
/// # Errors
/// A setting is out of range, the tree would exceed the memory limit, or cancellation.
pub fn build(
    scene: &Scene,
    settings: &BuildSettings,
    progress: &Progress,
) -> Result<Tree, BuildError> {
    settings.check()?;
    let objects = scene.objects();
    if objects.len() >= Node::MAX_LEAF {
        return Err(BuildError::TooManyObjects(objects.len()));
    }
    if let Builder::File(path) = settings.method.builder {
        let failed = |reason| match reason {
            TreeFileError::Cancelled(cancelled) => BuildError::Cancelled(cancelled),
            reason => BuildError::File {
                path: path.to_owned(),
                reason,
            },
        };
        return of_file(scene, settings, path, progress).map_err(failed);
    }
    // Enters the pool once instead of once per cell.
    rayon::scope(|_| in_pool(scene, settings, progress))
}

fn in_pool(
    scene: &Scene,
    settings: &BuildSettings,
    progress: &Progress,
) -> Result<Tree, BuildError> {
    /// Objects between two checks for cancellation.
    const CHUNK: usize = 1 << 14;
    let objects = scene.objects();
    let frame = Frame::around(&scene.bounds(), settings.root_margin.resolve(scene));
    let depth_limit = settings.d_max.resolve(objects.len());
    let mut bounds = Vec::new();
    objects
        .par_iter()
        .with_min_len(CHUNK)
        .map(|object| match progress.is_cancelled() {
            true => Aabb::EMPTY,
            false => object.bounds(),
        })
        .collect_into_vec(&mut bounds);
    progress.check()?;
    let scope = Scope {
        objects,
        bounds: &bounds,
        frame: &frame,
        settings,
        depth_limit,
        progress,
    };
    let (nodes, references, depth_reached) = match settings.method.builder {
        Builder::Cells(rule) => {
            let divided = divide(&scope, rule(settings).as_ref())?;
            let (nodes, references) = (divided.nodes, divided.references);
            (Nodes::Planes(nodes), references, divided.depth_reached)
        }
        Builder::File(_) => unreachable!("the tree of a file is not built"),
        Builder::Boxes(builder) => {
            let laid = enclose(&scope, builder(settings).as_ref())?;
            (
                Nodes::Boxes(laid.nodes),
                laid.references,
                laid.depth_reached,
            )
        }
    };
    let voxels = (settings.method.structure == Structure::Grid).then(|| Voxels::of(nodes.planes()));
    Ok(Tree {
        nodes,
        voxels,
        references,
        frame,
        settings: settings.clone(),
        depth_limit,
        depth_reached,
        faults: Faults::default(),
        simd_tree: OnceLock::new(),
    })
}

/// Reads the tree of a file.
fn of_file(
    scene: &Scene,
    settings: &BuildSettings,
    path: &Path,
    progress: &Progress,
) -> Result<Tree, TreeFileError> {
    let bytes = tree_file::load(path, settings.memory_limit)?;
    let FileTree {
        structure,
        width,
        nodes,
        references,
        voxels,
        frame,
        faults,
    } = tree_file::read(&bytes, scene, settings.root_margin, progress)?;
    let method = settings.method;
    let is_as_opened = structure == method.structure
        && (structure != Structure::Bvh || f64::from(width) == settings.constant("width"));
    if !is_as_opened {
        return Err(TreeFileError::Changed);
    }
    let mut tree = Tree {
        nodes,
        voxels,
        references,
        frame,
        settings: settings.clone(),
        depth_limit: 0,
        depth_reached: 0,
        faults,
        simd_tree: OnceLock::new(),
    };
    let is_leaf = |node: u32| tree.kind(node) != NodeKind::Inner;
    let leaves = tree.cells().filter(|cell| is_leaf(cell.node));
    let depth = leaves.map(|cell| cell.depth).max().unwrap_or(0);
    (tree.depth_reached, tree.depth_limit) = (depth, depth);
    Ok(tree)
}

/// Builds a bounding volume hierarchy.
fn enclose(scope: &Scope<'_>, builder: &dyn BvhBuilder) -> Result<Laid, BuildError> {
    /// Bytes that a build takes per reference: lists of the builder, two nodes of the binary hierarchy, two
    /// as laid out.
    const PER_REFERENCE: f64 = 320.0;
    let settings = scope.settings;
    let references = scope.bounds.len() as f64 * builder.max_references_per_object();
    let needed = (references * PER_REFERENCE) as u64;
    if needed > settings.memory_limit {
        return Err(BuildError::HierarchyTooLarge {
            needed,
            limit: settings.memory_limit,
        });
    }
    let binary = if scope.objects.is_empty() {
        let mut empty = Binary::default();
        empty.leaf(scope.frame.cell(), [], StopReason::Empty);
        empty
    } else {
        builder.build(&Input {
            objects: scope.objects,
            bounds: scope.bounds,
            depth_limit: if settings.method.has_limits {
                scope.depth_limit
            } else {
                MaxDepth::LIMIT
            },
            progress: scope.progress,
        })?
    };
    let width = settings.constant("width") as usize;
    Ok(lay_out(&binary, width, scope.frame, scope.progress)?)
}
