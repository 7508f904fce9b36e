//! Ways to a scene, a workspace or a tree file: dialog, dropped file, typed path, generators and the recent list.

use super::recent::Recent;
use super::thumbnails::Thumbnails;
use super::workspaces::Workspaces;
use crate::gui::action::tip;
use crate::gui::document::tasks::{Task, dialog, take};
use crate::gui::document::{Document, Failure};
use crate::scene::SceneSource;
use crate::scene::builtin::BUILTINS;
use crate::scene::format::{FORMATS, names};
use crate::structure::tree_file::{self, is_tree_file};
use crate::workspace::{EXTENSION, Workspace};
use egui::containers::menu::{MenuButton, MenuConfig};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// A person needs longer than this to close a dialog.
const FASTEST: Duration = Duration::from_millis(200);

/// What opening scenes needs to remember.
pub struct Files {
    pub recent: Recent,
    /// What is typed into the path field.
    path: String,
    /// Put the cursor into the path field.
    focus_path: bool,
    /// The answer of an open dialog.
    dialog: Option<(Task<Option<PathBuf>>, Instant)>,
    pub workspaces: Workspaces,
    thumbnails: Thumbnails,
}

/// Thumbnails of scenes beside each other.
const IN_A_ROW: usize = 4;
/// The distance of thumbnails, in points.
const GAP: f32 = 4.0;
/// The width of the menu of scenes, in points.
const MENU: f32 = IN_A_ROW as f32 * (Thumbnails::WIDTH + GAP) - GAP;

impl Files {
    pub fn new(recent: Recent, workspaces: Workspaces) -> Self {
        Files {
            recent,
            path: String::new(),
            focus_path: false,
            dialog: None,
            workspaces,
            thumbnails: Thumbnails::default(),
        }
    }

    /// Opens the dialog on a thread of its own.
    pub fn open_dialog(&mut self, ctx: &egui::Context) {
        if self.dialog.is_some() {
            return;
        }
        let task = dialog(ctx, || {
            let mut dialog =
                rfd::FileDialog::new().set_title("Open a scene, a workspace or a tree");
            for (name, extensions) in filters() {
                dialog = dialog.add_filter(name, &extensions);
            }
            dialog.add_filter("All files", &["*"]).pick_file()
        });
        self.dialog = Some((task, Instant::now()));
    }

    /// Opens a scene or a workspace. A tree file becomes the tree in front, of the scene on view.
    pub fn open(&mut self, source: SceneSource, ctx: &egui::Context, doc: &mut Document) {
        match source {
            SceneSource::File(path) if path.to_str().is_some_and(is_tree_file) => {
                doc.open_tree(&path);
            }
            SceneSource::File(path) if Workspace::is_path(&path) => {
                self.workspaces.open(path, ctx);
            }
            source => doc.open(source),
        }
    }

    pub fn focus_path(&mut self) {
        self.focus_path = true;
    }

    /// Opens what the dialog answered and what was dropped.
    pub fn receive(&mut self, ctx: &egui::Context, doc: &mut Document) {
        if let Some((task, since)) = &self.dialog
            && let Some(answer) = take(task)
        {
            let took = since.elapsed();
            self.dialog = None;
            match answer.flatten() {
                Some(path) => self.open(SceneSource::File(path), ctx, doc),
                // Nobody closes a dialog that fast: none could be opened.
                None if took < FASTEST => {
                    doc.failure = Some(Failure {
                        what: "The system's file dialog could not be opened".to_owned(),
                        why: "no desktop portal answered; type the path into the menu Scene, or drop \
                              the file onto the window"
                            .to_owned(),
                    });
                    self.focus_path();
                }
                None => {}
            }
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.first().map(|f| f.path().to_owned()));
        if let Some(path) = dropped {
            self.open(SceneSource::File(path), ctx, doc);
        }
    }

    /// The menu of scenes: generators, their size, recent scenes, a path, the dialog.
    pub fn menu(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        let name = doc.wanted.scene.source.short_name();
        let config =
            MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let title = egui::Button::new(format!("Scene: {name}")).truncate();
        let focuses = std::mem::take(&mut self.focus_path);
        let (button, _) = MenuButton::from_button(title).config(config).ui(ui, |ui| {
            ui.reset_style();
            ui.set_width(MENU);
            self.path_field(ui, doc, focuses);
            let open = ui.add_enabled(self.dialog.is_none(), egui::Button::new("Open…"));
            let about = format!(
                "Open a scene ({}), a workspace, or a tree (.bstree) of this scene.",
                names()
            );
            if open.on_hover_text(tip(&about, "window.open")).clicked() {
                self.open_dialog(ui.ctx());
                ui.close();
            }
            ui.separator();
            ui.strong("Generated scenes");
            ui.scope(|ui| self.generators(ui, doc));
            self.size(ui, doc);
            ui.separator();
            ui.strong("Recent");
            self.recent_list(ui, doc);
        });
        if focuses {
            egui::Popup::open_id(ui.ctx(), egui::Popup::default_response_id(&button));
            self.focus_path =
                !egui::Popup::is_id_open(ui.ctx(), egui::Popup::default_response_id(&button));
        }
        button.on_hover_text("The scene: generated, or from a file");
    }

    fn path_field(&mut self, ui: &mut egui::Ui, doc: &mut Document, focuses: bool) {
        let field = egui::TextEdit::singleline(&mut self.path)
            .hint_text("path or generator, Enter")
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path of a scene");
        let field = field.on_hover_text(tip(
            &format!(
                "The path of a scene ({}) or a workspace, or a generator's name with or without a size, such as \
                 balls:3; then Enter.",
                names()
            ),
            "window.path",
        ));
        if focuses {
            field.request_focus();
        }
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if entered && !self.path.trim().is_empty() {
            let source = SceneSource::parse(self.path.trim());
            self.open(source, ui.ctx(), doc);
            ui.close();
        }
    }

    fn recent_list(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        if self.recent.sources().is_empty() {
            ui.weak("Nothing was opened yet");
            return;
        }
        let mut chosen = None;
        for source in self.recent.sources() {
            if ui.button(source.to_string()).clicked() {
                chosen = Some(source.clone());
            }
        }
        if let Some(source) = chosen {
            self.open(source, ui.ctx(), doc);
            ui.close();
        }
        if ui.button("Clear list").clicked() {
            self.recent.clear();
        }
    }

    fn generators(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        ui.spacing_mut().item_spacing = egui::vec2(GAP, GAP);
        for row in BUILTINS.chunks(IN_A_ROW) {
            ui.horizontal(|ui| {
                for builtin in row {
                    let chosen = matches!(
                        &doc.wanted.scene.source,
                        SceneSource::Builtin { name, .. } if name == builtin.name
                    );
                    let item = self.thumbnails.button(ui, builtin, chosen);
                    if item.on_hover_text(builtin.about).clicked() {
                        doc.open(SceneSource::Builtin {
                            name: builtin.name.to_owned(),
                            size: None,
                        });
                    }
                }
            });
        }
    }

    /// The size of a generated scene.
    fn size(&self, ui: &mut egui::Ui, doc: &mut Document) {
        let SceneSource::Builtin { name, size } = &doc.wanted.scene.source else {
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
        let labeled = ui.horizontal(|ui| {
            ui.label("Size");
            ui.name_inputs("Size of the scene", |ui| ui.add(edit))
        });
        let response = labeled.inner;
        let changed = response.changed();
        response.on_hover_text(format!(
            "Size of the generated scene, {} to {}; the paper's is {}.",
            builtin.sizes.start(),
            builtin.sizes.end(),
            builtin.default_size
        ));
        if changed {
            let size = (value != builtin.default_size).then_some(value);
            doc.open(SceneSource::Builtin {
                name: builtin.name.to_owned(),
                size,
            });
        }
    }
}

/// What the dialog can be narrowed to: all scenes and workspaces, workspaces, then each format.
fn filters() -> Vec<(String, Vec<&'static str>)> {
    let scenes = FORMATS.iter().flat_map(|f| f.extensions).copied();
    let all = scenes.chain([EXTENSION, tree_file::EXTENSION]).collect();
    let workspaces = ("Workspaces".to_owned(), vec![EXTENSION]);
    let trees = ("Trees".to_owned(), vec![tree_file::EXTENSION]);
    let each = FORMATS.iter().map(|format| {
        let name = format!("{}: {}", format.name.to_uppercase(), format.about);
        (name, format.extensions.to_vec())
    });
    [
        ("Scenes, workspaces and trees".to_owned(), all),
        workspaces,
        trees,
    ]
    .into_iter()
    .chain(each)
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_filter_shows_files_of_every_format() {
        let filters = filters();
        assert_eq!(filters.len(), FORMATS.len() + 3);
        for extension in [
            "nff",
            "obj",
            "ply",
            "gltf",
            "glb",
            "stl",
            EXTENSION,
            tree_file::EXTENSION,
        ] {
            assert!(filters[0].1.contains(&extension));
            assert!(filters[1..].iter().any(|(_, e)| e.contains(&extension)));
        }
    }
}
