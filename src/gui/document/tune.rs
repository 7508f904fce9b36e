//! Starting the search for the best tree, and using what it finds.

use super::Document;
use super::tuning::Found;
use crate::jobs::FindBestTree;
use crate::measure::tune::{Search, is_tried};
use crate::setup::Setup;
use crate::structure::Method;
use std::sync::Arc;
use std::time::Duration;

impl Document {
    /// Whether a search can start: in a finished picture of a scene with objects, with a method.
    pub fn may_tune(&self) -> bool {
        let current = self.current.as_ref();
        let Some(current) = current.filter(|current| current.is_of_objects()) else {
            return false;
        };
        let objects = current.shown.scene.objects().len();
        let mut methods = self.tuning.methods.iter();
        methods.any(|method| is_tried(*method, objects)) && !self.tuning.study.is_running()
    }

    /// Starts a search in the scene and picture on view, in place of the last one.
    pub fn tune(&mut self) {
        let Some(current) = self.current.as_ref().filter(|_| self.may_tune()) else {
            return;
        };
        let scene = Arc::clone(&current.shown.scene);
        let chosen = |method: &Method| self.tuning.methods.contains(method);
        let search = Search {
            setup: current.shown.setup.clone(),
            goal: self.tuning.goal,
            rays: self.tuning.rays.get(),
            most_bytes: (self.tuning.memory.get()).map(|mib| (mib * f64::from(1 << 20)) as u64),
            methods: Method::all().filter(chosen).collect(),
            budget: Duration::from_secs(self.tuning.budget),
        };
        let found = Found {
            search: search.clone(),
            scene: scene.name().to_owned(),
            rows: Vec::new(),
            tuned: None,
        };
        let handle = self.jobs.start(FindBestTree { scene, search });
        self.tuning.study.follow(handle, found);
    }

    /// Whether the tree in front is wanted with the settings of a candidate.
    pub fn uses(&self, candidate: &Setup) -> bool {
        self.wanted.scene == candidate.scene && self.wanted.build == candidate.build
    }

    /// Builds the tree in front with the settings of a candidate. If the scene is a different one by
    /// now, the candidate's scene and picture come back with it.
    pub fn use_tree_of(&mut self, candidate: Setup) {
        if self.wanted.scene == candidate.scene {
            self.wanted.build = candidate.build;
        } else {
            self.wanted = candidate;
        }
    }
}
