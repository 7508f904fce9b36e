//! An action: what it is called, which keys it has and what it does. Shell and panes declare theirs in
//! tables; palette, shortcut list and tooltips read the same entries.

use egui::{Key, Modifiers};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Where the keys of an action count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    Everywhere,
    /// While the pointer is over the pane that declares the action.
    Here,
    /// While a lesson runs, and then nowhere else: the pages of a lesson turn by the keys that
    /// presenter remotes send.
    Lesson,
}

/// An action without its effect.
#[derive(Clone, Copy, Debug)]
pub struct Info {
    /// Unique, of the form `owner.verb`.
    pub id: &'static str,
    pub scope: Scope,
    pub modifiers: Modifiers,
    /// Each of these keys triggers the action; none for an action that only has a name.
    pub keys: &'static [Key],
    /// What it does, starting with a verb.
    pub about: &'static str,
    /// Whether it repeats in every frame while the key is held.
    pub is_held: bool,
    /// Whether its keys count while text is typed.
    pub while_typing: bool,
}

impl Info {
    pub const fn new(
        id: &'static str,
        scope: Scope,
        modifiers: Modifiers,
        keys: &'static [Key],
        about: &'static str,
    ) -> Self {
        Info {
            id,
            scope,
            modifiers,
            keys,
            about,
            is_held: false,
            while_typing: false,
        }
    }

    pub const fn held(self) -> Self {
        Info {
            is_held: true,
            ..self
        }
    }

    pub const fn typing(self) -> Self {
        Info {
            while_typing: true,
            ..self
        }
    }

    /// Returns its shortcut in words, such as "Ctrl+Up"; empty if it has none.
    pub fn shortcut(&self) -> String {
        let keys: Vec<&str> = self.keys.iter().map(|key| key_name(*key)).collect();
        if keys.is_empty() {
            return String::new();
        }
        let mut text = String::new();
        for (on, name) in [
            (self.modifiers.command, "Ctrl+"),
            (self.modifiers.alt, "Alt+"),
            (self.modifiers.shift, "Shift+"),
        ] {
            if on {
                text += name;
            }
        }
        text += &keys.join(" or ");
        if self.is_held {
            text += ", held";
        }
        text
    }
}

fn key_name(key: Key) -> &'static str {
    match key {
        Key::Comma => ",",
        Key::Period => ".",
        Key::OpenBracket => "[",
        Key::CloseBracket => "]",
        Key::Escape => "Esc",
        Key::Questionmark => "?",
        Key::PageUp => "Page up",
        Key::PageDown => "Page down",
        key => key.name(),
    }
}

/// An action with its effect, a function of the owner.
pub struct Action<F: 'static> {
    pub info: Info,
    pub run: F,
}

/// What the mouse does in a pane: listed with the shortcuts.
#[derive(Clone, Copy, Debug)]
pub struct Gesture {
    /// Such as "Right-drag".
    pub gesture: &'static str,
    pub about: &'static str,
}

/// A table of actions: `"id" Scope MODIFIERS [Keys] "What it does" flags => function;`
macro_rules! actions {
    ($($id:literal $scope:ident $modifiers:ident $(+ $more:ident)? [$($key:ident),*] $about:literal $($flag:ident)* => $run:expr;)*) => {
        &[$($crate::gui::action::Action {
            info: $crate::gui::action::Info::new(
                $id,
                $crate::gui::action::Scope::$scope,
                egui::Modifiers::$modifiers$(.plus(egui::Modifiers::$more))?,
                &[$(egui::Key::$key),*],
                $about,
            )$(.$flag())*,
            run: $run,
        }),*]
    };
}
pub(in crate::gui) use actions;

/// The shortcuts by the ids of their actions, for tooltips; filled when the window starts.
static SHORTCUTS: OnceLock<BTreeMap<&'static str, String>> = OnceLock::new();

/// Makes all actions known to [`shortcut`] and [`tip`].
pub fn register(all: impl Iterator<Item = Info>) {
    SHORTCUTS.get_or_init(|| all.map(|info| (info.id, info.shortcut())).collect());
}

/// Returns the shortcut of an action; empty if it has none.
pub fn shortcut(id: &str) -> &'static str {
    let known = SHORTCUTS.get().and_then(|all| all.get(id));
    debug_assert!(known.is_some(), "no action is called {id}");
    known.map_or("", String::as_str)
}

/// Returns a tooltip: what a widget does, and the shortcut of the action that does the same.
pub fn tip(about: &str, id: &str) -> String {
    match shortcut(id) {
        "" => about.to_owned(),
        keys => format!("{about}\nShortcut: {keys}"),
    }
}
