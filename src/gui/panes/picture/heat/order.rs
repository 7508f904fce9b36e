//! The way to the costliest pixels: pixels in the order of the values on view.

use super::look::{Look, ValuesKey};
use crate::gui::document::tasks::Latest;
use std::sync::Arc;

/// The order of cost, and how far the user has followed it.
#[derive(Default)]
pub struct Order {
    orders: Latest<ValuesKey, Vec<u32>>,
    /// Steps down the order that were asked for.
    steps: i64,
    ranked: Option<Ranked>,
}

/// A pixel found by its rank.
pub struct Ranked {
    key: ValuesKey,
    pixel: [u32; 2],
    /// 0 for the costliest.
    pub rank: usize,
    /// How many pixels have a value.
    pub of: usize,
}

impl Order {
    /// Asks for a pixel later or earlier in the order.
    pub fn step(&mut self, by: i64) {
        self.steps += by;
    }

    pub fn is_asked(&self) -> bool {
        self.steps != 0
    }

    /// Forgets what was asked for.
    pub fn forget(&mut self) {
        self.steps = 0;
    }

    /// Returns the pixel that was asked for, once the order is known.
    pub fn pixel(
        &mut self,
        look: &Look,
        picked: Option<[u32; 2]>,
        ctx: &egui::Context,
    ) -> Option<[u32; 2]> {
        let key = look.key.values;
        let values = Arc::clone(&look.values);
        let order = self.orders.get(&key, ctx, move || values.by_cost())?;
        let steps = std::mem::take(&mut self.steps);
        // A pixel that was not found by its rank has no place in the order: begin at the top.
        let rank = match self.rank(key, picked) {
            Some(ranked) => ranked.rank as i64 + steps,
            None => steps - 1,
        };
        let last = order.len().checked_sub(1)?;
        let rank = rank.clamp(0, last as i64) as usize;
        let (width, at) = (look.values.image.width, order[rank]);
        let pixel = [at % width, at / width];
        self.ranked = Some(Ranked {
            key,
            pixel,
            rank,
            of: order.len(),
        });
        Some(pixel)
    }

    /// Returns the rank of the picked pixel, if it was found by it.
    pub fn rank(&self, key: ValuesKey, picked: Option<[u32; 2]>) -> Option<&Ranked> {
        let ranked = self.ranked.as_ref();
        ranked.filter(|ranked| Some(ranked.pixel) == picked && ranked.key == key)
    }
}
