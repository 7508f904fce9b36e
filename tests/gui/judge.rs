//! The judge in the window: it looks at the rays of a finished picture, and can be stopped.

use crate::harness::{click, finish, has, open, open_sized, small, wait};

#[test]
fn sampled_rays_of_a_finished_picture_are_checked_in_the_background() {
    let mut window = open(small("teaching"));
    finish(&mut window);
    wait(&mut window, "all rays", |w| {
        has(w, "rays checked") && !has(w, "of the sample") && has(w, "0 faults")
    });
}

#[test]
fn the_judge_stops_when_told_and_begins_again() {
    // High enough for the box to be in view.
    let mut window = open_sized(small("teaching"), [1500.0, 1400.0], false);
    // Once the scene's facts stand above it, the box stays where it is.
    wait(&mut window, "a window", |w| {
        has(w, "lights: ") && has(w, "check sampled rays")
    });
    click(&mut window, "check sampled rays");
    finish(&mut window);
    window.run_steps(5);
    assert!(has(&window, "Stopped") && !has(&window, "rays checked"));
    click(&mut window, "check sampled rays");
    wait(&mut window, "all rays", |w| has(w, "0 faults"));
}
