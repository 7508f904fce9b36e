//! Where a scene comes from: a file or a generator's name, and how cylinders are taken.

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
    /// The generator's name and its size; `None` takes the size that the paper used.
    Builtin {
        name: String,
        size: Option<u32>,
    },
}

/// Everything that decides what scene results.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct SceneRequest {
    pub source: SceneSource,
    pub cylinders: Cylinders,
}

/// Why a scene could not be had.
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
    /// Reads what a user typed: an existing file or a path wins, then a generator's name with an
    /// optional size (`balls`, `balls:4`).
    pub fn parse(text: &str) -> Self {
        let path = PathBuf::from(text);
        match SceneSource::generator(text) {
            Some(generator) if !path.exists() => generator,
            _ => SceneSource::File(path),
        }
    }

    /// The generator of this name, with or without a size (`balls`, `balls:4`); `None` where there
    /// is none.
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
    /// The request for what a user typed, cylinders exact.
    pub fn parse(text: &str) -> Self {
        SceneRequest {
            source: SceneSource::parse(text),
            cylinders: Cylinders::Exact,
        }
    }
}

/// Reads or generates the scene asked for.
///
/// # Errors
/// The file's or the generator's error, or cancellation. Nothing is half-loaded.
pub fn load(request: &SceneRequest, progress: &Progress) -> Result<Scene, LoadError> {
    let parts: SceneParts = match &request.source {
        SceneSource::File(path) => format::read_file(path, progress)?,
        SceneSource::Builtin { name, size } => builtin::generate(name, *size)?,
    };
    progress.check()?;
    Ok(Scene::new(request.cylinders.apply(parts)))
}
