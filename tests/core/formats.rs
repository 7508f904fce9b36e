//! Scene formats: what is written reads back the same, and layout does not matter.

use bspscope::geometry::Vec3;
use bspscope::primitive::Primitive;
use bspscope::progress::Progress;
use bspscope::scene::builtin::{self, BUILTINS};
use bspscope::scene::format::{FORMATS, Input, nff, read_file};
use bspscope::scene::{Material, Note, NoteKind, SceneParts};
use std::path::{Path, PathBuf};

const VIEW: &str = "v\nfrom 0 -5 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 64 48\n";

fn read(text: &str) -> SceneParts {
    nff::read(text.as_bytes(), &Progress::new()).unwrap_or_else(|e| panic!("{e} in {text:?}"))
}

/// A file with a view, a background, and `rest`.
fn read_after_view(rest: &str) -> SceneParts {
    read(&format!("{VIEW}b 0 0 0\n{rest}"))
}

fn written(parts: &SceneParts) -> String {
    let mut bytes = Vec::new();
    nff::write(parts, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// The parts without what no file carries.
fn anonymous(parts: SceneParts) -> SceneParts {
    SceneParts {
        name: String::new(),
        notes: Vec::new(),
        ..parts
    }
}

/// What the reader says, but for what it found: its notes' texts.
fn said(parts: &SceneParts) -> Vec<&str> {
    let others = parts.notes.iter().filter(|n| n.kind != NoteKind::Read);
    others.map(|note| note.text.as_str()).collect()
}

#[test]
fn every_format_gives_back_every_generated_scene() {
    assert!(!FORMATS.is_empty() && !BUILTINS.is_empty());
    let mut written = 0;
    for format in FORMATS {
        let Some(write) = format.write else { continue };
        written += 1;
        for builtin in BUILTINS {
            for size in [*builtin.sizes.start(), builtin.default_size] {
                let parts = (builtin.generate)(size);
                assert_eq!(parts.name, format!("{}:{size}", builtin.name));
                let mut bytes = Vec::new();
                write(&parts, &mut bytes).unwrap();
                let input = Input::from(bytes.as_slice());
                let back = (format.read)(&input, &Progress::new()).unwrap();
                assert_eq!(said(&back), said(&parts), "{}", parts.name);
                let same = anonymous(back) == anonymous(parts);
                assert!(same, "{}:{size} through {}", builtin.name, format.name);
            }
        }
    }
    assert!(written > 0);
}

/// The folder of scene files and the files that belong there: scene and file name.
fn scene_files() -> (PathBuf, Vec<(SceneParts, String)>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = BUILTINS
        .iter()
        .map(|b| ((b.generate)(b.default_size), format!("{}.nff", b.name)))
        .collect();
    (folder, files)
}

/// With `UPDATE_SCENES=1` the files are written instead.
#[test]
fn scene_files_are_what_the_generators_write() {
    let update = std::env::var_os("UPDATE_SCENES").is_some_and(|value| value == "1");
    let (folder, files) = scene_files();
    assert!(!files.is_empty());
    for (parts, name) in files {
        let path = folder.join(&name);
        let text = written(&parts);
        if update {
            std::fs::write(&path, text).unwrap();
        } else {
            // A checkout may have turned line ends into CR LF.
            let file = std::fs::read_to_string(&path)
                .unwrap()
                .replace("\r\n", "\n");
            assert!(
                file == text,
                "{name} is out of date: run with UPDATE_SCENES=1"
            );
        }
    }
}

#[test]
fn a_scene_read_from_a_file_has_the_files_name() {
    let (folder, files) = scene_files();
    for (parts, name) in files {
        let read = read_file(&folder.join(&name), &Progress::new()).unwrap();
        assert_eq!(format!("{}.nff", read.name), name);
        assert!(anonymous(read) == anonymous(parts), "{name}");
    }
}

#[test]
fn line_ends_blanks_and_comments_do_not_matter() {
    let plain = written(&builtin::generate("teaching", None).unwrap());
    let expected = read(&plain);
    let variants = [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.trim_end().to_owned(),
        plain.replace(' ', "\t \t"),
        plain.replace('\n', "\n\n \t\n"),
        plain.replace('\n', " # 1 2 3 s 0 0 0 1\n"),
        plain.replace('\n', "#\n"),
        format!("\u{feff}{plain}"),
        format!("{plain}# no line end"),
        format!("# \u{e4}\u{20ac} and more\n{plain}"),
    ];
    for text in variants {
        assert!(read(&text) == expected, "{}", &text[..200]);
    }
    let in_one_line: Vec<_> = plain.lines().filter(|l| !l.starts_with('#')).collect();
    assert!(read(&in_one_line.join(" ")) == expected);
    assert!(read(&in_one_line.join("\n").replace(' ', "\n")) == expected);
}

#[test]
fn a_comment_that_is_not_utf8_is_skipped() {
    let text = [b"# \xff\xfe\n", VIEW.as_bytes()].concat();
    assert!(nff::read(&text, &Progress::new()).is_ok());
}

#[test]
fn a_view_is_read_as_it_stands() {
    let camera = read(VIEW).camera;
    assert_eq!(camera.from, Vec3::new(0.0, -5.0, 0.0));
    assert_eq!(camera.at, Vec3::ZERO);
    assert_eq!(camera.up, Vec3::Z);
    assert_eq!((camera.angle, camera.near), (45.0, 1.0));
    assert_eq!(camera.resolution, [64, 48]);
}

#[test]
fn a_light_has_a_colour_where_six_numbers_follow() {
    let lights = read_after_view("l 1 2 3\nl 4 5 6 .1 +.2 3e-1\nl -7 8\n9 s 0 0 0 1").lights;
    let colors: Vec<_> = lights.iter().map(|l| l.color).collect();
    assert_eq!(colors, [None, Some(Vec3::new(0.1, 0.2, 0.3)), None]);
    assert_eq!(lights[2].position, Vec3::new(-7.0, 8.0, 9.0));
}

#[test]
fn three_vertices_make_a_triangle_and_more_a_polygon() {
    let parts = read_after_view(
        "p 3\n0 0 0 1 0 0 0 1 0\np 4\n0 0 0 1 0 0 1 1 0 0 1 0\n\
         pp 3\n0 0 0 0 0 2 1 0 0 0 0 1 0 1 0 3 0 4\n\
         pp 4\n0 0 0 0 0 1 1 0 0 0 0 1 1 1 0 0 0 1 0 1 0 0 0 1\n",
    );
    let [
        Primitive::Triangle(flat),
        Primitive::Polygon(square),
        Primitive::Triangle(smooth),
        Primitive::Polygon(smooth_square),
    ] = parts.objects.as_slice()
    else {
        panic!("{:?}", parts.objects)
    };
    assert!(flat.normals.is_none() && square.vertex_normals().is_none());
    let normals = smooth.normals.as_deref().unwrap();
    assert_eq!(normals[0], Vec3::Z);
    assert!(normals[2].abs_diff_eq(Vec3::new(0.6, 0.0, 0.8), 1e-15));
    assert_eq!(smooth_square.vertex_normals().unwrap().len(), 4);
}

#[test]
fn equal_materials_are_one_and_unused_ones_are_left_out() {
    let [red, green] = ["f 1 0 0 1 0 0 0 1\n", "f 0 1 0 1 0 0 0 1\n"];
    let sphere = "s 0 0 0 1\n";
    let parts = read_after_view(
        &[
            green, red, sphere, red, sphere, green, sphere, red, sphere, green,
        ]
        .concat(),
    );
    assert_eq!(parts.material_of, [0, 0, 1, 0]);
    let colors: Vec<_> = parts.materials.iter().map(|m| m.color).collect();
    assert_eq!(colors, [Vec3::X, Vec3::Y]);
    assert_eq!(written(&parts).matches("\nf ").count(), 3);
}

#[test]
fn what_a_file_leaves_out_is_assumed_and_noted() {
    let parts = read(&format!("{VIEW}s 0 0 0 1\ns 0 0 0 2\n"));
    assert_eq!(parts.materials, [Material::default()]);
    assert_eq!(parts.background, Vec3::ZERO);
    assert_eq!(
        said(&parts),
        [
            "no background color in the file; using black",
            "no material before this object; using matte white, at line 8"
        ]
    );
    let empty = read_after_view("");
    assert!(empty.notes[0].text.starts_with("no objects"));
    assert!(empty.objects.is_empty() && empty.materials.is_empty());
}

#[test]
fn of_two_views_or_backgrounds_the_last_counts() {
    let second = VIEW.replace("angle 45", "angle 30");
    let parts = read_after_view(&format!("{second}b .5 .5 .5\ns 0 0 0 1"));
    assert_eq!(parts.camera.angle, 30.0);
    assert_eq!(parts.background, Vec3::splat(0.5));
    assert_eq!(
        said(&parts)[..2],
        [
            "view overridden by a later one, at line 9",
            "background overridden by a later one, at line 16"
        ]
    );
}

#[test]
fn objects_without_extent_are_skipped_and_noted() {
    let parts = read_after_view(
        "f 1 1 1 1 0 0 0 1\np 3\n0 0 0 1 1 1 2 2 2\np 4\n0 0 0 1 0 0 2 0 0 3 0 0\n\
         c 1 2 3 1 1 2 3 1\ns 0 0 0 1\n",
    );
    assert_eq!(parts.objects.len(), 1);
    assert_eq!(
        said(&parts),
        [
            "2 × polygon with zero area, first at line 10",
            "cylinder or cone with zero length, at line 14"
        ]
    );
}

#[test]
fn many_notes_of_one_kind_are_counted() {
    let flat = "p 3\n0 0 0 1 1 1 2 2 2\n".repeat(1000);
    let parts = read_after_view(&format!("{flat}f 1 1 1 1 0 0 0 1\ns 0 0 0 1"));
    assert_eq!(
        said(&parts),
        [
            "no material before this object; using matte white, at line 9",
            "1000 × polygon with zero area, first at line 9"
        ]
    );
}

#[test]
fn a_polygon_off_a_plane_becomes_triangles_with_its_normals() {
    let parts = read_after_view(
        "f 1 1 1 1 0 0 0 1\n\
         pp 4\n0 0 0 0 0 1\n1 0 0 0 1 0\n1 1 1 1 0 0\n0 1 0 0 0 -1\n",
    );
    assert_eq!(
        said(&parts),
        ["non-planar polygon split into triangles, at line 10"]
    );
    assert_eq!(parts.objects.len(), 2);
    for object in &parts.objects {
        let Primitive::Triangle(t) = object else {
            panic!("{object:?}")
        };
        let normals = t.normals.as_deref().unwrap();
        for (vertex, normal) in t.vertices.iter().zip(normals) {
            let expected = match vertex.to_array() {
                [0.0, 0.0, 0.0] => Vec3::Z,
                [1.0, 0.0, 0.0] => Vec3::Y,
                [1.0, 1.0, 1.0] => Vec3::X,
                _ => Vec3::NEG_Z,
            };
            assert_eq!(*normal, expected);
        }
    }
}

#[test]
fn a_vertex_normal_without_length_becomes_the_polygons_own() {
    let parts = read_after_view("f 1 1 1 1 0 0 0 1\npp 3\n0 0 0 1 0 0\n1 0 0 0 0 0\n0 1 0 0 1 0\n");
    let Primitive::Triangle(t) = &parts.objects[0] else {
        panic!("{:?}", parts.objects)
    };
    let normals = t.normals.as_deref().unwrap();
    assert_eq!(*normals, [Vec3::X, Vec3::Z, Vec3::Y]);
    assert_eq!(
        said(&parts),
        ["zero-length vertex normal; using the face normal, at line 10"]
    );
}

#[test]
fn a_file_read_and_written_reads_back_to_the_same_bits() {
    let parts = read_after_view(
        "l 0.1 1e-7 12345678.9 1 1 1\nf .1 .2 .3 .4 .5 3.0827 .7 1.333333333\n\
         s 0.333333333333 1e-320 -0 1e300\n\
         pp 3\n0 0 0 1 2 3\n.1 0 0 -1 1e-3 7\n0 .1 0 .1 .2 .3\n\
         c 1e15 2e16 3e17 .1 0 0 0 .2\n",
    );
    let back = read(&written(&parts));
    assert_eq!(back, parts);
    assert_eq!(written(&back), written(&parts));
}

#[test]
fn a_scene_name_with_line_ends_cannot_become_an_entity() {
    let mut parts = read_after_view("s 0 0 0 1");
    parts.name = "two\nlines\rand more".into();
    assert_eq!(read(&written(&parts)).objects, parts.objects);
}

#[test]
fn a_reconstruction_says_so_from_its_file_too() {
    for name in ["fluid", "m-fluid", "room"] {
        let parts = builtin::generate(name, None).unwrap();
        let path = scene_files().0.join(format!("{name}.nff"));
        let read = read_file(&path, &Progress::new()).unwrap();
        assert_eq!(said(&read), said(&parts), "{name}");
        assert!(said(&read)[0].starts_with("A reconstruction"), "{name}");
    }
    let parts = builtin::generate("balls", Some(1)).unwrap();
    let margins: Vec<_> = parts.notes.iter().map(Note::root_margin).collect();
    assert_eq!(margins, [Some(0.001)]);
}
