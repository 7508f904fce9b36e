//! Meshes in world space.

use super::accessor::Elements;
use super::material;
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::format::builder::MAX_FACES;
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use glam::{DMat3, DMat4};
use gltf_json::accessor::Type;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Index, Mesh, Root};
use std::borrow::Cow;

/// Triangles between two checks for cancellation.
const STEPS_PER_CHECK: usize = 4096;

/// The cost of a mesh part in triangles, even if it has none.
const STEPS_PER_PART: usize = 16;

/// Adds the triangles of every placed mesh.
pub(super) fn read(
    root: &Root,
    buffers: &[Cow<'_, [u8]>],
    placed: &[(Index<Mesh>, DMat4)],
    builder: &mut SceneBuilder,
    progress: &Progress,
) -> Result<(), ReadError> {
    for (number, material) in root.materials.iter().enumerate() {
        for _ in 0..material::textures(material) {
            let place = Place::Element("material", number);
            builder.note(NoteKind::Skipped, "texture", place);
        }
    }
    let mut reader = Reader {
        root,
        buffers,
        builder,
        progress,
        steps: 0,
    };
    for (done, (mesh, world)) in placed.iter().enumerate() {
        let place = Place::Element("mesh", mesh.value());
        let Some(mesh) = root.meshes.get(mesh.value()) else {
            let expected = format_args!("one of {} meshes", root.meshes.len());
            return Err(ReadError::at(place, expected, "none"));
        };
        for (part, primitive) in mesh.primitives.iter().enumerate() {
            let parts = (placed.len() * mesh.primitives.len()) as f64;
            let at = (done * mesh.primitives.len() + part) as f64;
            let share = [at / parts, (at + 1.0) / parts];
            reader.part(primitive, world, place, share)?;
        }
    }
    Ok(())
}

struct Reader<'a, 'g> {
    root: &'a Root,
    buffers: &'a [Cow<'a, [u8]>],
    builder: &'g mut SceneBuilder,
    progress: &'a Progress,
    /// The work done so far, in triangles. A small file can place a mesh very often.
    steps: usize,
}

impl<'a> Reader<'a, '_> {
    /// Counts work that takes as long as `steps` triangles.
    fn work(&mut self, steps: usize, place: Place, fraction: f64) -> Result<(), ReadError> {
        let before = self.steps / STEPS_PER_CHECK;
        self.steps += steps;
        if self.steps / STEPS_PER_CHECK > before {
            self.progress.check()?;
            self.progress.set(fraction);
        }
        if self.steps > 2 * MAX_FACES {
            let most = format_args!("at most {} mesh parts and triangles", 2 * MAX_FACES);
            return Err(ReadError::at(place, most, "more"));
        }
        Ok(())
    }

    /// Adds a part of a mesh; `share` is its interval of the progress.
    fn part(
        &mut self,
        primitive: &Primitive,
        world: &DMat4,
        place: Place,
        share: [f64; 2],
    ) -> Result<(), ReadError> {
        self.work(STEPS_PER_PART, place, share[0])?;
        let Some(part) = self.checked(primitive, world, place)? else {
            return Ok(());
        };
        for triangle in 0..part.triangles {
            let done = triangle as f64 / part.triangles as f64;
            let fraction = share[0] + done * (share[1] - share[0]);
            self.work(1, place, fraction)?;
            let (mut vertices, mut directions) = ([Vec3::ZERO; 3], [Vec3::ZERO; 3]);
            for (i, corner) in part.corners(triangle).into_iter().enumerate() {
                let vertex = match part.indices {
                    Some(indices) => indices.whole(corner),
                    None => Some(corner),
                };
                let position = vertex.and_then(|vertex| part.positions.vector(vertex));
                let (Some(vertex), Some(position)) = (vertex, position) else {
                    let expected = format_args!("indices below {}", part.positions.len());
                    return Err(ReadError::at(place, expected, "a larger one"));
                };
                vertices[i] = world.transform_point3(position);
                if let Some((normals, to_world)) = part.normals {
                    let Some(normal) = normals.vector(vertex) else {
                        return Err(ReadError::at(place, "a normal for every vertex", "fewer"));
                    };
                    directions[i] = (to_world * normal).normalize_or_zero();
                }
            }
            let directions = part.normals.is_some().then_some(&directions[..]);
            self.builder.face(place, &vertices, directions)?;
        }
        Ok(())
    }

    /// Checks a part and sets its material. Returns `None`, with a note, if it cannot be used.
    fn checked(
        &mut self,
        primitive: &Primitive,
        world: &DMat4,
        place: Place,
    ) -> Result<Option<Part<'a>>, ReadError> {
        let (root, buffers) = (self.root, self.buffers);
        let mut skipped = |what: &str| {
            self.builder.note(NoteKind::Skipped, what, place);
            Ok(None)
        };
        let accessor = |index, wanted| Elements::of(root, buffers, index, wanted);
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(index) = attribute(Semantic::Positions) else {
            return skipped("mesh part without positions");
        };
        const SPARSE: &str = "mesh part with sparse accessors";
        let Some(positions) = accessor(index, Type::Vec3)? else {
            return skipped(SPARSE);
        };
        let mut normals = None;
        if let Some(index) = attribute(Semantic::Normals) {
            let Some(elements) = accessor(index, Type::Vec3)? else {
                return skipped(SPARSE);
            };
            // The inverse transpose keeps normals perpendicular under non-uniform scaling.
            let linear = DMat3::from_mat4(*world);
            let to_world = linear.inverse().transpose();
            normals = to_world.is_finite().then_some((elements, to_world));
        }
        let mut indices = None;
        if let Some(index) = primitive.indices {
            indices = accessor(index, Type::Scalar)?;
            match &indices {
                None => return skipped(SPARSE),
                Some(elements) if elements.are_indices() => {}
                Some(_) => {
                    return Err(ReadError::at(place, "whole numbers as indices", "others"));
                }
            }
        }
        let count = indices.map_or(positions.len(), |indices| indices.len());
        let (mode, triangles) = match primitive.mode {
            Checked::Valid(Mode::Triangles) => (Mode::Triangles, count / 3),
            Checked::Valid(mode @ (Mode::TriangleStrip | Mode::TriangleFan)) => {
                (mode, count.saturating_sub(2))
            }
            _ => return skipped("lines or points (not surfaces)"),
        };
        if primitive.targets.is_some() {
            const TEXT: &str = "morph target; using the base mesh";
            self.builder.note(NoteKind::Skipped, TEXT, place);
        }
        let material = primitive.material.map(|m| root.materials.get(m.value()));
        self.builder.set_material(match material {
            None => Material::default(),
            Some(Some(material)) => material::of(material),
            Some(None) => {
                return Err(ReadError::at(place, "a material", "none of this number"));
            }
        });
        Ok(Some(Part {
            positions,
            normals,
            indices,
            mode,
            triangles,
        }))
    }
}

/// A mesh part whose accessors and material all exist.
struct Part<'a> {
    positions: Elements<'a>,
    /// With their transformation to world space.
    normals: Option<(Elements<'a>, DMat3)>,
    /// `None` if the positions are used in order.
    indices: Option<Elements<'a>>,
    mode: Mode,
    triangles: usize,
}

impl Part<'_> {
    /// Returns the corners of a triangle, as positions in the index list.
    fn corners(&self, triangle: usize) -> [usize; 3] {
        let i = triangle;
        match self.mode {
            // Every other triangle of a strip has the opposite orientation.
            Mode::TriangleStrip if i % 2 == 1 => [i + 1, i, i + 2],
            Mode::TriangleStrip => [i, i + 1, i + 2],
            Mode::TriangleFan => [0, i + 1, i + 2],
            _ => [3 * i, 3 * i + 1, 3 * i + 2],
        }
    }
}
