//! What the text of an argument stands for: names of registries, lists of numbers, points.

use crate::geometry::Vec3;
use crate::measure::heat::{Heatmap, RayFilter, heatmap, heatmaps};
use crate::measure::model::Equation;
use crate::measure::paper::{self, PaperScene};
use crate::measure::{Parameter, parameter, parameters};
use crate::present::export::LEAF_WRITERS;
use crate::present::overlay::{COLORMAPS, Colormap, Range, Scale, colormap};
use crate::present::report::WRITERS;
use crate::scene::Sampling;
use crate::structure::{MaxDepth, Method};
use crate::trace::{KernelChoice, PrecisionChoice};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// A parameter, chosen by its symbol.
#[derive(Clone, Copy)]
pub struct ByParameter(pub &'static Parameter);

impl std::fmt::Debug for ByParameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.symbol)
    }
}

/// Greatest depths in the order in which they were typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Depths(pub Vec<MaxDepth>);

/// Leaf sizes in the order in which they were typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeafSizes(pub Vec<u32>);

/// A heatmap, chosen by its symbol.
#[derive(Clone, Copy)]
pub struct ByHeatmap(pub &'static Heatmap);

impl std::fmt::Debug for ByHeatmap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.symbol)
    }
}

/// A colour map, chosen by its name.
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

pub fn leaf_writer_names() -> PossibleValuesParser {
    let names = LEAF_WRITERS.iter();
    PossibleValuesParser::new(names.map(|w| PossibleValue::new(w.name).help(w.about)))
}

pub fn method_names() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::all().map(|m| PossibleValue::new(m.name).help(m.title)))
        .try_map(|name| Method::named(&name))
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

/// Numbers and ranges with both ends, separated by commas; each number at most once.
fn numbers(text: &str, most: u32) -> Result<Vec<u32>, String> {
    let mut numbers = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once("..").unwrap_or((part, part));
        let range = from.trim().parse::<u32>().ok().zip(to.trim().parse().ok());
        let (from, to) = range
            .filter(|(from, to)| from <= to && *to <= most)
            .ok_or_else(|| {
                format!("expected numbers up to {most} or ranges such as 8..24, found '{part}'")
            })?;
        for number in from..=to {
            if numbers.contains(&number) {
                return Err(format!("{number} is there twice"));
            }
            numbers.push(number);
        }
    }
    Ok(numbers)
}

pub fn depths(text: &str) -> Result<Depths, String> {
    let parts = || text.split(',').map(str::trim);
    let fixed: Vec<_> = parts().filter(|part| *part != "auto").collect();
    let mut depths = Vec::new();
    if !fixed.is_empty() {
        let fixed = numbers(&fixed.join(","), MaxDepth::LIMIT)?;
        depths.extend(fixed.into_iter().map(MaxDepth::Fixed));
    }
    if parts().any(|part| part == "auto") {
        depths.push(MaxDepth::Automatic);
    }
    Ok(Depths(depths))
}

pub fn leaf_sizes(text: &str) -> Result<LeafSizes, String> {
    /// More than this many leaf sizes are a mistake in typing.
    const MOST: u32 = 100_000;
    numbers(text, MOST).map(LeafSizes)
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
    .try_map(|name| colormap(&name).map(ByColormap).ok_or("no such colours"))
}

pub fn range(text: &str) -> Result<Range, String> {
    text.split_once(':')
        .and_then(|(lo, hi)| Some((lo.parse().ok()?, hi.parse().ok()?)))
        .filter(|(lo, hi): &(f64, f64)| lo < hi && lo.is_finite() && hi.is_finite())
        .map(|(lo, hi)| Range::Fixed { lo, hi })
        .ok_or_else(|| "expected the lowest and a higher value, such as 0:200".into())
}

pub fn share(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a number from 0 to 1".into())
}

pub fn point(text: &str) -> Result<Vec3, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(Vec3::new(x, y, z)),
        _ => Err("expected three numbers, such as 0,-4,1.5".into()),
    }
}

pub fn pixel(text: &str) -> Result<[i64; 2], String> {
    text.split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]))
        .ok_or_else(|| "expected a column and a row, such as 256,256".into())
}

pub fn kernel_names() -> impl TypedValueParser<Value = KernelChoice> {
    let value = |kernel: KernelChoice| PossibleValue::new(kernel.name()).aliases(kernel.old_name());
    PossibleValuesParser::new(KernelChoice::ALL.map(value))
        .try_map(|name| KernelChoice::named(&name).ok_or("no such kernel"))
}

pub fn precision_names() -> impl TypedValueParser<Value = PrecisionChoice> {
    PossibleValuesParser::new(PrecisionChoice::ALL.map(PrecisionChoice::name))
        .try_map(|name| PrecisionChoice::named(&name).ok_or("no such precision"))
}

pub fn sampling_names() -> impl TypedValueParser<Value = Sampling> {
    PossibleValuesParser::new(["center", "corner"]).map(|name| match name.as_str() {
        "corner" => Sampling::Corner,
        _ => Sampling::Center,
    })
}

pub fn resolution(text: &str) -> Result<[u32; 2], String> {
    text.split_once(['x', '×'])
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]))
        .ok_or_else(|| "expected a width and a height in pixels, such as 512x512".into())
}

pub fn constant(text: &str) -> Result<(String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| Some((name.to_owned(), value.parse().ok()?)))
        .ok_or_else(|| "expected NAME=VALUE with a number, such as gap-fraction=0.05".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_numbers_are_read() {
        assert_eq!(numbers("3..5,9", 20), Ok(vec![3, 4, 5, 9]));
        for wrong in ["", "5..3", "1,,2", "x", "21", "2,1..3"] {
            assert!(numbers(wrong, 20).is_err(), "{wrong}");
        }
        let depths = depths("auto, 7").unwrap();
        assert_eq!(depths.0, [MaxDepth::Fixed(7), MaxDepth::Automatic]);
    }
}
