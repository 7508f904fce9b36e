//! `room`: a furnished room, all polygons, as exported by a CAD system. A reconstruction: the data
//! of the paper were never published.
//!
//! The original has 7788 polygons and the figures of the paper's Tables 4 and 6, which reveal more
//! than it seems. With method 1, R_FVWV of 12 % and 8 references per leaf mean that 150,000 deepest
//! leaves are where the bounding boxes of about ten slanted polygons coincide: a sloping roof in
//! layers. With method 2, 5.4 references per leaf and R_FVWV of 41 % mean closed boxes that are not
//! split. So furniture, walls and goods on shelves are boxes of thin sheets (an outer and an inner
//! skin).

use super::entry::{Builtin, SPD_BACKGROUND, reconstruction_note};
use super::percent_g::round_point;
use crate::geometry::Vec3;
use crate::primitive::{Polygon, Primitive};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "room",
    about: "A furnished room under a sloping roof: a reconstruction of the scene in the paper",
    default_size: 1,
    sizes: 1..=1,
    generate,
};

/// As many as in the paper.
const POLYGONS: usize = 7788;
/// Faces of a box.
const FACES: usize = 6;

/// Width (x), depth (y) and height (z) inside the walls, in meters. The top of the floor is z = 0.
const WIDTH: f64 = 5.0;
const DEPTH: f64 = 4.0;
const HEIGHT: f64 = 2.4;
const FLOOR: f64 = 0.35;
const WALL: f64 = 0.3;
/// Thickness of the sheets of hollow objects.
const SKIN: f64 = 0.004;

/// The roof: number of layers, thickness of a layer, and rise toward the back. The rise is chosen
/// to match R_BBSC of the paper.
const LAYERS: u32 = 6;
const LAYER: f64 = 0.005;
const RISE: f64 = 0.1315;

/// Number of shelves above each of the four cupboards, and the height of a shelf.
const SHELVES: u32 = 4;
const SHELF: f64 = 1.3 / SHELVES as f64;

/// Seed of the pseudo-random heights of the goods on the shelves.
const SEED: u32 = 7;

/// Indices of the materials.
const STONE: u32 = 0;
const WOOD: u32 = 1;
const PAINT: u32 = 2;
const GOODS: u32 = 3;

fn generate(size: u32) -> SceneParts {
    let mut room = Room::default();
    room.shell();
    room.table(1.2, -1.0, [1.6, 0.8, 0.74]);
    for place in 0..6 {
        room.chair(place);
    }
    room.furniture();
    room.roof();
    let shelves = room.cupboards();
    room.goods(&shelves);
    SceneParts {
        name: format!("room:{size}"),
        objects: room.objects,
        material_of: room.material_of,
        materials: materials(),
        lights: [(3.0, -6.0, 6.0), (-2.0, -4.0, 2.0), (2.0, -1.0, 2.2)]
            .map(|position| Light {
                position: position.into(),
                color: None,
            })
            .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(4.5, -8.0, 3.0),
            at: Vec3::new(-0.2, 0.0, 1.0),
            up: Vec3::Z,
            angle: 44.56,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![reconstruction_note("room")],
    }
}

fn materials() -> Vec<Material> {
    let material = |r, g, b, specular| Material {
        color: Vec3::new(r, g, b),
        diffuse: 0.8,
        specular,
        shine: 30.0,
        ..Material::default()
    };
    vec![
        material(0.85, 0.83, 0.78, 0.0),
        material(0.65, 0.42, 0.22, 0.1),
        material(0.35, 0.55, 0.6, 0.15),
        material(0.85, 0.45, 0.3, 0.05),
    ]
}

/// A cuboid: the center of its base, and its size.
#[derive(Clone, Copy)]
struct Cuboid {
    base: Vec3,
    size: Vec3,
}

impl Cuboid {
    fn new(x: f64, y: f64, z: f64, size: [f64; 3]) -> Self {
        Cuboid {
            base: Vec3::new(x, y, z),
            size: size.into(),
        }
    }

    /// Returns the inner cuboid, smaller by a skin on all sides.
    fn inner(&self) -> Cuboid {
        Cuboid {
            base: self.base + Vec3::Z * SKIN,
            size: self.size - 2.0 * SKIN,
        }
    }

    /// Returns the corner on the sides given by −1 and 1.
    fn corner(&self, side: [f64; 3]) -> Vec3 {
        let [x, y, z] = side;
        self.base + Vec3::new(x * 0.5, y * 0.5, (z + 1.0) * 0.5) * self.size
    }
}

/// The corners of each face of a cuboid, counter-clockwise from outside.
const CORNERS: [[[f64; 3]; 4]; FACES] = {
    const fn corner(number: u8) -> [f64; 3] {
        const fn side(bit: u8) -> f64 {
            if bit == 0 { -1.0 } else { 1.0 }
        }
        [side(number & 1), side(number & 2), side(number & 4)]
    }
    const fn face(a: u8, b: u8, c: u8, d: u8) -> [[f64; 3]; 4] {
        [corner(a), corner(b), corner(c), corner(d)]
    }
    [
        face(0, 2, 3, 1),
        face(4, 5, 7, 6),
        face(0, 1, 5, 4),
        face(1, 3, 7, 5),
        face(3, 2, 6, 7),
        face(2, 0, 4, 6),
    ]
};

#[derive(Default)]
struct Room {
    objects: Vec<Primitive>,
    material_of: Vec<u32>,
}

impl Room {
    fn faces(&mut self, material: u32, corner: impl Fn([f64; 3]) -> Vec3) {
        for face in CORNERS {
            let corners = face.map(|side| round_point(corner(side)));
            let polygon = Polygon::new(corners.to_vec(), None);
            self.objects.push(Primitive::Polygon(
                polygon.expect("the corners of a face lie in a plane and span an area"),
            ));
            self.material_of.push(material);
        }
    }

    fn solid(&mut self, material: u32, cuboid: Cuboid) {
        self.faces(material, |side| cuboid.corner(side));
    }

    fn hollow(&mut self, material: u32, cuboid: Cuboid) {
        self.solid(material, cuboid);
        self.solid(material, cuboid.inner());
    }

    /// Adds floor, back wall and left wall; the other sides are open.
    fn shell(&mut self) {
        let height = HEIGHT + FLOOR;
        for cuboid in [
            Cuboid::new(0.0, 0.0, -FLOOR, [WIDTH, DEPTH, FLOOR]),
            Cuboid::new(0.0, (DEPTH + WALL) * 0.5, -FLOOR, [WIDTH, WALL, height]),
            Cuboid::new(
                -(WIDTH + WALL) * 0.5,
                WALL * 0.5,
                -FLOOR,
                [WALL, DEPTH + WALL, height],
            ),
        ] {
            self.hollow(STONE, cuboid);
        }
    }

    /// A board on four legs.
    fn table(&mut self, x: f64, y: f64, [width, depth, height]: [f64; 3]) {
        let under = height - 0.03;
        self.solid(WOOD, Cuboid::new(x, y, under, [width, depth, 0.03]));
        for [u, v] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            let (x, y) = (x + u * (width * 0.5 - 0.03), y + v * (depth * 0.5 - 0.03));
            self.solid(WOOD, Cuboid::new(x, y, 0.0, [0.04, 0.04, under]));
        }
    }

    /// The chairs stand on both sides of the table in turn.
    fn chair(&mut self, place: u32) {
        let side = if place.is_multiple_of(2) { -1.0 } else { 1.0 };
        let x = 1.2 + (f64::from(place / 2) - 1.0) * 0.5;
        let y = -1.0 + side * 0.6;
        self.table(x, y, [0.42, 0.42, 0.46]);
        self.solid(
            WOOD,
            Cuboid::new(x, y + side * 0.19, 0.46, [0.42, 0.03, 0.5]),
        );
    }

    /// Adds a couch, two cabinets in the corners, and a chest.
    fn furniture(&mut self) {
        for cuboid in [
            Cuboid::new(-1.5, -1.0, 0.0, [1.7, 1.8, 1.0]),
            Cuboid::new(2.0, 1.45, 0.0, [0.95, 1.0, 1.5]),
            Cuboid::new(-2.0, 1.45, 0.0, [0.9, 1.0, 1.5]),
            Cuboid::new(0.0, -1.2, 0.0, [0.8, 0.9, 0.8]),
        ] {
            self.hollow(PAINT, cuboid);
        }
    }

    /// Adds sheared boxes, stacked on top of each other.
    fn roof(&mut self) {
        for layer in 0..LAYERS {
            let z = HEIGHT + f64::from(layer) * LAYER * 1.02;
            let sheet = Cuboid::new(0.0, 0.0, z, [WIDTH + 0.9, DEPTH + 0.7, LAYER]);
            self.faces(STONE, |side| {
                sheet.corner(side) + Vec3::Z * (RISE * (side[1] + 1.0) * 0.5)
            });
        }
    }

    /// Adds four cupboards at the back wall with shelves above them; returns the center of each
    /// shelf.
    fn cupboards(&mut self) -> Vec<Vec3> {
        let mut shelves = Vec::new();
        for cupboard in 0..4 {
            let x = -1.3 + 0.85 * f64::from(cupboard);
            self.hollow(WOOD, Cuboid::new(x, 1.7, 0.0, [0.8, 0.55, 0.85]));
            for side in [-0.4, 0.4] {
                self.solid(WOOD, Cuboid::new(x + side, 1.84, 1.0, [0.015, 0.3, 1.35]));
            }
            for level in 0..=SHELVES {
                let z = 1.0 + f64::from(level) * SHELF;
                self.solid(WOOD, Cuboid::new(x, 1.84, z, [0.78, 0.3, 0.015]));
                if level < SHELVES {
                    shelves.push(Vec3::new(x, 1.84, z + 0.015));
                }
            }
        }
        shelves
    }

    /// Adds boxes side by side on the shelves until the number of polygons is reached. If it is
    /// odd, one more box stands on the table.
    fn goods(&mut self, shelves: &[Vec3]) {
        let left = (POLYGONS - self.objects.len()) / FACES;
        if left % 2 == 1 {
            self.solid(GOODS, Cuboid::new(1.2, -1.0, 0.74, [0.3, 0.3, 0.3]));
        }
        let boxes = left / 2;
        let mut random = Random(SEED);
        for (i, shelf) in shelves.iter().enumerate() {
            let from = boxes * i / shelves.len();
            let count = boxes * (i + 1) / shelves.len() - from;
            let pitch = 0.76 / count as f64;
            for k in 0..count {
                let x = shelf.x - 0.38 + (k as f64 + 0.5) * pitch;
                let height = (SHELF - 0.02) * (0.7 + 0.25 * random.next());
                self.hollow(
                    GOODS,
                    Cuboid::new(x, shelf.y, shelf.z, [pitch, 0.3, height]),
                );
            }
        }
    }
}

/// Pseudo-random numbers from 0 to 1 (linear congruential generator with the constants of D. Knuth,
/// The Art of Computer Programming 2, 3.3.4, line 16).
struct Random(u32);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1u32 << 24)
    }
}
