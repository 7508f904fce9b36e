//! The node hierarchy: where meshes, cameras and lights are placed.

use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use crate::scene::note::NoteKind;
use glam::{DMat4, DQuat};
use gltf_json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf_json::scene::Node;
use gltf_json::validation::Checked;
use gltf_json::{Index, Mesh, Root};

/// Nodes between two checks for cancellation.
const NODES_PER_CHECK: usize = 4096;

/// Everything that the nodes place in the world.
#[derive(Default)]
pub(super) struct Placed {
    /// Meshes by number, with their transformation to world space.
    pub meshes: Vec<(Index<Mesh>, DMat4)>,
    /// The first perspective camera.
    pub camera: Option<PlacedCamera>,
    pub lights: Vec<PlacedLight>,
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

/// A light in world space.
pub(super) struct PlacedLight {
    pub kind: Type,
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
    let number = root.scene.map_or(0, |scene| scene.value());
    let roots: Vec<usize> = match root.scenes.get(number) {
        Some(scene) => scene.nodes.iter().map(Index::value).collect(),
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
        let world = parent * local(node);
        node_content(root, node, world, place, &mut placed, builder)?;
        let children = node.children.iter().flatten().rev();
        pending.extend(children.map(|child| (child.value(), world)));
    }
    Ok(placed)
}

/// Returns the nodes that are not a child of any other.
fn orphans(root: &Root) -> Vec<usize> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root
        .nodes
        .iter()
        .flat_map(|node| node.children.iter().flatten())
    {
        if let Some(known) = is_child.get_mut(child.value()) {
            *known = true;
        }
    }
    (0..root.nodes.len()).filter(|&n| !is_child[n]).collect()
}

/// Returns the transformation from the node's coordinates to those of its parent.
fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: [f32; 3]| Vec3::from_array(v.map(f64::from));
    let rotation = node.rotation.unwrap_or_default().0.map(f64::from);
    let rotation = DQuat::from_array(rotation);
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(Vec3::ONE, vector),
        // In `f32` its length is 1 only up to rounding.
        if rotation.length_squared() > 0.0 {
            rotation.normalize()
        } else {
            DQuat::IDENTITY
        },
        node.translation.map_or(Vec3::ZERO, vector),
    )
}

fn node_content(
    root: &Root,
    node: &Node,
    world: DMat4,
    place: Place,
    placed: &mut Placed,
    builder: &mut SceneBuilder,
) -> Result<(), ReadError> {
    if let Some(mesh) = node.mesh {
        placed.meshes.push((mesh, world));
    }
    let none = "none of this number";
    if let Some(number) = node.camera {
        let camera = root.cameras.get(number.value());
        let camera = camera.ok_or_else(|| ReadError::at(place, "a camera", none))?;
        let camera = camera.perspective.as_ref().and_then(|p| {
            Some(PlacedCamera {
                from: world.transform_point3(Vec3::ZERO),
                forward: world.transform_vector3(Vec3::NEG_Z).try_normalize()?,
                up: world.transform_vector3(Vec3::Y).try_normalize()?,
                angle: f64::from(p.yfov).to_degrees(),
                aspect: f64::from(p.aspect_ratio.unwrap_or(1.0)),
                near: f64::from(p.znear),
            })
        });
        let why = match (&placed.camera, &camera) {
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
    let extension = node.extensions.as_ref();
    if let Some(named) = extension.and_then(|e| e.khr_lights_punctual.as_ref()) {
        let lights = root.extensions.as_ref();
        let lights = lights.and_then(|e| e.khr_lights_punctual.as_ref());
        let light = lights.and_then(|all| all.lights.get(named.light.value()));
        let light = light.ok_or_else(|| ReadError::at(place, "a light", none))?;
        placed.lights.extend(placed_light(light, world, place));
    }
    Ok(())
}

fn placed_light(light: &Light, world: DMat4, place: Place) -> Option<PlacedLight> {
    let Checked::Valid(kind) = light.type_ else {
        return None;
    };
    Some(PlacedLight {
        kind,
        color: Vec3::from_array(light.color.map(f64::from)),
        intensity: f64::from(light.intensity),
        position: world.transform_point3(Vec3::ZERO),
        direction: world
            .transform_vector3(Vec3::NEG_Z)
            .normalize_or(Vec3::NEG_Z),
        place,
    })
}
