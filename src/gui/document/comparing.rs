//! Two trees beside each other: which of them is meant, how their pictures are shown, and whether
//! they may be compared at all.

use super::result::Current;
use super::tasks::Latest;
use crate::measure::{Unequal, differing_pixels, unequal};
pub use crate::workspace::{Arrangement as View, Which};
use std::cell::RefCell;
use std::sync::Arc;

/// How two trees are compared.
pub struct Comparing {
    pub view: View,
    /// Where the wipe's line lies, 0 at the pictures' left edge to 1 at the right one.
    pub split: f32,
    /// Made when it is asked for.
    verdict: RefCell<Latest<[u64; 2], Verdict>>,
}

impl Default for Comparing {
    fn default() -> Self {
        Comparing {
            view: View::Beside,
            split: 0.5,
            verdict: RefCell::default(),
        }
    }
}

/// Whether two trees may be compared.
pub struct Verdict {
    /// What keeps them from it; nothing if they may.
    pub reasons: Vec<Unequal>,
    /// The pixels whose colors differ, row by row; none of pictures of different sizes.
    pub pixels: Vec<u32>,
}

impl Comparing {
    /// The verdict on two finished pictures; `None` until it is there.
    pub fn verdict(
        &self,
        both: [Option<&Current>; 2],
        ctx: &egui::Context,
    ) -> Option<Arc<Verdict>> {
        let [Some(a), Some(b)] = both else {
            return None;
        };
        if !(a.done && b.done) {
            return None;
        }
        let key = [a.number, b.number];
        let mut latest = self.verdict.borrow_mut();
        if let Some(verdict) = latest.ready(&key) {
            return Some(verdict);
        }
        let [a, b] = [a, b].map(|side| {
            (
                side.shown.measurement.clone(),
                Arc::clone(&side.shown.picture),
            )
        });
        latest.get(&key, ctx, move || Verdict {
            reasons: unequal((&a.0, &a.1), (&b.0, &b.1)),
            pixels: differing_pixels(&a.1, &b.1),
        })
    }
}
