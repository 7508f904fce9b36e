//! The card of the first start: three ways in. It is shown until one is taken or it is closed, then never
//! again.

use super::kept::KeptFile;
use crate::gui::action::shortcut;
use crate::gui::{icons, theme};
use egui::text::LayoutJob;
use egui::{Align, FontId, Modal, Sense, TextStyle, pos2, vec2};

/// The name of the file that remembers that it was closed.
const FILE: &str = "hint.json";

const WIDTH: f32 = 720.0;
const HEIGHT: f32 = 248.0;
const BUTTON: egui::Vec2 = vec2(216.0, 112.0);
/// Around the contents.
const MARGIN: i8 = 24;

/// The card; where nothing is kept from run to run, it is not shown at all.
pub struct FirstStart {
    file: KeptFile,
    shown: bool,
}

/// The ways in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Tour,
    Ray,
    Scene,
}

impl FirstStart {
    pub fn new(start: &crate::gui::StartOptions) -> Self {
        let file = KeptFile::new(start, FILE);
        let has_goal = start.lesson.is_some() || start.workspace.is_some();
        FirstStart {
            shown: start.remember && !has_goal && file.read::<bool>() != Some(true),
            file,
        }
    }

    /// Never shows it again; says whether it was shown.
    pub fn dismiss(&mut self) -> bool {
        if self.shown {
            self.file.write(&true);
        }
        std::mem::take(&mut self.shown)
    }

    /// Shows the card while it is wanted; returns the way that was chosen.
    pub fn show(&mut self, ctx: &egui::Context) -> Option<Way> {
        if !self.shown {
            return None;
        }
        let t = theme::Tokens::of(ctx.theme());
        let frame = egui::Frame::new()
            .fill(t.card)
            .stroke(egui::Stroke::new(1.0, t.border))
            .corner_radius(theme::CARD_RADIUS)
            .inner_margin(MARGIN);
        let modal = Modal::new(egui::Id::unique("first start"))
            .backdrop_color(t.ground.gamma_multiply(0.75))
            .frame(frame);
        let card = modal.show(ctx, |ui| {
            let margin = 2.0 * f32::from(MARGIN) + 2.0;
            let room = ui.ctx().content_rect().size() - vec2(16.0, 16.0);
            let size = vec2(WIDTH, HEIGHT).min(room) - vec2(margin, margin);
            ui.set_width(size.x);
            ui.set_min_height(size.y);
            ways(ui)
        });
        if card.inner.is_some() || card.should_close() {
            self.dismiss();
        }
        card.inner
    }
}

/// The contents of the card.
fn ways(ui: &mut egui::Ui) -> Option<Way> {
    let title = "See how a kd-tree makes ray tracing fast";
    ui.add(egui::Label::new(theme::display(title)).wrap());
    ui.add_space(8.0);
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(11.0, 8.0);
        for (way, icon, name, about) in [
            (
                Way::Tour,
                icons::GRADUATION_CAP,
                "Take the tour",
                "Predict, then measure: the first lesson",
            ),
            (
                Way::Ray,
                icons::PATH,
                "Follow a ray",
                "Step through the tree with one ray",
            ),
            (
                Way::Scene,
                icons::FOLDER,
                "Use my scene",
                "Open an OBJ, PLY, glTF, STL or NFF file",
            ),
        ] {
            if way_button(ui, icon, name, about) {
                chosen = Some(way);
            }
        }
    });
    ui.add_space(4.0);
    ui.label(theme::hint(format!(
        "Esc closes this card. {} lists all shortcuts.",
        shortcut("window.help")
    )));
    chosen
}

/// A button with an icon, a name and a line below each other; whether it was clicked.
fn way_button(ui: &mut egui::Ui, icon: &str, name: &str, about: &str) -> bool {
    let (rect, response) = ui.allocate_exact_size(BUTTON, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    let look = ui.style().interact(&response);
    let painter = ui.painter();
    let inside = egui::StrokeKind::Inside;
    painter.rect(
        rect,
        look.corner_radius,
        look.bg_fill,
        look.bg_stroke,
        inside,
    );
    let t = theme::tokens(ui);
    let body = TextStyle::Body.resolve(ui.style());
    let mut top = rect.top() + 10.0;
    for (text, font, color) in [
        (icon, FontId::proportional(28.0), t.accent),
        (name, FontId::new(body.size, theme::semibold()), t.text),
        (
            about,
            theme::named(theme::HINT).resolve(ui.style()),
            t.label,
        ),
    ] {
        let mut job = LayoutJob::simple(text.to_owned(), font, color, rect.width() - 16.0);
        job.halign = Align::Center;
        let galley = painter.layout_job(job);
        let height = galley.size().y;
        painter.galley(pos2(rect.center().x, top), galley, color);
        top += height + 2.0;
    }
    response.clicked()
}
