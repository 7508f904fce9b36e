//! The window: the document, the panes, and what is kept of them. [`super::frame`] draws it.

use super::clipboard::Clipboard;
use super::exporting::Exports;
use super::files::Files;
use super::first_start::FirstStart;
use super::full_screen::FullScreen;
use super::kept::KeptFile;
use super::layout::{LAYOUT_FILE, Layout};
use super::palette::Palette;
use super::places::{self, PaneId, TITLE_ROW};
use super::progress::WorkInProgress;
use super::recent::Recent;
use super::status::StatusLine;
use super::tasks::{TaskId, task};
use super::title::Title;
use super::workspaces::Workspaces;
use super::{keys, top_bar};
use crate::gui::StartOptions;
use crate::gui::action::{self, Info, Scope};
use crate::gui::document::notices::Notices;
use crate::gui::document::{Document, tasks};
use crate::gui::edits::{Edits, Request};
use crate::gui::icons;
use crate::gui::pane::{AnyPane, Cx};
use crate::gui::panes::PANES;
use crate::gui::theme::{self, IconButton};
use crate::gui::widgets::hidden;
use crate::scene::SceneSource;
use crate::setup::{Setup, measure_command};
use crate::workspace::Workspace;

/// The window.
pub struct App {
    pub(super) doc: Document,
    /// The actions of the shell.
    pub(super) shell: Vec<Info>,
    /// The panes, in the order of [`PANES`].
    pub(super) panes: Vec<Box<dyn AnyPane>>,
    /// Their actions, likewise.
    pub(super) actions: Vec<Vec<Info>>,
    pub(super) files: Files,
    pub(super) layout: Layout,
    pub(super) layout_file: KeptFile,
    /// The layout as it was kept last.
    pub(super) kept_layout: Option<Layout>,
    /// The pane that was open at the bottom before a lesson, and whether the settings were shown; `None`
    /// without a lesson.
    pub(super) before_lesson: Option<(Option<String>, bool)>,
    /// The pane that fills the window.
    pub(super) maximized: Option<PaneId>,
    /// The pane under the pointer.
    pub(super) under_pointer: Option<PaneId>,
    pub(super) presenting: Option<FullScreen>,
    pub(super) status: StatusLine,
    pub(super) help_open: bool,
    pub(super) palette: Palette,
    pub(super) exports: Exports,
    pub(super) first_start: FirstStart,
    pub(super) clipboard: Clipboard,
    pub(super) title: Title,
    /// The largest window that the graphics adapter can draw, in pixels on a side; 0 before it is known.
    pub(super) largest: usize,
    pub(super) working: WorkInProgress,
    /// What panes and menus asked for in this frame.
    pub(super) requests: Vec<Request>,
}

impl App {
    /// Makes the window's contents, with the actions of the shell, and asks for the first scene.
    pub(super) fn with_actions(
        cc: &eframe::CreationContext<'_>,
        start: StartOptions,
        shell: Vec<Info>,
    ) -> Self {
        let ctx = &cc.egui_ctx;
        theme::install(ctx);
        let of_panes = PANES.iter().flat_map(|entry| entry.actions());
        action::register(shell.iter().copied().chain(of_panes));
        let recent = Recent::kept(KeptFile::new(&start, "recent.json"));
        let mut notices = Notices::default();
        let jobs = tasks::scheduler(ctx);
        let (workspaces, workspace) = Workspaces::new(&start, ctx, &mut notices);
        let layout_file = KeptFile::new(&start, LAYOUT_FILE);
        let layout: Layout = layout_file.read().unwrap_or_default();
        if let Some(dark) = layout.dark {
            top_bar::set_theme(ctx, dark);
        }
        let mut start = start;
        // The screen takes no larger picture.
        let largest = ctx.input(|i| i.max_texture_side) as u32;
        let render = &mut start.setup.render;
        render.width = render.width.min(largest);
        render.height = render.height.min(largest);
        let mut panes: Vec<_> = PANES.iter().map(|entry| (entry.make)()).collect();
        for pane in &mut panes {
            pane.start(cc.wgpu_render_state.as_ref());
        }
        let mut app = App {
            doc: Document::new(&start, jobs),
            shell,
            panes,
            actions: PANES.iter().map(|entry| entry.actions()).collect(),
            files: Files::new(recent, workspaces),
            layout,
            layout_file,
            kept_layout: None,
            before_lesson: None,
            maximized: None,
            under_pointer: None,
            presenting: None,
            status: StatusLine::default(),
            help_open: false,
            palette: Palette::default(),
            exports: Exports::default(),
            first_start: FirstStart::new(&start),
            clipboard: Clipboard::default(),
            title: Title::default(),
            largest: 0,
            working: WorkInProgress::default(),
            requests: Vec::new(),
        };
        app.doc.notices = notices;
        let first = app.layout.task.0;
        app.switch(first);
        if let Some(workspace) = workspace {
            app.restore(&workspace, ctx);
        }
        app
    }

    /// Whether everything that was asked for is on view, with final figures.
    pub fn is_finished(&self) -> bool {
        self.doc.is_finished()
    }

    /// The settings of the tree in front, as its widgets show them.
    pub fn setup(&self) -> &Setup {
        &self.doc.wanted
    }

    /// All that is shown, as a workspace.
    pub(super) fn workspace(&self) -> Workspace {
        let mut workspace = self.doc.workspace();
        for pane in &self.panes {
            pane.save(&mut workspace.view);
        }
        workspace.layout = serde_json::to_value(&self.layout).ok();
        workspace
    }

    /// Shows what a workspace says. A layout that is not known leaves the panes as they are.
    pub(super) fn restore(&mut self, workspace: &Workspace, ctx: &egui::Context) {
        let largest = ctx.input(|i| i.max_texture_side) as u32;
        self.doc.restore(workspace, largest);
        for pane in &mut self.panes {
            pane.load(&workspace.view);
        }
        let layout = workspace.layout.clone();
        if let Some(layout) = layout.and_then(|value| serde_json::from_value(value).ok()) {
            self.layout = layout;
            if let Some(dark) = self.layout.dark {
                top_bar::set_theme(ctx, dark);
            }
        }
        if workspace.b.is_some() && self.layout.task.0 != "lessons" {
            self.layout.task = TaskId("compare");
        }
        self.doc.task = self.layout.task.0;
    }

    /// Switches to a task. Comparing begins with the task and ends with it.
    pub(super) fn switch(&mut self, id: &str) {
        let task = task(id);
        let compares = task.id == "compare";
        if compares != self.doc.other.is_some() && !self.doc.in_lesson {
            self.doc.compare_or_not();
        }
        self.layout.task = TaskId(task.id);
        self.doc.task = task.id;
        self.maximized = None;
    }

    /// Shows the task that belongs to one tree or two, after undo or redo.
    pub(super) fn follow_comparison(&mut self) {
        let compares = self.doc.other.is_some();
        if compares != (self.doc.task == "compare") && !self.doc.in_lesson {
            self.switch(if compares { "compare" } else { "explore" });
        }
    }

    /// Keeps what was open at the bottom and beside the panes while a lesson runs, and opens it again
    /// after.
    pub(super) fn follow_lesson(&mut self) {
        if !self.doc.in_lesson {
            if let Some(before) = self.before_lesson.take() {
                (self.layout.open, self.layout.settings) = before;
            }
        } else if self.before_lesson.is_none() {
            self.before_lesson = Some((self.layout.open.clone(), self.layout.settings));
        }
    }

    pub(super) fn toggle_palette(&mut self) {
        let recent = self.files.recent.sources();
        let shell = self.shell.iter().copied();
        self.palette.toggle(shell, &self.panes, recent);
    }

    pub(super) fn toggle_present(&mut self, ctx: &egui::Context) {
        match self.presenting.take() {
            Some(presenting) => presenting.end(ctx),
            None => self.presenting = Some(FullScreen::begin(ctx)),
        }
    }

    pub(super) fn toggle_bottom(&mut self) {
        self.layout.open = match self.layout.opened() {
            Some(_) => None,
            None => self
                .layout
                .strip()
                .first()
                .map(|pane| pane.entry().id.to_owned()),
        };
    }

    pub(super) fn maximize_under_pointer(&mut self) {
        match self.under_pointer {
            Some(pane) => self.maximize(pane),
            None => self.maximized = None,
        }
    }

    /// Lets a pane fill the window; a second time, brings back the others.
    pub(super) fn maximize(&mut self, pane: PaneId) {
        self.maximized = match self.maximized {
            Some(_) => None,
            None => Some(pane),
        };
    }

    pub(super) fn save_workspace(&mut self, ctx: &egui::Context) {
        let workspace = self.workspace();
        self.files.workspaces.save(workspace, ctx);
    }

    pub(super) fn save_workspace_as(&mut self) {
        let workspace = self.workspace();
        self.files.workspaces.ask(&workspace);
    }

    pub(super) fn copy_command(&mut self, ctx: &egui::Context) {
        let command = measure_command(&self.doc.wanted);
        self.clipboard.copy(command, ctx);
    }

    /// Ends what is in the way, one at a time: a message, a maximized pane, the presentation, the work in
    /// progress, the task *Ray*.
    pub(super) fn escape(&mut self, ctx: &egui::Context) {
        let message = self.palette.close()
            || std::mem::take(&mut self.help_open)
            || self.doc.failure.take().is_some()
            || self.doc.notices.close()
            || self.maximized.take().is_some();
        if message {
            return;
        }
        if self.presenting.is_some() {
            self.toggle_present(ctx);
        } else if self.doc.inspect.undo() || self.doc.cancel() {
        } else if self.layout.task.0 == "ray" {
            self.switch("explore");
        }
    }

    /// Calls a pane with the document, then applies its edits.
    pub(super) fn with_pane(
        &mut self,
        pane: PaneId,
        ctx: &egui::Context,
        call: impl FnOnce(&mut dyn AnyPane, &mut Cx<'_>),
    ) {
        let mut edits = Edits::default();
        let mut cx = Cx {
            doc: &self.doc,
            edits: &mut edits,
            ctx,
            panes: PANES,
        };
        call(self.panes[pane.place()].as_mut(), &mut cx);
        self.requests.extend(edits.apply(&mut self.doc));
    }

    /// Runs the actions of panes that keys ask for in one scope.
    pub(super) fn pane_keys(&mut self, ctx: &egui::Context, scope: Scope) {
        for pane in PaneId::all() {
            for place in keys::pressed(ctx, &self.actions[pane.place()], scope) {
                self.with_pane(pane, ctx, |pane, cx| pane.act(place, cx));
            }
        }
    }

    /// Draws a pane; keys go to it while the pointer is over it.
    pub(super) fn pane(&mut self, ui: &mut egui::Ui, pane: PaneId) {
        let rect = ui.max_rect();
        let ctx = ui.ctx().clone();
        if ctx.rect_contains_pointer(ui.layer_id(), rect) {
            self.under_pointer = Some(pane);
            for place in keys::pressed(&ctx, &self.actions[pane.place()], Scope::Here) {
                self.with_pane(pane, &ctx, |pane, cx| pane.act(place, cx));
            }
        }
        if self.doc.hides(pane.entry().reveals) {
            hidden::card(ui);
            return;
        }
        self.with_pane(pane, &ctx, |pane, cx| pane.ui(ui, cx));
    }

    /// Draws what a pane has in its title row.
    pub(super) fn controls(&mut self, ui: &mut egui::Ui, pane: PaneId) {
        if self.doc.hides(pane.entry().reveals) {
            return;
        }
        let ctx = ui.ctx().clone();
        self.with_pane(pane, &ctx, |pane, cx| pane.controls(ui, cx));
    }

    /// Draws a pane below a row with its title and controls.
    pub(super) fn pane_with_header(&mut self, ui: &mut egui::Ui, pane: PaneId) {
        let size = egui::vec2(ui.available_width(), TITLE_ROW);
        let row = egui::Layout::left_to_right(egui::Align::Center);
        ui.allocate_ui_with_layout(size, row, |ui| {
            ui.set_min_size(size);
            ui.label(theme::strong(pane.entry().title));
            let to_the_left = egui::Layout::right_to_left(egui::Align::Center);
            ui.with_layout(to_the_left, |ui| {
                let is_maximized = self.maximized.is_some();
                let (icon, verb) = match is_maximized {
                    true => (icons::MINIMIZE, "Restore"),
                    false => (icons::MAXIMIZE, "Maximize"),
                };
                if !is_maximized {
                    let close = IconButton::new(icons::CLOSE, "Close the pane");
                    if ui.add(close).clicked() {
                        self.layout.open = None;
                    }
                }
                let name = format!("{verb} {}", pane.entry().title);
                if ui.add(IconButton::new(icon, &name)).clicked() {
                    self.maximize(pane);
                }
                self.controls(ui, pane);
            });
        });
        self.pane(ui, pane);
    }

    /// Draws panes below each other; the last one scrolls.
    pub(super) fn column(&mut self, ui: &mut egui::Ui, panes: &[&str]) {
        let panes: Vec<PaneId> = panes.iter().filter_map(|id| places::pane(id)).collect();
        let Some((last, before)) = panes.split_last() else {
            return;
        };
        for pane in before {
            // A square, as pictures are; a third of the column is left for what is below.
            let size = egui::vec2(
                ui.available_width(),
                (ui.available_width() + 60.0).min(0.62 * ui.available_height()),
            );
            ui.allocate_ui(size, |ui| {
                ui.set_min_size(size);
                self.pane(ui, *pane);
            });
        }
        let pane = *last;
        if pane.entry().fills {
            self.pane(ui, pane);
            return;
        }
        egui::ScrollArea::vertical()
            .id_salt(pane.entry().id)
            .auto_shrink(false)
            .show(ui, |ui| self.pane(ui, pane));
    }

    pub(super) fn top_bar(&mut self, ui: &mut egui::Ui) {
        let mut edits = Edits::default();
        top_bar::show(ui, &mut self.doc, &mut self.files, &mut edits);
        self.requests.extend(edits.apply(&mut self.doc));
    }

    /// Says so where a scene that was opened has nothing in it.
    pub(super) fn tell_empty_scene(&mut self) {
        let Some(current) = &self.doc.current else {
            return;
        };
        let scene = &current.shown.scene;
        if scene.objects().is_empty() {
            let text = format!(
                "{} has no objects: every ray meets the background. Its load report is in the pane Scene.",
                scene.name()
            );
            self.doc.notices.say(text);
        }
    }

    /// Keeps the window within what the graphics adapter can draw: a larger one could not be shown.
    pub(super) fn limit_size(&mut self, ctx: &egui::Context) {
        let largest = ctx.input(|i| i.max_texture_side);
        if largest != self.largest {
            self.largest = largest;
            let side = largest as f32 / ctx.pixels_per_point();
            let size = egui::vec2(side, side);
            ctx.send_viewport_cmd(egui::ViewportCommand::MaxInnerSize(size));
        }
    }

    /// Takes note of theme and size, and keeps the layout if it is another; a drag counts when it
    /// is over.
    pub(super) fn keep_layout(&mut self, ctx: &egui::Context) {
        self.layout.dark = match ctx.options(|options| options.theme_preference) {
            egui::ThemePreference::Dark => Some(true),
            egui::ThemePreference::Light => Some(false),
            egui::ThemePreference::System => None,
        };
        let (busy, size) = ctx.input(|i| {
            let window = i.viewport();
            let free = window.maximized != Some(true) && window.fullscreen != Some(true);
            let size = window.inner_rect.filter(|_| free).map(|rect| rect.size());
            (i.pointer.any_down(), size)
        });
        if let Some(size) = size {
            self.layout.size = Some((size * ctx.zoom_factor()).into());
        }
        if !busy && self.kept_layout.as_ref() != Some(&self.layout) {
            self.layout_file.write(&self.layout);
            self.kept_layout = Some(self.layout.clone());
        }
    }

    /// Asks where to save the workspace, while that was asked for.
    pub(super) fn ask_where_to_save(&mut self, ctx: &egui::Context) {
        let mut workspaces = std::mem::take(&mut self.files.workspaces);
        if let Some(path) = workspaces.show(ctx, || self.workspace()) {
            self.files.recent.add(SceneSource::File(path));
        }
        self.files.workspaces = workspaces;
    }

    /// Keeps what is shown for the next start, once there is something.
    pub(super) fn keep_session(&mut self, now: f64, at_once: bool) {
        if self.doc.current.is_some() {
            let mut workspaces = std::mem::take(&mut self.files.workspaces);
            workspaces.keep(now, at_once, || self.workspace());
            self.files.workspaces = workspaces;
        }
    }
}
