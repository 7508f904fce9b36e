//! Progress bars: on standard error, and only if that is a terminal. A command does its work as a job,
//! and the bar shows the stage and the fraction of the jobs that are live.

use crate::jobs::{Scheduler, Slot};
use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

const STEPS: u64 = 1000;
const REDRAW: Duration = Duration::from_millis(100);

/// Does a task as a timed job on this thread, under a bar that is gone when the task is done.
pub fn with_bar<R>(stage: &str, task: impl FnOnce(&Progress) -> R) -> R {
    let scheduler = Scheduler::new(|| ());
    let work = || scheduler.run_here(Slot::named("command"), stage, true, task);
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let style = ProgressStyle::with_template("{msg} [{bar:32}] {percent:>3} % {elapsed}")
        .expect("the template is well-formed")
        .progress_chars("=> ");
    let bar = ProgressBar::new(STEPS).with_style(style);
    let (done, is_done) = channel::<()>();
    std::thread::scope(|scope| {
        // Only draws; the work is on this thread.
        scope.spawn(|| {
            let is_done = is_done;
            // Short tasks end before the first look and show nothing.
            while is_done.recv_timeout(REDRAW) == Err(RecvTimeoutError::Timeout) {
                for job in scheduler.jobs() {
                    bar.set_message(job.stage);
                    bar.set_position((job.fraction * STEPS as f64) as u64);
                }
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}
