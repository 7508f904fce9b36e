//! The scenes and trees that jobs share.

use crate::measure::Measurement;
use crate::scene::{Scene, SceneRequest};
use crate::structure::{BuildSettings, Tree};
use crate::trace::{RenderError, thread_pool};
use rayon::ThreadPool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The last two scenes and the last two trees that were used, since a comparison alternates between
/// two. Cloning shares it.
#[derive(Clone, Default)]
pub struct Cache(Arc<Mutex<Kept>>);

#[derive(Default)]
struct Kept {
    scenes: LastTwo<Loaded>,
    trees: LastTwo<Built>,
    pool: Option<(usize, Arc<ThreadPool>)>,
}

struct Loaded {
    request: SceneRequest,
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

    /// The scene, if it was loaded since its file was read again for the `reload`th time. Drops the
    /// scenes and trees of other files, before the next scene takes memory.
    pub fn scene(&self, request: &SceneRequest, reload: u64) -> Option<Arc<Scene>> {
        let Kept { scenes, trees, .. } = &mut *self.lock();
        scenes
            .0
            .retain(|known| known.request.source == request.source && known.reload == reload);
        trees.0.retain(|built| {
            let mut all = scenes.0.iter();
            all.any(|known| Arc::ptr_eq(&known.scene, &built.scene))
        });
        let known = scenes.find(|known| known.request == *request)?;
        Some(Arc::clone(&known.scene))
    }

    pub fn put_scene(&self, request: SceneRequest, reload: u64, scene: Arc<Scene>) {
        self.lock().scenes.put(Loaded {
            request,
            reload,
            scene,
        });
    }

    /// The tree of a scene with these settings, if it was built.
    pub fn tree(&self, scene: &Arc<Scene>, settings: &BuildSettings) -> Option<Built> {
        let fits =
            |built: &Built| Arc::ptr_eq(&built.scene, scene) && built.known.build == *settings;
        self.lock().trees.find(fits).cloned()
    }

    pub fn put_tree(&self, built: Built) {
        self.lock().trees.put(built);
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
