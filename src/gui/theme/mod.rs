//! The look of the window: [`tokens`] are its colors, [`text`] its fonts and text styles, [`style`]
//! gives both to egui together with sizes and distances, and [`widgets`] are the few widgets that
//! egui lacks.
//!
//! Text that egui draws with `ui.label` has the color [`Tokens::label`], `ui.strong` and the contents
//! of controls have [`Tokens::text`], and `ui.weak` has [`Tokens::hint`]. Colors of data, such as those
//! of heatmaps, tree cells and curves, are no part of the theme.

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

/// Gives the window its fonts and, in both themes, its colors, text styles and distances.
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
