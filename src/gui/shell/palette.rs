//! The command palette: every action of the table of shortcuts, and what can be chosen from the
//! registries, found by a few letters.

use crate::gui::action::Info;
use crate::gui::pane::AnyPane;
use crate::gui::panes::PANES;
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
    /// An action, by its id.
    Do(&'static str),
    Method(Method),
    Open(SceneSource),
    /// A pane, by its id.
    Show(&'static str),
    /// One of a pane's choices: places of the pane and of the choice.
    Choose(usize, usize),
}

/// A line of the palette.
#[derive(Clone)]
struct Entry {
    text: String,
    /// Its shortcut; empty if it has none.
    keys: String,
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
    pub fn toggle(
        &mut self,
        shell: impl Iterator<Item = Info>,
        panes: &[Box<dyn AnyPane>],
        recent: &[SceneSource],
    ) {
        self.open = match self.open {
            Some(_) => None,
            None => Some(Search::new(entries(shell, panes, recent))),
        };
    }

    /// Closes the palette; says whether it was open.
    pub fn close(&mut self) -> bool {
        self.open.take().is_some()
    }

    /// Shows the palette while it is open; returns what was chosen.
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
    fn new(all: Vec<Entry>) -> Self {
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
            .hint_text("Search for a command; Enter runs it")
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
            ui.weak("No matching commands");
        }
        egui::ScrollArea::vertical()
            .max_height(LIST_HEIGHT.min(room.y))
            .auto_shrink([false, true])
            .show(ui, |ui| {
                for (i, entry) in self.found.iter().enumerate() {
                    let row = egui::Button::selectable(i == self.selected, entry.text.as_str())
                        .shortcut_text(entry.keys.as_str())
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
fn entries(
    shell: impl Iterator<Item = Info>,
    panes: &[Box<dyn AnyPane>],
    recent: &[SceneSource],
) -> Vec<Entry> {
    let plain = |text: String, command| Entry {
        text,
        keys: String::new(),
        command,
    };
    let of_shell = shell.map(|info| Entry {
        text: info.about.to_owned(),
        keys: info.shortcut(),
        command: Command::Do(info.id),
    });
    let of_panes = PANES.iter().flat_map(|entry| {
        let actions = entry.actions().into_iter();
        actions.map(|info| Entry {
            text: format!("{}: {}", entry.title, info.about),
            keys: info.shortcut(),
            command: Command::Do(info.id),
        })
    });
    let shown = PANES
        .iter()
        .map(|entry| plain(format!("Show {}", entry.title), Command::Show(entry.id)));
    let methods = Method::all().map(|method| {
        let text = format!("Method: {}", method.name);
        plain(text, Command::Method(method))
    });
    let choices = panes.iter().enumerate().flat_map(|(place, pane)| {
        let choices = pane.choices().into_iter().enumerate();
        choices.map(move |(choice, text)| plain(text, Command::Choose(place, choice)))
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
    of_shell
        .chain(of_panes)
        .chain(shown)
        .chain(methods)
        .chain(choices)
        .chain(scenes)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::shell::actions::ACTIONS;

    fn search(query: &str) -> Search {
        let panes: Vec<_> = PANES.iter().map(|entry| (entry.make)()).collect();
        let shell = ACTIONS.iter().map(|action| action.info);
        let recent = [SceneSource::parse("there/is/a.nff")];
        let mut search = Search::new(entries(shell, &panes, &recent));
        query.clone_into(&mut search.query);
        search.find();
        search
    }

    #[test]
    fn every_action_is_found_by_what_it_does() {
        let shell = ACTIONS.iter().map(|action| action.info);
        let all: Vec<Info> = shell
            .chain(PANES.iter().flat_map(|entry| entry.actions()))
            .collect();
        assert!(!all.is_empty());
        for info in all {
            let found = search(info.about).found;
            // What reads alike stands close together.
            let near = found.iter().take(5);
            let mut same = near.filter(|entry| entry.command == Command::Do(info.id));
            let entry = same.next().unwrap_or_else(|| panic!("{}", info.about));
            assert_eq!(entry.keys, info.shortcut());
        }
    }

    #[test]
    fn a_few_letters_will_do() {
        for (query, first) in [
            ("frm sel", "3D: Frame the selection"),
            ("sah-cut", "Method: SAH with cutting"),
            ("a.nff", "Scene: there/is/a.nff"),
            ("heatmap none", "Heatmap: none"),
            ("color by depth", "Color leaves by: "),
        ] {
            let found = search(query).found;
            let text = found.first().map_or("", |entry| entry.text.as_str());
            assert!(
                text.contains(first) || text.starts_with("Method"),
                "{query}: {text}"
            );
        }
        assert!(search("qqqq").found.is_empty());
        assert!(search("").found.len() > ACTIONS.len());
    }
}
