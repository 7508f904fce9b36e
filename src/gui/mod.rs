//! The window: a progressive picture, the tree in 3D, and the figures, all of one setup.
//!
//! Data flows one way. The [`document`] holds the setups, results and selection. [`panes`] read it and
//! return [`edits`]; each pane is one folder and one line in the registry. The [`shell`] owns what is
//! around the panes: tasks and their layouts, menus, palette, shortcuts, files.

mod action;
mod document;
mod edits;
pub mod icons;
mod pane;
mod panes;
mod shell;
mod start;
pub mod theme;
mod widgets;

pub use shell::{App, shortcuts};
pub use start::StartOptions;

use eframe::egui_wgpu::WgpuSetup;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum GuiError {
    #[error(
        "there is no screen to open a window on ({0}); the command line does without: \
         bspscope --help"
    )]
    NoDisplay(String),
    #[error(
        "there is nothing to draw with ({0}); install a Vulkan driver (libvulkan1 and \
         mesa-vulkan-drivers) or OpenGL (libegl1 and libgl1-mesa-dri), or use the command line: \
         bspscope --help"
    )]
    NoGraphics(String),
    #[error("the window ended: {0}")]
    Ended(String),
}

/// The program's own: a box split by planes.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/bspscope.png"))
        .expect("a test reads it")
}

/// Opens the window and returns once it is closed.
///
/// # Errors
/// No screen, nothing to draw with, or a system library that is missing.
pub fn run(start: StartOptions) -> Result<(), GuiError> {
    let kept: Option<shell::Layout> = shell::KeptFile::new(&start, shell::LAYOUT_FILE).read();
    let [width, height] = kept
        .and_then(|layout| layout.size)
        .unwrap_or([1400.0, 900.0]);
    let [least_width, least_height] = shell::LEAST_SIZE;
    let size = [width.max(least_width), height.max(least_height)];
    let mut options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(shell::PROGRAM)
            .with_app_id("bspscope")
            .with_icon(icon())
            .with_inner_size(size)
            .with_min_inner_size(shell::LEAST_SIZE),
        ..Default::default()
    };
    if let WgpuSetup::CreateNew(setup) = &mut options.wgpu_options.wgpu_setup {
        let usual = Arc::clone(&setup.device_descriptor);
        // Several screens beside each other can be wider than the usual limit of 8192 pixels.
        setup.device_descriptor = Arc::new(move |adapter| {
            let mut device = (*usual)(adapter);
            device.required_limits.max_texture_dimension_2d =
                adapter.limits().max_texture_dimension_2d;
            device
        });
    }
    let opened = Arc::new(AtomicBool::new(false));
    let inside = Arc::clone(&opened);
    let open = || {
        eframe::run_native(
            "bspscope",
            options,
            Box::new(move |cc| {
                inside.store(true, Ordering::Relaxed);
                Ok(Box::new(App::new(cc, start)))
            }),
        )
    };
    // Window systems panic where a library is missing, such as libxkbcommon-x11. Until the window is
    // there, that is one more reason why there is none, not a fault to report at length.
    let report: Arc<dyn Fn(&std::panic::PanicHookInfo<'_>) + Send + Sync> =
        Arc::from(std::panic::take_hook());
    let (loud, after) = (Arc::clone(&report), Arc::clone(&opened));
    std::panic::set_hook(Box::new(move |panic| {
        if after.load(Ordering::Relaxed) {
            loud(panic);
        }
    }));
    let ended = std::panic::catch_unwind(std::panic::AssertUnwindSafe(open));
    std::panic::set_hook(Box::new(move |panic| report(panic)));
    match ended {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(match error {
            eframe::Error::WinitEventLoop(_) | eframe::Error::Winit(_) => {
                // Before the reason stand places in the source of other crates.
                let text = error.to_string();
                let reason = text.rsplit(": ").next().unwrap_or(&text);
                GuiError::NoDisplay(reason.trim_end_matches('.').to_owned())
            }
            eframe::Error::Wgpu(_) => GuiError::NoGraphics(error.to_string()),
            error => GuiError::Ended(error.to_string()),
        }),
        Err(panic) => {
            let text = panic
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()))
                .unwrap_or_else(|| "for an unknown reason".into());
            Err(if opened.load(Ordering::Relaxed) {
                GuiError::Ended(text)
            } else {
                GuiError::NoDisplay(text)
            })
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_icon_is_a_picture() {
        let icon = super::icon();
        assert_eq!((icon.width, icon.height), (256, 256));
        // The corners are round: nothing there, something in the middle.
        assert_eq!(icon.rgba[3], 0);
        assert_eq!(icon.rgba[(128 * 256 + 128) * 4 + 3], 255);
    }
}
