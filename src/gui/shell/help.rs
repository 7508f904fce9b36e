//! The window that lists all shortcuts, made from the actions of shell and panes.

use crate::gui::action::{Gesture, Info, Scope};
use crate::gui::panes::PANES;

/// Actions and gestures that belong together.
pub struct Section {
    pub title: String,
    /// Shortcut and what it does.
    pub lines: Vec<(String, &'static str)>,
}

/// Returns all shortcuts: those that count everywhere first, then pane by pane.
pub fn sections(shell: impl Iterator<Item = Info>) -> Vec<Section> {
    let line = |info: &Info| (info.shortcut(), info.about);
    let gesture = |g: &Gesture| (g.gesture.to_owned(), g.about);
    let named = |(keys, _): &(String, &str)| !keys.is_empty();
    let all = PANES.iter().flat_map(|entry| entry.actions());
    let everywhere = shell.chain(all.filter(|info| info.scope != Scope::Here));
    let mut lines: Vec<_> = everywhere.map(|info| line(&info)).filter(named).collect();
    lines.push((
        "Drop a file".into(),
        "Open it: a scene, a workspace or a lesson",
    ));
    let mut sections = vec![Section {
        title: "Everywhere".into(),
        lines,
    }];
    for entry in PANES {
        let actions = entry.actions();
        let here = actions.iter().filter(|info| info.scope == Scope::Here);
        let gestures = entry.gestures.iter().map(gesture);
        let lines: Vec<_> = gestures.chain(here.map(line)).filter(named).collect();
        if !lines.is_empty() {
            let title = format!("Pointer over {}", entry.title);
            sections.push(Section { title, lines });
        }
    }
    sections
}

/// Shows the list while `open`.
pub fn show(ctx: &egui::Context, shell: impl Iterator<Item = Info>, open: &mut bool) {
    if !*open {
        return;
    }
    egui::Window::new("Shortcuts")
        .open(open)
        .collapsible(false)
        .default_size([480.0, 640.0])
        .vscroll(true)
        .show(ctx, |ui| {
            for section in sections(shell) {
                ui.heading(&section.title);
                egui::Grid::new(&section.title)
                    .num_columns(2)
                    .striped(true)
                    .min_col_width(110.0)
                    .show(ui, |ui| {
                        for (keys, about) in &section.lines {
                            ui.strong(keys);
                            ui.label(*about);
                            ui.end_row();
                        }
                    });
                ui.add_space(8.0);
            }
        });
}
