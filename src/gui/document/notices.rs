//! Short messages of what was done, in a corner until they were seen.

/// How long a message stays, in seconds.
const STAY: f64 = 12.0;

/// Messages, the oldest first.
#[derive(Default)]
pub struct Notices {
    list: Vec<Notice>,
}

struct Notice {
    text: String,
    /// When it goes, in the window's seconds; `None` until it was shown.
    until: Option<f64>,
}

impl Notices {
    /// Shows a message from now on.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        self.list.retain(|notice| notice.text != text);
        self.list.push(Notice { text, until: None });
    }

    /// Closes all; says whether there were any.
    pub fn close(&mut self) -> bool {
        let any = !self.list.is_empty();
        self.list.clear();
        any
    }

    pub fn show(&mut self, ctx: &egui::Context) {
        let now = ctx.input(|i| i.time);
        for notice in &mut self.list {
            notice.until.get_or_insert(now + STAY);
        }
        self.list
            .retain(|n| n.until.is_none_or(|until| now < until));
        let next = self.list.iter().filter_map(|n| n.until);
        let Some(next) = next.reduce(f64::min) else {
            return;
        };
        ctx.request_repaint_after_secs((next - now) as f32);
        let mut closed = false;
        egui::Window::new("Done")
            .title_bar(false)
            .anchor(egui::Align2::RIGHT_BOTTOM, [-12.0, -40.0])
            .resizable(false)
            .default_width(360.0)
            .show(ctx, |ui| {
                for notice in &self.list {
                    ui.add(egui::Label::new(&notice.text).wrap());
                }
                closed = ui
                    .small_button("Close")
                    .on_hover_text("Close these messages.\nShortcut: Esc")
                    .clicked();
            });
        if closed {
            self.close();
        }
    }
}
