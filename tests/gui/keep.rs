//! Workspaces in the window: saved, changed and restored it is the same; the last session comes
//! back; what cannot be opened leaves everything as it was.

use crate::harness::{
    SIZE, Window, click, finish, has, open, open_pane, open_sized, open_with_graphics, press,
    small, wait,
};
use bspscope::gui::StartOptions;
use bspscope::measure::model::Region;
use bspscope::scene::SceneSource;
use bspscope::structure::{MaxDepth, Moment};
use bspscope::workspace::{Arrangement, NODES_PER_RAY, VERSION, Workspace};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::path::Path;

const COMMAND_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Types into the field that asks where to save, and saves there.
fn save_to(window: &mut Window<'_>, path: &Path, said: &str) {
    wait(window, "the question where", |w| has(w, "Browse…"));
    let role = egui::accesskit::Role::TextInput;
    window
        .get_by_role_and_label(role, "Path to save to")
        .focus();
    window.run_steps(2);
    press(window, Modifiers::COMMAND, Key::A);
    let input = window.get_by_role_and_label(role, "Path to save to");
    input.type_text(path.to_str().expect("text"));
    window.run_steps(2);
    window.key_press(Key::Enter);
    wait(window, "the file", |w| has(w, said));
    press(window, Modifiers::NONE, Key::Escape);
}

fn save_as(window: &mut Window<'_>, path: &Path) -> Workspace {
    press(window, COMMAND_SHIFT, Key::S);
    save_to(window, path, "Workspace saved:");
    Workspace::read(path).unwrap()
}

/// Opens what is typed into the path field.
fn open_path(window: &mut Window<'_>, path: &Path) {
    press(window, Modifiers::COMMAND, Key::L);
    window.run_steps(3);
    let role = egui::accesskit::Role::TextInput;
    let field = window.get_by_role_and_label(role, "Path of a scene");
    field.focus();
    window.run_steps(2);
    press(window, Modifiers::COMMAND, Key::A);
    let field = window.get_by_role_and_label(role, "Path of a scene");
    field.type_text(path.to_str().expect("text"));
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(2);
}

const BALL: &str = "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 32 32\n\
                    b 0 0 0\nl 5 -5 5\nf 1 0 0 1 0 0 0 1\ns 0 0 0 1\n";

#[test]
fn saved_changed_and_restored_it_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("first.bspscope");
    // High enough for the panel of notes to be in view.
    let mut window = open_sized(small("balls:1"), [1500.0, 1600.0], false);
    finish(&mut window);
    // Two trees, settings of their own, a moment of the build, a zoom, a heatmap, a picked and pinned
    // pixel, a step of its walk.
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait(&mut window, "both", |w| has(w, "Fair comparison"));
    click(&mut window, "Wipe");
    press(&mut window, Modifiers::NONE, Key::J);
    press(&mut window, Modifiers::COMMAND, Key::ArrowDown);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::G);
    press(&mut window, Modifiers::ALT, Key::ArrowRight);
    press(&mut window, Modifiers::ALT, Key::ArrowRight);
    open_pane(&mut window, "Rays of the pixel");
    window.get_by_label("Traced picture").click();
    wait(&mut window, "the object", |w| has(w, "Hits sphere "));
    press(&mut window, Modifiers::COMMAND, Key::Num0);
    press(&mut window, Modifiers::NONE, Key::P);
    press(&mut window, Modifiers::NONE, Key::H);
    press(&mut window, Modifiers::NONE, Key::Period);
    open_pane(&mut window, "Notes");
    let role = egui::accesskit::Role::MultilineTextInput;
    let notes = window.get_by_role_and_label(role, "Text of the notes");
    notes.focus();
    notes.type_text("Look at the middle.");
    window.run_steps(3);
    let saved = save_as(&mut window, &path);
    assert_eq!(saved.notes, "Look at the middle.");
    assert_eq!(saved.a.scene.source, SceneSource::parse("balls:1"));
    assert_eq!(saved.a.build.method.name, "midpoint");
    let b = saved.b.as_ref().expect("a second tree");
    assert_eq!(b.build.method.name, "sah-cut");
    assert_eq!(saved.view.arrangement, Arrangement::Wipe);
    assert!(saved.view.heatmap.show.is_some());
    let selected = saved.view.selected;
    assert_eq!(saved.view.pinned, [selected.pixel.unwrap()]);
    assert!(selected.step > 0 && selected.node.is_some() && selected.object.is_some());
    assert_eq!(saved.view.build, Some(Moment::Node(2)));
    assert_eq!(saved.view.picture.zoom, Some(1.0));
    assert!(saved.layout.is_some());
    // What is dragged in panes, changed by hand in the file.
    let mut saved = saved;
    saved.view.picture.offset = [-12.0, 7.5];
    saved.view.region = Some(Region {
        x: 3,
        y: 4,
        width: 10,
        height: 20,
    });
    let ranges = [("depth", [1.0, 5.0]), (NODES_PER_RAY, [2.0, 9.0])];
    saved.view.ranges = ranges.map(|(name, range)| (name.to_owned(), range)).into();
    saved.write(&path).unwrap();

    // Everything else.
    press(&mut window, Modifiers::COMMAND, Key::E);
    open_path(&mut window, Path::new("tetra:2"));
    wait(&mut window, "the other scene", |w| {
        has(w, "tetra:2 · sah-cut")
    });
    press(&mut window, Modifiers::COMMAND, Key::ArrowUp);
    press(&mut window, Modifiers::COMMAND, Key::B);
    finish(&mut window);
    let other = save_as(&mut window, &folder.path().join("second.bspscope"));
    assert_ne!(other.a, saved.a);
    assert!(other.b.is_none() && other.layout != saved.layout);
    assert!(other.view.build.is_none() && other.view.ranges.is_empty());

    open_path(&mut window, &path);
    wait(&mut window, "the workspace", |w| {
        has(w, "balls:1 · sah-cut")
    });
    finish(&mut window);
    window.run_steps(40);
    let again = save_as(&mut window, &folder.path().join("third.bspscope"));
    assert_eq!(again, saved);

    // In another window it is the same, too.
    let start = StartOptions {
        workspace: Some((path.clone(), saved.clone())),
        ..small("rings:1")
    };
    let mut window = open(start);
    finish(&mut window);
    window.run_steps(40);
    let again = save_as(&mut window, &folder.path().join("fourth.bspscope"));
    assert_eq!(
        (again.view, again.a, again.b),
        (saved.view, saved.a, saved.b)
    );
}

#[test]
fn saving_again_asks_nothing_and_a_changed_scene_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("one-ball.nff");
    std::fs::write(&scene, BALL).unwrap();
    let path = folder.path().join("ball.bspscope");
    let mut window = open(small(scene.to_str().unwrap()));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    save_to(&mut window, &path, "Workspace saved:");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("file = \"one-ball.nff\""), "{text}");
    press(&mut window, Modifiers::COMMAND, Key::ArrowDown);
    press(&mut window, Modifiers::COMMAND, Key::S);
    wait(&mut window, "the file", |w| has(w, "Workspace saved:"));
    let saved = Workspace::read(&path).unwrap();
    assert_eq!(saved.a.build.d_max, MaxDepth::Fixed(19));

    std::fs::write(&scene, BALL.replace("s 0 0 0 1", "s 0 0 0 0.5")).unwrap();
    open_path(&mut window, &path);
    wait(&mut window, "the change", |w| has(w, "was changed since"));
    finish(&mut window);

    std::fs::remove_file(&scene).unwrap();
    open_path(&mut window, &path);
    wait(&mut window, "the reason", |w| {
        has(w, "its scene is not there")
    });
    assert!(has(&window, "one-ball · midpoint · depth 19"));
}

#[test]
fn what_cannot_be_opened_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("newer.bspscope");
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = save_as(&mut window, &path);
    let text = std::fs::read_to_string(&path).unwrap();
    let newer = format!("version = {}", VERSION + 1);
    for (wrong, reason) in [
        (
            text.replace(&format!("version = {VERSION}"), &newer),
            "newer bspscope",
        ),
        (text.replace("balls:1", "bells"), "'bells'"),
        (text.replace("\n[a]", "\n[a"), "newer.bspscope:"),
    ] {
        assert_ne!(wrong, text);
        std::fs::write(&path, wrong).unwrap();
        open_path(&mut window, &path);
        wait(&mut window, reason, |w| has(w, reason));
        assert!(has(&window, "could not be opened"));
        press(&mut window, Modifiers::NONE, Key::Escape);
        finish(&mut window);
        let after = save_as(&mut window, &folder.path().join("after.bspscope"));
        assert_eq!(after, before);
    }
}

#[test]
fn the_last_session_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let settings = tempfile::tempdir().unwrap();
    let scene = folder.path().join("one-ball.nff");
    std::fs::write(&scene, BALL).unwrap();
    let start = |scene: &str| StartOptions {
        remember: true,
        last_session: true,
        settings_folder: Some(settings.path().to_owned()),
        ..small(scene)
    };
    let session = settings.path().join("session.bspscope");
    let mut window = open(start(scene.to_str().unwrap()));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::M);
    finish(&mut window);
    let kept = |_: &Window<'_>| {
        Workspace::read(&session).is_ok_and(|w| w.a.build.method.name == "sah-cut")
    };
    wait(&mut window, "the session", kept);
    drop(window);

    let mut window = open(start("balls:1"));
    wait(&mut window, "the session", |w| has(w, "one-ball · sah-cut"));
    drop(window);

    // Asked for a scene, it opens that.
    let mut window = open(StartOptions {
        last_session: false,
        ..start("balls:1")
    });
    wait(&mut window, "the scene", |w| has(w, "balls:1 · midpoint"));
    let newest = SceneSource::parse("balls:1");
    wait(&mut window, "the newest session", |_| {
        Workspace::read(&session).is_ok_and(|w| w.a.scene.source == newest)
    });
    drop(window);

    let mut gone = Workspace::read(&session).unwrap();
    gone.a.scene.source = SceneSource::File(folder.path().join("gone.nff"));
    gone.write(&session).unwrap();
    let mut window = open(start("balls:1"));
    wait(&mut window, "the reason", |w| {
        has(w, "The last session could not be restored") && has(w, "gone.nff")
    });
    wait(&mut window, "the scene", |w| has(w, "balls:1 · midpoint"));
}

#[test]
fn settings_and_camera_are_copied_as_a_command() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::M);
    // In one frame: the output is that of the last.
    let events = &mut window.input_mut().events;
    events.push(egui::Event::ModifiersChanged(COMMAND_SHIFT));
    events.push(egui::Event::Key {
        key: Key::C,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: COMMAND_SHIFT,
    });
    window.step();
    let commands = &window.output().platform_output.commands;
    let copied = commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let expected = "bspscope measure balls:1 --method sah-cut --resolution 48x48 --d-arec 4 \
                    --threads 2";
    assert_eq!(copied.as_deref(), Some(expected));
    wait(&mut window, "the message", |w| has(w, expected));
}

#[test]
fn workspaces_are_among_the_recent_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.bspscope");
    let mut window = open(small("balls:1"));
    finish(&mut window);
    save_as(&mut window, &path);
    open_path(&mut window, Path::new("tetra:1"));
    wait(&mut window, "the other scene", |w| {
        has(w, "tetra:1 · midpoint")
    });
    window.get_by_label_contains("Scene: ").click();
    window.run_steps(3);
    let item = window.get_by_label_contains("mine.bspscope");
    assert!(!item.accesskit_node().is_disabled());
    item.click();
    wait(&mut window, "the workspace", |w| {
        has(w, "balls:1 · midpoint")
    });
}

/// Exports what a key asks for to a path, and gives its bytes.
fn export(window: &mut Window<'_>, key: Key, path: &Path) -> Vec<u8> {
    press(window, Modifiers::ALT, key);
    save_to(window, path, "Exported:");
    std::fs::read(path).unwrap()
}

#[test]
fn what_is_shown_is_exported_in_the_background() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    // Without a heatmap there is none to export.
    press(&mut window, Modifiers::ALT, Key::Num2);
    wait(&mut window, "the reason", |w| has(w, "no heatmap is shown"));
    press(&mut window, Modifiers::NONE, Key::Escape);

    let bytes = export(&mut window, Key::Num1, &place("a.png"));
    let picture = image::load_from_memory(&bytes).unwrap();
    assert_eq!((picture.width(), picture.height()), (SIZE, SIZE));
    assert!(export(&mut window, Key::Num1, &place("a.exr")).starts_with(b"v/1\x01"));

    window.get_by_label("Traced picture").hover();
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::H);
    wait(&mut window, "the heatmap", |w| has(w, "Legend from"));
    let bytes = export(&mut window, Key::Num2, &place("heat.png"));
    let drawn = image::load_from_memory(&bytes).unwrap();
    // Around it stand title, colour bar and figures, as on the command line.
    assert!(drawn.width() > 400 && drawn.height() > SIZE + 150);
    let command = std::process::Command::new(env!("CARGO_BIN_EXE_bspscope"))
        .args([
            "render",
            "balls:1",
            "--resolution",
            "48x48",
            "--show",
            "N_NODES",
            "-o",
        ])
        .arg(place("command.png"))
        .status();
    assert!(command.unwrap().success());
    assert_eq!(bytes, std::fs::read(place("command.png")).unwrap());

    let bytes = export(&mut window, Key::Num3, &place("view.png"));
    let view = image::load_from_memory(&bytes).unwrap().to_rgb8();
    let rect = window.get_by_label("3D view of scene and tree").rect();
    let off = (view.width() as f32 - rect.width()).abs();
    assert!(off < 2.0, "{} of {rect}", view.width());
    let colors: std::collections::HashSet<_> = view.pixels().collect();
    assert!(
        colors.len() > 50,
        "boxes, objects and a legend, not a plain ground"
    );

    let json = export(&mut window, Key::Num4, &place("figures.json"));
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    let leaves = json["runs"][0]["parameters"]["N_LS"].as_u64().unwrap();
    assert!(export(&mut window, Key::Num4, &place("figures.tex")).starts_with(b"%"));
    let obj = String::from_utf8(export(&mut window, Key::Num5, &place("leaves.obj"))).unwrap();
    let boxes = obj.lines().filter(|line| line.starts_with("o leaf-"));
    assert_eq!(boxes.count() as u64, leaves);
    let page = String::from_utf8(export(&mut window, Key::Num6, &place("report.html"))).unwrap();
    assert!(page.contains(&format!("<data value=\"{leaves}\">")));
    assert_eq!(page.matches("data:image/png;base64,").count(), 3);
}

#[test]
fn a_place_where_nothing_can_be_written_is_told_before_and_an_error_after() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    press(&mut window, Modifiers::ALT, Key::Num1);
    let role = egui::accesskit::Role::TextInput;
    for (path, reason) in [
        ("/not/there/a.png", "There is no folder /not/there"),
        ("/tmp", "This is a folder"),
        ("a.jpeg", "Type a name that ends in .png or .exr"),
    ] {
        window
            .get_by_role_and_label(role, "Path to save to")
            .focus();
        window.run_steps(2);
        press(&mut window, Modifiers::COMMAND, Key::A);
        let field = window.get_by_role_and_label(role, "Path to save to");
        field.type_text(path);
        wait(&mut window, reason, |w| has(w, reason));
        assert!(
            window
                .get_by_label("Save here")
                .accesskit_node()
                .is_disabled()
        );
    }
    click(&mut window, "Cancel saving");
    assert!(!has(&window, "Browse…"));
    // The 3D view cannot be taken from the screen where nothing draws it.
    press(&mut window, Modifiers::ALT, Key::Num3);
    wait(&mut window, "the reason", |w| {
        has(w, "is not on the screen")
    });
}

#[test]
fn escape_answers_the_question_where_to_save() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    press(&mut window, Modifiers::ALT, Key::Num1);
    wait(&mut window, "the question where", |w| has(w, "Browse…"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the question to go", |w| !has(w, "Browse…"));
}
