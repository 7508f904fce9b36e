//! The line at the bottom: pixel, colour, sample, rays a second, memory, jobs.

use crate::gui::document::Document;
use crate::gui::widgets::color_text::color_text;
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{JobStatus, Scheduler, Standing};

/// What the line keeps from frame to frame.
#[derive(Default)]
pub struct StatusLine {
    /// Bytes of memory, and when they were asked for in seconds.
    memory: Option<(usize, f64)>,
}

impl StatusLine {
    /// Shows the line.
    pub fn ui(&mut self, ui: &mut egui::Ui, doc: &mut Document) {
        let hovered = doc.hovered.take();
        ui.horizontal(|ui| {
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
            let current = doc.current.as_ref();
            let pixel = match (hovered, current) {
                (Some(([x, y], value)), Some(current)) => {
                    let color = || color_text(current.on_view().picture.get(x, y));
                    format!("Pixel {x}, {y}: {}", value.unwrap_or_else(color))
                }
                _ => "Pixel –".to_owned(),
            };
            // The rest of the line keeps its place whatever the pixel's text is.
            let (rect, _) = ui.allocate_exact_size(
                egui::vec2(
                    400.0_f32.min(0.44 * ui.available_width()),
                    ui.available_height(),
                ),
                egui::Sense::hover(),
            );
            ui.put(rect, |ui: &mut egui::Ui| {
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    ui.add(egui::Label::new(pixel).truncate())
                })
                .inner
            });
            ui.separator();
            let samples = match current {
                Some(current) => format!(
                    "Sample {} of {}",
                    current.sample + 1,
                    current.shown.setup.render.samples
                ),
                None => "Sample –".to_owned(),
            };
            ui.label(samples).on_hover_text("Samples a pixel, so far");
            ui.separator();
            ui.label(
                current
                    .and_then(|c| rays_per_second(&c.shown.measurement))
                    .map_or_else(
                        || "– rays/s".to_owned(),
                        |rays| format!("{} rays/s", grouped(rays as usize)),
                    ),
            )
            .on_hover_text(
                "All rays of the picture by the time on the wall of the timed pass, all threads",
            );
            ui.separator();
            let memory = self.memory(ui.input(|i| i.time));
            ui.label(memory.map_or_else(
                || "Memory –".to_owned(),
                |bytes| format!("Memory {} MiB", grouped(bytes >> 20)),
            ))
            .on_hover_text("Physical memory of this program");
            // At the right end, where it keeps its place.
            let to_the_left = egui::Layout::right_to_left(egui::Align::Center);
            ui.with_layout(to_the_left, |ui| jobs(ui, &doc.jobs));
        });
    }

    fn memory(&mut self, now: f64) -> Option<usize> {
        const EVERY: f64 = 1.0;
        if self.memory.is_none_or(|(_, then)| now - then > EVERY) {
            self.memory = memory_stats::memory_stats().map(|m| (m.physical_mem, now));
        }
        self.memory.map(|(bytes, _)| bytes)
    }
}

/// The live jobs as a menu, to pause, resume or cancel each.
fn jobs(ui: &mut egui::Ui, jobs: &Scheduler) {
    let live = jobs.jobs();
    let listed: Vec<_> = live
        .iter()
        .filter(|job| job.priority.takes_turns())
        .collect();
    let text = match listed.len() {
        0 => "No jobs".to_owned(),
        1 => "1 job".to_owned(),
        count => format!("{count} jobs"),
    };
    let menu = ui.menu_button(text, |ui| {
        if listed.is_empty() {
            ui.weak("Nothing is running.");
        }
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
