//! A workspace: what was looked at and how, as a file that people can read and change
//! (`.bspscope`, TOML). Data without a window: [`side`] is one setup, [`view`] is what is
//! shown, [`command`] puts settings into a line to paste.

mod command;
mod names;
mod scene;
mod side;
mod view;

pub use command::measure_command;
pub use view::{
    Arrangement, CutSettings, Heat, NODES_A_RAY, PicturePlace, Selected, View, View3dSettings,
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

/// The version that is written, and the newest that is read.
pub const VERSION: u32 = 2;

/// The extension of the files, without the dot.
pub const EXTENSION: &str = "bspscope";

/// No workspace is larger, in bytes.
const LARGEST: u64 = 4 << 20;

/// What a file begins with.
const HEADER: &str = "\
# A workspace of bspscope: what was looked at, and how. Open it with `bspscope FILE.bspscope`.
# All of it may be changed by hand. [a] is the setup, [b] the second one of a comparison; names are
# those of the command line (`bspscope measure --help`). Without from, at, up and angle the scene's
# own camera is used.
# A scene's file is looked for from this file's folder on.

";

/// What was looked at, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Workspace {
    /// Free text of the user.
    pub notes: String,
    /// The setup, or the first of two.
    pub a: Setup,
    /// The second setup of a comparison, of the same scene; `None` without one.
    pub b: Option<Setup>,
    /// SHA-256 of the scene's file in hexadecimal digits, as `sha256sum` prints it. `None` where it
    /// is not known, and for generators, whose name and size say all.
    pub scene_sha256: Option<String>,
    pub view: View,
    /// Where panes and bars lie, in the window's own form; `None` leaves them where they are.
    pub layout: Option<serde_json::Value>,
}

/// As it stands in the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    version: u32,
    #[serde(default)]
    notes: String,
    scene: SceneRecord,
    /// In version 1; part of `a` and `b` since.
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
        /// From 1.
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
    /// A setup of which nothing else is known.
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

    /// Whether a path is that of a workspace, by its extension.
    pub fn is_path(path: &Path) -> bool {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(EXTENSION))
    }

    /// Reads a file. A scene's relative path is taken from the file's folder.
    ///
    /// # Errors
    /// A file that cannot be read, is too large, is of a newer version, or says something that is
    /// not known or not possible. Nothing is half-loaded.
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

    /// Reads a file's text; `path` is where it stands, for messages and for the scene's place.
    ///
    /// # Errors
    /// As [`Workspace::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Workspace, WorkspaceError> {
        /// What every version has.
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

    /// The text of the file; with a folder, the scene's path is relative to it where that is
    /// possible, else absolute.
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

    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let absolute = std::path::absolute(path)?;
        let text = self.to_text(absolute.parent());
        files::write_whole(path, |out| out.write_all(text.as_bytes()))
    }

    /// The scene's file, if it is not there.
    pub fn missing_scene(&self) -> Option<&Path> {
        match &self.a.scene.source {
            SceneSource::File(path) => Some(path.as_path()).filter(|path| !path.is_file()),
            SceneSource::Builtin { .. } => None,
        }
    }

    /// Whether the scene's file holds other bytes than when the workspace was saved; `false` where
    /// that is not known, and for generators.
    pub fn scene_was_changed(&self) -> bool {
        match (&self.a.scene.source, &self.scene_sha256) {
            (SceneSource::File(path), Some(then)) => {
                files::sha256(path).is_ok_and(|now| !now.eq_ignore_ascii_case(then))
            }
            _ => false,
        }
    }
}
