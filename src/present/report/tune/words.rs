//! The sentences of a search for the best tree.

use crate::measure::BreakEven;
use crate::measure::tune::{Goal, LeftOut, MOST_SLOWDOWN, NAIVE_LIMIT, Row, Spread, Tuned};
use crate::present::number::{Digits, NO_VALUE, counted, grouped};
use crate::setup::measure_command;

/// Formats a time with its unit.
pub fn time(seconds: f64) -> String {
    Digits::Four.seconds(seconds)
}

/// Formats the memory of a tree with its unit.
pub fn memory(row: &Row) -> String {
    Digits::Four.bytes(row.bytes() as f64)
}

/// Returns `D_MAX` and `N_OILF` of a row; a dash where they do not apply.
pub fn limits(row: &Row) -> [String; 2] {
    let build = &row.setup.build;
    if build.method.has_limits {
        [row.measurement.depth_in_words(), build.n_oilf.to_string()]
    } else {
        [NO_VALUE.into(), NO_VALUE.into()]
    }
}

/// Returns the conditions under which all candidates were measured.
pub fn conditions(scene: &str, tuned: &Tuned) -> String {
    let render = &tuned.render;
    let threads = tuned.rows[0].measurement.building.threads;
    format!(
        "Scene {scene}. All candidates: {} × {} pixels, D_AREC {}, {}, kernel {}, {}. Times are CPU \
         times, the median of interleaved rounds. Candidates whose ranges overlap share a rank; slow ones were timed less \
         often and rank behind.",
        render.width,
        render.height,
        render.d_arec,
        tuned.rows[0].measurement.precision.precision.name(),
        render.kernel.description(),
        counted(threads, "thread")
    )
}

/// Returns which settings are recommended and why.
pub fn recommendation(tuned: &Tuned) -> String {
    let (place, row) = tuned.recommended();
    let spread = row.spread();
    let mut text = format!(
        "Best for {}: {}. The picture takes {}",
        tuned.search.goal.name(),
        row.setup.build.in_words(),
        time(spread.median)
    );
    if row.rounds() > 1 {
        text += &format!(
            " ({} to {} in {} rounds)",
            time(spread.least),
            time(spread.most),
            row.rounds()
        );
    }
    text += &format!(" and the tree {}.", memory(row));
    if let Some(rays) = tuned.search.rays {
        let Spread {
            least,
            median,
            most,
        } = row.spread_with_build(rays);
        text += &format!(
            " Building it once and tracing {} takes {} ({} to {}).",
            rays_in_words(rays),
            time(median),
            time(least),
            time(most)
        );
        text += &break_even(tuned, place);
    }
    if tuned.search.goal == Goal::Memory {
        text += &format!(
            " It is the smallest tree whose picture takes at most {MOST_SLOWDOWN} times as long as \
             that of the fastest."
        );
        return text;
    }
    let ranking = tuned.ranking();
    let rank = |of: usize| ranking.iter().find(|r| r.place == of).map(|r| r.rank);
    let ties = ranking.iter().filter(|r| Some(r.rank) == rank(place));
    match ties.count() - 1 {
        0 => {}
        1 => text += " 1 other candidate is as fast within the spread.",
        n => text += &format!(" {n} other candidates are as fast within the spread."),
    }
    text
}

/// Formats a number of rays.
pub fn rays_in_words(rays: u64) -> String {
    let noun = if rays == 1 { "ray" } else { "rays" };
    format!("{} {noun}", grouped(rays as f64))
}

/// Returns after how many rays the recommended tree pays off, compared with the one that is built fastest; empty if
/// it is that one.
fn break_even(tuned: &Tuned, place: usize) -> String {
    let build = |row: &Row| row.measurement.building.cpu;
    let fastest = tuned
        .rows
        .iter()
        .enumerate()
        .min_by_key(|(_, row)| build(row));
    let Some((_, first)) = fastest.filter(|(fastest, _)| *fastest != place) else {
        return String::new();
    };
    let rays = BreakEven::of(&first.measurement, &tuned.rows[place].measurement);
    match rays.and_then(BreakEven::rays) {
        None => String::new(),
        Some(rays) => format!(
            " Compared with {}, which is built fastest, it pays off after {} (N_BE).",
            first.setup.build.in_words(),
            rays_in_words(rays.ceil() as u64)
        ),
    }
}

/// Returns the command that measures the recommended settings.
pub fn command(row: &Row) -> String {
    measure_command(&row.setup)
}

/// Describes what was left out, one sentence per line.
pub fn left_out(tuned: &Tuned) -> Vec<String> {
    let budget = format!("budget of {} s", tuned.search.budget.as_secs_f64());
    let mut lines = Vec::new();
    let mut same = 0;
    let mut too_large = 0;
    for left_out in &tuned.left_out {
        match left_out {
            LeftOut::Method { method, objects } => lines.push(format!(
                "Method {} was left out: the scene has {} objects; it is only tried with at most {} objects.",
                method.name,
                grouped(*objects as f64),
                grouped(NAIVE_LIMIT as f64)
            )),
            LeftOut::Refused { setup, why } => {
                let settings = setup.build.in_words();
                lines.push(format!("The tree of {settings} was left out: {why}."));
            }
            LeftOut::SameTree { .. } => same += 1,
            LeftOut::Memory { .. } => too_large += 1,
            LeftOut::Untried { settings } => {
                let verb = if *settings == 1 { "was" } else { "were" };
                lines.push(format!(
                    "{} of settings {verb} not tried: their part of the {budget} was spent.",
                    counted(*settings, "combination")
                ));
            }
            LeftOut::Unfinished { candidates, rounds } => {
                let each = if *candidates == 1 { "it" } else { "each of them" };
                let verb = if *candidates == 1 { "was" } else { "were" };
                let times = counted(*rounds, "time");
                lines.push(format!(
                    "The {budget} was spent when {} {verb} left; {each} was timed at least {times}.",
                    counted(*candidates, "candidate")
                ));
            }
        }
    }
    if let Some(most) = tuned.search.most_bytes.filter(|_| too_large > 0) {
        let verb = if too_large == 1 { "needs" } else { "need" };
        lines.push(format!(
            "{} {verb} more memory than {} and {} not timed.",
            counted(too_large, "tree"),
            Digits::Four.bytes(most as f64),
            if too_large == 1 { "was" } else { "were" }
        ));
    }
    if same > 0 {
        let (verb, article) = if same == 1 {
            ("builds", "It is")
        } else {
            ("build", "They are")
        };
        lines.push(format!(
            "{} of settings {verb} the same tree as another one. {article} not listed.",
            counted(same, "combination")
        ));
    }
    lines
}

/// Says how many candidates a short list does not have; `None` if it has all.
pub fn not_listed(tuned: &Tuned) -> Option<String> {
    let others = tuned.rows.len() - tuned.short_ranking().len();
    (others > 0).then(|| {
        let verb = if others == 1 { "was" } else { "were" };
        format!(
            "{} {verb} dropped earlier; JSON and CSV reports list them.",
            counted(others, "candidate")
        )
    })
}
