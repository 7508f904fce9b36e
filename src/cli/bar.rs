//! Progress bars: on standard error, and only if that is a terminal. A command does its work as a job,
//! and the bar shows the job's stage and fraction.

use crate::jobs::{End, Job, JobStatus, News, Scheduler, Slot};
use crate::progress::Progress;
use anyhow::{Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

const STEPS: u64 = 1000;
const REDRAW: Duration = Duration::from_millis(100);

/// A bar; `None` without a terminal.
fn bar() -> Option<ProgressBar> {
    if !std::io::stderr().is_terminal() {
        return None;
    }
    let style = ProgressStyle::with_template("{msg} [{bar:32}] {percent:>3} % {elapsed}")
        .expect("the template is well-formed")
        .progress_chars("=> ");
    Some(ProgressBar::new(STEPS).with_style(style))
}

fn draw(bar: &ProgressBar, job: JobStatus) {
    bar.set_message(job.stage);
    bar.set_position((job.fraction * STEPS as f64) as u64);
}

/// Runs a job under a bar that is gone when the job has ended. `on_partial` receives its partial
/// results; if it fails, the job is cancelled.
///
/// # Errors
/// Why the job or `on_partial` failed.
pub fn follow<J: Job>(
    job: J,
    mut on_partial: impl FnMut(J::Partial) -> Result<()>,
) -> Result<J::Output> {
    let scheduler = Scheduler::new(|| ());
    let (handle, bar) = (scheduler.start(job), bar());
    loop {
        handle.wait(REDRAW);
        let News { partials, end } = handle.receive();
        partials.into_iter().try_for_each(&mut on_partial)?;
        if end.is_some()
            && let Some(bar) = &bar
        {
            bar.finish_and_clear();
        }
        match (end, &bar, handle.status()) {
            (Some(End::Done(output)), ..) => return Ok(output),
            (Some(End::Failed(why)), ..) => bail!(why),
            (Some(End::Cancelled | End::Replaced), ..) => bail!("cancelled"),
            (None, Some(bar), Some(job)) => draw(bar, job),
            (None, ..) => {}
        }
    }
}

/// Does a task as a timed job on this thread, under a bar that is gone when the task is done.
pub fn with_bar<R>(stage: &str, task: impl FnOnce(&Progress) -> R) -> R {
    let scheduler = Scheduler::new(|| ());
    let work = || scheduler.run_here(Slot::named("command"), stage, true, task);
    let Some(bar) = bar() else {
        return work();
    };
    let (done, is_done) = channel::<()>();
    std::thread::scope(|scope| {
        // Only draws; the work is on this thread.
        scope.spawn(|| {
            let is_done = is_done;
            // Short tasks end before the first look and show nothing.
            while is_done.recv_timeout(REDRAW) == Err(RecvTimeoutError::Timeout) {
                for job in scheduler.jobs() {
                    draw(&bar, job);
                }
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}
