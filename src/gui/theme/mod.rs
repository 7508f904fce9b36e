//! The look of the window. [`tokens`] has the colors, [`text`] the fonts and text styles. [`style`]
//! turns both, with sizes and distances, into the style that egui draws its widgets with. [`widgets`]
//! adds the few widgets that egui lacks.
//!
//! `ui.label` draws text in [`Tokens::label`], `ui.strong` and all controls in [`Tokens::text`], and
//! `ui.weak` in [`Tokens::hint`]. The theme does not include colors of data, such as those of heatmaps,
//! cells of the tree and curves.

mod style;
mod text;
mod tokens;
mod widgets;

pub use style::{CARD_RADIUS, RADIUS, ROW};
pub use text::{
    DISPLAY, FIGURE, HINT, LESSON, display, figure, heading, hint, lesson, named, semibold, strong,
};
pub use tokens::Tokens;
pub use widgets::{IconButton, card, chip};

/// Installs the fonts, and the style of both themes.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(text::fonts());
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        ctx.set_style_of(theme, style::style(theme));
    }
}

/// Returns the colors of the theme that `ui` is shown in.
pub fn tokens(ui: &egui::Ui) -> &'static Tokens {
    Tokens::of(if ui.visuals().dark_mode {
        egui::Theme::Dark
    } else {
        egui::Theme::Light
    })
}
