//! The real window, on a virtual display where there is one to be had (Xvfb).

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt, MapState, Window};
use x11rb::rust_connection::RustConnection;

/// Ends a process with the test, however that ends.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Starts a display and gives its name, such as `:1`; the server chooses a free one.
fn display() -> (Running, String) {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1400x900x24"])
        .args(["-nolisten", "tcp"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("Xvfb is installed: tests/run.sh does that");
    let mut number = String::new();
    let mut out = server.stdout.take().unwrap();
    let mut byte = [0];
    while out.read(&mut byte).unwrap() == 1 && byte[0] != b'\n' {
        number.push(byte[0].into());
    }
    (Running(server), format!(":{number}"))
}

/// The visible window with this title among the descendants of `parent`.
fn find(x: &RustConnection, parent: Window, title: &str) -> Option<Window> {
    let children = x.query_tree(parent).ok()?.reply().ok()?.children;
    children.into_iter().find_map(|window| {
        let name = x
            .get_property(false, window, AtomEnum::WM_NAME, AtomEnum::ANY, 0, 64)
            .ok()?
            .reply()
            .ok()?;
        let state = x
            .get_window_attributes(window)
            .ok()?
            .reply()
            .ok()?
            .map_state;
        if name.value.ends_with(title.as_bytes()) && state == MapState::VIEWABLE {
            Some(window)
        } else {
            find(x, window, title)
        }
    })
}

#[test]
fn the_program_opens_its_window_and_goes_on_running() {
    let (_server, name) = display();
    let folder = tempfile::tempdir().unwrap();
    let program = Command::new(env!("CARGO_BIN_EXE_bspscope"))
        .args(["tetra:3", "--resolution", "64x64"])
        .current_dir(folder.path())
        .env("DISPLAY", &name)
        .env_remove("WAYLAND_DISPLAY")
        .env("XDG_CONFIG_HOME", folder.path())
        .env("XDG_RUNTIME_DIR", folder.path())
        .spawn()
        .unwrap();
    let mut program = Running(program);
    let (x, screen) = x11rb::connect(Some(&name)).unwrap();
    let root = x.setup().roots[screen].root;
    let start = Instant::now();
    while find(&x, root, "bspscope").is_none() {
        let status = program.0.try_wait().unwrap();
        assert!(status.is_none(), "ended without a window: {status:?}");
        assert!(start.elapsed() < Duration::from_secs(120), "no window");
        std::thread::sleep(Duration::from_millis(50));
    }
    // Without a window the program would have written the picture to a file and ended.
    std::thread::sleep(Duration::from_secs(2));
    assert!(program.0.try_wait().unwrap().is_none(), "the window closed");
    assert!(std::fs::read_dir(folder.path()).unwrap().all(|file| {
        let name = file.unwrap().file_name();
        !name.to_string_lossy().ends_with(".png")
    }));
}
