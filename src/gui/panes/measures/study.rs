//! The study of the window: which measure predicts time, in the scene on view.

use crate::gui::document::study::Study;
use crate::gui::document::{Current, Document};
use crate::jobs::StudyMeasures;
use crate::measure::structures;
use crate::measure::study::{KERNELS, Outcome, Plan};
use std::sync::Arc;

/// The last study, and the settings of the next.
pub struct Studying {
    /// Rays per set, at least 1.
    pub rays: usize,
    /// How often each structure is timed, at least 1.
    pub rounds: usize,
    /// What is known: nothing before the end.
    pub study: Study<StudyMeasures, Option<Arc<Outcome>>>,
}

impl Default for Studying {
    fn default() -> Self {
        Studying {
            rays: 4096,
            rounds: 3,
            study: Study::default(),
        }
    }
}

impl Studying {
    pub fn receive(&mut self) {
        let outcome = self.study.receive(|_, ()| ());
        if let (Some(outcome), Some(found)) = (outcome, self.study.found_mut()) {
            *found = Some(Arc::new(outcome));
        }
    }

    /// Returns the outcome of the last study that was completed since it was started.
    pub fn outcome(&self) -> Option<Arc<Outcome>> {
        self.study.found()?.as_ref().clone()
    }

    /// Whether a study can be started: of a finished picture of a scene that has objects.
    pub fn may_start(&self, doc: &Document) -> bool {
        !self.study.is_running() && doc.current.as_ref().is_some_and(Current::is_of_objects)
    }

    /// Starts the study of the scene on view, in place of the last one.
    pub fn start(&mut self, doc: &Document) {
        let Some(current) = doc.current.as_ref().filter(|_| self.may_start(doc)) else {
            return;
        };
        let scene = Arc::clone(&current.shown.scene);
        let plan = Plan {
            render: current.shown.setup.render,
            builds: structures(&scene),
            kernels: KERNELS.to_vec(),
            rays: self.rays,
            rounds: self.rounds,
        };
        let handle = doc.jobs.start(StudyMeasures { scene, plan });
        self.study.follow(handle, None);
    }
}
