//! The scenes opened lately, kept in the user's settings folder.

use super::kept::KeptFile;
use crate::scene::SceneSource;

/// As many as a menu shows at a glance.
const KEPT: usize = 12;

/// The scenes opened lately, the last one first.
#[derive(Default)]
pub struct Recent {
    file: KeptFile,
    sources: Vec<SceneSource>,
}

impl Recent {
    /// The list kept in a file; empty where there is none yet.
    pub fn kept(file: KeptFile) -> Self {
        let sources = file.read().unwrap_or_default();
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
        self.file.write(&self.sources);
    }

    pub fn clear(&mut self) {
        self.sources.clear();
        self.file.write(&self.sources);
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
