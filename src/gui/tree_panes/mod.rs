//! The panes about the tree: its outline, histograms of its leaves, its shape, the cost of splitting
//! the selected node, what accuracy costs, where the time goes, and a grid of
//! settings. A pane is one file and one line in [`TreePane::ALL`].

mod cost;
mod find_bar;
mod histograms;
mod icicle;
mod log_axis;
mod outline;
mod rows;
mod sweep;
mod time;
mod trade;

use super::state::State;

/// One of the panes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreePane {
    Outline,
    Histograms,
    Icicle,
    Cost,
    Trade,
    Time,
    Sweep,
}

impl TreePane {
    pub const ALL: [TreePane; 7] = [
        TreePane::Outline,
        TreePane::Histograms,
        TreePane::Icicle,
        TreePane::Cost,
        TreePane::Trade,
        TreePane::Time,
        TreePane::Sweep,
    ];

    /// What its tab says.
    pub const fn title(self) -> &'static str {
        match self {
            TreePane::Outline => "Outline",
            TreePane::Histograms => "Leaf histograms",
            TreePane::Icicle => "Icicle",
            TreePane::Cost => "Split cost",
            TreePane::Trade => "Trade",
            TreePane::Time => "Time",
            TreePane::Sweep => "Sweep",
        }
    }
}

/// What the panes keep.
#[derive(Default)]
pub struct TreePanes {
    outline: outline::Outline,
    histograms: histograms::Histograms,
    icicle: icicle::Icicle,
    cost: cost::CostPane,
    trade: trade::TradePane,
    time: time::TimePane,
    sweep: sweep::SweepPane,
}

impl TreePanes {
    pub fn ui(&mut self, pane: TreePane, ui: &mut egui::Ui, state: &mut State) {
        if state.current.is_none() {
            ui.weak("No tree yet");
            return;
        }
        match pane {
            TreePane::Outline => self.outline.ui(ui, state),
            TreePane::Histograms => self.histograms.ui(ui, state),
            TreePane::Icicle => self.icicle.ui(ui, state),
            TreePane::Cost => self.cost.ui(ui, state),
            TreePane::Trade => self.trade.ui(ui, state),
            TreePane::Time => self.time.ui(ui, state),
            TreePane::Sweep => self.sweep.ui(ui, state),
        }
    }
}

/// What is shown while facts of the tree are being worked out.
fn waiting(ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        ui.spinner();
        ui.label("Working out the facts of the tree …");
    });
}

/// Whether the pointer is in a pane, so that keys go there.
fn is_under_pointer(ui: &egui::Ui) -> bool {
    let rect = ui.max_rect();
    ui.ctx().rect_contains_pointer(ui.layer_id(), rect)
}

/// A number in few characters.
fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.2e}")
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.3}")
    }
}

/// The least 1, 2 or 5 times a power of ten that is at least this.
fn nice_step(least: f64) -> f64 {
    let power = libm::exp10(least.max(f64::MIN_POSITIVE).log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|of| of * power);
    steps
        .into_iter()
        .find(|&step| step >= least)
        .unwrap_or(10.0 * power)
}
