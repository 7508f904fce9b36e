//! Files that other programs write and open although a specification forbids them: what is
//! unambiguous is read, and what was changed or ignored is reported.

use base64::Engine;
use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Shape};
use bspscope::progress::Progress;
use bspscope::scene::format::{FORMATS, FormatError, Input, ReadError, read_file};
use bspscope::scene::{Material, NoteKind, SceneParts};
use serde_json::{Value, json};
use std::path::Path;

fn try_read(format: &str, bytes: &[u8]) -> Result<SceneParts, ReadError> {
    let format = FORMATS.iter().find(|f| f.name == format).unwrap();
    (format.read)(&Input::from(bytes), &Progress::new())
}

fn read(format: &str, bytes: impl AsRef<[u8]>) -> SceneParts {
    let bytes = bytes.as_ref();
    let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(600)]);
    try_read(format, bytes).unwrap_or_else(|error| panic!("{error} in {shown}"))
}

/// What the load report says was skipped or changed.
fn reported(parts: &SceneParts) -> String {
    let kinds = [NoteKind::Skipped, NoteKind::Changed];
    let notes = parts.notes.iter().filter(|n| kinds.contains(&n.kind));
    let texts: Vec<_> = notes.map(|note| note.text.as_str()).collect();
    texts.join("; ")
}

/// Checks the number of objects and the report of what was skipped or changed; the latter is a part
/// of it, or empty if there must be none.
fn check(format: &str, bytes: impl AsRef<[u8]>, objects: usize, report: &str) -> SceneParts {
    let shown = String::from_utf8_lossy(bytes.as_ref()).into_owned();
    let parts = read(format, bytes);
    assert_eq!(parts.objects.len(), objects, "{shown}");
    let found = reported(&parts);
    let is_right = match report {
        "" => found.is_empty(),
        part => found.contains(part),
    };
    assert!(is_right, "{found:?}, not {report:?}, in {shown}");
    parts
}

const CORNERS: &str = "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n";

// OBJ and MTL

#[test]
fn a_backslash_in_obj_continues_only_what_goes_on() {
    let faces = "f 1 2 3\nf 1 3 4\n";
    for before in [
        "# from C:\\models\\\n",
        "o C:\\models\\\n",
        "g left \\\n",
        "usemtl odd\\\n",
        "f 2 3 4 # behind \\\n",
        "vt 0 0 \\\n",
    ] {
        let parts = read("obj", format!("{CORNERS}{before}{faces}"));
        let expected = 2 + usize::from(before.starts_with('f'));
        assert_eq!(parts.objects.len(), expected, "{before:?}");
    }
    for face in [
        "f 1 2 \\  \n 3 4\n",
        "f 1 2 \\\t\n3 \\ \n4\n",
        "f 1 \\\r\n2 3\\\r\n 4\r\n",
        "f 1 2 3 4\\\n",
        "f 1 2 3 4 \\",
    ] {
        let parts = check("obj", format!("{CORNERS}{face}"), 1, "");
        let Primitive::Polygon(polygon) = &parts.objects[0] else {
            panic!("{face:?}")
        };
        assert_eq!(polygon.vertices().len(), 4);
    }
    let parts = check("obj", format!("{CORNERS}f 1 2 3 \\\nf 1 3 4\n"), 2, "");
    assert_eq!(parts.objects.len(), 2);
}

#[test]
fn bad_normals_of_obj_never_refuse_a_face() {
    let infinite = "vertex normal that is not finite; using the face normal";
    for normal in [
        "nan nan nan",
        "-nan(ind) 0 1",
        "-1.#IND00 -1.#IND00 -1.#IND00",
        "1.#QNAN 0 0",
        "-1.#J 0 0",
        "inf 0 0",
        "-1.#INF 0 0",
        "1e999 0 0",
        "0 up 1",
        "0 0",
        "",
    ] {
        let text = format!("{CORNERS}vn {normal}\nvn 0 0 1\nf 1//1 2//2 3//2\nf 1//2 3//2 4//2\n");
        let parts = check("obj", &text, 2, infinite);
        assert!(reported(&parts).ends_with("at line 7"), "{normal:?}");
        let Primitive::Triangle(triangle) = &parts.objects[0] else {
            panic!("{normal:?}")
        };
        assert_eq!(**triangle.normals.as_ref().unwrap(), [Vec3::Z; 3]);
        // A normal that no face uses does not matter.
        check("obj", format!("{CORNERS}vn {normal}\nf 1 2 3 4\n"), 1, "");
    }
    for face in [
        "1//0 2//0 3//0",
        "1/1/1 2/1/1 3/1/1",
        "1//-1 2//-1 3//-1",
        "1//x 2//y 3//z",
    ] {
        let text = format!("{CORNERS}f {face}\nf {face}\n");
        let parts = check("obj", &text, 2, "2 × index of a normal that is not defined");
        assert!(reported(&parts).ends_with("first at line 5"));
        let Primitive::Triangle(triangle) = &parts.objects[0] else {
            panic!("{face}")
        };
        assert!(triangle.normals.is_none());
    }
    // The other vertices keep their normals.
    let text = format!("{CORNERS}vn 0 1 0\nf 1//1 2//7 3//1\n");
    let parts = check("obj", &text, 1, "index of a normal");
    let Primitive::Triangle(triangle) = &parts.objects[0] else {
        panic!("not a triangle")
    };
    assert_eq!(
        **triangle.normals.as_ref().unwrap(),
        [Vec3::Y, Vec3::Z, Vec3::Y]
    );
}

#[test]
fn a_vertex_of_obj_that_no_face_uses_may_be_anything_but_text() {
    for vertex in ["nan nan nan", "-1.#IND 0 0", "0 inf 0", "1e400 0 0"] {
        check("obj", format!("v {vertex}\n{CORNERS}f 2 3 4 5\n"), 1, "");
        let used = format!("v {vertex}\n{CORNERS}f 1 2 3\n");
        let error = try_read("obj", used.as_bytes()).unwrap_err().to_string();
        assert!(
            error.contains("line 6: expected vertices with finite"),
            "{error}"
        );
        assert!(error.contains("vertex 1 of line 1"), "{error}");
    }
    // Numbers as Fortran writes them, and comments without a blank before.
    let text = "v 1.0D+00 0d0 0#a\nv 2.5E0 0 0#b\nv 0 1.D1 0 # three\nf 1 2 3# the face\n";
    let parts = check("obj", text, 1, "");
    assert_eq!(parts.objects[0].bounds().hi.y.round(), 10.0);
}

#[test]
fn a_comment_after_a_vertex_is_no_color() {
    for line in [
        "v 5 5 5 # the upper right corner",
        "v 5 5 5 1.0 # w and more words",
    ] {
        check("obj", format!("{CORNERS}{line}\nf 1 2 3 4\n"), 1, "");
    }
    let colored = format!("{CORNERS}v 5 5 5 1 0 0 # red\nf 1 2 3 4\n");
    check("obj", colored, 1, "vertex colors, at line 5");
}

#[test]
fn points_in_obj_are_one_line_of_the_report() {
    let parts = check(
        "obj",
        "v 0 0 0 1 0 0\n".repeat(12),
        0,
        "12 points, no faces",
    );
    assert_eq!(parts.objects.len(), 0);
}

/// Loads an OBJ file with the given lines before its only face, beside some material files.
fn with_materials(lines: &str, after: &str, files: &[(&str, &[u8])]) -> SceneParts {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let path = folder.path().join("scene.obj");
    std::fs::write(&path, format!("{CORNERS}{lines}f 1 2 3 4\n{after}")).unwrap();
    read_file(&path, &Progress::new()).unwrap_or_else(|error| panic!("{error}"))
}

const TWO: &[u8] = b"newmtl warm\nKd 1 0 0\nnewmtl cold\nKd 0 0 1\n";

#[test]
fn materials_of_obj_may_be_defined_after_their_use() {
    for (before, after) in [
        ("mtllib two.mtl\nusemtl cold\n", ""),
        ("usemtl cold\nmtllib two.mtl\n", ""),
        ("usemtl cold\n", "mtllib two.mtl\n"),
        (
            "usemtl warm\nusemtl cold\n",
            "usemtl cold\nmtllib two.mtl\nmtllib two.mtl\n",
        ),
        ("usemtl cold # not warm\n", "mtllib two.mtl\n"),
        ("usemtl \"cold\"\n", "mtllib two.mtl\n"),
    ] {
        let parts = with_materials(before, after, &[("two.mtl", TWO)]);
        assert_eq!(parts.materials.len(), 1, "{before:?}");
        assert_eq!(parts.materials[0].color, Vec3::Z, "{before:?}, {after:?}");
    }
    // Materials that turn out to be equal are one.
    let same = b"newmtl a\nKd 0 1 0\nnewmtl b\nKd 0 1 0\n";
    let after = "usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl c\nf 2 3 4\nmtllib same.mtl\n";
    let parts = with_materials("usemtl a\n", after, &[("same.mtl", same)]);
    assert_eq!(parts.material_of, [0, 0, 1, 1]);
    let white = Material::default().color;
    let colors: Vec<_> = parts.materials.iter().map(|m| m.color).collect();
    assert_eq!(colors, [Vec3::Y, white]);
    let defaulted = parts.notes.iter().find(|n| n.text.contains("'c'")).unwrap();
    assert_eq!(
        defaulted.text,
        "2 × material 'c' is not defined; using matte white, first at line 9"
    );
}

#[test]
fn names_of_material_files_may_be_quoted_or_followed_by_comments() {
    for line in [
        "mtllib \"two.mtl\"",
        "mtllib 'two.mtl'",
        "mtllib two.mtl # made by hand",
        "mtllib \"two.mtl\" # made by hand",
        "mtllib \"none at all.mtl\" \"two.mtl\"",
        "mtllib none.mtl two.mtl",
        "mtllib\t two.mtl \t",
        "mtllib .\\two.mtl",
    ] {
        let parts = with_materials(&format!("{line}\nusemtl warm\n"), "", &[("two.mtl", TWO)]);
        assert_eq!(parts.materials[0].color, Vec3::X, "{line}");
        let missing = reported(&parts).contains("material file 'none");
        assert_eq!(
            missing,
            line.contains("none"),
            "{line}: {}",
            reported(&parts)
        );
    }
    let parts = with_materials(
        "mtllib my two.mtl\nusemtl warm\n",
        "",
        &[("my two.mtl", TWO)],
    );
    assert_eq!(parts.materials[0].color, Vec3::X);
}

#[test]
fn a_damaged_material_file_never_refuses_the_geometry() {
    let wide: Vec<u8> = "newmtl warm\nKd 1 0 0\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let cases: &[(&[u8], Vec3, &str)] = &[
        (
            b"<!DOCTYPE html>\n<p>404",
            Vec3::ONE,
            "a page in HTML or XML",
        ),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", Vec3::ONE, "not text"),
        (&wide, Vec3::ONE, "text in UTF-16"),
        (b"", Vec3::ONE, "a file without materials"),
        (
            b"Kd 1 1 1\nnewmtl warm\nKd 1 0 0\n",
            Vec3::X,
            "'Kd' before the first 'newmtl', at line 1",
        ),
        (
            b"newmtl warm\nKd 1 0 0\nKd wood.png\n",
            Vec3::X,
            "found 'wood.png', at line 3",
        ),
        (
            b"newmtl warm\nKd 1 0 0\nNs\nNi nan\nd inf\n",
            Vec3::X,
            "the exponent",
        ),
        (
            b"newmtl warm\nKd 1 0 0\nKd nan nan nan\n",
            Vec3::X,
            "found 'nan', at line 3",
        ),
        (
            b"newmtl warm\nKd 1 0 0\n\xff\xfe\x01\n",
            Vec3::X,
            "statement",
        ),
        (b"newmtl warm\nKd 1 0 0 # red\n", Vec3::X, ""),
    ];
    for (bytes, color, report) in cases {
        let parts = with_materials("mtllib a.mtl\nusemtl warm\n", "", &[("a.mtl", bytes)]);
        let text = String::from_utf8_lossy(bytes);
        assert_eq!(
            (parts.objects.len(), parts.materials[0].color),
            (1, *color),
            "{text:?}"
        );
        let found = reported(&parts);
        assert!(
            found.contains(report) && found.is_empty() == report.is_empty(),
            "{found}"
        );
        assert!(report.is_empty() || found.contains("a.mtl: "), "{found}");
    }
}

// PLY

/// A text file with four vertices with normals and two faces, after some changes.
fn ply(changes: &[(&str, &str)]) -> String {
    let mut text = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\n\
         property float y\nproperty float z\nproperty float nx\nproperty float ny\n\
         property float nz\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0 0 0 1\n2 0 0 0 0 1\n2 3 0 0 0 1\n0 3 0 0 0 1\n3 0 1 2\n3 0 2 3\n"
        .to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from:?}");
        text = text.replace(from, to);
    }
    text
}

#[test]
fn the_layout_of_ply_as_text_does_not_matter() {
    let expected = check("ply", ply(&[]), 2, "").objects;
    let in_one_line = {
        let text = ply(&[]);
        let (header, body) = text.split_once("end_header\n").unwrap();
        format!("{header}end_header\n{}", body.replace('\n', " "))
    };
    let variants = [
        ply(&[("ply\n", "\u{feff}ply\n")]),
        ply(&[("ply\n", "\u{feff}ply \n")]),
        ply(&[("element face", "\n  \nelement face")]),
        ply(&[
            ("format", "  format"),
            ("element vertex 4", "element   vertex\t4 "),
        ]),
        ply(&[("element vertex 4", "element vertex 4.0")]),
        ply(&[("3 0 1 2\n", "3 0\n1\n\n2\n")]),
        ply(&[("2 0 0 0 0 1\n", "2 0 0\n0 0 1 ")]),
        ply(&[("3 0 1 2\n", "3.0 0.0 1.0 2.00\n")]),
        ply(&[("3 0 1 2\n", "+3 0e0 1 2\n")]),
        ply(&[("end_header\n", "end_header  \n\n")]),
        ply(&[("\n", "\r\n")]),
        ply(&[("\n", "\r")]),
        in_one_line,
    ];
    for text in variants {
        let parts = check("ply", &text, 2, "");
        assert!(parts.objects == expected, "{text:?}");
        let path = tempfile::tempdir().unwrap();
        let path = path.path().join("unknown.bin");
        std::fs::write(&path, &text).unwrap();
        assert!(read_file(&path, &Progress::new()).is_ok(), "{text:?}");
    }
}

/// Values that the header does not declare are skipped if each element has a line of its own.
#[test]
fn lines_of_ply_may_hold_more_than_the_header_says() {
    let expected = read("ply", ply(&[])).objects;
    let text = ply(&[
        (" 0 0 1\n", " 0 0 1 255 255 255\n"),
        ("3 0 2 3", "3 0 2 3 7"),
    ]);
    let parts = check(
        "ply",
        &text,
        2,
        "line with more values than the header declares",
    );
    assert!(parts.objects == expected);
    // Without lines of their own, one value could be mistaken for another.
    let text = ply(&[("0 3 0 0 0 1\n3 0 1 2\n", "0 3 0 0 0 1 3 0 1 2 9 9 9\n")]);
    assert!(try_read("ply", text.as_bytes()).is_err());
    check(
        "ply",
        ply(&[("3 0 2 3\n", "3 0 2 3\n\nthe end\n")]),
        2,
        "after the last element",
    );
}

/// The values of [`ply`] in binary form.
fn binary_ply(big: bool, vertices: &[[f32; 6]], faces: &[&[i32]], kind: &str) -> Vec<u8> {
    let format = if big {
        "binary_big_endian"
    } else {
        "binary_little_endian"
    };
    let text = ply(&[
        ("ascii", format),
        (
            "element vertex 4",
            &format!("element vertex {}", vertices.len()),
        ),
        ("element face 2", &format!("element {kind} {}", faces.len())),
        ("list uchar int", "list int int"),
    ]);
    let (header, _) = text.split_once("end_header\n").unwrap();
    let mut bytes = format!("{header}end_header\n").into_bytes();
    let mut add = |mut four: [u8; 4]| {
        if big {
            four.reverse();
        }
        bytes.extend(four);
    };
    for number in vertices.as_flattened() {
        add(number.to_le_bytes());
    }
    for face in faces {
        add((face.len() as i32).to_le_bytes());
        face.iter().for_each(|index| add(index.to_le_bytes()));
    }
    bytes
}

#[test]
fn normals_of_ply_that_are_not_finite_are_replaced_in_text_and_binary_alike() {
    let nan = f32::NAN;
    let vertices = [
        [0.0, 0.0, 0.0, nan, nan, nan],
        [2.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [2.0, 3.0, 0.0, 0.0, 0.0, 1.0],
        [nan, 3.0, 0.0, 0.0, f32::INFINITY, 1.0],
    ];
    let report = "vertex normal that is not finite; using the face normal";
    let text = ply(&[
        ("0 0 0 0 0 1\n2", "0 0 0 -nan -1.#IND 1e999\n2"),
        ("0 3 0 0 0 1", "nan 3 0 0 up 1"),
        ("element face 2", "element face 1"),
        ("3 0 2 3\n", ""),
    ]);
    let expected = check("ply", &text, 1, report).objects;
    for big in [false, true] {
        let bytes = binary_ply(big, &vertices, &[&[0, 1, 2]], "face");
        assert!(check("ply", &bytes, 1, report).objects == expected);
        let used = binary_ply(big, &vertices, &[&[0, 2, 3]], "face");
        let error = try_read("ply", &used).unwrap_err().to_string();
        assert!(
            error.contains("finite coordinates, found vertex 3"),
            "{error}"
        );
    }
    let used = text.replace("3 0 1 2", "3 1 2 3");
    let error = try_read("ply", used.as_bytes()).unwrap_err().to_string();
    assert!(
        error.contains("finite coordinates, found vertex 3 of line 17"),
        "{error}"
    );
}

/// After a header with any line breaks, the first value may be a line feed.
#[test]
fn line_breaks_of_a_header_are_no_values() {
    for line_break in ["\n", "\r", "\r\n"] {
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n\
             property uchar y\nproperty uchar z\nelement face 1\n\
             property list uchar uchar vertex_index\nend_header\n";
        let mut file = header.replace('\n', line_break).into_bytes();
        file.extend([10, 13, 10, 20, 13, 10, 10, 30, 10]);
        file.extend([3, 0, 1, 2]);
        let parts = check("ply", &file, 1, "");
        let Primitive::Triangle(triangle) = &parts.objects[0] else {
            panic!("not a triangle")
        };
        assert_eq!(triangle.vertices[0], Vec3::new(10.0, 13.0, 10.0));
    }
}

#[test]
fn strips_in_ply_are_triangles_of_one_orientation() {
    // Two strips; the first has an odd number of triangles, and repeated vertices join its parts.
    let strip = [0, 1, 3, 2, 2, -1, 0, 1, 3];
    let vertices =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 3.0], [0.0, 3.0]].map(|[x, y]| [x, y, 0.0, 0.0, 0.0, 1.0]);
    let text = ply(&[
        ("element face 2", "element tristrips 1"),
        ("list uchar int", "list int int"),
        ("3 0 1 2\n3 0 2 3", "9 0 1 3 2 2\n -1 0 1 3"),
    ]);
    let mut files = vec![text.into_bytes()];
    files.extend([false, true].map(|big| binary_ply(big, &vertices, &[&strip], "tristrips")));
    for file in files {
        let parts = check("ply", &file, 3, "");
        for object in &parts.objects {
            let Primitive::Triangle(triangle) = object else {
                panic!("{object:?}")
            };
            assert_eq!(triangle.normal(), Vec3::Z, "{:?}", triangle.vertices);
        }
    }
    let bad = binary_ply(false, &vertices, &[&[0, 1, -2]], "tristrips");
    let error = try_read("ply", &bad).unwrap_err().to_string();
    assert!(
        error.contains("tristrips 0") && error.contains("found -2"),
        "{error}"
    );
}

#[test]
fn points_and_splats_in_ply_are_one_line_of_the_report() {
    let properties: String = (0..50)
        .map(|i| format!("property float f_rest_{i}\n"))
        .collect();
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n\
         property float z\n{properties}element camera 1\nproperty float focus\nend_header\n"
    );
    let row = format!("1 2 3{}\n", " 0.5".repeat(50));
    let text = format!("{header}{}7\n", row.repeat(12));
    let parts = read("ply", text);
    assert_eq!(
        (parts.objects.len(), reported(&parts)),
        (0, "12 points, no faces".to_owned())
    );
}

#[test]
fn properties_of_ply_that_are_not_read_are_one_line_of_the_report() {
    let text = ply(&[
        (
            "property float nx",
            "property uchar red\nproperty uchar green\nproperty float nx",
        ),
        (" 0 0 1\n", " none 300 0 0 1\n"),
        ("element face 2\n", "element face 2\nproperty uchar flags\n"),
        ("3 0 1 2\n3 0 2 3", "9 3 0 1 2\n9 3 0 2 3"),
    ]);
    let report = "properties 'red', 'green' of vertices, at vertex 0; property 'flags' of faces";
    check("ply", text, 2, report);
}

// STL

const FACETS: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 2 3 0\n\
    endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 3 0\nvertex 0 3 0\n\
    endloop\nendfacet\n";

#[test]
fn stl_as_text_is_known_by_its_content_and_read_as_tokens() {
    let plain = format!("solid part\n{FACETS}endsolid part\n");
    let expected = check("stl", &plain, 2, "").objects;
    let variants = [
        format!("\u{feff}{plain}"),
        format!("\n \t{plain}"),
        plain.replace(
            "solid part",
            &format!("solid {}", "long name ".repeat(3000)),
        ),
        plain.replace("solid part", "solid a facet of it"),
        FACETS.to_owned(),
        format!("\u{feff}{FACETS}endsolid"),
        plain
            .replace("endloop", "end loop")
            .replace("endfacet", "end facet")
            .replace("endsolid", "end solid"),
        plain.replace("outer loop", "outerloop"),
        plain.to_uppercase().replace("PART", "part"),
        plain
            .replace("\nouter", " outer")
            .replace("\nvertex", " vertex")
            .replace("\nend", " end"),
        plain.replace("vertex 0 0 0", "vertex\n0\n0 0"),
        plain.replace('\n', "\r"),
        plain.replace("0 0 1\nouter", "nan -1.#IND inf\nouter"),
        plain.replace(" normal 0 0 1", ""),
        plain.replace("normal 0 0 1", "normal 0 0"),
        format!("solid part {}endsolid part", FACETS.replace('\n', " ")),
        plain.replacen("endfacet\n", "endfacet\nendsolid part\nsolid other\n", 1),
    ];
    for text in variants {
        let parts = check("stl", &text, 2, "");
        assert!(
            parts.objects == expected,
            "{}",
            &text[..text.len().min(200)]
        );
    }
}

/// A binary file with a title, a declared number of facets, and some of them.
fn binary_stl(title: &str, declared: u32, facets: usize) -> Vec<u8> {
    let mut bytes = title.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend(declared.to_le_bytes());
    for i in 0..facets {
        let x = i as f32;
        for number in [0.0, 0.0, 1.0, x, 0.0, 0.0, x + 1.0, 0.0, 0.0, x, 1.0, 0.0] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

#[test]
fn the_size_of_binary_stl_decides_how_many_facets_there_are() {
    for title in ["scanner", "solid scan", "facet scan"] {
        check("stl", binary_stl(title, 5, 5), 5, "");
        for declared in [0, 1, 4, 6, 1_000_000, u32::MAX] {
            let report = format!("count of {declared} facets in the header; using the 5");
            check("stl", binary_stl(title, declared, 5), 5, &report);
        }
        // A file that was cut off within a facet.
        let mut cut = binary_stl(title, 9, 6);
        cut.truncate(cut.len() - 20);
        let parts = check("stl", &cut, 5, "count of 9 facets");
        assert!(reported(&parts).contains("30 bytes after the last facet"));
        // Bytes that a program has added are no facets.
        let mut longer = binary_stl(title, 5, 5);
        longer.extend([1; 120]);
        let parts = check("stl", &longer, 5, "120 bytes after the last facet");
        assert!(!reported(&parts).contains("count"));
    }
}

// glTF

/// Bytes of a triangle, and of what else the tests refer to.
fn buffer() -> Vec<u8> {
    let triangle = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    // Three translations from byte 36, three rotations from 72, three scales from 120.
    let translations = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0, 0.0, 0.0];
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let rotations = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 1.0, 0.0];
    let scales = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 1.0, 1.0];
    let all = triangle
        .into_iter()
        .chain(translations)
        .chain(rotations)
        .chain(scales);
    let mut bytes: Vec<u8> = all.flat_map(f32::to_le_bytes).collect();
    // Sparse: index 2 from byte 156, its value from 160.
    bytes.extend([2, 0, 0, 0]);
    bytes.extend([0.0_f32, 3.0, 0.0].into_iter().flat_map(f32::to_le_bytes));
    bytes
}

/// A glTF file of one triangle; `rest` replaces top-level entries.
fn gltf(rest: Value) -> Value {
    let data = base64::engine::general_purpose::STANDARD.encode(buffer());
    let vectors = |offset: usize, kind: &str| json!({"bufferView": 0, "byteOffset": offset, "componentType": 5126, "count": 3, "type": kind});
    let mut file = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [vectors(0, "VEC3"), vectors(36, "VEC3"), vectors(72, "VEC4"), vectors(120, "VEC3")],
        "bufferViews": [{"buffer": 0, "byteLength": 172}],
        "buffers": [{"byteLength": 172, "uri": format!("data:;base64,{data}")}],
    });
    let all = file.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    file
}

fn check_gltf(rest: Value, objects: usize, report: &str) -> SceneParts {
    check("gltf", gltf(rest).to_string(), objects, report)
}

/// The bounds of each object, rounded.
fn bounds(parts: &SceneParts) -> Vec<[[f64; 3]; 2]> {
    let rounded = |v: Vec3| (v * 1e6).round().to_array().map(|n| n / 1e6 + 0.0);
    let of = |object: &Primitive| [object.bounds().lo, object.bounds().hi].map(rounded);
    parts.objects.iter().map(of).collect()
}

#[test]
fn instances_in_gltf_are_copies() {
    let instancing = |attributes: Value| {
        json!({
            "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "extensionsRequired": ["EXT_mesh_gpu_instancing"],
            "nodes": [{"mesh": 0, "translation": [0, 0, 7], "extensions": {
                "EXT_mesh_gpu_instancing": {"attributes": attributes},
            }}],
        })
    };
    let parts = check_gltf(instancing(json!({"TRANSLATION": 1, "_ID": 0})), 3, "");
    let at = |x: f64| [[x, 0.0, 7.0], [x + 1.0, 1.0, 7.0]];
    assert_eq!(bounds(&parts), [at(0.0), at(2.0), at(4.0)]);
    let all = instancing(json!({"TRANSLATION": 1, "ROTATION": 2, "SCALE": 3}));
    let parts = check_gltf(all, 3, "");
    // The second is turned by a quarter about z, the third by a half.
    let expected = [
        [[0.0, 0.0, 7.0], [1.0, 1.0, 7.0]],
        [[0.0, 0.0, 7.0], [2.0, 2.0, 7.0]],
        [[1.0, -1.0, 7.0], [4.0, 0.0, 7.0]],
    ];
    assert_eq!(bounds(&parts), expected);
    for attributes in [json!({}), json!({"TRANSLATION": 9}), json!({"ROTATION": 1})] {
        let file = gltf(instancing(attributes)).to_string();
        assert!(try_read("gltf", file.as_bytes()).is_err(), "{file}");
    }
}

#[test]
fn hidden_nodes_of_gltf_are_skipped_with_their_children() {
    let visible = |is: bool| json!({"KHR_node_visibility": {"visible": is}});
    let nodes = json!({
        "extensionsUsed": ["KHR_node_visibility"],
        "scenes": [{"nodes": [0, 1, 3]}],
        "nodes": [
            {"mesh": 0, "extensions": visible(true)},
            {"mesh": 0, "children": [2], "extensions": visible(false)},
            {"mesh": 0, "extensions": visible(true)},
            {"mesh": 0, "extensions": visible(false)},
        ],
    });
    check_gltf(
        nodes,
        1,
        "2 × node that is hidden (KHR_node_visibility), with its children",
    );
}

fn with_material(material: Value, rest: Value) -> Value {
    let mut file = json!({
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [material],
    });
    let all = file.as_object_mut().unwrap();
    all.extend(rest.as_object().unwrap().clone());
    file
}

#[test]
fn specular_and_glossiness_in_gltf_are_read() {
    let name = "KHR_materials_pbrSpecularGlossiness";
    let required = json!({"extensionsUsed": [name], "extensionsRequired": [name]});
    let material = |extension: Value| json!({"extensions": {name: extension}});
    let file = with_material(
        material(json!({"diffuseFactor": [0, 1, 0, 1]})),
        required.clone(),
    );
    let parts = check_gltf(file, 1, "");
    assert_eq!(
        (parts.materials[0].color, parts.materials[0].diffuse),
        (Vec3::Y, 1.0)
    );
    let extension = json!({
        "diffuseFactor": [0.5, 0, 0, 1], "specularFactor": [0.5, 0.5, 0.5], "glossinessFactor": 0.5,
        "diffuseTexture": {"index": 0},
    });
    let parts = check_gltf(
        with_material(material(extension), required),
        1,
        "texture, at material 0",
    );
    let found = parts.materials[0];
    assert_eq!(
        (found.specular, found.diffuse, found.color.x),
        (0.25, 0.75, 0.5)
    );
}

#[test]
fn what_gltf_shows_and_bspscope_does_not_is_named() {
    let masked = |alpha: f64, more: Value| {
        let mut pbr = json!({"baseColorFactor": [1, 1, 1, alpha]});
        pbr.as_object_mut()
            .unwrap()
            .extend(more.as_object().unwrap().clone());
        json!({"alphaMode": "MASK", "pbrMetallicRoughness": pbr})
    };
    let none = || json!({});
    check_gltf(
        with_material(masked(0.4, none()), none()),
        0,
        "alpha mask hides, at mesh 0",
    );
    let colored = json!({"attributes": {"POSITION": 0, "COLOR_0": 1}, "material": 0});
    let colored = json!({"meshes": [{"primitives": [colored]}]});
    check_gltf(
        with_material(masked(0.6, none()), colored),
        1,
        "vertex colors (COLOR_0), at mesh 0",
    );
    let texture = json!({"baseColorTexture": {"index": 0}});
    check_gltf(
        with_material(masked(0.4, texture), none()),
        1,
        "alpha mask of a texture",
    );
    let glowing = json!({"emissiveFactor": [0, 0.5, 0]});
    check_gltf(with_material(glowing, none()), 1, "emissive color");
    let coat = json!({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}});
    let used = json!({"extensionsUsed": ["KHR_materials_clearcoat", "ACME_unknown"]});
    let parts = check_gltf(
        with_material(coat, used),
        1,
        "'KHR_materials_clearcoat', which is not supported, at material 0",
    );
    assert!(reported(&parts).contains("extension 'ACME_unknown', which is not supported"));
    // An extension that is used but not declared.
    let nodes = json!({"nodes": [{"mesh": 0, "extensions": {"ACME_bend": {}}}]});
    check_gltf(
        nodes,
        1,
        "extension 'ACME_bend', which is not supported, at node 0",
    );
}

#[test]
fn nothing_but_geometry_refuses_a_gltf_file() {
    for (material, report) in [
        (
            json!({"pbrMetallicRoughness": {"baseColorFactor": "red"}}),
            "baseColorFactor of a material",
        ),
        (
            json!({"pbrMetallicRoughness": 3, "emissiveFactor": [1]}),
            "emissiveFactor of a material",
        ),
        (
            json!({"pbrMetallicRoughness": {"roughnessFactor": null}}),
            "roughnessFactor",
        ),
        (json!(7), "the whole object of a material"),
    ] {
        check_gltf(with_material(material, json!({})), 1, report);
    }
    let part = |part: Value| json!({"meshes": [{"primitives": [part]}]});
    let attributes = json!({"POSITION": 0});
    let file = part(json!({"attributes": attributes, "material": 5}));
    let parts = check_gltf(file, 1, "");
    let defaulted = |n: &bspscope::scene::Note| n.text.contains("material that does not exist");
    assert!(parts.notes.iter().any(defaulted));
    for normal in [json!(99), json!(2), json!("up")] {
        let file = part(json!({"attributes": {"POSITION": 0, "NORMAL": normal}}));
        check_gltf(file, 1, "normals that cannot be read (accessor");
    }
    for (node, report) in [
        (
            json!({"mesh": 0, "camera": 3}),
            "camera that does not exist, at node 0",
        ),
        (
            json!({"mesh": 0, "camera": "front"}),
            "camera that does not exist, at node 0",
        ),
        (
            json!({"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 4}}}),
            "light that does not exist or cannot be read, at node 0",
        ),
    ] {
        check_gltf(json!({"nodes": [node]}), 1, report);
    }
}

#[test]
fn accessors_of_gltf_may_be_sparse_or_without_a_view() {
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": 0, "byteOffset": 156, "componentType": 5123},
        "values": {"bufferView": 0, "byteOffset": 160},
    });
    let view = json!({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse});
    let parts = check_gltf(json!({"accessors": [view]}), 1, "");
    assert_eq!(bounds(&parts), [[[0.0, 0.0, 0.0], [1.0, 3.0, 0.0]]]);
    // Without a view, all but the sparse elements are zero: the triangle has no area.
    let zeros = json!({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse});
    check_gltf(json!({"accessors": [zeros]}), 0, "polygon with zero area");
    let nothing = json!({"componentType": 5126, "count": 3, "type": "VEC3"});
    check_gltf(
        json!({"accessors": [nothing]}),
        0,
        "positions are not in the file",
    );
    let (positions, with_normals) = (
        gltf(json!({}))["accessors"][0].clone(),
        json!([{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}]),
    );
    let file = json!({"accessors": [positions, nothing], "meshes": with_normals});
    check_gltf(file, 1, "zero-length vertex normal; using the face normal");
    for (key, value) in [("count", json!(2)), ("count", json!(1_000_000_000_000_u64))] {
        let mut bad = view.clone();
        bad["sparse"][key] = value;
        let file = gltf(json!({"accessors": [bad]})).to_string();
        assert!(try_read("gltf", file.as_bytes()).is_err(), "{file}");
    }
    // Draco leaves accessors without views for data that is compressed, even if not required.
    let part =
        json!({"attributes": {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {}}});
    let file = json!({"accessors": [nothing], "meshes": [{"primitives": [part]}]});
    let error = try_read("gltf", gltf(file).to_string().as_bytes())
        .unwrap_err()
        .to_string();
    assert!(error.contains("compressed with Draco"), "{error}");
    let buffers = json!({"buffers": [{"byteLength": 172, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}]});
    let error = try_read("gltf", gltf(buffers).to_string().as_bytes())
        .unwrap_err()
        .to_string();
    assert!(error.contains("compressed with meshoptimizer"), "{error}");
}

#[test]
fn data_uris_of_gltf_may_be_written_in_many_ways() {
    let bytes = buffer();
    let base64 = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let lines: Vec<_> = base64
        .as_bytes()
        .chunks(76)
        .map(|l| String::from_utf8_lossy(l))
        .collect();
    let escaped: String = bytes.iter().map(|b| format!("%{b:02x}")).collect();
    for data in [
        format!("data:application/octet-stream;base64,{base64}"),
        format!(
            "data:;base64,{}",
            base64
                .replace('=', "%3D")
                .replace('+', "%2B")
                .replace('/', "%2F")
        ),
        format!("data:;base64,{}", base64.trim_end_matches('=')),
        format!(
            "data:;base64,{}",
            base64.replace('+', "-").replace('/', "_")
        ),
        format!("data:;base64,\n{}\n", lines.join("\r\n")),
        format!("data:application/gltf-buffer;charset=x;BASE64, {base64}"),
        format!("data:application/octet-stream,{escaped}"),
        format!("data:,{escaped}"),
    ] {
        check_gltf(
            json!({"buffers": [{"byteLength": 172, "uri": data}]}),
            1,
            "",
        );
    }
}

#[test]
fn whole_numbers_in_gltf_may_be_written_as_decimals() {
    let decimals = gltf(json!({"scene": 0})).to_string();
    let decimals = decimals
        .replace("5126", "5126.0")
        .replace("\"count\":3", "\"count\":3.0")
        .replace("172", "1.72e2")
        .replace("\"mesh\":0", "\"mesh\":0.0")
        .replace("\"POSITION\":0", "\"POSITION\":0.0")
        .replace("[0]", "[0.0]")
        .replace("\"scene\":0", "\"scene\":0.0");
    check("gltf", decimals, 1, "");
}

#[test]
fn gltf_1_0_is_named() {
    let old = json!({"asset": {"version": "1.0"}, "accessors": {"a": {}}, "meshes": {"m": {}}});
    for file in [
        old.to_string().into_bytes(),
        b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0".to_vec(),
    ] {
        let error = try_read("gltf", &file).unwrap_err().to_string();
        assert!(
            error.contains("found glTF 1.0") && error.contains("version 2"),
            "{error}"
        );
    }
    check_gltf(json!({"asset": {}}), 1, "");
}

#[test]
fn points_in_gltf_are_one_line_of_the_report() {
    let file = json!({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]});
    check_gltf(file, 0, "3 points, no faces");
}

// NFF

const VIEW: &str =
    "v\nfrom 0 -5 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 64 48\nb 0 0 0\n";

#[test]
fn negative_radii_of_nff_are_the_same_surface() {
    let positive = "f 1 1 1 1 0 0 0 1\ns 1 2 3 4\nc 0 0 0 1 0 0 5 2\nc 0 0 0 1 0 0 5 0\n";
    let negative = "f 1 1 1 1 0 0 0 1\ns 1 2 3 -4\nc 0 0 0 -1 0 0 5 -2\nc 0 0 0 -1 0 0 5 0\n";
    let expected = check("nff", format!("{VIEW}{positive}"), 3, "").objects;
    let report =
        "3 × negative radius (visible from the inside); using both sides, first at line 10";
    let parts = check("nff", format!("{VIEW}{negative}"), 3, report);
    assert!(parts.objects == expected);
}

#[test]
fn comments_and_numbers_of_nff_may_be_those_of_other_languages() {
    let plain = format!("{VIEW}l 0 -9 9\nf 1 0 0 1 0 0 0 1\ns 0 0 0 1.5\n");
    let expected = read("nff", &plain);
    for text in [
        format!("/* a ball */\n{plain}"),
        format!("/* a ball\n v 1 2 3 \n*/{plain}/* the end */"),
        plain
            .replace("s 0 0", "s /* here: */ 0/**/0")
            .replace("1.5", "1.5/*half*/"),
        plain.replace("1.5", "1.5D+00"),
        plain
            .replace("1.5", "0.15d1")
            .replace("angle 45", "angle 4.5D1"),
    ] {
        assert!(
            read("nff", &text)
                == SceneParts {
                    notes: read("nff", &text).notes,
                    ..expected.clone()
                },
            "{text}"
        );
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.txt");
        std::fs::write(&path, &text).unwrap();
        assert!(read_file(&path, &Progress::new()).is_ok(), "{text}");
    }
    let text = format!("{VIEW}/* one\ntwo */ s 0 0 0\nradius\n");
    let error = try_read("nff", text.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("line 11"), "{error}");
}

#[test]
fn bad_colors_and_normals_of_nff_never_refuse_the_geometry() {
    let triangle = "pp 3\n0 0 0 nan 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n";
    let text =
        format!("{VIEW}b nan 0 0\nl 1 2 3 -nan 0 0\nf 1 nan 0 1 0 inf 0 -1.#IND\n{triangle}");
    let parts = check(
        "nff",
        text,
        1,
        "green of a material that is not finite; using 1, at line 11",
    );
    let report = reported(&parts);
    for part in [
        "background color that is not finite; using black, at line 9",
        "color of a light that is not finite; using the default, at line 10",
        "Shine of a material",
        "index of refraction of a material",
        "vertex normal that is not finite",
    ] {
        assert!(report.contains(part), "{report}");
    }
    assert_eq!(
        (parts.background, parts.lights[0].color),
        (Vec3::ZERO, None)
    );
}

#[test]
fn other_formats_that_are_called_nff_are_named() {
    let error = try_read("nff", b"// a room\n").unwrap_err().to_string();
    assert!(error.contains("an entity"), "{error}");
    for start in ["", "// a room\n\n", "# by hand\n"] {
        let text = format!("{start}NFF\nversion 2.10\nviewpos 0 0 0\n");
        let error = try_read("nff", text.as_bytes()).unwrap_err().to_string();
        assert!(
            error.contains("Sense8") && error.contains("another format"),
            "{error}"
        );
    }
    for entity in [
        "include \"robots.aff\"",
        "xs 1 1 1",
        "tpp 3",
        "k walk {",
        "detail_level {",
    ] {
        let error = try_read("nff", format!("{VIEW}{entity}\n").as_bytes())
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("line 9") && error.contains("AFF"),
            "{error}"
        );
    }
    let error = FormatError::Unknown {
        path: Path::new("kitchen.AFF").to_owned(),
    }
    .to_string();
    assert!(error.contains("Animated File Format"), "{error}");
}
