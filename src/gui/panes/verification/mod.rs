//! What the judge in the background has found of the picture's rays.

mod study;

use crate::gui::pane::{Cx, Fact, Pane};
use crate::gui::widgets::symbol::grouped;
use crate::measure::judge::Tally;
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
        let doc = &*cx.doc;
        let judging = &mut self.judging;
        let mut wanted = !judging.stopped;
        ui.checkbox(&mut wanted, "check sampled rays").on_hover_text(
        "Once the picture is finished, sampled rays of it are asked of the tree and of every object, \
         in the background. Where answers differ, exact arithmetic says why.",
    );
        judging.stopped = !wanted;
        let mut others = Tally::default();
        for tally in judging.result.others {
            others += tally;
        }
        let rays: u64 = judging.result.rays.iter().sum();
        match judging.progress() {
            _ if judging.stopped => ui.weak("Stopped"),
            _ if judging.complete => ui.label(format!("{} rays checked", grouped(rays as usize))),
            Some(share) => ui.label(format!(
                "{} rays checked, {:.0} % of the sample",
                grouped(rays as usize),
                share * 100.0
            )),
            None => ui.weak(format!(
                "Waits for {}",
                match doc.measuring() {
                    Some(what) => format!("the end of the {what}"),
                    None => "the finished picture".to_owned(),
                }
            )),
        };
        if rays == 0 {
            return;
        }
        ui.label(format!(
        "{} ties · {} faults",
        grouped(others.ties as usize),
        grouped(others.faults as usize)
    ))
    .on_hover_text(
        "Other answers than testing every object gives. A tie is exactly right, too: objects at the \
         same distance, or a ray just on an edge. A fault is wrong.",
    );
        if others.faults > 0 {
            let scene = doc
                .current
                .as_ref()
                .map_or_else(String::new, |c| c.shown.setup.scene.source.to_string());
            ui.strong(format!(
                "The tree is wrong: bspscope verify {scene} writes the faults to files."
            ));
        }
    }
}
