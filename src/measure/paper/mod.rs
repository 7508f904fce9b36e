//! The paper's experiment: its printed Tables 4, 5 and 6 compared with computed figures.

mod printed;

pub use printed::{CHARACTERISTICS, PROPERTIES, PaperScene, SCENES};

use super::{
    Change, MeasureError, Measured, Measurement, Parameter, Unequal, Unit, change, measure,
    parameter, unequal,
};
use crate::progress::Progress;
use crate::scene::{Cylinders, LoadError, Sampling, SceneRequest, SceneSource, load};
use crate::structure::{BuildSettings, Method, RootMargin};
use crate::trace::RenderSettings;

/// How a computed figure relates to the printed one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The computed figure, rounded to as many digits as are printed, equals the printed one.
    Equal,
    /// For method 2 and 2/1: from method 1 to method 2, the figure changes in the same direction as
    /// in print.
    SameDirection,
    Differs,
}

/// A figure as printed, and as computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    pub printed: &'static str,
    /// In the unit of the printed figure; shares are in percent. `None` if it is not measured yet
    /// or has no value.
    pub computed: Option<f64>,
    /// `None` if there is no computed figure.
    pub mark: Option<Mark>,
    /// An error in the paper or a limit of the comparison, in a sentence or two.
    pub note: Option<&'static str>,
}

/// A row of a table.
#[derive(Clone)]
pub struct Row<const COLUMNS: usize> {
    pub parameter: &'static Parameter,
    pub cells: [Cell; COLUMNS],
}

/// The measurements of one of the paper's scenes that are available so far.
#[derive(Clone)]
pub struct Reproduction {
    pub scene: &'static PaperScene,
    /// By method, 1 then 2.
    pub runs: [Option<Measurement>; 2],
    /// The reasons why the two are not comparable; empty if they are. `None` until both are
    /// measured.
    pub unequal: Option<Vec<Unequal>>,
    /// The notes of the scene, except that on its root margin, which is the paper's.
    pub notes: Vec<String>,
}

/// The conditions of every scene. All other conditions are the paper's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conditions {
    /// Width and height in pixels; the paper's are 512.
    pub resolution: [u32; 2],
    /// Number of threads; 0 for one per core of the machine.
    pub threads: usize,
}

impl Default for Conditions {
    fn default() -> Self {
        Conditions {
            resolution: [512, 512],
            threads: 0,
        }
    }
}

/// Why an experiment cannot be reproduced.
#[derive(Debug, thiserror::Error)]
pub enum PaperError {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    Measure(#[from] MeasureError),
}

impl PaperError {
    /// Returns whether the task was cancelled.
    pub fn is_cancelled(&self) -> bool {
        match self {
            PaperError::Load(error) => matches!(error, LoadError::Cancelled(_)),
            PaperError::Measure(error) => error.is_cancelled(),
        }
    }
}

/// Returns the paper's scene with this name.
pub fn scene(name: &str) -> Option<&'static PaperScene> {
    SCENES.iter().find(|scene| scene.name == name)
}

impl PaperScene {
    /// Returns a printed figure of Table 4 as a number.
    fn characteristic(&self, symbol: &str) -> f64 {
        let place = CHARACTERISTICS.iter().position(|s| *s == symbol);
        number(self.characteristics[place.expect("Table 4 lists it")])
    }
}

/// Measures a scene as the paper did, with both methods: cylinders as ten polygons, samples from
/// the first to the last across the angle of view, the D_AREC of Table 4, D_MAX 20, N_OILF 1, and a root
/// margin of 0.001, also for the reconstructions of scenes that were not published.
///
/// Calls `on_measured` with the results so far after each method. `progress` restarts with each
/// stage of each method.
///
/// # Errors
/// No view or no threads under these conditions, too little memory, or cancellation.
pub fn reproduce(
    scene: &'static PaperScene,
    conditions: &Conditions,
    progress: &Progress,
    mut on_measured: impl FnMut(&Reproduction),
) -> Result<Reproduction, PaperError> {
    let request = SceneRequest {
        source: SceneSource::Builtin {
            name: scene.name.into(),
            size: None,
        },
        cylinders: Cylinders::Polygons(10),
    };
    let loaded = load(&request, progress)?;
    let [width, height] = conditions.resolution;
    let render = RenderSettings {
        width,
        height,
        d_arec: scene.characteristic("D_AREC") as u32,
        sampling: Sampling::Corner,
        threads: conditions.threads,
        ..RenderSettings::for_camera(*loaded.camera())
    };
    let mut result = Reproduction {
        scene,
        runs: [None, None],
        unequal: None,
        notes: (loaded.notes().iter())
            .filter(|note| note.root_margin().is_none())
            .map(|note| note.text.clone())
            .collect(),
    };
    let mut first: Option<Measured> = None;
    for (i, method) in Method::of_the_paper().into_iter().enumerate() {
        let build = BuildSettings {
            root_margin: RootMargin::Length(0.001),
            ..BuildSettings::for_method(method)
        };
        let measured = measure(&loaded, &build, &render, progress)?;
        result.runs[i] = Some(measured.measurement.clone());
        if let Some(first) = &first {
            let pair = [first, &measured].map(|m| (&m.measurement, &m.picture));
            result.unequal = Some(unequal(pair[0], pair[1]));
        }
        first = Some(measured);
        on_measured(&result);
    }
    Ok(result)
}

impl Reproduction {
    /// Returns the scene's column of Table 4.
    pub fn characteristics(&self) -> [Row<1>; 7] {
        std::array::from_fn(|i| {
            let (symbol, printed) = (CHARACTERISTICS[i], self.scene.characteristics[i]);
            let parameter = parameter(symbol);
            let computed = self.value(parameter, 0);
            Row {
                parameter,
                cells: [Cell {
                    printed,
                    computed,
                    mark: computed.map(|value| equal_or_not(printed, value)),
                    note: printed::note(self.scene, symbol, None),
                }],
            }
        })
    }

    /// Returns the scene's columns of Table 5 or 6: method 1, method 2, 2/1.
    pub fn properties(&self) -> [Row<3>; 10] {
        std::array::from_fn(|i| {
            let (symbol, printed) = (PROPERTIES[i], self.scene.properties[i]);
            let parameter = parameter(symbol);
            let [one, two] = [0, 1].map(|run| self.value(parameter, run));
            let fractions = [0, 1].map(|run| parameter.value(self.runs[run].as_ref()?));
            let ratio =
                change(parameter.unit, fractions[0], fractions[1]).map(|change| match change {
                    Change::Ratio(ratio) => ratio * 100.0,
                    Change::Points(points) => points,
                });
            let same_direction = one.zip(two).is_some_and(|(one, two)| {
                let in_print = number(printed[1]) - number(printed[0]);
                (two - one) * in_print > 0.0
            });
            let computed = [one, two, ratio];
            Row {
                parameter,
                cells: std::array::from_fn(|column| Cell {
                    printed: printed[column],
                    computed: computed[column],
                    mark: computed[column].map(|value| {
                        match equal_or_not(printed[column], value) {
                            Mark::Differs if column > 0 && same_direction => Mark::SameDirection,
                            mark => mark,
                        }
                    }),
                    note: printed::note(self.scene, symbol, Some(column)),
                }),
            }
        })
    }

    /// Returns a value of a run in the unit of the printed figure.
    fn value(&self, parameter: &Parameter, run: usize) -> Option<f64> {
        let value = parameter.value(self.runs[run].as_ref()?)?;
        Some(match parameter.unit {
            Unit::Percent => value * 100.0,
            _ => value,
        })
    }
}

fn equal_or_not(printed: &str, computed: f64) -> Mark {
    let rounded = format!("{computed:.*}", decimals(printed));
    if number(&rounded) == number(printed) {
        Mark::Equal
    } else {
        Mark::Differs
    }
}

/// Returns the number of decimals of a printed figure.
pub fn decimals(printed: &str) -> usize {
    printed
        .split_once('.')
        .map_or(0, |(_, digits)| digits.len())
}

fn number(printed: &str) -> f64 {
    printed.parse().expect("printed figures are numbers")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{DELTA, LAMBDA};

    #[test]
    fn the_properties_are_the_septet_and_the_triplet() {
        assert_eq!(PROPERTIES[..7], DELTA);
        assert_eq!(PROPERTIES[7..], LAMBDA);
    }

    #[test]
    fn figures_are_equal_if_they_round_to_what_is_printed() {
        assert_eq!(equal_or_not("7.75", 7.7533), Mark::Equal);
        assert_eq!(equal_or_not("43.3", 43.248), Mark::Differs);
        assert_eq!(equal_or_not("+9.7", 9.66), Mark::Equal);
        assert_eq!(equal_or_not("4505", 4505.13), Mark::Equal);
        assert_eq!(equal_or_not("100.0", 100.0), Mark::Equal);
        assert_eq!(equal_or_not("-2.7", 2.7), Mark::Differs);
    }

    /// Checks the paper's identity N_AOIFL = N_O (1 + N_ADL) / (N_LS (1 − R_ETNLS)) in all columns,
    /// which a wrongly copied figure would break. Also checks each ratio against its two columns,
    /// within their rounding. Where the paper's own figures disagree, a note says so.
    #[test]
    fn printed_figures_fit_together() {
        for scene in &SCENES {
            let objects = scene.characteristic("N_O");
            let figures = scene.properties.map(|row| row.map(number));
            for method in [0, 1] {
                let [leaves, empty, duplication, full] =
                    [0, 1, 2, 3].map(|row: usize| figures[row][method]);
                let computed =
                    objects * (1.0 + duplication / 100.0) / (leaves * (1.0 - empty / 100.0));
                let off = (computed / full - 1.0).abs();
                assert!(off < 0.003, "{}, method {}: {off}", scene.name, method + 1);
            }
            for (symbol, row) in PROPERTIES.into_iter().zip(scene.properties) {
                let [one, two, ratio] = row.map(number);
                let [half_1, half_2, half_ratio] =
                    row.map(|printed| 0.5 * 0.1f64.powi(decimals(printed) as i32) + 1e-9);
                let [lowest, highest] = if parameter(symbol).unit == Unit::Percent {
                    [two - one - half_1 - half_2, two - one + half_1 + half_2]
                } else {
                    [
                        100.0 * (two - half_2) / (one + half_1),
                        100.0 * (two + half_2) / (one - half_1),
                    ]
                };
                let fits = (lowest - half_ratio..=highest + half_ratio).contains(&ratio);
                let note = printed::note(scene, symbol, Some(2));
                let is_slip = note.is_some_and(|text| text.contains("own columns"));
                assert_eq!(fits, !is_slip, "{} {symbol}: {ratio}", scene.name);
            }
        }
    }
}
