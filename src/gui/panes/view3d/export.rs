//! The 3D view as a picture of the screen, and its leaf boxes as a file.

use super::view::View3d;
use crate::gui::document::Document;
use crate::gui::edits::{Content, Export, MakeFile};
use crate::present::export::{LEAF_WRITERS, LeafCells};
use std::sync::Arc;

/// The view as it is on the screen, with its legend.
pub fn screen(view: &View3d, ctx: &egui::Context) -> Export {
    Export {
        name: "3D view",
        suffix: "-3d",
        extensions: vec!["png"],
        content: match view.on_screen(ctx) {
            Some(rect) => Content::Screen(rect),
            None => Content::Nothing("the 3D view is not on the screen".into()),
        },
    }
}

/// The leaves that the filters let through.
pub fn leaves(view: &View3d, doc: &Document) -> Export {
    Export {
        name: "Leaf boxes",
        suffix: "-leaves",
        extensions: LEAF_WRITERS.iter().map(|writer| writer.extension).collect(),
        content: match make(view, doc) {
            Ok(make) => Content::File(make),
            Err(why) => Content::Nothing(why),
        },
    }
}

fn make(view: &View3d, doc: &Document) -> Result<MakeFile, String> {
    let filter = view.filter();
    let current = doc.current.as_ref().ok_or("there is no tree yet")?;
    let visits = if filter.needs_visits() {
        let visits = doc.inspect.visits.of(current, &doc.jobs);
        Some(visits.ok_or("the 3D view's filter needs visits, which are being counted")?)
    } else {
        None
    };
    let tree = Arc::clone(&current.shown.tree);
    let of = format!(
        "{}, {}",
        current.shown.scene.name(),
        tree.settings().method.name
    );
    Ok(Box::new(move |extension| {
        let visits = visits.as_ref().map(|visits| &visits.visits);
        let leaves = LeafCells::new(of, &tree, &filter, visits);
        let writer = LEAF_WRITERS.iter().find(|w| w.extension == extension);
        let writer = writer.ok_or("no such format")?;
        let mut bytes = Vec::new();
        (writer.write)(&leaves, &mut bytes).map_err(|error| error.to_string())?;
        Ok(bytes)
    }))
}
