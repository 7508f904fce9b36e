//! The scenes opened lately, kept in the user's settings folder. Failing to keep them is no error.

use crate::scene::SceneSource;
use std::path::PathBuf;

/// As many as a menu shows at a glance.
const KEPT: usize = 12;

/// The scenes opened lately, the last one first.
#[derive(Default)]
pub struct Recent {
    file: Option<PathBuf>,
    sources: Vec<SceneSource>,
}

impl Recent {
    /// The list kept from run to run; empty where there is none yet.
    pub fn kept() -> Self {
        let file = directories::ProjectDirs::from("", "", "bspscope")
            .map(|folders| folders.config_dir().join("recent.json"));
        let sources = file
            .as_ref()
            .and_then(|path| std::fs::read(path).ok())
            .and_then(|bytes| serde_json::from_slice(&bytes).ok())
            .unwrap_or_default();
        Recent { file, sources }
    }

    pub fn sources(&self) -> &[SceneSource] {
        &self.sources
    }

    /// Puts a scene first.
    pub fn add(&mut self, source: SceneSource) {
        // A path relative to today's folder means nothing tomorrow.
        let source = match source {
            SceneSource::File(path) => {
                SceneSource::File(std::path::absolute(&path).unwrap_or(path))
            }
            builtin => builtin,
        };
        self.sources.retain(|known| *known != source);
        self.sources.insert(0, source);
        self.sources.truncate(KEPT);
        self.write();
    }

    pub fn clear(&mut self) {
        self.sources.clear();
        self.write();
    }

    fn write(&self) {
        if let Some(file) = &self.file
            && let Some(folder) = file.parent()
            && let Ok(text) = serde_json::to_vec_pretty(&self.sources)
        {
            // The list is a convenience: a full or read-only disk is not worth a message.
            let _ = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(file, text));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_opened_is_first_and_none_is_there_twice() {
        let mut recent = Recent::default();
        for i in 0..20 {
            recent.add(SceneSource::File(format!("/scenes/{i}").into()));
        }
        recent.add(SceneSource::File("/scenes/15".into()));
        assert_eq!(recent.sources().len(), KEPT);
        assert_eq!(recent.sources()[0], SceneSource::File("/scenes/15".into()));
        assert_eq!(recent.sources()[1], SceneSource::File("/scenes/19".into()));
    }
}
