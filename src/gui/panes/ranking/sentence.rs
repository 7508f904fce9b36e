//! What a search recommends, in words.

use crate::gui::document::tuning::Found;
use crate::measure::tune::{Goal, Row};
use crate::present::number::{Digits, counted};
use crate::present::report::tune::rays_in_words;
use crate::structure::split::Structure;

/// Returns a candidate, such as "sah, depth 18, leaf size 4" and "bvh-sweep, width 8".
pub fn name(row: &Row) -> String {
    let method = row.setup.build.method.name;
    match settings(row).as_str() {
        "" => method.to_owned(),
        settings => format!("{method}, {settings}"),
    }
}

/// Returns the settings of a candidate: depth and leaf size where they limit cells, and constants that are not at
/// their defaults.
pub fn settings(row: &Row) -> String {
    let build = &row.setup.build;
    let mut words = Vec::new();
    if build.method.has_limits && build.method.structure != Structure::Bvh {
        let depth = row.measurement.depth_limit;
        words.push(format!("depth {depth}, leaf size {}", build.n_oilf));
    }
    let constants = build.constants.iter();
    words.extend(constants.map(|(name, value)| format!("{name} {value}")));
    words.join(", ")
}

/// Compares the candidate that is recommended with the method on view when the search began, or with
/// the second best if that is recommended itself.
pub fn recommendation(found: &Found, best: &Row) -> String {
    let name = name(best);
    let Some(other) = other(found, best) else {
        return name;
    };
    let comparison = match found.search.goal {
        Goal::Time => faster(found, best, other),
        Goal::Memory => smaller(best, other),
    };
    format!("{name}: {comparison}")
}

fn other<'a>(found: &'a Found, best: &Row) -> Option<&'a Row> {
    let on_view = found.search.setup.build.method;
    let others = || found.rows.iter().filter(|row| row.setup != best.setup);
    let mut of_view = others().filter(|row| row.setup.build.method == on_view);
    of_view.next().or_else(|| {
        let second = found.ranking().get(1)?.place;
        found.rows.get(second)
    })
}

/// The method alone where that tells the candidate from the other one.
fn short_name(row: &Row, other: &Row) -> String {
    let method = row.setup.build.method;
    if row.is_default() && method != other.setup.build.method {
        method.name.to_owned()
    } else {
        name(row)
    }
}

/// Times as a ratio, with its range over all rounds.
fn faster(found: &Found, best: &Row, other: &Row) -> String {
    let [a, b] = [best, other].map(|row| found.time(row));
    let than = short_name(other, best);
    if b.least <= a.most {
        return format!("as fast as {than} within the spread");
    }
    let [median, least, most] =
        [b.median / a.median, b.least / a.most, b.most / a.least].map(times);
    if least == most {
        format!("{median} faster than {than}")
    } else {
        format!("{median} faster than {than} ({least} to {most})")
    }
}

fn smaller(best: &Row, other: &Row) -> String {
    let than = short_name(other, best);
    let ratio = other.bytes() as f64 / best.bytes().max(1) as f64;
    if best.bytes() == other.bytes() {
        format!("as small as {than}")
    } else if ratio > 1.0 {
        format!("{} smaller than {than}", times(ratio))
    } else {
        format!("{} larger than {than}, but faster", times(1.0 / ratio))
    }
}

fn times(ratio: f64) -> String {
    let digits = if ratio < 10.0 { 1 } else { 0 };
    if ratio < 1.95 {
        format!("{ratio:.2}×")
    } else {
        format!("{ratio:.digits$}×")
    }
}

/// Returns what all candidates have in common.
pub fn conditions(found: &Found) -> String {
    let m = &found.rows[0].measurement;
    format!(
        "{} · {} × {} pixels · {} · {} · {} · median CPU times{}; ranges that overlap share a rank",
        found.scene,
        m.render.width,
        m.render.height,
        m.render.kernel.description(),
        m.precision.precision.name(),
        counted(m.building.threads, "thread"),
        match found.search.rays {
            Some(rays) => format!(" of building and {}", rays_in_words(rays)),
            None => String::new(),
        },
    )
}

/// Returns the median of the times by which a candidate is ranked.
pub fn time(found: &Found, row: &Row) -> String {
    Digits::Three.seconds(found.time(row).median)
}

/// Returns the least and the greatest time.
pub fn range(found: &Found, row: &Row) -> String {
    let spread = found.time(row);
    let [least, most] = [spread.least, spread.most].map(|s| Digits::Three.seconds(s));
    format!("{least} to {most} in {}", counted(row.rounds(), "round"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_have_two_digits_at_least() {
        let texts = [1.043, 1.8, 2.0, 9.96, 31.4].map(times);
        assert_eq!(texts, ["1.04×", "1.80×", "2.0×", "10.0×", "31×"]);
    }
}
