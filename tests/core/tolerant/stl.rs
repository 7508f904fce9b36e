//! STL files that a specification forbids, but that other programs write and open.

use super::{check, reported};

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
