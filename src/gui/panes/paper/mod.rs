//! The paper's experiment, repeated in the background: its tables, printed beside computed.

use crate::gui::action::{actions, tip};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::theme::heading;
use crate::jobs::{End, Handle, News, RepeatPaper, Scheduler, Standing};
use crate::measure::paper::{Cell, Conditions, Mark, PaperScene, Reproduction, Row, SCENES};
use crate::present::number::Digits;
use crate::present::words::printed_unit;

/// The experiment, as far as it has been done.
struct Experiment {
    /// The scenes to be measured, by place in [`SCENES`].
    chosen: [bool; SCENES.len()],
    /// The scene whose tables are shown, likewise.
    shown: usize,
    results: [Option<Reproduction>; SCENES.len()],
    running: Option<Handle<RepeatPaper>>,
    /// Why it ended before it was done.
    ended: Option<String>,
}

impl Default for Experiment {
    fn default() -> Self {
        Experiment {
            chosen: [true; SCENES.len()],
            shown: 0,
            results: [const { None }; SCENES.len()],
            running: None,
            ended: None,
        }
    }
}

impl Experiment {
    /// Measures the chosen scenes, or cancels that. What was measured stays.
    fn start_or_cancel(&mut self, threads: usize, jobs: &Scheduler) {
        if let Some(handle) = &self.running {
            handle.cancel();
            self.receive();
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
        self.running = Some(jobs.start(RepeatPaper {
            scenes: scenes.into_iter().map(|scene| &SCENES[scene]).collect(),
            conditions: Conditions {
                threads,
                ..Conditions::default()
            },
        }));
    }

    /// Receives what was measured.
    fn receive(&mut self) {
        let Some(handle) = &self.running else {
            return;
        };
        let News { partials, end } = handle.receive();
        for result in partials {
            let same = |scene: &PaperScene| scene.name == result.scene.name;
            if let Some(place) = SCENES.iter().position(same) {
                self.results[place] = Some(result);
                self.shown = place;
            }
        }
        if let Some(end) = end {
            self.running = None;
            self.ended = match end {
                End::Done(_) | End::Replaced => None,
                End::Cancelled => Some("Cancelled; what was measured stays.".into()),
                End::Failed(why) => Some(format!("Failed: {why}")),
            };
        }
    }
}

/// The paper's tables, printed beside computed.
#[derive(Default)]
pub struct PaperPane {
    experiment: Experiment,
}

impl Pane for PaperPane {
    const ID: &'static str = "paper";
    const TITLE: &'static str = "Paper's tables";
    const ALIASES: &'static [&'static str] = &["The paper's tables"];
    const ABOUT: &'static str =
        "The paper's experiment, repeated: printed figures beside computed ones.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "paper.run" Everywhere COMMAND [U] "Repeat the paper's experiment, or cancel it" => |pane, cx| {
            pane.experiment.start_or_cancel(cx.doc.wanted.render.threads, &cx.doc.jobs);
            cx.edits.request(Request::Show(Self::ID));
        };
    };

    fn update(&mut self, _: &mut Cx<'_>) {
        self.experiment.receive();
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let experiment = &mut self.experiment;
        choice(ui, experiment);
        standing(ui, experiment, doc.wanted.render.threads, &doc.jobs);
        let Some(result) = &experiment.results[experiment.shown] else {
            ui.weak(format!(
                "{}: not measured yet",
                SCENES[experiment.shown].name
            ));
            return;
        };
        egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            legend(ui);
            tables(ui, result);
        });
    }
}

/// Which scenes are measured, and which one is shown.
fn choice(ui: &mut egui::Ui, experiment: &mut Experiment) {
    let running = experiment.running.is_some();
    ui.horizontal_wrapped(|ui| {
        for (scene, chosen) in SCENES.iter().zip(&mut experiment.chosen) {
            ui.add_enabled(!running, egui::Checkbox::new(chosen, scene.name))
                .on_hover_text(if scene.published {
                    "Measure this scene."
                } else {
                    "Measure this scene, a reconstruction: the paper's scene was never published."
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

/// How far the experiment is, with the button that starts or cancels it.
fn standing(ui: &mut egui::Ui, experiment: &mut Experiment, threads: usize, jobs: &Scheduler) {
    let (name, about) = match experiment.running {
        None => (
            "Repeat the experiment",
            "Measure the chosen scenes with both methods, as the paper did: 512 × 512 pixels, \
             cylinders as 10 polygons. All scenes take about half a minute.",
        ),
        Some(_) => ("Cancel the experiment", "What was measured stays."),
    };
    let enabled = experiment.chosen.contains(&true);
    let button = ui.add_enabled(enabled, egui::Button::new(name));
    if button.on_hover_text(tip(about, "paper.run")).clicked() {
        experiment.start_or_cancel(threads, jobs);
    }
    if let Some(status) = experiment.running.as_ref().and_then(Handle::status) {
        let fraction = status.fraction;
        let text = match status.standing {
            Standing::Running => {
                let done = Digits::Three.percent(fraction);
                format!("{}: {done} of this stage", status.stage)
            }
            Standing::Waiting | Standing::Paused => "waiting for the picture".to_owned(),
        };
        ui.add(egui::ProgressBar::new(fraction as f32).text(&text));
        ui.ctx().request_repaint_after_secs(0.1);
    }
    if let Some(why) = &experiment.ended {
        ui.label(why);
    }
}

fn legend(ui: &mut egui::Ui) {
    let marks = [Mark::Equal, Mark::SameDirection, Mark::Differs];
    let marks = marks.map(|mark| format!("{} {}", mark.sign(), mark.name()));
    ui.label(marks.join(" · ")).on_hover_text(
        "How the computed figure, above, compares with the printed one, below. A direction is that \
         of the change from method 1 to method 2.",
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
    let of_properties = format!("Table {}", scene.table);
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 32.0;
        // A number that is broken is two numbers.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        ui.vertical(|ui| {
            table(ui, &of_properties, &["1", "2", "2/1"], &result.properties());
        });
        ui.vertical(|ui| table(ui, "Table 4", &[scene.name], &result.characteristics()));
    });
}

fn table<const COLUMNS: usize>(
    ui: &mut egui::Ui,
    title: &str,
    columns: &[&str; COLUMNS],
    rows: &[Row<COLUMNS>],
) {
    ui.label(heading(title));
    egui::Grid::new(title)
        .num_columns(COLUMNS + 1)
        .striped(true)
        .spacing([16.0, 4.0])
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
