//! The full screen with larger type, and the way back.

use egui::ViewportCommand;

/// How much larger everything is.
pub const SCALE: f32 = 1.25;

/// What is to come back after presenting.
pub struct FullScreen {
    zoom: f32,
}

impl FullScreen {
    pub fn begin(ctx: &egui::Context) -> Self {
        let zoom = ctx.zoom_factor();
        ctx.set_zoom_factor(zoom * SCALE);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        FullScreen { zoom }
    }

    pub fn end(self, ctx: &egui::Context) {
        ctx.set_zoom_factor(self.zoom);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(false));
    }
}
