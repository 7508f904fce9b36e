//! Finding the best tree: what is tried, how often, and what is left out.

use crate::support::scenes::scene;
use bspscope::jobs::{End, FindBestTree, Handle, News, Scheduler};
use bspscope::measure::tune::{
    Goal, LeftOut, NAIVE_LIMIT, RUNGS, Row, Search, Tuned, Tuning, Turn, rounds_after,
};
use bspscope::measure::{measure, parameter, variations};
use bspscope::progress::Progress;
use bspscope::scene::SceneRequest;
use bspscope::setup::Setup;
use bspscope::structure::Method;
use bspscope::trace::RenderSettings;
use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

/// More than any of these searches takes.
const ENOUGH: Duration = Duration::from_secs(100_000);

fn search(source: &str, budget: Duration) -> Search {
    let render = RenderSettings {
        width: 24,
        height: 16,
        samples: 4,
        ..RenderSettings::default()
    };
    Search {
        setup: Setup {
            render,
            ..Setup::new(SceneRequest::parse(source))
        },
        goal: Goal::Time,
        rays: None,
        most_bytes: None,
        methods: Method::all().collect(),
        budget,
    }
}

fn start(scheduler: &Scheduler, search: Search) -> Handle<FindBestTree> {
    let scene = Arc::new(scene(&search.setup.scene.source.to_string()));
    scheduler.start(FindBestTree { scene, search })
}

/// What a search sends: its rows as they become known, and its end.
fn found(search: Search) -> (Vec<Row>, End<Tuned>) {
    let scheduler = Scheduler::new(|| ());
    let job = start(&scheduler, search);
    assert!(scheduler.wait());
    let News { partials, end } = job.receive();
    let mut rows = Vec::new();
    for tried in partials {
        if tried.place == rows.len() {
            rows.push(tried.row);
        } else {
            rows[tried.place] = tried.row;
        }
    }
    (rows, end.expect("it has ended"))
}

fn tuned(search: Search) -> Tuned {
    let (rows, end) = found(search);
    match end {
        End::Done(tuned) => {
            assert_eq!(rows, tuned.rows, "the partial results are the whole result");
            tuned
        }
        end => panic!("{end:?}"),
    }
}

fn methods(rows: &[Row]) -> Vec<&'static str> {
    rows.iter().map(|row| row.setup.build.method.name).collect()
}

#[test]
fn all_settings_of_all_methods_are_tried_and_few_are_left() {
    let search = search("balls:2", ENOUGH);
    let tuned = tuned(search.clone());
    // The first rows are the methods with their defaults.
    let all: Vec<_> = Method::all().map(|m| m.name).collect();
    let (first, _) = tuned.rows.split_at(all.len());
    assert_eq!(methods(first), all);
    assert!(first.iter().all(Row::is_default));
    // Every variation is measured, or builds the tree of one that is.
    let same = tuned.left_out.iter();
    let same = same.map(|left_out| match left_out {
        LeftOut::SameTree { setup } => setup,
        other => panic!("{other:?}"),
    });
    let mut tried: Vec<_> = (tuned.rows.iter().map(|row| &row.setup))
        .chain(same)
        .map(|setup| setup.build.in_words())
        .collect();
    let objects = scene("balls:2").objects().len();
    let mut expected: Vec<_> = Method::all()
        .flat_map(|method| variations(method, objects))
        .map(|build| build.in_words())
        .collect();
    tried.sort();
    expected.sort();
    assert!(expected.len() > 200);
    assert_eq!(tried, expected);
    // Each rung has at least half of the candidates of the one before, timed twice as often in all.
    let standing = |rung: usize| tuned.rows.iter().filter(move |row| row.rung >= rung);
    let last = tuned.rows.iter().map(|row| row.rung).max().unwrap();
    assert!(rounds_after(last) >= 8 && last < RUNGS);
    for rung in 1..=last {
        let [before, now] = [rung - 1, rung].map(|rung| standing(rung).count());
        assert!(now >= before.div_ceil(2) && now <= before, "{before} {now}");
    }
    for (i, row) in tuned.rows.iter().enumerate() {
        assert_eq!(
            row.rounds(),
            rounds_after(row.rung),
            "{:?}",
            row.setup.build
        );
        assert!(row.seconds().is_sorted() && row.seconds()[0] > 0.0);
        let is_counted = row.tests_per_ray().is_some();
        assert_eq!(is_counted, row.rung > 0 || row.is_default());
        let is_same = |other: &Row| {
            other.setup.build.method == row.setup.build.method
                && other.measurement.tree == row.measurement.tree
        };
        assert!(!tuned.rows[..i].iter().any(is_same), "{:?}", row.setup);
        // What is recommended is the user's setup with another structure, whatever was measured.
        let setup = Setup {
            build: search.setup.build.clone(),
            ..row.setup.clone()
        };
        assert_eq!(setup, search.setup);
    }
    let (place, recommended) = tuned.recommended();
    assert_eq!(&tuned.rows[place], recommended);
    assert_eq!(recommended.rung, last);
    let least = standing(last).map(|row| row.spread().median);
    assert_eq!(recommended.spread().median, least.fold(f64::MAX, f64::min));
    assert_eq!(tuned.ranking()[0].place, place);
    // A short list has every method, and all that were timed longest.
    let short = tuned.short_ranking();
    let rows = || short.iter().map(|rank| &tuned.rows[rank.place]);
    assert_eq!(
        rows().filter(|row| row.rung == last).count(),
        standing(last).count()
    );
    let named: HashSet<_> = rows().map(|row| row.setup.build.method.name).collect();
    assert_eq!(named.len(), all.len());
    assert!(short.len() < tuned.rows.len());
}

#[test]
fn rows_have_the_counts_of_a_measurement() {
    let mut search = search("balls:2", Duration::ZERO);
    search.setup.render.width = 256;
    search.setup.render.height = 128;
    let tuned = tuned(search.clone());
    assert_eq!([tuned.render.width, tuned.render.height], [128, 64]);
    let scene = scene("balls:2");
    for row in &tuned.rows {
        let build = &row.setup.build;
        let expected = measure(&scene, build, &tuned.render, &Progress::new()).unwrap();
        for symbol in ["N_RPRT", "N_AT", "N_LS", "N_IN", "M_TREE"] {
            let of = |measurement| parameter(symbol).value(measurement);
            let value = of(&row.measurement);
            assert_eq!(value, of(&expected.measurement), "{symbol} {build:?}");
        }
        let rays = expected.measurement.all_rays().unwrap();
        let tests = rays.tests as f64 / rays.rays as f64;
        assert_eq!(row.tests_per_ray(), Some(tests));
        assert_eq!(
            parameter("T_TR").value(&row.measurement),
            Some(row.spread().median)
        );
        if build.method.has_limits {
            assert_eq!(row.nodes(), expected.tree.nodes().len() as u64);
        }
    }
}

#[test]
fn without_a_budget_every_method_is_timed_once_and_the_rest_is_left_out() {
    let tuned = tuned(search("tetra:3", Duration::ZERO));
    let all: Vec<_> = Method::all().map(|m| m.name).collect();
    assert_eq!(methods(&tuned.rows), all);
    assert!(tuned.rows.iter().all(|row| row.rounds() == 1));
    let objects = scene("tetra:3").objects().len();
    let variations = Method::all().map(|method| variations(method, objects).len() - 1);
    let settings = variations.sum();
    let unfinished = LeftOut::Unfinished {
        candidates: all.len().div_ceil(2),
        rounds: 1,
    };
    assert_eq!(tuned.left_out, [LeftOut::Untried { settings }, unfinished]);
}

#[test]
fn testing_every_object_is_left_out_of_large_scenes() {
    let tuned = tuned(search("balls:4", Duration::ZERO));
    let objects = scene("balls:4").objects().len();
    assert!(objects > NAIVE_LIMIT);
    let all = Method::all().map(|m| m.name);
    let all: Vec<_> = all.filter(|name| *name != "none").collect();
    assert_eq!(methods(&tuned.rows), all);
    let method = Method::named("none").unwrap();
    assert_eq!(tuned.left_out[0], LeftOut::Method { method, objects });
}

#[test]
fn trees_beyond_the_memory_limit_are_left_out() {
    let mut search = search("tetra:6", Duration::ZERO);
    search.setup.build.memory_limit = 1 << 20;
    let tuned = tuned(search.clone());
    let refused: Vec<_> = (tuned.left_out.iter())
        .filter_map(|left_out| match left_out {
            LeftOut::Refused { setup, .. } => Some(setup.build.method.name),
            _ => None,
        })
        .collect();
    assert!(refused.contains(&"midpoint"), "{refused:?}");
    let mut both = [methods(&tuned.rows), refused].concat();
    assert!(methods(&tuned.rows).contains(&"none"));
    both.sort_unstable();
    let mut all: Vec<_> = Method::all().map(|m| m.name).collect();
    all.sort_unstable();
    assert_eq!(both, all);

    search.setup.build.memory_limit = 1 << 10;
    match found(search).1 {
        End::Failed(why) => assert!(why.contains("memory limit"), "{why}"),
        end => panic!("{end:?}"),
    }
}

#[test]
fn a_cancelled_search_leaves_nothing_running_and_keeps_its_rows() {
    let scheduler = Scheduler::new(|| ());
    let mut long = search("balls:3", ENOUGH);
    [long.setup.render.width, long.setup.render.height] = [128, 128];
    let job = start(&scheduler, long);
    let mut tried = 0;
    while tried < 3 {
        tried += job.receive().partials.len();
        assert!(job.is_live());
        std::thread::yield_now();
    }
    let jobs = scheduler.jobs();
    assert_eq!(jobs[0].slot, FindBestTree::SLOT);
    let stage = &jobs[0].stage;
    assert!(stage.contains(" candidates, round 1 of 1: "), "{stage}");
    job.cancel();
    assert!(scheduler.wait());
    assert_eq!(scheduler.threads(), 0);
    assert!(matches!(job.receive().end, Some(End::Cancelled)));
}

#[test]
fn a_cancelled_turn_can_be_run_again() {
    let scene = scene("balls:2");
    let mut tuning = Tuning::new(&scene, search("balls:2", ENOUGH)).unwrap();
    let stopped = Progress::new();
    stopped.cancel();
    assert!(tuning.turn(&stopped).unwrap_err().is_cancelled());
    assert_eq!(tuning.rows(), []);
    let turn = |tuning: &mut Tuning<'_>| tuning.turn(&Progress::new()).unwrap();
    assert_eq!(turn(&mut tuning), Some(Turn::Timed(0)));
    assert_eq!(turn(&mut tuning), Some(Turn::Timed(1)));
    let next = tuning.upcoming().unwrap();
    assert_eq!((next.rung, next.rounds), (0, 0));
    assert!(next.candidates > 200, "{}", next.candidates);
    let mut last = 0.0;
    while let Some(next) = tuning.upcoming() {
        assert!((0.0..1.0).contains(&next.fraction));
        last = next.fraction;
        turn(&mut tuning);
    }
    assert!(last > 0.9, "{last}");
    assert_eq!(turn(&mut tuning), None);
}
