//! Puts the window together: bars, panels and panes, and what the window's own keys do.

use super::exporting::{Export, Exports, Shown};
use super::files::Files;
use super::first_hint::{Chosen, FirstHint};
use super::kept::KeptFile;
use super::layout::{self, Layout, Pane};
use super::lessons::{Around, Lessons};
use super::notices::Notices;
use super::palette::{Command, Palette};
use super::panels::{self, Side};
use super::picture_pane::PicturePane;
use super::recent::Recent;
use super::shortcuts::{self, Action, Scope, pressed};
use super::state::State;
use super::status::StatusLine;
use super::tree_panes::TreePanes;
use super::view3d::View3d;
use super::walk::Go;
use super::workspaces::Workspaces;
use super::{StartOptions, build_bar, help, keep, tasks, top_bar, walk_bar};
use crate::present::overlay::COLORINGS;
use crate::scene::format::names;
use crate::scene::{CameraOverride, SceneSource};
use crate::structure::{BuildSettings, MaxDepth, Method};
use crate::workspace::{Arrangement, Workspace};

/// The window.
pub struct App {
    state: State,
    files: Files,
    panes: Panes,
    layout: Layout,
    /// The title of a panel to be brought into view.
    sought: Option<&'static str>,
    /// Whether no layout was kept: it is made when the width of the window is known.
    layout_is_new: bool,
    layout_file: KeptFile,
    /// The layout as it was kept last.
    kept_layout: Option<Layout>,
    status: StatusLine,
    help_open: bool,
    palette: Palette,
    exports: Exports,
    lessons: Lessons,
    first_hint: FirstHint,
}

struct Panes {
    picture: PicturePane,
    view3d: View3d,
    tree: TreePanes,
}

impl App {
    /// Makes the window's contents and asks for the first scene.
    pub fn new(cc: &eframe::CreationContext<'_>, start: StartOptions) -> Self {
        super::theme::install(&cc.egui_ctx);
        let recent = Recent::kept(KeptFile::new(&start, "recent.json"));
        let mut notices = Notices::default();
        let jobs = tasks::scheduler(&cc.egui_ctx);
        let (workspaces, workspace) = Workspaces::new(&start, &cc.egui_ctx, &mut notices);
        let layout_file = KeptFile::new(&start, layout::FILE);
        let layout: Option<Layout> = layout_file.read();
        if let Some(dark) = layout.as_ref().and_then(|layout| layout.dark) {
            top_bar::set_theme(&cc.egui_ctx, dark);
        }
        let mut start = start;
        // The screen takes no larger picture.
        let largest = cc.egui_ctx.input(|i| i.max_texture_side) as u32;
        let render = &mut start.setup.render;
        render.width = render.width.min(largest);
        render.height = render.height.min(largest);
        let first_hint = FirstHint::new(&start);
        let mut app = App {
            state: State::new(&start, jobs),
            files: Files::new(recent, workspaces),
            panes: Panes {
                picture: PicturePane::default(),
                view3d: View3d::new(cc.wgpu_render_state.as_ref()),
                tree: TreePanes::default(),
            },
            layout_is_new: layout.is_none(),
            layout: layout.unwrap_or_default(),
            layout_file,
            kept_layout: None,
            status: StatusLine::default(),
            help_open: false,
            palette: Palette::default(),
            exports: Exports::default(),
            sought: None,
            lessons: Lessons::new(start.lesson.take()),
            first_hint,
        };
        app.state.notices = notices;
        if let Some(workspace) = workspace {
            app.restore(&workspace, &cc.egui_ctx);
        }
        app
    }

    /// All that is shown, as a workspace.
    fn workspace(&self) -> Workspace {
        let mut workspace = self.state.workspace();
        workspace.view.picture = self.panes.picture.kept_place();
        workspace.view.heatmap = self.panes.picture.heat.kept();
        workspace.view.view3d = self.panes.view3d.kept();
        workspace.layout = serde_json::to_value(&self.layout).ok();
        workspace
    }

    /// Shows what a workspace says. A layout that is not known leaves panes and bars as they are.
    fn restore(&mut self, workspace: &Workspace, ctx: &egui::Context) {
        let largest = ctx.input(|i| i.max_texture_side) as u32;
        self.state.restore(workspace, largest);
        let view = &workspace.view;
        let differences = workspace.b.is_some() && view.arrangement == Arrangement::Difference;
        self.panes.picture.heat.restore(&view.heatmap, differences);
        self.panes.picture.restore_place(&view.picture);
        self.panes.view3d.restore(&view.view3d);
        let layout = workspace.layout.clone();
        if let Some(layout) = layout.and_then(|value| serde_json::from_value(value).ok()) {
            self.layout = layout;
            self.layout_is_new = false;
            if let Some(dark) = self.layout.dark {
                top_bar::set_theme(ctx, dark);
            }
        }
    }

    fn act(&mut self, action: Action, ctx: &egui::Context) {
        let state = &mut self.state;
        let build = &mut state.wanted.build;
        let by = |value: u32, by: i32, most: u32| value.saturating_add_signed(by).min(most);
        match action {
            Action::Help => self.help_open ^= true,
            Action::Palette => self.palette.toggle(self.files.recent.sources()),
            Action::Open => self.files.open_dialog(ctx),
            Action::SaveWorkspace => {
                let workspace = self.workspace();
                self.files.workspaces.save(workspace, ctx);
            }
            Action::SaveWorkspaceAs => {
                let workspace = self.workspace();
                self.files.workspaces.ask(&workspace);
            }
            Action::CopyCommand => {
                let command = keep::command(state);
                state.notices.say(format!("Copied: {command}"));
                ctx.copy_text(command);
            }
            Action::Path => self.files.focus_path(),
            Action::Reload => state.reload(),
            Action::Cancel => {
                let message = self.palette.close()
                    || std::mem::take(&mut self.help_open)
                    || self.first_hint.dismiss()
                    || state.failure.take().is_some()
                    || state.notices.close();
                if !message && !state.inspect.undo() {
                    state.cancel();
                }
            }
            Action::Again => state.again(),
            Action::NextMethod => {
                let all: Vec<Method> = Method::all().collect();
                let at = all.iter().position(|m| *m == build.method).unwrap_or(0);
                build.set_method(all[(at + 1) % all.len()]);
            }
            Action::Deeper | Action::Shallower => {
                let step = if action == Action::Deeper { 1 } else { -1 };
                let depth = match build.d_max {
                    MaxDepth::Fixed(depth) => depth,
                    MaxDepth::Automatic => state
                        .current
                        .as_ref()
                        .map_or(20, |c| c.shown.tree.depth_limit()),
                };
                build.d_max = MaxDepth::Fixed(by(depth, step, MaxDepth::LIMIT));
            }
            Action::AutoDepth => top_bar::toggle_automatic(state),
            Action::MoreInLeaf => build.n_oilf = by(build.n_oilf, 1, 10_000),
            Action::FewerInLeaf => build.n_oilf = by(build.n_oilf, -1, 10_000),
            Action::MoreRecursion | Action::LessRecursion => {
                let step = if action == Action::MoreRecursion {
                    1
                } else {
                    -1
                };
                let d_arec = &mut state.wanted.render.d_arec;
                *d_arec = by(*d_arec, step, top_bar::MOST_RECURSION);
            }
            Action::ResetMethod => *build = BuildSettings::for_method(build.method),
            Action::Undo => state.undo(),
            Action::Redo => state.redo(),
            Action::Compare => state.compare_or_not(),
            Action::OtherTree => state.show(state.which.other()),
            Action::Paper => {
                let threads = state.wanted.render.threads;
                state.experiment.start_or_cancel(threads, &state.jobs);
                self.seek(&panels::paper::PANEL);
            }
            Action::Lessons | Action::LessonReveal | Action::LessonNext | Action::LessonBack => {
                let (lessons, mut around) = self.lessons();
                lessons.act(action, &mut around);
            }
            Action::Theme => top_bar::toggle_theme(ctx),
            Action::LeftBar => self.layout.left.shown ^= true,
            Action::RightBar => self.layout.right.shown ^= true,
            Action::ResetLayout => self.layout.reset(ctx),
            Action::FirstStep => state.go(Go::First),
            Action::PreviousStep => state.go(Go::Previous),
            Action::NextStep => state.go(Go::Next),
            Action::LastStep => state.go(Go::Last),
            Action::Play => state.play_or_pause(ctx.input(|i| i.time)),
            Action::LeavesOnly => state.set_leaves_only(!state.walking.leaves_only),
            Action::PreviousRay => state.next_ray(-1),
            Action::NextRay => state.next_ray(1),
            Action::SceneCamera => state.wanted.render.camera = CameraOverride::default(),
            action => match Export::of(action) {
                Some(export) => self.export(|exports, shown| exports.ask(export, shown, ctx)),
                None => build_bar::act(action, state, ctx.input(|i| i.time)),
            },
        }
    }

    /// Unfolds a panel and brings it into view.
    fn seek(&mut self, panel: &panels::Panel) {
        let bar = match panel.side {
            Side::Left => &mut self.layout.left,
            Side::Right => &mut self.layout.right,
        };
        bar.shown = true;
        self.layout.unfolded.insert(panel.title.to_owned(), true);
        self.sought = Some(panel.title);
    }

    /// The lessons, and what they set and bring back.
    fn lessons(&mut self) -> (&mut Lessons, Around<'_>) {
        let around = Around {
            state: &mut self.state,
            layout: &mut self.layout,
            heat: &mut self.panes.picture.heat,
        };
        (&mut self.lessons, around)
    }

    /// Does what was chosen in the palette; what belongs to a pane brings it to the front.
    fn run(&mut self, command: Command, ctx: &egui::Context) {
        match command {
            Command::Do(action) => {
                if let Some(pane) = shortcuts::scope(action).and_then(Pane::of) {
                    self.layout.show(pane);
                }
                shortcuts::choose(ctx, action);
            }
            Command::Method(method) => {
                self.state.wanted.build.set_method(method);
            }
            Command::Open(source) => self.files.open(source, ctx, &mut self.state),
            Command::Heatmap(heatmap) => {
                self.layout.show(Pane::Picture);
                self.panes.picture.heat.show(heatmap);
            }
            Command::Color(place) => {
                self.layout.show(Pane::View3d);
                self.panes.view3d.color_by(&COLORINGS[place]);
            }
            Command::Lesson(place) => self.lessons.take(place),
        }
    }

    /// The panels of one side; the bar can be folded away and resized.
    fn side_bar(&mut self, ui: &mut egui::Ui, side: Side) {
        let Layout {
            left,
            right,
            unfolded,
            ..
        } = &mut self.layout;
        let (panel, bar, widths) = match side {
            Side::Left => (egui::Panel::left("left"), left, 180.0..=480.0),
            Side::Right => (egui::Panel::right("right"), right, 220.0..=640.0),
        };
        let (state, sought) = (&mut self.state, &mut self.sought);
        let hidden = side == Side::Right && self.lessons.hides_figures();
        let shown = panel
            .default_size(bar.width)
            .size_range(widths)
            .show_collapsible(ui, &mut bar.shown, |ui| {
                if hidden {
                    // The bar keeps its width.
                    ui.set_width(ui.available_width());
                    ui.weak(HIDDEN);
                } else {
                    panels::show(ui, side, state, unfolded, sought);
                }
            });
        if let Some(shown) = shown {
            bar.width = shown.response.rect.width();
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

    /// Does something about exports, with what they are made of.
    fn export(&mut self, act: impl FnOnce(&mut Exports, &mut Shown<'_>)) {
        let mut shown = Shown {
            state: &mut self.state,
            heat: &self.panes.picture.heat,
            view3d: &self.panes.view3d,
        };
        act(&mut self.exports, &mut shown);
    }

    /// Asks where to save the workspace, while that was asked for.
    fn save_workspace_as(&mut self, ctx: &egui::Context) {
        let mut workspaces = std::mem::take(&mut self.files.workspaces);
        if let Some(path) = workspaces.show(ctx, || self.workspace()) {
            self.files.recent.add(SceneSource::File(path));
        }
        self.files.workspaces = workspaces;
    }

    /// Keeps what is shown for the next start, once there is something.
    fn keep_session(&mut self, now: f64, at_once: bool) {
        if self.state.current.is_some() {
            let mut workspaces = std::mem::take(&mut self.files.workspaces);
            workspaces.keep(now, at_once, || self.workspace());
            self.files.workspaces = workspaces;
        }
    }

    /// Why something failed, until it is closed; over the panes, so that nothing moves.
    fn message(&mut self, ctx: &egui::Context) {
        let Some(failure) = &self.state.failure else {
            return;
        };
        let kept = self.state.current.is_some();
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
                    ui.weak("What was there stays.");
                }
                close = ui
                    .button("Dismiss")
                    .on_hover_text("Close this message.\nShortcut: Esc")
                    .clicked();
            });
        if close || !open {
            self.state.failure = None;
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _: &mut eframe::Frame) {
        let opened = self.state.receive();
        // A lesson's scenes are not the user's.
        if !self.lessons.is_on() {
            for source in opened {
                self.files.recent.add(source);
            }
        }
        self.lessons.take_dropped(ctx);
        self.files.receive(ctx, &mut self.state);
        if let Some((path, workspace)) = self.files.workspaces.receive(&mut self.state, ctx) {
            self.restore(&workspace, ctx);
            self.files.recent.add(SceneSource::File(path));
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        shortcuts::note_focus(&ctx);
        if let Some(current) = &self.state.current {
            self.state.inspect.follow(current);
        }
        if std::mem::take(&mut self.layout_is_new) {
            self.layout.reset(&ctx);
        }
        self.state.remember(ctx.input(|i| i.time));
        for action in pressed(&ctx, Scope::Window, true) {
            self.act(action, &ctx);
        }
        self.state.restore_selection();
        self.state.follow_rays(&ctx);
        self.state.judge_rays();
        egui::Panel::top("top bar").show(ui, |ui| {
            top_bar::show(ui, &mut self.state, &mut self.files, &mut self.help_open);
        });
        egui::Panel::bottom("status line").show(ui, |ui| {
            let picture = &self.panes.picture;
            let value = picture.hovered.and_then(|p| picture.heat.value_text(p));
            self.status.ui(ui, &self.state, picture.hovered, value);
        });
        egui::Panel::bottom("walk bar").show(ui, |ui| walk_bar::show(ui, &mut self.state));
        build_bar::show(ui, &mut self.state);
        let (lessons, mut around) = self.lessons();
        lessons.show(ui, &mut around);
        // Both at once would leave too little room for the picture.
        if !self.lessons.is_listed() {
            self.side_bar(ui, Side::Left);
        }
        self.side_bar(ui, Side::Right);
        egui::CentralPanel::default()
            .frame(egui::Frame::new().fill(ui.visuals().panel_fill))
            .show(ui, |ui| {
                let mut behavior = Behavior {
                    panes: &mut self.panes,
                    state: &mut self.state,
                    hides_figures: self.lessons.hides_figures(),
                };
                self.layout.tiles.ui(&mut behavior, ui);
            });
        self.message(&ctx);
        if self.lessons.is_on() {
            self.first_hint.dismiss();
        }
        if self.first_hint.show(&ctx) == Some(Chosen::FirstLesson) {
            self.lessons.take(0);
        }
        self.state.notices.show(&ctx);
        self.save_workspace_as(&ctx);
        self.export(|exports, shown| exports.show(shown, &ctx));
        help::show(&ctx, &mut self.help_open);
        if let Some(command) = self.palette.show(&ctx) {
            self.run(command, &ctx);
        }
        if ctx.input(|i| !i.raw.hovered_files.is_empty()) {
            drop_hint(&ctx);
        }
        self.state.send();
        if !self.lessons.is_on() {
            self.keep_layout(&ctx);
            self.keep_session(ctx.input(|i| i.time), false);
        }
    }

    fn on_exit(&mut self) {
        let (lessons, mut around) = self.lessons();
        lessons.leave(&mut around);
        self.layout_file.write(&self.layout);
        self.keep_session(0.0, true);
    }
}

/// What stands in the place of figures while a lesson waits for a prediction.
const HIDDEN: &str = "Hidden until you have made your prediction.";

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

/// How tiles show the panes.
struct Behavior<'a> {
    panes: &'a mut Panes,
    state: &'a mut State,
    /// Whether a lesson waits for a prediction.
    hides_figures: bool,
}

impl egui_tiles::Behavior<Pane> for Behavior<'_> {
    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.title().into()
    }

    fn pane_ui(
        &mut self,
        ui: &mut egui::Ui,
        _: egui_tiles::TileId,
        pane: &mut Pane,
    ) -> egui_tiles::UiResponse {
        let margin = egui::Margin::same(4);
        egui::Frame::new()
            .inner_margin(margin)
            .show(ui, |ui| match pane {
                Pane::Picture => self.panes.picture.ui(ui, self.state),
                Pane::View3d => self.panes.view3d.ui(ui, self.state),
                Pane::Tree(_) if self.hides_figures => {
                    ui.weak(HIDDEN);
                }
                Pane::Tree(pane) => self.panes.tree.ui(*pane, ui, self.state),
            });
        egui_tiles::UiResponse::None
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        layout::simplification()
    }
}
