//! The scene of a workspace: its source, and whether it has changed.

use crate::scene::SceneSource;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The scene of a workspace.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct SceneRecord {
    pub source: SceneSource,
    /// SHA-256 of the file's bytes in hexadecimal digits, as `sha256sum` prints it. `None` if it
    /// is unknown, and for generators.
    pub sha256: Option<String>,
}

/// The scene in the file: either a file or a generator.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    file: Option<PathBuf>,
    generator: Option<String>,
    sha256: Option<String>,
}

impl TryFrom<Written> for SceneRecord {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let source = match (written.file, written.generator) {
            (Some(path), None) => SceneSource::File(path),
            (None, Some(text)) => SceneSource::generator(&text)
                .ok_or_else(|| format!("no generator is called '{text}'"))?,
            _ => return Err("expected the scene's file or its generator".into()),
        };
        Ok(SceneRecord {
            source,
            sha256: written.sha256,
        })
    }
}

impl From<SceneRecord> for Written {
    fn from(scene: SceneRecord) -> Self {
        let (file, generator) = match scene.source {
            SceneSource::File(path) => (Some(path), None),
            generator => (None, Some(generator.to_string())),
        };
        Written {
            file,
            generator,
            sha256: scene.sha256,
        }
    }
}

impl SceneRecord {
    /// Resolves a relative path from the folder of the workspace.
    pub(super) fn locate(&mut self, workspace: &Path) {
        if let SceneSource::File(path) = &mut self.source
            && let Some(folder) = workspace.parent()
        {
            let joined = folder.join(&*path);
            // Canonical, without `folder/../`, if the file exists.
            *path = std::fs::canonicalize(&joined).unwrap_or(joined);
        }
    }

    /// Makes the path relative to a folder if that is possible, with `/` on every system; otherwise
    /// makes it absolute.
    pub(super) fn relate(&mut self, folder: Option<&Path>) {
        let SceneSource::File(path) = &mut self.source else {
            return;
        };
        let whole = |path: &Path| {
            let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
            std::fs::canonicalize(&absolute).unwrap_or(absolute)
        };
        let absolute = whole(path);
        let relative = folder.and_then(|folder| pathdiff::diff_paths(&absolute, whole(folder)));
        *path = match relative {
            Some(relative) if relative.is_relative() => {
                let parts: Vec<_> = relative.iter().map(|part| part.to_string_lossy()).collect();
                parts.join("/").into()
            }
            _ => absolute,
        };
    }
}
