//! Meshes in world space.

use super::accessor::{Elements, Shape};
use super::extensions::{INSTANCING, compressed};
use super::json::{Mesh, Primitive, Root, Whole};
use super::material::{self, Converted};
use super::nodes::{PlacedMesh, rotation};
use crate::geometry::Vec3;
use crate::progress::Progress;
use crate::scene::format::builder::MAX_FACES;
use crate::scene::format::builder::SceneBuilder;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use crate::scene::material::Material;
use crate::scene::note::NoteKind;
use glam::{DMat3, DMat4};
use std::borrow::Cow;

/// Triangles between two checks for cancellation.
const STEPS_PER_CHECK: usize = 4096;

/// The cost of a mesh part in triangles, even if it has none.
const STEPS_PER_PART: usize = 16;

/// Adds the triangles of every placed mesh.
pub(super) fn read(
    root: &Root,
    buffers: &[Cow<'_, [u8]>],
    placed: &[PlacedMesh],
    builder: &mut SceneBuilder,
    progress: &Progress,
) -> Result<(), ReadError> {
    let materials = material::all(&root.materials, builder);
    let mut reader = Reader {
        root,
        buffers,
        materials,
        builder,
        progress,
        steps: 0,
        points: 0,
    };
    for (done, placed_mesh) in placed.iter().enumerate() {
        let share = [done, done + 1].map(|n| n as f64 / placed.len() as f64);
        reader.placed(placed_mesh, share)?;
    }
    let Reader {
        builder, points, ..
    } = reader;
    if builder.faces() == 0 {
        builder.note_points(points);
    } else if points > 0 {
        let first = Place::Element("mesh", 0);
        builder.note_times(NoteKind::Skipped, "point (not a surface)", points, first);
    }
    Ok(())
}

struct Reader<'a, 'g> {
    root: &'a Root,
    buffers: &'a [Cow<'a, [u8]>],
    materials: Vec<Converted>,
    builder: &'g mut SceneBuilder,
    progress: &'a Progress,
    /// The work done so far, in triangles. A small file can place a mesh very often.
    steps: usize,
    /// Vertices of parts that consist of points.
    points: usize,
}

/// The copies of a mesh that `EXT_mesh_gpu_instancing` places.
struct Instances<'a> {
    count: usize,
    translations: Option<Elements<'a>>,
    rotations: Option<Elements<'a>>,
    scales: Option<Elements<'a>>,
}

impl<'a> Instances<'a> {
    fn of(
        root: &Root,
        buffers: &'a [Cow<'_, [u8]>],
        node: usize,
    ) -> Result<Instances<'a>, ReadError> {
        let place = Place::Element("node", node);
        let extension = root.nodes[node].extensions.get(INSTANCING);
        let attributes = extension.and_then(|e| e.get("attributes"));
        let mut counts = Vec::new();
        let mut attribute = |name: &str, shape| -> Result<_, ReadError> {
            let Some(value) = attributes.and_then(|all| all.get(name)) else {
                return Ok(None);
            };
            let index = Whole::of(value).map_or(usize::MAX, Whole::index);
            let elements = Elements::of(root, buffers, index, shape)?;
            counts.push(elements.len());
            Ok(Some(elements))
        };
        let translations = attribute("TRANSLATION", Shape::Vec3)?;
        let rotations = attribute("ROTATION", Shape::Vec4)?;
        let scales = attribute("SCALE", Shape::Vec3)?;
        let Some(&count) = counts.first() else {
            let expected = "translations, rotations or scales of instances";
            return Err(ReadError::at(place, expected, "none"));
        };
        if counts.iter().any(|other| *other != count) {
            let expected = "as many translations as rotations and scales of instances";
            return Err(ReadError::at(place, expected, "others"));
        }
        Ok(Instances {
            count,
            translations,
            rotations,
            scales,
        })
    }

    /// Returns the transformation of a copy to the coordinates of its node.
    fn to_node(&self, i: usize) -> DMat4 {
        let vector = |of: Option<Elements<'_>>| of.and_then(|elements| elements.vector(i));
        let turned = self.rotations.and_then(|elements| elements.four(i));
        DMat4::from_scale_rotation_translation(
            vector(self.scales).unwrap_or(Vec3::ONE),
            rotation(turned.unwrap_or_default()),
            vector(self.translations).unwrap_or(Vec3::ZERO),
        )
    }

    fn steps(&self) -> usize {
        let all = [self.translations, self.rotations, self.scales];
        all.iter().flatten().map(Elements::steps).sum()
    }
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

    /// Adds a placed mesh, or all copies of it; `share` is its interval of the progress.
    fn placed(&mut self, placed: &PlacedMesh, share: [f64; 2]) -> Result<(), ReadError> {
        let place = Place::Element("mesh", placed.mesh);
        let Some(mesh) = self.root.meshes.get(placed.mesh) else {
            let expected = format_args!("one of {} meshes", self.root.meshes.len());
            return Err(ReadError::at(place, expected, "none"));
        };
        let Some(node) = placed.instancing else {
            return self.mesh(mesh, &placed.to_world, place, share);
        };
        let instances = Instances::of(self.root, self.buffers, node)?;
        self.work(instances.steps(), place, share[0])?;
        for i in 0..instances.count {
            let at =
                |i: usize| share[0] + (i as f64 / instances.count as f64) * (share[1] - share[0]);
            // A mesh without parts is work, too.
            self.work(STEPS_PER_PART, place, at(i))?;
            let to_world = placed.to_world * instances.to_node(i);
            self.mesh(mesh, &to_world, place, [at(i), at(i + 1)])?;
        }
        Ok(())
    }

    fn mesh(
        &mut self,
        mesh: &'a Mesh,
        to_world: &DMat4,
        place: Place,
        share: [f64; 2],
    ) -> Result<(), ReadError> {
        let parts = mesh.primitives.len() as f64;
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let at = |i: usize| share[0] + (i as f64 / parts) * (share[1] - share[0]);
            self.part(primitive, to_world, place, [at(number), at(number + 1)])?;
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
            let corners = part.corners(triangle);
            let done = triangle as f64 / part.triangles as f64;
            let fraction = share[0] + done * (share[1] - share[0]);
            self.work(1, place, fraction)?;
            let (mut vertices, mut directions) = ([Vec3::ZERO; 3], [Vec3::ZERO; 3]);
            let numbers = corners.map(|corner| match part.indices {
                Some(indices) => indices.whole(corner),
                None => Some(corner),
            });
            let [a, b, c] = numbers;
            // Strips are joined by triangles with a repeated vertex, which are no faces.
            if part.mode == Mode::Strip && (a == b || b == c || c == a) {
                continue;
            }
            for (i, vertex) in numbers.into_iter().enumerate() {
                let position = vertex.and_then(|vertex| part.positions.vector(vertex));
                let (Some(vertex), Some(position)) = (vertex, position) else {
                    let expected = format_args!("indices below {}", part.positions.len());
                    return Err(ReadError::at(place, expected, "a larger one"));
                };
                vertices[i] = world.transform_point3(position);
                if let Some((normals, to_world)) = part.normals {
                    let normal = normals.vector(vertex).unwrap_or(Vec3::ZERO);
                    let direction = to_world * normal;
                    directions[i] = match direction.is_finite() {
                        true => direction.normalize_or_zero(),
                        false => direction,
                    };
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
        let attribute = |name: &str| {
            let value = primitive.attributes.get(name)?;
            Some(Whole::of(value).map_or(usize::MAX, Whole::index))
        };
        let Some(index) = attribute("POSITION") else {
            let text = "mesh part without positions";
            self.builder.note(NoteKind::Skipped, text, place);
            return Ok(None);
        };
        let positions = Elements::of(root, buffers, index, Shape::Vec3)?;
        self.work(positions.steps(), place, 0.0)?;
        let is_strange = |part: &Elements<'_>| part.are_absent() && part.len() > 0;
        if is_strange(&positions) {
            if let Some(error) = compressed(primitive.extensions.keys(), place) {
                return Err(error);
            }
            let text = "mesh part whose positions are not in the file";
            self.builder.note(NoteKind::Skipped, text, place);
            return Ok(None);
        }
        let mut indices = None;
        if let Some(index) = primitive.indices {
            let elements = Elements::of(root, buffers, index.index(), Shape::Scalar)?;
            self.work(elements.steps(), place, 0.0)?;
            if !elements.are_indices() {
                return Err(ReadError::at(place, "whole numbers as indices", "others"));
            }
            if is_strange(&elements) {
                let text = "mesh part whose indices are not in the file";
                self.builder.note(NoteKind::Skipped, text, place);
                return Ok(None);
            }
            indices = Some(elements);
        }
        let count = indices.map_or(positions.len(), |indices| indices.len());
        let (mode, triangles) = match primitive.mode.map_or(TRIANGLES, |mode| mode.0) {
            POINTS => {
                self.points = self.points.saturating_add(count);
                return Ok(None);
            }
            TRIANGLES => (Mode::List, count / 3),
            STRIP => (Mode::Strip, count.saturating_sub(2)),
            FAN => (Mode::Fan, count.saturating_sub(2)),
            _ => {
                let text = "lines (not surfaces)";
                self.builder.note(NoteKind::Skipped, text, place);
                return Ok(None);
            }
        };
        if !self.set_material(primitive, place) {
            let text = "mesh part that its alpha mask hides";
            self.builder.note(NoteKind::Skipped, text, place);
            return Ok(None);
        }
        if primitive.targets.is_some() {
            const TEXT: &str = "morph target; using the base mesh";
            self.builder.note(NoteKind::Skipped, TEXT, place);
        }
        if attribute("COLOR_0").is_some() {
            const TEXT: &str = "vertex colors (COLOR_0)";
            self.builder.note(NoteKind::Skipped, TEXT, place);
        }
        let normals = match attribute("NORMAL") {
            None => None,
            Some(index) => self.normals(index, positions.len(), world, place)?,
        };
        Ok(Some(Part {
            positions,
            normals,
            indices,
            mode,
            triangles,
        }))
    }

    /// Returns the normals with their transformation to world space; `None`, with a note, if they
    /// cannot be used.
    fn normals(
        &mut self,
        index: usize,
        vertices: usize,
        world: &DMat4,
        place: Place,
    ) -> Result<Option<(Elements<'a>, DMat3)>, ReadError> {
        let why = match Elements::of(self.root, self.buffers, index, Shape::Vec3) {
            Ok(elements) => {
                self.work(elements.steps(), place, 0.0)?;
                // The inverse transpose keeps normals perpendicular under non-uniform scaling.
                let to_world = DMat3::from_mat4(*world).inverse().transpose();
                if elements.len() >= vertices {
                    return Ok(to_world.is_finite().then_some((elements, to_world)));
                }
                format!("{} for {vertices} vertices", elements.len())
            }
            Err(reason) => reason.to_string(),
        };
        let text = format!("normals that cannot be read ({why}); using the face normals");
        self.builder.note(NoteKind::Changed, &text, place);
        Ok(None)
    }

    /// Sets the material of a part. Returns whether the part is visible.
    fn set_material(&mut self, primitive: &Primitive, place: Place) -> bool {
        let Some(number) = &primitive.material else {
            self.builder.set_material(Material::default());
            return true;
        };
        let number = Whole::of(number).map_or(usize::MAX, Whole::index);
        let Some(converted) = self.materials.get(number) else {
            let text = "material that does not exist; using matte white";
            self.builder.note(NoteKind::Defaulted, text, place);
            self.builder.set_material(Material::default());
            return true;
        };
        self.builder.set_material(converted.material);
        !converted.is_hidden
    }
}

// Numbers of the modes.
const POINTS: u64 = 0;
const TRIANGLES: u64 = 4;
const STRIP: u64 = 5;
const FAN: u64 = 6;

/// How triangles follow from a list of vertices.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    List,
    Strip,
    Fan,
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
            Mode::Strip if i % 2 == 1 => [i + 1, i, i + 2],
            Mode::Strip => [i, i + 1, i + 2],
            Mode::Fan => [0, i + 1, i + 2],
            _ => [3 * i, 3 * i + 1, 3 * i + 2],
        }
    }
}
