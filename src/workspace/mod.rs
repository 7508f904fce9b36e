//! Workspaces: the state of a session as an editable text file (`.bspscope`, TOML). The data do not
//! depend on the window: [`side`] is one setup, [`view`] is what is shown.

mod names;
mod scene;
mod side;
mod view;

pub use view::{
    Arrangement, CutSettings, Heat, NODES_PER_RAY, PicturePlace, Selected, View, View3dSettings,
    Which,
};

use crate::files;
use crate::scene::SceneSource;
use crate::setup::Setup;
use scene::SceneRecord;
use serde::de::Error as _;
use serde::{Deserialize, Serialize};
use side::{OldCamera, Side};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The version that is written; newer versions cannot be read.
pub const VERSION: u32 = 2;

/// The extension of the files, without the dot.
pub const EXTENSION: &str = "bspscope";

/// Maximum size of a workspace in bytes.
const LARGEST: u64 = 4 << 20;

/// The first lines of a file.
const HEADER: &str = "\
# A workspace of bspscope: what was looked at, and how. Open it with `bspscope FILE.bspscope`.
# All of it may be changed by hand. [a] is the setup, [b] the second one of a comparison; names are
# those of the command line (`bspscope measure --help`). Without from, at, up and angle the scene's
# own camera is used.
# A scene's file is looked for from this file's folder on.

";

/// The state of a session.
#[derive(Clone, Debug, PartialEq)]
pub struct Workspace {
    /// The user's notes.
    pub notes: String,
    /// The setup, or the first of two.
    pub a: Setup,
    /// The second setup of a comparison, of the same scene; `None` without one.
    pub b: Option<Setup>,
    /// SHA-256 of the scene's file in hexadecimal digits, as `sha256sum` prints it. `None` if it
    /// is unknown, and for generators.
    pub scene_sha256: Option<String>,
    pub view: View,
    /// The layout, in a format defined by the window; `None` keeps the current layout.
    pub layout: Option<serde_json::Value>,
}

/// The content of the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    version: u32,
    #[serde(default)]
    notes: String,
    scene: SceneRecord,
    /// Only in version 1; part of `a` and `b` since.
    #[serde(skip_serializing)]
    camera: Option<OldCamera>,
    a: Side,
    b: Option<Side>,
    #[serde(default)]
    view: View,
    #[serde(default, with = "names::json", skip_serializing_if = "Option::is_none")]
    layout: Option<serde_json::Value>,
}

/// Why a workspace could not be read.
#[derive(Debug, thiserror::Error)]
pub enum WorkspaceError {
    #[error("{}: {reason}", path.display())]
    Io { path: PathBuf, reason: io::Error },
    #[error("{}: more than {limit} bytes: not a workspace", path.display(), limit = LARGEST)]
    TooLarge { path: PathBuf },
    #[error("{}: not text in UTF-8: not a workspace", path.display())]
    NotText { path: PathBuf },
    #[error("{}:{line}: {reason}", path.display())]
    Wrong {
        path: PathBuf,
        /// Counted from 1.
        line: usize,
        reason: String,
    },
    #[error(
        "{}: written by a newer bspscope (version {found} of the file; this one reads up to \
         {VERSION}); nothing was loaded", path.display()
    )]
    Newer { path: PathBuf, found: u32 },
}

impl Workspace {
    /// Creates the workspace of a setup, with defaults for everything else.
    pub fn new(a: Setup) -> Self {
        Workspace {
            notes: String::new(),
            a,
            b: None,
            scene_sha256: None,
            view: View::default(),
            layout: None,
        }
    }

    /// Returns whether a path has the extension of a workspace.
    pub fn is_path(path: &Path) -> bool {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(EXTENSION))
    }

    /// Reads a file. A relative path of a scene is relative to the file's folder.
    ///
    /// # Errors
    /// The file cannot be read, is too large, has a newer version, or contains an unknown or
    /// invalid value. A workspace is never partially loaded.
    pub fn read(path: &Path) -> Result<Workspace, WorkspaceError> {
        let io = |reason| WorkspaceError::Io {
            path: path.to_owned(),
            reason,
        };
        let mut bytes = Vec::new();
        let file = File::open(path).map_err(io)?;
        file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(io)?;
        if bytes.len() as u64 > LARGEST {
            return Err(WorkspaceError::TooLarge {
                path: path.to_owned(),
            });
        }
        let text = String::from_utf8(bytes).map_err(|_| WorkspaceError::NotText {
            path: path.to_owned(),
        })?;
        Workspace::parse(&text, path)
    }

    /// Parses the text of a file; `path` is its path, for error messages and relative paths.
    ///
    /// # Errors
    /// The same as for [`Workspace::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Workspace, WorkspaceError> {
        /// The part that all versions share.
        #[derive(Deserialize)]
        struct Versioned {
            version: u32,
        }
        let wrong = |error: toml::de::Error| {
            let start = error.span().map_or(0, |span| span.start);
            let before = text.get(..start).unwrap_or_default();
            WorkspaceError::Wrong {
                path: path.to_owned(),
                line: before.matches('\n').count() + 1,
                reason: error.message().trim().to_owned(),
            }
        };
        let Versioned { version: found } = toml::from_str(text).map_err(wrong)?;
        if found > VERSION {
            return Err(WorkspaceError::Newer {
                path: path.to_owned(),
                found,
            });
        }
        let mut written: Written = toml::from_str(text).map_err(wrong)?;
        written.scene.locate(path);
        let SceneRecord { source, sha256 } = written.scene;
        let setup = |Side(mut setup): Side| {
            setup.scene.source = source.clone();
            if let Some(camera) = &written.camera {
                camera.set(&mut setup).map_err(toml::de::Error::custom)?;
            }
            Ok(setup)
        };
        Ok(Workspace {
            notes: written.notes,
            a: setup(written.a).map_err(wrong)?,
            b: written.b.map(setup).transpose().map_err(wrong)?,
            scene_sha256: sha256,
            view: written.view,
            layout: written.layout,
        })
    }

    /// Returns the text of the file. The path of the scene is relative to the folder, if there is
    /// one and if that is possible; otherwise it is absolute.
    pub fn to_text(&self, folder: Option<&Path>) -> String {
        let mut scene = SceneRecord {
            source: self.a.scene.source.clone(),
            sha256: self.scene_sha256.clone(),
        };
        scene.relate(folder);
        let written = Written {
            version: VERSION,
            notes: self.notes.clone(),
            scene,
            camera: None,
            a: Side(self.a.clone()),
            b: self.b.clone().map(Side),
            view: self.view.clone(),
            layout: self.layout.clone(),
        };
        let text = toml::to_string(&written).expect("text, numbers and tables of them");
        format!("{HEADER}{text}")
    }

    /// Writes the file, completely or not at all.
    ///
    /// # Errors
    /// I/O errors.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let absolute = std::path::absolute(path)?;
        let text = self.to_text(absolute.parent());
        files::write_whole(path, |out| out.write_all(text.as_bytes()))
    }

    /// Returns the path of the scene's file if it does not exist.
    pub fn missing_scene(&self) -> Option<&Path> {
        match &self.a.scene.source {
            SceneSource::File(path) => Some(path.as_path()).filter(|path| !path.is_file()),
            SceneSource::Builtin { .. } => None,
        }
    }

    /// Returns whether the scene's file was changed since the workspace was saved; `false` if that
    /// is unknown, and for generators.
    pub fn scene_was_changed(&self) -> bool {
        match (&self.a.scene.source, &self.scene_sha256) {
            (SceneSource::File(path), Some(then)) => {
                files::sha256(path).is_ok_and(|now| !now.eq_ignore_ascii_case(then))
            }
            _ => false,
        }
    }
}
