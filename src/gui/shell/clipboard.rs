//! Copies text, and says so only once it is on the clipboard: the system is asked to paste it back.

use crate::gui::document::notices::Notices;

/// How long the system may take to paste back, in seconds.
const PATIENCE: f64 = 1.0;

/// The text that was copied last, until it is known whether that worked.
#[derive(Default)]
pub struct Clipboard {
    pending: Option<Pending>,
}

struct Pending {
    text: String,
    /// When it was copied, in the window's seconds.
    since: f64,
}

impl Clipboard {
    pub fn copy(&mut self, text: String, ctx: &egui::Context) {
        ctx.copy_text(text.clone());
        self.pending = Some(Pending {
            text,
            since: ctx.input(|i| i.time),
        });
        ctx.send_viewport_cmd(egui::ViewportCommand::RequestPaste);
        ctx.request_repaint();
    }

    /// Takes what is pasted back, so that no text field gets it; says how copying ended.
    pub fn follow(&mut self, ctx: &egui::Context, notices: &mut Notices) {
        let Some(pending) = &self.pending else {
            return;
        };
        let mut is_back = false;
        ctx.input_mut(|input| {
            input.events.retain(|event| {
                let back = matches!(event, egui::Event::Paste(text) if *text == pending.text);
                is_back |= back;
                !back
            });
        });
        let text = &pending.text;
        if is_back {
            notices.say(format!("Copied: {text}"));
        } else if ctx.input(|i| i.time) - pending.since > PATIENCE {
            notices.say(format!("The system has no clipboard. The text is: {text}"));
        } else {
            ctx.request_repaint_after_secs(PATIENCE as f32);
            return;
        }
        self.pending = None;
    }
}
