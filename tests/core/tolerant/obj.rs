//! OBJ and MTL files that a specification forbids, but that other programs write and open.

use super::{check, read, reported, try_read};
use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Shape};
use bspscope::progress::Progress;
use bspscope::scene::format::read_file;
use bspscope::scene::{Material, SceneParts};

const CORNERS: &str = "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n";

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
    // Normals of a polygon: those that cannot be read split it, those that are not there do not.
    let bad = format!("{CORNERS}vn nan nan nan\nf 1//1 2//1 3//1 4//1\n");
    check("obj", &bad, 2, infinite);
    let missing = format!("{CORNERS}f 1//1 2//1 3//1 4//1\n");
    check("obj", &missing, 1, "index of a normal that is not defined");
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
