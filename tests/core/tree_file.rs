//! Tree files: every structure written and read again, and what is said of broken ones.

use crate::support::scenes::{self, scene, tree_with};
use bspscope::measure::{DELTA, measure, parameter, sample_rays, unsplit};
use bspscope::measure::{answer, compare};
use bspscope::primitive::Precision;
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::tree_file::{FaultKind, Origin, TreeFileError, write};
use bspscope::structure::{BuildError, BuildSettings, Constants, Method, Tree, build, validate};
use bspscope::trace::{RenderSettings, thread_pool};
use std::path::Path;

/// Writes a tree to a file in a folder and returns the settings that read it.
fn settings_of_file(scene: &Scene, tree: &Tree, folder: &Path, name: &str) -> BuildSettings {
    let mut bytes = Vec::new();
    write(tree, scene, &Origin::default(), &mut bytes).unwrap();
    of_bytes(&bytes, &folder.join(name))
}

fn of_bytes(bytes: &[u8], path: &Path) -> BuildSettings {
    std::fs::write(path, bytes).unwrap();
    BuildSettings::for_method(Method::named(path.to_str().unwrap()).unwrap())
}

fn methods() -> Vec<BuildSettings> {
    let mut all: Vec<BuildSettings> = Method::all().map(|m| scenes::settings(m.name)).collect();
    for width in [3.0, 8.0] {
        for method in Method::all().filter(|m| m.constants.iter().any(|c| c.name == "width")) {
            all.push(BuildSettings {
                constants: Constants::from([("width".to_owned(), width)]),
                ..scenes::settings(method.name)
            });
        }
    }
    all
}

#[test]
fn every_tree_is_the_same_when_it_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["teaching", "balls:2", "rings:1", "m-fluid:1"] {
        let scene = scene(name);
        for (i, settings) in methods().into_iter().enumerate() {
            let tree = tree_with(&scene, &settings);
            let file = format!("{}-{i}.bstree", scene.name().replace(':', "-"));
            let again = settings_of_file(&scene, &tree, folder.path(), &file);
            let read = build(&scene, &again, &Progress::new()).unwrap();
            let said = format!("{name}, {settings:?}");
            assert!(read.nodes() == tree.nodes(), "{said}");
            assert_eq!(read.references(), tree.references(), "{said}");
            assert_eq!(read.frame(), tree.frame(), "{said}");
            assert_eq!(read.depth_reached(), tree.depth_reached(), "{said}");
            assert_eq!(read.voxels().is_some(), tree.voxels().is_some(), "{said}");
            assert_eq!(read.bytes(), tree.bytes(), "{said}");
            assert!(read.faults().is_empty(), "{said}: {}", read.faults());
            validate(&scene, &read).unwrap();
        }
    }
}

#[test]
fn the_seven_counts_are_those_of_the_tree_that_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("balls:2");
    let render = RenderSettings {
        width: 48,
        height: 48,
        ..RenderSettings::default()
    };
    for (i, settings) in methods().into_iter().enumerate() {
        let of = |settings: &BuildSettings| {
            let measured = measure(&scene, settings, &render, &Progress::new()).unwrap();
            let values = DELTA.map(|symbol| parameter(symbol).value(&measured.measurement));
            (measured.tree, values)
        };
        let (tree, expected) = of(&settings);
        let again = settings_of_file(&scene, &tree, folder.path(), &format!("{i}.bstree"));
        assert_eq!(of(&again).1, expected, "{settings:?}");
    }
}

/// A file of one inner node with two leaves, of a scene with three objects, as another program may write it.
struct Small {
    header: String,
    columns: Vec<(&'static str, Vec<u32>)>,
    boxes: Vec<f32>,
}

impl Small {
    fn new(scene: &Scene) -> Small {
        let bounds = scene.bounds();
        let corners = [bounds.lo, bounds.hi].map(|corner| corner.to_array().map(|c| c as f32));
        let around = corners.concat();
        let objects = scene.objects().len() as u32;
        Small {
            header: format!("\"kind\":\"bvh\",\"objects\":{objects}"),
            columns: vec![
                ("leaf", vec![0, 1, 1]),
                ("first", vec![0, 0, 2]),
                ("count", vec![2, 2, objects - 2]),
                ("child", vec![1, 2]),
                ("ref", (0..objects).collect()),
            ],
            boxes: around.repeat(3),
        }
    }

    fn set(mut self, name: &str, index: usize, value: u32) -> Small {
        let column = self.columns.iter_mut().find(|column| column.0 == name);
        column.unwrap().1[index] = value;
        self
    }

    fn bytes(&self) -> Vec<u8> {
        let (mut data, mut arrays) = (Vec::new(), Vec::new());
        for (name, numbers) in &self.columns {
            let (kind, length) = (if *name == "leaf" { "u8" } else { "u32" }, numbers.len());
            arrays.push(format!("[\"{name}\",\"{kind}\",[{length}],{}]", data.len()));
            for number in numbers {
                match *name {
                    "leaf" => data.push(*number as u8),
                    _ => data.extend(number.to_le_bytes()),
                }
            }
        }
        let rows = self.boxes.len() / 6;
        arrays.push(format!("[\"box\",\"f32\",[{rows},6],{}]", data.len()));
        data.extend(self.boxes.iter().flat_map(|number| number.to_le_bytes()));
        let (header, arrays) = (&self.header, arrays.join(","));
        let mut file =
            format!("{{\"format\":\"bstree\",\"version\":1,{header},\"arrays\":[{arrays}]}}\n")
                .into_bytes();
        file.resize(file.len().next_multiple_of(64), b' ');
        file.extend(data);
        file
    }
}

/// Builds the tree of a file for the scene `teaching`.
fn read(file: &Small) -> Result<Tree, TreeFileError> {
    let folder = tempfile::tempdir().unwrap();
    let settings = of_bytes(&file.bytes(), &folder.path().join("small.bstree"));
    build(&scene("teaching"), &settings, &Progress::new()).map_err(|error| match error {
        BuildError::File { reason, .. } => reason,
        other => panic!("{other}"),
    })
}

#[test]
fn a_small_file_of_another_program_is_read() {
    let tree = read(&Small::new(&scene("teaching"))).unwrap();
    assert!(tree.faults().is_empty(), "{}", tree.faults());
    validate(&scene("teaching"), &tree).unwrap();
    assert_eq!(tree.nodes().len(), 3);
}

#[test]
fn a_broken_tree_is_refused_with_every_kind_of_fault_and_its_first_place() {
    let small = || Small::new(&scene("teaching"));
    for (file, kind, said) in [
        (
            small().set("child", 1, 0),
            FaultKind::Cycle,
            "node 0: child 0 is the node itself",
        ),
        (
            small().set("child", 1, 1),
            FaultKind::TwoParents,
            "node 0: child 1 is also the child",
        ),
        (
            small().set("child", 0, 9),
            FaultKind::ChildIndex,
            "node 0: child 9 is not one of 3",
        ),
        (
            small().set("first", 0, 7),
            FaultKind::ChildIndex,
            "node 0: 2 children from 7 on",
        ),
        (
            small().set("count", 0, 1),
            FaultKind::ChildCount,
            "node 0 has 1 children",
        ),
        (
            small().set("leaf", 2, 7),
            FaultKind::LeafFlag,
            "node 2: leaf is 7",
        ),
        (
            small().set("ref", 5, 99),
            FaultKind::ObjectIndex,
            "leaf 2 refers to object 99",
        ),
        (
            small().set("first", 2, 11),
            FaultKind::ReferenceIndex,
            "references from 11 on",
        ),
        (
            small().set("first", 2, 0).set("count", 2, 12),
            FaultKind::ReferenceIndex,
            "shares",
        ),
    ] {
        let Err(TreeFileError::Broken(faults)) = read(&file) else {
            panic!("{said}: not refused as broken");
        };
        let fault = faults.list().iter().find(|fault| fault.kind == kind);
        let fault = fault
            .unwrap_or_else(|| panic!("{said}: {faults}"))
            .to_string();
        assert!(fault.contains(said), "{fault}");
    }
    let mut file = small();
    file.boxes[8] = f32::NAN;
    file.boxes[13] = f32::INFINITY;
    let error = read(&file).unwrap_err().to_string();
    assert!(
        error.contains("node 1: its box is [") && error.contains("and 1 more"),
        "{error}"
    );
    // Both kinds of faults are reported at once.
    let both = read(&small().set("ref", 0, 99).set("child", 1, 9)).unwrap_err();
    assert!(matches!(both, TreeFileError::Broken(faults) if faults.list().len() == 2));
}

#[test]
fn files_that_are_no_trees_of_the_scene_say_why() {
    let small = || Small::new(&scene("teaching"));
    let mut other_scene = small();
    other_scene.header = "\"kind\":\"bvh\",\"objects\":13".into();
    let mut without = small();
    without.columns.remove(4);
    let mut short = small();
    short.columns[1].1.pop();
    let mut kd = small();
    kd.header = "\"kind\":\"kd\",\"objects\":12".into();
    for (file, said) in [
        (other_scene, "a tree of 13 objects, but the scene has 12"),
        (without, "array 'ref': missing"),
        (
            short,
            "array 'first': expected 3 rows of 1, found the shape [2]",
        ),
        (kd, "the root cell: missing"),
    ] {
        let error = read(&file).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    let cut = &small().bytes()[..200];
    let folder = tempfile::tempdir().unwrap();
    let settings = of_bytes(cut, &folder.path().join("cut.bstree"));
    assert!(build(&scene("teaching"), &settings, &Progress::new()).is_err());
    let missing = Method::named("no/such/file.bstree").unwrap();
    let missing = BuildSettings::for_method(missing);
    let error = build(&scene("teaching"), &missing, &Progress::new()).unwrap_err();
    assert!(
        error.to_string().starts_with("no/such/file.bstree: "),
        "{error}"
    );
}

/// Such trees are read, so that their rays can be shown to miss.
#[test]
fn a_bad_tree_is_read_and_its_faults_are_listed() {
    let teaching = scene("teaching");
    let mut shrunk = Small::new(&teaching);
    for number in &mut shrunk.boxes[6..12] {
        *number *= 0.01;
    }
    let mut outside = Small::new(&teaching);
    outside.boxes[6] -= 5.0;
    for (file, kind, said) in [
        (
            Small::new(&teaching).set("ref", 3, 2),
            FaultKind::Lost,
            "object 3 is lost",
        ),
        (
            Small::new(&teaching).set("ref", 3, 2),
            FaultKind::Repeated,
            "leaf 2 refers to an object twice",
        ),
        (
            shrunk,
            FaultKind::Uncovered,
            "extends beyond the boxes of its leaves",
        ),
        (outside, FaultKind::Outside, "beyond that of its parent 0"),
    ] {
        let tree = read(&file).unwrap();
        let fault = tree.faults().list().iter().find(|fault| fault.kind == kind);
        let fault = fault.unwrap_or_else(|| panic!("{said}: {}", tree.faults()));
        assert!(fault.to_string().contains(said), "{fault}");
    }
}

/// Boxes that are too small do not matter, because they are computed anew; a lost object does.
#[test]
fn only_lost_objects_lose_hits() {
    let teaching = scene("teaching");
    let (pool, progress) = (thread_pool(2).unwrap(), Progress::new());
    let everything = unsplit(&teaching, &progress).unwrap();
    let render = RenderSettings::default();
    let sample = sample_rays(&teaching, &everything, &render, 2000, &pool, &progress).unwrap();
    let trace =
        |tree: &Tree| answer(&teaching, tree, Precision::F64, &sample, &pool, &progress).unwrap();
    let expected = trace(&everything);
    let mut shrunk = Small::new(&teaching);
    shrunk.boxes[6..].fill(0.0);
    let found = trace(&read(&shrunk).unwrap());
    assert!(compare(&teaching, &sample, &expected, &found, None).is_identical());
    let lost = Small::new(&teaching).set("ref", 3, 2);
    let found = trace(&read(&lost).unwrap());
    let result = compare(&teaching, &sample, &expected, &found, None);
    assert!(
        result.tree_wrong > 0 && result.every_object_wrong == 0,
        "{result:?}"
    );
}

/// Each is the tree that `examples/export_*` writes for `trimesh.obj`.
#[test]
fn trees_of_other_programs_are_valid_and_their_hits_are_right() {
    let mesh = scene(scenes::asset("trimesh.obj").to_str().unwrap());
    let (pool, progress) = (thread_pool(2).unwrap(), Progress::new());
    let everything = unsplit(&mesh, &progress).unwrap();
    let render = RenderSettings::default();
    let sample = sample_rays(&mesh, &everything, &render, 1000, &pool, &progress).unwrap();
    let trace =
        |tree: &Tree| answer(&mesh, tree, Precision::F64, &sample, &pool, &progress).unwrap();
    let expected = trace(&everything);
    for (program, width) in [("obvhs", 2.0), ("embree", 4.0), ("three-mesh-bvh", 2.0)] {
        let file = scenes::asset(&format!("trimesh-{program}.bstree"));
        let method = Method::named(file.to_str().unwrap()).unwrap();
        let settings = BuildSettings::for_method(method);
        assert_eq!(settings.constant("width"), width, "{program}");
        let tree = build(&mesh, &settings, &progress).unwrap();
        assert!(tree.faults().is_empty(), "{program}: {}", tree.faults());
        assert!(tree.nodes().len() > 10, "{program}");
        validate(&mesh, &tree).unwrap();
        let result = compare(&mesh, &sample, &expected, &trace(&tree), None);
        assert!(result.is_identical(), "{program}: {result:?}");
    }
}
