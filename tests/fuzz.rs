//! Every reader on mutated files: no panic, no hang, no memory out of all proportion.
//!
//! `FUZZ_INPUTS=1000000 cargo test --release --test fuzz` runs more than the suite does; the inputs
//! are the same everywhere.

#[path = "support/random.rs"]
#[allow(dead_code)]
mod random;

use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::exact::ExactKernel;
use bspscope::primitive::Precision;
use bspscope::progress::Progress;
use bspscope::scene::format::{BYTES_PER_TRIANGLE, FORMATS, Input};
use bspscope::scene::{Material, Scene, SceneRequest, load};
use bspscope::structure::tree_file::{self, Origin};
use bspscope::structure::{BuildSettings, MaxDepth, Method, RootMargin, build, validate};
use random::Random;
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// How many inputs the suite tries per format.
const INPUTS: usize = 5000;

/// The most bytes that reading one file may hold at once.
const MOST_MEMORY: usize = 1 << 30;

/// Far more than any of these small files takes, on the busiest machine.
const HANG: Duration = Duration::from_secs(60);

/// Counts the bytes that are held.
struct Counted;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST_HELD: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is passed on to the system's allocator as it came.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST_HELD.fetch_max(held, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // Large blocks are moved without a copy.
        let held = HELD.fetch_add(size, Ordering::Relaxed) + size - layout.size();
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        MOST_HELD.fetch_max(held, Ordering::Relaxed);
        unsafe { System.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counted = Counted;

/// Words that readers stumble over.
const WORDS: &[&str] = &[
    "0",
    "-0",
    "-1",
    "1e308",
    "1e309",
    "-1e-320",
    "nan",
    "inf",
    "4294967296",
    "18446744073709551616",
    "999999999",
    "3",
    "v",
    "b",
    "l",
    "f",
    "c",
    "s",
    "p",
    "pp",
    "from",
    "at",
    "#",
    "\0",
    "\u{fe0f}",
    "usemtl",
    "vn",
    "1//1",
    "-1/-1/-1",
    "\\",
    "solid",
    "vertex",
    "endloop",
    "endsolid",
    "element vertex 4294967295\n",
    "property list uchar int vertex_indices\n",
    "end_header\n",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"children\":[0],",
    "\"byteOffset\":4294967295,",
    "\"count\":9007199254740993,",
    "-1.#IND",
    "1.0D+02",
    "4.0",
    "/*",
    "*/",
    "\n",
    "\"",
    "facet",
    "outer loop",
    "end loop",
    "mtllib",
    "newmtl",
    "Kd",
    "element tristrips 3\n",
    "%3D",
    "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{\"bufferView\":0}},",
    "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":0}}},",
];

fn mutate(file: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len() + 1);
        let to = (at + random.below(40)).min(bytes.len());
        match random.below(7) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..to)),
            2 => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
            3 => {
                let word = format!(" {} ", WORDS[random.below(WORDS.len())]);
                drop(bytes.splice(at..at, word.into_bytes()));
            }
            4 => {
                // A whole word in place of another.
                let is_space = |i: &usize| bytes[*i].is_ascii_whitespace();
                let from = (0..at).rev().find(is_space).map_or(0, |i| i + 1);
                let to = (at..bytes.len()).find(is_space).unwrap_or(bytes.len());
                let word = WORDS[random.below(WORDS.len())];
                drop(bytes.splice(from..to, word.bytes()));
            }
            5 => {
                let part = bytes[at..to].to_vec();
                let place = random.below(bytes.len() + 1);
                drop(bytes.splice(place..place, part));
            }
            _ => {
                let from = random.below(other.len() + 1);
                let to = (from + random.below(200)).min(other.len());
                drop(bytes.splice(at..at, other[from..to].iter().copied()));
            }
        }
    }
    bytes
}

fn corpus(extensions: &[&str]) -> Vec<Vec<u8>> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut files: Vec<_> = ["fuzz_corpus", "assets"]
        .into_iter()
        .flat_map(|folder| std::fs::read_dir(tests.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|e| extensions.iter().any(|x| e == *x))
        })
        .collect();
    files.sort();
    files
        .iter()
        .map(|path| std::fs::read(path).unwrap())
        .collect()
}

/// How many inputs are tried per format.
fn inputs() -> usize {
    std::env::var("FUZZ_INPUTS").map_or(INPUTS, |n| n.parse().unwrap())
}

/// Keeps the other tests waiting, because they share the count of bytes.
fn alone() -> std::sync::MutexGuard<'static, ()> {
    static ALONE: std::sync::Mutex<()> = std::sync::Mutex::new(());
    ALONE
        .lock()
        .unwrap_or_else(|poisoned| poisoned.into_inner())
}

#[test]
fn readers_survive_mutated_files() {
    let _alone = alone();
    let inputs = inputs();
    for format in FORMATS {
        let corpus = corpus(format.extensions);
        assert!(corpus.len() >= 2, "no corpus for {}", format.name);
        let (mut read, mut refused) = (0, 0);
        for i in 0..inputs {
            let mut random = Random(i as u64);
            let file = &corpus[random.below(corpus.len())];
            let other = &corpus[random.below(corpus.len())];
            let bytes = mutate(file, other, &mut random);
            let (start, before) = (Instant::now(), HELD.load(Ordering::Relaxed));
            MOST_HELD.store(before, Ordering::Relaxed);
            // Told if this input ends the process.
            let told = Told(i);
            match (format.read)(&Input::from(bytes.as_slice()), &Progress::new()) {
                Ok(parts) => {
                    read += 1;
                    drop(Scene::new(parts));
                }
                Err(error) => {
                    refused += 1;
                    assert!(!error.to_string().is_empty());
                }
            }
            std::mem::forget(told);
            let most = MOST_HELD.load(Ordering::Relaxed) - before;
            assert!(most < MOST_MEMORY, "input {i} took {most} bytes");
            assert!(
                start.elapsed() < HANG,
                "input {i} took {:?}",
                start.elapsed()
            );
        }
        eprintln!(
            "{}: {inputs} inputs, {read} read, {refused} refused",
            format.name
        );
        // Mutations of every depth: some files survive them, some do not.
        assert!(read > inputs / 50 && refused > inputs / 50);
    }
}

/// Replaces up to four words of four bytes, mostly by small numbers and by limits of types.
fn change_words(file: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = file.to_vec();
    let data = 64 * bytes.iter().position(|&b| b == b'\n').unwrap().div_ceil(64);
    let words = (bytes.len() - data) / 4;
    for _ in 0..=random.below(4) {
        let at = data + 4 * random.below(words);
        let limits = [
            0,
            1,
            0x7fff_ffff,
            u32::MAX,
            0x7f80_0000,
            0x7fc0_0000,
            0xff7f_ffff,
        ];
        let value = match random.below(3) {
            0 => random.below(200) as u32,
            1 => random.one_of(&limits),
            _ => random.bits() as u32,
        };
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    }
    bytes
}

/// Validates and traverses the tree of a file, whatever it is.
fn trace(scene: &Scene, file: &Path) {
    let progress = Progress::new();
    let settings = BuildSettings::for_method(Method::named(file.to_str().unwrap()).unwrap());
    let tree = build(scene, &settings, &progress).unwrap();
    // Bad trees are read, too.
    let _ = validate(scene, &tree);
    let from = scene.bounds().center() + Vec3::splat(9.0);
    let directions = (0..8_u32).map(|i| Vec3::new(-1.0, f64::from(i) / -7.0, -1.0));
    let rays: Vec<Ray> = directions
        .map(|direction| Ray::new(from, direction))
        .collect();
    for kernel in ExactKernel::all() {
        kernel.answers(scene, &tree, Precision::F32, &rays, &progress);
    }
}

/// What can be read is a tree that can be traversed.
#[test]
fn tree_files_survive_mutations() {
    /// One of so many trees that could be read is traversed.
    const TRACED: usize = 64;
    let _alone = alone();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/assets/trimesh.obj");
    let request = SceneRequest::parse(mesh.to_str().unwrap());
    let (scene, progress) = (load(&request, &Progress::new()).unwrap(), Progress::new());
    let mut corpus = corpus(&["bstree"]);
    assert!(corpus.len() >= 3);
    for method in [
        "midpoint",
        "sah-cut",
        "octree",
        "grid",
        "bvh-sweep",
        "bvh-spatial",
    ] {
        // Small files are read sooner.
        let settings = BuildSettings {
            d_max: MaxDepth::Fixed(6),
            ..BuildSettings::for_method(Method::named(method).unwrap())
        };
        let tree = build(&scene, &settings, &progress).unwrap();
        let mut bytes = Vec::new();
        tree_file::write(&tree, &scene, &Origin::default(), &mut bytes).unwrap();
        corpus.push(bytes);
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mutated.bstree");
    let (mut read, mut refused) = (0, 0);
    for i in 0..inputs() {
        let mut random = Random(i as u64);
        let original = &corpus[random.below(corpus.len())];
        let other = &corpus[random.below(corpus.len())];
        let bytes = match random.below(4) {
            0 => mutate(original, other, &mut random),
            _ => change_words(original, &mut random),
        };
        let (start, before) = (Instant::now(), HELD.load(Ordering::Relaxed));
        MOST_HELD.store(before, Ordering::Relaxed);
        let told = Told(i);
        match tree_file::read(&bytes, &scene, RootMargin::Automatic, &progress) {
            Ok(_) => {
                read += 1;
                if read % TRACED == 0 {
                    std::fs::write(&file, bytes).unwrap();
                    trace(&scene, &file);
                }
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
        std::mem::forget(told);
        let most = MOST_HELD.load(Ordering::Relaxed).saturating_sub(before);
        assert!(most < MOST_MEMORY, "input {i} took {most} bytes");
        assert!(start.elapsed() < HANG, "input {i}: {:?}", start.elapsed());
    }
    eprintln!("trees: {} inputs, {read} read, {refused} refused", inputs());
    assert!(read > inputs() / 50 && refused > inputs() / 50);
}

/// Whatever a material file contains, the geometry of the file that refers to it is read.
#[test]
fn material_files_never_refuse_the_geometry() {
    let _alone = alone();
    let inputs = inputs();
    let corpus = corpus(&["mtl"]);
    assert!(corpus.len() >= 2);
    let folder = tempfile::tempdir().unwrap();
    let text = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl late\nf 1 2 3\n";
    let obj = FORMATS.iter().find(|f| f.name == "obj").unwrap();
    let mut changed = 0;
    for i in 0..inputs {
        let mut random = Random(i as u64);
        let file = &corpus[random.below(corpus.len())];
        let other = &corpus[random.below(corpus.len())];
        let bytes = mutate(file, other, &mut random);
        std::fs::write(folder.path().join("a.mtl"), &bytes).unwrap();
        let told = Told(i);
        let input = Input {
            bytes: text,
            folder: Some(folder.path()),
        };
        let parts = (obj.read)(&input, &Progress::new()).unwrap();
        std::mem::forget(told);
        assert_eq!(parts.objects.len(), 1, "input {i}");
        let material = parts.materials[0];
        assert!(material.color.is_finite() && material.shine.is_finite());
        changed += usize::from(material != Material::default());
    }
    eprintln!("mtl: {inputs} inputs, {changed} with a material");
    assert!(changed > inputs / 50);
}

/// Reading a file that places a mesh many times takes no more than the stated memory per triangle.
#[test]
fn instances_stay_within_the_stated_memory() {
    let _alone = alone();
    const NODES: usize = 500;
    const TRIANGLES: usize = 1000;
    let mut binary = Vec::new();
    for i in 0..TRIANGLES {
        let x = i as f32;
        for number in [x, 0.0, 0.0, x + 1.0, 0.0, 0.0, x, 1.0, 0.0] {
            binary.extend(number.to_le_bytes());
        }
    }
    let positions = binary.len();
    binary.extend(
        [0.0_f32, 0.0, 1.0]
            .repeat(3 * TRIANGLES)
            .iter()
            .flat_map(|n| n.to_le_bytes()),
    );
    let uri = percent(&binary);
    let accessor = |offset: usize| {
        format!(
            "{{\"bufferView\":0,\"byteOffset\":{offset},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\"}}",
            3 * TRIANGLES
        )
    };
    let json = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}],\"meshes\":[{{\"primitives\":[{{\
         \"attributes\":{{\"POSITION\":0,\"NORMAL\":1}}}}]}}],\"accessors\":[{},{}],\
         \"bufferViews\":[{{\"buffer\":0,\"byteLength\":{length}}}],\
         \"buffers\":[{{\"byteLength\":{length},\"uri\":\"data:,{uri}\"}}]}}",
        vec!["{\"mesh\":0}"; NODES].join(","),
        accessor(0),
        accessor(positions),
        length = binary.len(),
    );
    let format = FORMATS.iter().find(|f| f.name == "gltf").unwrap();
    let before = HELD.load(Ordering::Relaxed);
    MOST_HELD.store(before, Ordering::Relaxed);
    let parts = (format.read)(&Input::from(json.as_bytes()), &Progress::new()).unwrap();
    assert_eq!(parts.objects.len(), NODES * TRIANGLES);
    let most = MOST_HELD.load(Ordering::Relaxed) - before;
    // While it grows, the list of objects may be a quarter longer than needed.
    let stated = parts.objects.len() * BYTES_PER_TRIANGLE * 5 / 4 + 4 * json.len();
    assert!(most <= stated, "{most} bytes, more than {stated}");
}

/// Bytes in the form of a data URI without base64.
fn percent(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("%{byte:02x}")).collect()
}

/// Says at a panic which input it was.
struct Told(usize);

impl Drop for Told {
    fn drop(&mut self) {
        eprintln!("input {} panics", self.0);
    }
}
