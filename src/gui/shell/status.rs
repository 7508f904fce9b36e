//! The right end of the bottom strip: work in progress, the pixel under the pointer, jobs.

use crate::gui::action::shortcut;
use crate::gui::document::Document;
use crate::gui::theme;
use crate::gui::widgets::color_text::color_text;
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{JobStatus, Priority, Scheduler, Standing};

/// What the line keeps from frame to frame.
#[derive(Default)]
pub struct StatusLine {
    /// Bytes of memory, and when they were asked for in seconds.
    memory: Option<(usize, f64)>,
    /// The work in progress; `None` while there is nothing to say.
    pub progress: Option<String>,
}

impl StatusLine {
    /// Shows jobs, then what is worked on or what is under the pointer, from right to left.
    pub fn ui(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        let memory = self.memory(ui.input(|i| i.time));
        jobs(ui, &doc.jobs);
        let rest = ui.available_rect_before_wrap();
        ui.interact(rest, ui.scope_id().with("facts"), egui::Sense::hover())
            .on_hover_text(facts(doc, memory));
        let hovered = doc.hovered.take();
        let current = doc.current.as_ref();
        let text = match (&self.progress, hovered, current) {
            (Some(progress), ..) => progress.clone(),
            (None, Some(([x, y], value)), Some(current)) => {
                let color = || color_text(current.on_view().picture.get(x, y));
                format!("Pixel {x}, {y}: {}", value.unwrap_or_else(color))
            }
            _ if doc.stopped => format!("Stopped · {} resumes", shortcut("window.again")),
            _ => return,
        };
        ui.add(egui::Label::new(theme::hint(&text)).truncate())
            .on_hover_text(text);
    }

    fn memory(&mut self, now: f64) -> Option<usize> {
        const EVERY: f64 = 1.0;
        if self.memory.is_none_or(|(_, then)| now - then > EVERY) {
            self.memory = memory_stats::memory_stats().map(|m| (m.physical_mem, now));
        }
        self.memory.map(|(bytes, _)| bytes)
    }
}

/// Samples, speed and memory, for a tooltip.
fn facts(doc: &Document, memory: Option<usize>) -> String {
    let mut text = "Speed and memory".to_owned();
    if let Some(current) = &doc.current {
        let (sample, of) = (current.sample + 1, current.shown.setup.render.samples);
        text += &format!("\nSamples per pixel: {sample} of {of}");
        if let Some(rays) = rays_per_second(&current.shown.measurement) {
            let rays = grouped(rays as usize);
            text += &format!("\n{rays} rays/s: all rays of the picture, elapsed time, all threads");
        }
    }
    if let Some(bytes) = memory {
        let mebibytes = grouped(bytes >> 20);
        text += &format!("\n{mebibytes} MiB of memory used by this program");
    }
    text
}

/// The live jobs as a menu, to pause, resume or cancel each.
fn jobs(ui: &mut egui::Ui, jobs: &Scheduler) {
    let live = jobs.jobs();
    let listed: Vec<_> = live
        .iter()
        .filter(|job| job.priority.takes_turns() && job.priority != Priority::Idle)
        .collect();
    let text = match listed.len() {
        0 => return,
        1 => "1 job".to_owned(),
        count => format!("{count} jobs"),
    };
    let menu = ui.menu_button(text, |ui| {
        for job in &listed {
            ui.horizontal(|ui| row(ui, job, jobs));
        }
        ui.ctx().request_repaint_after_secs(0.2);
    });
    menu.response.on_hover_text("What runs in the background");
}

fn row(ui: &mut egui::Ui, job: &JobStatus, jobs: &Scheduler) {
    let name = job.slot.name();
    let standing = match job.standing {
        Standing::Running => format!("{:.0} %", job.fraction * 100.0),
        Standing::Waiting => "waits".to_owned(),
        Standing::Paused => "paused".to_owned(),
    };
    ui.label(format!("{name}: {} · {standing}", job.stage));
    let (pause, about) = match job.is_paused {
        false => ("Pause", "Pause before the next measurement."),
        true => ("Resume", "Let it go on."),
    };
    let pause = ui.button(pause).on_hover_text(about);
    if pause.clicked() && job.is_paused {
        jobs.resume(job.slot);
    } else if pause.clicked() {
        jobs.pause(job.slot);
    }
    let cancel = ui.button("Cancel").on_hover_text("What was found stays.");
    if cancel.clicked() {
        jobs.cancel_where(|other| other.slot == job.slot);
    }
}

/// `None` until all rays are counted.
fn rays_per_second(measurement: &crate::measure::Measurement) -> Option<f64> {
    let wall = measurement.rendering?.wall.as_secs_f64();
    let primary = measurement.tally(crate::trace::RayKind::Primary)?.rays;
    let pixels = u64::from(measurement.render.width) * u64::from(measurement.render.height);
    let rays = measurement.all_rays()?.rays;
    (primary == pixels && wall > 0.0).then(|| rays as f64 / wall)
}
