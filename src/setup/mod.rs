//! The whole experiment as one value, [`Setup`]: which scene, which structure, how it is rendered,
//! and from where. Each setting is declared once, in [`SETTINGS`]: options, widgets, files, axes of
//! sweeps and lines in reports are made from that list.

mod choices;
mod command;
mod edits;
mod lookup;
mod setting;
mod settings;

pub use choices::methods;
pub use command::measure_command;
pub use edits::Edits;
pub use lookup::{any_setting, setting};
pub use setting::{Affects, Choice, Group, Kind, Range, Setting, Value};
pub use settings::SETTINGS;

use crate::scene::{Cylinders, SceneRequest, SceneSource};
use crate::structure::{BuildSettings, Method};
use crate::trace::RenderSettings;

/// Everything that decides the structure, the picture and what is counted.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    pub scene: SceneRequest,
    pub build: BuildSettings,
    pub render: RenderSettings,
}

impl Setup {
    /// This scene with the paper's settings.
    pub fn new(scene: SceneRequest) -> Self {
        Setup {
            scene,
            build: BuildSettings::default(),
            render: RenderSettings::default(),
        }
    }

    /// The paper's `balls` with this method and the paper's other settings.
    pub fn of_method(method: Method) -> Self {
        Setup {
            build: BuildSettings::for_method(method),
            ..Setup::default()
        }
    }
}

impl Default for Setup {
    /// The paper's `balls` with the paper's settings.
    fn default() -> Self {
        Setup::new(SceneRequest {
            source: SceneSource::Builtin {
                name: "balls".into(),
                size: None,
            },
            cylinders: Cylinders::Exact,
        })
    }
}
