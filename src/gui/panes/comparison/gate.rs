//! Whether two trees may be compared, and if not, why and what can be done.

use crate::gui::document::Document;
use crate::gui::document::comparing::{Verdict, View};
use crate::gui::edits::Edits;
use crate::gui::icons;
use crate::gui::theme::{hint, strong, tokens};
use crate::measure::Unequal;

/// Shows the verdict; `None` while it is not there.
pub fn show(ui: &mut egui::Ui, doc: &Document, verdict: Option<&Verdict>, edits: &mut Edits) {
    let t = tokens(ui);
    let Some(verdict) = verdict else {
        ui.label(hint("Waiting for both pictures"));
        return;
    };
    if verdict.reasons.is_empty() {
        let text = format!("{} Fair comparison", icons::CHECK);
        ui.label(strong(text).color(t.better)).on_hover_text(
            "Scene, camera and light are the same (parameters of class S and D), and so is every \
                 pixel.",
        );
        return;
    }
    let text = format!("{} Not comparable", icons::WARNING);
    ui.label(strong(text).color(t.warning)).on_hover_text(
        "The paper's precondition: parameters of class S and D are equal, and so is the picture.",
    );
    for reason in &verdict.reasons {
        ui.add(egui::Label::new(format!("• {reason}")).wrap());
    }
    ui.horizontal_wrapped(|ui| {
        let of_settings = |reason: &Unequal| !matches!(reason, Unequal::Pixels { .. });
        let which = doc.which.name();
        let about = format!(
            "Use {which}'s settings of scene and picture for both. The trees stay different."
        );
        let can_be_made_fair = verdict.reasons.iter().any(of_settings);
        let button = egui::Button::new("Use same conditions");
        if ui
            .add_enabled(can_be_made_fair, button)
            .on_hover_text(about)
            .clicked()
        {
            edits.add(Document::use_same_conditions);
        }
        let button = egui::Button::new("Show the pixels");
        if ui
            .add_enabled(!verdict.pixels.is_empty(), button)
            .on_hover_text("Darken the picture except for the pixels that differ.")
            .clicked()
        {
            edits.add(|doc| {
                doc.comparing.view = View::Difference;
                doc.heatmap = None;
            });
        }
    });
}
