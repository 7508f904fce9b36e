//! What was measured for a step of a lesson, and the names that lessons have for it.

use crate::measure::accuracy::pixel_errors;
use crate::measure::heat::{HEATMAPS, Heatmap, RayFilter, Source, Whole};
use crate::measure::{Class, Measurement, PARAMETERS, Parameter, differing_pixels};
use crate::present::number::{grouped, significant};
use crate::trace::{Picture, PixelTallies, Tally};

/// Everything measured for a step.
#[derive(Clone, Debug)]
pub struct Figures {
    pub a: SideFigures,
    /// The second tree, where the step compares two.
    pub b: Option<SideFigures>,
    /// How B's picture differs from A's; `None` without B, or where they have another size.
    pub difference: Option<Difference>,
}

/// What was measured of one tree.
#[derive(Clone, Debug)]
pub struct SideFigures {
    pub measurement: Measurement,
    /// What the rays of the step's pixel did; `None` if it has none.
    pub pixel: Option<PixelTallies>,
}

/// How a picture differs from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Pixels whose colours are not the same.
    pub pixels: usize,
    /// Square root of the mean squared error, 0 to 1.
    pub rmse: f64,
}

impl Difference {
    /// Of two pictures; `None` if their sizes differ.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    A,
    B,
}

/// The name of a figure.
#[derive(Clone, Copy)]
pub enum Name {
    /// `a.N_LS`: a parameter of the paper, or the like.
    Parameter(Side, &'static Parameter),
    /// `a.N_IT`: a heatmap's value of the whole picture, where parameters sum to it.
    Total(Side, &'static Heatmap),
    /// `a.pixel.N_IT` or `a.ray.N_IT`: of all rays of the step's pixel, or of its primary ray.
    Pixel(Side, &'static Heatmap, RayFilter),
    /// `differing`: pixels in which the pictures of A and B differ.
    Differing,
    /// `rmse`: the error of B's picture against A's.
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
    /// Reads a name.
    ///
    /// # Errors
    /// A sentence that says what names there are.
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
                "'{text}' is no figure: expected a. or b. and a symbol, such as a.N_LS, or differing \
                 or rmse"
            ));
        };
        let of_pixel = [("pixel.", RayFilter::All), ("ray.", RayFilter::Primary)];
        for (prefix, rays) in of_pixel {
            if let Some(symbol) = symbol.strip_prefix(prefix) {
                let mut all = HEATMAPS.iter();
                let counted = |h: &&Heatmap| matches!(h.source, Source::Rays(_));
                let heatmap = all.find(|h| h.symbol == symbol && counted(h));
                let heatmap = heatmap.ok_or_else(|| {
                    let known: Vec<_> = HEATMAPS.iter().filter(counted).map(|h| h.symbol).collect();
                    format!(
                        "no {symbol} of a pixel's rays; there are {}",
                        known.join(", ")
                    )
                })?;
                return Ok(Name::Pixel(side, heatmap, rays));
            }
        }
        if let Some(parameter) = PARAMETERS.iter().find(|p| p.symbol == symbol) {
            return Ok(Name::Parameter(side, parameter));
        }
        let mut sums = HEATMAPS
            .iter()
            .filter(|h| !h.parameters(RayFilter::All).is_empty());
        let heatmap = sums.find(|h| h.symbol == symbol);
        let heatmap = heatmap.ok_or_else(|| {
            format!("no parameter {symbol}; 'bspscope measure' prints them all, and there is N_IT")
        })?;
        Ok(Name::Total(side, heatmap))
    }

    /// Which tree it is of; `None` for what is of both.
    pub fn side(&self) -> Option<Side> {
        match self {
            Name::Parameter(side, _) | Name::Total(side, _) | Name::Pixel(side, ..) => Some(*side),
            Name::Differing | Name::Rmse => None,
        }
    }

    /// Whether it is of the step's pixel.
    pub fn is_of_pixel(&self) -> bool {
        matches!(self, Name::Pixel(..))
    }

    /// Whether it was specified before anything was measured.
    pub fn is_given(&self) -> bool {
        matches!(self, Name::Parameter(_, p) if p.class == Class::S)
    }

    /// Whether it is a time, which is another on every machine.
    pub fn is_timed(&self) -> bool {
        matches!(self, Name::Parameter(_, p) if p.class == Class::T)
    }

    /// Its value; `None` where it has none.
    pub fn value(&self, figures: &Figures) -> Option<f64> {
        let of = |side: Side| match side {
            Side::A => Some(&figures.a),
            Side::B => figures.b.as_ref(),
        };
        match *self {
            Name::Parameter(side, parameter) => (parameter.value)(&of(side)?.measurement),
            Name::Total(side, heatmap) => {
                let measurement = &of(side)?.measurement;
                let parameters = heatmap.parameters(RayFilter::All).iter();
                let values = parameters.map(|s| (crate::measure::parameter(s).value)(measurement));
                values.sum()
            }
            Name::Pixel(side, heatmap, rays) => of_rays(of(side)?.pixel.as_ref()?, heatmap, rays),
            Name::Differing => Some(figures.difference?.pixels as f64),
            Name::Rmse => Some(figures.difference?.rmse),
        }
    }

    /// A value of it for people.
    pub fn write(&self, value: f64) -> String {
        match self {
            Name::Parameter(_, parameter) => parameter.format(Some(value)),
            Name::Pixel(_, heatmap, _) if matches!(heatmap.whole, Whole::RatioTo(_)) => {
                significant(value)
            }
            Name::Total(..) | Name::Pixel(..) | Name::Differing => grouped(value),
            Name::Rmse => significant(value),
        }
    }
}

/// What some of a pixel's rays did, as a heatmap counts it; `None` for a ratio to nothing.
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
