//! The line that finds nodes: the query, how many nodes match, and the way from one to the next.

use crate::gui::action::tip;
use crate::gui::document::inspect::TreeKey;
use crate::gui::document::tasks::Latest;
use crate::gui::widgets::symbol::grouped;
use crate::jobs::PictureVisits;
use crate::structure::{Query, TreeIndex};
use std::sync::Arc;

/// The query.
#[derive(Default)]
pub struct FindBar {
    pub text: String,
    /// Whether the outline lists only the matches.
    pub only: bool,
    found: Latest<Key, Vec<u32>>,
}

/// What decides the matches: the tree, the query, and for queries by visits the picture's number.
type Key = (TreeKey, String, Option<u64>);

/// What the line's widgets ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Next,
    Previous,
}

const ABOUT: &str = "Find nodes:\n\
    depth 12 · node 17 · object 138 (leaves that refer to it)\n\
    objects > 8 (in a leaf) · references >= 100 · leaves > 5 (in a subtree)\n\
    area > 2 % (of the root's) · tests > 3 (expected tests of a ray)\n\
    visits >= 1000 (rays of the picture) · visits 0 (never visited)\n\
    stop depth (why a leaf stopped, in words) · empty";

impl FindBar {
    /// All matches; `None` while there is nothing to look for, the search goes on, or visits are
    /// looked for that are not counted yet. `visits` are of the picture of this number.
    pub fn matches(
        &mut self,
        tree: &TreeKey,
        index: &Arc<TreeIndex>,
        visits: Option<Arc<PictureVisits>>,
        picture: u64,
        ctx: &egui::Context,
    ) -> Option<Arc<Vec<u32>>> {
        let query = Query::parse(&self.text).ok()?;
        if query.needs_visits() && visits.is_none() {
            return None;
        }
        let of = query.needs_visits().then_some(picture);
        let key = (tree.clone(), self.text.clone(), of);
        let (tree, index) = (Arc::clone(&tree.0), Arc::clone(index));
        self.found.get(&key, ctx, move || {
            let visits = visits.as_ref().map(|visits| visits.by_node.as_slice());
            query.find(&tree, &index, visits)
        })
    }

    /// Shows the line.
    pub fn ui(
        &mut self,
        ui: &mut egui::Ui,
        matches: Option<&[u32]>,
        selected: Option<u32>,
    ) -> Option<Step> {
        let mut step = None;
        ui.horizontal_wrapped(|ui| {
            ui.label("Find").on_hover_text(ABOUT);
            let field = egui::TextEdit::singleline(&mut self.text)
                .desired_width(120.0)
                .hint_text("objects > 8");
            let field = ui.add(field).on_hover_text(ABOUT);
            crate::gui::widgets::common::name_widget(ui, &field, "Find nodes");
            if field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
                step = Some(Step::Next);
            }
            let some = matches.is_some_and(|found| !found.is_empty());
            for (name, about, to, key) in [
                (
                    "Previous match",
                    "Select the previous match.",
                    Step::Previous,
                    "outline.find-previous",
                ),
                (
                    "Next match",
                    "Select the next match.",
                    Step::Next,
                    "outline.find-next",
                ),
            ] {
                let button = ui.add_enabled(some, egui::Button::new(name));
                if button.on_hover_text(tip(about, key)).clicked() {
                    step = Some(to);
                }
            }
            ui.add_enabled_ui(some, |ui| {
                ui.checkbox(&mut self.only, "Only matches")
                    .on_hover_text("List only the matches, in the order of the tree.");
            });
            let text = match (Query::parse(&self.text), matches) {
                _ if self.text.trim().is_empty() => return,
                (Err(why), _) => why,
                (Ok(_), None) => "searching…".to_owned(),
                (Ok(_), Some(found)) => {
                    let at = selected.and_then(|node| found.binary_search(&node).ok());
                    let of = grouped(found.len());
                    match at {
                        Some(at) => format!("match {} of {of}", grouped(at + 1)),
                        None if found.len() == 1 => "1 match".to_owned(),
                        None => format!("{of} matches"),
                    }
                }
            };
            ui.label(text);
        });
        step
    }
}

/// Returns the match after, or before, the selected node; after the last comes the first.
pub fn step(matches: &[u32], selected: Option<u32>, step: Step) -> Option<u32> {
    let last = matches.last().copied();
    let Some(selected) = selected else {
        return if step == Step::Next {
            matches.first().copied()
        } else {
            last
        };
    };
    match step {
        Step::Next => {
            let at = matches.partition_point(|&node| node <= selected);
            matches.get(at).or(matches.first()).copied()
        }
        Step::Previous => {
            let at = matches.partition_point(|&node| node < selected);
            at.checked_sub(1).map(|at| matches[at]).or(last)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matches_are_walked_in_a_circle() {
        let found = [2, 5, 9];
        assert_eq!(step(&found, None, Step::Next), Some(2));
        assert_eq!(step(&found, Some(5), Step::Next), Some(9));
        assert_eq!(step(&found, Some(9), Step::Next), Some(2));
        assert_eq!(step(&found, Some(4), Step::Previous), Some(2));
        assert_eq!(step(&found, Some(2), Step::Previous), Some(9));
        assert_eq!(step(&[], Some(2), Step::Next), None);
    }
}
