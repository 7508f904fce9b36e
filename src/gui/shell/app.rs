//! Puts the window together: bars, panes of the current task, messages, and the order of a frame.

use super::actions::ACTIONS;
use super::clipboard::Clipboard;
use super::exporting::Exports;
use super::files::Files;
use super::first_start::{FirstStart, Way};
use super::kept::KeptFile;
use super::layout::{self, LAYOUT_FILE, Layout, PaneId};
use super::palette::{Command, Palette};
use super::present::{self, Presenting};
use super::progress::WorkInProgress;
use super::recent::Recent;
use super::status::StatusLine;
use super::tasks::{Task, TaskId, task};
use super::tiles::TITLE_ROW;
use super::title::Title;
use super::workspaces::Workspaces;
use super::{help, keys, top_bar};
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
use crate::scene::format::names;
use crate::setup::{Setup, measure_command};
use crate::workspace::Workspace;

/// The window.
pub struct App {
    pub(super) doc: Document,
    /// The panes, in the order of [`PANES`].
    panes: Vec<Box<dyn AnyPane>>,
    /// Their actions, likewise.
    actions: Vec<Vec<Info>>,
    pub(super) files: Files,
    pub(super) layout: Layout,
    layout_file: KeptFile,
    /// The layout as it was kept last.
    kept_layout: Option<Layout>,
    /// The pane that fills the window.
    maximized: Option<PaneId>,
    /// The pane under the pointer.
    under_pointer: Option<PaneId>,
    presenting: Option<Presenting>,
    pub(super) status: StatusLine,
    pub(super) help_open: bool,
    palette: Palette,
    exports: Exports,
    first_start: FirstStart,
    clipboard: Clipboard,
    title: Title,
    /// The largest window that the graphics adapter can draw, in pixels on a side; 0 before it is known.
    largest: usize,
    working: WorkInProgress,
    /// What panes and menus asked for in this frame.
    requests: Vec<Request>,
}

impl App {
    /// Makes the window's contents and asks for the first scene.
    pub fn new(cc: &eframe::CreationContext<'_>, start: StartOptions) -> Self {
        let ctx = &cc.egui_ctx;
        theme::install(ctx);
        let of_panes = PANES.iter().flat_map(|entry| entry.actions());
        action::register(shell_actions().chain(of_panes));
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
            panes,
            actions: PANES.iter().map(|entry| entry.actions()).collect(),
            files: Files::new(recent, workspaces),
            layout,
            layout_file,
            kept_layout: None,
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
    fn workspace(&self) -> Workspace {
        let mut workspace = self.doc.workspace();
        for pane in &self.panes {
            pane.save(&mut workspace.view);
        }
        workspace.layout = serde_json::to_value(&self.layout).ok();
        workspace
    }

    /// Shows what a workspace says. A layout that is not known leaves the panes as they are.
    fn restore(&mut self, workspace: &Workspace, ctx: &egui::Context) {
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

    pub(super) fn toggle_palette(&mut self) {
        let recent = self.files.recent.sources();
        self.palette.toggle(shell_actions(), &self.panes, recent);
    }

    pub(super) fn toggle_present(&mut self, ctx: &egui::Context) {
        match self.presenting.take() {
            Some(presenting) => presenting.end(ctx),
            None => self.presenting = Some(Presenting::begin(ctx)),
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

    /// Runs a shell action or a pane's, by its id; an action of a pane brings the pane to the front.
    fn run(&mut self, id: &str, ctx: &egui::Context) {
        if let Some(action) = ACTIONS.iter().find(|action| action.info.id == id) {
            (action.run)(self, ctx);
            return;
        }
        for pane in PaneId::all() {
            let actions = &self.actions[pane.place()];
            if let Some(place) = actions.iter().position(|info| info.id == id) {
                if actions[place].scope == Scope::Here {
                    self.layout.show(pane);
                }
                self.with_pane(pane, ctx, |pane, cx| pane.act(place, cx));
                return;
            }
        }
        debug_assert!(false, "no action is called {id}");
    }

    /// Calls a pane with the document, then applies its edits.
    fn with_pane(
        &mut self,
        pane: PaneId,
        ctx: &egui::Context,
        call: impl FnOnce(&mut dyn AnyPane, &mut Cx<'_>),
    ) {
        let mut edits = Edits::default();
        let mut cx = Cx {
            doc: &mut self.doc,
            edits: &mut edits,
            ctx,
            panes: PANES,
        };
        call(self.panes[pane.place()].as_mut(), &mut cx);
        self.requests.extend(edits.apply(&mut self.doc));
    }

    /// Does what panes and menus asked for.
    fn serve(&mut self, ctx: &egui::Context) {
        for request in std::mem::take(&mut self.requests) {
            match request {
                Request::Show(id) => {
                    if let Some(pane) = layout::pane(id) {
                        self.layout.show(pane);
                    }
                }
                Request::Task(id) => self.switch(id),
                Request::Stage(slots) => self.layout.stage(&slots),
                Request::Run(id) => self.run(id, ctx),
                Request::Export(export) => self.exports.ask(*export, &mut self.doc),
                Request::Copy(text) => self.clipboard.copy(text, ctx),
            }
            ctx.request_repaint();
        }
    }

    /// Does what was chosen in the palette.
    fn command(&mut self, command: Command, ctx: &egui::Context) {
        match command {
            Command::Do(id) => self.run(id, ctx),
            Command::Method(method) => self.doc.wanted.build.set_method(method),
            Command::Open(source) => self.files.open(source, ctx, &mut self.doc),
            Command::Show(id) => self.requests.push(Request::Show(id)),
            Command::Choose(place, choice) => {
                let pane = PaneId::all().nth(place);
                if let Some(pane) = pane {
                    self.with_pane(pane, ctx, |pane, cx| pane.choose(choice, cx));
                }
            }
        }
    }

    /// Runs the actions that keys ask for everywhere.
    fn keys(&mut self, ctx: &egui::Context) {
        if self.doc.in_lesson {
            self.pane_keys(ctx, Scope::Lesson);
        }
        let shell: Vec<Info> = shell_actions().collect();
        for place in keys::pressed(ctx, &shell, Scope::Everywhere) {
            (ACTIONS[place].run)(self, ctx);
        }
        self.pane_keys(ctx, Scope::Everywhere);
    }

    /// Runs the actions of panes that keys ask for in one scope.
    fn pane_keys(&mut self, ctx: &egui::Context, scope: Scope) {
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
        let panes: Vec<PaneId> = panes.iter().filter_map(|id| layout::pane(id)).collect();
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

    /// Draws the current task: columns, the bottom, and the tiles in what is left.
    fn task(&mut self, ui: &mut egui::Ui) {
        let window = ui.ctx().content_rect().size();
        let Task {
            left, right, below, ..
        } = self.layout.current();
        if let Some(column) = left {
            self.left_column(ui, column);
        }
        if let Some(column) = right {
            egui::Panel::right("right column")
                .exact_size(column.size(window))
                .resizable(false)
                .show(ui, |ui| self.column(ui, column.panes));
        }
        if let Some(row) = below {
            self.row_below(ui, row);
        }
        self.opened_pane(ui);
        self.tiles(ui);
    }

    pub(super) fn top_bar(&mut self, ui: &mut egui::Ui) {
        let mut edits = Edits::default();
        top_bar::show(ui, &mut self.doc, &mut self.files, &mut edits);
        self.requests.extend(edits.apply(&mut self.doc));
    }

    /// All settings, beside the panes.
    fn drawer(&mut self, ui: &mut egui::Ui) {
        if self.layout.settings
            && let Some(pane) = layout::pane("settings")
        {
            egui::Panel::right("settings")
                .exact_size(300.0)
                .resizable(false)
                .show(ui, |ui| {
                    egui::ScrollArea::vertical()
                        .auto_shrink(false)
                        .show(ui, |ui| self.pane(ui, pane));
                });
        }
    }

    /// Keeps the window within what the graphics adapter can draw: a larger one could not be shown.
    fn limit_size(&mut self, ctx: &egui::Context) {
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
    fn keep_layout(&mut self, ctx: &egui::Context) {
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
    fn ask_where_to_save(&mut self, ctx: &egui::Context) {
        let mut workspaces = std::mem::take(&mut self.files.workspaces);
        if let Some(path) = workspaces.show(ctx, || self.workspace()) {
            self.files.recent.add(SceneSource::File(path));
        }
        self.files.workspaces = workspaces;
    }

    /// Keeps what is shown for the next start, once there is something.
    fn keep_session(&mut self, now: f64, at_once: bool) {
        if self.doc.current.is_some() {
            let mut workspaces = std::mem::take(&mut self.files.workspaces);
            workspaces.keep(now, at_once, || self.workspace());
            self.files.workspaces = workspaces;
        }
    }

    /// Why something failed, until it is closed; over the panes, so that nothing moves.
    fn message(&mut self, ctx: &egui::Context) {
        let Some(failure) = &self.doc.failure else {
            return;
        };
        let kept = self.doc.current.is_some();
        let mut open = true;
        let mut close = false;
        egui::Window::new("Problem")
            .open(&mut open)
            .anchor(egui::Align2::CENTER_BOTTOM, [0.0, -40.0])
            .collapsible(false)
            .resizable(false)
            .default_width(520.0)
            .show(ctx, |ui| {
                ui.strong(&failure.what);
                ui.add(egui::Label::new(format!("Reason: {}", failure.why)).wrap());
                if kept {
                    ui.weak("Nothing else changed.");
                }
                close = ui
                    .button("Dismiss")
                    .on_hover_text("Close this message.\nShortcut: Esc")
                    .clicked();
            });
        if close || !open {
            self.doc.failure = None;
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _: &mut eframe::Frame) {
        let opened = self.doc.receive();
        // A lesson's scenes are not the user's.
        if !self.doc.in_lesson {
            for source in opened {
                self.files.recent.add(source);
            }
        }
        for pane in PaneId::all() {
            self.with_pane(pane, ctx, |pane, cx| pane.update(cx));
        }
        self.files.receive(ctx, &mut self.doc);
        if let Some((path, workspace)) = self.files.workspaces.receive(&mut self.doc, ctx) {
            self.restore(&workspace, ctx);
            self.files.recent.add(SceneSource::File(path));
        }
        self.serve(ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        keys::note_focus(&ctx);
        self.clipboard.follow(&ctx, &mut self.doc.notices);
        self.limit_size(&ctx);
        self.working.follow(&self.doc, &ctx);
        self.status.progress = self.working.text();
        let is_unsaved = self.files.workspaces.is_changed(&self.doc.all_wanted());
        self.title.follow(&self.doc, is_unsaved, &ctx);
        if let Some(current) = &self.doc.current {
            self.doc.inspect.follow(current);
        }
        self.doc.remember(ctx.input(|i| i.time));
        self.keys(&ctx);
        self.serve(&ctx);
        self.under_pointer = None;
        self.doc.restore_selection();
        self.doc.pick_interesting();
        self.doc.follow_rays(&ctx);
        let presents = self.presenting.is_some();
        if !presents {
            egui::Panel::top("top bar")
                .exact_size(present::BAR)
                .show(ui, |ui| self.top_bar(ui));
            self.strip(ui);
            self.working.line(ui, ui.available_rect_before_wrap());
        }
        if let Some(pane) = self.maximized {
            egui::CentralPanel::default().show(ui, |ui| self.pane_with_header(ui, pane));
        } else if presents {
            present::show(self, ui);
        } else {
            self.drawer(ui);
            self.task(ui);
        }
        if presents {
            present::sliding_bar(self, &ctx);
        }
        self.message(&ctx);
        if self.doc.in_lesson {
            self.first_start.dismiss();
        }
        match self.first_start.show(&ctx) {
            Some(Way::Tour) => {
                self.doc.next_lesson = crate::lesson::LESSONS.first().map(|known| known.read());
            }
            Some(Way::Ray) => {
                self.doc.wants_ray = true;
                self.switch("ray");
            }
            Some(Way::Scene) => self.files.focus_path(),
            None => {}
        }
        self.doc.notices.show(&ctx);
        self.ask_where_to_save(&ctx);
        self.exports.show(&mut self.doc, &ctx);
        help::show(&ctx, shell_actions(), &mut self.help_open);
        if let Some(command) = self.palette.show(&ctx) {
            self.command(command, &ctx);
        }
        if ctx.input(|i| !i.raw.hovered_files.is_empty()) {
            drop_hint(&ctx);
        }
        self.serve(&ctx);
        self.doc.send();
        if !self.doc.in_lesson {
            self.keep_layout(&ctx);
            self.keep_session(ctx.input(|i| i.time), false);
        }
    }

    fn on_exit(&mut self) {
        if self.doc.in_lesson {
            // What is kept is what was there before the lesson.
            self.run("lesson.open", &egui::Context::default());
            self.serve(&egui::Context::default());
        }
        self.layout_file.write(&self.layout);
        self.keep_session(0.0, true);
    }
}

fn shell_actions() -> impl Iterator<Item = Info> {
    ACTIONS.iter().map(|action| action.info)
}

/// Says that a file can be dropped here.
fn drop_hint(ctx: &egui::Context) {
    let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop hint"));
    let (painter, rect) = (ctx.layer_painter(layer), ctx.content_rect());
    painter.rect_filled(rect, 0.0, egui::Color32::from_black_alpha(160));
    painter.text(
        rect.center(),
        egui::Align2::CENTER_CENTER,
        format!("Drop the file to open it\n{} or a workspace", names()),
        egui::FontId::proportional(26.0),
        egui::Color32::WHITE,
    );
}
