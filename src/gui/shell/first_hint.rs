//! What to try first: shown until it is dismissed, then never again.

use super::kept::KeptFile;
use crate::gui::action::shortcut;
use crate::lesson::LESSONS;

/// The name of the file that remembers that it was dismissed.
const FILE: &str = "hint.json";

/// The hint; where nothing is kept from run to run, it is not shown at all.
pub struct FirstHint {
    file: KeptFile,
    shown: bool,
}

/// What was chosen in the hint.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Chosen {
    FirstLesson,
    Dismiss,
}

impl FirstHint {
    pub fn new(start: &crate::gui::StartOptions) -> Self {
        let file = KeptFile::new(start, FILE);
        FirstHint {
            shown: start.remember && start.lesson.is_none() && file.read::<bool>() != Some(true),
            file,
        }
    }

    /// Never shows it again; says whether it was shown.
    pub fn dismiss(&mut self) -> bool {
        if self.shown {
            self.file.write(&true);
        }
        std::mem::take(&mut self.shown)
    }

    /// Shows the hint while it is wanted; gives what was chosen.
    pub fn show(&mut self, ctx: &egui::Context) -> Option<Chosen> {
        if !self.shown {
            return None;
        }
        let mut chosen = None;
        egui::Window::new("Three things to try")
            .anchor(egui::Align2::CENTER_BOTTOM, [0.0, -60.0])
            .collapsible(false)
            .resizable(false)
            .default_width(430.0)
            .show(ctx, |ui| {
                egui::Grid::new("hints").num_columns(2).show(ui, |ui| {
                    for (keys, about) in [
                        (
                            shortcut("window.next-method"),
                            "build the tree by another method; watch Δ",
                        ),
                        (
                            shortcut("window.toggle-compare"),
                            "put a second tree beside this one",
                        ),
                        (
                            "Click a pixel",
                            "follow its rays through the tree, step by step",
                        ),
                    ] {
                        ui.strong(keys);
                        ui.label(about);
                        ui.end_row();
                    }
                });
                ui.separator();
                ui.horizontal_wrapped(|ui| {
                    let first = LESSONS[0].read().title;
                    if ui.button(format!("First lesson: {first}")).clicked() {
                        chosen = Some(Chosen::FirstLesson);
                    }
                    let dismiss = ui.button("Dismiss");
                    if dismiss
                        .on_hover_text("Close this for good.\nShortcut: Esc")
                        .clicked()
                    {
                        chosen = Some(Chosen::Dismiss);
                    }
                });
                let all = shortcut("window.help");
                ui.weak(format!(
                    "{all} lists all shortcuts, {} the lessons.",
                    shortcut("lesson.open")
                ));
            });
        if chosen.is_some() {
            self.dismiss();
        }
        chosen
    }
}
