//! Presenting as a state: the full screen and larger type, and what comes back after it.

use egui::ViewportCommand;

/// How much larger everything is.
pub const SCALE: f32 = 1.25;
/// The height of the top bar, in points.
pub const BAR: f32 = 40.0;

/// What is to come back after presenting.
pub struct Presenting {
    zoom: f32,
}

impl Presenting {
    pub fn begin(ctx: &egui::Context) -> Self {
        let zoom = ctx.zoom_factor();
        ctx.set_zoom_factor(zoom * SCALE);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        Presenting { zoom }
    }

    pub fn end(self, ctx: &egui::Context) {
        ctx.set_zoom_factor(self.zoom);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(false));
    }
}
