//! Tree files in the window.

use crate::harness::{enter_path, finish, has, open, small, wait, wait_for};
use crate::support::scenes::asset;

#[test]
fn trees_of_other_programs_become_the_tree_of_the_scene_on_view() {
    let mut window = open(small(asset("trimesh.obj").to_str().unwrap()));
    finish(&mut window);
    for program in ["obvhs", "embree", "three-mesh-bvh"] {
        let name = format!("trimesh-{program}.bstree");
        enter_path(&mut window, asset(&name).to_str().unwrap());
        wait(&mut window, &name, |w| has(w, &name));
        finish(&mut window);
        assert!(has(&window, &name), "{name}");
        assert!(!has(&window, "could not be done"), "{name}");
    }
}

#[test]
fn a_tree_of_another_scene_is_refused_and_a_bad_one_says_what_is_wrong() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let foreign = asset("trimesh-obvhs.bstree");
    enter_path(&mut window, foreign.to_str().unwrap());
    wait_for(&mut window, "a tree of 92 objects, but the scene has 11");

    // The last leaf refers to the first object instead of its own.
    let mut bytes = std::fs::read(&foreign).unwrap();
    let end = bytes.len();
    bytes[end - 4..].fill(0);
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.bstree");
    std::fs::write(&bad, bytes).unwrap();
    let mut window = open(small(asset("trimesh.obj").to_str().unwrap()));
    finish(&mut window);
    enter_path(&mut window, bad.to_str().unwrap());
    wait_for(&mut window, "is lost: no leaf refers to it");
}
