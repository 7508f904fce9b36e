//! Builds a scene from what a reader finds. Faces become triangles and polygons; faces that cannot
//! are skipped and counted.

use super::complete;
use super::error::ReadError;
use super::place::Place;
use crate::geometry::{Aabb, Vec3};
use crate::primitive::{Polygon, Primitive, PrimitiveKind, ShapeError, Triangle};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;
use std::collections::HashMap;

/// Maximum number of objects and skipped faces of a file, including instances of meshes.
///
/// A triangle takes at most [`BYTES_PER_TRIANGLE`], so this many take at most 11 GiB while a file
/// is read.
pub const MAX_FACES: usize = 1 << 25;

/// Maximum memory that a triangle with vertex normals takes, in bytes: the object, its material
/// index and its normals.
pub const BYTES_PER_TRIANGLE: usize = size_of::<Primitive>() + size_of::<u32>() + NORMALS;

/// While a file is read, lists may be a quarter longer than needed.
const _: () = assert!(MAX_FACES * BYTES_PER_TRIANGLE / 4 * 5 <= 11 << 30);

/// Bytes of three normals, with what an allocator adds to them.
const NORMALS: usize = size_of::<[Vec3; 3]>() + 16;

/// Maximum number of vertices of a face; larger faces are skipped.
pub const MAX_VERTICES: usize = 1 << 20;

/// Maximum number of vertices of all polygons together.
const MAX_CORNERS: usize = 1 << 27;

/// Maximum number of vertices of a face that is split into triangles. Splitting can take time
/// quadratic in it.
pub const MAX_SPLIT_VERTICES: usize = 10_000;

/// Maximum number of distinct reasons that are counted, because a file can cause arbitrarily many.
const MAX_REASONS: usize = 64;

/// Why something was skipped or changed, how often, and where first.
struct Reason {
    kind: NoteKind,
    text: String,
    count: usize,
    first: Place,
}

/// The scene as read so far.
#[derive(Default)]
pub(super) struct SceneBuilder {
    /// The camera to use; readers note further cameras.
    pub camera: Option<Camera>,
    pub background: Option<Vec3>,
    pub lights: Vec<Light>,
    pub notes: Vec<Note>,
    objects: Vec<Primitive>,
    material_of: Vec<u32>,
    materials: Vec<Material>,
    /// The index of each material in `materials`, by the bits of its numbers.
    slots: HashMap<[u64; 8], u32>,
    /// The current material.
    material: Current,
    /// Its index in `materials`, once an object uses it.
    slot: Option<u32>,
    /// For each named material in use, its number and its index in `materials`.
    named: HashMap<usize, u32>,
    reasons: Vec<Reason>,
    faces: usize,
    /// Vertices of polygons.
    corners: usize,
}

/// The material of the objects that follow.
enum Current {
    Known(Material),
    /// A material that is defined at the end, by its number.
    Named(usize),
}

impl Default for Current {
    fn default() -> Self {
        Current::Known(Material::default())
    }
}

impl SceneBuilder {
    /// Returns the number of objects and skipped faces so far.
    pub fn faces(&self) -> usize {
        self.faces
    }

    /// Returns the tight bounding box of all objects so far.
    pub fn bounds(&self) -> Aabb {
        complete::bounds(&self.objects)
    }

    /// Reserves memory for objects that are known to follow.
    pub fn reserve(&mut self, objects: usize) {
        let objects = objects.min(MAX_FACES);
        self.objects.reserve_exact(objects);
        self.material_of.reserve_exact(objects);
    }

    /// Sets the material of the objects that follow. Equal materials are merged, and unused
    /// materials are dropped.
    pub fn set_material(&mut self, material: Material) {
        self.material = Current::Known(material);
        self.slot = None;
    }

    /// Sets the material of the objects that follow to one that [`SceneBuilder::define`] defines
    /// once everything is read.
    pub fn set_named_material(&mut self, number: usize) {
        self.material = Current::Named(number);
        self.slot = self.named.get(&number).copied();
    }

    /// Defines the materials that [`SceneBuilder::set_named_material`] announced, each by its
    /// number. Equal materials are merged.
    pub fn define(&mut self, materials: &[Material]) {
        if self.named.is_empty() {
            return;
        }
        for (&number, &slot) in &self.named {
            self.materials[slot as usize] = materials[number];
        }
        self.named.clear();
        let (mut merged, mut slots) = (Vec::new(), HashMap::new());
        let new: Vec<u32> = self
            .materials
            .iter()
            .map(|m| merge(m, &mut merged, &mut slots))
            .collect();
        for slot in &mut self.material_of {
            *slot = new[*slot as usize];
        }
        (self.materials, self.slots, self.slot) = (merged, slots, None);
    }

    /// Notes that something was skipped or changed. Notes are counted by reason, with the position
    /// of the first.
    pub fn note(&mut self, kind: NoteKind, text: &str, place: Place) {
        self.note_times(kind, text, 1, place);
    }

    /// Notes that something was skipped or changed `times` times.
    pub fn note_times(&mut self, kind: NoteKind, text: &str, times: usize, place: Place) {
        if times == 0 {
            return;
        }
        let is_full = self.reasons.len() >= MAX_REASONS;
        for text in [text, OTHER_REASONS] {
            let known = |reason: &&mut Reason| reason.kind == kind && reason.text == text;
            if let Some(reason) = self.reasons.iter_mut().find(known) {
                reason.count += times;
                return;
            }
            if !is_full || text == OTHER_REASONS {
                self.reasons.push(Reason {
                    kind,
                    text: text.to_owned(),
                    count: times,
                    first: place,
                });
                return;
            }
        }
    }

    /// Adds a face: a triangle if it has three vertices, a polygon if it has more. A non-planar
    /// polygon is split into triangles. A face with zero area is skipped.
    ///
    /// A normal of zero length, or one that is not finite, is replaced by that of the face.
    ///
    /// # Errors
    /// A coordinate is not finite, or there are too many faces.
    pub fn face(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
    ) -> Result<(), ReadError> {
        self.note_normals(place, normals);
        self.face_as_noted(place, vertices, normals)
    }

    /// Adds a face as [`SceneBuilder::face`] does, but splits a polygon into triangles if one of its
    /// normals has no direction, so that only the triangles at its vertex change.
    pub fn face_or_triangles(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
    ) -> Result<(), ReadError> {
        match normals {
            Some(given) if vertices.len() > 3 && !given.iter().all(|n| is_direction(*n)) => {
                self.note_normals(place, normals);
                const TEXT: &str = "polygon with a normal of no direction split into triangles";
                self.split(place, vertices, repaired(given).as_deref(), TEXT)
            }
            _ => self.face(place, vertices, normals),
        }
    }

    /// Notes normals without a direction.
    fn note_normals(&mut self, place: Place, normals: Option<&[Vec3]>) {
        let given = normals.unwrap_or_default();
        let infinite = given.iter().any(|n| !n.is_finite());
        let zero = given.contains(&Vec3::ZERO);
        for (there, text) in [(infinite, INFINITE_NORMAL), (zero, ZERO_NORMAL)] {
            self.note_times(NoteKind::Changed, text, usize::from(there), place);
        }
    }

    /// Adds a face as [`SceneBuilder::face`] does, but without notes on its normals.
    pub fn face_as_noted(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
    ) -> Result<(), ReadError> {
        let replacement;
        let mut normals = normals;
        if let Some(given) = normals
            && !given.iter().all(|n| is_direction(*n))
        {
            replacement = repaired(given);
            normals = replacement.as_deref();
        }
        if let &[a, b, c] = vertices {
            let normals = normals.map(|n| [n[0], n[1], n[2]]);
            let triangle = Triangle::new([a, b, c], normals).map(Primitive::Triangle);
            return self.object(place, "a triangle", triangle);
        }
        if vertices.len() > MAX_VERTICES {
            let text = format!("face of more than {MAX_VERTICES} vertices");
            return self.skip_face(place, &text);
        }
        self.corners += vertices.len();
        if self.corners > MAX_CORNERS {
            let most = format_args!("at most {MAX_CORNERS} vertices of polygons in a file");
            return Err(ReadError::at(place, most, "more"));
        }
        match Polygon::new(vertices.to_vec(), normals.map(<[Vec3]>::to_vec)) {
            Err(ShapeError::NotPlanar(_)) => {
                const TEXT: &str = "non-planar polygon split into triangles";
                self.split(place, vertices, normals, TEXT)
            }
            polygon => self.object(place, "a polygon", polygon.map(Primitive::Polygon)),
        }
    }

    /// Adds a face as triangles, noted with this text; triangles with zero area are dropped silently.
    fn split(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
        text: &'static str,
    ) -> Result<(), ReadError> {
        if vertices.len() > MAX_SPLIT_VERTICES {
            let text = format!("polygon to split, of more than {MAX_SPLIT_VERTICES} vertices");
            return self.skip_face(place, &text);
        }
        let before = self.objects.len();
        for numbers in Polygon::triangulate(vertices) {
            let corners = numbers.map(|i| vertices[i as usize]);
            let normals = normals.map(|n| numbers.map(|i| n[i as usize]));
            match Triangle::new(corners, normals) {
                Err(ShapeError::ZeroArea) => {}
                triangle => self.object(place, "a triangle", triangle.map(Primitive::Triangle))?,
            }
        }
        if self.objects.len() > before {
            self.note(NoteKind::Changed, text, place);
            Ok(())
        } else {
            self.skip_face(place, ZERO_AREA)
        }
    }

    /// Adds an object with the current material, or skips it if it is degenerate.
    ///
    /// # Errors
    /// The numbers do not define an object, or there are too many objects.
    pub fn object(
        &mut self,
        place: Place,
        what: &str,
        object: Result<Primitive, ShapeError>,
    ) -> Result<(), ReadError> {
        match object {
            Ok(object) => {
                self.count_face(place)?;
                let material = self.slot();
                push(&mut self.objects, object);
                push(&mut self.material_of, material);
                Ok(())
            }
            Err(ShapeError::ZeroArea) => self.skip_face(place, ZERO_AREA),
            Err(ShapeError::NoLength) => self.skip_face(place, "cylinder or cone with zero length"),
            Err(reason) => Err(ReadError::at(
                place,
                format_args!("numbers that define {what}"),
                reason,
            )),
        }
    }

    /// Notes that a face is skipped.
    ///
    /// # Errors
    /// There are too many faces.
    pub fn skip_face(&mut self, place: Place, why: &str) -> Result<(), ReadError> {
        self.count_face(place)?;
        self.note(NoteKind::Skipped, why, place);
        Ok(())
    }

    /// Notes in one line that a file has points but no faces.
    pub fn note_points(&mut self, points: usize) {
        if points > 0 {
            let are = if points == 1 { "point" } else { "points" };
            let text = format!("{points} {are}, no faces");
            self.notes.push(Note::new(NoteKind::Skipped, text));
        }
    }

    fn count_face(&mut self, place: Place) -> Result<(), ReadError> {
        self.faces += 1;
        if self.faces > MAX_FACES {
            let most = format_args!("at most {MAX_FACES} objects in a file");
            return Err(ReadError::at(place, most, "more"));
        }
        Ok(())
    }

    /// Returns the index of the current material, which is added with its first object.
    fn slot(&mut self) -> u32 {
        if let Some(slot) = self.slot {
            return slot;
        }
        let slot = match self.material {
            Current::Known(material) => merge(&material, &mut self.materials, &mut self.slots),
            Current::Named(number) => {
                let slot = self.materials.len() as u32;
                self.materials.push(Material::default());
                self.named.insert(number, slot);
                slot
            }
        };
        self.slot = Some(slot);
        slot
    }

    /// Returns the scene, with the given camera and the load report.
    pub fn finish(mut self, camera: Camera) -> SceneParts {
        let found = Note::new(NoteKind::Read, self.found());
        self.notes.insert(0, found);
        for reason in std::mem::take(&mut self.reasons) {
            let Reason { text, first, .. } = reason;
            let text = match reason.count {
                1 => format!("{text}, at {first}"),
                count => format!("{count} × {text}, first at {first}"),
            };
            self.notes.push(Note::new(reason.kind, text));
        }
        self.objects.shrink_to_fit();
        self.material_of.shrink_to_fit();
        SceneParts {
            name: String::new(),
            objects: self.objects,
            material_of: self.material_of,
            materials: self.materials,
            lights: self.lights,
            background: self.background.unwrap_or(Vec3::ZERO),
            camera,
            notes: self.notes,
        }
    }

    /// Returns the scene of a format without background colors, with default camera and lights if
    /// it has none. `up` is the format's up direction.
    pub fn finish_mesh(mut self, up: Vec3) -> SceneParts {
        self.background = Some(complete::BACKGROUND);
        let text = "no background color in the file; using gray";
        self.notes.push(Note::new(NoteKind::Defaulted, text));
        let bounds = self.bounds();
        let camera = self.camera.unwrap_or_else(|| {
            let text = "no camera in the file; using one that frames all objects";
            self.notes.push(Note::new(NoteKind::Defaulted, text));
            complete::camera(&bounds, up)
        });
        let mut parts = self.finish(camera);
        complete::lights(&mut parts);
        parts
    }

    /// Returns what the file contains, in one sentence.
    fn found(&self) -> String {
        let mut counts = [0_usize; PrimitiveKind::ALL.len()];
        for object in &self.objects {
            counts[object.kind() as usize] += 1;
        }
        let mut words: Vec<_> = PrimitiveKind::ALL
            .into_iter()
            .zip(counts)
            .filter(|(_, count)| *count > 0)
            .map(|(kind, count)| format!("{}: {count}", kind.plural()))
            .collect();
        if words.is_empty() {
            words.push("no objects".into());
        }
        for (what, count) in [
            ("materials in use", self.materials.len()),
            ("lights", self.lights.len()),
            ("cameras", usize::from(self.camera.is_some())),
        ] {
            words.push(format!("{what}: {count}"));
        }
        words.join(", ")
    }
}

/// Adds an item to a list. A long list grows by a quarter at a time instead of doubling.
fn push<T>(list: &mut Vec<T>, item: T) {
    const LONG: usize = 1 << 16;
    let length = list.len();
    if length == list.capacity() && length >= LONG {
        list.reserve_exact(length / 4);
    }
    list.push(item);
}

/// Returns the index of a material in `materials`, where it is added if no equal one is there.
fn merge(m: &Material, materials: &mut Vec<Material>, slots: &mut HashMap<[u64; 8], u32>) -> u32 {
    let [r, g, b] = m.color.to_array();
    let numbers = [
        r,
        g,
        b,
        m.diffuse,
        m.specular,
        m.shine,
        m.transmittance,
        m.index_of_refraction,
    ];
    *slots.entry(numbers.map(f64::to_bits)).or_insert_with(|| {
        materials.push(*m);
        (materials.len() - 1) as u32
    })
}

/// Returns the normals with zero in place of those without a direction; `None` if none has one.
fn repaired(normals: &[Vec3]) -> Option<Vec<Vec3>> {
    let direction = |n: &Vec3| if is_direction(*n) { *n } else { Vec3::ZERO };
    let any = normals.iter().any(|n| is_direction(*n));
    any.then(|| normals.iter().map(direction).collect())
}

/// Returns whether a normal has a direction.
fn is_direction(normal: Vec3) -> bool {
    normal.is_finite() && normal != Vec3::ZERO
}

pub(super) const INFINITE_NORMAL: &str = "vertex normal that is not finite; using the face normal";
const ZERO_NORMAL: &str = "zero-length vertex normal; using the face normal";
const ZERO_AREA: &str = "polygon with zero area";
const OTHER_REASONS: &str = "other reasons";
