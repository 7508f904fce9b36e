//! Reads the tree of a file for a scene.

use super::boxes::{Boxes, contains};
use super::columns::Columns;
use super::error::TreeFileError;
use super::faults::Faults;
use super::graph::Graph;
use super::header::{Header, Kind, Root};
use super::planes::{Planes, children_of, voxels_of};
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::frame::Frame;
use crate::structure::method::Structure;
use crate::structure::nodes::Nodes;
use crate::structure::settings::RootMargin;
use crate::structure::voxels::Voxels;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Returns the bytes of a file.
///
/// # Errors
/// It cannot be read, or is larger than `limit` bytes.
pub fn load(path: &Path, limit: u64) -> Result<Vec<u8>, TreeFileError> {
    let failed = |error: io::Error| TreeFileError::Io(error.to_string());
    let file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    // Devices and pipes report no length.
    file.take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    match bytes.len() as u64 > limit {
        true => Err(TreeFileError::TooLarge(limit)),
        false => Ok(bytes),
    }
}

/// The tree of a file.
pub struct FileTree {
    pub structure: Structure,
    pub width: u32,
    pub nodes: Nodes,
    pub references: Vec<u32>,
    pub voxels: Option<Voxels>,
    pub frame: Frame,
    /// What is wrong with it, although it is a tree.
    pub faults: Faults,
}

/// Reads a tree of a scene. The margin is that of the root cell where the file has none.
///
/// # Errors
/// It is not a file of this format, it is of another scene, or its nodes are no tree. Cancellation.
pub fn read(
    bytes: &[u8],
    scene: &Scene,
    margin: RootMargin,
    progress: &Progress,
) -> Result<FileTree, TreeFileError> {
    let (header, data) = Header::parse(bytes)?;
    let (columns, objects) = (
        Columns {
            header: &header,
            data,
        },
        scene.objects(),
    );
    if header.objects as usize != objects.len() {
        return Err(TreeFileError::Objects {
            file: header.objects,
            scene: objects.len(),
        });
    }
    let frame = frame(&header, scene, margin)?;
    let leaf = columns.u8s("leaf", None)?;
    let rows = Some(leaf.len());
    let (first, count) = (columns.u32s("first", rows)?, columns.u32s("count", rows)?);
    let [first, count, child] = match header.kind {
        Kind::Bvh => [first, count, columns.u32s("child", None)?],
        Kind::Kd => children_of(&columns, leaf, first, count)?,
    };
    let graph = Graph {
        leaf,
        first,
        count,
        child,
        references: columns.u32s("ref", None)?,
        stop: columns.optional_u8s("stop", leaf.len())?,
        stops: &header.stops,
        width: if header.kind == Kind::Bvh {
            header.width
        } else {
            2
        },
        objects: objects.len(),
    };
    let mut faults = Faults::default();
    let order = graph.order(&mut faults, progress)?;
    if faults.are_fatal() {
        return Err(TreeFileError::Broken(faults));
    }
    let mut voxels = None;
    let (nodes, references) = match header.kind {
        Kind::Bvh => {
            let (boxes, rounded) = columns.sixes("box", leaf.len())?;
            let boxes = Boxes {
                boxes,
                rounded,
                split: header.split,
                objects,
                frame: &frame,
            };
            let (nodes, references) = boxes.lay_out(&graph, &order, &mut faults, progress)?;
            (Nodes::Boxes(nodes), references)
        }
        Kind::Kd => {
            let planes = Planes {
                axis: columns.u8s("axis", rows)?,
                plane: columns.f32s("plane", leaf.len())?,
            };
            let (nodes, references) = planes.lay_out(&graph, &order, &mut faults, progress)?;
            if header.structure() == Structure::Grid && !faults.are_fatal() {
                voxels = voxels_of(&nodes, &mut faults);
            }
            (Nodes::Planes(nodes), references)
        }
    };
    if faults.are_fatal() {
        return Err(TreeFileError::Broken(faults));
    }
    Ok(FileTree {
        structure: header.structure(),
        width: header.width,
        nodes,
        references,
        voxels,
        frame,
        faults,
    })
}

/// Returns the root cell of a file, or that of the scene if the file has none.
fn frame(header: &Header, scene: &Scene, margin: RootMargin) -> Result<Frame, TreeFileError> {
    let bounds = scene.bounds();
    let Some(Root {
        center,
        half,
        margin,
    }) = header.root
    else {
        return match header.kind {
            Kind::Bvh => Ok(Frame::around(&bounds, margin.resolve(scene))),
            Kind::Kd => Err(TreeFileError::Root("missing from the header")),
        };
    };
    let (center, half) = (Vec3::from_array(center), Vec3::from_array(half));
    if !(center.is_finite() && half.is_finite() && margin.is_finite() && margin >= 0.0) {
        return Err(TreeFileError::Root(
            "a number is not finite, or the margin is negative",
        ));
    }
    let frame = Frame::at(center, half, margin, &bounds).ok_or(TreeFileError::Root(
        "it is empty, or too small for its place",
    ))?;
    let cell = frame.cell().enlarged(frame.slack());
    if !(cell.lo.is_finite() && cell.hi.is_finite()) {
        return Err(TreeFileError::Root("it is too large"));
    }
    if !contains(&cell, &bounds) {
        return Err(TreeFileError::Root(
            "it does not contain all objects of the scene",
        ));
    }
    Ok(frame)
}
