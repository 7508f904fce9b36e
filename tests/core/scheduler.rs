//! The scheduler of jobs: whatever is requested in whatever order, it comes to rest with the last
//! request of every slot answered, and timed units run alone.

use crate::support::random::Random;
use bspscope::jobs::{
    Context, End, Handle, Job, JobError, Priority, Run, Scheduler, Slot, Standing,
};
use bspscope::progress::{Cancelled, Progress};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering::SeqCst};

/// What all virtual jobs of a sequence share.
#[derive(Default)]
struct Watch {
    /// Units that run now, without those of light jobs.
    units: AtomicI64,
    timed: AtomicI64,
    /// Those of each of [`SLOTS`].
    by_slot: [AtomicI64; SLOTS.len()],
    /// Units that have run, to show that something is tested.
    all_units: AtomicU64,
    all_timed: AtomicU64,
    interrupted: AtomicU64,
    /// Whether a timed unit ran beside another unit, or two units of one slot at once.
    disturbed: AtomicBool,
    /// Whether jobs that hold on may end.
    released: AtomicBool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    Unit,
    Timed,
    /// Runs until it is released, cancelled or interrupted.
    Hold,
    Send,
    Fail,
    Panic,
}

/// A job that does nothing, in steps.
struct Virtual {
    slot: Slot,
    priority: Priority,
    steps: Vec<Step>,
    id: u64,
    watch: Arc<Watch>,
}

impl Virtual {
    fn work(&self, timed: bool, progress: &Progress, step: Step) -> Result<(), Cancelled> {
        let watch = &self.watch;
        let counts = self.priority.takes_turns();
        let place = SLOTS.iter().position(|slot| *slot == self.slot);
        let of_slot = place.map(|place| &watch.by_slot[place]).filter(|_| counts);
        if of_slot.is_some_and(|units| units.fetch_add(1, SeqCst) > 0) {
            watch.disturbed.store(true, SeqCst);
        }
        if counts {
            let before = watch.units.fetch_add(1, SeqCst);
            if timed {
                watch.timed.fetch_add(1, SeqCst);
                watch.all_timed.fetch_add(1, SeqCst);
            }
            if (timed && before > 0) || watch.timed.load(SeqCst) > i64::from(timed) {
                watch.disturbed.store(true, SeqCst);
            }
            watch.all_units.fetch_add(1, SeqCst);
        }
        let mut result = Ok(());
        let mut turns = 3;
        while turns > 0 || (step == Step::Hold && !watch.released.load(SeqCst)) {
            result = progress.check();
            if result.is_err() {
                watch.interrupted.fetch_add(1, SeqCst);
                break;
            }
            turns -= i32::from(turns > 0);
            std::thread::yield_now();
        }
        if counts {
            if timed {
                watch.timed.fetch_sub(1, SeqCst);
            }
            watch.units.fetch_sub(1, SeqCst);
        }
        if let Some(units) = of_slot {
            units.fetch_sub(1, SeqCst);
        }
        result
    }
}

impl Job for Virtual {
    type Partial = (u64, usize);
    type Output = u64;

    fn place(&self) -> (Slot, Priority) {
        (self.slot, self.priority)
    }

    fn run(self, context: &Context<(u64, usize)>) -> Result<u64, JobError> {
        for (place, &step) in self.steps.iter().enumerate() {
            context.stage(format!("{step:?}"));
            match step {
                Step::Unit | Step::Hold => {
                    context.unit(|progress| self.work(false, progress, step))?;
                }
                Step::Timed => context.timed(|progress| self.work(true, progress, step))?,
                Step::Send => context.send((self.id, place)),
                Step::Fail => return Err(JobError::new("as asked")),
                // Without the hook, which would print thousands of messages.
                Step::Panic => std::panic::resume_unwind(Box::new("as asked")),
            }
        }
        Ok(self.id)
    }
}

fn random_steps(random: &mut Random) -> Vec<Step> {
    let count = 1 + random.below(4);
    let mut steps: Vec<_> = (0..count)
        .map(|_| {
            random.one_of(&[
                Step::Unit,
                Step::Unit,
                Step::Timed,
                Step::Timed,
                Step::Send,
                Step::Send,
                Step::Hold,
            ])
        })
        .collect();
    match random.below(8) {
        0 => steps.push(Step::Fail),
        1 => steps.push(Step::Panic),
        _ => {}
    }
    steps
}

const SLOTS: [Slot; 4] = [
    Slot::named("a"),
    Slot::named("b"),
    Slot::numbered("c", 0),
    Slot::numbered("c", 1),
];

const PRIORITIES: [Priority; 6] = [
    Priority::Idle,
    Priority::Detail,
    Priority::Study,
    Priority::Pane,
    Priority::Now,
    Priority::Light,
];

/// The last request of a slot.
struct Request {
    handle: Handle<Virtual>,
    id: u64,
    last_step: Step,
    /// Partial results that it sends if it is not ended early.
    sends: usize,
    cancelled: bool,
    received: Vec<(u64, usize)>,
    end: Option<End<u64>>,
}

impl Request {
    fn receive(&mut self) {
        let news = self.handle.receive();
        if !news.partials.is_empty() || news.end.is_some() {
            assert_eq!(self.end, None, "nothing follows the end");
        }
        self.received.extend(news.partials);
        self.end = self.end.take().or(news.end);
    }

    /// Checks that it was answered as was asked for.
    fn check(&self) {
        let end = self.end.as_ref().expect("an answer");
        let own = self.received.iter().all(|&(id, _)| id == self.id);
        assert!(own, "a result of another job");
        let rising = self.received.windows(2).all(|pair| pair[0].1 < pair[1].1);
        assert!(rising, "results in order");
        if self.cancelled && *end == End::Cancelled {
            return;
        }
        assert_eq!(self.received.len(), self.sends, "all partial results");
        let wanted = match self.last_step {
            Step::Fail => End::Failed("as asked".to_owned()),
            Step::Panic => End::Failed("internal error: as asked".to_owned()),
            _ => End::Done(self.id),
        };
        assert_eq!(*end, wanted);
    }
}

/// Drives one scheduler through a random sequence.
fn sequence(seed: u64, totals: &Watch) {
    let random = &mut Random(seed);
    let watch = Arc::new(Watch::default());
    let scheduler = Scheduler::new(|| ());
    let mut last: [Option<Request>; SLOTS.len()] = [const { None }; SLOTS.len()];
    let mut replaced = Vec::new();
    for id in 0..4 + random.below(8) as u64 {
        let place = random.below(SLOTS.len());
        match random.below(12) {
            0..5 => {
                let steps = random_steps(random);
                let request = |handle| Request {
                    handle,
                    id,
                    last_step: steps[steps.len() - 1],
                    sends: steps.iter().filter(|step| **step == Step::Send).count(),
                    cancelled: false,
                    received: Vec::new(),
                    end: None,
                };
                let handle = scheduler.start(Virtual {
                    slot: SLOTS[place],
                    priority: random.one_of(&PRIORITIES),
                    steps: steps.clone(),
                    id,
                    watch: Arc::clone(&watch),
                });
                if let Some(old) = last[place].replace(request(handle)) {
                    let news = old.handle.receive();
                    if old.end.is_none() && news.end == Some(End::Replaced) {
                        assert!(news.partials.is_empty(), "a stale result");
                    }
                    replaced.push(old.handle);
                }
            }
            5 | 6 => scheduler.pause(SLOTS[place]),
            7 => scheduler.resume(SLOTS[place]),
            8 => {
                if let Some(request) = &mut last[place] {
                    request.handle.cancel();
                    request.cancelled = true;
                    assert!(!request.handle.is_live());
                    assert_eq!(request.handle.status(), None, "a stage of a cancelled job");
                }
            }
            9 => {
                if let Some(request) = &mut last[place] {
                    request.receive();
                }
            }
            10 => std::thread::yield_now(),
            _ => watch.released.store(true, SeqCst),
        }
    }
    for old in &replaced {
        let news = old.receive();
        assert!(news.partials.is_empty() && news.end.is_none(), "stale news");
    }
    if random.below(8) > 0 {
        watch.released.store(true, SeqCst);
        let at_rest = scheduler.wait();
        let paused = |standing| matches!(standing, Standing::Paused | Standing::Waiting);
        assert!(
            scheduler.jobs().iter().all(|job| paused(job.standing)),
            "seed {seed}: {:?}",
            scheduler.jobs()
        );
        assert_eq!(at_rest, scheduler.jobs().is_empty(), "seed {seed}");
        for slot in SLOTS {
            scheduler.resume(slot);
        }
        assert!(scheduler.wait(), "seed {seed}: {:?}", scheduler.jobs());
        assert!(scheduler.jobs().is_empty() && scheduler.threads() == 0);
        for request in last.iter_mut().flatten() {
            request.receive();
            request.check();
        }
    }
    drop(scheduler);
    assert_eq!(
        Arc::strong_count(&watch),
        1,
        "seed {seed}: a thread is left"
    );
    assert!(!watch.disturbed.load(SeqCst), "seed {seed}: not alone");
    assert_eq!(watch.units.load(SeqCst), 0);
    for (total, of) in [
        (&totals.all_units, &watch.all_units),
        (&totals.all_timed, &watch.all_timed),
        (&totals.interrupted, &watch.interrupted),
    ] {
        total.fetch_add(of.load(SeqCst), SeqCst);
    }
}

#[test]
fn random_sequences_of_requests_come_to_rest_with_the_last_ones_answered() {
    let totals = Watch::default();
    for seed in 0..12_000 {
        sequence(seed, &totals);
    }
    let [units, timed, interrupted] =
        [&totals.all_units, &totals.all_timed, &totals.interrupted].map(|n| n.load(SeqCst));
    println!("{units} units, {timed} timed, {interrupted} interrupted");
    assert!(units > 20_000 && timed > 5_000);
    // How many depends on the load of the machine.
    assert!(interrupted > 0);
}

fn wait_until(done: impl Fn() -> bool) {
    while !done() {
        std::thread::yield_now();
    }
}

/// A job whose only unit runs until it is released.
fn hold(name: &'static str, priority: Priority, watch: &Arc<Watch>) -> Virtual {
    Virtual {
        slot: Slot::named(name),
        priority,
        steps: vec![Step::Hold],
        id: 0,
        watch: Arc::clone(watch),
    }
}

#[test]
fn a_job_of_higher_priority_interrupts_a_unit_which_is_repeated() {
    let watch = Arc::new(Watch::default());
    let scheduler = Scheduler::new(|| ());
    let study = scheduler.start(hold("study", Priority::Study, &watch));
    wait_until(|| watch.units.load(SeqCst) == 1);
    let first = scheduler.start(Run::new(Slot::named("picture"), Priority::Now, |context| {
        context.timed(|_| Ok::<_, JobError>(7))
    }));
    wait_until(|| !first.is_live());
    assert_eq!(first.receive().end, Some(End::Done(7)));
    assert_eq!(watch.interrupted.load(SeqCst), 1);
    assert!(study.is_live(), "it is repeated");
    watch.released.store(true, SeqCst);
    assert!(scheduler.wait());
    assert_eq!(study.receive().end, Some(End::Done(0)));
    assert_eq!(watch.all_units.load(SeqCst), 2);
}

#[test]
fn studies_run_one_after_the_other_and_details_after_them() {
    let watch = Arc::new(Watch::default());
    let scheduler = Scheduler::new(|| ());
    let order = Arc::new(std::sync::Mutex::new(Vec::new()));
    let block = scheduler.start(hold("picture", Priority::Now, &watch));
    wait_until(|| watch.units.load(SeqCst) == 1);
    let study = |name: &'static str, priority| {
        let order = Arc::clone(&order);
        scheduler.start(Run::new(Slot::named(name), priority, move |context| {
            for _ in 0..3 {
                context.timed(|_| {
                    order.lock().unwrap().push(name);
                    Ok::<_, JobError>(())
                })?;
            }
            Ok(())
        }))
    };
    let _all = [
        study("detail", Priority::Detail),
        study("sweep", Priority::Study),
        study("model", Priority::Study),
        study("visits", Priority::Pane),
    ];
    wait_until(|| {
        scheduler
            .jobs()
            .iter()
            .filter(|j| j.standing == Standing::Waiting)
            .count()
            == 4
    });
    drop(block);
    assert!(scheduler.wait());
    let order = order.lock().unwrap();
    let each = ["visits", "sweep", "model", "detail"];
    let wanted: Vec<_> = each.iter().flat_map(|name| [*name; 3]).collect();
    assert_eq!(*order, wanted);
}

#[test]
fn stages_and_shares_are_those_of_live_jobs() {
    let watch = Arc::new(Watch::default());
    let scheduler = Scheduler::new(|| ());
    let inside = Arc::clone(&watch);
    let handle = scheduler.start(Run::new(
        Slot::named("sweep"),
        Priority::Study,
        move |context| {
            context.stage("points");
            context.part(1, 4);
            context.unit(|progress| {
                progress.set(0.5);
                inside.units.store(1, SeqCst);
                while !inside.released.load(SeqCst) {
                    progress.check()?;
                    std::thread::yield_now();
                }
                Ok::<_, Cancelled>(())
            })
        },
    ));
    wait_until(|| watch.units.load(SeqCst) == 1);
    let jobs = scheduler.jobs();
    assert_eq!(jobs.len(), 1);
    assert_eq!((jobs[0].slot.name(), &*jobs[0].stage), ("sweep", "points"));
    assert_eq!(
        (jobs[0].fraction, jobs[0].standing),
        (0.375, Standing::Running)
    );
    assert_eq!(handle.status().as_ref(), Some(&jobs[0]));
    handle.cancel();
    assert!(scheduler.jobs().is_empty() && handle.status().is_none());
    assert!(scheduler.wait());
    assert_eq!(handle.receive().end, Some(End::Cancelled));
}

#[test]
fn what_a_panicking_job_says_is_its_end() {
    let scheduler = Scheduler::new(|| ());
    let handle = scheduler.start(Run::<()>::new(
        Slot::named("export"),
        Priority::Now,
        |context| {
            context.timed(|_| -> Result<(), JobError> {
                std::panic::resume_unwind(Box::new("no ink".to_owned()))
            })
        },
    ));
    assert!(scheduler.wait());
    let end = handle.receive().end;
    assert_eq!(end, Some(End::Failed("internal error: no ink".to_owned())));
    // The unit has ended, too: others run.
    let next = scheduler.start(Run::new(Slot::named("export"), Priority::Now, |context| {
        context.timed(|_| Ok::<_, JobError>(1))
    }));
    assert!(scheduler.wait());
    assert_eq!(next.receive().end, Some(End::Done(1)));
}

#[test]
fn work_on_the_callers_thread_is_a_job_like_others() {
    let scheduler = Scheduler::new(|| ());
    let listed = scheduler.run_here(Slot::named("load"), "loading", true, |progress| {
        progress.set(0.25);
        scheduler.jobs()
    });
    assert_eq!(listed.len(), 1);
    assert_eq!((&*listed[0].stage, listed[0].fraction), ("loading", 0.25));
    assert!(scheduler.jobs().is_empty());
}
