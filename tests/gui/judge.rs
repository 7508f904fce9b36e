//! The correctness check in the window: it looks at rays of a finished picture, and can be stopped.

use crate::harness::{Window, click, finish, has, open, open_pane, small, wait};

/// A window on the pane.
fn on_check<'a>() -> Window<'a> {
    let mut window = open(small("teaching"));
    open_pane(&mut window, "Correctness check");
    window
}

#[test]
fn sampled_rays_of_a_finished_picture_are_checked_in_the_background() {
    let mut window = on_check();
    finish(&mut window);
    wait(&mut window, "all rays", |w| {
        has(w, "rays checked") && !has(w, "of the sample") && has(w, "0 faults")
    });
}

#[test]
fn the_check_can_be_stopped_and_started_again() {
    let mut window = on_check();
    click(&mut window, "Check sampled rays");
    finish(&mut window);
    window.run_steps(5);
    assert!(has(&window, "Stopped") && !has(&window, "rays checked"));
    click(&mut window, "Check sampled rays");
    wait(&mut window, "all rays", |w| has(w, "0 faults"));
}
