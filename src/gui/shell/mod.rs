//! What is around the panes: the window with its bars, tasks and their layouts, palette, shortcuts, and
//! files.

mod actions;
mod app;
mod clipboard;
mod exporting;
mod files;
mod first_start;
mod frame;
mod full_screen;
mod help;
mod kept;
mod keys;
mod layout;
mod palette;
mod places;
mod present;
mod progress;
mod recent;
mod save_as;
mod status;
mod strip;
mod tasks;
mod thumbnails;
mod tiles;
mod title;
mod top_bar;
mod workspaces;

pub use app::App;
pub use kept::KeptFile;
pub use layout::{LAYOUT_FILE, LEAST_SIZE, Layout};
pub use title::PROGRAM;

use help::Section;

/// Returns all shortcuts, as the window lists them.
pub fn shortcuts() -> Vec<Section> {
    help::sections(actions::ACTIONS.iter().map(|action| action.info))
}
