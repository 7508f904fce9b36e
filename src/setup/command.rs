//! A setup as a command.

use super::{Kind, SETTINGS, Setup};
use crate::scene::SceneSource;
use std::path::absolute;

/// Settings that are always written, even at their defaults.
const SPELLED_OUT: [&str; 3] = ["method", "resolution", "d-arec"];

/// Returns the command that measures this setup: `bspscope measure SCENE …`, quoted for a POSIX
/// shell. Most options at their defaults are omitted; paths are absolute.
pub fn measure_command(setup: &Setup) -> String {
    let scene = match &setup.scene.source {
        SceneSource::File(path) => {
            let path = absolute(path).unwrap_or_else(|_| path.clone());
            path.display().to_string()
        }
        generator => generator.to_string(),
    };
    let mut words = vec!["bspscope".to_owned(), "measure".into(), scene];
    for setting in setup.settings() {
        let mut text = setting.text(setup);
        if matches!(setting.kind, Kind::Method) && setup.build.method.is_file() {
            text = absolute(&text).map_or(text, |path| path.display().to_string());
        }
        let is_option = SETTINGS.iter().any(|s| s.name == setting.name);
        if setting.is_default(setup) && !SPELLED_OUT.contains(&setting.name) {
            continue;
        }
        words.extend(if is_option {
            [format!("--{}", setting.name), text]
        } else {
            ["--set".into(), format!("{}={text}", setting.name)]
        });
    }
    shell_words::join(words)
}
