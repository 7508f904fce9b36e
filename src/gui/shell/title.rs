//! The window's title: scene, method, and whether the workspace has unsaved changes.

use crate::gui::document::Document;
use crate::structure::tree_file::short_name;

/// The program's name, which ends every title.
pub const PROGRAM: &str = "bspscope";

/// The title that the window has.
#[derive(Default)]
pub struct Title {
    shown: String,
}

impl Title {
    /// Sets the window's title if it is another.
    pub fn follow(&mut self, doc: &Document, is_unsaved: bool, ctx: &egui::Context) {
        let title = text(doc, is_unsaved);
        if title != self.shown {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.shown = title;
        }
    }
}

fn text(doc: &Document, is_unsaved: bool) -> String {
    let scene = doc.wanted.scene.source.short_name();
    let mark = if is_unsaved { "• " } else { "" };
    let method = short_name(doc.wanted.build.method.name);
    format!("{mark}{scene} · {method} – {PROGRAM}")
}
