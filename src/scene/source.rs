//! Scene sources: a file or a generator, and how cylinders are represented.

use super::model::Scene;
use super::parts::SceneParts;
use super::tessellate::Cylinders;
use super::{builtin, format};
use crate::progress::{Cancelled, Progress};
use std::path::PathBuf;

/// A scene file or a generator with its size.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SceneSource {
    File(PathBuf),
    /// A generator by name, with its size; `None` means the size that the paper used.
    Builtin {
        name: String,
        size: Option<u32>,
    },
}

/// Everything that determines the resulting scene.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct SceneRequest {
    pub source: SceneSource,
    pub cylinders: Cylinders,
}

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    #[error(transparent)]
    Format(format::FormatError),
    #[error(transparent)]
    Builtin(#[from] builtin::BuiltinError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<format::FormatError> for LoadError {
    fn from(error: format::FormatError) -> Self {
        match error {
            format::FormatError::Cancelled(cancelled) => LoadError::Cancelled(cancelled),
            error => LoadError::Format(error),
        }
    }
}

impl SceneSource {
    /// Returns the name of the file without its folders, or the generator with its size.
    pub fn short_name(&self) -> String {
        match self {
            SceneSource::File(path) => path.file_name().map_or_else(
                || path.display().to_string(),
                |name| name.to_string_lossy().into_owned(),
            ),
            builtin => builtin.to_string(),
        }
    }

    /// Parses user input: the path of an existing file, or else the name of a generator with an
    /// optional size (`balls`, `balls:4`). Anything else is taken as a path.
    pub fn parse(text: &str) -> Self {
        let path = PathBuf::from(text);
        match SceneSource::generator(text) {
            Some(generator) if !path.exists() => generator,
            _ => SceneSource::File(path),
        }
    }

    /// Parses the name of a generator, with or without a size (`balls`, `balls:4`). Returns `None`
    /// if there is no such generator.
    pub fn generator(text: &str) -> Option<Self> {
        let (name, size) = match text.split_once(':') {
            Some((name, size)) => (name, Some(size.parse().ok()?)),
            None => (text, None),
        };
        builtin::find(name)?;
        Some(SceneSource::Builtin {
            name: name.to_owned(),
            size,
        })
    }
}

impl std::fmt::Display for SceneSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            SceneSource::File(path) => write!(f, "{}", path.display()),
            SceneSource::Builtin { name, size: None } => f.write_str(name),
            SceneSource::Builtin {
                name,
                size: Some(size),
            } => write!(f, "{name}:{size}"),
        }
    }
}

impl SceneRequest {
    /// Parses user input as [`SceneSource::parse`] does; cylinders are exact.
    pub fn parse(text: &str) -> Self {
        SceneRequest {
            source: SceneSource::parse(text),
            cylinders: Cylinders::Exact,
        }
    }
}

/// Reads or generates a scene.
///
/// # Errors
/// Errors of the reader or generator, or cancellation. A scene is never partially loaded.
pub fn load(request: &SceneRequest, progress: &Progress) -> Result<Scene, LoadError> {
    let parts: SceneParts = match &request.source {
        SceneSource::File(path) => format::read_file(path, progress)?,
        SceneSource::Builtin { name, size } => builtin::generate(name, *size)?,
    };
    progress.check()?;
    Ok(Scene::new(request.cylinders.apply(parts)))
}
