//! What the judge in the background has found of the picture's rays.

use super::{Panel, Side};
use crate::gui::state::State;
use crate::gui::symbol::grouped;
use crate::measure::judge::Tally;

pub(super) const PANEL: Panel = Panel {
    title: "Judge",
    side: Side::Left,
    open: true,
    show,
};

fn show(ui: &mut egui::Ui, state: &mut State) {
    let judging = &mut state.judging;
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
            match state.measuring() {
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
        let scene = state
            .current
            .as_ref()
            .map_or_else(String::new, |c| c.shown.setup.scene.source.to_string());
        ui.strong(format!(
            "The tree is wrong: bspscope verify {scene} writes the faults to files."
        ));
    }
}
