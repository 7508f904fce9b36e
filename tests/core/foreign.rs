//! Files of other programs: the same hits as the same geometry in NFF, whatever the format.

use crate::support::scenes::{asset, tree_by};
use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::{RaySample, answer, sample_rays};
use bspscope::primitive::{Precision, Primitive, PrimitiveKind};
use bspscope::progress::{Cancelled, Progress};
use bspscope::scene::builtin::generate;
use bspscope::scene::format::{
    FORMATS, Format, FormatError, Input, MAX_VERTICES, ReadError, nff, read_file,
};
use bspscope::scene::{LoadError, NoteKind, Scene, SceneParts, SceneRequest};
use bspscope::trace::{RayKind, RenderSettings, thread_pool};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many rays are compared.
const RAYS: usize = 10_000;

fn load(path: &Path) -> SceneParts {
    read_file(path, &Progress::new()).unwrap_or_else(|e| panic!("{e}"))
}

/// Reads bytes as a format, with nothing beside them.
fn read(format: &str, bytes: &[u8]) -> Result<SceneParts, ReadError> {
    let format = FORMATS.iter().find(|f| f.name == format).unwrap();
    (format.read)(&Input::from(bytes), &Progress::new())
}

/// Holds the hits in one scene against those in the other, on rays of the first one's picture.
fn same_hits(expected: SceneParts, found: SceneParts, what: &str) {
    let (pool, progress) = (thread_pool(1).unwrap(), Progress::new());
    let scenes = [expected, found].map(Scene::new);
    let trees = [&scenes[0], &scenes[1]].map(|scene| tree_by(scene, "sah-cut"));
    let settings = RenderSettings::for_camera(*scenes[0].camera());
    let sample = sample_rays(&scenes[0], &trees[0], &settings, RAYS, &pool, &progress).unwrap();
    let primary = &sample.rays[RayKind::Primary as usize];
    assert_eq!(primary.len(), RAYS, "{what}");
    let answers: Vec<_> = scenes
        .iter()
        .zip(&trees)
        .map(|(scene, tree)| {
            answer(scene, tree, Precision::F64, &sample, &pool, &progress).unwrap()
        })
        .collect();
    assert!(answers[0] == answers[1], "{what}: other hits");
    let misses = RaySample {
        rays: [
            vec![Ray::new(Vec3::splat(1e3), Vec3::X); RAYS],
            vec![],
            vec![],
            vec![],
        ],
    };
    let none = answer(
        &scenes[0],
        &trees[0],
        Precision::F64,
        &misses,
        &pool,
        &progress,
    );
    assert!(
        none.unwrap() != answers[0],
        "{what}: no ray hits, nothing was compared"
    );
}

#[test]
fn files_of_other_programs_give_the_hits_of_nff() {
    let files = [
        ("trimesh.obj", "triangles.nff"),
        ("trimesh.ply", "triangles.nff"),
        ("trimesh-text.ply", "triangles.nff"),
        ("trimesh.stl", "triangles.nff"),
        ("trimesh-text.stl", "triangles.nff"),
        ("trimesh.glb", "triangles.nff"),
        ("trimesh.gltf", "triangles.nff"),
        ("meshio.obj", "polygons.nff"),
        ("meshio.ply", "polygons.nff"),
        ("meshio-text.ply", "polygons.nff"),
    ];
    for format in FORMATS {
        let with = |name: &str| format.extensions.iter().any(|e| name.ends_with(e));
        let tested = files.iter().any(|(name, _)| with(name));
        assert!(tested || format.write.is_some(), "{}", format.name);
    }
    for (name, in_nff) in files {
        same_hits(load(&asset(in_nff)), load(&asset(name)), name);
    }
}

#[test]
fn polygons_stay_polygons() {
    for name in ["meshio.obj", "meshio.ply", "meshio-text.ply"] {
        let objects = load(&asset(name)).objects;
        let count = |kind| objects.iter().filter(|o| o.kind() == kind).count();
        let counts = [PrimitiveKind::Polygon, PrimitiveKind::Triangle].map(count);
        assert_eq!(counts, [5, 6], "{name}");
    }
}

/// The triangles of tetra with coordinates that `f32` holds, and the same scene with them.
fn tetra() -> (Vec<[[f32; 3]; 3]>, SceneParts) {
    let mut parts = generate("tetra", Some(4)).unwrap();
    let mut triangles = Vec::new();
    for object in &mut parts.objects {
        let Primitive::Triangle(triangle) = object else {
            panic!("{object:?}")
        };
        let narrow = triangle.vertices.map(|v| v.as_vec3().to_array());
        triangle.vertices = narrow.map(|v| Vec3::from_array(v.map(f64::from)));
        triangles.push(narrow);
    }
    assert_eq!(triangles.len(), 256);
    // Through the text, so that it is NFF that is compared.
    let mut text = Vec::new();
    nff::write(&parts, &mut text).unwrap();
    (triangles, nff::read(&text, &Progress::new()).unwrap())
}

#[test]
fn stl_of_a_writer_crate_gives_the_hits_of_nff() {
    let (triangles, parts) = tetra();
    let facets: Vec<_> = triangles
        .iter()
        .map(|vertices| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0; 3]),
            vertices: vertices.map(stl_io::Vertex::new),
        })
        .collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, facets.iter()).unwrap();
    same_hits(parts.clone(), read("stl", &bytes).unwrap(), "stl_io");
    // Many programs begin the free text with the word that begins a text file.
    bytes[..5].copy_from_slice(b"solid");
    same_hits(
        parts.clone(),
        read("stl", &bytes).unwrap(),
        "solid, but binary",
    );
    // Nor does it become one by more that a text would have, or by bytes behind the end.
    bytes[..17].copy_from_slice(b"solid a\nfacet of\0");
    bytes.extend(b"end");
    let found = read("stl", &bytes).unwrap();
    let skipped = texts(&found, NoteKind::Skipped).join("; ");
    assert!(skipped.starts_with("3 bytes after the last"), "{skipped}");
    same_hits(parts, found, "much like a text, but binary");
}

#[test]
fn ply_of_a_writer_crate_gives_the_hits_of_nff() {
    use ply_rs_bw::ply::{
        Addable, DefaultElement, ElementDef, Encoding, Ply, Property, PropertyDef, PropertyType,
        ScalarType,
    };
    let (triangles, parts) = tetra();
    for encoding in [
        Encoding::Ascii,
        Encoding::BinaryBigEndian,
        Encoding::BinaryLittleEndian,
    ] {
        let mut ply = Ply::<DefaultElement>::new();
        ply.header.encoding = encoding;
        let mut vertex = ElementDef::new("vertex".into());
        for name in ["x", "y", "z"] {
            let double = PropertyType::Scalar(ScalarType::Double);
            vertex.properties.add(PropertyDef::new(name.into(), double));
        }
        let mut face = ElementDef::new("face".into());
        let list = PropertyType::List(ScalarType::UShort, ScalarType::UShort);
        face.properties
            .add(PropertyDef::new("vertex_index".into(), list));
        ply.header.elements.add(vertex);
        ply.header.elements.add(face);
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        for triangle in &triangles {
            let first = vertices.len() as u16;
            for vertex in triangle {
                let mut element = DefaultElement::new();
                for (name, value) in ["x", "y", "z"].into_iter().zip(vertex) {
                    element.insert(name.into(), Property::Double(f64::from(*value)));
                }
                vertices.push(element);
            }
            let mut element = DefaultElement::new();
            let indices = Property::ListUShort(vec![first, first + 1, first + 2]);
            element.insert("vertex_index".into(), indices);
            faces.push(element);
        }
        ply.payload.insert("vertex".into(), vertices);
        ply.payload.insert("face".into(), faces);
        let mut bytes = Vec::new();
        let writer = ply_rs_bw::writer::Writer::new();
        writer.write_ply(&mut bytes, &mut ply).unwrap();
        let what = format!("ply-rs-bw, {encoding:?}");
        same_hits(parts.clone(), read("ply", &bytes).unwrap(), &what);
    }
}

#[test]
fn every_vertex_of_ply_has_its_own_normal() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                property float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                9 9 9 1 0 0\n0 0 0 0 0 1\n1 0 0 0.6 0 0.8\n0 1 0 0 0.6 0.8\n3 1 2 3\n";
    let parts = read("ply", text.as_bytes()).unwrap();
    let Primitive::Triangle(triangle) = &parts.objects[0] else {
        panic!("not a triangle")
    };
    let normals = triangle.normals.as_ref().expect("normals at the vertices");
    let expected = [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8)];
    for (found, expected) in normals.iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-6), "{found}");
    }
}

#[test]
fn gltf_of_a_writer_crate_gives_the_hits_of_nff() {
    let (triangles, parts) = tetra();
    // Nodes move and turn the mesh to and fro, by amounts that numbers hold exactly.
    let file = crate::support::glb::file(&triangles, &crate::support::glb::to_and_fro());
    let found = read("gltf", &file.glb()).unwrap();
    same_hits(parts.clone(), found, "GLB");
    let found = read("gltf", &file.with_data_uri()).unwrap();
    same_hits(parts.clone(), found, "data URI");

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::create_dir(folder.path().join("buffers of it")).unwrap();
    std::fs::write(folder.path().join("buffers of it/a.bin"), &file.binary).unwrap();
    std::fs::write(&path, file.with_uri("buffers%20of%20it/a.bin")).unwrap();
    same_hits(parts, load(&path), "a file below");
}

#[test]
fn gltf_brings_camera_colours_and_lights() {
    let (triangles, _) = tetra();
    let parts = read(
        "gltf",
        &crate::support::glb::file(&triangles, &crate::support::glb::furnished()).glb(),
    )
    .unwrap();
    assert_eq!(parts.camera.from, Vec3::new(1.0, 2.0, 9.0));
    let [forward, _, up] = parts.camera.frame().unwrap();
    assert!(forward.abs_diff_eq(Vec3::NEG_Z, 1e-12) && up.abs_diff_eq(Vec3::Y, 1e-12));
    assert!((parts.camera.angle - 60.0).abs() < 1e-4);
    assert_eq!(parts.camera.resolution, [1024, 512]);
    let material = parts.materials[0];
    assert!(material.color.abs_diff_eq(Vec3::new(0.5, 0.25, 1.0), 1e-6));
    assert!((material.transmittance - 0.75).abs() < 1e-6 && material.index_of_refraction == 1.0);
    let positions: Vec<_> = parts.lights.iter().map(|l| l.position).collect();
    assert_eq!(
        positions,
        [Vec3::new(5.0, 0.0, 0.0), Vec3::new(0.0, 7.0, 0.0)]
    );
    // The brighter one has 1/√2, the other its share of that: half as strong, red only.
    let colors = [0, 1].map(|i| parts.lights[i].color.unwrap());
    assert!(colors[0].max_element() <= 0.5_f64.sqrt() + 1e-12);
    assert!(colors[1].y == 0.0 && colors[1].x > 0.0);
    let defaulted: Vec<_> = texts(&parts, NoteKind::Defaulted);
    assert_eq!(defaulted, ["no background color in the file; using gray"]);
}

/// The texts of the notes of one kind.
fn texts(parts: &SceneParts, kind: NoteKind) -> Vec<&str> {
    let of_kind = parts.notes.iter().filter(|note| note.kind == kind);
    of_kind.map(|note| note.text.as_str()).collect()
}

#[test]
fn the_content_tells_the_format_where_the_extension_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("trimesh.obj", "OBJ"),
        ("trimesh.ply", "PLY"),
        ("trimesh-text.ply", "PLY"),
        ("trimesh.stl", "STL"),
        ("trimesh-text.stl", "STL"),
        ("trimesh.glb", "GLTF"),
        ("triangles.nff", "NFF"),
    ];
    let expected = load(&asset("triangles.nff")).objects;
    for (name, format) in cases {
        let bytes = std::fs::read(asset(name)).unwrap();
        for other in [
            "scene",
            "scene.dat",
            "scene.nff",
            "scene.obj",
            "scene.PLY",
            "scene.glb",
        ] {
            let path = folder.path().join(other);
            std::fs::write(&path, &bytes).unwrap();
            let parts = load(&path);
            assert!(parts.objects == expected, "{name} as {other}");
            let said = &parts.notes[0].text;
            assert!(said.starts_with(format), "{said}");
            let extension = path.extension().map(|e| e.to_string_lossy().to_uppercase());
            let lies = extension
                .is_some_and(|e| e != "DAT" && e != format && !(e == "GLB" && format == "GLTF"));
            assert_eq!(said.contains("the extension is that of"), lies, "{said}");
        }
    }
}

#[test]
fn what_is_no_scene_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("notes.txt");
    for bytes in [
        &b"Dear diary,\nnothing today.\n"[..],
        b"",
        b"\x89PNG\r\n\x1a\n",
        b"{}",
    ] {
        std::fs::write(&path, bytes).unwrap();
        let error = read_file(&path, &Progress::new()).unwrap_err();
        assert!(matches!(error, FormatError::Unknown { .. }), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("notes.txt") && text.contains("NFF, OBJ, PLY"),
            "{text}"
        );
    }
}

/// A picture of the scene is neither empty nor dark.
#[test]
fn a_mesh_without_camera_and_lights_is_framed_and_lit() {
    for name in ["meshio.obj", "meshio.ply", "trimesh.stl", "trimesh.glb"] {
        let parts = load(&asset(name));
        let defaulted = texts(&parts, NoteKind::Defaulted).join("; ");
        for word in ["no camera", "no light", "using gray"] {
            assert!(defaulted.contains(word), "{name}: {defaulted}");
        }
        let scene = Scene::new(parts);
        let tree = tree_by(&scene, "sah-cut");
        let settings = RenderSettings {
            width: 40,
            height: 40,
            ..RenderSettings::for_camera(*scene.camera())
        };
        let (pool, progress) = (thread_pool(1).unwrap(), Progress::new());
        let picture = std::sync::Mutex::new(bspscope::trace::Picture::new(40, 40));
        bspscope::trace::render_timed(&scene, &tree, &settings, 0, &pool, &progress, |tile, c| {
            picture.lock().unwrap().add_tile(tile, 0, c);
        })
        .unwrap();
        let picture = picture.into_inner().unwrap();
        let (mut lit, mut seen) = (0, 0);
        for y in 0..40 {
            for x in 0..40 {
                let color = Vec3::from_array(picture.get(x, y).map(f64::from));
                let is_background = color.abs_diff_eq(scene.background(), 1e-6);
                seen += u32::from(!is_background);
                lit += u32::from(!is_background && color.max_element() > 0.1);
                let is_edge = [0, 39].contains(&x) || [0, 39].contains(&y);
                assert!(is_background || !is_edge, "{name}: cut off at {x}, {y}");
            }
        }
        assert!(
            seen > 300 && lit * 2 > seen,
            "{name}: {seen} seen, {lit} lit"
        );
    }
}

#[test]
fn a_scene_in_nff_without_lights_is_lit_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dark.nff");
    let text = std::fs::read_to_string(asset("polygons.nff")).unwrap();
    std::fs::write(&path, text.replace("l 5 -9 12\n", "")).unwrap();
    let parts = load(&path);
    assert_eq!(parts.lights.len(), 2);
    assert!(texts(&parts, NoteKind::Defaulted)[0].starts_with("no light"));
    let kept = load(&asset("polygons.nff"));
    assert_eq!(
        (kept.lights.len(), texts(&kept, NoteKind::Defaulted).len()),
        (1, 0)
    );
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_indices_count_forth_and_back() {
    let texts = [
        "f 1 2 3 4\n",
        "f -4 -3 -2 -1\n",
        "o a\ng b c\ns off\nvt 0 0\nf 1/1 2/1 3/1 4/1\n",
        "f 1 \\\n 2 3 \\\n 4\n",
        "f 1 2 3 4 # a comment\n",
        "f 1 2 3 4\nv 9 9 9",
    ];
    let expected = read("obj", format!("{SQUARE}{}", texts[0]).as_bytes()).unwrap();
    assert_eq!(expected.objects.len(), 1);
    for text in texts {
        let text = format!("{SQUARE}{text}");
        for text in [text.clone(), text.replace('\n', "\r\n")] {
            let parts = read("obj", text.as_bytes()).unwrap();
            assert!(parts.objects == expected.objects, "{text:?}");
        }
    }
    let smooth = format!("{SQUARE}vn 0 0 2\nvn 0 1 1\nf 1//1 2//2 3//-1 4//1\n");
    let Primitive::Polygon(polygon) = &read("obj", smooth.as_bytes()).unwrap().objects[0] else {
        panic!("not a polygon")
    };
    assert_eq!(polygon.vertex_normals().unwrap()[0], Vec3::Z);
}

#[test]
fn mtl_becomes_our_material() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    let faces = "usemtl glass\nf 1 2 3\nusemtl dull one\nf 1 3 4\nusemtl none\nf 1 2 4\n";
    std::fs::write(&path, format!("mtllib the materials.mtl\n{SQUARE}{faces}")).unwrap();
    let mtl = "# made by hand\nnewmtl glass\nKd 0.1 0.2 0.3\nKs 0.3 0.6 0.9\nNs 50\nd 0.25\n\
               Ni 1.5\nillum 7\nmap_Kd wood.png\nnewmtl dull one\nKd 0.5\nKs 1 1 1\nTr 0.25\nillum 2\n";
    std::fs::write(folder.path().join("the materials.mtl"), mtl).unwrap();
    let parts = load(&path);
    let [glass, dull, white] = parts.materials.as_slice() else {
        panic!("{:?}", parts.materials)
    };
    assert_eq!(glass.color, Vec3::new(0.1, 0.2, 0.3));
    assert!((glass.specular - 0.6).abs() < 1e-12 && glass.shine == 50.0);
    assert_eq!((glass.diffuse, glass.transmittance), (0.25, 0.75));
    assert_eq!(glass.index_of_refraction, 1.5);
    assert_eq!((dull.color, dull.specular), (Vec3::splat(0.5), 0.0));
    assert_eq!((dull.diffuse, dull.transmittance), (0.75, 0.25));
    assert_eq!(*white, bspscope::scene::Material::default());
    let skipped = texts(&parts, NoteKind::Skipped).join("; ");
    assert!(
        skipped.contains("the materials.mtl: statement 'map_Kd', at line 9"),
        "{skipped}"
    );
    assert!(skipped.contains("illum 2"), "{skipped}");
    let defaulted = texts(&parts, NoteKind::Defaulted).join("; ");
    assert!(
        defaulted.contains("material 'none' is not defined"),
        "{defaulted}"
    );
}

/// Nothing outside the file's folder is read, however it is named.
#[test]
fn files_elsewhere_are_not_read() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("inner");
    std::fs::create_dir(&folder).unwrap();
    let secret = outer.path().join("secret.mtl");
    std::fs::write(&secret, "newmtl m\nKd 1 0 0\n").unwrap();
    std::os::unix::fs::symlink(&secret, folder.join("link.mtl")).unwrap();
    std::fs::create_dir(folder.join("below")).unwrap();
    std::fs::copy(&secret, folder.join("below/near.mtl")).unwrap();
    let path = folder.join("a.obj");
    let absolute = secret.display().to_string();
    for (name, inside) in [
        ("below/near.mtl", true),
        ("below\\near.mtl", true),
        ("./below/near.mtl", true),
        ("../secret.mtl", false),
        ("below/../../secret.mtl", false),
        ("link.mtl", false),
        (absolute.as_str(), false),
        ("absent.mtl", false),
    ] {
        let text = format!("mtllib {name}\n{SQUARE}usemtl m\nf 1 2 3\n");
        std::fs::write(&path, text).unwrap();
        let parts = load(&path);
        let is_red = parts.materials[0].color == Vec3::X;
        assert_eq!(is_red, inside, "{name}: {:?}", parts.notes);
        let skipped = texts(&parts, NoteKind::Skipped).join("; ");
        assert_eq!(
            skipped.contains("material file"),
            !inside,
            "{name}: {skipped}"
        );
    }
    let (triangles, _) = tetra();
    let file = crate::support::glb::file(&triangles, &crate::support::glb::to_and_fro());
    std::fs::write(outer.path().join("secret.bin"), &file.binary).unwrap();
    let path = folder.join("a.gltf");
    for uri in [
        "../secret.bin",
        "%2e%2e/secret.bin",
        "file:///etc/passwd",
        "/etc/passwd",
    ] {
        std::fs::write(&path, file.with_uri(uri)).unwrap();
        let error = read_file(&path, &Progress::new()).unwrap_err().to_string();
        assert!(
            error.contains("buffer 0: expected the file"),
            "{uri}: {error}"
        );
    }
}

#[test]
fn what_is_skipped_is_counted_with_its_first_place() {
    let text = format!("{SQUARE}f 1 1 2\nf 1 2\nl 1 2\nf 1 2 2\ncurv 0 1 1 2\nf 1 2 3\n");
    let parts = read("obj", text.as_bytes()).unwrap();
    assert_eq!(parts.objects.len(), 1);
    assert_eq!(
        texts(&parts, NoteKind::Skipped),
        [
            "2 × polygon with zero area, first at line 5",
            "face of fewer than 3 vertices, at line 6",
            "line (not a surface), at line 7",
            "unknown statement 'curv', at line 9",
        ]
    );
    assert_eq!(
        texts(&parts, NoteKind::Read),
        ["triangles: 1, materials in use: 1, lights: 0, cameras: 0"]
    );
    let bent = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n";
    let parts = read("obj", bent.as_bytes()).unwrap();
    assert_eq!(parts.objects.len(), 2);
    assert_eq!(
        texts(&parts, NoteKind::Changed),
        ["non-planar polygon split into triangles, at line 5"]
    );
}

/// A file of many facets, in every format.
fn many(format: &str) -> Vec<u8> {
    const COUNT: usize = 50_000;
    let triangles = vec![[[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]; COUNT];
    match format {
        "obj" => (SQUARE.to_owned() + &"f 1 2 3\n".repeat(COUNT)).into_bytes(),
        "stl" => {
            let facet = stl_io::Triangle {
                normal: stl_io::Normal::new([0.0; 3]),
                vertices: triangles[0].map(stl_io::Vertex::new),
            };
            let mut bytes = Vec::new();
            stl_io::write_stl(&mut bytes, vec![facet; COUNT].iter()).unwrap();
            bytes
        }
        "ply" => {
            let header = format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nelement face {COUNT}\n\
                 property list uchar int vertex_indices\nend_header\n"
            );
            (header + "0 0 0\n1 0 0\n0 1 0\n" + &"3 0 1 2\n".repeat(COUNT)).into_bytes()
        }
        "gltf" => crate::support::glb::file(&triangles, &crate::support::glb::to_and_fro()).glb(),
        "nff" => {
            let view = "v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45 hither 1 resolution 8 8\n";
            (view.to_owned() + &"p 3 0 0 0 1 0 0 0 1 0\n".repeat(COUNT)).into_bytes()
        }
        other => panic!("no file of many facets in {other}"),
    }
}

/// Cancels once a fifth is read; the answer, and how far it was.
fn cancelled_amid(format: &Format, bytes: &[u8]) -> (Result<SceneParts, ReadError>, f64) {
    let progress = Progress::new();
    let (ended, watched) = (AtomicBool::new(false), progress.clone());
    let result = std::thread::scope(|scope| {
        scope.spawn(|| {
            while watched.fraction() < 0.2 && !ended.load(Ordering::Relaxed) {
                std::thread::yield_now();
            }
            watched.cancel();
        });
        let result = (format.read)(&Input::from(bytes), &progress);
        ended.store(true, Ordering::Relaxed);
        result
    });
    (result, progress.fraction())
}

#[test]
fn reading_tells_how_far_it_is_and_stops_in_the_middle() {
    for format in FORMATS {
        let bytes = many(format.name);
        // On a busy machine it may be done before anybody looks.
        let stopped = (0..50).any(|_| {
            let (result, fraction) = cancelled_amid(format, &bytes);
            let amid = result == Err(ReadError::Cancelled(Cancelled));
            assert!(!amid || (0.2..1.0).contains(&fraction), "{fraction}");
            amid
        });
        assert!(stopped, "{} cannot be cancelled", format.name);
        // Told to stop before it begins, it reads nothing.
        let stopped = Progress::new();
        stopped.cancel();
        let result = (format.read)(&Input::from(bytes.as_slice()), &stopped);
        assert_eq!(result, Err(ReadError::Cancelled(Cancelled)));
        let whole = (format.read)(&Input::from(bytes.as_slice()), &Progress::new());
        assert_eq!(whole.unwrap().objects.len(), 50_000, "{}", format.name);
    }
}

#[test]
fn a_cancelled_load_is_no_failure() {
    let progress = Progress::new();
    progress.cancel();
    let request = SceneRequest::parse(asset("trimesh.glb").to_str().unwrap());
    let error = bspscope::scene::load(&request, &progress).unwrap_err();
    assert!(matches!(error, LoadError::Cancelled(_)), "{error:?}");
}

#[test]
fn faces_of_too_many_vertices_are_skipped() {
    let corners = " 1 2 3 4".repeat(MAX_VERTICES / 4 + 1);
    let text = format!("{SQUARE}f{corners}\nf 1 2 3 4\n");
    let parts = read("obj", text.as_bytes()).unwrap();
    assert_eq!(parts.objects.len(), 1);
    let said = format!("face of more than {MAX_VERTICES} vertices, at line 5");
    assert_eq!(texts(&parts, NoteKind::Skipped), [said]);
}

#[test]
fn however_many_reasons_there_are_all_is_counted() {
    let statements: Vec<_> = (0..200).map(|i| format!("x{i}\n")).collect();
    let text = format!("{}f 1 2 3\n", statements.concat() + SQUARE);
    let parts = read("obj", text.as_bytes()).unwrap();
    let skipped = texts(&parts, NoteKind::Skipped);
    assert_eq!(skipped[0], "unknown statement 'x0', at line 1");
    let others: usize = 200 - (skipped.len() - 1);
    assert!(others > 100);
    let last = format!("{others} × other reasons, first at line {}", skipped.len());
    assert_eq!(*skipped.last().unwrap(), last);
}
