//! The heatmap on view as a file.

use super::{HeatView, On};
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::present::export::HeatSheet;
use crate::present::overlay::COLORMAPS;
use image::ImageFormat;
use std::sync::Arc;

impl HeatView {
    /// What makes the bytes of a file of the heatmap on view; `None` while there is none.
    pub fn export(
        &self,
        doc: &Document,
    ) -> Option<impl FnOnce(ImageFormat) -> Result<Vec<u8>, String> + Send + use<>> {
        let look = Arc::clone(self.look()?);
        let (which, trees) = match self.on {
            On::Picture(which) => (which, ""),
            On::Difference => (Which::B, "B less A, "),
        };
        let current = doc.both()[which as usize]?;
        let shown = &current.shown;
        let of = format!(
            "{}, {trees}{}",
            shown.scene.name(),
            shown.tree.settings().method.name
        );
        let opacity = f64::from(self.choice.opacity);
        let picture = (opacity < 1.0).then(|| Arc::clone(&shown.picture));
        Some(move |format| {
            let sheet = HeatSheet {
                heatmap: look.heatmap(),
                image: &look.values.image,
                total: look.values.total,
                difference: look.is_difference(),
                rays: look.key.values.rays,
                scale: look.key.scale,
                range: look.key.range,
                colors: &COLORMAPS[look.key.colors],
                below: picture.as_deref().map(|picture| (picture, opacity)),
                of,
            };
            match format {
                ImageFormat::OpenExr => sheet.exr().map_err(|error| error.to_string()),
                _ => sheet.png().map_err(|error| error.to_string()),
            }
        })
    }
}
