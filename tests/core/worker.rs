//! The background worker: the latest request wins, stages are reused, nothing is mixed, and a
//! failure leaves the thread ready for the next request.

use bspscope::measure::heat::{RayFilter, heatmap};
use bspscope::measure::parameter;
use bspscope::scene::SceneRequest;
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use bspscope::trace::RenderSettings;
use bspscope::worker::{Numbered, Stage, Update, Worker};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

fn start() -> (Worker, Receiver<()>) {
    let (wake, woken) = channel();
    let worker = Worker::start(move || {
        // The test may have ended.
        let _ = wake.send(());
    });
    (worker, woken)
}

fn request(scene: &str, method: &str) -> Setup {
    Setup {
        scene: SceneRequest::parse(scene),
        build: BuildSettings::for_method(Method::named(method).unwrap()),
        render: RenderSettings {
            width: 64,
            height: 48,
            ..RenderSettings::default()
        },
    }
}

/// Collects updates until the request with this number is done or failed.
fn until_end(worker: &Worker, woken: &Receiver<()>, number: u64) -> Vec<Numbered> {
    let mut all = Vec::new();
    let deadline = Instant::now() + Duration::from_secs(120);
    loop {
        assert!(Instant::now() < deadline, "no end of request {number}");
        let _ = woken.recv_timeout(Duration::from_millis(50));
        for update in worker.updates() {
            let end = update.request == number
                && matches!(update.update, Update::Done | Update::Failed(_));
            all.push(update);
            if end {
                return all;
            }
        }
    }
}

fn stages(updates: &[Numbered], number: u64) -> Vec<Stage> {
    updates
        .iter()
        .filter(|u| u.request == number)
        .filter_map(|u| match u.update {
            Update::Stage(stage, _) => Some(stage),
            _ => None,
        })
        .collect()
}

#[test]
fn a_request_goes_from_picture_to_complete_figures() {
    let (worker, woken) = start();
    let mut wanted = request("tetra:3", "midpoint");
    wanted.render.samples = 2;
    let number = worker.request(wanted, 0);
    let updates = until_end(&worker, &woken, number);
    assert_eq!(
        stages(&updates, number),
        [
            Stage::Loading,
            Stage::Building,
            Stage::Previewing,
            Stage::Tracing,
            Stage::Counting,
            Stage::Refining(1, 2)
        ]
    );
    let shown = updates
        .iter()
        .position(|u| matches!(u.update, Update::Shown(_)))
        .expect("a first picture");
    let first_tile = updates
        .iter()
        .position(|u| matches!(u.update, Update::Tile { .. }))
        .expect("tiles");
    assert!(shown < first_tile, "tiles refine a picture that is there");
    let complete: Vec<_> = updates
        .iter()
        .filter_map(|u| match &u.update {
            Update::Measured {
                measurement,
                complete: true,
            } => Some(measurement),
            _ => None,
        })
        .collect();
    assert_eq!(complete.len(), 1);
    let every_pixel: Vec<_> = updates
        .iter()
        .zip(&updates[1..])
        .filter_map(|(update, next)| match (&update.update, &next.update) {
            (Update::PixelCounts(counts), Update::Measured { complete: true, .. }) => Some(counts),
            (Update::PixelCounts(_), next) => panic!("counts of pixels before {next:?}"),
            _ => None,
        })
        .collect();
    assert_eq!(every_pixel.len(), 1);
    assert_eq!(
        heatmap("N_NODES").and_then(|nodes| nodes.total(every_pixel[0], RayFilter::All)),
        parameter("N_NODES").value(complete[0])
    );
    assert!(complete[0].rendering.is_some() && complete[0].counted.is_some());
}

#[test]
fn only_what_changed_is_done_again() {
    let (worker, woken) = start();
    let base = request("tetra:3", "midpoint");
    let number = worker.request(base.clone(), 0);
    until_end(&worker, &woken, number);

    let mut moved = base.clone();
    moved.render.camera.angle = Some(30.0);
    let number = worker.request(moved, 0);
    let updates = until_end(&worker, &woken, number);
    assert_eq!(stages(&updates, number)[0], Stage::Previewing);

    let mut deeper = base.clone();
    deeper.build.d_max = MaxDepth::Fixed(9);
    let number = worker.request(deeper, 0);
    let updates = until_end(&worker, &woken, number);
    assert_eq!(stages(&updates, number)[0], Stage::Building);

    let number = worker.request(base, 1);
    let updates = until_end(&worker, &woken, number);
    assert_eq!(stages(&updates, number)[0], Stage::Loading);
}

#[test]
fn the_latest_request_wins_and_older_ones_end_early() {
    let (worker, woken) = start();
    let mut heavy = request("balls:4", "none");
    heavy.render.width = 2000;
    heavy.render.height = 2000;
    let first = worker.request(heavy, 0);
    std::thread::sleep(Duration::from_millis(300));
    let mut last = 0;
    for depth in 1..=8 {
        let mut light = request("tetra:2", "midpoint");
        light.build.d_max = MaxDepth::Fixed(depth);
        last = worker.request(light, 0);
    }
    let updates = until_end(&worker, &woken, last);
    let ended = |number| {
        updates
            .iter()
            .any(|u| u.request == number && matches!(u.update, Update::Done))
    };
    assert!(
        !ended(first),
        "tracing 4 million pixels naively takes minutes"
    );
    assert!(ended(last));
    let shown: Vec<_> = updates
        .iter()
        .filter(|u| u.request == last)
        .filter_map(|u| match &u.update {
            Update::Shown(shown) => Some(shown),
            _ => None,
        })
        .collect();
    assert_eq!(shown.len(), 1);
    assert_eq!(shown[0].tree.depth_limit(), 8);
    assert_eq!(shown[0].measurement.depth_limit, 8);
}

#[test]
fn a_failure_is_told_and_the_next_request_works() {
    let (worker, woken) = start();
    let number = worker.request(request("no-such-file.nff", "midpoint"), 0);
    let updates = until_end(&worker, &woken, number);
    let Update::Failed(reason) = &updates.last().unwrap().update else {
        panic!("{updates:?}");
    };
    assert!(reason.contains("no-such-file.nff"), "{reason}");

    let mut greedy = request("tetra:5", "midpoint");
    greedy.build.memory_limit = 1 << 16;
    let number = worker.request(greedy, 0);
    let updates = until_end(&worker, &woken, number);
    let Update::Failed(reason) = &updates.last().unwrap().update else {
        panic!("{updates:?}");
    };
    assert!(reason.contains("memory limit"), "{reason}");

    let mut blind = request("tetra:3", "midpoint");
    blind.render.camera.angle = Some(180.0);
    let number = worker.request(blind, 0);
    let updates = until_end(&worker, &woken, number);
    assert!(matches!(updates.last().unwrap().update, Update::Failed(_)));

    let number = worker.request(request("tetra:3", "sah-cut"), 0);
    let updates = until_end(&worker, &woken, number);
    assert!(matches!(updates.last().unwrap().update, Update::Done));
}

#[test]
fn the_tree_before_the_last_is_at_hand() {
    let (worker, woken) = start();
    let served = |wanted: &Setup| {
        let number = worker.request(wanted.clone(), 0);
        stages(&until_end(&worker, &woken, number), number)
    };
    let (a, b) = (
        request("tetra:3", "midpoint"),
        request("tetra:3", "sah-cut"),
    );
    for wanted in [&a, &b] {
        assert!(served(wanted).contains(&Stage::Building));
    }
    for wanted in [&a, &b, &a] {
        let again = served(wanted);
        assert!(!again.contains(&Stage::Loading) && !again.contains(&Stage::Building));
        assert!(again.contains(&Stage::Tracing));
    }
    // A third takes the place of the one used less lately.
    let third = request("tetra:3", "object-median");
    assert!(served(&third).contains(&Stage::Building));
    assert!(!served(&a).contains(&Stage::Building));
    assert!(served(&b).contains(&Stage::Building));
    // Another scene's trees are of no use.
    assert!(served(&request("tetra:2", "midpoint")).contains(&Stage::Loading));
    assert!(served(&a).contains(&Stage::Loading));
}
