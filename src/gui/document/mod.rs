//! What is wanted and what is shown. All that is shown belongs together: it is swapped as one.
//!
//! Two trees can be compared, A and B. One of them is in front: widgets and panels are about it. The
//! other waits in [`Document::other`]; the picture of the one in front is rendered first.

mod asked;
mod build_view;
mod building;
pub mod comparing;
mod history;
pub mod inspect;
mod interesting;
mod keep;
pub mod notices;
pub mod picked;
pub mod picture_job;
mod restoring;
pub mod result;
mod second;
mod selection;
mod stepping;
pub mod study;
pub mod tasks;
mod tiles;
mod tune;
pub mod tuning;
pub mod visits;
pub mod walk;

use super::start::StartOptions;
use crate::jobs::{
    Cache, End, Handle, JobStatus, News, Priority, RenderPicture, Scheduler, Stage, Standing,
    Update,
};
use crate::lesson::{Lesson, Secret};
use crate::measure::model::Region;
use crate::scene::{CameraOverride, SceneRequest, SceneSource};
use crate::setup::Setup;
use crate::structure::{MaxDepth, Method};
pub use asked::Fact;
pub use build_view::RATES;
use comparing::{Comparing, Verdict, Which};
use egui::util::undoer::Undoer;
pub use history::{Figures, History, Measured};
use inspect::Inspect;
use notices::Notices;
use restoring::Restoring;
pub use result::Current;
use std::path::Path;
use std::sync::Arc;
use tuning::Tuning;
use walk::Walking;

/// What is wanted, what is shown, and the jobs that lead from one to the other.
pub struct Document {
    /// What the widgets say, of the tree in front.
    pub wanted: Setup,
    /// How often the scene's file was to be read again.
    pub reload: u64,
    /// What was wanted before, and what was undone of it.
    history: Undoer<Wanted>,
    /// The last request about the tree in front, with its number.
    sent: Option<(u64, Setup)>,
    /// Runs all jobs of the window.
    pub jobs: Scheduler,
    /// The scenes and trees used last.
    cache: Cache,
    /// Pictures that were requested so far.
    requests: u64,
    /// The picture, tree and figures in front; `None` until the first arrive.
    pub current: Option<Current>,
    /// Which of two compared trees is in front.
    pub which: Which,
    /// The other tree of a comparison, if there is one.
    pub other: Option<Other>,
    /// The other tree of the last comparison.
    last_other: Option<Setup>,
    /// The last results of A and of B.
    histories: [History; 2],
    /// How two trees are compared.
    pub comparing: Comparing,
    /// The picture that is being rendered.
    pub work: Option<Work>,
    /// Whether the last request was stopped by the user before it was done.
    pub stopped: bool,
    /// Why the last request failed, until dismissed.
    pub failure: Option<Failure>,
    /// How the walks of rays are followed.
    pub walking: Walking,
    /// What the panes about the tree share.
    pub inspect: Inspect,
    /// The heatmap over the picture, by its place in the registry; `None` for the picture alone.
    pub heatmap: Option<usize>,
    /// A rectangle of the picture that was marked.
    pub region: Option<Region>,
    /// The pixel under the pointer, with what a heatmap says of it.
    pub hovered: Option<([u32; 2], Option<String>)>,
    /// The task on view.
    pub task: &'static str,
    /// Whether a pixel is to be picked whose rays are worth following.
    pub wants_ray: bool,
    /// A lesson that is to begin.
    pub next_lesson: Option<Lesson>,
    /// Whether a lesson is being taken.
    pub in_lesson: bool,
    /// What a lesson asks for, until the prediction is checked.
    pub asked: Secret,
    /// What the user wrote down.
    pub notes: String,
    /// Pixels marked to come back to.
    pub pinned: Vec<[u32; 2]>,
    /// What is to be selected again, until it is.
    pub restoring: Option<Restoring>,
    /// The search for the best tree.
    pub tuning: Tuning,
    /// What was done, for a moment.
    pub notices: Notices,
}

/// A picture on its way.
pub struct Work {
    handle: Handle<RenderPicture>,
    /// Number of the request.
    number: u64,
    /// Which tree it is of.
    pub which: Which,
    pub stage: Stage,
}

impl Work {
    /// Stage and progress; `None` if it has just ended.
    pub fn status(&self) -> Option<JobStatus> {
        self.handle.status()
    }
}

/// The tree of a comparison that is not in front.
pub struct Other {
    pub wanted: Setup,
    sent: Option<(u64, Setup)>,
    pub current: Option<Current>,
}

impl Other {
    /// Whether what is shown was made with other settings than are wanted.
    pub fn is_previous(&self, reload: u64) -> bool {
        self.current
            .as_ref()
            .is_some_and(|c| c.shown.setup != self.wanted || c.shown.reload != reload)
    }
}

/// What is wanted of A and, while two trees are compared, of B.
#[derive(Clone, PartialEq)]
pub struct Wanted {
    pub a: Setup,
    pub b: Option<Setup>,
}

/// A request that failed.
pub struct Failure {
    pub what: String,
    pub why: String,
}

impl Document {
    pub fn new(start: &StartOptions, jobs: Scheduler) -> Self {
        Document {
            wanted: start.setup.clone(),
            reload: 0,
            history: Undoer::default(),
            sent: None,
            jobs,
            cache: Cache::default(),
            requests: 0,
            current: None,
            which: Which::A,
            other: None,
            last_other: None,
            histories: Default::default(),
            comparing: Comparing::default(),
            work: None,
            stopped: false,
            failure: None,
            walking: Walking::default(),
            inspect: Inspect::default(),
            heatmap: None,
            region: None,
            hovered: None,
            task: "explore",
            wants_ray: false,
            next_lesson: start.lesson.clone(),
            in_lesson: false,
            asked: Secret::default(),
            notes: String::new(),
            pinned: Vec::new(),
            restoring: None,
            tuning: Tuning::default(),
            notices: Notices::default(),
        }
    }

    /// Takes note of what is wanted, once a frame; `time` is the window's, in seconds. A change that
    /// goes on, such as a drag, is one step of the history.
    pub fn remember(&mut self, time: f64) {
        let wanted = self.all_wanted();
        self.history.feed_state(time, &wanted);
    }

    /// Wants again what was wanted before the last change.
    pub fn undo(&mut self) {
        let now = self.all_wanted();
        if let Some(before) = self.history.undo(&now).cloned() {
            self.tell_change(&now, &before, "back to");
            self.want(before);
        }
    }

    /// Wants again what was undone last.
    pub fn redo(&mut self) {
        let now = self.all_wanted();
        if let Some(after) = self.history.redo(&now).cloned() {
            self.tell_change(&now, &after, "again");
            self.want(after);
        }
    }

    /// Says which setting changes, such as "Depth 15 back to 20"; nothing where B comes or goes.
    fn tell_change(&mut self, from: &Wanted, to: &Wanted, how: &str) {
        let sides = [Some((&from.a, &to.a)), from.b.as_ref().zip(to.b.as_ref())];
        let change = sides.into_iter().flatten().find_map(|(from, to)| {
            let mut settings = to.settings();
            let setting = settings.find(|s| s.value(from) != s.value(to))?;
            let (label, from, to) = (setting.label, setting.text(from), setting.text(to));
            Some(format!("{label} {from} {how} {to}"))
        });
        if let Some(change) = change {
            self.notices.say(change);
        }
    }

    /// What is wanted of both trees.
    pub fn all_wanted(&self) -> Wanted {
        let front = self.wanted.clone();
        match &self.other {
            None => Wanted { a: front, b: None },
            Some(other) => {
                let [a, b] = in_order(self.which, front, other.wanted.clone());
                Wanted { a, b: Some(b) }
            }
        }
    }

    /// Wants this; begins or ends a comparison where that takes it.
    pub fn want(&mut self, Wanted { a, b }: Wanted) {
        if self.other.is_some() != b.is_some() {
            self.show(Which::A);
            self.compare_or_not();
        }
        let (front, behind) = match self.which {
            Which::A => (Some(a), b),
            Which::B => (b, Some(a)),
        };
        self.wanted = front.unwrap_or_else(|| self.wanted.clone());
        if let (Some(other), Some(wanted)) = (&mut self.other, behind) {
            other.wanted = wanted;
        }
    }

    /// Compares with a second tree, B; or ends the comparison with the tree in front.
    pub fn compare_or_not(&mut self) {
        if let Some(other) = self.other.take() {
            self.last_other = Some(other.wanted);
            // The one in front is A from now on.
            let front = std::mem::replace(&mut self.which, Which::A);
            if front == Which::B {
                self.histories.reverse();
            }
            // Dropping what was being rendered for the other one cancels it.
            self.work = self.work.take().filter(|work| work.which == front);
            if let Some(work) = &mut self.work {
                work.which = Which::A;
            }
        } else {
            self.other = Some(Other {
                wanted: self.second_setup(),
                sent: None,
                current: None,
            });
            self.comparing = Comparing::default();
        }
    }

    /// Uses the settings of scene and picture of the tree in front for both trees.
    pub fn use_same_conditions(&mut self) {
        if let Some(other) = &mut self.other {
            other.wanted.scene = self.wanted.scene.clone();
            other.wanted.render = self.wanted.render;
        }
    }

    /// Brings one of two compared trees to the front; the picked pixel comes along.
    pub fn show(&mut self, which: Which) {
        let Some(other) = &mut self.other else {
            return;
        };
        if self.which == which {
            return;
        }
        self.which = which;
        std::mem::swap(&mut self.wanted, &mut other.wanted);
        std::mem::swap(&mut self.sent, &mut other.sent);
        std::mem::swap(&mut self.current, &mut other.current);
        let picked = other.current.as_ref().and_then(|c| c.picked_pixel());
        if let Some(current) = &mut self.current
            && current.picked_pixel() != picked
        {
            match picked {
                Some(pixel) => current.pick(pixel),
                None => current.unpick(),
            }
        }
    }

    /// The pictures of A and B, as far as they are there.
    pub fn both(&self) -> [Option<&Current>; 2] {
        let front = self.current.as_ref();
        let behind = self.other.as_ref().and_then(|other| other.current.as_ref());
        in_order(self.which, front, behind)
    }

    /// Whether A and B may be compared; `None` until both are finished.
    pub fn verdict(&self, ctx: &egui::Context) -> Option<Arc<Verdict>> {
        let front = self.current.as_ref();
        let behind = self.other.as_ref().and_then(|other| other.current.as_ref());
        self.comparing
            .verdict(in_order(self.which, front, behind), ctx)
    }

    /// Returns the last results of a tree.
    pub fn results(&self, which: Which) -> &History {
        &self.histories[which as usize]
    }

    /// Returns the figures on view of a tree; `None` before the first.
    pub fn figures(&self, which: Which) -> Option<Figures<'_>> {
        let history = self.results(which);
        let now = history.last()?;
        let wanted = match &self.other {
            Some(other) if which != self.which => &other.wanted,
            _ => &self.wanted,
        };
        let current = self.both()[which as usize];
        let answers = |current: &Current| {
            current.complete && current.number == now.number && current.shown.reload == self.reload
        };
        Some(Figures {
            now,
            before: history.previous(),
            are_current: current.is_some_and(answers) && now.setup == *wanted,
        })
    }

    /// Asks for another scene, seen by its own camera.
    pub fn open(&mut self, source: SceneSource) {
        self.wanted.scene = SceneRequest {
            source,
            cylinders: self.wanted.scene.cylinders,
        };
        self.wanted.render.camera = CameraOverride::default();
        self.failure = None;
        self.sent = None;
    }

    /// Asks for the tree of a file instead of the tree in front. The file is read again if its tree is that in
    /// front.
    pub fn open_tree(&mut self, path: &Path) {
        // Workspaces keep the path, and can be opened from any folder.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let Ok(method) = Method::named(&path.to_string_lossy()) else {
            return;
        };
        if self.wanted.build.method == method {
            self.reload();
        }
        self.wanted.build.set_method(method);
    }

    /// Reads the scene again.
    pub fn reload(&mut self) {
        self.reload += 1;
        self.sent = None;
        if let Some(other) = &mut self.other {
            other.sent = None;
        }
    }

    /// Asks once more for what is wanted, after it was stopped or failed.
    pub fn again(&mut self) {
        self.stopped = false;
        if !is_served(&self.sent, &self.current) {
            self.sent = None;
        }
        if let Some(other) = &mut self.other
            && !is_served(&other.sent, &other.current)
        {
            other.sent = None;
        }
    }

    /// Cancels the picture, the visits and all studies; what is shown stays. Returns whether there was
    /// anything to cancel.
    pub fn cancel(&mut self) -> bool {
        let mut any = self.work.take().is_some();
        self.stopped |= any;
        let cancels = |job: &JobStatus| match job.priority {
            Priority::Pane => job.standing == Standing::Running,
            Priority::Study => true,
            Priority::Idle
            | Priority::Detail
            | Priority::Now
            | Priority::Light
            | Priority::Dialog => false,
        };
        any |= self.jobs.jobs().iter().any(cancels);
        self.jobs.cancel_where(cancels);
        any
    }

    /// Whether everything that is wanted is on view, with final figures.
    pub fn is_finished(&self) -> bool {
        let done =
            |current: &Option<Current>| current.as_ref().is_some_and(|c| c.done && c.complete);
        let served = is_served(&self.sent, &self.current) && !self.is_previous();
        let other = self.other.as_ref().is_none_or(|other| {
            is_served(&other.sent, &other.current)
                && done(&other.current)
                && !other.is_previous(self.reload)
        });
        served && done(&self.current) && other && self.work.is_none()
    }

    /// Which study is running, in words: what waits for its end says so.
    pub fn measuring(&self) -> Option<&'static str> {
        let jobs = self.jobs.jobs();
        let study = jobs.iter().find(|job| job.priority == Priority::Study);
        study.map(|job| job.slot.name())
    }

    /// Whether what is shown was made with other settings than the widgets say.
    pub fn is_previous(&self) -> bool {
        self.current
            .as_ref()
            .is_some_and(|c| c.shown.setup != self.wanted || c.shown.reload != self.reload)
    }

    /// Whether the picture of a tree is about to differ from the one on view.
    pub fn picture_will_differ(&self, which: Which) -> bool {
        let (wanted, current) = match &self.other {
            Some(other) if which != self.which => (&other.wanted, &other.current),
            _ => (&self.wanted, &self.current),
        };
        let current = current.as_ref();
        current.is_some_and(|current| current.will_differ(wanted, self.reload))
    }

    /// Receives what the jobs have sent. Returns the scenes that came into view.
    pub fn receive(&mut self) -> Vec<SceneSource> {
        let mut opened = Vec::new();
        self.tuning.receive();
        let Some(work) = &mut self.work else {
            return opened;
        };
        let News { partials, end } = work.handle.receive();
        let (number, which) = (work.number, work.which);
        let in_front = which == self.which;
        let place = match &mut self.other {
            Some(other) if !in_front => &mut other.current,
            _ => &mut self.current,
        };
        for update in partials {
            match update {
                Update::Stage(stage) => work.stage = stage,
                Update::Shown(shown) => {
                    let source = &shown.setup.scene.source;
                    let known = place.as_ref().map(|c| &c.shown.setup.scene.source);
                    if in_front && known != Some(source) {
                        opened.push(source.clone());
                    }
                    let before = place.as_ref().map(|current| &current.shown.tree);
                    let is_new = before.is_none_or(|tree| !Arc::ptr_eq(tree, &shown.tree));
                    let faults = shown.tree.faults();
                    if is_new && !faults.is_empty() {
                        let file = shown.setup.build.method.name;
                        self.notices.say(format!("{file}:\n{faults}"));
                    }
                    *place = Some(Current::new(number, *shown, place.as_ref()));
                }
                update => {
                    if let Some(current) = place
                        && current.number == number
                    {
                        let was_complete = current.complete;
                        current.take(update);
                        if current.complete && !was_complete {
                            self.histories[which as usize].add(current);
                        }
                    }
                }
            }
        }
        match end {
            Some(End::Done(())) => {
                self.work = None;
                if let Some(current) = place
                    && current.number == number
                {
                    current.done = true;
                }
            }
            Some(End::Failed(why)) => self.fail(which, why),
            Some(End::Cancelled) => {
                self.work = None;
                self.stopped = true;
            }
            Some(End::Replaced) => self.work = None,
            None => {}
        }
        opened
    }

    fn fail(&mut self, which: Which, why: String) {
        let work = self.work.take();
        let loading = work.is_some_and(|work| work.stage == Stage::Loading);
        self.restoring = None;
        if which != self.which {
            let what = format!("Tree {} could not be shown", which.name());
            self.failure = Some(Failure { what, why });
            return;
        }
        let what = if loading {
            format!("{} could not be opened", self.wanted.scene.source)
        } else {
            "This could not be done".to_owned()
        };
        self.failure = Some(Failure { what, why });
        // The scene that is there stays, and so do the settings that go with it.
        if loading && let Some(current) = &self.current {
            let before = &current.shown.setup;
            self.wanted.scene = before.scene.clone();
            self.wanted.render.camera = before.render.camera;
            self.reload = current.shown.reload;
            if current.done && *before == self.wanted {
                self.sent = Some((current.number, before.clone()));
            }
        }
    }

    /// Sends what is wanted if it is news; of the tree behind once the one in front is there. A
    /// camera move waits until the last request has a picture, else moving the camera would starve it.
    pub fn send(&mut self) {
        self.share();
        let is_sent = |sent: &Option<(u64, Setup)>, wanted: &Setup| {
            sent.as_ref().is_some_and(|(_, sent)| sent == wanted)
        };
        if !is_sent(&self.sent, &self.wanted) {
            if let Some((number, last)) = &self.sent {
                let has_picture = self.current.as_ref().is_some_and(|c| c.number == *number);
                let work = self.work.as_ref();
                let in_work = work.is_some_and(|work| work.which == self.which);
                if in_work && !has_picture && same_but_camera(last, &self.wanted) {
                    return;
                }
            }
            // What was begun for the tree behind is broken off.
            if let Some(other) = &mut self.other
                && !is_served(&other.sent, &other.current)
            {
                other.sent = None;
            }
            self.sent = Some((
                self.ask(self.which, self.wanted.clone()),
                self.wanted.clone(),
            ));
        } else if let Some(other) = &self.other
            && self.work.is_none()
            && !self.stopped
            && !is_sent(&other.sent, &other.wanted)
        {
            let wanted = other.wanted.clone();
            let number = self.ask(self.which.other(), wanted.clone());
            if let Some(other) = &mut self.other {
                other.sent = Some((number, wanted));
            }
        }
    }

    /// Both trees are of the same scene, seen by the same camera.
    fn share(&mut self) {
        if let Some(other) = &mut self.other {
            other.wanted.scene.source = self.wanted.scene.source.clone();
            other.wanted.render.camera = self.wanted.render.camera;
        }
    }

    fn ask(&mut self, which: Which, wanted: Setup) -> u64 {
        self.requests += 1;
        self.stopped = false;
        self.failure = self.failure.take().filter(|_| self.current.is_some());
        let job = RenderPicture {
            setup: wanted,
            reload: self.reload,
            cache: self.cache.clone(),
        };
        self.work = Some(Work {
            handle: self.jobs.start(job),
            number: self.requests,
            which,
            stage: Stage::Previewing,
        });
        self.requests
    }
}

/// What is in front and behind, as A and B.
fn in_order<T>(in_front: Which, front: T, behind: T) -> [T; 2] {
    match in_front {
        Which::A => [front, behind],
        Which::B => [behind, front],
    }
}

/// Whether the last request was answered in full.
fn is_served(sent: &Option<(u64, Setup)>, current: &Option<Current>) -> bool {
    match (sent, current) {
        (Some((number, _)), Some(current)) => current.done && current.number == *number,
        _ => false,
    }
}

fn same_but_camera(a: &Setup, b: &Setup) -> bool {
    let mut a = a.clone();
    a.render.camera = b.render.camera;
    a == *b
}

impl Document {
    /// Selects a node of the tree on view.
    pub fn select_node(&mut self, node: Option<u32>) {
        if let Some(current) = &mut self.current {
            current.selection.node = node;
        }
    }

    /// Picks a pixel of the picture in front.
    pub fn pick(&mut self, pixel: [u32; 2]) {
        if let Some(current) = &mut self.current {
            current.pick(pixel);
        }
    }

    /// Clears the picked pixel.
    pub fn unpick(&mut self) {
        if let Some(current) = &mut self.current {
            current.unpick();
        }
    }
}

impl Document {
    /// Switches between an automatic depth and the number it resolves to.
    pub fn toggle_automatic_depth(&mut self) {
        let resolved = self.depth_limit();
        let d_max = &mut self.wanted.build.d_max;
        *d_max = match d_max {
            MaxDepth::Automatic => MaxDepth::Fixed(resolved),
            MaxDepth::Fixed(_) => MaxDepth::Automatic,
        };
    }

    /// Makes the tree deeper by some levels, or shallower.
    pub fn deepen(&mut self, by: i32) {
        let depth = match self.wanted.build.d_max {
            MaxDepth::Fixed(depth) => depth,
            MaxDepth::Automatic => self.depth_limit(),
        };
        let depth = depth.saturating_add_signed(by).min(MaxDepth::LIMIT);
        self.wanted.build.d_max = MaxDepth::Fixed(depth);
    }

    /// The greatest depth of the tree on view; 20 before there is one.
    fn depth_limit(&self) -> u32 {
        self.current
            .as_ref()
            .map_or(20, |c| c.shown.tree.depth_limit())
    }

    /// Selects the next build method.
    pub fn next_method(&mut self) {
        let build = &mut self.wanted.build;
        let all: Vec<Method> = Method::all().collect();
        let at = all.iter().position(|m| *m == build.method).unwrap_or(0);
        build.set_method(all[(at + 1) % all.len()]);
    }
}
