//! Every reader on mutated files: no panic, no hang, no memory out of all proportion.
//!
//! `FUZZ_INPUTS=1000000 cargo test --release --test fuzz` runs more than the suite does; the inputs
//! are the same everywhere.

#[path = "support/random.rs"]
#[allow(dead_code)]
mod random;

use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::scene::format::{FORMATS, Input};
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

#[test]
fn readers_survive_mutated_files() {
    let inputs = std::env::var("FUZZ_INPUTS").map_or(INPUTS, |n| n.parse().unwrap());
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

/// Says at a panic which input it was.
struct Told(usize);

impl Drop for Told {
    fn drop(&mut self) {
        eprintln!("input {} panics", self.0);
    }
}
