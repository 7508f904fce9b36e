//! What is wanted and what is shown. All that is shown belongs together: it is swapped as one.

use super::StartOptions;
use super::inspect::Inspect;
use super::judging::Judging;
use super::selection::Selection;
use super::walk::{Picked, Walking, Wish};
use crate::measure::heat::PixelCounts;
use crate::progress::Progress;
use crate::scene::{SceneRequest, SceneSource};
use crate::trace::Tile;
use crate::worker::{Request, Shown, Stage, Update, Worker};
use egui::util::undoer::Undoer;
use std::sync::Arc;

/// The window's side of the worker.
pub struct State {
    /// What the widgets say.
    pub wanted: Request,
    /// What was wanted before, and what was undone of it.
    history: Undoer<Request>,
    /// The last request with its number.
    sent: Option<(u64, Request)>,
    worker: Worker,
    /// The picture, tree and figures on view; `None` until the first arrive.
    pub current: Option<Current>,
    /// What the worker does now.
    pub work: Option<(Stage, Progress)>,
    /// Whether the last request was stopped by the user before it was done.
    pub stopped: bool,
    /// Why the last request failed, until dismissed.
    pub failure: Option<Failure>,
    /// How the walks of rays are followed.
    pub walking: Walking,
    /// What the panes about the tree share.
    pub inspect: Inspect,
    /// What the judge has found of what is shown.
    pub judging: Judging,
}

/// A request that failed.
pub struct Failure {
    pub what: String,
    pub why: String,
}

/// A picture with everything that belongs to it.
pub struct Current {
    /// Number of the request that it answers; no other picture has it.
    pub number: u64,
    pub shown: Shown,
    /// Whether the figures are final.
    pub complete: bool,
    /// Whether nothing more will come.
    pub done: bool,
    /// Number of the newest sample in the picture.
    pub sample: u32,
    /// The parts of the picture that the screen does not have yet.
    pub fresh: Fresh,
    /// The pixel whose rays are to be followed, until they are.
    pub wish: Option<Wish>,
    pub picked: Option<Picked>,
    pub selection: Selection,
    /// What every pixel's rays did, once they were counted.
    pub pixel_counts: Option<Arc<PixelCounts>>,
}

/// Parts of a picture.
pub enum Fresh {
    All,
    Tiles(Vec<Tile>),
}

impl Current {
    fn new(number: u64, shown: Shown, wish: Option<Wish>) -> Self {
        Current {
            number,
            shown,
            complete: false,
            done: false,
            sample: 0,
            fresh: Fresh::All,
            wish,
            picked: None,
            selection: Selection::default(),
            pixel_counts: None,
        }
    }

    /// The settings of what is shown, in one line.
    pub fn settings_text(&self) -> String {
        let Shown {
            scene,
            measurement: m,
            ..
        } = &self.shown;
        format!(
            "{} · {} · D_MAX {} · N_OILF {} · D_AREC {} · {} × {} pixels",
            scene.name(),
            m.build.method.name,
            m.depth_in_words(),
            m.build.n_oilf,
            m.render.d_arec,
            m.render.width,
            m.render.height,
        )
    }
}

impl State {
    pub fn new(start: &StartOptions, ctx: &egui::Context) -> Self {
        let ctx = ctx.clone();
        State {
            wanted: Request {
                scene: start.scene.clone(),
                build: start.build.clone(),
                render: start.render,
                own_camera: start.own_camera,
                reload: 0,
            },
            history: Undoer::default(),
            sent: None,
            worker: Worker::start(move || ctx.request_repaint()),
            current: None,
            work: None,
            stopped: false,
            failure: None,
            walking: Walking::default(),
            inspect: Inspect::default(),
            judging: Judging::default(),
        }
    }

    /// Takes note of what is wanted, once a frame; `time` is the window's, in seconds. A change that
    /// goes on, such as a drag, is one step of the history.
    pub fn remember(&mut self, time: f64) {
        self.history.feed_state(time, &self.wanted);
    }

    /// Wants again what was wanted before the last change.
    pub fn undo(&mut self) {
        if let Some(before) = self.history.undo(&self.wanted) {
            self.wanted = before.clone();
        }
    }

    /// Wants again what was undone last.
    pub fn redo(&mut self) {
        if let Some(after) = self.history.redo(&self.wanted) {
            self.wanted = after.clone();
        }
    }

    /// Asks for another scene, seen by its own camera.
    pub fn open(&mut self, source: SceneSource) {
        self.wanted.scene = SceneRequest {
            source,
            cylinders: self.wanted.scene.cylinders,
        };
        self.wanted.own_camera = false;
        self.failure = None;
        self.again();
    }

    /// Reads the scene again.
    pub fn reload(&mut self) {
        self.wanted.reload += 1;
    }

    /// Asks once more for what is wanted, after it was stopped or failed.
    pub fn again(&mut self) {
        self.sent = None;
    }

    /// Stops what the worker does; what is shown stays.
    pub fn cancel(&mut self) {
        if self.work.take().is_some() {
            self.worker.cancel();
            self.stopped = true;
        }
    }

    /// Whether what is shown was made with other settings than the widgets say.
    pub fn is_previous(&self) -> bool {
        self.current
            .as_ref()
            .is_some_and(|current| current.shown.request != self.wanted)
    }

    /// Whether what is shown differs from what is wanted in the camera alone.
    pub fn only_camera_differs(&self) -> bool {
        self.current
            .as_ref()
            .is_some_and(|current| same_but_camera(&current.shown.request, &self.wanted))
    }

    /// Takes the worker's news; gives the scenes that came into view.
    pub fn receive(&mut self) -> Vec<SceneSource> {
        let mut opened = Vec::new();
        let updates: Vec<_> = self.worker.updates().collect();
        for news in updates {
            let is_last = self.sent.as_ref().is_some_and(|(n, _)| *n == news.request);
            match news.update {
                Update::Stage(stage, progress) => {
                    if is_last && !self.stopped {
                        self.work = Some((stage, progress));
                    }
                }
                Update::Shown(shown) => {
                    let source = &shown.request.scene.source;
                    let known = self.current.as_ref().map(|c| &c.shown.request.scene.source);
                    if known != Some(source) {
                        opened.push(source.clone());
                    }
                    let wish = self.kept_pixel(&shown);
                    let selection = self.kept_selection(&shown);
                    let mut current = Current::new(news.request, *shown, wish);
                    current.selection = selection.unwrap_or(current.selection);
                    self.current = Some(current);
                }
                update => {
                    if let Update::Failed(reason) = &update
                        && is_last
                    {
                        self.fail(reason.clone());
                        continue;
                    }
                    if is_last && matches!(update, Update::Done) {
                        self.work = None;
                    }
                    if let Some(current) = &mut self.current
                        && current.number == news.request
                    {
                        current.take(update);
                    }
                }
            }
        }
        opened
    }

    /// A picked pixel stays picked in a new picture of the same scene and size, and so does its ray.
    fn kept_pixel(&self, shown: &Shown) -> Option<Wish> {
        let before = self.current.as_ref()?;
        let same = Arc::ptr_eq(&before.shown.scene, &shown.scene)
            && before.shown.picture.width == shown.picture.width
            && before.shown.picture.height == shown.picture.height;
        let picked = before.picked.as_ref().map(|picked| Wish {
            pixel: picked.pixel,
            ray: picked.ray,
        });
        before.wish.or(picked).filter(|_| same)
    }

    /// What is selected stays so in another picture of the same tree.
    fn kept_selection(&self, shown: &Shown) -> Option<Selection> {
        let before = self.current.as_ref()?;
        Arc::ptr_eq(&before.shown.tree, &shown.tree).then_some(before.selection)
    }

    fn fail(&mut self, why: String) {
        let loading = matches!(self.work, Some((Stage::Loading, _)));
        self.work = None;
        let what = if loading {
            format!("{} could not be opened", self.wanted.scene.source)
        } else {
            "This could not be done".to_owned()
        };
        self.failure = Some(Failure { what, why });
        // The scene that is there stays, and so do the settings that go with it.
        if loading && let Some(current) = &self.current {
            let before = &current.shown.request;
            self.wanted.scene = before.scene.clone();
            self.wanted.reload = before.reload;
            self.wanted.own_camera = before.own_camera;
            if current.done && *before == self.wanted {
                self.sent = Some((current.number, before.clone()));
            }
        }
    }

    /// Sends what is wanted if it is news. A camera move waits until the last request has a
    /// picture, else moving the camera would starve it.
    pub fn send(&mut self) {
        if let Some((number, last)) = &self.sent {
            if *last == self.wanted {
                return;
            }
            let has_picture = self.current.as_ref().is_some_and(|c| c.number == *number);
            if self.work.is_some() && !has_picture && same_but_camera(last, &self.wanted) {
                return;
            }
        }
        let number = self.worker.request(self.wanted.clone());
        self.sent = Some((number, self.wanted.clone()));
        self.stopped = false;
        self.failure = self.failure.take().filter(|_| self.current.is_some());
        self.work = Some((Stage::Previewing, Progress::new()));
    }
}

impl Current {
    fn take(&mut self, update: Update) {
        match update {
            Update::Tile {
                tile,
                sample,
                colors,
            } => {
                self.shown.picture.add_tile(&tile, sample, &colors);
                self.sample = self.sample.max(sample);
                if let Fresh::Tiles(tiles) = &mut self.fresh {
                    tiles.push(tile);
                }
            }
            Update::Measured {
                measurement,
                complete,
            } => {
                self.shown.measurement = *measurement;
                self.complete = complete;
            }
            Update::PixelCounts(counts) => self.pixel_counts = Some(counts),
            Update::Done => self.done = true,
            Update::Stage(..) | Update::Shown(_) | Update::Failed(_) => {}
        }
    }
}

fn same_but_camera(a: &Request, b: &Request) -> bool {
    let mut a = a.clone();
    a.render.camera = b.render.camera;
    a.own_camera = b.own_camera;
    a == *b
}
