//! The heatmap of one picture, or the difference of two, on its way from values to the screen.

use super::look::{Look, LookKey, Values, ValuesKey};
use crate::gui::document::tasks::Latest;
use egui::{Color32, TextureHandle, TextureId, TextureOptions};
use std::sync::Arc;

/// The tint of what is about to change.
pub const DIM: Color32 = Color32::from_gray(140);

#[derive(Default)]
pub struct Layer {
    values: Latest<ValuesKey, Values>,
    looks: Latest<LookKey, Look>,
    /// What is on view; `None` for the picture alone, and while there is nothing to show yet.
    pub look: Option<Arc<Look>>,
    /// Holds the colors of the look with this key.
    texture: Option<(LookKey, TextureHandle)>,
}

impl Layer {
    /// Forgets a look that is of none of the pictures on view.
    pub fn keep_if(&mut self, keeps: impl FnOnce(&ValuesKey) -> bool) {
        self.look = self.look.take().filter(|look| keeps(&look.key.values));
    }

    /// The values of this key, made in the background.
    pub fn values(
        &mut self,
        key: ValuesKey,
        ctx: &egui::Context,
        make: impl FnOnce() -> Values + Send + 'static,
    ) -> Option<Arc<Values>> {
        self.values.get(&key, ctx, make)
    }

    /// Shows values in colors as soon as those are there; until then the look before stays, with
    /// its own legend.
    pub fn show(&mut self, key: LookKey, values: Arc<Values>, ctx: &egui::Context) {
        if let Some(look) = self.looks.get(&key, ctx, move || Look::of(key, values)) {
            self.look = Some(look);
        }
    }

    /// Colors to draw over the picture; `None` while there are none.
    pub fn texture(&mut self, ctx: &egui::Context) -> Option<TextureId> {
        let look = self.look.as_ref()?;
        let fits = |texture: &TextureHandle| texture.size() == look.pixels.size;
        match &mut self.texture {
            Some((key, _)) if *key == look.key => {}
            Some((key, texture)) if fits(texture) => {
                texture.set(Arc::clone(&look.pixels), TextureOptions::NEAREST);
                *key = look.key;
            }
            texture => {
                let pixels = Arc::clone(&look.pixels);
                let handle = ctx.load_texture("heatmap", pixels, TextureOptions::NEAREST);
                *texture = Some((look.key, handle));
            }
        }
        let (_, texture) = self.texture.as_ref()?;
        Some(texture.id())
    }
}

/// Returns the tint of a heatmap that hides so much of the picture below, from 0 to 1. A heatmap that is
/// about to change is dim.
pub fn tint(opacity: f32, is_old: bool) -> Color32 {
    let tint = if is_old { DIM } else { Color32::WHITE };
    tint.gamma_multiply(opacity)
}
