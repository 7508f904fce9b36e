//! Workspaces as files: written and read again they are the same; what is wrong is told with its
//! line; nothing is half-loaded.

use bspscope::geometry::{Axis, Vec3};
use bspscope::measure::model::Region;
use bspscope::present::overlay::{Outside, Visited};
use bspscope::scene::{Camera, Cylinders, Sampling, SceneRequest, SceneSource};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, MaxDepth, Method, Moment, OverlapRule, RootMargin};
use bspscope::trace::{KernelChoice, PrecisionChoice, RenderSettings};
use bspscope::workspace::{
    Arrangement, CutSettings, Heat, NODES_PER_RAY, PicturePlace, Selected, VERSION, View,
    View3dSettings, Which, Workspace, WorkspaceError,
};
use std::path::Path;

const CAMERA: Camera = Camera {
    from: Vec3::new(-1.25, 1e-7, 3.0),
    at: Vec3::new(0.1, 0.2, 0.3),
    up: Vec3::Z,
    angle: 33.3,
    near: 1.0,
    resolution: [512, 512],
};

fn settings(method: &str) -> Setup {
    Setup {
        build: BuildSettings::for_method(Method::named(method).unwrap()),
        ..Setup::new(SceneRequest::parse("balls:3"))
    }
}

/// Unlike the defaults in everything.
fn changed() -> Workspace {
    let mut b = settings("sah-cut");
    b.scene.cylinders = Cylinders::Polygons(10);
    b.build.d_max = MaxDepth::Automatic;
    b.build.n_oilf = 4;
    b.build.root_margin = RootMargin::Length(0.1);
    b.build.overlap = OverlapRule::Exact;
    b.build.first_axis = Axis::Y;
    b.build.constants.insert("gap-fraction".into(), 0.05);
    b.build.memory_limit = 1 << 30;
    b.render = RenderSettings {
        camera: CAMERA.into(),
        width: 640,
        height: 360,
        samples: 16,
        d_arec: 2,
        min_contribution: 0.1,
        precision: PrecisionChoice::Auto,
        kernel: KernelChoice::Stream,
        sampling: Sampling::Corner,
        threads: 3,
    };
    let mut a = settings("midpoint");
    a.render.camera = CAMERA.into();
    let mut workspace = Workspace::new(a);
    workspace.notes = "Two lines,\nwith \"quotes\" and \\ and Δ.".into();
    workspace.b = Some(b);
    workspace.view = View {
        front: Which::B,
        arrangement: Arrangement::Beside,
        split: 0.7,
        pinned: vec![[1, 2], [300, 4]],
        picture: PicturePlace {
            zoom: Some(2.5),
            offset: [-10.25, 3.0],
        },
        region: Some(Region {
            x: 1,
            y: 2,
            width: 30,
            height: 40,
        }),
        selected: Selected {
            pixel: Some([7, 9]),
            ray: 2,
            step: 5,
            node: Some(11),
            object: Some(3),
        },
        build: Some(Moment::Node(7)),
        ranges: [("depth", [2.0, 5.0]), (NODES_PER_RAY, [10.0, 20.5])]
            .map(|(name, range)| (name.to_owned(), range))
            .into(),
        heatmap: Heat {
            show: Some("N_NODES".into()),
            rays: "shadow".into(),
            scale: "log".into(),
            range: Some([0.0, 120.5]),
            opacity: 0.6,
            ..Heat::default()
        },
        view3d: View3dSettings {
            objects: false,
            leaf_boxes: false,
            coloring: "objects".into(),
            full_leaves: false,
            empty_leaves: false,
            visited: Visited::Never,
            outside: Outside::Hidden,
            least_depth: 3,
            greatest_depth: Some(9),
            only_visited: true,
            cells_to_depth: Some(4),
            all_rays: false,
            orthographic: true,
            camera: Some(CAMERA),
            same_camera: true,
            cut: CutSettings {
                on: true,
                axis: Axis::Z,
                places: [0.25, 0.5, 0.75],
                hides_less: true,
            },
        },
    };
    workspace.layout = Some(serde_json::json!({"left": {"shown": false}, "dark": null}));
    workspace
}

#[test]
fn a_workspace_written_and_read_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.bspscope");
    for workspace in [changed(), Workspace::new(settings("midpoint"))] {
        workspace.write(&path).unwrap();
        assert_eq!(Workspace::read(&path).unwrap(), workspace);
    }
    assert!(Workspace::is_path(&path) && !Workspace::is_path(Path::new("a.nff")));
}

/// As version 1 of the format had it.
const VERSION_1: &str = r#"
version = 1
notes = "Old."

[scene]
generator = "balls:3"

[camera]
from = [-1.25, 0.0000001, 3.0]
at = [0.1, 0.2, 0.3]
up = [0.0, 0.0, 1.0]
angle = 33.3
hither = 1.0
resolution = [512, 512]

[a]
cylinders = "exact"

[a.tree]
method = "midpoint"
d_max = 20
n_oilf = 1
root_margin = 0.001
overlap = "paper"
first_axis = "x"
memory_limit = 4294967296

[a.tree.constants]

[a.picture]
resolution = [512, 512]
samples = 1
d-arec = 4
cut-off = 0.0
precision = "f64"
kernel = "plain"
sampling = "center"
threads = 0

[b]
cylinders = "polygons:10"

[b.tree]
method = "sah-cut"
d_max = "auto"
n_oilf = 4
root_margin = 0.1
overlap = "exact"
first_axis = "y"
memory_limit = 1073741824

[b.tree.constants]
gap-fraction = 0.05

[b.picture]
resolution = [640, 360]
samples = 16
d-arec = 2
cut-off = 0.1
precision = "auto"
kernel = "lanes"
sampling = "corner"
threads = 3
"#;

#[test]
fn files_of_version_1_are_read() {
    let read = Workspace::parse(VERSION_1, Path::new("a.bspscope")).unwrap();
    let mut changed = changed();
    changed.a.build.root_margin = RootMargin::Length(0.001);
    assert_eq!(read.a, changed.a);
    assert_eq!(read.b, changed.b);
    assert_eq!(read.notes, "Old.");
    let wrong = VERSION_1.replace("cut-off = 0.1", "cut-off = 2.0");
    let error = Workspace::parse(&wrong, Path::new("a.bspscope")).unwrap_err();
    let line = wrong.lines().position(|l| l == "cut-off = 2.0").unwrap() + 1;
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("a.bspscope:{line}: ")),
        "{message}"
    );
}

#[test]
fn the_file_can_be_read_by_people() {
    let text = changed().to_text(None);
    assert!(text.starts_with("# A workspace of bspscope"));
    for line in [
        "version = 2",
        "generator = \"balls:3\"",
        "method = \"midpoint\"",
        "d-max = 20",
        "d-max = \"auto\"",
        "cylinders = \"polygons:10\"",
        "overlap = \"exact\"",
        "gap-fraction = 0.05",
        "resolution = [640, 360]",
        "d-arec = 2",
        "arrangement = \"side by side\"",
        "split = 0.7",
        "opacity = 0.6",
        "show = \"N_NODES\"",
        "axis = \"z\"",
        "from = [-1.25, 0.0000001, 3.0]",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
}

#[test]
fn what_is_left_out_of_the_view_is_at_its_default() {
    let text = changed().to_text(None);
    let head = &text[..text.find("[view]").expect("a view")];
    let read = Workspace::parse(head, Path::new("a.bspscope")).unwrap();
    assert_eq!(read.view, View::default());
    assert_eq!(read.b, changed().b);
}

#[test]
fn the_histogram_of_nodes_per_ray_is_read_by_its_earlier_name() {
    let text = changed().to_text(None);
    let earlier = text.replace(NODES_PER_RAY, "nodes a ray");
    assert_ne!(earlier, text);
    let read = Workspace::parse(&earlier, Path::new("a.bspscope")).unwrap();
    assert_eq!(read, changed());
}

#[test]
fn a_scene_is_found_from_the_folder_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().canonicalize().unwrap();
    for name in ["scenes", "work"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    let scene = folder.join("scenes/a b.nff");
    std::fs::write(&scene, "b 0 0 0\n").unwrap();
    let path = folder.join("work/a.bspscope");
    let mut setup = settings("midpoint");
    setup.scene.source = SceneSource::File(scene.clone());
    let mut workspace = Workspace::new(setup);
    workspace.scene_sha256 = Some(bspscope::files::sha256(&scene).unwrap());
    workspace.write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("file = \"../scenes/a b.nff\""), "{text}");
    assert_eq!(Workspace::read(&path).unwrap(), workspace);
    // Both moved together, it is still found.
    let elsewhere = folder.join("elsewhere");
    std::fs::create_dir(&elsewhere).unwrap();
    for name in ["scenes", "work"] {
        std::fs::rename(folder.join(name), elsewhere.join(name)).unwrap();
    }
    let read = Workspace::read(&elsewhere.join("work/a.bspscope")).unwrap();
    let moved = elsewhere.join("scenes/a b.nff");
    assert_eq!(read.a.scene.source, SceneSource::File(moved.clone()));
    assert!(!read.scene_was_changed());
    std::fs::write(&moved, "b 1 0 0\n").unwrap();
    assert!(read.scene_was_changed());
    // A scene that is gone is told by whoever opens it.
    std::fs::remove_file(&moved).unwrap();
    let gone = Workspace::read(&elsewhere.join("work/a.bspscope")).unwrap();
    assert!(matches!(gone.a.scene.source, SceneSource::File(path) if !path.exists()));
}

/// The message about a text.
fn message(text: &str) -> String {
    let path = Path::new("some/a.bspscope");
    Workspace::parse(text, path).unwrap_err().to_string()
}

/// The text of a workspace with one line changed, and that line's number.
fn with(line: &str, changed_to: &str) -> (String, usize) {
    let text = changed().to_text(None);
    let number = text.lines().position(|l| l == line);
    let number = number.unwrap_or_else(|| panic!("{line} in\n{text}")) + 1;
    (text.replacen(line, changed_to, 1), number)
}

#[test]
fn mistakes_are_told_with_file_line_and_reason() {
    for (line, wrong, reason) in [
        ("d-max = \"auto\"", "d-max = \"deep\"", "expected a depth"),
        ("d-max = \"auto\"", "d-max = 101", "from 0 to 100"),
        ("method = \"sah-cut\"", "method = \"best\"", "found 'best'"),
        ("split = 0.7", "split = 7", "from 0 to 1"),
        ("zoom = 2.5", "zoom = 0", "from 0.02 to 200"),
        ("node = 7", "nod = 7", "unknown variant `nod`"),
        (
            "depth = [2.0, 5.0]",
            "dpth = [2.0, 5.0]",
            "no histogram is called 'dpth'",
        ),
        ("width = 30", "width = -30", "expected u32"),
        (
            "show = \"N_NODES\"",
            "show = \"N_X\"",
            "no heatmap is called 'N_X'",
        ),
        ("rays = \"shadow\"", "rays = 3", "expected a string"),
        ("front = \"b\"", "frnt = \"b\"", "unknown field `frnt`"),
        ("samples-per-pixel = 16", "samples-per-pixel = ", "value"),
        (
            "min-contribution = 0.1",
            "min-contribution = 1.1",
            "from 0 to 1",
        ),
        (
            "samples-per-pixel = 16",
            "samples-per-pixel = 0",
            "from 1 to",
        ),
        (
            "resolution = [640, 360]",
            "resolution = [640, 0]",
            "at least 1 pixel",
        ),
        ("root-margin = 0.1", "root-margin = -1.0", "root-margin"),
        ("threads = 3", "thrads = 3", "no setting 'thrads'"),
    ] {
        let (text, number) = with(line, wrong);
        let message = message(&text);
        let place = format!("some/a.bspscope:{number}: ");
        assert!(
            message.starts_with(&place),
            "{wrong}: {message}, not {place}"
        );
        assert!(message.contains(reason), "{wrong}: {message}");
    }
    // These are told where the table begins.
    for (line, wrong, reason) in [
        ("gap-fraction = 0.05", "gap = 0.05", "no setting 'gap'"),
        (
            "generator = \"balls:3\"",
            "generator = \"bells\"",
            "'bells'",
        ),
        ("generator = \"balls:3\"", "", "file or its generator"),
    ] {
        let message = message(&with(line, wrong).0);
        assert!(message.contains(reason), "{wrong}: {message}");
    }
    assert!(message("").contains("missing field `version`"));
}

#[test]
fn a_newer_version_says_so() {
    let newer = format!("version = {}", VERSION + 1);
    // Whatever else it may hold.
    let text = with("version = 2", &newer).0 + "\n[holograms]\non = true\n";
    let error = Workspace::parse(&text, Path::new("a.bspscope")).unwrap_err();
    assert!(matches!(error, WorkspaceError::Newer { found, .. } if found == VERSION + 1));
    assert!(error.to_string().contains("newer bspscope"), "{error}");
    assert!(error.to_string().contains("nothing was loaded"), "{error}");
}

#[test]
fn what_is_no_workspace_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.bspscope");
    let error = || Workspace::read(&path).unwrap_err();
    assert!(matches!(error(), WorkspaceError::Io { .. }));
    std::fs::write(&path, [0xff, 0xfe]).unwrap();
    assert!(matches!(error(), WorkspaceError::NotText { .. }));
    std::fs::write(&path, vec![b'#'; 5 << 20]).unwrap();
    assert!(matches!(error(), WorkspaceError::TooLarge { .. }));
    assert!(Workspace::read(folder.path()).is_err());
}

#[test]
fn requests_are_told_from_files() {
    let request = SceneRequest::parse("tetra:3");
    assert_eq!(SceneSource::generator("tetra:3"), Some(request.source));
    for other in ["tetra:x", "tetrahedron", ""] {
        assert_eq!(SceneSource::generator(other), None, "{other}");
    }
}
