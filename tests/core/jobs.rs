//! The jobs behind the window: the latest request wins, stages are reused, nothing is mixed, and a
//! failure leaves the scheduler ready for the next request.

use bspscope::jobs::{Cache, End, Handle, News, RenderPicture, Scheduler, Stage, Update};
use bspscope::measure::heat::{RayFilter, heatmap};
use bspscope::measure::parameter;
use bspscope::scene::SceneRequest;
use bspscope::setup::{Affects, Setup};
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use bspscope::trace::{KernelChoice, Picture, RenderSettings};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// A scheduler with the cache that its pictures share.
struct Pictures {
    scheduler: Scheduler,
    cache: Cache,
    wakes: Arc<AtomicU64>,
}

impl Pictures {
    fn new() -> Pictures {
        let wakes = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&wakes);
        Pictures {
            scheduler: Scheduler::new(move || {
                counted.fetch_add(1, Ordering::Relaxed);
            }),
            cache: Cache::default(),
            wakes,
        }
    }

    fn request(&self, setup: Setup, reload: u64) -> Handle<RenderPicture> {
        self.scheduler.start(RenderPicture {
            setup,
            reload,
            cache: self.cache.clone(),
        })
    }

    /// What a request sends until its end.
    fn answer(&self, setup: Setup, reload: u64) -> (Vec<Update>, End<()>) {
        until_end(&self.request(setup, reload))
    }
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

/// What a job sends until its end.
fn until_end(job: &Handle<RenderPicture>) -> (Vec<Update>, End<()>) {
    while !job.wait(Duration::from_secs(1)) {}
    let News { partials, end } = job.receive();
    (partials, end.expect("it has ended"))
}

fn stages(updates: &[Update]) -> Vec<Stage> {
    let stage = |update: &Update| match update {
        Update::Stage(stage) => Some(*stage),
        _ => None,
    };
    updates.iter().filter_map(stage).collect()
}

#[test]
fn a_request_goes_from_picture_to_complete_figures() {
    let pictures = Pictures::new();
    let mut wanted = request("tetra:3", "midpoint");
    wanted.render.samples = 2;
    let (updates, end) = pictures.answer(wanted, 0);
    assert_eq!(end, End::Done(()));
    assert!(pictures.wakes.load(Ordering::Relaxed) >= updates.len() as u64);
    assert_eq!(
        stages(&updates),
        [
            Stage::Loading,
            Stage::Building,
            Stage::Previewing,
            Stage::Rendering,
            Stage::Counting,
            Stage::Timing,
            Stage::Refining(1, 2)
        ]
    );
    let shown = updates
        .iter()
        .position(|u| matches!(u, Update::Shown(_)))
        .expect("a first picture");
    let first_tile = updates
        .iter()
        .position(|u| matches!(u, Update::Tile { .. }))
        .expect("tiles");
    assert!(shown < first_tile, "tiles refine a picture that is there");
    let complete: Vec<_> = updates
        .iter()
        .filter_map(|u| match u {
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
        .filter_map(|(update, next)| match (update, next) {
            (Update::PixelCounts(counts), Update::Measured { measurement, .. }) => {
                assert_eq!(measurement.counted, complete[0].counted, "the final counts");
                Some(counts)
            }
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
    let pictures = Pictures::new();
    let base = request("tetra:3", "midpoint");
    pictures.answer(base.clone(), 0);

    let mut moved = base.clone();
    moved.render.camera.angle = Some(30.0);
    let (updates, _) = pictures.answer(moved, 0);
    assert_eq!(stages(&updates)[0], Stage::Previewing);

    let mut deeper = base.clone();
    deeper.build.d_max = MaxDepth::Fixed(9);
    let (updates, _) = pictures.answer(deeper, 0);
    assert_eq!(stages(&updates)[0], Stage::Building);

    let (updates, _) = pictures.answer(base, 1);
    assert_eq!(stages(&updates)[0], Stage::Loading);
}

#[test]
fn a_change_of_a_setting_redoes_exactly_what_the_setting_affects() {
    let all = [
        Stage::Loading,
        Stage::Building,
        Stage::Previewing,
        Stage::Rendering,
        Stage::Counting,
        Stage::Timing,
    ];
    let mut tried = Vec::new();
    for (setting, plain, changed) in crate::settings::changed() {
        let of_method = plain.build.method.constants.iter();
        let is_constant = of_method.into_iter().any(|c| c.name == setting.name);
        if !is_constant && plain.build.method.name != "midpoint" {
            continue;
        }
        let mut before = plain;
        (before.render.width, before.render.height) = (8, 8);
        // Small enough for the memory limits among the examples.
        before.build.d_max = MaxDepth::Fixed(5);
        let mut after = before.clone();
        setting.store(&mut after, setting.value(&changed));
        let pictures = Pictures::new();
        let (first, end) = pictures.answer(before, 0);
        assert_eq!((stages(&first), end), (all.to_vec(), End::Done(())));
        let (updates, end) = pictures.answer(after, 0);
        assert_eq!(end, End::Done(()), "{}", setting.name);
        let mut redone = stages(&updates);
        redone.retain(|stage| !matches!(stage, Stage::Refining(..)));
        let expected: &[Stage] = match setting.affects {
            Affects::Scene => &all,
            Affects::Structure => &all[1..],
            Affects::Image => &all[2..],
            Affects::Time => &[Stage::Timing],
        };
        assert_eq!(redone, expected, "{}", setting.name);
        tried.push(setting.affects);
    }
    for affects in [
        Affects::Scene,
        Affects::Structure,
        Affects::Image,
        Affects::Time,
    ] {
        assert!(tried.contains(&affects), "{affects:?}");
    }
}

#[test]
fn a_change_of_times_alone_keeps_the_finished_picture_and_its_counts() {
    let pictures = Pictures::new();
    let mut wanted = request("balls:1", "midpoint");
    wanted.render.samples = 3;
    let complete = |updates: &[Update]| match updates {
        [.., Update::Measured { measurement, .. }] => measurement.clone(),
        _ => panic!("no figures at the end"),
    };
    let (mut first, _) = pictures.answer(wanted.clone(), 0);
    let mut picture = Picture::new(wanted.render.width, wanted.render.height);
    let mut counts = None;
    for update in &first {
        match update {
            Update::Tile {
                tile,
                sample,
                colors,
            } => picture.add_tile(tile, *sample, colors),
            Update::PixelCounts(new) => counts = Some(Arc::clone(new)),
            _ => {}
        }
    }
    first.retain(|update| matches!(update, Update::Measured { complete: true, .. }));

    wanted.render.kernel = KernelChoice::Stream;
    let (second, end) = pictures.answer(wanted.clone(), 0);
    assert_eq!(end, End::Done(()));
    let [
        Update::Shown(shown),
        Update::PixelCounts(same),
        Update::Stage(Stage::Timing),
        Update::Measured { complete: true, .. },
    ] = &second[..]
    else {
        panic!("{second:?}")
    };
    assert_eq!(shown.setup, wanted);
    assert_eq!((&*shown.picture, shown.sample), (&picture, 2));
    assert!(Arc::ptr_eq(same, &counts.unwrap()));
    let (before, after) = (complete(&first), complete(&second));
    assert_eq!(after.counted, before.counted);
    assert_eq!(shown.measurement.counted, before.counted);
    assert_eq!(shown.measurement.rendering, None);
    assert!(after.rendering.is_some() && after.render.kernel == KernelChoice::Stream);
}

#[test]
fn the_latest_request_wins_and_older_ones_end_early() {
    let pictures = Pictures::new();
    let mut heavy = request("balls:4", "none");
    heavy.render.width = 2000;
    heavy.render.height = 2000;
    let first = pictures.request(heavy, 0);
    while first.receive().partials.is_empty() {
        std::thread::yield_now();
    }
    let all: Vec<_> = (1..=8)
        .map(|depth| {
            let mut light = request("tetra:2", "midpoint");
            light.build.d_max = MaxDepth::Fixed(depth);
            pictures.request(light, 0)
        })
        .collect();
    let (last, older) = all.split_last().expect("eight requests");
    let (updates, end) = until_end(last);
    assert_eq!(end, End::Done(()));
    let News { partials, end } = first.receive();
    assert!(partials.is_empty(), "nothing arrives from a replaced job");
    assert_eq!(
        end,
        Some(End::Replaced),
        "rendering 4 million pixels naively takes minutes"
    );
    for job in older {
        let News { partials, end } = job.receive();
        assert!(partials.is_empty() && end == Some(End::Replaced));
    }
    assert!(pictures.scheduler.wait(), "no thread is left");
    let shown: Vec<_> = updates
        .iter()
        .filter_map(|u| match u {
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
    let pictures = Pictures::new();
    let failure = |wanted: Setup| match pictures.answer(wanted, 0).1 {
        End::Failed(reason) => reason,
        end => panic!("{end:?}"),
    };
    let reason = failure(request("no-such-file.nff", "midpoint"));
    assert!(reason.contains("no-such-file.nff"), "{reason}");

    let mut greedy = request("tetra:5", "midpoint");
    greedy.build.memory_limit = 1 << 16;
    let reason = failure(greedy);
    assert!(reason.contains("memory limit"), "{reason}");

    let mut blind = request("tetra:3", "midpoint");
    blind.render.camera.angle = Some(180.0);
    failure(blind);

    let (_, end) = pictures.answer(request("tetra:3", "sah-cut"), 0);
    assert_eq!(end, End::Done(()));
}

#[test]
fn the_tree_before_the_last_is_at_hand() {
    let pictures = Pictures::new();
    let served = |wanted: &Setup| stages(&pictures.answer(wanted.clone(), 0).0);
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
        assert!(again.contains(&Stage::Timing));
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
