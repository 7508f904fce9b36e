//! The scenes, trees and pictures that jobs share. What a setup can reuse follows from what its
//! settings affect ([`Setup::invalidates`]).

use crate::measure::heat::PixelCounts;
use crate::measure::{Measurement, TreeFacts};
use crate::scene::Scene;
use crate::setup::{Affects, Setup};
use crate::structure::Tree;
use crate::trace::{CountedRender, Picture, RenderError, thread_pool};
use rayon::ThreadPool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The last two scenes, trees and pictures that were used, since a comparison alternates between two.
/// Cloning shares it.
#[derive(Clone, Default)]
pub struct Cache(Arc<Mutex<Kept>>);

#[derive(Default)]
struct Kept {
    scenes: LastTwo<Loaded>,
    trees: LastTwo<(Setup, Built)>,
    pictures: LastTwo<(Setup, Finished)>,
    pool: Option<(usize, Arc<ThreadPool>)>,
}

struct Loaded {
    setup: Setup,
    reload: u64,
    scene: Arc<Scene>,
}

/// A tree with everything that is known before a ray is traced.
#[derive(Clone)]
pub struct Built {
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub known: Measurement,
}

/// A finished picture with what was counted for it.
#[derive(Clone)]
pub struct Finished {
    pub tree: Arc<Tree>,
    /// With all samples.
    pub picture: Arc<Picture>,
    pub pixel_counts: Arc<PixelCounts>,
    pub counted: CountedRender,
}

/// The two things used last, the later first.
struct LastTwo<T>(Vec<T>);

impl<T> Default for LastTwo<T> {
    fn default() -> Self {
        LastTwo(Vec::new())
    }
}

impl<T> LastTwo<T> {
    /// The one that fits, from now on the one used last.
    fn find(&mut self, fits: impl FnMut(&T) -> bool) -> Option<&T> {
        let place = self.0.iter().position(fits)?;
        self.0[..=place].rotate_right(1);
        self.0.first()
    }

    fn put(&mut self, new: T) {
        self.0.insert(0, new);
        self.0.truncate(2);
    }
}

impl Cache {
    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The scene of a setup, if it was loaded since its file was read again for the `reload`th time.
    /// Drops the scenes, trees and pictures of other files, before the next scene takes memory.
    pub fn scene(&self, setup: &Setup, reload: u64) -> Option<Arc<Scene>> {
        let Kept {
            scenes,
            trees,
            pictures,
            ..
        } = &mut *self.lock();
        scenes.0.retain(|known| {
            known.setup.scene.source == setup.scene.source && known.reload == reload
        });
        trees.0.retain(|(_, built)| {
            let mut all = scenes.0.iter();
            all.any(|known| Arc::ptr_eq(&known.scene, &built.scene))
        });
        pictures.0.retain(|(_, finished)| {
            let mut all = trees.0.iter();
            all.any(|(_, built)| Arc::ptr_eq(&built.tree, &finished.tree))
        });
        let known = scenes.find(|known| keeps(setup, &known.setup, Affects::Scene))?;
        Some(Arc::clone(&known.scene))
    }

    pub fn put_scene(&self, setup: Setup, reload: u64, scene: Arc<Scene>) {
        self.lock().scenes.put(Loaded {
            setup,
            reload,
            scene,
        });
    }

    /// The tree of a setup, if it was built of this scene.
    pub fn tree(&self, setup: &Setup, scene: &Arc<Scene>) -> Option<Built> {
        let fits = |(known, built): &(Setup, Built)| {
            Arc::ptr_eq(&built.scene, scene) && keeps(setup, known, Affects::Structure)
        };
        let known = self.lock().trees.find(fits).cloned();
        known.map(|(_, built)| built)
    }

    pub fn put_tree(&self, setup: Setup, built: Built) {
        self.lock().trees.put((setup, built));
    }

    /// Adds what was found out about a tree after it was built.
    pub fn put_facts(&self, tree: &Arc<Tree>, facts: TreeFacts) {
        let trees = &mut self.lock().trees;
        let same = trees.0.iter_mut().map(|(_, built)| built);
        for built in same.filter(|built| Arc::ptr_eq(&built.tree, tree)) {
            built.known.tree = facts;
        }
    }

    /// The picture of a setup, if it was finished with this tree.
    pub fn picture(&self, setup: &Setup, tree: &Arc<Tree>) -> Option<Finished> {
        let fits = |(known, finished): &(Setup, Finished)| {
            Arc::ptr_eq(&finished.tree, tree) && keeps(setup, known, Affects::Image)
        };
        let known = self.lock().pictures.find(fits).cloned();
        known.map(|(_, finished)| finished)
    }

    /// Keeps a finished picture in place of one that differs only in times.
    pub fn put_picture(&self, setup: Setup, finished: Finished) {
        let pictures = &mut self.lock().pictures;
        pictures
            .0
            .retain(|(known, _)| !keeps(&setup, known, Affects::Image));
        pictures.put((setup, finished));
    }

    /// Threads to render on; 0 takes as many as the machine has cores.
    ///
    /// # Errors
    /// The system provides no threads.
    pub fn pool(&self, threads: usize) -> Result<Arc<ThreadPool>, RenderError> {
        let mut kept = self.lock();
        match &kept.pool {
            Some((known, pool)) if *known == threads => Ok(Arc::clone(pool)),
            _ => {
                let pool = Arc::new(thread_pool(threads)?);
                kept.pool = Some((threads, Arc::clone(&pool)));
                Ok(pool)
            }
        }
    }
}

/// Whether a setup can reuse the scene, the tree or the picture of another setup.
fn keeps(setup: &Setup, other: &Setup, result: Affects) -> bool {
    setup
        .invalidates(other)
        .is_none_or(|invalid| invalid > result)
}
