//! The command palette: every action of the table of shortcuts, and what can be chosen from the
//! registries, found by a few letters.

use super::layout::Pane;
use super::shortcuts::{Action, SHORTCUTS};
use crate::lesson::LESSONS;
use crate::measure::heat::heatmaps;
use crate::present::overlay::COLORINGS;
use crate::scene::SceneSource;
use crate::scene::builtin::BUILTINS;
use crate::structure::Method;
use crate::workspace::Workspace;
use egui::{Key, Modifiers};
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher};

/// What can be chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    Do(Action),
    Method(Method),
    Open(SceneSource),
    /// Place in [`heatmaps`]; `None` for the picture alone.
    Heatmap(Option<usize>),
    /// Place in [`COLORINGS`].
    Color(usize),
    /// Place in [`LESSONS`].
    Lesson(usize),
}

/// A line of the palette.
#[derive(Clone)]
struct Entry {
    text: String,
    /// Its shortcut; empty if it has none.
    keys: &'static str,
    command: Command,
}

impl AsRef<str> for Entry {
    fn as_ref(&self) -> &str {
        &self.text
    }
}

/// The palette; it shows nothing until it is opened.
#[derive(Default)]
pub struct Palette {
    open: Option<Search>,
}

struct Search {
    query: String,
    /// Place in `found`.
    selected: usize,
    all: Vec<Entry>,
    /// The entries that go with the query, the best first.
    found: Vec<Entry>,
    matcher: Matcher,
}

impl Palette {
    /// Opens or closes the palette.
    pub fn toggle(&mut self, recent: &[SceneSource]) {
        self.open = match self.open {
            Some(_) => None,
            None => Some(Search::new(recent)),
        };
    }

    /// Closes the palette; says whether it was open.
    pub fn close(&mut self) -> bool {
        self.open.take().is_some()
    }

    /// Shows the palette while it is open; gives what was chosen.
    pub fn show(&mut self, ctx: &egui::Context) -> Option<Command> {
        let search = self.open.as_mut()?;
        let id = egui::Id::unique("command palette");
        let area = egui::Modal::default_area(id).anchor(egui::Align2::CENTER_TOP, [0.0, 48.0]);
        let shown = egui::Modal::new(id)
            .area(area)
            .show(ctx, |ui| search.ui(ui));
        let close = shown.should_close();
        if shown.inner.is_some() || close {
            self.open = None;
        }
        shown.inner
    }
}

impl Search {
    fn new(recent: &[SceneSource]) -> Self {
        let all = entries(recent);
        Search {
            query: String::new(),
            selected: 0,
            found: all.clone(),
            all,
            matcher: Matcher::new(Config::DEFAULT),
        }
    }

    /// The entries that hold the words as they were typed come first, then the nearest.
    fn find(&mut self) {
        let pattern = Pattern::parse(&self.query, CaseMatching::Ignore, Normalization::Smart);
        let found = pattern.match_list(&self.all, &mut self.matcher);
        self.found = found.into_iter().map(|(entry, _)| entry.clone()).collect();
        let typed = self.query.to_lowercase();
        self.found
            .sort_by_key(|entry| !entry.text.to_lowercase().contains(&typed));
        self.selected = 0;
    }

    fn ui(&mut self, ui: &mut egui::Ui) -> Option<Command> {
        const WIDTH: f32 = 560.0;
        const LIST_HEIGHT: f32 = 340.0;
        let room = ui.ctx().content_rect().size() - egui::vec2(40.0, 140.0);
        ui.set_width(WIDTH.min(room.x));
        let pressed = |key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        let (down, up) = (pressed(Key::ArrowDown), pressed(Key::ArrowUp));
        let enter = pressed(Key::Enter);
        let field = egui::TextEdit::singleline(&mut self.query)
            .hint_text("Search for a command; Enter does it")
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Search for a command");
        field.request_focus();
        if field.changed() {
            self.find();
        }
        let last = self.found.len().saturating_sub(1);
        if down {
            self.selected = (self.selected + 1).min(last);
        }
        if up {
            self.selected = self.selected.saturating_sub(1);
        }
        let mut chosen = enter.then_some(self.selected);
        if self.found.is_empty() {
            ui.weak("No command goes by that.");
        }
        egui::ScrollArea::vertical()
            .max_height(LIST_HEIGHT.min(room.y))
            .auto_shrink([false, true])
            .show(ui, |ui| {
                for (i, entry) in self.found.iter().enumerate() {
                    let row = egui::Button::selectable(i == self.selected, entry.text.as_str())
                        .shortcut_text(entry.keys)
                        .truncate()
                        .min_size(egui::vec2(ui.available_width(), 0.0));
                    let row = ui.add(row);
                    if row.clicked() {
                        chosen = Some(i);
                    }
                    if i == self.selected && (down || up || field.changed()) {
                        row.scroll_to_me(None);
                    }
                }
            });
        chosen
            .and_then(|i| self.found.get(i))
            .map(|entry| entry.command.clone())
    }
}

/// All there is to choose from.
fn entries(recent: &[SceneSource]) -> Vec<Entry> {
    let plain = |text: String, command| Entry {
        text,
        keys: "",
        command,
    };
    let actions = SHORTCUTS
        .iter()
        .filter(|shortcut| shortcut.action != Action::Mouse)
        .map(|shortcut| Entry {
            text: match Pane::of(shortcut.scope) {
                Some(pane) => format!("{}: {}", pane.title(), shortcut.about),
                None => shortcut.about.to_owned(),
            },
            keys: shortcut.text,
            command: Command::Do(shortcut.action),
        });
    let methods = Method::all().map(|method| {
        let text = format!("Method: {} ({})", method.title, method.name);
        plain(text, Command::Method(method))
    });
    let picture = plain("Heatmap: none".into(), Command::Heatmap(None));
    let heatmaps = heatmaps().iter().enumerate().map(|(place, heatmap)| {
        let text = format!("Heatmap: {} ({})", heatmap.name, heatmap.symbol);
        plain(text, Command::Heatmap(Some(place)))
    });
    let colorings = COLORINGS.iter().enumerate().map(|(place, coloring)| {
        let text = format!("Colour leaves by: {}", coloring.title);
        plain(text, Command::Color(place))
    });
    let lessons = LESSONS.iter().enumerate().map(|(place, known)| {
        let text = format!("Lesson: {}", known.read().title);
        plain(text, Command::Lesson(place))
    });
    let scenes = BUILTINS.iter().map(|builtin| SceneSource::Builtin {
        name: builtin.name.to_owned(),
        size: None,
    });
    let recent = recent.iter().cloned();
    let opened: Vec<SceneSource> = recent.clone().collect();
    let scenes = recent
        .chain(scenes.filter(|scene| !opened.contains(scene)))
        .map(|source| {
            let path = std::path::PathBuf::from(source.to_string());
            let what = if Workspace::is_path(&path) {
                "Workspace"
            } else {
                "Scene"
            };
            plain(format!("{what}: {source}"), Command::Open(source))
        });
    actions
        .chain(methods)
        .chain([picture])
        .chain(heatmaps)
        .chain(colorings)
        .chain(lessons)
        .chain(scenes)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn search(query: &str) -> Search {
        let mut search = Search::new(&[SceneSource::parse("there/is/a.nff")]);
        query.clone_into(&mut search.query);
        search.find();
        search
    }

    #[test]
    fn every_action_is_found_by_what_it_does() {
        let actions: Vec<_> = SHORTCUTS
            .iter()
            .filter(|shortcut| shortcut.action != Action::Mouse)
            .collect();
        assert!(!actions.is_empty());
        for shortcut in actions {
            let found = search(shortcut.about).found;
            // What reads alike stands close together.
            let near = found.iter().take(5);
            let mut same = near.filter(|entry| entry.command == Command::Do(shortcut.action));
            let entry = same.next().unwrap_or_else(|| panic!("{}", shortcut.about));
            assert_eq!(entry.keys, shortcut.text);
        }
    }

    #[test]
    fn a_few_letters_will_do() {
        for (query, first) in [
            ("frm sel", Command::Do(Action::FrameSelection)),
            (
                "sah-cut",
                Command::Method(Method::named("sah-cut").unwrap()),
            ),
            ("a.nff", Command::Open(SceneSource::parse("there/is/a.nff"))),
            ("heatmap none", Command::Heatmap(None)),
            ("colour by depth", Command::Color(0)),
        ] {
            let found = search(query).found;
            let first_found = found.first().map(|entry| entry.command.clone());
            assert_eq!(first_found, Some(first), "{query}");
        }
        assert!(search("qqqq").found.is_empty());
        assert!(search("").found.len() > SHORTCUTS.len() / 2);
    }
}
