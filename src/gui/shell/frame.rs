//! One frame of the window: keys, bars, the panes of the current task, messages, and what was asked for.

use super::actions::ACTIONS;
use super::app::App;
use super::first_start::Way;
use super::palette::Command;
use super::places::{self, PaneId, TOP_BAR};
use super::tasks::Task;
use super::{help, keys, present};
use crate::gui::StartOptions;
use crate::gui::action::Scope;
use crate::gui::edits::Request;
use crate::scene::SceneSource;
use crate::scene::format::names;

/// The width of the settings, in points.
const DRAWER: f32 = 280.0;

impl App {
    /// Makes the window's contents and asks for the first scene.
    pub fn new(cc: &eframe::CreationContext<'_>, start: StartOptions) -> Self {
        let shell = ACTIONS.iter().map(|action| action.info).collect();
        App::with_actions(cc, start, shell)
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

    /// Does what panes and menus asked for.
    fn serve(&mut self, ctx: &egui::Context) {
        for request in std::mem::take(&mut self.requests) {
            match request {
                Request::Show(id) => {
                    if let Some(pane) = places::pane(id) {
                        self.layout.show(pane);
                    }
                }
                Request::Task(id) => self.switch(id),
                Request::Stage(slots) => self.layout.stage(&slots),
                Request::Run(id) => self.run(id, ctx),
                Request::Export(export) => self.exports.ask(export, &mut self.doc),
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
        for place in keys::pressed(ctx, &self.shell, Scope::Everywhere) {
            (ACTIONS[place].run)(self, ctx);
        }
        self.pane_keys(ctx, Scope::Everywhere);
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

    /// Shows all settings beside the panes.
    fn drawer(&mut self, ui: &mut egui::Ui) {
        if self.layout.settings
            && let Some(pane) = places::pane("settings")
        {
            egui::Panel::right("settings")
                .exact_size(DRAWER)
                .resizable(false)
                .show(ui, |ui| {
                    egui::ScrollArea::vertical()
                        .auto_shrink(false)
                        .show(ui, |ui| self.pane(ui, pane));
                });
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
        if !opened.is_empty() {
            self.tell_empty_scene();
        }
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
        self.follow_lesson();
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
                .exact_size(TOP_BAR)
                .show(ui, |ui| self.top_bar(ui));
            self.strip(ui);
            self.working.line(ui, ui.available_rect_before_wrap());
        }
        if let Some(pane) = self.maximized {
            let frame = egui::Frame::new().fill(ui.visuals().panel_fill);
            egui::CentralPanel::default()
                .frame(frame)
                .show(ui, |ui| self.pane_with_header(ui, pane));
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
        help::show(&ctx, self.shell.iter().copied(), &mut self.help_open);
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
            self.follow_lesson();
        }
        self.layout_file.write(&self.layout);
        self.keep_session(0.0, true);
    }
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
