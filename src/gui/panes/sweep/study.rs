//! A sweep of the scene on view in the background, point by point: the rows of `bspscope sweep`. A sweep
//! that was cancelled is resumed after its last row.

use crate::gui::document::Document;
use crate::gui::document::study::Study;
use crate::jobs::{End, Export, Handle, Scheduler, Sweep};
use crate::measure::sweep::{Axis, Form, Plan, Row, done, header, line};
use crate::setup::{Setup, Value};
use crate::structure::{MaxDepth, Method};
use std::path::PathBuf;
use std::sync::Arc;

/// The last sweep, and the settings of the next.
pub struct Sweeping {
    pub study: Study<Sweep, Found>,
    /// The least and the greatest `D_MAX` of the next sweep.
    pub depths: [u32; 2],
    /// Its leaf sizes, as they are typed: numbers, separated by commas.
    pub leaf_sizes: String,
    /// Its build methods.
    pub methods: Vec<Method>,
    /// The row whose settings were loaded last.
    pub chosen: Option<usize>,
    pub saving: Saving,
}

impl Default for Sweeping {
    fn default() -> Self {
        Sweeping {
            study: Study::default(),
            depths: [6, 24],
            leaf_sizes: "1, 2, 4, 8".to_owned(),
            methods: Method::of_the_paper(),
            chosen: None,
            saving: Saving::default(),
        }
    }
}

/// What is known of a sweep; it grows point by point.
#[derive(Clone)]
pub struct Found {
    /// What was on view when the sweep began.
    of: Setup,
    reload: u64,
    pub plan: Arc<Plan>,
    /// The rows so far, in the order of the points.
    pub rows: Vec<Row>,
}

impl Sweeping {
    /// The leaf sizes; `None` where something else is typed.
    pub fn n_oilf(&self) -> Option<Vec<u32>> {
        /// More than this many objects are a mistake in typing.
        const MOST: u32 = 100_000;
        let parts = self.leaf_sizes.split(',').map(str::trim);
        let mut sizes = Vec::new();
        for part in parts {
            let size = part.parse().ok().filter(|size| *size <= MOST)?;
            if !sizes.contains(&size) {
                sizes.push(size);
            }
        }
        Some(sizes)
    }

    pub fn receive(&mut self) {
        self.study.receive(|found, row| found.rows.push(row));
        self.saving.receive();
    }
}

impl Sweeping {
    /// Whether a sweep can be started: of a finished picture, with settings that make points.
    pub fn may_start(&self, doc: &Document) -> bool {
        !self.study.is_running()
            && doc.current.as_ref().is_some_and(|current| current.done)
            && !self.methods.is_empty()
            && self.depths[0] <= self.depths[1]
            && self.n_oilf().is_some()
    }

    /// Starts a sweep of the scene and picture on view. If the last one was of the same, it is resumed
    /// after its rows; otherwise it is replaced.
    pub fn start(&mut self, doc: &Document) {
        let Some(current) = doc.current.as_ref().filter(|_| self.may_start(doc)) else {
            return;
        };
        let shown = &current.shown;
        let [from, to] = self.depths;
        let axis = |name, values: Vec<Value>| Axis { name, values };
        let depths = (from..=to).map(|d| Value::Depth(MaxDepth::Fixed(d)));
        let sizes = self.n_oilf().unwrap_or_default().into_iter();
        let axes = [
            axis(
                "n-oilf",
                sizes.map(|n| Value::Number(f64::from(n))).collect(),
            ),
            axis("d-max", depths.collect()),
        ];
        let bases: Vec<_> = (self.methods.iter())
            .map(|&method| base(method, &shown.setup))
            .collect();
        let plan = Arc::new(Plan::new(&bases, &axes));
        let (of, reload) = (shown.setup.clone(), shown.reload);
        let known = self.study.found().filter(|found| {
            found.of.scene == of.scene
                && found.reload == reload
                && found.of.render == of.render
                && is_resumable(&found.rows, &plan)
        });
        let rows = known.map_or_else(Vec::new, |found| found.rows.clone());
        if rows.is_empty() {
            self.chosen = None;
        }
        let scene = (of.scene.clone(), Arc::clone(&shown.scene));
        let points = (rows.len()..plan.points.len()).collect();
        let found = Found {
            of,
            reload,
            plan: Arc::clone(&plan),
            rows,
        };
        let handle = doc.jobs.start(Sweep {
            plan,
            points,
            scene,
        });
        self.study.follow(handle, found);
    }

    /// Chooses a row; returns its settings, with the scene and picture that it was measured with.
    pub fn choose(&mut self, place: usize) -> Option<Setup> {
        let found = self.study.found()?;
        let row = found.rows.get(place)?;
        let setup = found.plan.points[row.point].setup.clone();
        self.chosen = Some(place);
        Some(setup)
    }
}

/// Returns the setup that a method is swept with: the one on view, with the default constants of the
/// method if that is another one.
fn base(method: Method, on_view: &Setup) -> Setup {
    let mut setup = on_view.clone();
    setup.build.set_method(method);
    setup
}

/// Whether these rows are the first of a plan, but not all of it.
fn is_resumable(rows: &[Row], plan: &Plan) -> bool {
    let keys = plan.points.iter().map(|point| point.key.clone());
    let keys: Vec<_> = keys.enumerate().collect();
    done(rows, &keys, keys.len()).is_ok_and(|done| done < keys.len())
}

/// Rows on their way to a file.
#[derive(Default)]
pub struct Saving {
    /// The file, as it is typed.
    pub path: String,
    running: Option<(Handle<Export>, String)>,
    /// What became of it.
    pub said: Option<String>,
}

impl Saving {
    /// Writes the rows: CSV, or JSON lines, by the extension of the path.
    pub fn save(&mut self, rows: &[Row], jobs: &Scheduler) {
        let path = PathBuf::from(self.path.trim());
        let Some(form) = Form::for_path(&path) else {
            self.said = Some("rows are written as .csv or .jsonl".to_owned());
            return;
        };
        let done = format!("{} rows in {}", rows.len(), path.display());
        let rows = rows.to_vec();
        let make = move || {
            let lines = rows.iter().map(|row| line(row, form));
            Ok((header(form) + &lines.collect::<String>()).into_bytes())
        };
        let export = Export {
            path,
            make: Box::new(make),
        };
        self.said = None;
        self.running = Some((jobs.start(export), done));
    }

    /// Takes note of how writing ended.
    fn receive(&mut self) {
        let end = self
            .running
            .as_ref()
            .map(|(handle, _)| handle.receive().end);
        if let Some(Some(end)) = end
            && let Some((_, done)) = self.running.take()
        {
            self.said = match end {
                End::Done(()) => Some(done),
                End::Failed(why) => Some(format!("{}: {why}", self.path.trim())),
                End::Cancelled | End::Replaced => None,
            };
        }
    }
}
