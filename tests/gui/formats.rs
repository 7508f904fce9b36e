//! Scene files of every format in the window, and what the reader says of them.

use crate::harness::{enter_path, finish, has, open, open_pane, small, wait};
use crate::support::scenes::asset;
use bspscope::scene::format::FORMATS;
use egui_kittest::kittest::Queryable as _;
use std::path::Path;

#[test]
fn files_of_every_format_are_opened_by_the_path_field() {
    let mut window = open(small("balls:1"));
    open_pane(&mut window, "Scene");
    finish(&mut window);
    for (name, title, kinds) in [
        ("trimesh.glb", "trimesh", "triangles: 92"),
        ("meshio.obj", "meshio", "polygons: 5"),
        ("trimesh.stl", "trimesh", "triangles: 92"),
        ("meshio-text.ply", "meshio-text", "triangles: 6"),
        ("polygons.nff", "polygons", "polygons: 5"),
    ] {
        enter_path(&mut window, asset(name).to_str().unwrap());
        wait(&mut window, name, |w| {
            w.query_by_label(title).is_some() && has(w, kinds)
        });
        finish(&mut window);
        let extension = Path::new(name).extension().unwrap().to_str().unwrap();
        let format = FORMATS.iter().find(|f| f.extensions.contains(&extension));
        let said = format!("{} file of ", format.unwrap().name.to_uppercase());
        assert!(has(&window, &said), "{name}");
    }
}

#[test]
fn the_load_report_says_what_was_read_skipped_and_defaulted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("faulty.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nl 1 2\nf 1 2 3\nf 2 2 3\n";
    std::fs::write(&file, text).unwrap();
    let mut window = open(small(file.to_str().unwrap()));
    open_pane(&mut window, "Scene");
    finish(&mut window);
    for text in [
        "Load report",
        "OBJ file of",
        "2 × polygon with zero area, first at line 4",
        "line (not a surface), at line 5",
        "no camera in the file; using one that frames all objects",
        "no light in the file; using two",
    ] {
        assert!(has(&window, text), "{text}");
    }
}

#[test]
fn a_file_that_is_no_scene_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("letter.txt");
    std::fs::write(&file, "Dear all,\nthis is no scene.\n").unwrap();
    let mut window = open(small(file.to_str().unwrap()));
    wait(&mut window, "the message", |w| {
        has(w, "could not be opened")
    });
    assert!(has(
        &window,
        "neither the extension nor the content is that of a scene file"
    ));
}
