//! Ways to a scene: dialog, dropped file, typed path, generators and the recent list.

use super::recent::Recent;
use super::shortcuts::{Action, tip};
use super::state::State;
use crate::scene::SceneSource;
use crate::scene::builtin::BUILTINS;
use crate::scene::format::{FORMATS, names};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// What opening scenes needs to remember.
pub struct Files {
    pub recent: Recent,
    /// What is typed into the path field.
    path: String,
    /// Put the cursor into the path field.
    focus_path: bool,
    /// The answer of an open dialog.
    dialog: Option<Receiver<Option<PathBuf>>>,
}

impl Files {
    pub fn new(recent: Recent) -> Self {
        Files {
            recent,
            path: String::new(),
            focus_path: false,
            dialog: None,
        }
    }

    /// Opens the dialog on a thread of its own.
    pub fn open_dialog(&mut self, ctx: &egui::Context) {
        if self.dialog.is_some() {
            return;
        }
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let mut dialog = rfd::FileDialog::new().set_title("Open a scene");
            for (name, extensions) in filters() {
                dialog = dialog.add_filter(name, &extensions);
            }
            dialog = dialog.add_filter("All files", &["*"]);
            // Without a window the answer is not needed.
            let _ = sender.send(dialog.pick_file());
            ctx.request_repaint();
        });
        self.dialog = Some(receiver);
    }

    pub fn focus_path(&mut self) {
        self.focus_path = true;
    }

    /// Opens what the dialog answered and what was dropped.
    pub fn receive(&mut self, ctx: &egui::Context, state: &mut State) {
        if let Some(dialog) = &self.dialog {
            match dialog.try_recv() {
                Ok(answer) => {
                    self.dialog = None;
                    if let Some(path) = answer {
                        state.open(SceneSource::File(path));
                    }
                }
                Err(TryRecvError::Disconnected) => self.dialog = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.first().map(|f| f.path().to_owned()));
        if let Some(path) = dropped {
            state.open(SceneSource::File(path));
        }
    }

    /// The widgets: generators, Open, path field, recent scenes.
    pub fn ui(&mut self, ui: &mut egui::Ui, state: &mut State) {
        let name = match &state.wanted.scene.source {
            SceneSource::File(path) => path
                .file_name()
                .map_or_else(|| path.display().to_string(), |n| n.display().to_string()),
            builtin => builtin.to_string(),
        };
        egui::ComboBox::from_id_salt("scene")
            .selected_text(format!("Scene: {name}"))
            .width(150.0)
            .truncate()
            .show_ui(ui, |ui| self.generators(ui, state))
            .response
            .accessible_name("Scene")
            .on_hover_text("Scenes made by generators");
        self.size(ui, state);
        ui.menu_button("Recent", |ui| {
            if self.recent.sources().is_empty() {
                ui.label("No scene was opened yet");
            }
            let mut chosen = None;
            for source in self.recent.sources() {
                if ui.button(source.to_string()).clicked() {
                    chosen = Some(source.clone());
                }
            }
            if let Some(source) = chosen {
                state.open(source);
            }
            ui.separator();
            if ui.button("Forget them").clicked() {
                self.recent.clear();
            }
        })
        .response
        .on_hover_text("Scenes opened lately");
        if ui
            .add_enabled(self.dialog.is_none(), egui::Button::new("Open…"))
            .on_hover_text(tip(
                &format!("Open a scene file: {}.", names()),
                Action::Open,
            ))
            .clicked()
        {
            self.open_dialog(ui.ctx());
        }
        let field = egui::TextEdit::singleline(&mut self.path)
            .hint_text("path or generator, Enter")
            .desired_width(170.0);
        let field = ui.add(field).accessible_name("Path of a scene");
        let field = field.on_hover_text(tip(
            &format!(
                "The path of a file ({}), or a generator's name with or without a size, such as \
                 balls:3; then Enter.",
                names()
            ),
            Action::Path,
        ));
        if std::mem::take(&mut self.focus_path) {
            field.request_focus();
        }
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if entered && !self.path.trim().is_empty() {
            state.open(SceneSource::parse(self.path.trim()));
        }
    }

    fn generators(&self, ui: &mut egui::Ui, state: &mut State) {
        if BUILTINS.is_empty() {
            ui.label("There are no generators");
        }
        for builtin in BUILTINS {
            let chosen = matches!(
                &state.wanted.scene.source,
                SceneSource::Builtin { name, .. } if name == builtin.name
            );
            let item = ui.selectable_label(chosen, builtin.name);
            if item.on_hover_text(builtin.about).clicked() {
                state.open(SceneSource::Builtin {
                    name: builtin.name.to_owned(),
                    size: None,
                });
            }
        }
    }

    /// The size of a generated scene.
    fn size(&self, ui: &mut egui::Ui, state: &mut State) {
        let SceneSource::Builtin { name, size } = &state.wanted.scene.source else {
            return;
        };
        let Some(builtin) = crate::scene::builtin::find(name) else {
            return;
        };
        let mut value = size.unwrap_or(builtin.default_size);
        let edit = egui::DragValue::new(&mut value)
            .range(builtin.sizes.clone())
            .speed(0.05)
            .update_while_editing(false);
        let response = ui.name_inputs("Size of the scene", |ui| ui.add(edit));
        let changed = response.changed();
        response.on_hover_text(format!(
            "Size of the generated scene, {} to {}; the paper's is {}.",
            builtin.sizes.start(),
            builtin.sizes.end(),
            builtin.default_size
        ));
        if changed {
            let size = (value != builtin.default_size).then_some(value);
            state.open(SceneSource::Builtin {
                name: builtin.name.to_owned(),
                size,
            });
        }
    }
}

/// What the dialog can be narrowed to: all scene files, then those of each format.
fn filters() -> Vec<(String, Vec<&'static str>)> {
    let all = FORMATS.iter().flat_map(|f| f.extensions).copied().collect();
    let each = FORMATS.iter().map(|format| {
        let name = format!("{}: {}", format.name.to_uppercase(), format.about);
        (name, format.extensions.to_vec())
    });
    std::iter::once(("Scenes".to_owned(), all))
        .chain(each)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_filter_shows_files_of_every_format() {
        let filters = filters();
        assert_eq!(filters.len(), FORMATS.len() + 1);
        for extension in ["nff", "obj", "ply", "gltf", "glb", "stl"] {
            assert!(filters[0].1.contains(&extension));
            assert!(filters[1..].iter().any(|(_, e)| e.contains(&extension)));
        }
    }
}
