//! Every setting appears in every face of the program: each is declared once, and a new one needs no
//! other edit than its field and its entry.

use bspscope::measure::sweep::{Axis, Key, Plan};
use bspscope::measure::{Measurement, measure};
use bspscope::present::report::{Report, WRITERS};
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::setup::{Affects, Edits, SETTINGS, Setting, Setup, any_setting, measure_command};
use bspscope::structure::{BuildSettings, Method};
use bspscope::workspace::Workspace;
use std::path::Path;

/// Setups that differ from a plain one in one setting each, with that setting; constants of every
/// method among them.
pub fn changed() -> Vec<(Setting, Setup, Setup)> {
    let mut all = Vec::new();
    for method in Method::all() {
        let plain = Setup {
            build: BuildSettings::for_method(method),
            ..Setup::new(SceneRequest::parse("tetra:2"))
        };
        for setting in plain.settings() {
            let default = setting.value(&plain);
            let values = setting.examples().into_iter().filter(|v| *v != default);
            all.extend(values.map(|value| {
                let mut setup = plain.clone();
                setting.store(&mut setup, value);
                (setting, plain.clone(), setup)
            }));
        }
    }
    assert!(all.len() > 10 * SETTINGS.len());
    all
}

#[test]
fn a_setting_changes_what_it_stands_for_and_nothing_else() {
    for (setting, plain, setup) in changed() {
        let name = setting.name;
        assert_ne!(setup, plain, "{name}");
        assert_ne!(setting.text(&setup), setting.text(&plain), "{name}");
        let [a, b] = [&setup, &plain];
        let differs = match setting.affects {
            Affects::Scene => a.scene != b.scene,
            Affects::Structure => a.build != b.build,
            Affects::Image | Affects::Time => a.render != b.render,
        };
        assert!(differs, "{name}");
        assert_eq!(setup.invalidates(&plain), Some(setting.affects), "{name}");
        assert_eq!(plain.invalidates(&plain), None);
        let of_picture = matches!(setting.affects, Affects::Scene | Affects::Image);
        assert_eq!(setup.alters_picture(&plain), of_picture, "{name}");
        assert!(!plain.alters_picture(&plain));
    }
}

#[test]
fn every_setting_is_written_in_lists_workspaces_and_commands() {
    for (setting, _, setup) in changed() {
        let name = setting.name;
        // As `--a` and lessons have it.
        let edits = Edits::parse(&setup.to_text()).unwrap();
        let base = Setup::new(setup.scene.clone());
        assert_eq!(edits.apply(&base).unwrap(), setup, "{name}");
        let workspace = Workspace::new(setup.clone());
        let text = workspace.to_text(None);
        let read = Workspace::parse(&text, Path::new("a.bspscope"));
        assert_eq!(read.unwrap(), workspace, "{name}\n{text}");
        let command = measure_command(&setup);
        let words = shell_words::split(&command).unwrap();
        let (option, constant) = (format!("--{name}"), format!("{name}="));
        let is_written = words
            .windows(2)
            .any(|pair| pair[0] == option || pair[0] == "--set" && pair[1].starts_with(&constant));
        assert!(is_written, "{command}");
    }
}

#[test]
fn every_setting_is_an_axis_of_a_sweep_and_in_the_key_of_its_rows() {
    for (setting, plain, setup) in changed() {
        let name = setting.name;
        let axis = Axis::parse(&format!("{name}={}", setting.text(&setup))).unwrap();
        assert_eq!(axis.name, any_setting(name).unwrap().name);
        let points = Plan::new(std::slice::from_ref(&plain), &[axis]).points;
        assert_eq!(points.len(), 1);
        assert_eq!(points[0].setup, setup, "{name}");
        let [was, is] = [&plain, &setup].map(|setup| Key::of(setup, &["other"]));
        assert_ne!(was, is, "{name}");
        let expected = format!(
            "{name}: {} vs {}",
            setting.text(&plain),
            setting.text(&setup)
        );
        assert!(was.differences(&is).contains(&expected), "{name}");
    }
}

/// What is measured of a setup, but with its settings changed afterwards: reports do not ask how.
fn report_of(measured: &Measurement, setup: &Setup, form: &str) -> String {
    let scene = load(&setup.scene, &Progress::new()).unwrap();
    let run = Measurement {
        build: setup.build.clone(),
        render: setup.render,
        camera: setup.render.camera.resolve(scene.camera()),
        ..measured.clone()
    };
    let report = Report::new(&scene, &setup.scene, vec![run]);
    let writer = WRITERS.iter().find(|writer| writer.name == form).unwrap();
    let mut text = Vec::new();
    (writer.write)(&report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn every_setting_is_in_reports() {
    let mut plain = Setup::new(SceneRequest::parse("tetra:2"));
    (plain.render.width, plain.render.height) = (4, 4);
    let scene = load(&plain.scene, &Progress::new()).unwrap();
    let measured = measure(&scene, &plain.build, &plain.render, &Progress::new()).unwrap();
    for (setting, _, setup) in changed() {
        let word = setting.word();
        let text = report_of(&measured.measurement, &setup, "text");
        let lines = text
            .lines()
            .filter(|line| line.to_lowercase().contains(&word.to_lowercase()));
        let value = setting.text(&setup);
        let mut lines = lines.map(|line| line.replace(" × ", "x").replace(", ", ","));
        assert!(
            lines.any(|line| line.contains(&value)),
            "{word} {value}: {text}"
        );
        let json = report_of(&measured.measurement, &setup, "json");
        let key = format!("\"{}\":", setting.name.replace('-', "_"));
        let constant = format!("\"{}\":", setting.name);
        assert!(
            json.contains(&key) || json.contains(&constant),
            "{key} {json}"
        );
    }
}
