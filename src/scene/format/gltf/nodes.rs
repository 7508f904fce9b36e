//! The node hierarchy: where meshes, cameras and lights are placed.

use super::extensions::{INSTANCING, LIGHTS, VISIBILITY};
use super::json::{Fields, Node, Root, Whole};
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use crate::scene::note::NoteKind;
use glam::{DMat4, DQuat};
use serde_json::Value;

/// Nodes between two checks for cancellation.
const NODES_PER_CHECK: usize = 4096;

/// Everything that the nodes place in the world.
#[derive(Default)]
pub(super) struct Placed {
    pub meshes: Vec<PlacedMesh>,
    /// The first perspective camera.
    pub camera: Option<PlacedCamera>,
    pub lights: Vec<PlacedLight>,
}

/// A mesh in world space.
pub(super) struct PlacedMesh {
    pub mesh: usize,
    pub to_world: DMat4,
    /// The node with the extension that places copies of the mesh.
    pub instancing: Option<usize>,
}

/// A perspective camera in world space.
pub(super) struct PlacedCamera {
    pub from: Vec3,
    pub forward: Vec3,
    pub up: Vec3,
    /// Full vertical angle in degrees.
    pub angle: f64,
    pub aspect: f64,
    pub near: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LightKind {
    Directional,
    Point,
    Spot,
}

/// A light in world space.
pub(super) struct PlacedLight {
    pub kind: LightKind,
    pub color: Vec3,
    /// Candela, or lux for a directional one.
    pub intensity: f64,
    pub position: Vec3,
    /// Direction in which a directional light shines.
    pub direction: Vec3,
    /// The node that contains it.
    pub place: Place,
}

/// Collects what the nodes of the default scene place in the world; without a default, of the first
/// scene; without scenes, of all nodes.
pub(super) fn collect(
    root: &Root,
    builder: &mut SceneBuilder,
    progress: &Progress,
) -> Result<Placed, ReadError> {
    let mut placed = Placed::default();
    let number = root.scene.map_or(0, Whole::index);
    let roots: Vec<usize> = match root.scenes.get(number) {
        Some(scene) => scene.nodes.iter().map(|node| node.index()).collect(),
        None if root.scenes.is_empty() => orphans(root),
        None => {
            let count = root.scenes.len();
            let expected = format_args!("one of {count} scenes");
            return Err(ReadError::at(
                Place::Element("scene", number),
                expected,
                "none",
            ));
        }
    };
    let others = root.scenes.len().saturating_sub(1);
    if others > 0 {
        let text = format!("{others} other scene(s) of the file");
        builder.note(NoteKind::Skipped, &text, Place::Element("scene", 0));
    }
    // Valid nodes form a forest. A node that is reached twice could be part of an endless cycle.
    let mut visited = vec![false; root.nodes.len()];
    let mut pending: Vec<_> = roots
        .into_iter()
        .rev()
        .map(|node| (node, DMat4::IDENTITY))
        .collect();
    let mut steps = 0_usize;
    while let Some((number, parent)) = pending.pop() {
        steps += 1;
        if steps.is_multiple_of(NODES_PER_CHECK) {
            progress.check()?;
        }
        let place = Place::Element("node", number);
        let Some(node) = root.nodes.get(number) else {
            let count = root.nodes.len();
            let expected = format_args!("one of {count} nodes");
            return Err(ReadError::at(place, expected, "none"));
        };
        if std::mem::replace(&mut visited[number], true) {
            builder.note(NoteKind::Skipped, "node with two parents", place);
            continue;
        }
        let visibility = node
            .extensions
            .get(VISIBILITY)
            .and_then(|e| e.get("visible"));
        if visibility == Some(&Value::Bool(false)) {
            let text = "node that is hidden (KHR_node_visibility), with its children";
            builder.note(NoteKind::Skipped, text, place);
            continue;
        }
        let world = parent * local(node);
        node_content(root, node, world, number, &mut placed, builder);
        let children = node.children.iter().rev();
        pending.extend(children.map(|child| (child.index(), world)));
    }
    Ok(placed)
}

/// Returns the nodes that are not a child of any other.
fn orphans(root: &Root) -> Vec<usize> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| &node.children) {
        if let Some(known) = is_child.get_mut(child.index()) {
            *known = true;
        }
    }
    (0..root.nodes.len()).filter(|&n| !is_child[n]).collect()
}

/// Returns the transformation from the node's coordinates to those of its parent.
fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(Vec3::ONE, Vec3::from_array),
        rotation(node.rotation.unwrap_or_default()),
        node.translation.map_or(Vec3::ZERO, Vec3::from_array),
    )
}

/// Returns the rotation of a quaternion, whose length may be 1 only up to rounding.
pub(super) fn rotation(quaternion: [f64; 4]) -> DQuat {
    let rotation = DQuat::from_array(quaternion);
    if rotation.length_squared() > 0.0 {
        rotation.normalize()
    } else {
        DQuat::IDENTITY
    }
}

fn node_content(
    root: &Root,
    node: &Node,
    to_world: DMat4,
    number: usize,
    placed: &mut Placed,
    builder: &mut SceneBuilder,
) {
    let place = Place::Element("node", number);
    if let Some(mesh) = node.mesh {
        placed.meshes.push(PlacedMesh {
            mesh: mesh.index(),
            to_world,
            instancing: node.extensions.contains_key(INSTANCING).then_some(number),
        });
    }
    if let Some(camera) = &node.camera {
        let camera = Whole::of(camera).and_then(|number| root.cameras.get(number.index()));
        let exists = camera.is_some();
        let camera = camera.and_then(|camera| placed_camera(camera, to_world));
        let why = match (&placed.camera, &camera) {
            _ if !exists => "camera that does not exist",
            (_, None) => "camera without perspective",
            (Some(_), _) => "camera after the first",
            (None, Some(_)) => {
                placed.camera = camera;
                ""
            }
        };
        if !why.is_empty() {
            builder.note(NoteKind::Skipped, why, place);
        }
    }
    if let Some(named) = node.extensions.get(LIGHTS) {
        let light = named.get("light").and_then(Whole::of).and_then(|number| {
            let all = root.extensions.get(LIGHTS)?.get("lights")?;
            all.get(number.index())
        });
        match light.and_then(|light| placed_light(light, to_world, place)) {
            Some(light) => placed.lights.push(light),
            None => {
                let text = "light that does not exist or cannot be read";
                builder.note(NoteKind::Skipped, text, place);
            }
        }
    }
}

fn placed_camera(camera: &Value, to_world: DMat4) -> Option<PlacedCamera> {
    let mut fields = Fields::of(Some(camera.get("perspective")?));
    let camera = PlacedCamera {
        from: to_world.transform_point3(Vec3::ZERO),
        forward: to_world.transform_vector3(Vec3::NEG_Z).try_normalize()?,
        up: to_world.transform_vector3(Vec3::Y).try_normalize()?,
        angle: fields.number("yfov", 0.0).to_degrees(),
        aspect: fields.number("aspectRatio", 1.0),
        near: fields.number("znear", 0.0),
    };
    fields.unreadable.is_empty().then_some(camera)
}

fn placed_light(light: &Value, to_world: DMat4, place: Place) -> Option<PlacedLight> {
    let mut fields = Fields::of(Some(light));
    let light = PlacedLight {
        kind: match fields.text("type")? {
            "directional" => LightKind::Directional,
            "point" => LightKind::Point,
            "spot" => LightKind::Spot,
            _ => return None,
        },
        color: Vec3::from_array(fields.numbers("color", [1.0; 3])),
        intensity: fields.number("intensity", 1.0),
        position: to_world.transform_point3(Vec3::ZERO),
        direction: to_world
            .transform_vector3(Vec3::NEG_Z)
            .normalize_or(Vec3::NEG_Z),
        place,
    };
    fields.unreadable.is_empty().then_some(light)
}
