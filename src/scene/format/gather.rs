//! Gathers what a reader finds; faces become triangles and polygons, what cannot is counted.

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

/// The most objects and skipped faces that one file may come to, instances of a mesh included. So
/// many triangles take about 8 GiB.
pub const MOST_FACES: usize = 1 << 25;

/// The most vertices of a face; larger ones are skipped.
pub const MOST_VERTICES: usize = 1 << 20;

/// The most vertices of all polygons together.
const MOST_CORNERS: usize = 1 << 27;

/// The most vertices of a face that is split into triangles, which may take the square of that.
pub const MOST_VERTICES_SPLIT: usize = 10_000;

/// How many reasons are told apart; files may invent any number of them.
const MOST_REASONS: usize = 64;

/// The reason for what was left out or changed, how often, and where first.
struct Reason {
    kind: NoteKind,
    text: String,
    count: usize,
    first: Place,
}

/// What has been found so far.
#[derive(Default)]
pub(super) struct Gatherer {
    /// The first camera that counts; readers say where there are more.
    pub camera: Option<Camera>,
    pub background: Option<Vec3>,
    pub lights: Vec<Light>,
    pub notes: Vec<Note>,
    objects: Vec<Primitive>,
    material_of: Vec<u32>,
    materials: Vec<Material>,
    /// Where each material stands in `materials`, by the bits of its numbers.
    slots: HashMap<[u64; 8], u32>,
    /// The material of what follows.
    material: Material,
    /// Where it stands in `materials`, once an object has it.
    slot: Option<u32>,
    reasons: Vec<Reason>,
    faces: usize,
    /// Vertices of polygons.
    corners: usize,
}

impl Gatherer {
    /// The tight box around all objects so far.
    pub fn bounds(&self) -> Aabb {
        complete::bounds(&self.objects)
    }

    /// Makes room for objects that are known to follow.
    pub fn reserve(&mut self, objects: usize) {
        let objects = objects.min(MOST_FACES);
        self.objects.reserve_exact(objects);
        self.material_of.reserve_exact(objects);
    }

    /// The material of the objects that follow. Equal materials become one, and a material that no
    /// object has is left out.
    pub fn set_material(&mut self, material: Material) {
        self.material = material;
        self.slot = None;
    }

    /// Notes that something was left out or changed: counted by reason, the first place named.
    pub fn note(&mut self, kind: NoteKind, text: &str, place: Place) {
        let is_full = self.reasons.len() >= MOST_REASONS;
        for text in [text, OTHER_REASONS] {
            let known = |reason: &&mut Reason| reason.kind == kind && reason.text == text;
            if let Some(reason) = self.reasons.iter_mut().find(known) {
                reason.count += 1;
                return;
            }
            if !is_full || text == OTHER_REASONS {
                self.reasons.push(Reason {
                    kind,
                    text: text.to_owned(),
                    count: 1,
                    first: place,
                });
                return;
            }
        }
    }

    /// Adds a face: three vertices make a triangle, more a polygon, and a polygon off a plane
    /// several triangles. Without area it is skipped.
    ///
    /// # Errors
    /// Numbers that are not finite, or too many faces.
    pub fn face(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
    ) -> Result<(), ReadError> {
        if normals.is_some_and(|n| n.contains(&Vec3::ZERO)) {
            const TEXT: &str = "vertex normal without length, the face's own taken";
            self.note(NoteKind::Changed, TEXT, place);
        }
        if let &[a, b, c] = vertices {
            let normals = normals.map(|n| [n[0], n[1], n[2]]);
            let triangle = Triangle::new([a, b, c], normals).map(Primitive::Triangle);
            return self.object(place, "a triangle", triangle);
        }
        if vertices.len() > MOST_VERTICES {
            let text = format!("face of more than {MOST_VERTICES} vertices");
            return self.skip_face(place, &text);
        }
        self.corners += vertices.len();
        if self.corners > MOST_CORNERS {
            let most = format_args!("at most {MOST_CORNERS} vertices of polygons in a file");
            return Err(ReadError::at(place, most, "more"));
        }
        match Polygon::new(vertices.to_vec(), normals.map(<[Vec3]>::to_vec)) {
            Err(ShapeError::NotPlanar(_)) => self.split(place, vertices, normals),
            polygon => self.object(place, "a polygon", polygon.map(Primitive::Polygon)),
        }
    }

    /// Adds a face as triangles; those without area are left out silently.
    fn split(
        &mut self,
        place: Place,
        vertices: &[Vec3],
        normals: Option<&[Vec3]>,
    ) -> Result<(), ReadError> {
        if vertices.len() > MOST_VERTICES_SPLIT {
            let text =
                format!("polygon off a common plane with more than {MOST_VERTICES_SPLIT} vertices");
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
            const TEXT: &str = "polygon off a common plane split into triangles";
            self.note(NoteKind::Changed, TEXT, place);
            Ok(())
        } else {
            self.skip_face(place, WITHOUT_AREA)
        }
    }

    /// Adds an object of the current material, or skips it where it has no extent.
    ///
    /// # Errors
    /// Numbers that make no object, or too many objects.
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
                self.objects.push(object);
                self.material_of.push(material);
                Ok(())
            }
            Err(ShapeError::ZeroArea) => self.skip_face(place, WITHOUT_AREA),
            Err(ShapeError::NoLength) => self.skip_face(place, "cylinder or cone without length"),
            Err(reason) => Err(ReadError::at(
                place,
                format_args!("numbers that make {what}"),
                reason,
            )),
        }
    }

    /// Notes that a face is left out.
    ///
    /// # Errors
    /// Too many faces.
    pub fn skip_face(&mut self, place: Place, why: &str) -> Result<(), ReadError> {
        self.count_face(place)?;
        self.note(NoteKind::Skipped, why, place);
        Ok(())
    }

    fn count_face(&mut self, place: Place) -> Result<(), ReadError> {
        self.faces += 1;
        if self.faces > MOST_FACES {
            let most = format_args!("at most {MOST_FACES} objects in a file");
            return Err(ReadError::at(place, most, "more"));
        }
        Ok(())
    }

    /// Where the current material stands; it is entered when its first object is met.
    fn slot(&mut self) -> u32 {
        if let Some(slot) = self.slot {
            return slot;
        }
        let m = self.material;
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
        let materials = &mut self.materials;
        let slot = *self
            .slots
            .entry(numbers.map(f64::to_bits))
            .or_insert_with(|| {
                materials.push(m);
                (materials.len() - 1) as u32
            });
        self.slot = Some(slot);
        slot
    }

    /// The scene with a camera of its own, and what there is to say of it.
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

    /// The scene of a format without backgrounds that may lack camera and lights: they are made up,
    /// `up` being where upright things point.
    pub fn finish_mesh(mut self, up: Vec3) -> SceneParts {
        self.background = Some(complete::BACKGROUND);
        let text = "background: grey";
        self.notes.push(Note::new(NoteKind::MadeUp, text));
        let bounds = self.bounds();
        let camera = self.camera.unwrap_or_else(|| {
            let text = "no camera: one taken that frames all objects";
            self.notes.push(Note::new(NoteKind::MadeUp, text));
            complete::camera(&bounds, up)
        });
        let mut parts = self.finish(camera);
        complete::lights(&mut parts);
        parts
    }

    /// What the file itself holds, in a sentence.
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

const WITHOUT_AREA: &str = "polygon without area";
const OTHER_REASONS: &str = "other things";
