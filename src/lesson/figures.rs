//! The figures that were measured for a step of a lesson, and their names in lessons.

use crate::measure::accuracy::pixel_errors;
use crate::measure::heat::{Heatmap, RayFilter, Source, Whole, heatmaps};
use crate::measure::{Class, Measurement, Parameter, differing_pixels, parameters};
use crate::present::number::{Digits, grouped};
use crate::trace::{Picture, PixelTallies, Tally};

/// All figures of a step.
#[derive(Clone, Debug)]
pub struct Figures {
    pub a: SideFigures,
    /// The figures of the second tree, if the step compares two.
    pub b: Option<SideFigures>,
    /// How the picture of B differs from that of A; `None` without B, or if their sizes differ.
    pub difference: Option<Difference>,
}

/// The figures of one tree.
#[derive(Clone, Debug)]
pub struct SideFigures {
    pub measurement: Measurement,
    /// The counts of the rays of the step's pixel; `None` if the step has no pixel.
    pub pixel: Option<PixelTallies>,
}

/// The difference between two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Number of pixels with different colors.
    pub pixels: usize,
    /// Root-mean-square error, 0 to 1.
    pub rmse: f64,
}

impl Difference {
    /// Compares two pictures; `None` if their sizes differ.
    pub fn between(a: &Picture, b: &Picture) -> Option<Difference> {
        if (a.width, a.height) != (b.width, b.height) {
            return None;
        }
        let errors = pixel_errors(b.pixels(), a.pixels());
        let squares: f64 = errors.iter().map(|&error| f64::from(error).powi(2)).sum();
        Some(Difference {
            pixels: differing_pixels(a, b).len(),
            rmse: (squares / errors.len().max(1) as f64).sqrt(),
        })
    }
}

/// One of the two trees of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    #[default]
    A,
    B,
}

/// The name of a figure.
#[derive(Clone, Copy)]
pub enum Name {
    /// `a.N_LS`: a parameter.
    Parameter(Side, &'static Parameter),
    /// `a.N_IT`: the value of a heatmap for the whole picture, if it is a sum of parameters.
    Total(Side, &'static Heatmap),
    /// `a.pixel.N_IT` or `a.ray.N_IT`: the value for all rays of the step's pixel, or for its
    /// primary ray.
    Pixel(Side, &'static Heatmap, RayFilter),
    /// `differing`: number of pixels in which the pictures of A and B differ.
    Differing,
    /// `rmse`: the error of B's picture relative to A's.
    Rmse,
}

impl std::fmt::Debug for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let side = match self.side() {
            Some(Side::A) => "a.",
            Some(Side::B) => "b.",
            None => "",
        };
        let name = match self {
            Name::Parameter(_, parameter) => parameter.symbol,
            Name::Total(_, heatmap) | Name::Pixel(_, heatmap, _) => heatmap.symbol,
            Name::Differing => "differing",
            Name::Rmse => "rmse",
        };
        let rays = match self {
            Name::Pixel(_, _, RayFilter::Primary) => "ray.",
            Name::Pixel(..) => "pixel.",
            _ => "",
        };
        write!(f, "{side}{rays}{name}")
    }
}

impl Name {
    /// Parses a name.
    ///
    /// # Errors
    /// One sentence on which names exist.
    pub fn parse(text: &str) -> Result<Name, String> {
        match text {
            "differing" => return Ok(Name::Differing),
            "rmse" => return Ok(Name::Rmse),
            _ => {}
        }
        let sides = [("a.", Side::A), ("b.", Side::B)];
        let found = sides
            .into_iter()
            .find_map(|(prefix, side)| Some((side, text.strip_prefix(prefix)?)));
        let Some((side, symbol)) = found else {
            return Err(format!(
                "'{text}' is not a figure: expected a. or b. and a symbol, such as a.N_LS, or differing \
                 or rmse"
            ));
        };
        let of_pixel = [("pixel.", RayFilter::All), ("ray.", RayFilter::Primary)];
        for (prefix, rays) in of_pixel {
            if let Some(symbol) = symbol.strip_prefix(prefix) {
                let mut all = heatmaps().iter();
                let counted = |h: &&Heatmap| matches!(h.source, Source::Rays(_));
                let heatmap = all.find(|h| h.symbol == symbol && counted(h));
                let heatmap = heatmap.ok_or_else(|| {
                    let known: Vec<_> = heatmaps()
                        .iter()
                        .filter(counted)
                        .map(|h| h.symbol)
                        .collect();
                    format!(
                        "'{symbol}' is not counted per pixel; available: {}",
                        known.join(", ")
                    )
                })?;
                return Ok(Name::Pixel(side, heatmap, rays));
            }
        }
        if let Some(parameter) = parameters().iter().find(|p| p.symbol == symbol) {
            return Ok(Name::Parameter(side, parameter));
        }
        let mut sums = heatmaps()
            .iter()
            .filter(|h| !h.parameters(RayFilter::All).is_empty());
        let heatmap = sums.find(|h| h.symbol == symbol);
        let heatmap = heatmap.ok_or_else(|| {
            format!("no parameter '{symbol}'; use N_IT or a symbol that 'bspscope measure' prints")
        })?;
        Ok(Name::Total(side, heatmap))
    }

    /// Returns the tree that the figure belongs to; `None` if it depends on both.
    pub fn side(&self) -> Option<Side> {
        match self {
            Name::Parameter(side, _) | Name::Total(side, _) | Name::Pixel(side, ..) => Some(*side),
            Name::Differing | Name::Rmse => None,
        }
    }

    /// Returns whether the figure is of the step's pixel.
    pub fn is_of_pixel(&self) -> bool {
        matches!(self, Name::Pixel(..))
    }

    /// Returns whether the figure was specified, rather than measured.
    pub fn is_given(&self) -> bool {
        matches!(self, Name::Parameter(_, p) if p.class == Class::S)
    }

    /// Returns whether the figure is a time, which differs between machines.
    pub fn is_timed(&self) -> bool {
        matches!(self, Name::Parameter(_, p) if p.class == Class::T)
    }

    /// Returns the value; `None` if it has none.
    pub fn value(&self, figures: &Figures) -> Option<f64> {
        let of = |side: Side| match side {
            Side::A => Some(&figures.a),
            Side::B => figures.b.as_ref(),
        };
        match *self {
            Name::Parameter(side, parameter) => parameter.value(&of(side)?.measurement),
            Name::Total(side, heatmap) => {
                let measurement = &of(side)?.measurement;
                let parameters = heatmap.parameters(RayFilter::All).iter();
                let values = parameters.map(|s| crate::measure::parameter(s).value(measurement));
                values.sum()
            }
            Name::Pixel(side, heatmap, rays) => of_rays(of(side)?.pixel.as_ref()?, heatmap, rays),
            Name::Differing => Some(figures.difference?.pixels as f64),
            Name::Rmse => Some(figures.difference?.rmse),
        }
    }

    /// Formats a value of this figure.
    pub fn write(&self, value: f64) -> String {
        match self {
            Name::Parameter(_, parameter) => parameter.format(Some(value)),
            Name::Pixel(_, heatmap, _) if matches!(heatmap.whole, Whole::RatioTo(_)) => {
                Digits::Four.number(value)
            }
            Name::Total(..) | Name::Pixel(..) | Name::Differing => grouped(value),
            Name::Rmse => Digits::Four.number(value),
        }
    }
}

/// Returns the value of a heatmap for some rays of a pixel; `None` for a ratio with denominator 0.
fn of_rays(tallies: &PixelTallies, heatmap: &Heatmap, rays: RayFilter) -> Option<f64> {
    let Source::Rays(count) = heatmap.source else {
        return None;
    };
    let kinds = rays.kinds().iter();
    let tally: Tally = kinds.map(|&kind| tallies[kind as usize]).sum();
    let over = count(&tally) as f64;
    match heatmap.whole {
        Whole::Sum | Whole::Mean => Some(over),
        Whole::RatioTo(under) => {
            let under = under(&tally) as f64;
            (under != 0.0).then(|| over / under)
        }
    }
}
