//! A picture with all its samples, behind a progress bar.

use super::bar;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{Picture, RenderSettings, render_timed, thread_pool};
use anyhow::Result;
use std::sync::{Mutex, PoisonError};

/// Renders all samples of a picture.
pub fn render(scene: &Scene, tree: &Tree, settings: &RenderSettings) -> Result<Picture> {
    let pool = thread_pool(settings.threads)?;
    let picture = Mutex::new(Picture::new(settings.width, settings.height));
    for sample in 0..settings.samples {
        let stage = format!(
            "{}: sample {} of {}",
            scene.name(),
            sample + 1,
            settings.samples
        );
        bar::with_bar(&stage, |progress| {
            render_timed(
                scene,
                tree,
                settings,
                sample,
                &pool,
                progress,
                |tile, colors| {
                    picture
                        .lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .add_tile(tile, sample, colors);
                },
            )
        })?;
    }
    Ok(picture.into_inner().unwrap_or_else(PoisonError::into_inner))
}
