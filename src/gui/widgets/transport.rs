//! Buttons that go through steps one by one or play them: of a ray, of the build.

use crate::gui::action::tip;
use crate::gui::icons;
use crate::gui::theme::IconButton;
use egui::Ui;

/// The height of a row with these buttons, in points.
pub const HEIGHT: f32 = 36.0;

/// One of the buttons.
pub struct Button {
    /// What screen readers know it by.
    pub name: &'static str,
    /// What it does, starting with a verb.
    pub about: &'static str,
    /// The action that does the same.
    pub action: &'static str,
    pub enabled: bool,
}

/// The buttons, in their order on the screen.
pub struct Transport {
    pub first: Button,
    pub previous: Button,
    pub play: Button,
    pub next: Button,
    pub last: Button,
    /// Whether steps are being played: the button in the middle pauses then.
    pub is_playing: bool,
}

impl Transport {
    /// Draws the buttons. Returns the action of the one that was clicked.
    pub fn show(self, ui: &mut Ui) -> Option<&'static str> {
        let play = if self.is_playing {
            icons::PAUSE
        } else {
            icons::PLAY
        };
        ui.spacing_mut().item_spacing.x = 2.0;
        let mut clicked = None;
        for (icon, button) in [
            (icons::FIRST, self.first),
            (icons::PREVIOUS, self.previous),
            (play, self.play),
            (icons::NEXT, self.next),
            (icons::LAST, self.last),
        ] {
            let about = tip(button.about, button.action);
            let widget = IconButton::new(icon, button.name).tip(&about);
            if ui.add_enabled(button.enabled, widget).clicked() {
                clicked = Some(button.action);
            }
        }
        clicked
    }
}
