//! Parses the values of arguments: names in registries, numbers, points.

use crate::measure::accuracy::{KNOBS, Knob};
use crate::measure::heat::{Heatmap, RayFilter, heatmap, heatmaps};
use crate::measure::model::Equation;
use crate::measure::paper::{self, PaperScene};
use crate::measure::tune::Goal;
use crate::measure::{Parameter, parameter, parameters};
use crate::present::export::LEAF_WRITERS;
use crate::present::overlay::{COLORMAPS, Colormap, Range, Scale, colormap};
use crate::present::report::WRITERS;
use crate::present::report::study::STUDY_WRITERS;
use crate::primitive::Precision;
use crate::structure::Method;
use crate::structure::tree_file::is_tree_file;
use clap::builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser};
use std::ffi::OsStr;
use std::time::Duration;

/// A parameter, given by its symbol.
#[derive(Clone, Copy)]
pub struct ByParameter(pub &'static Parameter);

impl std::fmt::Debug for ByParameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.symbol)
    }
}

/// A heatmap, given by its symbol.
#[derive(Clone, Copy)]
pub struct ByHeatmap(pub &'static Heatmap);

impl std::fmt::Debug for ByHeatmap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.symbol)
    }
}

/// A color map, given by its name.
#[derive(Clone, Copy)]
pub struct ByColormap(pub &'static Colormap);

impl std::fmt::Debug for ByColormap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.name)
    }
}

pub fn writer_names() -> PossibleValuesParser {
    PossibleValuesParser::new(
        WRITERS
            .iter()
            .map(|writer| PossibleValue::new(writer.name).help(writer.about)),
    )
}

pub fn study_writer_names() -> PossibleValuesParser {
    let names = STUDY_WRITERS.iter();
    PossibleValuesParser::new(names.map(|w| PossibleValue::new(w.name).help(w.about)))
}

pub fn leaf_writer_names() -> PossibleValuesParser {
    let names = LEAF_WRITERS.iter();
    PossibleValuesParser::new(names.map(|w| PossibleValue::new(w.name).help(w.about)))
}

pub fn method_names() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::all().map(|m| PossibleValue::new(m.name).help(m.summary)))
        .try_map(|name| Method::named(&name))
}

/// Parses a build method or a tree file. Help lists the methods.
#[derive(Clone)]
pub struct MethodParser;

impl TypedValueParser for MethodParser {
    type Value = Method;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Method, clap::Error> {
        match value.to_str().filter(|text| is_tree_file(text)) {
            Some(file) => StringValueParser::new()
                .try_map(|file| Method::named(&file))
                .parse_ref(command, arg, OsStr::new(file)),
            None => method_names().parse_ref(command, arg, value),
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let all = Method::all().map(|m| PossibleValue::new(m.name).help(m.summary));
        Some(Box::new(all))
    }
}

pub fn precision_names() -> impl TypedValueParser<Value = Precision> {
    PossibleValuesParser::new(Precision::ALL.map(Precision::name)).try_map(|name| {
        let mut all = Precision::ALL.into_iter();
        all.find(|p| p.name() == name).ok_or("no such precision")
    })
}

pub fn equation_names() -> impl TypedValueParser<Value = Equation> {
    PossibleValuesParser::new(Equation::ALL.map(Equation::name)).try_map(|name| {
        let mut all = Equation::ALL.into_iter();
        all.find(|e| e.name() == name).ok_or("no such equation")
    })
}

pub fn parameter_names() -> impl TypedValueParser<Value = ByParameter> {
    PossibleValuesParser::new(
        parameters()
            .iter()
            .map(|p| PossibleValue::new(p.symbol).help(p.name)),
    )
    .map(|symbol| ByParameter(parameter(&symbol)))
}

pub fn paper_scenes() -> impl TypedValueParser<Value = &'static PaperScene> {
    PossibleValuesParser::new(paper::SCENES.iter().map(|scene| scene.name))
        .try_map(|name| paper::scene(&name).ok_or("no such scene"))
}

pub fn heatmap_names() -> impl TypedValueParser<Value = ByHeatmap> {
    PossibleValuesParser::new(
        heatmaps()
            .iter()
            .map(|h| PossibleValue::new(h.symbol).help(h.meaning)),
    )
    .try_map(|symbol| heatmap(&symbol).map(ByHeatmap).ok_or("no such heatmap"))
}

pub fn filter_names() -> impl TypedValueParser<Value = RayFilter> {
    PossibleValuesParser::new(RayFilter::ALL.map(RayFilter::name))
        .try_map(|name| RayFilter::named(&name).ok_or("no such kind of rays"))
}

pub fn scale_names() -> impl TypedValueParser<Value = Scale> {
    PossibleValuesParser::new(Scale::ALL.map(Scale::name))
        .try_map(|name| Scale::named(&name).ok_or("no such scale"))
}

pub fn colormap_names() -> impl TypedValueParser<Value = ByColormap> {
    PossibleValuesParser::new(
        COLORMAPS
            .iter()
            .map(|map| PossibleValue::new(map.name).help(map.about)),
    )
    .try_map(|name| colormap(&name).map(ByColormap).ok_or("no such color map"))
}

pub fn range(text: &str) -> Result<Range, String> {
    text.split_once(':')
        .and_then(|(lo, hi)| Some((lo.parse().ok()?, hi.parse().ok()?)))
        .filter(|(lo, hi): &(f64, f64)| lo < hi && lo.is_finite() && hi.is_finite())
        .map(|(lo, hi)| Range::Fixed { lo, hi })
        .ok_or_else(|| "expected a lower and a higher value, such as 0:200".into())
}

pub fn share(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a number from 0 to 1".into())
}

pub fn pixel(text: &str) -> Result<[i64; 2], String> {
    text.split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]))
        .ok_or_else(|| "expected a column and a row, such as 256,256".into())
}

pub fn knob_names() -> impl TypedValueParser<Value = &'static Knob> {
    let names = KNOBS.iter().map(|knob| {
        let setting = knob.setting();
        PossibleValue::new(setting.name)
            .help(setting.about)
            .aliases(setting.symbol)
            .aliases(setting.aliases)
    });
    PossibleValuesParser::new(names).try_map(|name| {
        let mut knobs = KNOBS.iter();
        let called = |knob: &&Knob| {
            let setting = knob.setting();
            setting.is_called(&name) || setting.symbol == Some(&*name)
        };
        knobs.find(called).ok_or("no such setting")
    })
}

pub fn goal_names() -> impl TypedValueParser<Value = Goal> {
    PossibleValuesParser::new(Goal::ALL.map(|goal| {
        PossibleValue::new(goal.name()).help(match goal {
            Goal::Time => "the shortest rendering time",
            Goal::Memory => "the smallest tree that is at most twice as slow as the fastest",
        })
    }))
    .try_map(|name| Goal::named(&name).ok_or("no such goal"))
}

pub fn seconds(text: &str) -> Result<Duration, String> {
    text.parse()
        .ok()
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "expected a number of seconds, at least 0, such as 60".into())
}

/// Reads a number of MiB, greater than 0, and returns bytes.
pub fn mebibytes(text: &str) -> Result<u64, String> {
    let number = text
        .parse()
        .ok()
        .filter(|mib: &f64| *mib > 0.0 && mib.is_finite());
    number
        .map(|mib| (mib * f64::from(1 << 20)) as u64)
        .ok_or_else(|| "expected a number of MiB, greater than 0, such as 16 or 0.5".into())
}

pub fn constant(text: &str) -> Result<(String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| Some((name.to_owned(), value.parse().ok()?)))
        .ok_or_else(|| "expected NAME=VALUE with a number, such as gap-fraction=0.05".into())
}
