//! The paper's experiment, repeated in the background: its tables, printed beside computed.

use super::{Panel, Side};
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::State;
use crate::measure::paper::{Cell, Conditions, Mark, Reproduction, Row, SCENES, reproduce};
use crate::present::words::printed_unit;
use crate::progress::Progress;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

pub const PANEL: Panel = Panel {
    title: "The paper's tables",
    side: Side::Right,
    open: false,
    show,
};

/// The experiment as far as it is done.
pub struct Experiment {
    /// The scenes to be measured, by place in [`SCENES`].
    chosen: [bool; SCENES.len()],
    /// The scene whose tables are shown, likewise.
    shown: usize,
    results: [Option<Reproduction>; SCENES.len()],
    run: Option<Run>,
    /// Why it ended before it was done.
    ended: Option<String>,
}

/// An experiment on its way; dropping it cancels it.
struct Run {
    progress: Progress,
    news: Receiver<News>,
    /// The scene that is measured now.
    scene: usize,
}

enum News {
    Began(usize),
    Measured(usize, Box<Reproduction>),
    Failed(String),
}

impl Drop for Run {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

impl Default for Experiment {
    fn default() -> Self {
        Experiment {
            chosen: [true; SCENES.len()],
            shown: 0,
            results: [const { None }; SCENES.len()],
            run: None,
            ended: None,
        }
    }
}

impl Experiment {
    /// Measures the chosen scenes on a thread; or cancels that, and what is measured stays.
    pub fn start_or_cancel(&mut self, threads: usize, ctx: &egui::Context) {
        if self.run.take().is_some() {
            self.ended = Some("cancelled; what was measured stays".into());
            return;
        }
        let scenes: Vec<usize> = (0..SCENES.len()).filter(|&i| self.chosen[i]).collect();
        let Some(&first) = scenes.first() else {
            return;
        };
        for &scene in &scenes {
            self.results[scene] = None;
        }
        self.ended = None;
        self.shown = first;
        let (sender, news) = channel();
        let progress = Progress::new();
        self.run = Some(Run {
            progress: progress.clone(),
            news,
            scene: first,
        });
        let conditions = Conditions {
            threads,
            ..Conditions::default()
        };
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let tell = |news| tell(&sender, news, &ctx);
            for scene in scenes {
                tell(News::Began(scene));
                let result = reproduce(&SCENES[scene], &conditions, &progress, |partial| {
                    tell(News::Measured(scene, Box::new(partial.clone())));
                });
                if let Err(error) = result {
                    tell(News::Failed(error.to_string()));
                    break;
                }
            }
            drop(sender);
            ctx.request_repaint();
        });
    }

    /// Takes what the thread has to tell.
    fn receive(&mut self) {
        while let Some(run) = &mut self.run {
            match run.news.try_recv() {
                Ok(News::Began(scene)) => run.scene = scene,
                Ok(News::Measured(scene, result)) => {
                    self.results[scene] = Some(*result);
                    self.shown = scene;
                }
                Ok(News::Failed(why)) => self.ended = Some(why),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => self.run = None,
            }
        }
    }
}

fn tell(sender: &Sender<News>, news: News, ctx: &egui::Context) {
    // If nobody listens any more, the news is not needed.
    let _ = sender.send(news);
    ctx.request_repaint();
}

fn show(ui: &mut egui::Ui, state: &mut State) {
    let threads = state.wanted.render.threads;
    let experiment = &mut state.experiment;
    experiment.receive();
    choice(ui, experiment);
    standing(ui, experiment, threads);
    let Some(result) = &experiment.results[experiment.shown] else {
        ui.weak(format!(
            "{}: not measured yet",
            SCENES[experiment.shown].name
        ));
        return;
    };
    legend(ui);
    tables(ui, result);
}

/// Which scenes are measured, and which one is shown.
fn choice(ui: &mut egui::Ui, experiment: &mut Experiment) {
    let running = experiment.run.is_some();
    ui.horizontal_wrapped(|ui| {
        for (scene, chosen) in SCENES.iter().zip(&mut experiment.chosen) {
            ui.add_enabled(!running, egui::Checkbox::new(chosen, scene.name))
                .on_hover_text(if scene.published {
                    "Measure this scene."
                } else {
                    "Measure this scene; it is a reconstruction, the paper's was never published."
                });
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (i, scene) in SCENES.iter().enumerate() {
            ui.selectable_value(&mut experiment.shown, i, format!("show {}", scene.name))
                .on_hover_text(format!("Tables 4 and {} for {}", scene.table, scene.name));
        }
    });
}

/// How far the experiment is, with the button that begins or cancels it.
fn standing(ui: &mut egui::Ui, experiment: &mut Experiment, threads: usize) {
    let (name, about) = match experiment.run {
        None => (
            "Repeat the experiment",
            "Measure the chosen scenes with both methods, as the paper did: 512 × 512 pixels, \
             cylinders as 10 polygons. Takes about half a minute for all.",
        ),
        Some(_) => ("Cancel the experiment", "What is measured stays."),
    };
    let enabled = experiment.chosen.contains(&true);
    let button = ui.add_enabled(enabled, egui::Button::new(name));
    if button.on_hover_text(tip(about, Action::Paper)).clicked() {
        experiment.start_or_cancel(threads, ui.ctx());
    }
    if let Some(run) = &experiment.run {
        let fraction = run.progress.fraction();
        let text = format!(
            "{}: {:.0} % of a stage",
            SCENES[run.scene].name,
            fraction * 100.0
        );
        ui.add(egui::ProgressBar::new(fraction as f32).text(&text));
        ui.ctx().request_repaint_after_secs(0.1);
    }
    if let Some(why) = &experiment.ended {
        ui.label(format!("Ended: {why}"));
    }
}

fn legend(ui: &mut egui::Ui) {
    let marks = [Mark::Equal, Mark::SameDirection, Mark::Differs];
    let marks = marks.map(|mark| format!("{} {}", mark.sign(), mark.name()));
    ui.label(marks.join(" · ")).on_hover_text(
        "How the computed figure, above, relates to the printed one, below. Directions are those \
         from method 1 to method 2.",
    );
}

fn tables(ui: &mut egui::Ui, result: &Reproduction) {
    let scene = result.scene;
    for note in &result.notes {
        ui.add(egui::Label::new(note).wrap());
    }
    for reason in result.unequal.iter().flatten() {
        ui.add(egui::Label::new(format!("The methods are not comparable: {reason}")).wrap());
    }
    table(
        ui,
        &format!("Table {}", scene.table),
        &["1", "2", "2/1"],
        &result.properties(),
    );
    table(ui, "Table 4", &[scene.name], &result.characteristics());
}

fn table<const COLUMNS: usize>(
    ui: &mut egui::Ui,
    title: &str,
    columns: &[&str; COLUMNS],
    rows: &[Row<COLUMNS>],
) {
    ui.add_space(4.0);
    ui.strong(title);
    egui::Grid::new(title)
        .num_columns(COLUMNS + 1)
        .striped(true)
        .show(ui, |ui| {
            ui.label("");
            for column in columns {
                ui.strong(*column);
            }
            ui.end_row();
            for row in rows {
                let parameter = row.parameter;
                ui.label(egui::RichText::new(parameter.symbol).monospace())
                    .on_hover_text(format!("{}: {}", parameter.name, parameter.meaning));
                for (i, figure) in row.cells.iter().enumerate() {
                    cell(ui, figure, printed_unit(parameter, COLUMNS == 3 && i == 2));
                }
                ui.end_row();
            }
        });
}

/// The computed figure with its mark, above the printed one.
fn cell(ui: &mut egui::Ui, cell: &Cell, unit: &str) {
    let (sign, mark) = match cell.mark {
        Some(mark) => (mark.sign(), mark.name()),
        None => ("", "not measured yet"),
    };
    let computed = cell.computed_text();
    let mut about = format!(
        "Printed: {} {unit}\nComputed: {computed} {unit}\nMark: {mark}",
        cell.printed
    );
    if let Some(note) = cell.note {
        about += &format!("\n\n{note}");
    }
    ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let text = format!("{computed} {unit} {sign}");
        ui.label(egui::RichText::new(text).monospace());
        ui.weak(format!("{} {unit}", cell.printed));
    })
    .response
    .on_hover_text(about);
}
