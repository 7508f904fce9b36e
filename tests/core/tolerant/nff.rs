//! NFF files that a specification forbids, but that other programs write and open.

use super::{check, read, reported, try_read};
use bspscope::geometry::Vec3;
use bspscope::progress::Progress;
use bspscope::scene::SceneParts;
use bspscope::scene::format::{FormatError, read_file};
use std::path::Path;

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
