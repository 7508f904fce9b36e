//! Small files in the user's settings folder. What they hold is a convenience: failing to read or
//! write one is no error.

use crate::files::write_whole;
use crate::gui::StartOptions;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// A JSON file in the settings folder.
#[derive(Default)]
pub struct KeptFile {
    /// `None` where nothing is kept.
    path: Option<PathBuf>,
}

impl KeptFile {
    /// The file of this name, in the folder that the start options say.
    pub fn new(start: &StartOptions, name: &str) -> Self {
        KeptFile {
            path: place(start, name),
        }
    }

    /// What was written last; `None` where there is no such file, or it holds something else.
    pub fn read<T: DeserializeOwned>(&self) -> Option<T> {
        let bytes = std::fs::read(self.path.as_ref()?).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    pub fn write<T: Serialize>(&self, value: &T) {
        if let Some(path) = &self.path
            && let Ok(text) = serde_json::to_vec_pretty(value)
        {
            keep(path, &text);
        }
    }
}

/// Writes a file whole, and the folders that it lies in; failing to is no error.
pub fn keep(path: &Path, bytes: &[u8]) {
    if let Some(folder) = path.parent() {
        // A full or read-only disk is not worth a message.
        let _ = std::fs::create_dir_all(folder)
            .and_then(|()| write_whole(path, |out| out.write_all(bytes)));
    }
}

/// Where a file of this name is kept; `None` where nothing is.
pub fn place(start: &StartOptions, name: &str) -> Option<PathBuf> {
    let folder = || {
        start.settings_folder.clone().or_else(|| {
            let folders = directories::ProjectDirs::from("", "", "bspscope")?;
            Some(folders.config_dir().to_owned())
        })
    };
    let folder = start.remember.then(folder).flatten()?;
    Some(folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_again_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let start = StartOptions {
            settings_folder: Some(folder.path().join("not there yet")),
            ..StartOptions::default()
        };
        let file = KeptFile::new(&start, "numbers.json");
        assert_eq!(file.read::<Vec<u32>>(), None);
        file.write(&vec![1, 2]);
        assert_eq!(file.read(), Some(vec![1, 2]));
        assert_eq!(file.read::<String>(), None);
        // A new file takes the place of the old one, which is never seen half written.
        let [path, old] = ["numbers.json", "old.json"].map(|name| place(&start, name).unwrap());
        std::fs::hard_link(&path, &old).unwrap();
        file.write(&vec![3]);
        assert_eq!(std::fs::read(&old).unwrap(), b"[\n  1,\n  2\n]");
        file.write(&vec![1, 2]);
        let forgetful = StartOptions {
            remember: false,
            ..start
        };
        let nowhere = KeptFile::new(&forgetful, "numbers.json");
        nowhere.write(&vec![3]);
        assert_eq!(nowhere.read::<Vec<u32>>(), None);
        assert_eq!(file.read(), Some(vec![1, 2]));
    }
}
