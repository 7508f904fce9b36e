//! Asks where to save something: a path that can be typed, with the system's dialog beside it.

use crate::gui::document::tasks::{Task, dialog, take};
use std::path::{Path, PathBuf};

/// The question, while it is open.
pub struct SaveAs<T> {
    /// What is to be saved.
    what: T,
    title: String,
    /// File name extensions; the first is the default.
    extensions: Vec<&'static str>,
    path: String,
    dialog: Option<Task<Option<PathBuf>>>,
    /// Whether the path was given the focus.
    focused: bool,
}

/// What was answered.
pub enum Answer<T> {
    Save(T, PathBuf),
    Cancel,
}

impl<T> SaveAs<T> {
    /// Asks where to save under one of these extensions; a path without one gets the first.
    pub fn new(
        what: T,
        title: impl Into<String>,
        path: &Path,
        extensions: Vec<&'static str>,
    ) -> Self {
        SaveAs {
            what,
            title: title.into(),
            path: with_extension(path.to_owned(), &extensions)
                .display()
                .to_string(),
            extensions,
            dialog: None,
            focused: false,
        }
    }

    /// Shows the question; gives it back until it is answered.
    pub fn show(mut self, ctx: &egui::Context) -> Result<Answer<T>, SaveAs<T>> {
        if let Some(answer) = self.dialog.as_ref().and_then(take) {
            self.dialog = None;
            if let Some(Some(path)) = answer {
                self.path = path.display().to_string();
            }
        }
        let mut save = false;
        let mut cancel = false;
        let modal = egui::Modal::new(egui::Id::unique("save as")).show(ctx, |ui| {
            ui.set_width(460.0);
            ui.strong(&self.title);
            let field = egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
            let field = ui.add(field).accessible_name("Path to save to");
            if !std::mem::replace(&mut self.focused, true) {
                field.request_focus();
            }
            let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
            let path = self.target();
            let trouble = trouble(&path, &self.extensions);
            let replaces = trouble.is_none() && path.is_file();
            match &trouble {
                Some(trouble) => ui.label(trouble),
                None if replaces => ui.label("There is a file of this name; it will be replaced."),
                None => ui.label(format!("Forms: .{}", self.extensions.join(", ."))),
            };
            ui.horizontal(|ui| {
                let name = if replaces { "Replace" } else { "Save here" };
                let button = ui.add_enabled(trouble.is_none(), egui::Button::new(name));
                save = trouble.is_none()
                    && (entered || button.on_hover_text("Shortcut: Enter").clicked());
                let browse = ui.add_enabled(self.dialog.is_none(), egui::Button::new("Browse…"));
                if browse
                    .on_hover_text("Choose a place in the system's dialog.")
                    .clicked()
                {
                    self.browse(ui.ctx(), &path);
                }
                cancel = ui
                    .button("Cancel saving")
                    .on_hover_text("Shortcut: Esc")
                    .clicked();
            });
        });
        if save {
            let path = self.target();
            Ok(Answer::Save(self.what, path))
        } else if cancel || modal.should_close() {
            Ok(Answer::Cancel)
        } else {
            Err(self)
        }
    }

    /// The path that was typed; with the extension where it has none.
    fn target(&self) -> PathBuf {
        with_extension(PathBuf::from(self.path.trim()), &self.extensions)
    }

    fn browse(&mut self, ctx: &egui::Context, path: &Path) {
        let (title, extensions) = (self.title.clone(), self.extensions.clone());
        let (folder, name) = (path.parent().map(Path::to_owned), path.file_name());
        let name = name.map(|name| name.to_string_lossy().into_owned());
        self.dialog = Some(dialog(ctx, move || {
            let mut dialog = rfd::FileDialog::new()
                .set_title(title)
                .add_filter(extensions.join(", "), &extensions);
            if let Some(folder) = folder.filter(|folder| folder.is_dir()) {
                dialog = dialog.set_directory(folder);
            }
            if let Some(name) = name {
                dialog = dialog.set_file_name(name);
            }
            dialog.save_file()
        }));
    }
}

/// The path; with the first extension where it has none.
fn with_extension(path: PathBuf, extensions: &[&str]) -> PathBuf {
    let Some(name) = path.file_name() else {
        return path;
    };
    match path.extension() {
        Some(_) => path,
        None if path.is_dir() => path,
        None => {
            let name = format!("{}.{}", name.to_string_lossy(), extensions[0]);
            path.with_file_name(name)
        }
    }
}

/// Why nothing can be saved under a path; `None` if nothing speaks against it.
fn trouble(path: &Path, extensions: &[&str]) -> Option<String> {
    if path.file_name().is_none() {
        return Some("Type the path of a file.".into());
    }
    if path.is_dir() {
        return Some("This is a folder.".into());
    }
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    if !extensions.iter().any(|known| extension == *known) {
        let known = extensions.join(" or .");
        return Some(format!("Type a name that ends in .{known}."));
    }
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.filter(|folder| !folder.is_dir())?;
    Some(format!("There is no folder {}.", folder.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_gets_the_extension_that_it_lacks() {
        let ask =
            |path: &str| SaveAs::new((), "Save", Path::new(path), vec!["obj", "ply"]).target();
        assert_eq!(ask("a/b"), Path::new("a/b.obj"));
        assert_eq!(ask("a.ply"), Path::new("a.ply"));
        assert_eq!(ask(""), Path::new(""));
    }

    #[test]
    fn places_where_nothing_can_be_saved_are_told() {
        let folder = tempfile::tempdir().unwrap();
        assert!(trouble(Path::new(""), &["obj"]).is_some());
        assert!(trouble(folder.path(), &["obj"]).is_some());
        assert!(trouble(&folder.path().join("none/a.obj"), &["obj"]).is_some());
        assert_eq!(trouble(&folder.path().join("a.obj"), &["obj"]), None);
        assert_eq!(trouble(Path::new("a.OBJ"), &["obj"]), None);
        assert!(trouble(Path::new("a.png"), &["obj"]).is_some());
    }
}
