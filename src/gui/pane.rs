//! What a pane is. A pane owns its state, its drawing, its actions and what a workspace keeps of it. It
//! reads the document and returns edits.

use super::action::{Action, Gesture, Info};
use super::document::Document;
pub use super::document::Fact;
use super::edits::Edits;
use crate::workspace::View;
use eframe::egui_wgpu::RenderState;

/// What a pane works with.
pub struct Cx<'a> {
    pub doc: &'a Document,
    pub edits: &'a mut Edits,
    pub ctx: &'a egui::Context,
    /// All panes.
    pub panes: &'static [Entry],
}

/// An action of a pane.
pub type PaneAction<P> = Action<fn(&mut P, &mut Cx<'_>)>;

/// A pane. It is one folder in `panes` and one line in [`super::panes::PANES`].
pub trait Pane: Default + 'static {
    /// Names the pane in layouts, workspaces and lessons; never changes.
    const ID: &'static str;
    /// What its tab says.
    const TITLE: &'static str;
    /// Titles of earlier versions, which files may contain.
    const ALIASES: &'static [&'static str] = &[];
    /// What it shows, in one sentence.
    const ABOUT: &'static str;
    /// The facts that it shows. While a lesson asks for one of them, the pane is hidden.
    const REVEALS: &'static [Fact] = Fact::ALL;
    /// Whether it fills its place and scrolls by itself.
    const FILLS: bool = false;
    const ACTIONS: &'static [PaneAction<Self>] = &[];
    const GESTURES: &'static [Gesture] = &[];

    /// Prepares for drawing; `None` where there is no graphics adapter.
    fn start(&mut self, _graphics: Option<&RenderState>) {}

    /// Receives results; once a frame, whether or not the pane is on the screen.
    fn update(&mut self, _cx: &mut Cx<'_>) {}

    /// Draws the pane.
    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>);

    /// Draws what belongs into the pane's title row, from right to left.
    fn controls(&mut self, _ui: &mut egui::Ui, _cx: &mut Cx<'_>) {}

    /// What else the palette offers, such as one line per heatmap.
    fn choices(&self) -> Vec<String> {
        Vec::new()
    }

    /// Applies one of [`Pane::choices`], by its place.
    fn choose(&mut self, _place: usize, _cx: &mut Cx<'_>) {}

    /// Writes what a workspace keeps.
    fn save(&self, _view: &mut View) {}

    /// Shows what a workspace kept.
    fn load(&mut self, _view: &View) {}
}

/// [`Pane`] as an object.
pub trait AnyPane {
    fn act(&mut self, place: usize, cx: &mut Cx<'_>);
    fn start(&mut self, graphics: Option<&RenderState>);
    fn update(&mut self, cx: &mut Cx<'_>);
    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>);
    fn controls(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>);
    fn choices(&self) -> Vec<String>;
    fn choose(&mut self, place: usize, cx: &mut Cx<'_>);
    fn save(&self, view: &mut View);
    fn load(&mut self, view: &View);
}

impl<P: Pane> AnyPane for P {
    fn act(&mut self, place: usize, cx: &mut Cx<'_>) {
        (P::ACTIONS[place].run)(self, cx);
    }

    fn start(&mut self, graphics: Option<&RenderState>) {
        Pane::start(self, graphics);
    }

    fn update(&mut self, cx: &mut Cx<'_>) {
        Pane::update(self, cx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        Pane::ui(self, ui, cx);
    }

    fn controls(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        Pane::controls(self, ui, cx);
    }

    fn choices(&self) -> Vec<String> {
        Pane::choices(self)
    }

    fn choose(&mut self, place: usize, cx: &mut Cx<'_>) {
        Pane::choose(self, place, cx);
    }

    fn save(&self, view: &mut View) {
        Pane::save(self, view);
    }

    fn load(&mut self, view: &View) {
        Pane::load(self, view);
    }
}

/// A line of the registry of panes.
pub struct Entry {
    pub id: &'static str,
    pub title: &'static str,
    pub aliases: &'static [&'static str],
    pub about: &'static str,
    pub reveals: &'static [Fact],
    pub fills: bool,
    pub gestures: &'static [Gesture],
    infos: fn() -> Vec<Info>,
    pub make: fn() -> Box<dyn AnyPane>,
}

impl Entry {
    pub const fn of<P: Pane>() -> Self {
        Entry {
            id: P::ID,
            title: P::TITLE,
            aliases: P::ALIASES,
            about: P::ABOUT,
            reveals: P::REVEALS,
            fills: P::FILLS,
            gestures: P::GESTURES,
            infos: || P::ACTIONS.iter().map(|action| action.info).collect(),
            make: || Box::new(P::default()),
        }
    }

    /// Its actions, in the order of their table.
    pub fn actions(&self) -> Vec<Info> {
        (self.infos)()
    }

    /// Whether a file means this pane by a name.
    pub fn is_called(&self, name: &str) -> bool {
        self.id == name || self.title == name || self.aliases.contains(&name)
    }
}
