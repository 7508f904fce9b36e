//! PLY files that a specification forbids, but that other programs write and open.

use super::{check, read, reported, try_read};
use bspscope::geometry::Vec3;
use bspscope::primitive::Primitive;
use bspscope::progress::Progress;
use bspscope::scene::format::read_file;

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
