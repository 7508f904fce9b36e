//! What the check in the background has found about rays of the picture.

mod study;

use crate::gui::document::Document;
use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::theme::strong;
use crate::measure::judge::Tally;
use crate::present::number::{Digits, counted};
use study::Judging;

/// The checks of the picture on view.
#[derive(Default)]
pub struct VerificationPane {
    judging: Judging,
}

impl Pane for VerificationPane {
    const ID: &'static str = "verification";
    const TITLE: &'static str = "Correctness check";
    const ALIASES: &'static [&'static str] = &["Judge"];
    const ABOUT: &'static str =
        "Whether the tree gives the hits of testing every object, for sampled rays.";
    const REVEALS: &'static [Fact] = &[];

    fn update(&mut self, cx: &mut Cx<'_>) {
        self.judging.receive();
        self.judging.follow(cx.doc);
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let judging = &mut self.judging;
        let mut wanted = !judging.stopped;
        ui.checkbox(&mut wanted, "Check sampled rays")
            .on_hover_text(
                "Once the picture is finished, the hits of sampled rays are compared with those of \
             testing every object. Where they differ, exact arithmetic says why.",
            );
        judging.stopped = !wanted;
        ui.label(progress(judging, doc));
        if judging.result.rays.iter().any(|rays| *rays > 0) {
            result(ui, judging, doc);
        }
    }
}

/// How far the check is, in words.
fn progress(judging: &Judging, doc: &Document) -> String {
    let rays: u64 = judging.result.rays.iter().sum();
    let checked = counted(rays as usize, "ray");
    match judging.progress() {
        _ if judging.stopped => "Stopped".to_owned(),
        _ if judging.complete => format!("{checked} checked"),
        Some(share) => format!(
            "{checked} checked, {} of the sample",
            Digits::Three.percent(share)
        ),
        None => match doc.measuring() {
            Some(what) => format!("Waiting for the end of the {what}"),
            None => "Waiting for the finished picture".to_owned(),
        },
    }
}

fn result(ui: &mut egui::Ui, judging: &Judging, doc: &Document) {
    let mut others = Tally::default();
    for tally in judging.result.others {
        others += tally;
    }
    ui.label(format!(
        "{} · {}",
        counted(others.ties as usize, "tie"),
        counted(others.faults as usize, "fault")
    ))
    .on_hover_text(
        "Rays whose hit differs from that of testing every object. A tie is right, too: objects at \
         the same distance, or a ray exactly on an edge. A fault is wrong.",
    );
    if others.faults > 0 {
        let scene = doc
            .current
            .as_ref()
            .map_or_else(String::new, |c| c.shown.setup.scene.source.to_string());
        ui.label(strong(format!(
            "The tree is wrong. This command writes the faults to files: bspscope verify {scene}"
        )));
    }
}
