//! What the window opens with.

use crate::lesson::Lesson;
use crate::setup::Setup;
use crate::workspace::Workspace;
use std::path::PathBuf;

/// What the window opens with.
#[derive(Clone, Debug)]
pub struct StartOptions {
    pub setup: Setup,
    /// The lesson that the window opens with.
    pub lesson: Option<Lesson>,
    /// Whether recent scenes and the window's layout are read from and kept in the settings folder.
    pub remember: bool,
    /// A workspace to open, with its path; it takes the place of `setup`.
    pub workspace: Option<(PathBuf, Workspace)>,
    /// Whether to go on where the last session ended, if that was kept.
    pub last_session: bool,
    /// The settings folder; `None` for the one that the system has for the user.
    pub settings_folder: Option<PathBuf>,
}

impl Default for StartOptions {
    /// The paper's `balls` with the paper's settings.
    fn default() -> Self {
        StartOptions {
            setup: Setup::default(),
            lesson: None,
            remember: true,
            workspace: None,
            last_session: false,
            settings_folder: None,
        }
    }
}
