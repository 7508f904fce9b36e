//! Bad scene files: each mistake is named with its line, and nothing is half-loaded.

use crate::support::random::Random;
use bspscope::progress::Progress;
use bspscope::scene::format::{
    FORMATS, Format, FormatError, Input, Place, ReadError, nff, read_file,
};
use bspscope::scene::{SceneParts, builtin};
use std::path::Path;

/// A view in its own nine lines, so that what follows begins in line 10.
const VIEW: &str = "# nine lines\n# before it\nv\nfrom 0 -5 0\nat 0 0 0\nup 0 0 1\nangle 45\n\
                    hither 1\nresolution 64 64\n";

fn read(bytes: &[u8]) -> Result<SceneParts, ReadError> {
    nff::read(bytes, &Progress::new())
}

/// The line and the message of the mistake in a file.
fn mistake(bytes: &[u8]) -> (usize, String) {
    match read(bytes) {
        Err(error @ ReadError::Syntax { place, .. }) => match place {
            Place::Line(line) => (line, error.to_string()),
            other => panic!("{other}"),
        },
        other => panic!("{}: {other:?}", String::from_utf8_lossy(bytes)),
    }
}

#[test]
fn each_mistake_after_a_view_is_named_with_its_line() {
    let cases: &[(&str, usize, &[&str])] = &[
        // Entities.
        (
            "teapot 3\n",
            10,
            &["an entity (v, b, l, f, c, s, p or pp)", "found 'teapot'"],
        ),
        ("S 0 0 0 1\n", 10, &["an entity", "found 'S'"]),
        (
            "s 0 0 0 1 2\n",
            10,
            &["after the complete 's' of line 10", "found the number '2'"],
        ),
        (
            "s 0 0 0 1\n\n7\n",
            12,
            &["after the complete 's' of line 10", "found the number '7'"],
        ),
        (
            "7\n",
            10,
            &["after the complete 'v' of line 3", "found the number '7'"],
        ),
        // Entities that end early.
        (
            "s 0 0 0\n",
            10,
            &["expected the sphere's radius", "found the end of the file"],
        ),
        (
            "s 0 0 0\ns 1 1 1 1\n",
            11,
            &["expected the sphere's radius", "found 's'"],
        ),
        (
            "s",
            10,
            &[
                "expected x of the sphere's center",
                "found the end of the file",
            ],
        ),
        (
            "c 0 0 0 1\n0 0 1\nb 0 0 0\n",
            12,
            &["the cone's radius at its apex", "found 'b'"],
        ),
        (
            "f 1 1 1 1 0 0 0\n",
            10,
            &[
                "expected index of refraction of the material",
                "end of the file",
            ],
        ),
        (
            "b 1 1\n\n",
            11,
            &["expected blue of the background", "end of the file"],
        ),
        (
            "l 1 2\ns 0 0 0 1\n",
            11,
            &["expected z of the light", "found 's'"],
        ),
        (
            "l 1 2 3 1\n",
            10,
            &["expected green of the light's color", "end of the file"],
        ),
        (
            "l 1 2 3 1 1 1 1\n",
            10,
            &["after the complete", "found the number '1'"],
        ),
        // Vertex lists.
        (
            "p 4\n0 0 0\n1 0 0\n1 0 1\ns 0 0 0 1\n",
            14,
            &["expected x of vertex 4 of 4", "found 's'"],
        ),
        (
            "p 4\n0 0 0\n1 0 0\n1 0 1\n0 0\n",
            14,
            &["expected z of vertex 4 of 4", "end of the file"],
        ),
        (
            "p 3\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n",
            14,
            &["after the complete 'p' of line 10", "number '0'"],
        ),
        (
            "pp 3\n0 0 0 0 0 1\n1 0 0 0 0\np 3\n",
            13,
            &["z of the normal at vertex 2 of 3", "found 'p'"],
        ),
        (
            "p 2\n0 0 0\n1 0 0\n",
            10,
            &["vertices, 3 or more", "found '2'"],
        ),
        ("p 0\n", 10, &["vertices, 3 or more", "found '0'"]),
        ("p -4\n", 10, &["vertices, 3 or more", "found '-4'"]),
        ("p 3.0\n", 10, &["vertices, 3 or more", "found '3.0'"]),
        ("p\n", 10, &["vertices, 3 or more", "the end of the file"]),
        (
            "p 4000000000\n0 0 0\n",
            11,
            &["x of vertex 2 of 4000000000", "the end of the file"],
        ),
        (
            "pp 18446744073709551615\n0 0 0 0 0 1\n",
            11,
            &["vertex 2 of 18446744073709551615"],
        ),
        (
            "p 99999999999999999999999\n0 0 0\n",
            10,
            &["vertices, 3 or more", "'99999999999999999999999'"],
        ),
        // Numbers.
        (
            "s 0 zero 0 1\n",
            10,
            &["y of the sphere's center (a finite number)", "found 'zero'"],
        ),
        ("s 0 0 0 1,5\n", 10, &["the sphere's radius", "found '1,5'"]),
        (
            "s 0 0 NaN 1\n",
            10,
            &["z of the sphere's center (a finite number)", "found 'NaN'"],
        ),
        (
            "s inf 0 0 1\n",
            10,
            &["x of the sphere's center (a finite number)", "found 'inf'"],
        ),
        (
            "s 0 0 0 -infinity\n",
            10,
            &["the sphere's radius (a finite number)", "found '-infinity'"],
        ),
        (
            "s 0\n1e999 0 1\n",
            11,
            &[
                "y of the sphere's center (a finite number)",
                "found '1e999'",
            ],
        ),
        (
            "b 0 0x10 0\n",
            10,
            &["green of the background", "found '0x10'"],
        ),
        (
            "p 3\n0 0 0\n1 nan 0\n1 0 1\n",
            12,
            &["y of vertex 2 of 3 (a finite number)", "found 'nan'"],
        ),
        ("s 0 0 0 1#2\n3\n", 11, &["found the number '3'"]),
        // Radii: negative ones are those of an inside, which has but one.
        (
            "c 0 0 0 -0.5 0 0 1 1\n",
            10,
            &[
                "the cone's radius at its apex, of the same sign",
                "found '1'",
            ],
        ),
        (
            "c 0 0 0 1\n0 0 1 -1e-9\n",
            11,
            &["of the same sign", "found '-1e-9'"],
        ),
        ("s 0 0 0 -inf\n", 10, &["the sphere's radius", "'-inf'"]),
        // Comments.
        (
            "s 0 0 0 1\n/* and so on\n",
            11,
            &["'*/' at the end of the comment", "end of the file"],
        ),
        // Other formats.
        ("fm 1 0 0\n", 10, &["'fm' of AFF", "another format"]),
        // A second view is checked like the first.
        (
            "v\nfrom 0 0 0\nat 0 0 0\n",
            12,
            &["expected 'up' of the view", "the end of the file"],
        ),
    ];
    assert!(!cases.is_empty());
    for (text, line, fragments) in cases {
        let (found_line, message) = mistake(format!("{VIEW}{text}").as_bytes());
        assert_eq!(found_line, *line, "{text:?}: {message}");
        for fragment in *fragments {
            assert!(
                message.contains(fragment),
                "{text:?}: {message}, not {fragment}"
            );
        }
    }
}

#[test]
fn each_mistake_in_a_view_is_named_with_its_line() {
    let good = [
        "v",
        "from 0 -5 0",
        "at 0 0 0",
        "up 0 0 1",
        "angle 45",
        "hither 1",
        "resolution 64 64",
    ];
    assert!(read(good.join("\n").as_bytes()).is_ok());
    // Number of the line, what it says instead, line of the mistake, message.
    let cases: &[(usize, &str, usize, &[&str])] = &[
        (1, "form 0 -5 0", 2, &["'from' of the view", "found 'form'"]),
        (1, "", 3, &["'from' of the view", "found 'at'"]),
        (1, "from 0 -5", 3, &["z of the view's 'from'", "found 'at'"]),
        (
            2,
            "at 0 -5 0",
            3,
            &["a point 'at' other than 'from'", "found at 0 -5 0"],
        ),
        (
            3,
            "up 0 0 0",
            4,
            &["neither zero nor along the line of sight", "found up 0 0 0"],
        ),
        (
            3,
            "up 0 2 0",
            4,
            &["neither zero nor along the line of sight", "found up 0 2 0"],
        ),
        (
            4,
            "angle 0",
            5,
            &["above 0 and below 180 degrees", "found '0'"],
        ),
        (
            4,
            "angle 180",
            5,
            &["above 0 and below 180 degrees", "found '180'"],
        ),
        (
            4,
            "angle -45",
            5,
            &["above 0 and below 180 degrees", "found '-45'"],
        ),
        (
            4,
            "angle wide",
            5,
            &["the view's angle (a finite number)", "found 'wide'"],
        ),
        (5, "", 7, &["'hither' of the view", "found 'resolution'"]),
        (
            6,
            "resolution 0 64",
            7,
            &["the width in pixels", "1 to 65536", "found '0'"],
        ),
        (
            6,
            "resolution 64 -1",
            7,
            &["the height in pixels", "found '-1'"],
        ),
        (
            6,
            "resolution 64.5 64",
            7,
            &["the width in pixels", "found '64.5'"],
        ),
        (
            6,
            "resolution 64 65537",
            7,
            &["the height in pixels", "found '65537'"],
        ),
        (
            6,
            "resolution 64",
            7,
            &["the height in pixels", "the end of the file"],
        ),
        (
            6,
            "",
            6,
            &["'resolution' of the view", "the end of the file"],
        ),
    ];
    for (number, bad, line, fragments) in cases {
        let mut lines = good;
        lines[*number] = bad;
        let text = if bad.is_empty() && *number == 6 {
            lines[..6].join("\n")
        } else {
            lines.join("\n")
        };
        let (found_line, message) = mistake(text.as_bytes());
        assert_eq!(found_line, *line, "{text:?}: {message}");
        for fragment in *fragments {
            assert!(
                message.contains(fragment),
                "{text:?}: {message}, not {fragment}"
            );
        }
    }
}

#[test]
fn a_file_without_a_view_says_so_at_its_last_line() {
    for (text, line) in [
        ("", 1),
        ("\n", 1),
        ("# nothing but a comment", 1),
        ("s 0 0 0 1\n", 1),
        ("s 0 0 0 1\ns 0 0 0 2", 2),
        ("b 0 0 0\r\ns 0 0 0 1\r\n", 2),
        ("b 0 0 0\n\n\n", 3),
    ] {
        let (found_line, message) = mistake(text.as_bytes());
        assert_eq!(found_line, line, "{text:?}");
        assert!(message.contains("expected a view ('v')"), "{message}");
    }
}

#[test]
fn binary_garbage_is_quoted_short_and_without_control_characters() {
    let cases: &[&[u8]] = &[
        b"\x7fELF\x02\x01\x01\x00\x00",
        b"\x89PNG\r\n\x1a\n",
        b"\x00\x00\x00\x00",
        &[0x80; 100_000],
        &[b'x'; 100_000],
    ];
    for bytes in cases {
        let (line, message) = mistake(bytes);
        assert_eq!(line, 1);
        assert!(message.contains("expected an entity"), "{message}");
        assert!(!message.contains(char::is_control), "{message:?}");
        assert!(message.len() < 400, "{message}");
    }
    for (bytes, name) in [
        (&b"\xff\xfes\0 \0"[..], "UTF-16"),
        (b"\0v\0\n\0f\0r", "UTF-16"),
        (b"\xff\xfe\0\0", "UTF-32"),
    ] {
        let (line, message) = mistake(bytes);
        assert!(line == 1 && message.contains(name), "{message}");
    }
    let (line, message) = mistake(&[VIEW.as_bytes(), b"s 0 0 \xc3\x28 1\n"].concat());
    assert_eq!(line, 10);
    assert!(message.contains("z of the sphere's center"), "{message}");
}

#[test]
fn lines_are_counted_the_same_for_every_line_end() {
    let text = format!("{VIEW}# a comment\n\n\ts 0 0 0\n one\n");
    for end in ["\n", "\r\n", "\r"] {
        let (line, message) = mistake(text.replace('\n', end).as_bytes());
        assert_eq!(line, 13, "{end:?}: {message}");
    }
}

#[test]
fn a_file_error_shows_path_line_expected_and_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.nff");
    std::fs::write(&path, format!("{VIEW}s 0 0 0 radius\n")).unwrap();
    let error = read_file(&path, &Progress::new()).unwrap_err();
    assert!(matches!(error, FormatError::Read { .. }));
    let expected = format!(
        "{}:10: expected the sphere's radius (a finite number), found 'radius'",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for path in [folder.path().join("absent.nff"), folder.path().to_owned()] {
        let error = read_file(&path, &Progress::new()).unwrap_err();
        assert!(matches!(error, FormatError::Io { .. }), "{error:?}");
        assert!(error.to_string().starts_with(&path.display().to_string()));
    }
}

/// What every answer of a reader must hold, whatever the file.
fn check_answer(answer: Result<SceneParts, ReadError>, lines: usize) {
    match answer {
        Ok(parts) => {
            assert_eq!(parts.objects.len(), parts.material_of.len());
            let materials = parts.materials.len() as u32;
            assert!(parts.material_of.iter().all(|&m| m < materials));
            assert!(parts.camera.frame().is_ok());
        }
        Err(ReadError::Syntax { place, .. }) => {
            if let Place::Line(line) = place {
                assert!((1..=lines).contains(&line));
            }
        }
        Err(ReadError::Cancelled(_)) => panic!("nobody cancelled"),
    }
}

/// Files of every format: the teaching scene, or what other programs wrote.
fn good_files() -> Vec<(&'static Format, Vec<u8>)> {
    let parts = builtin::generate("teaching", None).unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/assets");
    let mut files = Vec::new();
    for format in FORMATS {
        if let Some(write) = format.write {
            let mut bytes = Vec::new();
            write(&parts, &mut bytes).unwrap();
            files.push((format, bytes));
        }
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let is_of_it = |e: &std::ffi::OsStr| format.extensions.iter().any(|x| e == *x);
            if format.write.is_none() && path.extension().is_some_and(is_of_it) {
                files.push((format, std::fs::read(path).unwrap()));
            }
        }
        assert!(
            files.iter().any(|(f, _)| f.name == format.name),
            "{}",
            format.name
        );
    }
    files
}

#[test]
fn a_file_cut_off_anywhere_never_panics() {
    for (format, bytes) in good_files() {
        let lines = lines(&bytes);
        for end in 0..bytes.len() {
            let input = Input::from(&bytes[..end]);
            check_answer((format.read)(&input, &Progress::new()), lines);
        }
    }
}

#[test]
fn damaged_bytes_never_panic() {
    // Characters that mean something to a reader are tried more often than others.
    const TELLING: &[u8] = b"\n\r\t #.-+e0123456789vblfcspN\x00\xff";
    for (format, bytes) in good_files() {
        let mut numbers = Random(1);
        let mut random = |below: usize| numbers.below(below);
        for _ in 0..4000 {
            let mut damaged = bytes.clone();
            for _ in 0..=random(4) {
                let place = random(damaged.len());
                match random(4) {
                    0 => damaged[place] ^= 1 << random(8),
                    1 => drop(damaged.remove(place)),
                    2 => damaged.insert(place, TELLING[random(TELLING.len())]),
                    _ => damaged[place] = TELLING[random(TELLING.len())],
                }
            }
            let input = Input::from(damaged.as_slice());
            let answer = (format.read)(&input, &Progress::new());
            check_answer(answer, lines(&damaged));
        }
    }
}

/// The most lines that a text can be said to have.
fn lines(text: &[u8]) -> usize {
    text.iter().filter(|b| matches!(b, b'\n' | b'\r')).count() + 1
}
