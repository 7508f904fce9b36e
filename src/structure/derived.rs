//! What others make of a tree, kept as long as the tree.

use std::any::Any;
use std::sync::OnceLock;

/// One thing of any type, made when it is first asked for. It follows from the tree.
#[derive(Default)]
pub(super) struct Derived(OnceLock<Box<dyn Any + Send + Sync>>);

impl Derived {
    /// # Panics
    /// If something of another type is kept already.
    pub(super) fn get<T: Send + Sync + 'static>(&self, make: impl FnOnce() -> T) -> &T {
        let kept = self.0.get_or_init(|| Box::new(make()));
        kept.downcast_ref().expect("one type a tree")
    }
}

impl std::fmt::Debug for Derived {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Derived")
    }
}
