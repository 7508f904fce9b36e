//! Progress bars: on standard error, and only if that is a terminal.

use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

const STEPS: u64 = 1000;
const REDRAW: Duration = Duration::from_millis(100);

/// Does a task under a bar that follows its progress; the bar is gone when the task is done.
pub fn with_bar<R>(stage: &str, task: impl FnOnce(&Progress) -> R) -> R {
    let progress = Progress::new();
    if !std::io::stderr().is_terminal() {
        return task(&progress);
    }
    let style = ProgressStyle::with_template("{msg} [{bar:32}] {percent:>3} % {elapsed}")
        .expect("the template is well-formed")
        .progress_chars("=> ");
    let bar = ProgressBar::new(STEPS)
        .with_style(style)
        .with_message(stage.to_owned());
    let (done, is_done) = channel::<()>();
    let watched = progress.clone();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            // Short tasks end before the first look and show nothing.
            while is_done.recv_timeout(REDRAW) == Err(RecvTimeoutError::Timeout) {
                bar.set_position((watched.fraction() * STEPS as f64) as u64);
            }
            bar.finish_and_clear();
        });
        let result = task(&progress);
        drop(done);
        result
    })
}
